"""The RTIC image in QEMU: it boots, speaks MAVLink on its UART, and both loops keep their rates.

The image measures its loops with a timer of the simulated board, and QEMU's time is counted in instructions
(-icount), so neither depends on how busy the machine is.
"""

import os
import re
import shutil
import socket
import struct
import subprocess
import time
from pathlib import Path

import pytest
from pymavlink.dialects.v20 import common as mavlink

from conftest import HANG_S, ROOT, missing

IMAGE = Path(os.environ.get("GLISSADE_IMAGE", ROOT / "target/thumbv7em-none-eabihf/image/mps2"))
QEMU = "qemu-system-arm"
# Of ELF.
SHT_NOBITS = 8
SHF_WRITE, SHF_ALLOC = 1, 2


class Board:
    """The image at work, and the other end of its UART."""

    def __init__(self, log):
        with socket.create_server(("127.0.0.1", 0)) as server:
            server.settimeout(HANG_S)
            port = server.getsockname()[1]
            self.process = subprocess.Popen(
                [
                    QEMU, "-M", "mps2-an386", "-kernel", str(IMAGE), "-icount", "shift=3,sleep=off",
                    "-display", "none", "-monitor", "none", "-serial", f"tcp:127.0.0.1:{port},nodelay=on",
                    "-semihosting-config", "enable=on,target=native",
                ],
                stdin=subprocess.DEVNULL,
                stdout=log,
                stderr=subprocess.STDOUT,
            )
            try:
                self.uart, _ = server.accept()
            except TimeoutError:
                self.process.kill()
                raise
        self.uart.settimeout(HANG_S)
        self.mav = mavlink.MAVLink(None, srcSystem=255, srcComponent=190)
        # The line may begin in the middle of a frame.
        self.mav.robust_parsing = True

    def messages(self):
        end = time.monotonic() + HANG_S
        while time.monotonic() < end:
            data = self.uart.recv(4096)
            assert data, "the image ended by itself"
            yield from self.mav.parse_buffer(data) or []
        pytest.fail(f"not heard within {HANG_S} s")

    def wait(self, condition):
        return next(message for message in self.messages() if condition(message))

    def send(self, message):
        self.uart.sendall(message.pack(self.mav))

    def stop(self):
        self.uart.close()
        self.process.kill()
        self.process.wait()


@pytest.fixture(scope="module")
def board(tmp_path_factory):
    if shutil.which(QEMU) is None:
        missing(f"{QEMU} is not installed")
    if not IMAGE.is_file():
        missing(f"no image at {IMAGE}: cargo fw")
    with open(tmp_path_factory.mktemp("qemu") / "log", "wb") as log:
        board = Board(log)
        yield board
        board.stop()


def loop_timing(board, name):
    return board.wait(lambda m: m.get_type() == "NAMED_VALUE_INT" and m.name == name).value


def sizes(elf):
    """What `size` has of an image of 32 bits: text and bss, B."""
    (table,), (entry, count) = struct.unpack_from("<I", elf, 32), struct.unpack_from("<HH", elf, 46)
    sections = [struct.unpack_from("<10I", elf, table + entry * number) for number in range(count)]
    loaded = [(kind, flags, size) for _, kind, flags, _, _, size, *_ in sections if flags & SHF_ALLOC]
    text = sum(size for _, flags, size in loaded if not flags & SHF_WRITE)
    return text, sum(size for kind, _, size in loaded if kind == SHT_NOBITS)


def test_the_manual_has_the_size_of_the_image():
    if not IMAGE.is_file():
        missing(f"no image at {IMAGE}: cargo fw")
    row = re.search(r"image/mps2` \| ([\d,]+) B and ([\d,]+) B", (ROOT / "docs/results.md").read_text(encoding="utf-8"))
    told = [int(number.replace(",", "")) for number in row.groups()]
    # Compilers differ, and small changes need no new row.
    for is_now, was in zip(sizes(IMAGE.read_bytes()), told):
        assert abs(is_now - was) <= 0.05 * was, f"docs/results.md has {was} B, and it is {is_now} B"


def test_it_boots_and_says_who_it_is(board):
    heartbeat = board.wait(lambda message: message.get_type() == "HEARTBEAT")
    assert (heartbeat.get_srcSystem(), heartbeat.get_srcComponent()) == (1, 1)
    assert (heartbeat.type, heartbeat.autopilot) == (mavlink.MAV_TYPE_QUADROTOR, mavlink.MAV_AUTOPILOT_PX4)
    assert not heartbeat.base_mode & mavlink.MAV_MODE_FLAG_SAFETY_ARMED


def test_both_loops_hold_their_rates(board):
    for _ in range(3):
        assert abs(loop_timing(board, "inner_hz") - 1000) <= 1
        assert abs(loop_timing(board, "outer_hz") - 250) <= 1


def test_no_job_overruns(board):
    status = board.wait(lambda message: message.get_type() == "SYS_STATUS")
    assert (status.errors_count2, status.errors_count3, status.errors_count4) == (0, 0, 0)


def result_of(board, command, param1=0):
    board.send(board.mav.command_long_encode(1, 1, command, 0, param1, 0, 0, 0, 0, 0, 0))
    return board.wait(lambda message: message.get_type() == "COMMAND_ACK" and message.command == command).result


def test_unsupported_commands_are_answered(board):
    assert result_of(board, mavlink.MAV_CMD_DO_SET_SERVO) == mavlink.MAV_RESULT_UNSUPPORTED


def test_it_arms_and_disarms(board):
    for armed in (1, 0):
        assert result_of(board, mavlink.MAV_CMD_COMPONENT_ARM_DISARM, armed) == mavlink.MAV_RESULT_ACCEPTED
        flag = armed * mavlink.MAV_MODE_FLAG_SAFETY_ARMED
        board.wait(
            lambda message: message.get_type() == "HEARTBEAT"
            and message.base_mode & mavlink.MAV_MODE_FLAG_SAFETY_ARMED == flag
        )
