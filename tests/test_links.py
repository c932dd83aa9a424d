"""Several ground stations on one vehicle, and the requests that they make, by raw frames.

Station A is a peer that `serve` was told of; B is a guest, known only because it has sent something. What is measured in
time is measured in the vehicle's own time stamps as A hears them.
"""

import itertools
import math
import select
import socket
import struct
import threading
import time

import pytest
from pymavlink.dialects.v20 import development as mavlink

from conftest import HANG_S, PREARM_CHECK, Simulator, Station

ACCEPTED = mavlink.MAV_RESULT_ACCEPTED
DENIED = mavlink.MAV_RESULT_DENIED
UNSUPPORTED = mavlink.MAV_RESULT_UNSUPPORTED
# Newer than pymavlink 2.4.50: MAV_RESULT_COMMAND_UNSUPPORTED_MAV_FRAME.
UNSUPPORTED_MAV_FRAME = 9
REQUEST_MESSAGE = mavlink.MAV_CMD_REQUEST_MESSAGE
SET_MESSAGE_INTERVAL = mavlink.MAV_CMD_SET_MESSAGE_INTERVAL
ARM_DISARM = mavlink.MAV_CMD_COMPONENT_ARM_DISARM
TAKEOFF = mavlink.MAV_CMD_NAV_TAKEOFF
# A command that nobody has: its answer shows that the link is alive and costs the vehicle nothing else.
NO_COMMAND = 65_535
# What clients wait before they repeat a command, and before QGroundControl gives up on a request, ms.
COMMAND_MS, REQUEST_MS = 500, 1_000


class Client(Station):
    """A ground station that also knows messages still in development, and is a component of its own."""

    def __init__(self, vehicle=None, component=Station.COMPONENT):
        super().__init__()
        self.COMPONENT = component
        self.mav = mavlink.MAVLink(self, srcSystem=self.SYSTEM, srcComponent=component)
        self.vehicle = vehicle

    def heartbeat(self):
        self.mav.heartbeat_send(mavlink.MAV_TYPE_GCS, mavlink.MAV_AUTOPILOT_INVALID, 0, 0, 0)

    def frame(self, message, system=None, component=None):
        """A message's bytes, as this client or anyone else would send it."""
        sender = mavlink.MAVLink(None, srcSystem=system or self.SYSTEM, srcComponent=component or self.COMPONENT)
        return message.pack(sender)

    def pending(self):
        return bool(self.heard) or bool(select.select([self.socket], [], [], 0)[0])

    def catch_up(self):
        """All that has arrived by now, so that what follows is the answer to what is sent next."""
        heard = []
        while self.pending():
            heard.append(self.next())
        return heard

    def ask(self, send, kind, condition=lambda message: True, within_ms=REQUEST_MS):
        """Sends something and returns the first message that answers it."""
        self.catch_up()
        send(self.mav)
        return self.wait(kind, condition, within_ms)

    def command(self, command, *params, within_ms=COMMAND_MS, **how):
        """The result of a command that is sent once all that was heard before is out of the way."""
        self.catch_up()
        self.command_long(command, *params, **how)
        return self.ack(command, within_ms)

    def tell_interval(self, kind, interval_us):
        assert self.command(SET_MESSAGE_INTERVAL, kind, interval_us) == ACCEPTED


def listen(clock, others, duration_ms):
    """What each station hears, as a list each, while that much time passes on the vehicle by the first one's account."""
    stations = [clock, *others]
    heard = {station: station.catch_up() for station in stations}
    if clock.now_ms is None:
        heard[clock].append(clock.wait("LOCAL_POSITION_NED"))
    end, hang = clock.now_ms + duration_ms, time.monotonic() + HANG_S
    while clock.now_ms < end:
        assert time.monotonic() < hang, "the vehicle has fallen silent"
        select.select([station.socket for station in stations], [], [], 1)
        for station in stations:
            heard[station] += station.catch_up()
    return heard


def kinds(messages):
    return [message.get_type() for message in messages]


def assert_no_gap(messages, least=20):
    """One counter a link and component, which skips no number."""
    by_sender = {}
    for message in messages:
        by_sender.setdefault((message.get_srcSystem(), message.get_srcComponent()), []).append(message.get_seq())
    assert (1, 1) in by_sender and len(by_sender[1, 1]) >= least, by_sender.keys()
    for sender, numbers in by_sender.items():
        gaps = [(a, b) for a, b in zip(numbers, numbers[1:]) if (b - a) % 256 != 1]
        assert not gaps, (sender, gaps)


class Sender:
    """Datagrams from an address of its own, at a rate, until told to stop."""

    def __init__(self, vehicle, datagrams, rate_hz):
        self.socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self.socket.bind(("127.0.0.1", 0))
        self.vehicle, self.datagrams, self.rate_hz, self.sent = vehicle, itertools.cycle(datagrams), rate_hz, 0
        self.ended = threading.Event()
        self.thread = threading.Thread(target=self.run, daemon=True)

    def run(self):
        start = time.monotonic()
        while not self.ended.wait(0.01):
            due = 1 + int((time.monotonic() - start) * self.rate_hz)
            # What a busy machine has kept it from sending in a while is not made up for all at once.
            for _ in range(min(due - self.sent, 1 + self.rate_hz // 20)):
                self.socket.sendto(next(self.datagrams), self.vehicle)
            self.sent = due

    def __enter__(self):
        self.thread.start()
        return self

    def __exit__(self, *_):
        self.ended.set()
        self.thread.join()
        self.socket.close()


def serve(*arguments, speed="1"):
    """A vehicle ready to be armed, and the station that is its peer."""
    station = Client()
    simulator = Simulator(station, "--speed", speed, *arguments)
    while not select.select([station.socket], [], [], 0.1)[0]:
        if not simulator.is_running():
            station.close()
            pytest.fail(simulator.process.communicate()[1])
    station.wait("SYS_STATUS", lambda status: status.onboard_control_sensors_health & PREARM_CHECK, within_ms=10_000)
    station.heartbeat()
    return simulator, station


def stop(simulator, station):
    running = simulator.is_running()
    simulator.stop()
    station.close()
    assert running, "the simulator ended by itself"


@pytest.fixture(scope="module")
def shared(simulator_path):
    simulator, station = serve()
    yield station
    stop(simulator, station)


@pytest.fixture(scope="module")
def guest_of(shared):
    guest = Client(shared.vehicle, component=191)
    guest.heartbeat()
    guest.wait("HEARTBEAT")
    yield guest
    guest.close()


@pytest.fixture
def a(shared):
    """The peer, with its default rates."""
    shared.heartbeat()
    shared.catch_up()
    yield shared


@pytest.fixture
def b(guest_of):
    """The guest, which has not been silent for so long that it is forgotten."""
    guest_of.heartbeat()
    guest_of.wait("LOCAL_POSITION_NED")
    guest_of.catch_up()
    yield guest_of


@pytest.fixture
def own(simulator_path):
    """A vehicle of one test's own, at four times real time, and its peer."""
    simulator, station = serve(speed="4")
    yield station
    stop(simulator, station)


# ------------------------------------------------------------------------------------------------ two at once


def test_neither_of_two_stations_misses_a_frame(own):
    guest = Client(own.vehicle, component=191)
    try:
        guest.heartbeat()
        guest.wait("LOCAL_POSITION_NED")
        own.catch_up(), guest.catch_up()
        for station in (own, guest):
            station.command_long(REQUEST_MESSAGE, mavlink.MAVLINK_MSG_ID_AUTOPILOT_VERSION)
        heard = listen(own, [guest], 10_000)
        for station in (own, guest):
            assert_no_gap(heard[station], least=400)
            assert "COMMAND_ACK" in kinds(heard[station]) and "AUTOPILOT_VERSION" in kinds(heard[station])
    finally:
        guest.close()


def test_an_answer_goes_to_the_one_who_asked_only(a, b):
    a.command_long(NO_COMMAND)
    a.mav.timesync_send(0, 123)
    a.mav.param_request_read_send(1, 1, b"MIS_TAKEOFF_ALT", -1)
    heard = listen(a, [b], 1_000)
    mine = kinds(heard[a])
    assert {"COMMAND_ACK", "TIMESYNC", "PARAM_VALUE"} <= set(mine), set(mine)
    # The vehicle may ask everyone for the time, but answers one.
    theirs = kinds(m for m in heard[b] if m.get_type() != "TIMESYNC" or m.ts1 == 123)
    assert "LOCAL_POSITION_NED" in theirs
    assert not {"COMMAND_ACK", "TIMESYNC", "PARAM_VALUE"} & set(theirs)


def test_rates_belong_to_a_link(a, b):
    b.tell_interval(mavlink.MAVLINK_MSG_ID_ATTITUDE, -1)
    a.tell_interval(mavlink.MAVLINK_MSG_ID_LOCAL_POSITION_NED, 20_000)
    listen(a, [b], 200)
    heard = listen(a, [b], 2_000)
    b.tell_interval(mavlink.MAVLINK_MSG_ID_ATTITUDE, 0)
    a.tell_interval(mavlink.MAVLINK_MSG_ID_LOCAL_POSITION_NED, 0)
    b.wait("ATTITUDE", within_ms=500)
    assert kinds(heard[b]).count("ATTITUDE") == 0
    assert kinds(heard[a]).count("ATTITUDE") >= 30
    times = {s: [m.time_boot_ms for m in heard[s] if m.get_type() == "LOCAL_POSITION_NED"] for s in (a, b)}
    gaps = {s: min(q - p for p, q in zip(t, t[1:])) for s, t in times.items()}
    assert gaps[a] < gaps[b], gaps


def test_a_default_rate_asked_for_again_changes_nothing(a):
    def times(heard):
        return [m.time_boot_ms for m in heard[a] if m.get_type() == "ATTITUDE"]

    before = times(listen(a, [], 1_000))
    for _ in range(10):
        a.command_long(SET_MESSAGE_INTERVAL, mavlink.MAVLINK_MSG_ID_ATTITUDE, 0)
    after = times(listen(a, [], 1_000))
    assert abs(len(before) - len(after)) <= 1, (before, after)


def test_a_rate_is_forgotten_with_the_one_who_asked(own):
    """Twelve seconds after its last word a guest is gone; who then comes from the same port is new."""
    guest = Client(own.vehicle, component=191)
    try:
        guest.heartbeat()
        guest.wait("ATTITUDE")
        guest.tell_interval(mavlink.MAVLINK_MSG_ID_ATTITUDE, -1)
        listen(own, [guest], 15_000)
        guest.catch_up()
        # The wall clock decides who is gone.
        hang = time.monotonic() + HANG_S
        while kinds(listen(own, [guest], 1_000)[guest]):
            assert time.monotonic() < hang, "a silent guest is served for ever"
        guest.heartbeat()
        guest.wait("ATTITUDE", within_ms=2_000)
    finally:
        guest.close()


# ----------------------------------------------------------------------------------------- one disturbs the other


def foreign(message, system, component=1):
    return message.pack(mavlink.MAVLink(None, srcSystem=system, srcComponent=component))


ATTITUDE = mavlink.MAVLink_attitude_message(1, 0.1, 0.2, 0.3, 0.1, 0.2, 0.3)
POSITION = mavlink.MAVLink_global_position_int_message(1, 473_977_000, 85_456_000, 488_000, 0, 0, 0, 0, 0)
GCS = mavlink.MAVLink_heartbeat_message(mavlink.MAV_TYPE_GCS, mavlink.MAV_AUTOPILOT_INVALID, 0, 0, 0, 3)
# A message that a quadrotor has no use for, whose payload looks like the beginning of frames.
STRANGER = mavlink.MAVLink_v2_extension_message(0, 0, 0, 1, [0xFD, 9, 0, 0] * 62 + [0])
COMMAND = mavlink.MAVLink_command_long_message(1, 1, NO_COMMAND, 0, 0, 0, 0, 0, 0, 0, 0)
FLOODS = {
    "a silent one": ([foreign(GCS, 254, 190)], 1),
    "one with telemetry of its own": ([foreign(ATTITUDE, 254, 190), foreign(POSITION, 254, 190)], 2_000),
    "one that returns the vehicle's": ([foreign(ATTITUDE, 1), foreign(POSITION, 1)], 2_000),
    "one that forwards others'": ([foreign(GCS, 3), foreign(ATTITUDE, 3), foreign(POSITION, 4)], 2_000),
    "messages unknown to the vehicle": ([foreign(STRANGER, 254, 190)], 1_000),
    "large datagrams": ([foreign(ATTITUDE, 2) * 30], 200),
    "commands for others": ([foreign(mavlink.MAVLink_command_long_message(7, 1, 400, 0, *[1] * 7), 254, 190)], 2_000),
    "junk": ([bytes([0xFD, 255, 0, 0] * 20), b"\xfe\xff" * 50, bytes(range(256)), b"\x00"], 1_000),
    "half frames": ([foreign(COMMAND, 254, 190)[:n] for n in range(1, 40)], 1_000),
}


@pytest.mark.parametrize("flood", FLOODS)
def test_what_one_does_keeps_no_other_waiting(a, flood):
    with Sender(a.vehicle, *FLOODS[flood]) as sender:
        listen(a, [], 300)
        heard = []
        for _ in range(4):
            heard += a.catch_up()
            before = a.now_ms
            a.command_long(NO_COMMAND)
            while True:
                heard.append(a.next())
                if heard[-1].get_type() == "COMMAND_ACK":
                    assert (heard[-1].command, heard[-1].result) == (NO_COMMAND, UNSUPPORTED)
                    break
                assert a.now_ms - before <= COMMAND_MS, "the answer has not come in time"
        heard += listen(a, [], 200)[a]
        assert sender.sent > 0
    assert_no_gap(heard)
    assert not any(m.base_mode & mavlink.MAV_MODE_FLAG_SAFETY_ARMED for m in heard if m.get_type() == "HEARTBEAT")


def test_a_junk_byte_earns_no_telemetry(a):
    guest = Client(a.vehicle, component=192)
    try:
        guest.write(b"\xfd")
        assert not listen(a, [guest], 1_500)[guest]
        # It is heard all the same, once it says something sensible.
        guest.heartbeat()
        assert "LOCAL_POSITION_NED" in kinds(listen(a, [guest], 1_000)[guest])
    finally:
        guest.close()


def test_sixteen_senders_of_junk_keep_nobody_out(a):
    crowd = [Client(a.vehicle) for _ in range(16)]
    client = Client(a.vehicle, component=193)
    try:
        for one in crowd:
            one.write(b"\x55")
        listen(a, [], 100)
        client.heartbeat()
        client.command_long(NO_COMMAND)
        heard = listen(a, [client], 1_000)[client]
        assert "COMMAND_ACK" in kinds(heard) and "LOCAL_POSITION_NED" in kinds(heard)
    finally:
        for one in [*crowd, client]:
            one.close()


def test_half_a_datagram_swallows_nobody_elses_command(a):
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as other:
        for cut in (1, 5, 10, 20, 40):
            a.catch_up()
            other.sendto(foreign(COMMAND, 254, 190)[:cut], a.vehicle)
            a.command_long(NO_COMMAND)
            assert a.ack(NO_COMMAND, COMMAND_MS) == UNSUPPORTED, cut


def test_the_end_of_a_datagram_ends_a_frame(a):
    whole = a.frame(COMMAND)
    for cut in (1, 5, 10, 20, 40):
        a.catch_up()
        a.write(whole[:cut])
        a.write(whole)
        assert a.ack(NO_COMMAND, COMMAND_MS) == UNSUPPORTED, cut


@pytest.mark.parametrize("before", [60, 250])
def test_a_large_datagram_arrives_whole(a, before):
    datagram = a.frame(ATTITUDE) * before + a.frame(COMMAND)
    assert len(datagram) > 2_048
    a.catch_up()
    a.write(datagram)
    assert a.ack(NO_COMMAND, COMMAND_MS) == UNSUPPORTED


@pytest.mark.parametrize("together", [False, True])
def test_each_of_a_burst_of_requests_is_answered(a, together):
    wanted = [mavlink.MAVLINK_MSG_ID_AUTOPILOT_VERSION, mavlink.MAVLINK_MSG_ID_EXTENDED_SYS_STATE] * 10
    nothing = [0.0] * 6
    frames = [
        a.frame(mavlink.MAVLink_command_long_message(1, 1, REQUEST_MESSAGE, 0, kind, *nothing)) for kind in wanted
    ]
    for datagram in [b"".join(frames)] if together else frames:
        a.write(datagram)
    heard = listen(a, [], 2_000)[a]
    acks = [m.result for m in heard if m.get_type() == "COMMAND_ACK" and m.command == REQUEST_MESSAGE]
    assert acks == [ACCEPTED] * 20
    assert kinds(heard).count("AUTOPILOT_VERSION") == 10


def test_each_of_a_burst_of_commands_is_answered(a):
    """Some of them are the commander's, which has places for four: the rest is told so, not dropped."""
    commands = [ARM_DISARM] * 8
    for command in commands:
        a.command_long(command, 0)
    heard = listen(a, [], 1_000)[a]
    results = [m.result for m in heard if m.get_type() == "COMMAND_ACK" and m.command == ARM_DISARM]
    assert len(results) == 8, results
    assert results.count(ACCEPTED) >= 4, results


def test_a_command_is_answered_while_parameters_stream(a):
    a.catch_up()
    a.mav.param_request_list_send(1, 1)
    first = a.wait("PARAM_VALUE", within_ms=REQUEST_MS)
    assert a.command(NO_COMMAND) == UNSUPPORTED
    if first.param_count > 1:
        a.wait("PARAM_VALUE", lambda value: value.param_index == value.param_count - 1)


# ------------------------------------------------------------------- requests, of which none is left unanswered


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


def wait_any(client, accepted, within_ms=REQUEST_MS):
    """The first message of several kinds, each with a condition of its own."""
    start = client.now_ms
    while True:
        message = client.next()
        condition = accepted.get(message.get_type())
        if condition and condition(message):
            return message
        if client.now_ms - start > within_ms:
            pytest.fail(f"none of {list(accepted)} within {within_ms} ms of simulated time")


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


def ftp(client, sequence, opcode, data=b"", target=1):
    """The answer to a file transfer request: sequence, session, opcode, size, request's opcode, data."""
    header = struct.pack(FTP_HEADER, sequence, 0, opcode, len(data), 0, 0, 0, 0)
    payload = list((header + data).ljust(251, b"\0"))
    reply = client.ask(lambda mav: mav.file_transfer_protocol_send(0, 1, target, payload), "FILE_TRANSFER_PROTOCOL")
    assert (reply.target_system, reply.target_component) == (client.SYSTEM, client.COMPONENT)
    content = bytes(reply.payload)
    number, session, kind, size, of, _, _, _ = struct.unpack_from(FTP_HEADER, content)
    return number, session, kind, size, of, content[12 : 12 + size]


@pytest.mark.parametrize("opcode", [FTP_LIST, FTP_OPEN, FTP_READ, FTP_CREATE, FTP_WRITE, FTP_REMOVE, FTP_CRC, FTP_BURST])
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
    wait_any(a, {"PARAM_EXT_VALUE": lambda value: value.param_count == 0, "PARAM_ERROR": lambda error: error.error != 0})


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


# The place of the scenario `field`: latitude and longitude, degrees.
HOME_DEG = (47.3977, 8.5456)


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


# --------------------------------------------------------------------------------------------------- parameters


def code(value, kind):
    """A value in the float field: whole numbers by their bits."""
    if kind == mavlink.MAV_PARAM_TYPE_REAL32:
        return value
    return struct.unpack("<f", struct.pack("<i", value))[0]


def decode(message):
    """The value of a PARAM_VALUE. Its bits are taken from the frame, as Python changes some that are no numbers."""
    if message.param_type == mavlink.MAV_PARAM_TYPE_REAL32:
        return message.param_value
    start = 10 if message.get_msgbuf()[0] == 0xFD else 6
    raw = bytes(message.get_msgbuf())[start : start + 4]
    return struct.unpack("<i", raw)[0]


def parameter_list(client):
    """All parameters in the order in which they come, by PARAM_REQUEST_LIST alone."""
    client.catch_up()
    client.mav.param_request_list_send(1, 1)
    values = [client.wait("PARAM_VALUE", within_ms=REQUEST_MS)]
    # A station that hears nothing for so long asks for what is missing.
    while values[-1].param_index != values[-1].param_count - 1:
        values.append(client.wait("PARAM_VALUE", within_ms=REQUEST_MS))
    return values


def read(client, name):
    return client.ask(
        lambda mav: mav.param_request_read_send(1, 1, name.encode(), -1),
        "PARAM_VALUE",
        lambda value: value.param_id == name,
    )


def write(client, name, coded, kind):
    """Asks for a value; what the vehicle then says it is, and the errors it names."""
    client.catch_up()
    client.mav.param_set_send(1, 1, name.encode(), coded, kind)
    heard = listen(client, [], 400)[client]
    values = [m for m in heard if m.get_type() == "PARAM_VALUE" and m.param_id == name]
    errors = [m for m in heard if m.get_type() == "PARAM_ERROR" and m.param_id == name]
    assert values, "the value is echoed"
    return values[-1], errors


def test_the_list_of_parameters_is_complete_and_always_the_same(a):
    values = parameter_list(a)
    count = values[0].param_count
    # The gains, the modes, the airframe, the estimator: it cannot be few.
    assert count >= 50
    assert [value.param_count for value in values] == [count] * count
    assert [value.param_index for value in values] == list(range(count))
    names = [value.param_id for value in values]
    assert len(set(names)) == count and all(0 < len(name) <= 16 for name in names)
    assert [value.param_id for value in parameter_list(a)] == names
    assert all(math.isfinite(decode(value)) for value in values)


# Without these QGroundControl's set-up pages show an error, or it takes the vehicle for one that was never configured.
QGROUNDCONTROL = """SYS_AUTOSTART SYS_AUTOCONFIG MAV_SYS_ID CAL_GYRO0_ID CAL_ACC0_ID CAL_MAG0_ID CAL_MAG1_ID CAL_MAG2_ID
COM_RC_IN_MODE RC_MAP_ROLL RC_MAP_PITCH RC_MAP_YAW RC_MAP_THROTTLE COM_FLTMODE1 COM_FLTMODE2 COM_FLTMODE3 COM_FLTMODE4
COM_FLTMODE5 COM_FLTMODE6 BAT1_SOURCE BAT1_N_CELLS RTL_LAND_DELAY RTL_DESCEND_ALT RTL_RETURN_ALT NAV_DLL_ACT NAV_RCL_ACT
NAV_ACC_RAD COM_RC_LOSS_T COM_DL_LOSS_T COM_LOW_BAT_ACT""".split()


def test_the_parameters_that_clients_look_for_exist(a):
    names = {value.param_id for value in parameter_list(a)}
    missing = [name for name in [*QGROUNDCONTROL, "MIS_TAKEOFF_ALT"] if name not in names]
    assert not missing, missing


def test_a_parameter_is_read_by_name_and_by_index(a):
    by_name = read(a, "MIS_TAKEOFF_ALT")
    by_index = a.ask(lambda mav: mav.param_request_read_send(1, 1, b"", by_name.param_index), "PARAM_VALUE")
    assert by_index.param_id == "MIS_TAKEOFF_ALT"
    assert (by_index.param_value, by_index.param_count) == (by_name.param_value, by_name.param_count)
    assert decode(read(a, "MAV_SYS_ID")) == 1


@pytest.mark.parametrize("name, index", [("NO_SUCH_NAME", -1), ("_HASH_CHECK", -1), ("", 32_000)])
def test_a_parameter_that_there_is_not_is_an_error(a, name, index):
    error = a.ask(lambda mav: mav.param_request_read_send(1, 1, name.encode(), index), "PARAM_ERROR")
    assert error.error == mavlink.MAV_PARAM_ERROR_DOES_NOT_EXIST
    assert (error.target_system, error.target_component) == (a.SYSTEM, a.COMPONENT)


def test_writing_a_parameter_that_there_is_not_is_an_error(a):
    real = mavlink.MAV_PARAM_TYPE_REAL32
    error = a.ask(lambda mav: mav.param_set_send(1, 1, b"NO_SUCH_NAME", 1.0, real), "PARAM_ERROR")
    assert error.error == mavlink.MAV_PARAM_ERROR_DOES_NOT_EXIST


def test_a_parameter_can_be_written(a):
    before = read(a, "MIS_TAKEOFF_ALT")
    for height in (before.param_value + 1, before.param_value):
        value, errors = write(a, "MIS_TAKEOFF_ALT", height, before.param_type)
        assert value.param_value == height and not errors
        assert read(a, "MIS_TAKEOFF_ALT").param_value == height


@pytest.mark.parametrize("bad", [1e9, -1e9, math.nan, math.inf])
def test_a_value_out_of_range_is_refused(a, bad):
    before = read(a, "MIS_TAKEOFF_ALT")
    value, errors = write(a, "MIS_TAKEOFF_ALT", bad, before.param_type)
    assert value.param_value == before.param_value
    assert [error.error for error in errors] == [mavlink.MAV_PARAM_ERROR_VALUE_OUT_OF_RANGE]


@pytest.mark.parametrize("bad", [-1, 256, 2**31 - 1])
def test_a_whole_number_out_of_range_is_refused(a, bad):
    before = read(a, "MAV_SYS_ID")
    value, errors = write(a, "MAV_SYS_ID", code(bad, before.param_type), before.param_type)
    assert decode(value) == decode(before) == 1
    assert [error.error for error in errors] == [mavlink.MAV_PARAM_ERROR_VALUE_OUT_OF_RANGE]


@pytest.mark.parametrize("name, coded, kind", [
    ("MIS_TAKEOFF_ALT", code(5, mavlink.MAV_PARAM_TYPE_INT32), mavlink.MAV_PARAM_TYPE_INT32),
    ("MAV_SYS_ID", 2.0, mavlink.MAV_PARAM_TYPE_REAL32),
])  # fmt: skip
def test_a_value_of_another_type_is_refused(a, name, coded, kind):
    before = read(a, name)
    assert before.param_type != kind
    value, errors = write(a, name, coded, kind)
    assert (decode(value), value.param_type) == (decode(before), before.param_type)
    assert errors and errors[0].error != mavlink.MAV_PARAM_ERROR_NO_ERROR


def test_a_parameter_is_kept_across_restarts(simulator_path, tmp_path):
    # The stored set begins empty, is made by the first start, and read by the second.
    arguments = ("--params", str(tmp_path / "params.bin"))
    chosen = None
    for _ in range(2):
        simulator, station = serve(*arguments, speed="5")
        try:
            value = read(station, "MIS_TAKEOFF_ALT")
            if chosen is None:
                chosen = value.param_value + 1.5
                value, errors = write(station, "MIS_TAKEOFF_ALT", chosen, value.param_type)
                assert not errors
            assert value.param_value == chosen
            listen(station, [], 2_000)
        finally:
            stop(simulator, station)
    # Another file, another set.
    simulator, station = serve("--params", str(tmp_path / "others.bin"), speed="5")
    try:
        assert read(station, "MIS_TAKEOFF_ALT").param_value != chosen
    finally:
        stop(simulator, station)


# -------------------------------------------------------------------------------------------------- in the air


def mode_of(heartbeat):
    return heartbeat.custom_mode >> 16 & 0xFF, heartbeat.custom_mode >> 24


def test_old_mode_messages_are_obeyed_and_seen_at_once(own):
    """QGroundControl changes modes by SET_MODE, and tries three times within 1.3 s to see the new one."""
    assert own.command(ARM_DISARM, 1) == ACCEPTED
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


# ------------------------------------------------------------------------------------- QGroundControl's connection

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
