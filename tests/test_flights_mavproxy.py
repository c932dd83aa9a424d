"""Whole flights by lines that are typed into MAVProxy, judged by the simulator's truth.

`mode NAME` fails within MAVProxy 1.8.75 for every mode of every PX4, before anything is sent; modes are asked for by
`long`, with the numbers that pymavlink has for the names.
"""

import re
import socket

import pytest
from pymavlink import mavutil

from conftest import PREARM_CHECK, Simulator
from flight import ENDLESS, HEIGHT_M, MOVED_M, NEAR_M, Observer, place, turn
from test_mavproxy import Mavproxy, wait_until
from test_mavsdk import free_port

SPEED = "5"
TAKEOFF_M = 5.0
# How long MAVProxy may say nothing of a command, s.
SILENCE_S = 5
STICKS = {"roll": 1, "pitch": 2, "throttle": 3, "yaw": 4}
# Modes by MAVProxy's names, and by those that the truth's station has for them.
PILOTED = {"ALTCTL": "ALTITUDE", "POSCTL": "POSITION", "STABILIZED": "STABILIZED", "ACRO": "ACRO", "MANUAL": "STABILIZED"}
AUTOMATIC = {"LOITER": "HOLD", "MISSION": "MISSION", "RTL": "RETURN"}


class Flyer(Mavproxy):
    """MAVProxy, and a station beside it that knows the truth."""

    def __init__(self, port, folder, true):
        super().__init__(port, folder)
        self.true = true

    def ask(self, line, command):
        """Types a line whose command is accepted; again, as a person would, if nothing is said of it.

        MAVProxy repeats no command, and on a busy machine it reads so slowly that its socket loses answers.
        """
        accepted = re.compile(rf"Got COMMAND_ACK: {command}: (ACCEPTED)")
        before = self.read
        for _ in range(4):
            self.true.catch_up()
            self.type(line)
            try:
                wait_until(lambda: accepted.search(self.output, before), SILENCE_S)
                break
            except AssertionError:
                continue
        self.says(accepted, since=before)

    def ask_mode(self, name):
        flags, main, sub = mavutil.px4_map[name]
        self.ask(f"long DO_SET_MODE {flags} {main} {sub}", "DO_SET_MODE")

    def set_param(self, name, value):
        self.type(f"param set {name} {value}")

        def is_set():
            self.type(f"param fetch {name}")
            return float(self.says(rf"{name} = ([-\d.]+)", 10).group(1)) == pytest.approx(value)

        wait_until(is_set)

    def arm(self):
        self.ask("arm throttle", "COMPONENT_ARM_DISARM")
        self.true.wait_armed()

    def take_off(self):
        start = self.true.now()
        self.arm()
        self.ask(f"takeoff {TAKEOFF_M}", "NAV_TAKEOFF")
        self.true.until(lambda t: abs(t.up - start.up - TAKEOFF_M) < HEIGHT_M and abs(t.v_up) < 0.2, "at its height")
        return start

    def sticks(self, **pulses):
        """Moves sticks, which MAVProxy repeats ten times a second; µs."""
        for name, pulse in pulses.items():
            self.type(f"rc {STICKS[name]} {pulse}")

    def land(self):
        self.ask("long NAV_LAND", "NAV_LAND")
        return self.true.wait_landed()


@pytest.fixture(scope="module")
def flown(simulator_path, tmp_path_factory):
    port = free_port(socket.SOCK_DGRAM)
    true = Observer()
    mavproxy = Flyer(port, tmp_path_factory.mktemp("mavproxy"), true)
    mavproxy.says("Waiting for heartbeat")
    simulator = Simulator(true, "--peer", f"127.0.0.1:{port}", "--speed", SPEED, *ENDLESS)
    mavproxy.says("Detected vehicle 1:1")
    mavproxy.says(r"Received \d+ parameters")
    true.wait("SYS_STATUS", lambda status: status.onboard_control_sensors_health & PREARM_CHECK, within_ms=10_000)
    # At a multiple of real time MAVProxy's ten messages a second are far apart.
    mavproxy.set_param("COM_RC_LOSS_T", 10.0)
    yield mavproxy
    running = simulator.is_running()
    mavproxy.stop()
    simulator.stop()
    true.close()
    assert running, "the simulator ended by itself"


@pytest.fixture
def mavproxy(flown):
    """On the ground, disarmed and without sticks, also after a flight that went wrong."""
    yield flown
    flown.type("rc clear")
    flown.type("long NAV_LAND")
    flown.true.catch_up()
    flown.true.wait_armed(False, within_ms=60_000)


def test_a_guided_flight(mavproxy):
    """`guided` sends DO_REPOSITION above home, with a yaw of 0: north."""
    start = mavproxy.take_off()
    latitude, longitude = place(start.north + 10, start.east + 5)
    mavproxy.ask(f"guided {latitude:.7f} {longitude:.7f} 8", "DO_REPOSITION")
    there = mavproxy.true.wait_at(start.north + 10, start.east + 5, start.up + 8)
    assert there.faces(0)
    mavproxy.ask("setyaw 90 20 0", "CONDITION_YAW")
    mavproxy.true.until(lambda truth: truth.faces(90), "facing east", within_s=10)
    mavproxy.ask("setyaw 45 20 1", "CONDITION_YAW")
    turned = mavproxy.true.until(lambda truth: truth.faces(135), "turned by 45° more", within_s=10)
    assert turned.distance(there.north, there.east) < MOVED_M
    mavproxy.ask("setspeed 2", "DO_CHANGE_SPEED")
    # So far away that it is still on its way when MAVProxy, on a busy machine, says that it may go.
    latitude, longitude = place(start.north - 60, start.east + 5)
    mavproxy.ask(f"guided {latitude:.7f} {longitude:.7f} 8", "DO_REPOSITION")
    mavproxy.true.until(lambda truth: truth.speed > 1.5, "on its way")
    assert max(truth.speed for truth in mavproxy.true.during(2)) < 2.5
    mavproxy.ask("long NAV_RETURN_TO_LAUNCH", "NAV_RETURN_TO_LAUNCH")
    landed = mavproxy.true.wait_landed(90)
    assert landed.distance(start.north, start.east) < MOVED_M


def test_every_mode_by_its_number(mavproxy):
    """In the air with centred sticks; without set-points there is no offboard mode, and it says so."""
    mavproxy.take_off()
    for name, told in AUTOMATIC.items():
        mavproxy.ask_mode(name)
        mavproxy.true.wait_mode(told)
    flags, main, sub = mavutil.px4_map["OFFBOARD"]
    mavproxy.type(f"long DO_SET_MODE {flags} {main} {sub}")
    mavproxy.says("no set-points")
    mavproxy.ask_mode("LOITER")
    mavproxy.sticks(roll=1500, pitch=1500, throttle=1500, yaw=1500)
    mavproxy.true.wait("RC_CHANNELS", lambda channels: channels.chan4_raw == 1500)
    for name, told in PILOTED.items():
        mavproxy.ask_mode(name)
        mavproxy.true.wait_mode(told)
        mavproxy.ask_mode("POSCTL")
        mavproxy.true.wait_mode("POSITION")
    mavproxy.ask_mode("LAND")
    mavproxy.true.wait_mode("LAND")
    mavproxy.true.wait_landed()


def test_a_radio_flies_altitude_mode(mavproxy):
    """By overridden channels from the ground to the ground, armed by its sticks."""
    start = mavproxy.true.now()
    mavproxy.sticks(roll=1500, pitch=1500, throttle=1000, yaw=1500)
    mavproxy.true.wait("RC_CHANNELS", lambda channels: channels.chan4_raw == 1500)
    mavproxy.ask_mode("ALTCTL")
    mavproxy.sticks(yaw=2000)
    mavproxy.true.wait_armed(within_ms=10_000)
    mavproxy.sticks(yaw=1500, throttle=1800)
    mavproxy.true.until(lambda truth: truth.up > start.up + 4, "up")
    mavproxy.sticks(throttle=1500)
    still = mavproxy.true.until(lambda truth: abs(truth.v_up) < 0.1, "holding its height")
    mavproxy.sticks(yaw=1700)
    mavproxy.true.until(lambda truth: turn(still.heading, truth.heading) > 45, "turned to the right")
    mavproxy.sticks(yaw=1500, roll=1600)
    mavproxy.true.until(lambda truth: truth.roll > 3, "leaning to the right")
    mavproxy.sticks(roll=1500)
    assert abs(mavproxy.true.now().up - still.up) < HEIGHT_M
    mavproxy.sticks(throttle=1000)
    mavproxy.true.until(lambda truth: truth.up < 0.1, "down")
    mavproxy.true.wait_landed()


def test_it_goes_on_by_long_commands(mavproxy):
    """Numbers of a COMMAND_LONG: a place in degrees, which carry 0.4 m here, a speed, and landing at a place."""
    start = mavproxy.take_off()
    latitude, longitude = place(start.north + 6, start.east)
    height = mavproxy.true.wait("GLOBAL_POSITION_INT").alt / 1e3
    mavproxy.ask(f"long DO_REPOSITION -1 1 0 nan {latitude:.7f} {longitude:.7f} {height}", "DO_REPOSITION")
    mavproxy.true.wait_at(start.north + 6, start.east, start.up + TAKEOFF_M)
    mavproxy.ask("long DO_CHANGE_SPEED 1 3 -1 0 0 0 0", "DO_CHANGE_SPEED")
    latitude, longitude = place(start.north, start.east + 6)
    mavproxy.ask(f"long NAV_LAND 0 0 0 nan {latitude:.7f} {longitude:.7f} 0", "NAV_LAND")
    mavproxy.true.wait_mode("LAND")
    landed = mavproxy.true.wait_landed()
    assert landed.distance(start.north, start.east + 6) < NEAR_M


def test_disarming_is_refused_in_the_air(mavproxy):
    mavproxy.take_off()
    mavproxy.type("disarm")
    mavproxy.says("Got COMMAND_ACK: COMPONENT_ARM_DISARM: TEMPORARILY_REJECTED|Disarming refused")
    mavproxy.land()
    mavproxy.arm()
    mavproxy.ask("disarm", "COMPONENT_ARM_DISARM")
    mavproxy.true.wait_armed(False)
