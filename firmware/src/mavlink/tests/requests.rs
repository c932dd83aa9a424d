//! Requests for messages and intervals, pings, and the profiles.

use glissade_dialect::PING_DATA;

use super::*;
use crate::mavlink::telemetry::Telemetry;

const GET_INTERVAL: u16 = 510;
const PROTOCOL_VERSION: u16 = 519;

fn interval(bench: &mut Bench, received: &[u8]) -> Option<(u16, i32)> {
    bench.job(received).into_iter().find_map(|message| match message {
        MavMessage::MESSAGE_INTERVAL(told) => Some((told.message_id, told.interval_us)),
        _ => None,
    })
}

#[test]
fn an_interval_is_told_in_either_way() {
    let mut bench = Bench::new();
    for (id, expected) in [(30.0, 50_000), (331.0, -1), (435.0, -1), (28.0, 0), (0.0, 1_000_000)] {
        assert_eq!(interval(&mut bench, &command(GET_INTERVAL, id, 0.0)), Some((id as u16, expected)));
        assert_eq!(interval(&mut bench, &command(REQUEST_MESSAGE, 244.0, id)), Some((id as u16, expected)));
    }
    bench.job(&command(SET_INTERVAL, 30.0, 25_000.0));
    assert_eq!(interval(&mut bench, &command(GET_INTERVAL, 30.0, 0.0)), Some((30, 25_000)));
    for id in [f32::NAN, -1.0, 0.5, 1e9] {
        assert_eq!(bench.result_of(&command(GET_INTERVAL, id, 0.0)), Some(MavResult::MAV_RESULT_DENIED), "{id}");
    }
}

#[test]
fn setting_the_interval_that_is_set_sends_nothing_more() {
    let mut bench = Bench::new();
    bench.jobs(100);
    let alone = count(&bench.jobs(100), 245);
    for default in [0.0, f32::NAN, 500_000.0] {
        let messages: Vec<_> = (0..100).flat_map(|_| bench.job(&command(SET_INTERVAL, 245.0, default))).collect();
        assert_eq!((count(&messages, 245), alone), (2, 2), "{default}");
    }
}

#[test]
fn an_interval_with_a_reserved_parameter_is_denied() {
    let set = COMMAND_LONG_DATA {
        target_system: 1,
        target_component: 1,
        command: SET_INTERVAL,
        param1: 30.0,
        param2: 10_000.0,
        ..COMMAND_LONG_DATA::DEFAULT
    };
    let mut bench = Bench::silent();
    for (denied, allowed) in [
        (COMMAND_LONG_DATA { param3: 1.0, ..set.clone() }, COMMAND_LONG_DATA { param3: f32::NAN, ..set.clone() }),
        (COMMAND_LONG_DATA { param4: 1.0, ..set.clone() }, COMMAND_LONG_DATA { param4: f32::NAN, ..set.clone() }),
        (COMMAND_LONG_DATA { param5: 1.0, ..set.clone() }, COMMAND_LONG_DATA { param5: f32::NAN, ..set.clone() }),
        (COMMAND_LONG_DATA { param6: 1.0, ..set.clone() }, COMMAND_LONG_DATA { param6: f32::NAN, ..set.clone() }),
        (COMMAND_LONG_DATA { param7: 3.0, ..set.clone() }, COMMAND_LONG_DATA { param7: 1.0, ..set }),
    ] {
        assert_eq!(bench.result_of(&frame(&denied)), Some(MavResult::MAV_RESULT_DENIED), "{denied:?}");
        assert_eq!(bench.result_of(&frame(&allowed)), Some(MavResult::MAV_RESULT_ACCEPTED), "{allowed:?}");
    }
}

#[test]
fn an_interval_that_is_no_multiple_of_10_ms_is_kept_on_average_and_a_very_long_one_is_long() {
    let mut bench = Bench::new();
    bench.set_interval(30.0, 25_000.0);
    bench.jobs(10);
    let came = count(&bench.jobs(1_000), 30);
    assert!(came.abs_diff(400) <= 1, "{came} in 10 s");
    // A month is more than half of what the clock counts before it begins anew.
    for seconds in [1e6, 3e6, 4e6, 1e9] {
        bench.job(&command(SET_INTERVAL, 30.0, seconds * 1e6));
        bench.jobs(1);
        assert_eq!(count(&bench.jobs(500), 30), 0, "{seconds} s");
    }
}

#[test]
fn the_protocols_version_is_told_by_the_old_command_too() {
    let mut bench = Bench::silent();
    assert_eq!(count(&bench.job(&command(PROTOCOL_VERSION, 1.0, 0.0)), 300), 1);
    assert_eq!(bench.result_of(&command(PROTOCOL_VERSION, 0.0, 0.0)), Some(MavResult::MAV_RESULT_DENIED));
}

#[test]
fn a_ping_to_anyone_is_answered_and_an_answer_is_not() {
    let mut bench = Bench::silent();
    let ping = PING_DATA { time_usec: 123_456_789_012, seq: 7, target_system: 0, target_component: 0 };
    let messages = bench.job(&frame(&ping));
    let [MavMessage::PING(answer)] = messages.as_slice() else { panic!("{messages:?}") };
    assert_eq!((answer.time_usec, answer.seq), (123_456_789_012, 7));
    assert_eq!((answer.target_system, answer.target_component), (255, 190));
    assert!(bench.job(&frame(&PING_DATA { target_system: 1, target_component: 1, ..ping })).is_empty());
}

#[test]
fn a_link_on_board_is_told_more_often() {
    let mut bench = Bench::new();
    bench.ground.links[0].telemetry = Telemetry::new(Profile::Onboard, 0);
    let messages = bench.jobs(1_000);
    for (id, expected) in [(0, 10), (30, 1_000), (32, 500), (31, 500), (245, 50)] {
        assert_eq!(count(&messages, id), expected, "message {id} in 10 s");
    }
    assert!(bench.largest <= SENT_CAPACITY);
    bench.job(&command(SET_INTERVAL, 32.0, 1e6));
    bench.job(&command(SET_INTERVAL, 32.0, 0.0));
    assert_eq!(interval(&mut bench, &command(GET_INTERVAL, 32.0, 0.0)), Some((32, 20_000)), "its own default");
}
