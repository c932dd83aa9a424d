//! Failure injection: accepted if the board supports the failure, and then passed to it.

use super::*;
use crate::failure::{Failure, Injectable, Manner, Unit};

const INJECT_FAILURE: u16 = 420;

fn request(unit: f32, manner: f32, instance: f32) -> Vec<u8> {
    frame(&COMMAND_LONG_DATA {
        target_system: 1,
        target_component: 1,
        command: INJECT_FAILURE,
        param1: unit,
        param2: manner,
        param3: instance,
        ..COMMAND_LONG_DATA::DEFAULT
    })
}

fn bench(injectable: Injectable) -> Bench {
    let mut bench = Bench::silent();
    bench.input.injectable = injectable;
    bench
}

fn gnss_and_motors() -> Injectable {
    Injectable::NONE.with(Unit::Gnss, 1, &[Manner::Off]).with(Unit::Motor, 4, &[Manner::Off])
}

#[test]
fn a_board_without_failure_injection_denies() {
    let result = bench(Injectable::NONE).result_of(&request(4.0, 1.0, 0.0));
    assert_eq!(result, Some(MavResult::MAV_RESULT_DENIED));
}

#[test]
fn accepted_failures_are_passed_to_the_board_and_nothing_else() {
    let accepted = MavResult::MAV_RESULT_ACCEPTED;
    let (denied, unsupported) = (MavResult::MAV_RESULT_DENIED, MavResult::MAV_RESULT_UNSUPPORTED);
    let gnss = |manner| Failure { unit: Unit::Gnss, manner, instance: None };
    let motor = |instance| Failure { unit: Unit::Motor, manner: Manner::Off, instance };
    for (params, result, failure) in [
        ((4.0, 1.0, 0.0), accepted, Some(gnss(Manner::Off))),
        ((4.0, 0.0, f32::NAN), accepted, Some(gnss(Manner::Well))),
        ((101.0, 1.0, 4.0), accepted, Some(motor(Some(3)))),
        ((101.0, 1.0, 0.0), accepted, Some(motor(None))),
        ((101.0, 1.0, 5.0), denied, None),
        ((4.0, 1.0, 2.0), denied, None),
        ((4.0, 2.0, 0.0), unsupported, None),
        ((3.0, 1.0, 0.0), unsupported, None),
        ((3.0, 0.0, 0.0), unsupported, None),
        ((8.0, 1.0, 0.0), unsupported, None),
        ((4.0, 8.0, 0.0), unsupported, None),
        ((f32::NAN, 1.0, 0.0), denied, None),
        ((4.0, 0.5, 0.0), denied, None),
        ((4.0, -1.0, 0.0), denied, None),
        ((260.0, 1.0, 0.0), denied, None),
    ] {
        let mut bench = bench(gnss_and_motors());
        let (output, messages) = bench.output_of(&request(params.0, params.1, params.2));
        let [MavMessage::COMMAND_ACK(ack)] = messages.as_slice() else { panic!("{messages:?}") };
        assert_eq!((ack.command, ack.result), (INJECT_FAILURE, result), "{params:?}");
        assert_eq!(output.failures.first().copied(), failure, "{params:?}");
    }
}

#[test]
fn too_many_at_once_are_temporarily_rejected() {
    let five: Vec<u8> = (0..5).flat_map(|_| request(4.0, 1.0, 0.0)).collect();
    let mut bench = bench(gnss_and_motors());
    let results: Vec<_> = bench
        .job(&five)
        .into_iter()
        .filter_map(|m| if let MavMessage::COMMAND_ACK(ack) = m { Some(ack.result) } else { None })
        .collect();
    let rejected = results.iter().filter(|r| **r == MavResult::MAV_RESULT_TEMPORARILY_REJECTED).count();
    assert_eq!((results.len(), rejected), (5, 1));
}

#[test]
fn the_whole_autopilot_passes_a_failure_to_the_board_in_the_tick_of_its_acknowledgement() {
    let mut autopilot = Autopilot::new(&FlightConfig::default()).expect("valid");
    autopilot.inner.allow_failures(gnss_and_motors());
    let sample = SensorFrame::Motion(NavState::at_rest());
    let mut sequence = 0;
    for tick in 0..200 {
        if tick == 100 {
            autopilot.ports.first().receive(&request(4.0, 1.0, 0.0));
        }
        autopilot.tick(Some(&sample));
        let failures = autopilot.inner.take_failures();
        let messages = parse(autopilot.ports.first().take(&mut [0; SENT_CAPACITY]), &mut sequence);
        assert_eq!(failures.len(), count(&messages, 77), "at {tick}");
    }
    assert!(autopilot.inner.take_failures().is_empty());
}
