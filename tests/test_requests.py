"""The requests that ground stations make, none of which is left unanswered, by raw frames.

Among them those of a mission, of files and of logs, which there are none of: refused at once, as clients wait in vain
otherwise.
"""

import math
import struct

import pytest
from pymavlink.dialects.v20 import development as mavlink

from client import a, own, shared  # noqa: F401 (fixtures)
from client import (
    ACCEPTED,
    ARM_DISARM,
    DENIED,
    HOME_DEG,
    NO_COMMAND,
    REQUEST_MESSAGE,
    REQUEST_MS,
    TAKEOFF,
    UNSUPPORTED,
    UNSUPPORTED_MAV_FRAME,
    listen,
    parameter_list,
    wait_any,
)


@pytest.mark.parametrize("mission_type", [0, 1, 2])
def test_there_is_no_plan_and_it_says_so(a, mission_type):
    count = a.ask(
        lambda mav: mav.mission_request_list_send(1, 1, mission_type),
        "MISSION_COUNT",
        lambda count: count.mission_type == mission_type,
    )
    assert (count.count, count.target_system, count.target_component) == (0, a.SYSTEM, a.COMPONENT)


@pytest.mark.parametrize("mission_type", [0, 1, 2, 255])
def test_clearing_a_plan_that_there_is_not_succeeds(a, mission_type):
    ack = a.ask(lambda mav: mav.mission_clear_all_send(1, 1, mission_type), "MISSION_ACK")
    assert (ack.type, ack.mission_type) == (mavlink.MAV_MISSION_ACCEPTED, mission_type)
    assert (ack.target_system, ack.target_component) == (a.SYSTEM, a.COMPONENT)


@pytest.mark.parametrize("mission_type", [0, 1, 2])
def test_a_plan_that_cannot_be_kept_is_refused(a, mission_type):
    ack = a.ask(lambda mav: mav.mission_count_send(1, 1, 3, mission_type), "MISSION_ACK")
    refused = (
        mavlink.MAV_MISSION_ERROR,
        mavlink.MAV_MISSION_UNSUPPORTED,
        mavlink.MAV_MISSION_NO_SPACE,
        mavlink.MAV_MISSION_DENIED,
    )
    assert ack.type in refused and ack.mission_type == mission_type


@pytest.mark.parametrize("request_of", ["mission_request_int_send", "mission_request_send"])
def test_an_item_that_there_is_not_is_refused(a, request_of):
    ack = a.ask(lambda mav: getattr(mav, request_of)(1, 1, 0, 0), "MISSION_ACK")
    assert ack.type != mavlink.MAV_MISSION_ACCEPTED


def test_an_item_that_there_is_not_cannot_be_flown(a):
    a.catch_up()
    a.mav.mission_set_current_send(1, 1, 3)
    wait_any(
        a,
        {
            "MISSION_ACK": lambda ack: ack.type != mavlink.MAV_MISSION_ACCEPTED,
            "MISSION_CURRENT": lambda current: current.seq != 3,
            "STATUSTEXT": lambda text: "ission" in text.text,
        },
    )


FTP_HEADER = "<HBBBBBBI"
FTP_TERMINATE, FTP_RESET, FTP_LIST, FTP_OPEN, FTP_READ, FTP_CREATE, FTP_WRITE, FTP_REMOVE, FTP_CRC, FTP_BURST = (
    1, 2, 3, 4, 5, 6, 7, 8, 14, 15
)  # fmt: skip
FTP_ACK, FTP_NAK = 128, 129
FTP_OF_FILES = [FTP_LIST, FTP_OPEN, FTP_READ, FTP_CREATE, FTP_WRITE, FTP_REMOVE, FTP_CRC, FTP_BURST]


def ftp(client, sequence, opcode, data=b"", target=1):
    """The answer to a file transfer request: sequence, session, opcode, size, request's opcode, data."""
    header = struct.pack(FTP_HEADER, sequence, 0, opcode, len(data), 0, 0, 0, 0)
    payload = list((header + data).ljust(251, b"\0"))
    reply = client.ask(lambda mav: mav.file_transfer_protocol_send(0, 1, target, payload), "FILE_TRANSFER_PROTOCOL")
    assert (reply.target_system, reply.target_component) == (client.SYSTEM, client.COMPONENT)
    content = bytes(reply.payload)
    number, session, kind, size, of, _, _, _ = struct.unpack_from(FTP_HEADER, content)
    return number, session, kind, size, of, content[12 : 12 + size]


@pytest.mark.parametrize("opcode", FTP_OF_FILES)
@pytest.mark.parametrize("sequence", [7, 65_535])
def test_a_file_that_there_is_not_is_refused(a, opcode, sequence):
    number, _, kind, size, of, data = ftp(a, sequence, opcode, b"@PARAM/param.pck?withdefaults=1")
    assert (number, kind, of) == ((sequence + 1) % 65_536, FTP_NAK, opcode)
    assert size >= 1 and data[0] != 0, "a NAK says why"


@pytest.mark.parametrize("opcode", [FTP_TERMINATE, FTP_RESET])
def test_ending_a_file_transfer_is_answered(a, opcode):
    number, _, kind, _, of, _ = ftp(a, 100, opcode)
    assert number == 101 and kind in (FTP_ACK, FTP_NAK) and of == opcode


def test_there_is_no_log_and_it_says_so(a):
    entry = a.ask(lambda mav: mav.log_request_list_send(1, 1, 0, 0xFFFF), "LOG_ENTRY")
    assert (entry.num_logs, entry.size) == (0, 0)


def test_a_log_that_there_is_not_is_refused(a):
    a.catch_up()
    a.mav.log_request_data_send(1, 1, 0, 0, 90)
    wait_any(a, {"LOG_DATA": lambda data: data.count == 0, "LOG_ENTRY": lambda entry: entry.num_logs == 0})


def test_a_ping_is_returned(a):
    ping = a.ask(lambda mav: mav.ping_send(123_456_789, 42, 0, 0), "PING", lambda ping: ping.target_system != 0)
    assert (ping.time_usec, ping.seq) == (123_456_789, 42)
    assert (ping.target_system, ping.target_component) == (a.SYSTEM, a.COMPONENT)


def test_a_list_of_extended_parameters_is_refused(a):
    a.catch_up()
    a.mav.param_ext_request_list_send(1, 1)
    wait_any(a, {"PARAM_EXT_VALUE": lambda value: value.param_count == 0, "PARAM_ERROR": lambda error: error.error > 0})


@pytest.mark.parametrize("form", ["command_long", "command_int"])
@pytest.mark.parametrize("command", [NO_COMMAND, mavlink.MAV_CMD_IMAGE_START_CAPTURE, mavlink.MAV_CMD_DO_SET_SERVO])
def test_an_unknown_command_is_refused(a, form, command):
    a.catch_up()
    getattr(a, form)(command, math.nan)
    assert a.ack(command) == UNSUPPORTED


@pytest.mark.parametrize("frame", [200, 255])
def test_a_frame_that_makes_no_sense_is_refused(a, frame):
    a.catch_up()
    a.mav.command_int_send(1, 1, frame, TAKEOFF, 0, 0, 0, 0, 0, math.nan, 0, 0, 5)
    assert a.ack(TAKEOFF) == UNSUPPORTED_MAV_FRAME


def test_home_is_told_on_request_and_by_itself(a):
    a.catch_up()
    a.command_long(mavlink.MAV_CMD_GET_HOME_POSITION)
    answers = {m.get_type(): m for m in listen(a, [], 400)[a]}
    assert answers["COMMAND_ACK"].result == ACCEPTED
    home = answers["HOME_POSITION"]
    assert abs(home.latitude / 1e7 - HOME_DEG[0]) < 1e-3 and abs(home.longitude / 1e7 - HOME_DEG[1]) < 1e-3
    # Nobody asks for it in QGroundControl.
    a.wait("HOME_POSITION", within_ms=5_000)


def test_home_can_be_set(own):
    a = own
    set_home = mavlink.MAV_CMD_DO_SET_HOME
    a.wait("HOME_POSITION", within_ms=5_000)
    latitude = int((HOME_DEG[0] + 1e-4) * 1e7)
    for result, x, y in [
        (DENIED, int(95e7), int(8e7)),
        (DENIED, int(47e7), int(-181e7)),
        (ACCEPTED, latitude, int(HOME_DEG[1] * 1e7)),
    ]:
        a.catch_up()
        a.mav.command_int_send(1, 1, mavlink.MAV_FRAME_GLOBAL, set_home, 0, 0, 0, 0, 0, math.nan, x, y, 488)
        assert a.ack(set_home) == result, (x, y)
    a.wait("HOME_POSITION", lambda home: abs(home.latitude - latitude) <= 10, within_ms=5_000)
    # Where it is now.
    assert a.command(set_home, 1) == ACCEPTED
    a.wait("HOME_POSITION", lambda home: abs(home.latitude - HOME_DEG[0] * 1e7) < 300, within_ms=5_000)


def mode_of(heartbeat):
    return heartbeat.custom_mode >> 16 & 0xFF, heartbeat.custom_mode >> 24


def test_old_mode_messages_are_obeyed_and_seen_at_once(own):
    """QGroundControl changes modes by SET_MODE, and tries three times within 1.3 s to see the new one."""
    assert own.command(ARM_DISARM, 1) == ACCEPTED
    own.wait("HEARTBEAT", lambda heartbeat: heartbeat.base_mode & mavlink.MAV_MODE_FLAG_SAFETY_ARMED)
    assert own.command(TAKEOFF, *[0] * 6, 3) == ACCEPTED
    own.wait("EXTENDED_SYS_STATE", lambda state: state.landed_state == mavlink.MAV_LANDED_STATE_IN_AIR)
    own.wait("HEARTBEAT", lambda heartbeat: mode_of(heartbeat) == (4, 3))
    custom = mavlink.MAV_MODE_FLAG_CUSTOM_MODE_ENABLED
    for sub in (5, 3, 6):
        own.heartbeat()
        own.catch_up()
        own.mav.set_mode_send(1, custom | mavlink.MAV_MODE_FLAG_SAFETY_ARMED, 4 << 16 | sub << 24)
        own.wait("HEARTBEAT", lambda heartbeat: mode_of(heartbeat) == (4, sub), within_ms=1_300)
    own.wait("HEARTBEAT", lambda heartbeat: not heartbeat.base_mode & mavlink.MAV_MODE_FLAG_SAFETY_ARMED)


# Of COMPONENT_INFORMATION and COMPONENT_METADATA, which pymavlink 2.4.50 does not have, only the number is needed.
AVAILABLE_MODES, COMPONENT_INFORMATION, COMPONENT_METADATA, PROTOCOL_VERSION = 435, 395, 397, 300


def request_message(client, kind, param2=0.0):
    client.catch_up()
    client.command_long(REQUEST_MESSAGE, kind, param2)
    return client.ack(REQUEST_MESSAGE, REQUEST_MS)


def test_a_ground_station_connects_as_qgroundcontrol_does(own):
    """Its requests in their order, each answered within a second; it gives up on each after that or a few more."""
    a = own
    a.heartbeat()
    heartbeat = a.wait("HEARTBEAT", within_ms=2_000)
    assert (heartbeat.type, heartbeat.autopilot) == (mavlink.MAV_TYPE_QUADROTOR, mavlink.MAV_AUTOPILOT_PX4)

    assert request_message(a, mavlink.MAVLINK_MSG_ID_AUTOPILOT_VERSION) == ACCEPTED
    version = a.wait("AUTOPILOT_VERSION", within_ms=REQUEST_MS)
    assert version.flight_sw_version >= 0x0104_0100, "older versions of PX4 are warned of"
    capability = mavlink.MAV_PROTOCOL_CAPABILITY_PARAM_ENCODE_BYTEWISE
    assert version.capabilities & capability and version.capabilities & mavlink.MAV_PROTOCOL_CAPABILITY_COMMAND_INT

    check_modes(a)
    for kind in (COMPONENT_METADATA, COMPONENT_INFORMATION):
        assert request_message(a, kind) == UNSUPPORTED
    error = a.ask(lambda mav: mav.param_request_read_send(1, 1, b"_HASH_CHECK", -1), "PARAM_ERROR")
    assert error.param_id == "_HASH_CHECK"
    assert len(parameter_list(a)) >= 50
    for mission_type in (0, 1, 2):
        a.ask(lambda mav: mav.mission_request_list_send(1, 1, mission_type), "MISSION_COUNT", lambda m: m.count == 0)
        a.mav.mission_ack_send(1, 1, mavlink.MAV_MISSION_ACCEPTED, mission_type)
    a.wait("HOME_POSITION", within_ms=5_000)
    for kind in MAP:
        a.wait(kind, within_ms=3_000)
    assert a.command(NO_COMMAND) == UNSUPPORTED


# What its map, its instruments and its status bar show.
MAP = """GLOBAL_POSITION_INT GPS_RAW_INT ATTITUDE ATTITUDE_QUATERNION VFR_HUD ALTITUDE SYS_STATUS BATTERY_STATUS
EXTENDED_SYS_STATE VIBRATION ESTIMATOR_STATUS SYSTEM_TIME WIND_COV SERVO_OUTPUT_RAW""".split()


def check_modes(client):
    """All modes on one request, the last one last; without these five the buttons of flight go."""
    client.catch_up()
    client.command_long(REQUEST_MESSAGE, AVAILABLE_MODES, 0)
    modes = [client.wait("AVAILABLE_MODES", within_ms=REQUEST_MS)]
    while modes[-1].mode_index != modes[-1].number_modes:
        modes.append(client.wait("AVAILABLE_MODES", within_ms=REQUEST_MS))
    assert [mode.mode_index for mode in modes] == list(range(1, modes[0].number_modes + 1))
    flown = {(mode.custom_mode >> 16 & 0xFF, mode.custom_mode >> 24) for mode in modes}
    assert {(4, 2), (4, 3), (4, 4), (4, 5), (4, 6)} <= flown, flown
    assert all(mode.mode_name for mode in modes)


def test_what_is_newer_than_the_client_does_not_end_it(a):
    """pymavlink 2.4.50 knows no PROTOCOL_VERSION: it comes as a message without a name."""
    assert request_message(a, PROTOCOL_VERSION) == ACCEPTED
    a.wait("UNKNOWN_300", within_ms=REQUEST_MS)
