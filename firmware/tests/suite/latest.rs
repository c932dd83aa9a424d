//! Latest values on their way through the whole autopilot: how soon sticks arrive, and that nothing old replaces
//! what is newer.

use firmware::autopilot::Autopilot;
use firmware::config::{FlightConfig, Start};
use firmware::guidance::Trajectory;
use firmware::latest::Latest;
use firmware::mavlink::port::Profile;
use firmware::schedule::{GROUND, OUTER};
use firmware::signals::{NavState, SensorFrame, Tick};
use glissade_dialect::mavlink_core::{MAVLinkV2MessageRaw, MavHeader, MessageData};
use glissade_dialect::{HEARTBEAT_DATA, MANUAL_CONTROL_DATA};
use nalgebra::Vector3;
use proptest::prelude::*;

use crate::modes::config;

fn frame(message: &impl MessageData) -> Vec<u8> {
    let mut frame = MAVLinkV2MessageRaw::new();
    frame.serialize_message_data(MavHeader { system_id: 255, component_id: 190, sequence: 0 }, message);
    frame.raw_bytes().to_vec()
}

/// Sticks with a number in them.
fn sticks(number: u16) -> Vec<u8> {
    frame(&MANUAL_CONTROL_DATA { target: 1, buttons: number, ..MANUAL_CONTROL_DATA::DEFAULT })
}

/// A heartbeat.
fn heartbeat(mavtype: u8) -> Vec<u8> {
    frame(&HEARTBEAT_DATA { mavtype, ..HEARTBEAT_DATA::DEFAULT })
}

const STATION: u8 = 6;

fn hovering() -> FlightConfig {
    let start = [0.0, 0.0, 20.0];
    FlightConfig {
        start: Start::InFlight,
        trajectory: Trajectory::Hold { position_m: start, yaw_rad: 0.0 },
        start_position_m: start,
        join: None,
        ..config()
    }
}

/// The schedule as on a board, where the ground partition may be late.
struct Vehicle {
    pilot: Autopilot,
    /// The ground partition's output, and when it will be finished.
    late: Option<(Tick, firmware::mavlink::GroundOutput)>,
    tick: Tick,
}

impl Vehicle {
    fn new() -> Self {
        let pilot = Autopilot::new(&hovering()).expect("valid");
        pilot.ports.first().open(Profile::Normal);
        pilot.ports.get(1).expect("a link").open(Profile::Onboard);
        Self { pilot, late: None, tick: 0 }
    }

    /// A tick in which a job of the ground partition takes `delay` ticks. Returns what outer and commander are handed.
    fn tick(&mut self, delay: Tick) -> [Option<Latest>; 2] {
        let Autopilot { inner, outer, commander, ground, mail, ports, .. } = &mut self.pilot;
        let motion = NavState { position: Vector3::new(0.0, 0.0, 20.0), ..NavState::at_rest() };
        let released = inner.tick(mail, ports, Some(&SensorFrame::Motion(motion)));
        let mut handed = [None; 2];
        if released.outer
            && let Some((tick, input)) = mail.outer.take()
        {
            handed[0] = Some(input.latest);
            mail.outer.finish(outer.step(tick, &input));
        }
        if released.commander
            && let Some((tick, input)) = mail.commander.take()
        {
            handed[1] = Some(input.latest);
            mail.commander.finish(commander.step(tick, &input));
        }
        if released.ground
            && let Some((tick, input)) = mail.ground.take()
        {
            self.late = Some((self.tick + delay, ground.step(tick, &input, ports)));
        }
        if let Some((_, output)) = self.late.take_if(|(at, _)| *at <= self.tick) {
            mail.ground.finish(output);
        }
        for port in &*ports {
            port.take(&mut [0; 2048]);
        }
        self.tick += 1;
        handed
    }
}

/// From the bytes of a stick message to the rotors: less than this, ticks.
const STICK_TO_ROTOR: Tick = 25;

#[test]
fn sticks_are_in_the_outer_loop_within_18_ms_and_can_move_a_rotor_within_20() {
    let mut longest = 0;
    for offset in 0..40 {
        let mut vehicle = Vehicle::new();
        for _ in 0..offset {
            assert!(vehicle.tick(0).iter().flatten().all(|latest| latest.sticks.is_none()));
        }
        // At worst they arrive just after the last tick.
        let arrived = vehicle.tick.wrapping_sub(1);
        vehicle.pilot.ports.first().receive(&sticks(7));
        let released = loop {
            let tick = vehicle.tick;
            if let [Some(Latest { sticks: Some(sticks), .. }), _] = vehicle.tick(0) {
                assert_eq!(sticks.value.buttons, 7);
                break tick;
            }
            assert!(tick < 100, "they never arrive");
        };
        longest = longest.max(released.wrapping_sub(arrived));
    }
    assert_eq!(longest, 18, "as the schedule says");
    assert!(longest + OUTER.offset <= 20 && 20 < STICK_TO_ROTOR);
}

proptest! {
    /// Sticks and heartbeats on two links at any ticks, with a ground partition that is late at times.
    #[test]
    fn what_is_handed_on_is_never_older_than_before(
        delays in prop::collection::vec(prop_oneof![4 => Just(0), 1 => 1..15_u32], 400),
        arrivals in prop::collection::vec((0..4_usize, 1..30_u32), 40),
    ) {
        let mut vehicle = Vehicle::new();
        let mut schedule: Vec<(Tick, usize)> = Vec::new();
        for (kind, gap) in arrivals {
            schedule.push((schedule.last().map_or(0, |(tick, _)| *tick) + gap, kind));
        }
        let (mut number, mut last) = (0_u16, [(0, 0, 0); 2]);
        let mut sent_at = Vec::new();
        for delay in delays {
            for (_, kind) in schedule.extract_if(.., |(tick, _)| *tick == vehicle.tick) {
                let port = vehicle.pilot.ports.get(kind % 2).expect("a link");
                if kind < 2 {
                    number += 1;
                    sent_at.push(vehicle.tick);
                    port.receive(&sticks(number));
                } else {
                    port.receive(&heartbeat(STATION));
                }
            }
            let now = vehicle.tick;
            for (last, latest) in last.iter_mut().zip(vehicle.tick(delay)) {
                let Some(latest) = latest else { continue };
                let (number, at) = latest.sticks.map_or((0, 0), |sticks| (sticks.value.buttons, sticks.at));
                let station = latest.station.unwrap_or(0);
                prop_assert!(number >= last.0 && at >= last.1 && station >= last.2, "{:?} after {:?}", latest, last);
                prop_assert!(at <= now && station <= now);
                *last = (number, at, station);
            }
        }
        // What has come last arrives in the end, or what has come on another link for the same job.
        for _ in 0..60 {
            vehicle.tick(0);
        }
        let arrived = vehicle.pilot.inner.latest().sticks.map_or(0, |sticks| sticks.value.buttons);
        let at = |number: u16| number.checked_sub(1).map_or(0, |index| sent_at[usize::from(index)]);
        prop_assert!(at(number) - at(arrived) < 2 * GROUND.period, "{} of {}", arrived, number);
    }
}
