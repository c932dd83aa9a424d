"""`serve` with several vehicles, another system number, and a ground station over TCP."""

import time

from pymavlink import mavutil
from pymavlink.dialects.v20 import common as mavlink

from conftest import HANG_S, PREARM_CHECK, Simulator, Station

TAKEOFF_HEIGHT_M = 3.0


def until(condition, step):
    hang = time.monotonic() + HANG_S
    while not condition():
        assert time.monotonic() < hang, f"not within {HANG_S} s"
        step()


def test_two_vehicles_are_two_systems_and_each_obeys_for_itself(station, simulator_path):
    simulator = Simulator(station, "--vehicles", "2", "--sysid", "7", "--speed", "5")
    try:
        addresses, ready, highest = {}, set(), {7: 0.0, 8: 0.0}

        def hear():
            message = station.next()
            system = message.get_srcSystem()
            addresses[system] = station.vehicle
            if message.get_type() == "SYS_STATUS" and message.onboard_control_sensors_health & PREARM_CHECK:
                ready.add(system)
            if message.get_type() == "LOCAL_POSITION_NED":
                highest[system] = max(highest[system], -message.z)

        until(lambda: ready == {7, 8}, hear)
        assert addresses[7] != addresses[8], "each has a port of its own"
        for command, *params in [
            (mavlink.MAV_CMD_COMPONENT_ARM_DISARM, 1),
            (mavlink.MAV_CMD_NAV_TAKEOFF, 0, 0, 0, 0, 0, 0, TAKEOFF_HEIGHT_M),
        ]:
            station.vehicle = addresses[8]
            station.command_long(command, *params, target=(8, 1))
            until(lambda: station.next().get_type() == "COMMAND_ACK", lambda: None)
        until(lambda: highest[8] > 0.9 * TAKEOFF_HEIGHT_M, hear)
        assert highest[7] < 0.5, "the other has stayed on the ground"
    finally:
        simulator.stop()


def test_a_ground_station_connects_over_tcp(station, simulator_path):
    simulator = Simulator(station, "--tcp", "127.0.0.1:0", "--speed", "2")
    try:
        line = ""
        while "by TCP to" not in line:
            line = simulator.process.stderr.readline()
            assert line, "it ended"
        address = line.split("by TCP to ")[1].strip().rstrip(".")
        vehicle = mavutil.mavlink_connection(f"tcp:{address}")
        assert vehicle.wait_heartbeat(timeout=HANG_S).autopilot == mavlink.MAV_AUTOPILOT_PX4
        vehicle.mav.command_long_send(1, 1, mavlink.MAV_CMD_REQUEST_MESSAGE, 0, mavlink.MAVLINK_MSG_ID_AUTOPILOT_VERSION, *[0] * 6)
        answer = vehicle.recv_match(type="COMMAND_ACK", blocking=True, timeout=HANG_S)
        assert answer and answer.result == mavlink.MAV_RESULT_ACCEPTED
        assert vehicle.recv_match(type="AUTOPILOT_VERSION", blocking=True, timeout=HANG_S)
        vehicle.close()
    finally:
        simulator.stop()
