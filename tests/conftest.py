"""What the MAVLink tests share: a simulator of their own for each test, and a ground station that talks to it.

Ports are never guessed: the station binds any free one and tells the simulator, which also binds any free one and
is heard from it. So tests can run side by side. Evidence about time is taken from simulated time (the messages'
time stamps), so a busy machine makes the tests slower and nothing else; only the time-outs that turn a hang into a
failure are the wall clock's.
"""

import os
import socket
import subprocess
import time
from collections import deque
from pathlib import Path

import pytest
from pymavlink.dialects.v20 import common as mavlink

ROOT = Path(__file__).resolve().parent.parent
SIMULATOR = Path(os.environ.get("GLISSADE_SIM", ROOT / "target" / "release" / "sim-host"))

# The bit of SYS_STATUS that says that it may be armed.
PREARM_CHECK = mavlink.MAV_SYS_STATUS_PREARM_CHECK

# The longest that anything may take before the test calls it a hang, in seconds of wall time.
HANG_S = 60.0


def missing(what):
    """A suite that cannot run fails, unless skipping was asked for."""
    if os.environ.get("GLISSADE_ALLOW_SKIPS") == "1":
        pytest.skip(what)
    pytest.fail(f"{what} (GLISSADE_ALLOW_SKIPS=1 skips instead)")


class Station:
    """A ground station: MAVLink system 255, component 190, on a UDP port of its own."""

    SYSTEM, COMPONENT = 255, 190

    def __init__(self):
        self.socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self.socket.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 1 << 20)
        self.socket.settimeout(HANG_S)
        self.socket.bind(("127.0.0.1", 0))
        # Where the vehicle is: whence it was heard last.
        self.vehicle = None
        # Writes frames through `write`; raises on any byte received that is not part of a sound frame.
        self.mav = mavlink.MAVLink(self, srcSystem=self.SYSTEM, srcComponent=self.COMPONENT)
        self.heard = deque()
        # Simulated time of the vehicle, as far as it has been heard, ms.
        self.now_ms = None

    @property
    def address(self):
        return "127.0.0.1:%d" % self.socket.getsockname()[1]

    def close(self):
        self.socket.close()

    def write(self, data):
        self.socket.sendto(data, self.vehicle)

    def next(self):
        """The next message."""
        while not self.heard:
            datagram, self.vehicle = self.socket.recvfrom(65536)
            messages = self.mav.parse_buffer(datagram) or []
            length = sum(len(message.get_msgbuf()) for message in messages)
            assert length == len(datagram), "a datagram holds whole frames"
            self.heard.extend(messages)
        message = self.heard.popleft()
        self.now_ms = getattr(message, "time_boot_ms", self.now_ms)
        return message

    def wait(self, kind, condition=lambda message: True, within_ms=20_000):
        """The first message of a kind that meets a condition, within so much simulated time."""
        start = self.now_ms
        hang = time.monotonic() + HANG_S
        while True:
            message = self.next()
            start = self.now_ms if start is None else start
            if message.get_type() == kind and condition(message):
                return message
            assert time.monotonic() < hang, f"no such {kind} within {HANG_S} s of wall time"
            if start is not None and self.now_ms - start > within_ms:
                pytest.fail(f"no such {kind} within {within_ms} ms of simulated time")

    def collect(self, duration_ms):
        """All messages of a stretch of simulated time, each with the last time stamp heard before it."""
        if self.now_ms is None:
            self.wait("LOCAL_POSITION_NED")
        end = self.now_ms + duration_ms
        heard = []
        while self.now_ms < end:
            before = self.now_ms
            heard.append((before, self.next()))
        return heard

    def command_long(self, command, *params, target=(1, 1), confirmation=0):
        params = list(params) + [0.0] * (7 - len(params))
        self.mav.command_long_send(*target, command, confirmation, *params)

    def command_int(self, command, *params, target=(1, 1), frame=0):
        p1, p2, p3, p4 = list(params) + [0.0] * (4 - len(params))
        self.mav.command_int_send(*target, frame, command, 0, 0, p1, p2, p3, p4, 0, 0, 0.0)

    def ack(self, command, within_ms=500):
        """The result of a command; 500 ms is what clients wait before they repeat it."""
        message = self.wait("COMMAND_ACK", lambda ack: ack.command == command, within_ms)
        assert (message.target_system, message.target_component) == (self.SYSTEM, self.COMPONENT)
        return message.result


class Simulator:
    """`sim-host serve` as a process; lines written to it are its standard input."""

    def __init__(self, station, *arguments):
        command = [str(SIMULATOR), "serve", "--listen", "127.0.0.1:0", "--peer", station.address, *arguments]
        pipe = subprocess.PIPE
        self.process = subprocess.Popen(command, stdin=pipe, stdout=pipe, stderr=pipe, text=True, bufsize=1)

    def write(self, line):
        self.process.stdin.write(line + "\n")

    def says(self, text):
        """The next line of its standard output that holds a text."""
        for line in self.process.stdout:
            if text in line:
                return line
        pytest.fail(f"it ended without saying `{text}`")

    def end_input(self):
        self.process.stdin.close()
        self.process.stdin = None

    def is_running(self):
        return self.process.poll() is None

    def stop(self):
        self.process.terminate()
        self.process.communicate(timeout=10)


@pytest.fixture(scope="session")
def simulator_path():
    if not SIMULATOR.is_file():
        missing(f"no simulator at {SIMULATOR}: cargo build --release")
    return SIMULATOR


@pytest.fixture
def station():
    station = Station()
    yield station
    station.close()


@pytest.fixture
def vehicle(station, simulator_path):
    """A simulator of the scenario `field`, at five times real time, once it has aligned and may be armed."""
    simulator = Simulator(station, "--speed", "5")
    station.wait("HEARTBEAT")
    station.wait("LOCAL_POSITION_NED")
    station.wait("SYS_STATUS", lambda status: status.onboard_control_sensors_health & PREARM_CHECK, within_ms=10_000)
    yield simulator
    running = simulator.is_running()
    simulator.stop()
    assert running, "the simulator ended by itself"
