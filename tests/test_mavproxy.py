"""The vehicle as MAVProxy shows it: the program itself, its lines typed and its output read through pipes."""

import os
import re
import socket
import subprocess
import sys
import threading
import time

import pytest

from conftest import HANG_S, PREARM_CHECK, Simulator, Station
from test_mavsdk import HEIGHT_M, LATITUDE_DEG, LONGITUDE_DEG, free_port

# Its modules that need neither a display nor large packages: of its default ones all but adsb and terrain.
MODULES = """log signing wp rally fence ftp param relay tuneopt arm mode calibration rc auxopt misc cmdlong battery output
layout""".split()
# PX4's modes by MAVProxy's names, as they go into DO_SET_MODE. `mode LAND` itself fails before anything is sent: with
# MAVProxy 1.8.75 and pymavlink 2.4.50 by an error of theirs, for every PX4.
SUB_MODE = {"LOITER": 3, "RTL": 5, "LAND": 6}
# What would show that something was asked for in vain.
IN_VAIN = re.compile(r"time[d ]*-?out|no ack|link 1 down|no link|Failed|Traceback|Exception|unsupported", re.IGNORECASE)


class Mavproxy:
    """It reads lines from its standard input where that is no terminal, and needs no display."""

    def __init__(self, port, folder):
        program = os.path.join(os.path.dirname(sys.executable), "mavproxy.py")
        command = [
            sys.executable,
            "-u",
            program,
            f"--master=udpin:127.0.0.1:{port}",
            f"--default-modules={','.join(MODULES)}",
        ]
        command += [f"--state-basedir={folder}", "--logfile=flight.tlog"]
        pipe = subprocess.PIPE
        self.process = subprocess.Popen(command, stdin=pipe, stdout=pipe, stderr=subprocess.STDOUT, cwd=folder)
        self.output, self.read = "", 0
        self.grown = threading.Condition()
        self.thread = threading.Thread(target=self.collect, daemon=True)
        self.thread.start()

    def collect(self):
        # By whole lines, and prompts, which end none.
        rest = ""
        for text in iter(lambda: os.read(self.process.stdout.fileno(), 65_536), b""):
            whole, _, rest = re.match(r"(?s)(.*(\n|> )|)(.*)", rest + text.decode("ascii", errors="replace")).groups()
            with self.grown:
                self.output += whole
                self.grown.notify()

    def type(self, line):
        self.process.stdin.write(f"{line}\n".encode())
        self.process.stdin.flush()

    def has_said(self, pattern):
        with self.grown:
            return re.search(pattern, self.output)

    def says(self, pattern, within_s=HANG_S, since=None):
        """The next place in its output that a pattern matches, or the next one after a place."""
        end = time.monotonic() + within_s
        self.read = self.read if since is None else since
        with self.grown:
            while True:
                match = re.compile(pattern).search(self.output, self.read)
                if match:
                    self.read = match.end()
                    return match
                rest = end - time.monotonic()
                if rest <= 0:
                    pytest.fail(f"`{pattern}` is not among\n{self.output[self.read :][-3000:]}")
                self.grown.wait(rest)

    def status(self, kind, condition=lambda fields: True):
        """The fields of the last message of a kind, by its command `status`, once they meet a condition."""
        end = time.monotonic() + 20
        while True:
            self.type(f"status {kind}")
            # Where the answer to this ends is where the answer to that begins.
            self.type("end-of-status")
            text = self.says(r"(?s)(.*?)Unknown command 'end-of-status'").group(1)
            found = re.search(kind + r" \{(.*)\}", text)
            fields = dict(re.findall(r"(\w+) : (\[[^]]*\]|[^,]+)", found.group(1))) if found else None
            if fields and condition(fields):
                return fields
            if time.monotonic() > end:
                pytest.fail(f"{kind}: {fields}")
            time.sleep(0.1)

    def stop(self):
        self.process.stdin.close()
        try:
            self.process.wait(timeout=10)
        finally:
            self.process.kill()
            self.process.wait()
            self.thread.join()


@pytest.fixture(scope="module")
def connected(simulator_path, tmp_path_factory):
    """The program, the vehicle in real time, and a station beside it that reads the vehicle's time."""
    port = free_port(socket.SOCK_DGRAM)
    station = Station()
    mavproxy = Mavproxy(port, tmp_path_factory.mktemp("mavproxy"))
    mavproxy.says("Waiting for heartbeat")
    simulator = Simulator(station, "--peer", f"127.0.0.1:{port}")
    mavproxy.says("Detected vehicle 1:1")
    station.wait("HEARTBEAT")
    yield mavproxy, simulator, station
    running = simulator.is_running()
    mavproxy.stop()
    simulator.stop()
    station.close()
    assert running, "the simulator ended by itself"


@pytest.fixture
def mavproxy(connected):
    return connected[0]


def test_parameters_are_complete_within_five_seconds(connected):
    """It asks by file transfer first, and by the list once that is refused."""
    mavproxy, _, station = connected
    # By the vehicle's time, which passes no faster than the wall clock's: a busy machine slows both.
    start = station.wait("LOCAL_POSITION_NED").time_boot_ms
    while not (received := mavproxy.has_said(r"Received (\d+) parameters")) and station.now_ms - start < 10_000:
        station.wait("LOCAL_POSITION_NED")
    assert received and int(received.group(1)) >= 50, mavproxy.output[-2000:]
    assert station.now_ms - start <= 5_000


def test_a_parameter_is_read_and_written(mavproxy):
    before = read(mavproxy)
    for height in (before + 1.5, before):
        mavproxy.type(f"param set MIS_TAKEOFF_ALT {height}")
        wait_until(lambda height=height: read(mavproxy) == pytest.approx(height))
    mavproxy.type("param fetch MAV_SYS_ID")
    assert int(mavproxy.says(r"MAV_SYS_ID = (\d+)\s").group(1)) == 1


def read(mavproxy):
    mavproxy.type("param fetch MIS_TAKEOFF_ALT")
    return float(mavproxy.says(r"MIS_TAKEOFF_ALT = ([\d.]+)", 10).group(1))


def wait_until(condition, within_s=20):
    end = time.monotonic() + within_s
    while not condition():
        assert time.monotonic() < end
        time.sleep(0.2)


def test_it_is_on_the_map(mavproxy):
    """The map's icon is put where GLOBAL_POSITION_INT says, unless that is 0, 0; turned by its heading."""
    position = mavproxy.status("GLOBAL_POSITION_INT", lambda fields: int(fields["lat"]) != 0)
    assert abs(int(position["lat"]) / 1e7 - LATITUDE_DEG) < 1e-3
    assert abs(int(position["lon"]) / 1e7 - LONGITUDE_DEG) < 1e-3
    assert abs(int(position["alt"]) / 1e3 - HEIGHT_M) < 60
    assert abs(int(position["relative_alt"]) / 1e3) < 5
    assert 0 <= int(position["hdg"]) < 36_000
    assert int(mavproxy.status("GPS_RAW_INT")["fix_type"]) >= 3
    home = mavproxy.status("HOME_POSITION")
    assert abs(int(home["latitude"]) / 1e7 - LATITUDE_DEG) < 1e-3


def test_the_battery_is_shown(mavproxy):
    status = mavproxy.status("BATTERY_STATUS")
    cells = [int(cell) for cell in re.findall(r"\d+", status["voltages"]) if int(cell) != 65_535]
    assert 14_000 < sum(cells) < 17_500, "mV"
    mavproxy.type("bat")
    assert 0 < int(mavproxy.says(r"Flight battery: +(-?\d+)%").group(1)) <= 100


def test_it_names_px4s_modes(mavproxy):
    mavproxy.type("mode")
    names = mavproxy.says(r"Available modes: +(.*)").group(1).split(", ")
    assert {"MANUAL", "POSCTL", "LOITER", "MISSION", "RTL", "LAND", "OFFBOARD", "TAKEOFF"} <= set(names)


def test_it_flies(connected):
    mavproxy, _, station = connected
    station.wait("SYS_STATUS", lambda status: status.onboard_control_sensors_health & PREARM_CHECK)
    mavproxy.type("arm throttle")
    mavproxy.says("Got COMMAND_ACK: COMPONENT_ARM_DISARM: ACCEPTED")
    # The name of the mode comes with the heartbeat that says so.
    mavproxy.says(r"\bARMED")
    mavproxy.type("takeoff 5")
    mavproxy.says("Got COMMAND_ACK: NAV_TAKEOFF: ACCEPTED")
    mavproxy.status("GLOBAL_POSITION_INT", lambda fields: abs(int(fields["relative_alt"]) - 5_000) < 500)
    airborne = mavproxy.read
    for name in ("LOITER", "RTL", "LAND"):
        asked = mavproxy.read
        mavproxy.type(f"long MAV_CMD_DO_SET_MODE 1 4 {SUB_MODE[name]} 0 0 0 0")
        mavproxy.says("Got COMMAND_ACK: DO_SET_MODE: ACCEPTED")
        if name != "LOITER":
            # Which of heartbeat and acknowledgement comes first is chance. By its prompt: that names every mode, while
            # "Mode RTL" is said only where the last such line is 2 s old.
            mavproxy.says(f"{name}> ", since=asked)
    mavproxy.says(r"\bDISARMED", since=airborne)


def test_disarming_is_obeyed_on_the_ground(mavproxy):
    mavproxy.type("arm throttle")
    mavproxy.says("Got COMMAND_ACK: COMPONENT_ARM_DISARM: ACCEPTED")
    mavproxy.says(r"\bARMED")
    mavproxy.type("disarm")
    mavproxy.says("Got COMMAND_ACK: COMPONENT_ARM_DISARM: ACCEPTED")
    mavproxy.says(r"\bDISARMED")


def test_nothing_was_asked_for_in_vain(mavproxy):
    """The last one: of all that it has said until now."""
    assert "Detected vehicle" in mavproxy.output
    lines = [line for line in mavproxy.output.splitlines() if IN_VAIN.search(line)]
    assert not lines, lines
