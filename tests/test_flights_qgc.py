"""Whole flights by the messages that QGroundControl sends, in its order, as raw frames.

Its guided buttons send commands, each mode the old SET_MODE, and a joystick 25 MANUAL_CONTROL a second. It gives up when
the heartbeat does not tell the mode within 1.3 s, or that it is armed within 1.5 s.
"""

import math

import pytest
from pymavlink.dialects.v20 import development as mavlink

from client import ACCEPTED, ARM_DISARM, COMMAND_MS, TAKEOFF, parameter_list, stop
from conftest import PREARM_CHECK, Simulator
from flight import ENDLESS, HEIGHT_M, MODES, MOVED_M, Observer, is_armed, place, turn
from test_requests import check_modes, request_message

REPOSITION = mavlink.MAV_CMD_DO_REPOSITION
CHANGE_SPEED = mavlink.MAV_CMD_DO_CHANGE_SPEED
CHANGE_MODE = mavlink.MAV_DO_REPOSITION_FLAGS_CHANGE_MODE
GLOBAL = mavlink.MAV_FRAME_GLOBAL
FORCE = 21196
# What it puts for a coordinate that is not given in a COMMAND_INT.
NONE_E7 = 2**31 - 1
TAKEOFF_M = 6.0
# 25 messages of a joystick a second.
STICKS_MS = 40
STICKS_LOST_S = 5.0
NO_STICK = (0, 0, 500, 0)


class Station(Observer):
    """QGroundControl, for one vehicle: what its buttons do."""

    # The heartbeat that was heard last while sticks are moved.
    told = None

    def command_and_ack(self, command, *params):
        assert self.command(command, *params) == ACCEPTED, self.words()

    def words(self):
        """What it would show."""
        return [m.text for m in self.catch_up() if m.get_type() == "STATUSTEXT"]

    def arm(self):
        self.command_and_ack(ARM_DISARM, 1)
        self.wait_armed()

    def set_mode(self, name):
        """By SET_MODE, once, and the heartbeat has to tell."""
        self.catch_up()
        self.heartbeat()
        main, sub = MODES[name]
        flags = mavlink.MAV_MODE_FLAG_CUSTOM_MODE_ENABLED | mavlink.MAV_MODE_FLAG_SAFETY_ARMED
        self.mav.set_mode_send(1, flags, main << 16 | sub << 24)
        self.wait_mode(name)

    def above_sea(self):
        """The vehicle's own height above the sea, m, which its heights are reckoned from."""
        self.catch_up()
        return self.wait("GLOBAL_POSITION_INT").alt / 1e3

    def take_off(self, height=TAKEOFF_M):
        """By its button: the command with a height above the sea, and arming once that is accepted; what is true before."""
        start = self.now()
        self.command_and_ack(TAKEOFF, -1, 0, 0, math.nan, math.nan, math.nan, self.above_sea() + height)
        self.arm()
        self.wait_mode("TAKEOFF")
        self.until(lambda t: abs(t.up - start.up - height) < HEIGHT_M and abs(t.v_up) < 0.2, f"at {height} m")
        self.wait_mode("HOLD", 5_000)
        return start

    def reposition(self, north=None, east=None, above_sea=math.nan, yaw=math.nan, speed=-1.0):
        """A COMMAND_INT in frame GLOBAL; what is not given stays."""
        x = y = NONE_E7
        if north is not None:
            x, y = (round(degrees * 1e7) for degrees in place(north, east))
        self.catch_up()
        self.mav.command_int_send(1, 1, GLOBAL, REPOSITION, 0, 0, speed, CHANGE_MODE, 0, yaw, x, y, above_sea)
        assert self.ack(REPOSITION, COMMAND_MS) == ACCEPTED, self.words()

    def reposition_long(self, above_sea=math.nan, yaw=math.nan):
        """The same as a COMMAND_LONG, for what has no place."""
        self.command_and_ack(REPOSITION, -1, CHANGE_MODE, 0, yaw, math.nan, math.nan, above_sea)

    def fly_sticks(self, sticks, condition, what, within_s=30.0):
        """Moves the sticks, 25 times a second of the vehicle's time, until something is true."""
        end = self.now().time_s + within_s
        sent = -math.inf
        while True:
            message = self.next()
            if self.now_ms - sent >= STICKS_MS:
                pitch, roll, throttle, yaw = sticks
                self.mav.manual_control_send(1, pitch, roll, throttle, yaw, 0)
                sent = self.now_ms
            if message.get_type() == "HIL_STATE_QUATERNION":
                truth = self.seen(message)
                if condition(truth):
                    return truth
                assert truth.time_s < end, f"not {what}, but {truth}; {self.words()}"
            elif message.get_type() == "HEARTBEAT":
                self.told = message


def start():
    station = Station()
    simulator = Simulator(station, "--speed", "10", *ENDLESS)
    station.wait("SYS_STATUS", lambda status: status.onboard_control_sensors_health & PREARM_CHECK, within_ms=10_000)
    # The joystick's messages pass by this program and the wall clock, which a busy machine stops for a while.
    station.mav.param_set_send(1, 1, b"COM_RC_LOSS_T", STICKS_LOST_S, mavlink.MAV_PARAM_TYPE_REAL32)
    station.heartbeat()
    return simulator, station


@pytest.fixture(scope="module")
def flown(simulator_path):
    simulator, station = start()
    yield station
    stop(simulator, station)


@pytest.fixture
def own(simulator_path):
    """A vehicle of one test's own, which may end as it will."""
    simulator, station = start()
    yield station
    stop(simulator, station)


@pytest.fixture
def station(flown):
    """On the ground, disarmed, also after a flight that went wrong."""
    flown.heartbeat()
    yield flown
    flown.catch_up()
    flown.command_long(mavlink.MAV_CMD_NAV_LAND)
    flown.wait_armed(False, within_ms=60_000)


def test_it_connects(station):
    """Identity, modes, parameters, plans, each before the next is asked for."""
    a = station
    heartbeat = a.wait("HEARTBEAT", within_ms=2_000)
    assert heartbeat.autopilot == mavlink.MAV_AUTOPILOT_PX4 and not is_armed(heartbeat)
    assert request_message(a, mavlink.MAVLINK_MSG_ID_AUTOPILOT_VERSION) == ACCEPTED
    a.wait("AUTOPILOT_VERSION", within_ms=1_000)
    check_modes(a)
    names = {value.param_id for value in parameter_list(a)}
    assert {"COM_RC_IN_MODE", "COM_FLTMODE1", "RC_MAP_THROTTLE", "NAV_RCL_ACT", "MPC_XY_VEL_MAX"} <= names
    for mission_type in (0, 1, 2):
        a.ask(lambda mav: mav.mission_request_list_send(1, 1, mission_type), "MISSION_COUNT")


def test_the_buttons_of_flight(station):
    """Take-off, go to, another height, pause, another heading, land, in one flight."""
    a = station
    start = a.take_off()
    sea = a.above_sea() - TAKEOFF_M

    a.reposition(start.north + 10, start.east, sea + TAKEOFF_M)
    there = a.wait_at(start.north + 10, start.east, start.up + TAKEOFF_M)
    assert there.faces(start.heading), "a yaw that is not given stays"
    a.wait_mode("HOLD")

    a.reposition_long(above_sea=sea + 9)
    above = a.wait_at(there.north, there.east, start.up + 9)
    a.reposition(above_sea=sea + 5)
    a.wait_at(above.north, above.east, start.up + 5)

    a.reposition(start.north - 20, start.east, sea + 5)
    a.until(lambda truth: truth.speed > 2, "on its way")
    a.reposition_long()
    paused = a.until(lambda truth: truth.speed < 0.3, "paused", within_s=6)
    assert a.pause(2).distance(paused.north, paused.east) < MOVED_M

    for yaw in (math.pi / 2, -math.pi / 2):
        a.reposition_long(yaw=yaw)
        turned = a.until(lambda truth: truth.faces(math.degrees(yaw)), f"turned to {yaw}", within_s=10)
        assert turned.distance(paused.north, paused.east) < MOVED_M and abs(turned.up - paused.up) < HEIGHT_M

    a.set_mode("LAND")
    landed = a.wait_landed()
    assert landed.distance(paused.north, paused.east) < MOVED_M


def test_another_speed_over_the_ground(station):
    """Its slider of speed, and a fast way back by its return."""
    a = station
    start = a.take_off(4.0)
    a.command_and_ack(CHANGE_SPEED, 1, 2.0, -1, 0)
    a.reposition(start.north + 12, start.east, a.above_sea())
    a.until(lambda truth: truth.distance(start.north, start.east) > 5, "on its way")
    assert max(truth.speed for truth in a.during(2)) < 2.5
    a.wait_at(start.north + 12, start.east, start.up + 4)
    a.set_mode("RETURN")
    landed = a.wait_landed(90)
    assert landed.distance(start.north, start.east) < MOVED_M


def test_an_emergency_stop(station):
    """While the rotors idle on the ground, and in the air, which is the last flight's."""
    a = station
    a.arm()
    a.command_and_ack(ARM_DISARM, 0, FORCE)
    a.wait_armed(False)


def test_modes_are_told_in_time(station):
    """Each that its list offers in the air, and every stick mode with a joystick."""
    a = station
    a.take_off()
    for name in ("RETURN", "HOLD", "MISSION", "HOLD"):
        a.set_mode(name)
    for name in ("POSITION", "ALTITUDE", "STABILIZED", "ACRO", "POSITION"):
        a.mav.manual_control_send(1, *NO_STICK, 0)
        a.set_mode(name)
    a.set_mode("HOLD")
    a.set_mode("LAND")


def test_a_joystick_flies_position_mode(station):
    """From the ground: the mode, arming with the throttle centred, up, forward, sideways, a turn."""
    a = station
    start = a.now()
    a.fly_sticks((0, 0, 500, 0), lambda truth: truth.time_s > start.time_s + 1, "a second later")
    a.set_mode("POSITION")
    a.arm()
    a.fly_sticks((0, 0, 900, 0), lambda truth: truth.up > start.up + 4, "up")
    still = a.fly_sticks(NO_STICK, lambda t: abs(t.v_up) < 0.15 and t.speed < 0.3, "standing")
    # In three seconds without a stick it stays.
    held = a.fly_sticks(NO_STICK, lambda truth: truth.time_s > still.time_s + 3, "three seconds later")
    assert held.distance(still.north, still.east) < MOVED_M and abs(held.up - still.up) < 0.5
    heading = math.radians(held.heading)

    def along(truth):
        return (truth.north - held.north) * math.cos(heading) + (truth.east - held.east) * math.sin(heading)

    def across(truth):
        return (truth.east - held.east) * math.cos(heading) - (truth.north - held.north) * math.sin(heading)

    a.fly_sticks((600, 0, 500, 0), lambda truth: along(truth) > 5, "forward")
    a.fly_sticks((0, 600, 500, 0), lambda truth: across(truth) > 5, "to the right")
    a.fly_sticks((0, 0, 500, 600), lambda truth: turn(held.heading, truth.heading) > 60, "turned to the right")
    a.fly_sticks(NO_STICK, lambda truth: truth.speed < 0.3, "standing")
    a.set_mode("LAND")
    a.wait_landed()


@pytest.mark.parametrize("mode", ["ALTITUDE", "POSITION"])
def test_a_joystick_lands(own, mode):
    """With the throttle down until it is on the ground; it stays level there, and disarms by itself."""
    a = own
    a.fly_sticks(NO_STICK, lambda truth: True, "a word of the simulator")
    a.set_mode(mode)
    a.arm()
    a.fly_sticks((0, 0, 900, 0), lambda truth: truth.up > 3, "up")
    a.fly_sticks(NO_STICK, lambda truth: abs(truth.v_up) < 0.15, "holding its height")
    a.fly_sticks((0, 0, 0, 0), lambda truth: truth.up < 0.1, "down")
    tilts = []

    def disarmed(truth):
        tilts.append(max(abs(truth.roll), abs(truth.pitch)))
        return a.told and not is_armed(a.told)

    a.fly_sticks((0, 0, 0, 0), disarmed, "disarmed by itself")
    assert max(tilts) < 15, "it stays level on the ground"


def test_sticks_that_are_lost_bring_it_home(station):
    """By NAV_RCL_ACT, so long after the last of them."""
    a = station
    a.take_off()
    a.mav.manual_control_send(1, *NO_STICK, 0)
    a.set_mode("POSITION")
    a.wait("STATUSTEXT", lambda text: "Sticks lost" in text.text, within_ms=2_000 + int(STICKS_LOST_S * 1e3))
    a.wait_mode("RETURN")


def test_an_emergency_stop_in_the_air(station):
    """The last one: it falls."""
    a = station
    a.take_off(3.0)
    a.command_and_ack(ARM_DISARM, 0, FORCE)
    a.until(lambda truth: truth.v_up < -2, "falling", within_s=2)
    a.wait_armed(False)
