"""Several ground stations on one vehicle, by raw frames: what one does changes nothing for another.

Station A is a peer of the vehicle's, B a guest.
"""

import itertools
import socket
import statistics
import threading
import time

import pytest
from pymavlink.dialects.v20 import development as mavlink

from client import a, own, shared  # noqa: F401 (fixtures)
from client import (
    ACCEPTED,
    ARM_DISARM,
    COMMAND_MS,
    Client,
    NO_COMMAND,
    REQUEST_MESSAGE,
    REQUEST_MS,
    SET_MESSAGE_INTERVAL,
    UNSUPPORTED,
    kinds,
    listen,
    stop,
    assert_no_gap,
)
from conftest import HANG_S


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


@pytest.fixture(scope="module")
def guest_of(shared):
    guest = Client(shared.vehicle, component=191)
    guest.heartbeat()
    guest.wait("HEARTBEAT")
    yield guest
    guest.close()


@pytest.fixture
def b(guest_of):
    """The guest, which has not been silent for so long that it is forgotten."""
    guest_of.heartbeat()
    guest_of.wait("LOCAL_POSITION_NED")
    guest_of.catch_up()
    yield guest_of


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
    heard = listen(a, [], 200)[a]
    for _ in range(10):
        # Between two of them, at every phase.
        a.command_long(SET_MESSAGE_INTERVAL, mavlink.MAVLINK_MSG_ID_ATTITUDE, 0)
        heard += listen(a, [], 70)[a]
    times = [message.time_boot_ms for message in heard if message.get_type() == "ATTITUDE"]
    gaps = [q - p for p, q in zip(times, times[1:])]
    assert kinds(heard).count("COMMAND_ACK") >= 9 and len(gaps) >= 12
    # One may be lost on the way, but none is added.
    assert all(gap > 0.8 * statistics.median(gaps) for gap in gaps), gaps


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
