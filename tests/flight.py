"""What the tests of whole flights share: a station that only listens, and knows what is true of the vehicle.

A flight is judged by the simulator's truth, not by the vehicle's own word. The vehicle knows its place by satellites, so
what it holds and what is true differ by the receiver's error; the limits below leave room for that.
"""

import math
import time
from typing import NamedTuple

import pytest
from pymavlink.dialects.v20 import development as mavlink

from client import HOME_DEG, Client
from conftest import HANG_S

# Metres a degree of latitude, and of longitude where `field` is.
NORTH_M = 111_194.0
EAST_M = NORTH_M * math.cos(math.radians(HOME_DEG[0]))
# Where `field` stands above the sea, m.
GROUND_MSL_M = 488.0
# How far the truth may be from what the vehicle was asked for: the receiver's error and gusts, m.
NEAR_M = 2.5
# How far it may be after a move from where it began, which cancels most of the receiver's error, m.
MOVED_M = 1.5
# The same of heights, of which the barometer keeps the difference, m, and of headings, degrees.
HEIGHT_M, HEADING_DEG = 1.0, 8.0
# For `serve`: a battery that many flights in a row do not empty. A low one brings the vehicle home.
ENDLESS = ("--set", "airframe.battery.capacity_ah=1000")
MODES = {
    "MANUAL": (1, 0),
    "ALTITUDE": (2, 0),
    "POSITION": (3, 0),
    "TAKEOFF": (4, 2),
    "HOLD": (4, 3),
    "MISSION": (4, 4),
    "RETURN": (4, 5),
    "LAND": (4, 6),
    "ACRO": (5, 0),
    "OFFBOARD": (6, 0),
    "STABILIZED": (7, 0),
}


class Truth(NamedTuple):
    """Metres from home, m/s, degrees."""

    time_s: float
    north: float
    east: float
    up: float
    v_north: float
    v_east: float
    v_up: float
    roll: float
    pitch: float
    heading: float

    @property
    def speed(self):
        """Over the ground."""
        return math.hypot(self.v_north, self.v_east)

    def is_at(self, north, east, up, near=NEAR_M):
        """It has come there, and stands."""
        return self.distance(north, east) < near and abs(self.up - up) < HEIGHT_M and self.speed < 0.7

    def distance(self, north, east):
        return math.hypot(self.north - north, self.east - east)

    def faces(self, heading):
        return abs(turn(heading, self.heading)) < HEADING_DEG


def turn(before, after):
    """How far a heading has turned, −180 to 180 degrees."""
    return (after - before + 180.0) % 360.0 - 180.0


def truth_of(m):
    w, x, y, z = m.attitude_quaternion
    return Truth(
        m.time_usec / 1e6,
        (m.lat / 1e7 - HOME_DEG[0]) * NORTH_M,
        (m.lon / 1e7 - HOME_DEG[1]) * EAST_M,
        m.alt / 1e3 - GROUND_MSL_M,
        m.vx / 100,
        m.vy / 100,
        -m.vz / 100,
        math.degrees(math.atan2(2 * (w * x + y * z), 1 - 2 * (x * x + y * y))),
        math.degrees(math.asin(max(-1.0, min(1.0, 2 * (w * y - z * x))))),
        math.degrees(math.atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z))) % 360,
    )


def place(north, east):
    """Latitude and longitude of a place so many metres from home."""
    return HOME_DEG[0] + north / NORTH_M, HOME_DEG[1] + east / EAST_M


def mode_of(heartbeat):
    return heartbeat.custom_mode >> 16 & 0xFF, heartbeat.custom_mode >> 24


def is_armed(heartbeat):
    return bool(heartbeat.base_mode & mavlink.MAV_MODE_FLAG_SAFETY_ARMED)


class Observer(Client):
    """A station that hears the vehicle and the simulator. Of several vehicles it follows one."""

    def __init__(self, system=1):
        super().__init__()
        self.system = system

    def next(self):
        """The next message of its vehicle."""
        while True:
            message = super().next()
            if message.get_srcSystem() == self.system:
                return message

    @staticmethod
    def seen(message):
        """What a HIL_STATE_QUATERNION says."""
        return truth_of(message)

    def now(self):
        """What is true by now."""
        self.catch_up()
        return self.until(lambda truth: True, "a word of the simulator")

    def until(self, condition, what, within_s=60.0):
        """The first truth that meets a condition, within so much simulated time."""
        first = last = None
        hang = time.monotonic() + HANG_S
        while time.monotonic() < hang:
            message = self.next()
            if message.get_type() != "HIL_STATE_QUATERNION":
                continue
            last = truth_of(message)
            first = first or last
            if condition(last):
                return last
            if last.time_s - first.time_s > within_s:
                break
        pytest.fail(f"not {what} within {within_s} s, but {last}")

    def wait_at(self, north, east, up, within_s=60.0, near=NEAR_M):
        return self.until(lambda t: t.is_at(north, east, up, near), f"at {north:.1f} {east:.1f} {up:.1f}", within_s)

    def pause(self, duration_s):
        """Lets so much simulated time pass; what is true then."""
        end = self.now().time_s + duration_s
        return self.until(lambda truth: truth.time_s >= end, "later")

    def during(self, duration_s):
        """All that is true in so much simulated time."""
        truths = [self.now()]
        while truths[-1].time_s < truths[0].time_s + duration_s:
            truths.append(self.until(lambda truth: True, "a word of the simulator"))
        return truths

    def wait_mode(self, name, within_ms=1_300):
        """Until the heartbeat tells a mode, for which QGroundControl gives 1.3 s."""
        return self.wait("HEARTBEAT", lambda heartbeat: mode_of(heartbeat) == MODES[name], within_ms)

    def wait_armed(self, armed=True, within_ms=1_500):
        return self.wait("HEARTBEAT", lambda heartbeat: is_armed(heartbeat) == armed, within_ms)

    def most_tilt(self, duration_s):
        """The greatest of roll and pitch in so much simulated time."""
        return max(max(abs(truth.roll), abs(truth.pitch)) for truth in self.during(duration_s))

    def wait_landed(self, within_s=60.0):
        """Until it stands disarmed on the ground; what is true then."""
        self.wait_armed(False, int(within_s * 1e3))
        truth = self.now()
        assert abs(truth.up) < 0.3 and truth.speed < 0.3, truth
        return truth
