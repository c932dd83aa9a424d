//! Telemetry of sensors, battery and estimator.

use super::*;
use crate::estimator::status::{Sensor, Status};
use crate::sensors::BatterySample;
use crate::signals::NavHealth;

const WELL: Sensor = Sensor { present: true, healthy: true };
const SILENT: Sensor = Sensor { present: true, healthy: false };
const ABSENT: Sensor = Sensor { present: false, healthy: false };

pub(super) fn status() -> Status {
    Status {
        health: NavHealth::ALL,
        mag: WELL,
        baro: WELL,
        gnss: WELL,
        pose: ABSENT,
        battery: WELL,
        battery_sample: Some(BatterySample { voltage_v: 15.25, current_a: 12.5 }),
        ratios: [0.1, 0.2, 0.3, 0.4],
        accuracy_m: [0.5, 0.25],
        sigma: [0.01; 9],
        wind: [0.0; 2],
        wind_sigma: [5.0; 2],
        origin: None,
    }
}

fn heard(estimator: Status) -> Vec<MavMessage> {
    let mut bench = Bench::new();
    bench.input.estimator = Some(estimator);
    bench.jobs(100)
}

fn sys_status(estimator: Status) -> glissade_dialect::SYS_STATUS_DATA {
    let found =
        heard(estimator).into_iter().find_map(|m| if let MavMessage::SYS_STATUS(m) = m { Some(m) } else { None });
    found.expect("sent")
}

#[test]
fn sys_status_reports_present_and_healthy_sensors() {
    const SENSORS: u32 = 1 | 2 | 4 | 8 | 0x20 | 0x200 | 0x20_0000 | 0x200_0000;
    let told = sys_status(Status { gnss: SILENT, ..status() });
    assert_eq!(told.onboard_control_sensors_present.bits() & SENSORS, SENSORS & !0x200, "no motion capture");
    assert_eq!(told.onboard_control_sensors_health.bits() & SENSORS, SENSORS & !0x220);
    let told = sys_status(Status { health: NavHealth { heading: false, ..NavHealth::ALL }, ..status() });
    assert_eq!(told.onboard_control_sensors_health.bits() & 0x20_0000, 0, "the heading is not known");
}

#[test]
fn sys_status_reports_the_battery_while_it_is_measured() {
    let told = sys_status(status());
    assert_eq!((told.voltage_battery, told.current_battery, told.battery_remaining), (15_250, 1_250, -1));
    let told = sys_status(Status { battery: SILENT, ..status() });
    assert_eq!((told.voltage_battery, told.current_battery), (u16::MAX, -1));
    let wild = BatterySample { voltage_v: 1e9, current_a: -1e9 };
    let told = sys_status(Status { battery_sample: Some(wild), ..status() });
    assert_eq!((told.voltage_battery, told.current_battery), (u16::MAX - 1, 0));
}

#[test]
fn estimator_status_is_sent_once_per_second() {
    let found: Vec<_> = heard(status())
        .into_iter()
        .filter_map(|m| if let MavMessage::ESTIMATOR_STATUS(m) = m { Some(m) } else { None })
        .collect();
    let [told] = found.as_slice() else { panic!("{found:?}") };
    assert_eq!(told.flags.bits(), 1 | 2 | 4 | 8 | 16);
    assert_eq!((told.vel_ratio, told.pos_horiz_ratio, told.pos_vert_ratio, told.mag_ratio), (0.1, 0.2, 0.3, 0.4));
    assert_eq!((told.pos_horiz_accuracy, told.pos_vert_accuracy), (0.5, 0.25));
    assert_eq!(told.time_usec, 350_000);
}

#[test]
fn a_vertical_velocity_is_known_without_a_height() {
    let flags = |health: NavHealth| {
        let told = heard(Status { health, ..status() });
        let told = told.into_iter().find_map(|m| if let MavMessage::ESTIMATOR_STATUS(m) = m { Some(m) } else { None });
        told.expect("sent").flags.bits()
    };
    assert_eq!(flags(NavHealth { height: false, ..NavHealth::ALL }) & 4, 4);
    assert_eq!(flags(NavHealth { climb: false, ..NavHealth::ALL }) & 4, 0);
}

#[test]
fn unknown_states_are_not_flagged() {
    let lost =
        Status { gnss: SILENT, health: NavHealth { position: false, height: false, ..NavHealth::ALL }, ..status() };
    let flags =
        heard(lost).into_iter().find_map(|m| if let MavMessage::ESTIMATOR_STATUS(m) = m { Some(m) } else { None });
    assert_eq!(flags.expect("sent").flags.bits(), 1 | 2 | 4);
}

#[test]
fn a_position_without_gnss_is_a_relative_one() {
    let silent = Status { gnss: SILENT, ..status() };
    let told =
        heard(silent).into_iter().find_map(|m| if let MavMessage::ESTIMATOR_STATUS(m) = m { Some(m) } else { None });
    assert_eq!(told.expect("sent").flags.bits(), 1 | 2 | 4 | 8);
}

#[test]
fn on_ideal_state_nothing_is_estimated() {
    assert_eq!(count(&Bench::new().jobs(200), 230), 0);
    let result = Bench::silent().result_of(&command(REQUEST_MESSAGE, 230.0, 0.0));
    assert_eq!(result, Some(MavResult::MAV_RESULT_TEMPORARILY_REJECTED));
}
