"""`serve --keys` on a terminal of its own: keys fly, a typed line is executed, and the terminal is left as it was."""

import os
import pty
import re
import select
import signal
import subprocess
import termios
import time

import pytest

from conftest import HANG_S

ESCAPE = "\x1b"
CTRL_C, CTRL_Z = "\x03", "\x1a"


class Desk:
    """`serve --keys` as the foreground process of a pseudo-terminal."""

    def __init__(self, path, *arguments):
        self.master, self.slave = pty.openpty()
        self.before = self.settings()
        command = [str(path), "serve", "--listen", "127.0.0.1:0", "--peer", "127.0.0.1:9", "--keys", *arguments]
        terminal = dict(stdin=self.slave, stdout=self.slave, stderr=self.slave, start_new_session=True)
        environment = {**os.environ, "TERM": "xterm"}
        # Only its controlling terminal sends a process Ctrl-C and Ctrl-Z: the first that a leader of a session opens.
        name = os.ttyname(self.slave)
        own = ["sh", "-c", 'exec "$@" <"$0" >"$0" 2>&1', name, *command]
        self.process = subprocess.Popen(own, env=environment, **terminal)
        self.text = ""

    def settings(self):
        return termios.tcgetattr(self.slave)

    def is_as_before(self):
        return self.settings() == self.before

    def reads_keys(self):
        """Whether echo and line editing are off."""
        return self.settings()[3] & (termios.ECHO | termios.ICANON) == 0

    def press(self, keys):
        os.write(self.master, keys.encode())

    def listen(self):
        """Takes what it prints, without the sequences that draw the typed line."""
        if select.select([self.master], [], [], 0.05)[0]:
            self.text += os.read(self.master, 65536).decode(errors="replace")

    def says(self, pattern):
        """Waits until it has printed something since the last call."""
        self.until(lambda: re.search(pattern, self.text), f"`{pattern}`")
        self.text = self.text[re.search(pattern, self.text).end() :]

    def until(self, condition, what):
        start = time.monotonic()
        while not condition():
            self.listen()
            assert time.monotonic() < start + HANG_S, f"it never came to {what}, but said:\n{self.text}"

    def end(self):
        """Waits for the end; returns the exit code."""
        self.until(lambda: self.process.poll() is not None, "an end")
        return self.process.returncode

    def state(self):
        """What the process does, as Linux has it: T is stopped."""
        with open(f"/proc/{self.process.pid}/stat", encoding="ascii") as stat:
            return stat.read().rsplit(")", 1)[1].split()[0]

    def close(self):
        if self.process.poll() is None:
            self.process.kill()
            self.process.wait()
        os.close(self.master)
        os.close(self.slave)


@pytest.fixture
def desk(simulator_path, tmp_path):
    desk = Desk(simulator_path, "--speed", "5", "--record", str(tmp_path / "flight.txt"))
    desk.until(desk.reads_keys, "reading keys")
    yield desk
    desk.close()


@pytest.mark.parametrize(
    "keys, number, code",
    [("Q", None, 0), (CTRL_C, None, 130), (CTRL_C + CTRL_C, None, 130), (":quit\r", None, 0)]
    + [("", number, 128 + number) for number in (signal.SIGTERM, signal.SIGHUP, signal.SIGQUIT)],
)
def test_the_terminal_is_as_before_however_it_ends(desk, keys, number, code):
    desk.press(keys)
    if number:
        desk.process.send_signal(number)
    assert desk.end() == code
    assert desk.is_as_before()


def test_the_terminal_is_as_before_while_ctrl_z_stops_it(desk):
    desk.press(CTRL_Z)
    desk.until(lambda: desk.state() == "T", "a stop")
    assert desk.is_as_before()
    desk.process.send_signal(signal.SIGCONT)
    desk.until(desk.reads_keys, "reading keys again")
    desk.press("Q")
    assert desk.end() == 0 and desk.is_as_before()


def test_keys_ask_and_a_colon_begins_a_line(desk, simulator_path, tmp_path):
    desk.says(r"\] ready to arm")
    desk.press("m")
    desk.says("pilot: arm: accepted")
    desk.press(":takeoff 2\r")
    desk.says("] take-off to 2 m: accepted")
    desk.says("in the air")
    # What is left is not executed, and an arrow within it is no stick; then keys fly again.
    desk.press(":kill")
    desk.says(":kill")
    desk.press(ESCAPE)
    desk.says("keys fly")
    desk.press("5wa\x1b[A")
    desk.says("pilot: hold: accepted")
    desk.press("?")
    desk.says("all sticks to the middle")
    desk.press(":status\r")
    desk.says("hold, in the air")
    desk.press("7")
    desk.says("pilot: land: accepted")
    desk.press("K")
    desk.says("pilot: kill: accepted")
    desk.press("Q")
    assert desk.end() == 0
    recording = tmp_path / "flight.txt"
    assert recording.read_text(encoding="utf-8").splitlines()[-1].endswith(" end")
    again = subprocess.run([simulator_path, "run", "field", "--replay", recording], capture_output=True, text=True)
    assert again.returncode in (0, 1), again.stderr


def test_without_a_terminal_keys_are_refused_in_a_line(simulator_path):
    run = subprocess.run([simulator_path, "serve", "--keys"], stdin=subprocess.DEVNULL, capture_output=True, text=True)
    assert run.returncode == 2
    remedy = "--keys needs a terminal, and standard input is none: leave it out, and type lines"
    assert run.stderr == f"sim-host: {remedy}\n"
