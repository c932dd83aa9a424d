//! The parameter protocol.

use glissade_dialect::{
    MavParamError, PARAM_REQUEST_LIST_DATA, PARAM_REQUEST_READ_DATA, PARAM_SET_DATA, PARAM_VALUE_DATA,
};
use glissade_dialect::{MavParamType, PARAM_ERROR_DATA};

use super::*;
use crate::settings::{COUNT, SETTINGS, Value, find};

const INT32: u8 = MavParamType::MAV_PARAM_TYPE_INT32 as u8;
const REAL32: u8 = MavParamType::MAV_PARAM_TYPE_REAL32 as u8;

fn list() -> Vec<u8> {
    frame(&PARAM_REQUEST_LIST_DATA { target_system: 1, target_component: 0 })
}

fn read(param_index: i16, name: &str) -> Vec<u8> {
    frame(&PARAM_REQUEST_READ_DATA { param_index, target_system: 1, target_component: 1, param_id: name.into() })
}

fn short(index: usize) -> i16 {
    i16::try_from(index).expect("few settings")
}

fn set_bits(name: &str, bits: u32, param_type: u8) -> Vec<u8> {
    let param_value = f32::from_bits(bits);
    frame(&PARAM_SET_DATA { param_value, target_system: 1, target_component: 1, param_id: name.into(), param_type })
}

fn set_real(name: &str, value: f32) -> Vec<u8> {
    set_bits(name, value.to_bits(), REAL32)
}

fn values(messages: &[MavMessage]) -> Vec<PARAM_VALUE_DATA> {
    let value =
        |message: &MavMessage| if let MavMessage::PARAM_VALUE(value) = message { Some(value.clone()) } else { None };
    messages.iter().filter_map(value).collect()
}

fn errors(messages: &[MavMessage]) -> Vec<PARAM_ERROR_DATA> {
    let error =
        |message: &MavMessage| if let MavMessage::PARAM_ERROR(error) = message { Some(error.clone()) } else { None };
    messages.iter().filter_map(error).collect()
}

#[test]
fn the_list_is_complete_in_order_and_leaves_room_for_telemetry() {
    let mut bench = Bench::new();
    let mut messages = bench.job(&list());
    messages.extend(bench.jobs(400));
    let values = values(&messages);
    assert_eq!(values.len(), COUNT);
    for (index, (value, setting)) in values.iter().zip(&SETTINGS).enumerate() {
        assert_eq!((usize::from(value.param_index), usize::from(value.param_count)), (index, COUNT));
        assert_eq!(value.param_id.to_str(), Ok(setting.name));
        let sent = Value::from_bits(setting.kind(), value.param_value.to_bits());
        assert_eq!(bench.ground.settings().get(index).map(Value::bits), Some(sent.bits()));
    }
    // 4 s, in which the motion is sent 80 times.
    assert_eq!(count(&messages, 30), 81);
    assert!(bench.jobs(100).iter().all(|message| message.message_id() != PARAM_VALUE_DATA::ID), "once");
}

#[test]
fn a_value_is_read_by_name_and_by_index_and_an_unknown_one_is_an_error() {
    let mut bench = Bench::silent();
    let index = find("MPC_TKO_SPEED").expect("in the table");
    for request in [read(-1, "MPC_TKO_SPEED"), read(short(index), "anything")] {
        let sent = values(&bench.job(&request));
        assert_eq!(sent.len(), 1);
        assert_eq!((sent[0].param_id.to_str(), sent[0].param_value), (Ok("MPC_TKO_SPEED"), 1.5));
    }
    for (request, name) in [(read(-1, "_HASH_CHECK"), "_HASH_CHECK"), (read(short(COUNT), ""), ""), (read(-1, ""), "")]
    {
        let messages = bench.job(&request);
        assert!(values(&messages).is_empty());
        let error = errors(&messages).remove(0);
        assert_eq!(error.error, MavParamError::MAV_PARAM_ERROR_DOES_NOT_EXIST as u8);
        assert_eq!((error.param_id.to_str(), error.target_system, error.target_component), (Ok(name), 255, 190));
    }
}

#[test]
fn a_value_is_set_and_echoed_and_repeated_changes_nothing() {
    let mut bench = Bench::silent();
    for (request, bits) in [
        (set_real("MPC_TKO_SPEED", 2.5), 2.5_f32.to_bits()),
        (set_bits("MAV_SYS_ID", 7, INT32), 7),
        (set_bits("SYS_AUTOSTART", 4001, INT32), 4001),
    ] {
        let echo = values(&bench.job(&request));
        assert_eq!((echo.len(), echo[0].param_value.to_bits()), (1, bits));
        let generation = bench.ground.settings().generation();
        assert_eq!(values(&bench.job(&request)), echo);
        assert_eq!(bench.ground.settings().generation(), generation, "repeated");
    }
}

#[test]
fn what_is_refused_says_why_and_what_the_value_is() {
    use MavParamError as E;
    let mut bench = Bench::silent();
    bench.input.armed = true;
    for (request, error, echoed) in [
        (set_real("MPC_TKO_SPEED", f32::NAN), E::MAV_PARAM_ERROR_VALUE_OUT_OF_RANGE, true),
        (set_real("MPC_TKO_SPEED", 1e6), E::MAV_PARAM_ERROR_VALUE_OUT_OF_RANGE, true),
        (set_bits("MPC_TKO_SPEED", 2, INT32), E::MAV_PARAM_ERROR_TYPE_MISMATCH, true),
        (set_bits("MPC_TKO_SPEED", 2, 1), E::MAV_PARAM_ERROR_TYPE_MISMATCH, true),
        (set_bits("SYS_AUTOCONFIG", 1, INT32), E::MAV_PARAM_ERROR_READ_ONLY, true),
        (set_bits("SYS_AUTOSTART", 4001, INT32), E::MAV_PARAM_ERROR_PERMISSION_DENIED, true),
        (set_bits("GL_YAW_1", f32::INFINITY.to_bits(), REAL32), E::MAV_PARAM_ERROR_VALUE_OUT_OF_RANGE, true),
        (set_real("NO_SUCH", 1.0), E::MAV_PARAM_ERROR_DOES_NOT_EXIST, false),
        (set_real("SIXTEEN_LETTERS_", 1.0), E::MAV_PARAM_ERROR_DOES_NOT_EXIST, false),
    ] {
        let before = bench.ground.settings().clone();
        let messages = bench.job(&request);
        assert_eq!(errors(&messages).remove(0).error, error as u8);
        let echo = values(&messages);
        assert_eq!(echo.len(), usize::from(echoed));
        for value in echo {
            let index = usize::from(value.param_index);
            assert_eq!(before.get(index).map(Value::bits), Some(value.param_value.to_bits()));
        }
        assert_eq!(*bench.ground.settings(), before);
    }
}

#[test]
fn a_burst_of_reads_is_answered_one_and_all() {
    let mut bench = Bench::silent();
    let burst: Vec<u8> = (0..12).flat_map(|index| read(index, "")).collect();
    let mut messages = bench.job(&burst);
    messages.extend(bench.jobs(10));
    assert_eq!(
        values(&messages).iter().map(|value| value.param_index).collect::<Vec<_>>(),
        (0..12).collect::<Vec<_>>()
    );
    // As many as 2,048 bytes hold of what there is not.
    let mut messages = bench.job(&read(-1, "NO_SUCH").repeat(32));
    messages.extend(bench.jobs(10));
    assert_eq!(errors(&messages).len(), 32);
}

#[test]
fn a_take_off_without_a_height_goes_to_the_set_one() {
    let mut bench = Bench::silent();
    bench.job(&set_real("MIS_TAKEOFF_ALT", 7.5));
    let message = COMMAND_LONG_DATA { target_system: 1, command: 22, param7: f32::NAN, ..COMMAND_LONG_DATA::DEFAULT };
    bench.job(&frame(&message));
    bench.job(&command(176, 1.0, 4.0));
    assert_eq!(bench.commands[0].request, Request::TakeOff { height_m: 7.5 });
}

#[test]
fn who_keeps_on_setting_keeps_nobody_from_arming() {
    let mut bench = Bench::silent();
    let mut armed_after = None;
    for job in 0..60 {
        // They are taken over within a few jobs, and each job another is set.
        bench.input.changes_taken = job % 4 == 0;
        let mut bytes = set_real("GL_E_GYR_N", 1e-4 * (1.0 + 0.01 * job as f32));
        if job == 10 {
            bytes.extend(command(ARM, 1.0, 0.0));
        }
        bench.job(&bytes);
        if armed_after.is_none() && !bench.commands.is_empty() {
            armed_after = Some(job - 10);
        }
    }
    assert!(armed_after.is_some_and(|jobs| jobs < 20), "{armed_after:?}");
}

#[test]
fn what_can_be_set_while_disarmed_only_is_refused_from_the_arming_on_not_from_when_it_is_seen() {
    let mut bench = Bench::silent();
    let noise = || set_real("GL_E_GYR_N", 2e-4);
    bench.job(&command(ARM, 1.0, 0.0));
    let messages = bench.job(&noise());
    assert_eq!(errors(&messages)[0].error, MavParamError::MAV_PARAM_ERROR_PERMISSION_DENIED as u8);
    // It was refused, and the vehicle stays disarmed.
    bench.jobs(5);
    assert!(errors(&bench.job(&noise())).is_empty());
}
