//! The autopilot as a whole, through the doors a board uses: what it does with samples it cannot use, and when what its
//! partitions decide takes effect.

use firmware::airframe::Airframe;
use firmware::autopilot::Autopilot;
use firmware::commander::Request;
use firmware::config::{FlightConfig, Start};
use firmware::guidance::Trajectory;
use firmware::inner::STALE_AFTER;
use firmware::mavlink::port::Profile;
use firmware::schedule::{COMMANDER, GROUND, OUTER};
use firmware::signals::{MotorCommand, NavState, SensorFrame};
use nalgebra::{UnitQuaternion, Vector3};
use proptest::prelude::*;

/// Hovering in the air at the origin.
pub(crate) fn in_flight() -> FlightConfig {
    FlightConfig {
        start: Start::InFlight,
        trajectory: Trajectory::Hold { position_m: [0.0; 3], yaw_rad: 0.0 },
        join: None,
        ..FlightConfig::default()
    }
}

pub(crate) fn autopilot(config: &FlightConfig) -> Autopilot {
    let autopilot = Autopilot::new(config).expect("valid");
    autopilot.ports.first().open(Profile::Normal);
    autopilot
}

pub(crate) fn at(position: [f32; 3]) -> SensorFrame {
    SensorFrame::Motion(NavState { position: position.into(), ..NavState::at_rest() })
}

/// A sample for each number in it, spoilt by `bad`.
fn spoilt(bad: f32) -> Vec<SensorFrame> {
    let good = NavState::at_rest();
    let spoil = |f: &dyn Fn(&mut NavState)| {
        let mut nav = good;
        f(&mut nav);
        SensorFrame::Motion(nav)
    };
    let mut all = Vec::new();
    for i in 0..3 {
        all.push(spoil(&|nav| nav.position[i] = bad));
        all.push(spoil(&|nav| nav.velocity[i] = bad));
        all.push(spoil(&|nav| nav.rates[i] = bad));
    }
    for i in 0..4 {
        all.push(spoil(&|nav| {
            let mut q = *nav.attitude.quaternion();
            q.coords[i] = bad;
            nav.attitude = UnitQuaternion::new_unchecked(q);
        }));
    }
    all
}

#[test]
fn a_sample_that_is_not_finite_is_refused_and_the_last_good_one_held() {
    let tilted = SensorFrame::Motion(NavState {
        attitude: UnitQuaternion::from_euler_angles(0.1, -0.05, 0.2),
        rates: Vector3::new(0.3, 0.2, -0.1),
        ..NavState::at_rest()
    });
    for bad in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
        for sample in spoilt(bad) {
            let (mut refusing, mut missing) = (autopilot(&in_flight()), autopilot(&in_flight()));
            for _ in 0..10 {
                refusing.tick(Some(&tilted));
                missing.tick(Some(&tilted));
            }
            for _ in 0..20 {
                let (with, without) = (*refusing.tick(Some(&sample)), *missing.tick(None));
                assert_eq!(with, without, "a refused sample is as good as none: {sample:?}");
                assert!(with.motors.omega_rad_s.iter().all(|w| w.is_finite()));
            }
            assert_ne!(*refusing.inner.inner_output(), *autopilot(&in_flight()).tick(Some(&at([0.0; 3]))), "it holds");
        }
    }
}

#[test]
fn an_attitude_that_is_no_rotation_is_refused() {
    for scale in [0.0, 0.5, 2.0] {
        let nav = NavState {
            attitude: UnitQuaternion::new_unchecked(*UnitQuaternion::identity().quaternion() * scale),
            ..NavState::at_rest()
        };
        let (mut refusing, mut missing) = (autopilot(&in_flight()), autopilot(&in_flight()));
        for _ in 0..10 {
            assert_eq!(refusing.tick(Some(&SensorFrame::Motion(nav))), missing.tick(None));
        }
    }
}

#[test]
fn without_samples_a_vehicle_is_not_armable_and_with_them_it_is_again() {
    let mut vehicle = autopilot(&FlightConfig::default());
    let armable = |vehicle: &Autopilot| vehicle.inner.commander_output().armable.is_ok();
    let good = at([0.0; 3]);
    // A commander's job is released every period; its output takes effect after its offset.
    let settle = COMMANDER.period + COMMANDER.offset + 1;
    for _ in 0..settle {
        vehicle.tick(Some(&good));
    }
    assert!(armable(&vehicle));
    for _ in 0..STALE_AFTER + settle {
        vehicle.tick(None);
    }
    assert!(!armable(&vehicle));
    for _ in 0..settle {
        vehicle.tick(Some(&good));
    }
    assert!(armable(&vehicle));
}

#[test]
fn the_outer_loops_output_takes_effect_exactly_its_offset_after_its_release() {
    let mut moved = autopilot(&in_flight());
    let mut still = autopilot(&in_flight());
    // From the release at tick 40 on, one vehicle is a metre off: its outer loop asks for something else at tick 42.
    let released = 10 * OUTER.period;
    for tick in 0..released + OUTER.period + OUTER.offset {
        let place = if tick >= released { [1.0, 0.0, 0.0] } else { [0.0; 3] };
        moved.tick(Some(&at(place)));
        still.tick(Some(&at([0.0; 3])));
        let target = |vehicle: &Autopilot| vehicle.inner.outer_output().attitude.target.attitude;
        let differs = target(&moved) != target(&still);
        assert_eq!(differs, tick >= released + OUTER.offset, "tick {tick}");
        let (_, pitch, _) = target(&moved).euler_angles();
        assert!(!differs || pitch < -0.01, "too far north: it leans back, not {pitch}");
    }
    assert_eq!(OUTER.offset, 2, "the design's");
}

#[test]
fn the_inner_loop_answers_in_the_same_tick() {
    let (mut moved, mut still) = (autopilot(&in_flight()), autopilot(&in_flight()));
    let tilted = SensorFrame::Motion(NavState {
        attitude: UnitQuaternion::from_euler_angles(0.01, 0.0, 0.0),
        ..NavState::at_rest()
    });
    let (with, without) = (*moved.tick(Some(&tilted)), *still.tick(Some(&at([0.0; 3]))));
    // Rolled by +0.01 (left side up): U2 turns it back, rotor 2 (right) over rotor 4 (left).
    assert!(with.demand.roll_n_m < 0.0 && without.demand.roll_n_m == 0.0);
    let [_, right, _, left] = with.motors.omega_rad_s;
    assert!(right > left);
}

#[test]
fn hover_asks_for_the_weight() {
    let mut vehicle = autopilot(&in_flight());
    let output = *vehicle.tick(Some(&at([0.0; 3])));
    let weight = Airframe::paper(2.0).weight_n();
    let near = |value: f32, exact: f32, part: f32| (exact * (1.0 - part)..exact * (1.0 + part)).contains(&value);
    assert!(near(output.demand.thrust_n, weight, 1e-5), "{output:?}");
    let hover = Airframe::paper(2.0).omega_for_thrust_to_weight(1.0);
    assert!(output.motors.omega_rad_s.iter().all(|w| near(*w, hover, 1e-4)), "{output:?}");
}

/// Ticks without the outer partition's jobs being run.
fn fly_without_outer(pilot: &mut Autopilot, sample: &SensorFrame, ticks: u32) {
    for _ in 0..ticks {
        pilot.inner.tick(&mut pilot.mail, &pilot.ports, Some(sample));
    }
}

#[test]
fn an_outer_loop_that_stops_answering_is_not_extrapolated_for_ever() {
    // On the helix and with its velocity, the attitude reference has rates and accelerations.
    let helix = FlightConfig { trajectory: Trajectory::PAPER_HELIX, ..in_flight() };
    let mut pilot = autopilot(&helix);
    let sample = SensorFrame::Motion(NavState {
        position: Vector3::new(0.0, 5.0, 2.0),
        velocity: Vector3::new(4.0, 0.0, 1.0),
        ..NavState::at_rest()
    });
    for _ in 0..8 {
        pilot.tick(Some(&sample));
    }
    assert!(!pilot.inner.outer_output().limited && pilot.inner.outer_output().attitude.target.rates.norm() > 0.01);
    fly_without_outer(&mut pilot, &sample, 100);
    let soon = pilot.inner.inner_output().demand;
    fly_without_outer(&mut pilot, &sample, 10_000);
    let late = pilot.inner.inner_output().demand;
    assert_eq!(soon, late, "after 20 ms nothing changes any more");
    assert!(pilot.mail.overruns()[0] > 0, "and it is counted");
}

/// MAVLink 2 `COMMAND_LONG` 400 (arm or disarm), by hand: from system 255, component 190, to system 1, component 1.
pub(crate) fn command_arm(arm: bool, force: bool) -> Vec<u8> {
    command_arm_from(255, arm, force)
}

/// The same from another system.
fn command_arm_from(system: u8, arm: bool, force: bool) -> Vec<u8> {
    let mut payload = Vec::new();
    let magic = if force { 21_196.0_f32 } else { 0.0 };
    for parameter in [f32::from(u8::from(arm)), magic, 0.0, 0.0, 0.0, 0.0, 0.0] {
        payload.extend(parameter.to_le_bytes());
    }
    payload.extend(400_u16.to_le_bytes());
    payload.extend([1, 1, 0]);
    while payload.len() > 1 && payload.last() == Some(&0) {
        payload.pop();
    }
    let mut frame = vec![0xfd, payload.len() as u8, 0, 0, 0, system, 190, 76, 0, 0];
    frame.extend(payload);
    // X.25 over all but the first byte, then COMMAND_LONG's CRC_EXTRA.
    let crc = frame[1..].iter().chain(&[152]).fold(0xffff_u16, |crc, byte| {
        let mut mixed = byte ^ (crc as u8);
        mixed ^= mixed << 4;
        let mixed = u16::from(mixed);
        (crc >> 8) ^ (mixed << 8) ^ (mixed << 3) ^ (mixed >> 4)
    });
    frame.extend(crc.to_le_bytes());
    frame
}

fn is_stopped(motors: &MotorCommand) -> bool {
    *motors == MotorCommand::STOPPED
}

#[test]
fn a_forced_disarm_stops_the_rotors_at_the_tick_it_is_published() {
    let mut vehicle = autopilot(&in_flight());
    let high = at([0.0, 0.0, 20.0]);
    for _ in 0..GROUND.period {
        vehicle.tick(Some(&high));
    }
    // Read by the ground's job released at tick 10, published at tick 20.
    vehicle.ports.first().receive(&command_arm(false, true));
    for tick in GROUND.period..500 {
        let stopped = is_stopped(&vehicle.tick(Some(&high)).motors);
        assert_eq!(stopped, tick >= GROUND.period + GROUND.offset, "tick {tick}");
    }
    assert!(!vehicle.inner.commander_output().armed, "and the commander knows");
}

#[test]
fn a_disarm_in_the_air_is_refused_unless_forced() {
    let mut vehicle = autopilot(&in_flight());
    let high = at([0.0, 0.0, 20.0]);
    vehicle.ports.first().receive(&command_arm(false, false));
    for _ in 0..200 {
        assert!(!is_stopped(&vehicle.tick(Some(&high)).motors));
    }
    assert!(vehicle.inner.commander_output().armed);
}

#[test]
fn after_a_forced_disarm_the_vehicle_can_be_armed_again() {
    let mut vehicle = autopilot(&FlightConfig::default());
    let ground = at([0.0; 3]);
    let mut fly = |frame: &[u8]| {
        vehicle.ports.first().receive(frame);
        (0..1_100).map(|_| is_stopped(&vehicle.tick(Some(&ground)).motors)).last()
    };
    assert_eq!(fly(&[]), Some(true), "disarmed at first");
    assert_eq!(fly(&command_arm(true, false)), Some(false));
    // With an arming behind the kill, as if it had waited on another link.
    assert_eq!(fly(&[command_arm(false, true), command_arm(true, true)].concat()), Some(true));
    assert_eq!(fly(&command_arm(true, false)), Some(false));
}

/// Results of the acknowledgements to a system among whole MAVLink 2 frames.
pub(crate) fn acknowledged(mut frames: &[u8], system: u8) -> Vec<u8> {
    let mut results = Vec::new();
    while let [0xfd, length, ..] = *frames {
        let (frame, rest) = frames.split_at(12 + usize::from(length));
        let (id, payload) = ([frame[7], frame[8], frame[9]], &frame[10..]);
        // COMMAND_ACK: command, result, progress, result_param2, target.
        if id == [77, 0, 0] && length == 10 && payload[8] == system {
            results.push(payload[2]);
        }
        frames = rest;
    }
    results
}

/// The armed flag of the last heartbeat among whole MAVLink 2 frames.
fn says_armed(mut frames: &[u8]) -> Option<bool> {
    let mut armed = None;
    while let [0xfd, length, ..] = *frames {
        let (frame, rest) = frames.split_at(12 + usize::from(length));
        if frame[7..10] == [0, 0, 0] {
            armed = Some(frame[10 + 6] & 0x80 != 0);
        }
        frames = rest;
    }
    armed
}

proptest! {
    /// Forced disarms from two stations on links of their own, whenever, with as many other commands around them as arrive at once: the rotors
    /// stop within two jobs of the ground partition and stay stopped; commander, heartbeat and acknowledgement agree; and
    /// arming works afterwards.
    #[test]
    fn a_kill_is_lost_in_no_queue(
        offset in 0..40_u32,
        before in 0..9_usize,
        on_board in 0..5_usize,
        stations in prop::collection::vec(prop::sample::select(vec![255_u8, 254]), 1..3),
    ) {
        let mut vehicle = autopilot(&in_flight());
        let high = at([0.0, 0.0, 20.0]);
        let link = |station: u8| 255 - usize::from(station);
        vehicle.ports.get(1).expect("a link").open(Profile::Onboard);
        let mut sent = [Vec::new(), Vec::new()];
        let tick = |vehicle: &mut Autopilot, sent: &mut [Vec<u8>; 2]| {
            let stopped = is_stopped(&vehicle.tick(Some(&high)).motors);
            for (sent, port) in sent.iter_mut().zip(&vehicle.ports) {
                sent.extend_from_slice(port.take(&mut [0; 2048]));
            }
            stopped
        };
        for _ in 0..offset {
            prop_assert!(!tick(&mut vehicle, &mut sent));
        }
        for _ in 0..on_board {
            let _ = vehicle.inner.request(Request::Hold);
        }
        for _ in 0..before {
            vehicle.ports.first().receive(&command_arm_from(253, true, true));
        }
        for station in &stations {
            vehicle.ports.get(link(*station)).expect("a link").receive(&command_arm_from(*station, false, true));
        }
        let latest = GROUND.period + GROUND.offset;
        let stopped: Vec<bool> = (0..1_200).map(|_| tick(&mut vehicle, &mut sent)).collect();
        prop_assert!(stopped[latest as usize - 1..].iter().all(|stopped| *stopped), "{stopped:?}");
        prop_assert!(!vehicle.inner.commander_output().armed, "the commander knows");
        for sent in &sent {
            prop_assert_eq!(says_armed(sent), Some(false), "so does the heartbeat");
        }
        for station in &stations {
            let results = acknowledged(&sent[link(*station)], *station);
            prop_assert!(acknowledged(&sent[1 - link(*station)], *station).is_empty(), "on its own link alone");
            prop_assert!(!results.is_empty() && results.iter().all(|result| *result == 0), "{results:?}");
        }
        vehicle.ports.first().receive(&command_arm(true, true));
        let stopped = (0..100).map(|_| tick(&mut vehicle, &mut sent)).last();
        prop_assert_eq!(stopped, Some(false), "armed again");
        prop_assert!(vehicle.inner.commander_output().armed);
    }
}
