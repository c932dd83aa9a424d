"""Orders of ground stations and SDKs besides plain flight: orbit, flight termination, reboot, and a motor test."""

import math

import pytest
from pymavlink.dialects.v20 import development as mavlink

from client import ACCEPTED, ARM_DISARM, TAKEOFF, UNSUPPORTED, stop
from conftest import PREARM_CHECK, Simulator
from flight import ENDLESS, HEIGHT_M, MODES, MOVED_M, NEAR_M, Observer, place, turn
from test_flights_mavsdk import Flyer
from test_mavsdk import Grpc

TERMINATION = mavlink.MAV_CMD_DO_FLIGHTTERMINATION
REBOOT = mavlink.MAV_CMD_PREFLIGHT_REBOOT_SHUTDOWN
MOTOR_TEST = mavlink.MAV_CMD_DO_MOTOR_TEST
# PX4's sub mode of main mode 3 while it orbits.
ORBIT_MODE = (3, 1)
TAKEOFF_M = 5.0


class Station(Observer):
    def command_and_ack(self, command, *params):
        result = self.command(command, *params)
        assert result == ACCEPTED, result

    def take_off(self):
        start = self.now()
        self.command_and_ack(ARM_DISARM, 1)
        self.command_and_ack(TAKEOFF, *[0] * 6, TAKEOFF_M)
        self.until(lambda t: abs(t.up - start.up - TAKEOFF_M) < HEIGHT_M and abs(t.v_up) < 0.2, "at its height")
        return start

    def wait_ready(self, within_ms=20_000):
        self.wait("SYS_STATUS", lambda status: status.onboard_control_sensors_health & PREARM_CHECK, within_ms)

    def orbit(self, radius, speed, north, east):
        """As QGroundControl does: a COMMAND_INT in frame GLOBAL, the height above the sea, the nose to the centre."""
        x, y = (round(degrees * 1e7) for degrees in place(north, east))
        height = self.wait("GLOBAL_POSITION_INT").alt / 1e3
        self.catch_up()
        orbit = mavlink.MAV_CMD_DO_ORBIT
        self.mav.command_int_send(1, 1, 0, orbit, 0, 0, radius, speed, 0, math.nan, x, y, height)
        assert self.ack(orbit) == ACCEPTED


@pytest.fixture
def station(simulator_path):
    """A vehicle of one test's own, because it may be broken after it."""
    station = Station()
    simulator = Simulator(station, "--speed", "10", *ENDLESS)
    station.wait_ready()
    station.heartbeat()
    yield station
    stop(simulator, station)


@pytest.fixture
def pilot(simulator_path):
    """MAVSDK, likewise."""
    pilot = Flyer(Grpc())
    yield pilot
    pilot.close()


def bearing(truth, north, east):
    """Of the vehicle, from a centre."""
    return math.degrees(math.atan2(truth.east - east, truth.north - north))


@pytest.mark.parametrize("radius, sign", [(6.0, 1), (-6.0, -1)])
def test_it_orbits_a_place(station, radius, sign):
    """Clockwise for a positive radius, facing the centre, at its distance and speed, until something else is asked."""
    start = station.take_off()
    centre = start.north + 6, start.east
    station.orbit(radius, 2.0, *centre)
    station.pause(10)
    truths = station.during(12)
    assert all(abs(truth.distance(*centre) - 6) < NEAR_M for truth in truths)
    assert all(abs(truth.speed - 2) < 0.7 for truth in truths)
    assert all(abs(turn(bearing(t, *centre) + 180, t.heading)) < 25 for t in truths)
    assert all(abs(truth.up - start.up - TAKEOFF_M) < HEIGHT_M for truth in truths)
    went = sum(turn(bearing(a, *centre), bearing(b, *centre)) for a, b in zip(truths, truths[1:]))
    assert sign * went > 180, "12 s at 2 m/s are 229° of a circle of 6 m"
    heartbeat = station.wait("HEARTBEAT")
    assert (heartbeat.custom_mode >> 16 & 0xFF, heartbeat.custom_mode >> 24) == ORBIT_MODE
    station.wait("ORBIT_EXECUTION_STATUS", within_ms=2_000)
    main, sub = MODES["HOLD"]
    station.command_and_ack(mavlink.MAV_CMD_DO_SET_MODE, 1, main, sub)
    station.until(lambda truth: truth.speed < 0.3, "standing", within_s=6)


def test_an_orbit_without_a_speed_has_the_usual_one(station):
    """The button of QGroundControl gives none: NaN."""
    start = station.take_off()
    centre = start.north + 8, start.east
    station.orbit(8.0, math.nan, *centre)
    station.pause(10)
    truths = station.during(5)
    assert all(abs(truth.distance(*centre) - 8) < NEAR_M and truth.speed > 0.7 for truth in truths)


def test_it_orbits_by_the_sdk(pilot):
    """As the example of do_orbit: two metres at a metre a second round where it hovers, at a height above the sea."""
    from mavsdk_grpc.action import OrbitYawBehavior

    pilot.take_off()
    begun = pilot.true.now()
    behaviour = OrbitYawBehavior.HOLD_FRONT_TO_CIRCLE_CENTER
    height = pilot.do(pilot.first("position", bool)).absolute_altitude_m + 3
    pilot.act("do_orbit", 2.0, 1.0, behaviour, *place(begun.north, begun.east), height)
    pilot.true.pause(10)
    # A whole turn: its middle is where the vehicle takes the centre to be, off by the error of its satellites.
    truths = pilot.true.during(4 * math.pi)
    middle = [sum(truth[axis] for truth in truths) / len(truths) for axis in (1, 2)]
    assert begun.distance(*middle) < NEAR_M
    assert all(abs(truth.distance(*middle) - 2) < 0.5 and abs(truth.up - begun.up - 3) < HEIGHT_M for truth in truths)
    pilot.act("hold")
    pilot.land()


def test_a_termination_stops_the_rotors(station):
    station.take_off()
    station.command_and_ack(TERMINATION, 1)
    station.until(lambda truth: truth.v_up < -2, "falling", within_s=2)
    station.wait_armed(False)


def test_a_termination_that_asks_for_nothing_does_nothing(station):
    start = station.take_off()
    assert station.command(TERMINATION, 0) != UNSUPPORTED
    assert abs(station.pause(2).up - start.up - TAKEOFF_M) < HEIGHT_M


def test_it_is_terminated_by_the_sdk(pilot):
    pilot.take_off()
    pilot.act("terminate")
    pilot.true.until(lambda truth: truth.v_up < -2, "falling", within_s=2)


def test_a_reboot_begins_anew(station):
    """Its estimate is gone for a while, then it may be armed again, and flies."""
    station.command_and_ack(REBOOT, 1)
    station.wait("SYS_STATUS", lambda status: not status.onboard_control_sensors_health & PREARM_CHECK, within_ms=3_000)
    station.wait_ready()
    station.take_off()


def test_a_reboot_in_flight_is_refused(station):
    start = station.take_off()
    assert station.command(REBOOT, 1) not in (ACCEPTED, UNSUPPORTED)
    assert abs(station.pause(2).up - start.up - TAKEOFF_M) < HEIGHT_M


def test_it_is_rebooted_by_the_sdk(pilot):
    pilot.act("reboot")
    pilot.wait("health_all_ok", lambda ok: not ok)
    pilot.wait("health_all_ok", bool)


@pytest.mark.parametrize("motor", [1, 2, 3, 4])
def test_a_motor_is_tested(station, motor):
    """A tenth of its speed for a second, disarmed: that rotor turns and no other, the vehicle stays, and it ends."""
    start = station.now()
    # ESC_STATUS is newer than pymavlink 2.4.50; the rotors' commands are in SERVO_OUTPUT_RAW too, 1000 µs at rest.
    station.tell_interval(mavlink.MAVLINK_MSG_ID_SERVO_OUTPUT_RAW, 100_000)
    station.command_and_ack(MOTOR_TEST, motor, mavlink.MOTOR_TEST_THROTTLE_PERCENT, 10, 1.0, 1, 0)
    outputs = station.wait("SERVO_OUTPUT_RAW", lambda outputs: max(pulses(outputs)) > 1_000, within_ms=2_000)
    turning = [number for number, pulse in enumerate(pulses(outputs), 1) if pulse > 1_000]
    assert turning == [motor], turning
    station.wait("SERVO_OUTPUT_RAW", lambda outputs: max(pulses(outputs)) <= 1_000, within_ms=4_000)
    assert station.now().distance(start.north, start.east) < MOVED_M


def pulses(outputs):
    return [outputs.servo1_raw, outputs.servo2_raw, outputs.servo3_raw, outputs.servo4_raw]


def test_no_motor_is_tested_in_flight(station):
    start = station.take_off()
    assert station.command(MOTOR_TEST, 1, 0, 10, 1, 1, 0) not in (ACCEPTED, UNSUPPORTED)
    assert abs(station.pause(2).up - start.up - TAKEOFF_M) < HEIGHT_M
