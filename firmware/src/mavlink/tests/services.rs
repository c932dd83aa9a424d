//! Requests of protocols that the vehicle does not have: each is answered in the job that reads it.

use glissade_dialect::{
    FILE_TRANSFER_PROTOCOL_DATA, LOG_REQUEST_DATA_DATA, LOG_REQUEST_LIST_DATA, MISSION_CLEAR_ALL_DATA,
    MISSION_COUNT_DATA, MISSION_ITEM_INT_DATA, MISSION_REQUEST_INT_DATA, MISSION_REQUEST_PARTIAL_LIST_DATA,
    MISSION_SET_CURRENT_DATA, MavMissionResult, PARAM_EXT_REQUEST_LIST_DATA, PARAM_EXT_REQUEST_READ_DATA,
    PARAM_EXT_SET_DATA, SERIAL_CONTROL_DATA,
};

use super::*;

/// The one message that answers.
fn answer(message: &impl MessageData) -> MavMessage {
    let mut messages = Bench::silent().job(&frame(message));
    assert_eq!(messages.len(), 1, "{messages:?}");
    messages.remove(0)
}

#[test]
fn missions_take_nothing_have_nothing_and_say_so() {
    let target_system = 1;
    let upload = MISSION_COUNT_DATA { target_system, count: 3, mission_type: 1, ..MISSION_COUNT_DATA::DEFAULT };
    let item = MISSION_ITEM_INT_DATA { target_system, mission_type: 1, ..MISSION_ITEM_INT_DATA::DEFAULT };
    let request = MISSION_REQUEST_INT_DATA { target_system, mission_type: 1, ..MISSION_REQUEST_INT_DATA::DEFAULT };
    let nothing = MISSION_COUNT_DATA { count: 0, ..upload.clone() };
    let part = MISSION_REQUEST_PARTIAL_LIST_DATA {
        target_system,
        mission_type: 1,
        ..MISSION_REQUEST_PARTIAL_LIST_DATA::DEFAULT
    };
    let clear = MISSION_CLEAR_ALL_DATA { target_system, mission_type: 1, ..MISSION_CLEAR_ALL_DATA::DEFAULT };
    for (answer, result) in [
        (answer(&upload), MavMissionResult::MAV_MISSION_UNSUPPORTED),
        (answer(&item), MavMissionResult::MAV_MISSION_UNSUPPORTED),
        (answer(&part), MavMissionResult::MAV_MISSION_UNSUPPORTED),
        (answer(&nothing), MavMissionResult::MAV_MISSION_ACCEPTED),
        (answer(&request), MavMissionResult::MAV_MISSION_INVALID_SEQUENCE),
        (answer(&clear), MavMissionResult::MAV_MISSION_ACCEPTED),
    ] {
        let MavMessage::MISSION_ACK(ack) = answer else { panic!("{answer:?}") };
        assert_eq!((ack.mavtype, ack.mission_type, ack.target_system), (result as u8, 1, 255));
    }
    let set = answer(&MISSION_SET_CURRENT_DATA { target_system, seq: 2, ..MISSION_SET_CURRENT_DATA::DEFAULT });
    let MavMessage::MISSION_CURRENT(current) = set else { panic!("{set:?}") };
    assert_eq!((current.seq, current.total, current.mission_state), (0, u16::MAX, 1), "there is no mission");
}

#[test]
fn a_request_for_files_is_refused_with_the_next_number_and_its_own_operation() {
    // Operation, then what is answered: operation, size, and error of a refusal.
    for (opcode, expected) in [(4_u8, [129, 1, 10]), (3, [129, 1, 6]), (15, [129, 1, 7]), (2, [128, 0, 0])] {
        let mut request = FILE_TRANSFER_PROTOCOL_DATA { target_system: 1, ..FILE_TRANSFER_PROTOCOL_DATA::DEFAULT };
        request.payload[..4].copy_from_slice(&[0xff, 0x01, 7, opcode]);
        let answer = answer(&request);
        let MavMessage::FILE_TRANSFER_PROTOCOL(answer) = answer else { panic!("{answer:?}") };
        let [low, high, session, operation, size, asked, ..] = answer.payload;
        assert_eq!((u16::from_le_bytes([low, high]), session, asked), (0x200, 7, opcode));
        assert_eq!([operation, size, answer.payload[12]], expected, "operation {opcode}");
        assert_eq!((answer.target_system, answer.target_component), (255, 190));
    }
}

#[test]
fn there_are_no_logs_no_extended_parameters_and_nothing_on_a_console() {
    let (target_system, target_component) = (1, 1);
    let list = LOG_REQUEST_LIST_DATA { target_system, target_component, ..LOG_REQUEST_LIST_DATA::DEFAULT };
    let data = LOG_REQUEST_DATA_DATA { target_system, target_component, ..LOG_REQUEST_DATA_DATA::DEFAULT };
    for answer in [answer(&list), answer(&data)] {
        let MavMessage::LOG_ENTRY(entry) = answer else { panic!("{answer:?}") };
        assert_eq!((entry.num_logs, entry.size), (0, 0));
    }
    let extended = answer(&PARAM_EXT_REQUEST_LIST_DATA { target_system, target_component });
    let MavMessage::PARAM_EXT_VALUE(extended) = extended else { panic!("{extended:?}") };
    assert_eq!(extended.param_count, 0);
    let read =
        PARAM_EXT_REQUEST_READ_DATA { target_system, target_component, param_id: "CAM_MODE".into(), param_index: -1 };
    let MavMessage::PARAM_EXT_VALUE(none) = answer(&read) else { panic!("no PARAM_EXT_VALUE") };
    assert_eq!((none.param_id.to_str(), none.param_count), (Ok("CAM_MODE"), 0));
    let set = PARAM_EXT_SET_DATA {
        target_system,
        target_component,
        param_id: "CAM_MODE".into(),
        param_value: "1".into(),
        param_type: 6,
    };
    let MavMessage::PARAM_EXT_ACK(ack) = answer(&set) else { panic!("no PARAM_EXT_ACK") };
    assert_eq!((ack.param_id.to_str(), ack.param_type, ack.param_result), (Ok("CAM_MODE"), 6, 2), "failed");
    let serial = answer(&SERIAL_CONTROL_DATA { device: 10, flags: 2, ..SERIAL_CONTROL_DATA::DEFAULT });
    let MavMessage::SERIAL_CONTROL(serial) = serial else { panic!("{serial:?}") };
    assert_eq!((serial.device, serial.flags, serial.count), (10, 1, 0));
    let echo = SERIAL_CONTROL_DATA { device: 10, flags: 1, ..SERIAL_CONTROL_DATA::DEFAULT };
    assert!(Bench::silent().job(&frame(&echo)).is_empty(), "an answer is no request");
}
