//! Latest values on their way through the whole autopilot: how soon sticks arrive, that nothing old replaces what is
//! newer, and the answer to a ground station that is lost.

use firmware::autopilot::Autopilot;
use firmware::commander::{Goal, Mode, Override, Request, StationAction};
use firmware::config::{FlightConfig, Start};
use firmware::guidance::Trajectory;
use firmware::latest::Latest;
use firmware::mavlink::port::Profile;
use firmware::schedule::{GROUND, OUTER};
use firmware::settings::{COM_DL_LOSS_T, NAV_DLL_ACT, Settings, Value};
use firmware::signals::{NavState, SensorFrame, Tick};
use glissade_dialect::mavlink_core::{MAVLinkV2MessageRaw, MavHeader, MessageData};
use glissade_dialect::{HEARTBEAT_DATA, MANUAL_CONTROL_DATA};
use nalgebra::Vector3;
use proptest::prelude::*;

use crate::autopilot::command_arm;
use crate::vehicle::{Body, config};

pub(crate) fn frame(message: &impl MessageData) -> Vec<u8> {
    let mut frame = MAVLinkV2MessageRaw::new();
    frame.serialize_message_data(MavHeader { system_id: 255, component_id: 190, sequence: 0 }, message);
    frame.raw_bytes().to_vec()
}

/// Sticks with a number in them.
fn sticks(number: u16) -> Vec<u8> {
    frame(&MANUAL_CONTROL_DATA { target: 1, buttons: number, ..MANUAL_CONTROL_DATA::DEFAULT })
}

/// The heartbeat of a ground station, or of a vehicle.
fn heartbeat(mavtype: u8) -> Vec<u8> {
    frame(&HEARTBEAT_DATA { mavtype, ..HEARTBEAT_DATA::DEFAULT })
}

const STATION: u8 = 6;
const QUADROTOR: u8 = 2;

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
        mail.outer.run(|tick, input| {
            handed[0] = Some(input.latest);
            outer.step(tick, input)
        });
        mail.commander.run(|tick, input| {
            handed[1] = Some(input.latest);
            commander.step(tick, input)
        });
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

#[test]
fn sticks_that_come_together_with_commands_arrive_as_soon() {
    let mut vehicle = Vehicle::new();
    for number in 1..20 {
        // Armed it is already.
        let bytes = [sticks(number), command_arm(true, false)].concat();
        vehicle.pilot.ports.first().receive(&bytes);
        for _ in 0..GROUND.period {
            vehicle.tick(0);
        }
        let arrived = vehicle.pilot.inner.latest().sticks.expect("sticks");
        assert_eq!(arrived.value.buttons, number);
    }
}

proptest! {
    /// Sticks on one link and heartbeats on two at any ticks, with a ground partition that is late at times.
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
        for delay in delays {
            for (_, kind) in schedule.extract_if(.., |(tick, _)| *tick == vehicle.tick) {
                let port = vehicle.pilot.ports.get(kind % 2).expect("a link");
                if kind < 2 {
                    number += 1;
                    // Of one station: those of another would not count.
                    vehicle.pilot.ports.first().receive(&sticks(number));
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
        // What has come last arrives in the end.
        for _ in 0..60 {
            vehicle.tick(0);
        }
        let arrived = vehicle.pilot.inner.latest().sticks.map_or(0, |sticks| sticks.value.buttons);
        prop_assert_eq!(arrived, number);
    }
}

/// A vehicle in the air, and the ground stations that it hears.
pub(crate) struct Flight {
    pub(crate) pilot: Autopilot,
    pub(crate) body: Body,
    tick: Tick,
    pub(crate) sent: Vec<u8>,
}

impl Flight {
    /// Hovering at 20 m; the ground station is lost after 5 s.
    pub(crate) fn new(action: i32) -> Self {
        let config = hovering();
        let mut settings = Settings::of(&config);
        settings.restore(NAV_DLL_ACT, Value::Int(action)).expect("in range");
        settings.restore(COM_DL_LOSS_T, Value::Int(5)).expect("in range");
        let pilot = Autopilot::new(&config).expect("valid").with_settings(settings);
        pilot.ports.first().open(Profile::Normal);
        let nav = NavState { position: config.start_position(), ..NavState::at_rest() };
        Self { pilot, body: Body { airframe: config.airframe, nav }, tick: 0, sent: Vec::new() }
    }

    /// Flies, with a heartbeat of these types each second.
    pub(crate) fn fly(&mut self, seconds: u32, beats: &[u8]) -> &mut Self {
        for _ in 0..seconds * 1000 {
            if self.tick.is_multiple_of(1000) {
                for mavtype in beats {
                    self.pilot.ports.first().receive(&heartbeat(*mavtype));
                }
            }
            let motors = self.pilot.tick(Some(&SensorFrame::Motion(self.body.nav))).motors;
            self.body.step(&motors);
            self.sent.extend_from_slice(self.pilot.ports.first().take(&mut [0; 2048]));
            self.tick += 1;
        }
        self
    }

    /// On the way to a place 60 m away, with a ground station for 3 s.
    fn on_the_way(action: i32) -> Self {
        let mut flight = Self::new(action);
        flight.fly(1, &[STATION]);
        let place = Request::GoTo(Goal::at([60.0, 0.0, 20.0], 0.0));
        flight.pilot.inner.request(place).expect("room");
        flight.fly(2, &[STATION]);
        assert_eq!(flight.mode(), Mode::GoTo);
        flight
    }

    fn mode(&self) -> Mode {
        self.pilot.inner.commander_output().mode
    }

    pub(crate) fn says(&self, text: &str) -> bool {
        self.sent.windows(text.len()).any(|bytes| bytes == text.as_bytes())
    }

    fn off_home_m(&self) -> f32 {
        self.body.nav.position.xy().norm()
    }
}

#[test]
fn a_vehicle_that_loses_its_station_on_the_way_returns_home_and_lands() {
    let mut flight = Flight::on_the_way(2);
    flight.fly(4, &[]);
    assert_eq!(flight.mode(), Mode::GoTo, "not yet");
    assert!(flight.off_home_m() > 10.0);
    flight.fly(3, &[QUADROTOR]);
    assert_eq!(flight.mode(), Mode::Return);
    let overridden = flight.pilot.inner.commander_output().overridden;
    assert_eq!(overridden, Some(Override::StationLost { action: StationAction::Return }));
    assert!(flight.says("Ground station lost: returning home"));
    flight.fly(90, &[]);
    assert_eq!(flight.mode(), Mode::Disarmed);
    assert!(flight.off_home_m() < 0.5 && flight.body.nav.position.z < 0.1);
}

#[test]
fn the_other_answers_are_to_land_where_it_is_and_to_hold() {
    let mut flight = Flight::on_the_way(3);
    flight.fly(6, &[]);
    assert_eq!(flight.mode(), Mode::Land);
    assert!(flight.says("Ground station lost: landing"));
    flight.fly(60, &[]);
    assert_eq!(flight.mode(), Mode::Disarmed);
    assert!((15.0..60.0).contains(&flight.off_home_m()) && flight.body.nav.position.z < 0.1);

    let mut flight = Flight::on_the_way(1);
    flight.fly(6, &[]);
    assert_eq!(flight.mode(), Mode::Hold);
    assert!(flight.says("Ground station lost: holding"));
    let nav = flight.fly(10, &[]).body.nav;
    assert!(nav.velocity.norm() < 0.05 && nav.position.x < 59.0 && nav.position.z > 19.0);
}

#[test]
fn heartbeats_prevent_it_and_so_does_a_station_that_was_never_there() {
    let mut flight = Flight::on_the_way(2);
    flight.fly(40, &[STATION, QUADROTOR]);
    assert!(flight.mode() == Mode::GoTo && (flight.off_home_m() - 60.0).abs() < 0.3);
    let mut flight = Flight::new(2);
    flight.fly(20, &[QUADROTOR]);
    assert_eq!(flight.mode(), Mode::Follow);
    assert!(!flight.says("Ground station lost"));
}
