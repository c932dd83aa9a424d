"""What the tests of links, requests and parameters share: a ground station that is one of several, and vehicles.

A peer is a station that `serve` was told of; a guest is known only because it has sent something. What is measured in
time is measured in the vehicle's own time stamps.
"""

import select
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

# The place of the scenario `field`: latitude and longitude, degrees.
HOME_DEG = (47.3977, 8.5456)


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
    """What each station hears while that much time passes on the vehicle by the first one's account."""
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


def parameter_list(client):
    """All parameters in the order in which they come, by PARAM_REQUEST_LIST alone."""
    client.catch_up()
    client.mav.param_request_list_send(1, 1)
    values = [client.wait("PARAM_VALUE", within_ms=REQUEST_MS)]
    # A station that hears nothing for so long asks for what is missing.
    while values[-1].param_index != values[-1].param_count - 1:
        values.append(client.wait("PARAM_VALUE", within_ms=REQUEST_MS))
    return values


def kinds(messages):
    return [message.get_type() for message in messages]


def assert_no_gap(messages, least=20):
    """One counter a link and component, which skips no number."""
    by_sender = {}
    for message in messages:
        # From the frame itself: pymavlink does not tell it of messages that it does not know, as ESC_STATUS.
        _, _, _, _, number, system, component, *_ = message.get_msgbuf()
        by_sender.setdefault((system, component), []).append(number)
    assert (1, 1) in by_sender and len(by_sender[1, 1]) >= least, by_sender.keys()
    for sender, numbers in by_sender.items():
        gaps = [(a, b) for a, b in zip(numbers, numbers[1:]) if (b - a) % 256 != 1]
        assert not gaps, (sender, gaps)


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


@pytest.fixture
def a(shared):
    """The peer, with its default rates."""
    shared.heartbeat()
    shared.catch_up()
    yield shared


@pytest.fixture
def own(simulator_path):
    """A vehicle of one test's own, at four times real time, and its peer."""
    simulator, station = serve(speed="4")
    yield station
    stop(simulator, station)
