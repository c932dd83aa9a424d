"""The vehicle as a MAVLink client sees it, by pymavlink over UDP."""

import math
import random
import signal
import socket
import statistics
import subprocess

import pytest
from pymavlink.dialects.v20 import common as mavlink

from conftest import HANG_S, PREARM_CHECK, Simulator, Station

ARM_DISARM = mavlink.MAV_CMD_COMPONENT_ARM_DISARM
TAKEOFF = mavlink.MAV_CMD_NAV_TAKEOFF
LAND = mavlink.MAV_CMD_NAV_LAND
RETURN = mavlink.MAV_CMD_NAV_RETURN_TO_LAUNCH
SET_MODE = mavlink.MAV_CMD_DO_SET_MODE
CUSTOM = mavlink.MAV_MODE_FLAG_CUSTOM_MODE_ENABLED
AUTO, AUTO_TAKEOFF, AUTO_LOITER, AUTO_MISSION, AUTO_RTL, AUTO_LAND = 4, 2, 3, 4, 5, 6
FORCE = 21196
# Commands that exist in MAVLink and are not supported here.
UNSUPPORTED = [mavlink.MAV_CMD_DO_SET_SERVO, mavlink.MAV_CMD_NAV_WAYPOINT, mavlink.MAV_CMD_IMAGE_START_CAPTURE]
# A message that QGroundControl asks for and that there is none of.
COMPONENT_METADATA = 397
HOVER_Z_M = -2.0
# The vehicle is told its place by satellites, in wind: what it holds by its own account, and what its idea of it drifts by.
HELD_M = 0.3
GROUND_M = 0.5


def is_armed(heartbeat):
    return bool(heartbeat.base_mode & mavlink.MAV_MODE_FLAG_SAFETY_ARMED)


def arm(station):
    station.command_long(ARM_DISARM, 1)
    assert station.ack(ARM_DISARM) == mavlink.MAV_RESULT_ACCEPTED
    station.wait("HEARTBEAT", is_armed, within_ms=2_500)


def climb(station):
    arm(station)
    station.command_long(TAKEOFF, *[0] * 6, -HOVER_Z_M)
    assert station.ack(TAKEOFF) == mavlink.MAV_RESULT_ACCEPTED
    station.wait("LOCAL_POSITION_NED", lambda position: abs(position.z - HOVER_Z_M) < HELD_M)


def test_heartbeat_is_a_px4_quadrotors(vehicle, station):
    heartbeat = station.wait("HEARTBEAT")
    assert (heartbeat.get_srcSystem(), heartbeat.get_srcComponent()) == (1, 1)
    assert heartbeat.type == mavlink.MAV_TYPE_QUADROTOR
    assert heartbeat.autopilot == mavlink.MAV_AUTOPILOT_PX4
    assert heartbeat.base_mode & mavlink.MAV_MODE_FLAG_CUSTOM_MODE_ENABLED
    assert not is_armed(heartbeat)
    assert heartbeat.system_status == mavlink.MAV_STATE_STANDBY
    assert heartbeat.custom_mode >> 16 & 0xFF in range(1, 8), "a main mode of PX4"
    assert heartbeat.mavlink_version == 3


def test_heartbeat_comes_once_a_second(vehicle, station):
    times = [before for before, message in station.collect(8_000) if message.get_type() == "HEARTBEAT"]
    gaps = [b - a for a, b in zip(times, times[1:])]
    assert len(gaps) >= 5
    # The heartbeat itself has no time stamp: known to within the 50 ms between those of the position.
    assert all(abs(gap - 1000) <= 100 for gap in gaps), gaps


@pytest.mark.parametrize("kind", ["ATTITUDE", "LOCAL_POSITION_NED"])
def test_motion_comes_at_20_hz(vehicle, station, kind):
    times = [message.time_boot_ms for _, message in station.collect(4_000) if message.get_type() == kind]
    gaps = [b - a for a, b in zip(times, times[1:])]
    assert len(gaps) >= 75
    assert statistics.median(gaps) == 50
    # UDP may lose one; what comes is in step all the same.
    assert all(gap > 0 and gap % 50 == 0 for gap in gaps), gaps


def test_status_says_that_it_may_be_armed_and_is_on_the_ground(vehicle, station):
    status = station.wait("SYS_STATUS", lambda status: status.onboard_control_sensors_health & PREARM_CHECK)
    assert status.onboard_control_sensors_present & PREARM_CHECK
    assert (status.errors_count1, status.errors_count2, status.errors_count3, status.errors_count4) == (0, 0, 0, 0)
    state = station.wait("EXTENDED_SYS_STATE")
    assert state.landed_state == mavlink.MAV_LANDED_STATE_ON_GROUND


def test_arming_is_acknowledged_and_shows_in_the_heartbeat(vehicle, station):
    arm(station)
    heartbeat = station.wait("HEARTBEAT")
    assert is_armed(heartbeat) and heartbeat.system_status == mavlink.MAV_STATE_ACTIVE


def test_armed_it_stays_on_the_ground(vehicle, station):
    arm(station)
    for _, message in station.collect(3_000):
        if message.get_type() == "LOCAL_POSITION_NED":
            assert abs(message.z) < GROUND_M, message
        if message.get_type() == "EXTENDED_SYS_STATE":
            assert message.landed_state == mavlink.MAV_LANDED_STATE_ON_GROUND


def mode_of(heartbeat):
    return heartbeat.custom_mode >> 16 & 0xFF, heartbeat.custom_mode >> 24


def wait_mode(station, sub):
    station.wait("HEARTBEAT", lambda heartbeat: mode_of(heartbeat) == (AUTO, sub))


def test_it_lands_and_disarms_by_itself(vehicle, station):
    climb(station)
    station.command_long(LAND)
    assert station.ack(LAND) == mavlink.MAV_RESULT_ACCEPTED
    wait_mode(station, AUTO_LAND)
    station.wait("HEARTBEAT", lambda heartbeat: not is_armed(heartbeat))
    assert abs(station.wait("LOCAL_POSITION_NED").z) < GROUND_M


def test_modes_are_set_as_px4s_are(vehicle, station):
    arm(station)
    for sub in (AUTO_TAKEOFF, AUTO_LOITER, AUTO_MISSION, AUTO_LOITER, AUTO_RTL):
        station.command_long(SET_MODE, CUSTOM, AUTO, sub)
        assert station.ack(SET_MODE) == mavlink.MAV_RESULT_ACCEPTED, sub
        wait_mode(station, sub)
        if sub == AUTO_TAKEOFF:
            station.wait("LOCAL_POSITION_NED", lambda position: position.z < -1)
    # By sticks, of which there are none; and a main mode that does not exist.
    station.command_long(SET_MODE, CUSTOM, 1, 0)
    assert station.ack(SET_MODE) == mavlink.MAV_RESULT_TEMPORARILY_REJECTED
    station.command_long(SET_MODE, CUSTOM, 9, 0)
    assert station.ack(SET_MODE) == mavlink.MAV_RESULT_DENIED


def test_disarmed_it_does_not_fly(vehicle, station):
    station.command_long(RETURN)
    assert station.ack(RETURN) == mavlink.MAV_RESULT_TEMPORARILY_REJECTED
    assert "disarmed" in station.wait("STATUSTEXT", within_ms=500).text
    for command in (TAKEOFF, LAND):
        station.command_long(command, *[0] * 6, 2)
        assert station.ack(command) == mavlink.MAV_RESULT_ACCEPTED
    for _, message in station.collect(3_000):
        if message.get_type() == "HEARTBEAT":
            assert not is_armed(message)
        if message.get_type() == "LOCAL_POSITION_NED":
            assert abs(message.z) < GROUND_M, message


def test_a_take_off_before_arming_is_flown_when_armed(vehicle, station):
    # As QGroundControl does: it arms after the answer, and looks for the mode in the heartbeat.
    station.command_long(TAKEOFF, *[0] * 6, -HOVER_Z_M)
    assert station.ack(TAKEOFF) == mavlink.MAV_RESULT_ACCEPTED
    wait_mode(station, AUTO_TAKEOFF)
    arm(station)
    station.wait("LOCAL_POSITION_NED", lambda position: abs(position.z - HOVER_Z_M) < HELD_M)


def test_a_later_arming_does_not_launch_it(vehicle, station):
    station.command_long(TAKEOFF, *[0] * 6, -HOVER_Z_M)
    assert station.ack(TAKEOFF) == mavlink.MAV_RESULT_ACCEPTED
    station.collect(6_000)
    test_armed_it_stays_on_the_ground(vehicle, station)


def test_a_mode_may_be_set_before_arming(vehicle, station):
    station.command_long(SET_MODE, CUSTOM, AUTO, AUTO_LOITER)
    assert station.ack(SET_MODE) == mavlink.MAV_RESULT_ACCEPTED
    wait_mode(station, AUTO_LOITER)
    test_armed_it_stays_on_the_ground(vehicle, station)


def test_a_take_off_without_sense_is_denied(vehicle, station):
    arm(station)
    for height in (-1, 0, 1e6, math.inf):
        station.command_long(TAKEOFF, *[0] * 6, height)
        assert station.ack(TAKEOFF) == mavlink.MAV_RESULT_DENIED, height


def test_it_climbs_to_two_metres_and_holds(vehicle, station):
    ground = station.wait("LOCAL_POSITION_NED")
    assert math.dist((ground.x, ground.y, ground.z), (0, 0, 0)) < GROUND_M
    climb(station)
    state = station.wait("EXTENDED_SYS_STATE", within_ms=1_500)
    assert state.landed_state == mavlink.MAV_LANDED_STATE_IN_AIR
    # The climb may overshoot; two seconds later it is to have settled, where it has come to rest.
    station.collect(2_000)
    start = station.wait("LOCAL_POSITION_NED")
    for _, message in station.collect(3_000):
        if message.get_type() == "LOCAL_POSITION_NED":
            assert math.dist((message.x, message.y), (start.x, start.y)) < HELD_M, message
            assert abs(message.z - (ground.z + HOVER_Z_M)) < 0.5, message
        if message.get_type() == "ATTITUDE":
            # It leans into the wind and its gusts.
            assert abs(message.roll) < 0.2 and abs(message.pitch) < 0.2, message


def test_disarming_in_the_air_is_refused_with_a_reason(vehicle, station):
    climb(station)
    station.command_long(ARM_DISARM, 0)
    assert station.ack(ARM_DISARM) == mavlink.MAV_RESULT_TEMPORARILY_REJECTED
    assert "in the air" in station.wait("STATUSTEXT", within_ms=500).text
    assert is_armed(station.wait("HEARTBEAT"))


def test_forced_disarming_in_the_air_is_done(vehicle, station):
    climb(station)
    station.command_long(ARM_DISARM, 0, FORCE)
    assert station.ack(ARM_DISARM) == mavlink.MAV_RESULT_ACCEPTED
    assert not is_armed(station.wait("HEARTBEAT"))


def test_disarming_on_the_ground_is_accepted_in_either_form(vehicle, station):
    station.command_long(ARM_DISARM, 0, math.nan, target=(1, 0))
    assert station.ack(ARM_DISARM) == mavlink.MAV_RESULT_ACCEPTED
    station.command_int(ARM_DISARM, 0, math.nan)
    assert station.ack(ARM_DISARM) == mavlink.MAV_RESULT_ACCEPTED


@pytest.mark.parametrize("param1", [math.nan, 0.5, 7.0])
def test_neither_arming_nor_disarming_is_denied(vehicle, station, param1):
    station.command_long(ARM_DISARM, param1)
    assert station.ack(ARM_DISARM) == mavlink.MAV_RESULT_DENIED


@pytest.mark.parametrize("form", ["command_long", "command_int"])
def test_unsupported_commands_are_answered(vehicle, station, form):
    for command in [*UNSUPPORTED, 65535]:
        getattr(station, form)(command, math.nan)
        assert station.ack(command) == mavlink.MAV_RESULT_UNSUPPORTED, command


def test_mavlink_1_is_understood(vehicle, station):
    message = station.mav.command_long_encode(1, 1, UNSUPPORTED[0], 0, 0, 0, 0, 0, 0, 0, 0)
    station.write(message.pack(station.mav, force_mavlink1=True))
    assert station.ack(UNSUPPORTED[0]) == mavlink.MAV_RESULT_UNSUPPORTED


def test_commands_for_others_are_ignored(vehicle, station):
    theirs, ours = UNSUPPORTED[0], UNSUPPORTED[1]
    for target in [(2, 1), (1, 2), (255, 190)]:
        station.command_long(theirs, target=target)
    station.command_long(ours, target=(0, 0))
    acks = [message.command for _, message in station.collect(1_000) if message.get_type() == "COMMAND_ACK"]
    assert acks == [ours]


def test_messages_come_on_request(vehicle, station):
    station.command_long(mavlink.MAV_CMD_REQUEST_MESSAGE, mavlink.MAVLINK_MSG_ID_AUTOPILOT_VERSION, math.nan)
    assert station.ack(mavlink.MAV_CMD_REQUEST_MESSAGE) == mavlink.MAV_RESULT_ACCEPTED
    version = station.wait("AUTOPILOT_VERSION", within_ms=500)
    bits = ["COMMAND_INT", "PARAM_ENCODE_BYTEWISE", "MAVLINK2"]
    capabilities = sum(getattr(mavlink, f"MAV_PROTOCOL_CAPABILITY_{bit}") for bit in bits)
    assert version.capabilities == capabilities
    station.command_long(mavlink.MAV_CMD_REQUEST_MESSAGE, COMPONENT_METADATA)
    assert station.ack(mavlink.MAV_CMD_REQUEST_MESSAGE) == mavlink.MAV_RESULT_UNSUPPORTED


def test_intervals_can_be_set_and_given_back(vehicle, station):
    for interval_us, gap_ms in [(100_000, 100), (0, 50)]:
        station.command_long(mavlink.MAV_CMD_SET_MESSAGE_INTERVAL, mavlink.MAVLINK_MSG_ID_ATTITUDE, interval_us)
        assert station.ack(mavlink.MAV_CMD_SET_MESSAGE_INTERVAL) == mavlink.MAV_RESULT_ACCEPTED
        times = [m.time_boot_ms for _, m in station.collect(2_000) if m.get_type() == "ATTITUDE"]
        assert statistics.median(b - a for a, b in zip(times[1:], times[2:])) == gap_ms
    station.command_long(mavlink.MAV_CMD_SET_MESSAGE_INTERVAL, mavlink.MAVLINK_MSG_ID_ATTITUDE, -1)
    assert station.ack(mavlink.MAV_CMD_SET_MESSAGE_INTERVAL) == mavlink.MAV_RESULT_ACCEPTED
    assert all(message.get_type() != "ATTITUDE" for _, message in station.collect(500)[10:])


def test_there_is_no_mission_and_it_says_so(vehicle, station):
    for mission_type in (0, 1, 2):
        station.mav.mission_request_list_send(1, 1, mission_type)
        count = station.wait("MISSION_COUNT", lambda m: m.mission_type == mission_type, within_ms=500)
        assert (count.count, count.target_system) == (0, station.SYSTEM)


def test_time_is_told(vehicle, station):
    station.mav.timesync_send(0, 123_456_789)
    answer = station.wait("TIMESYNC", within_ms=500)
    assert answer.ts1 == 123_456_789
    assert abs(answer.tc1 / 1e6 - station.now_ms) < 500


def test_garbage_is_survived(vehicle, station):
    generator = random.Random(1)
    for _ in range(50):
        station.write(generator.randbytes(generator.randrange(1, 300)))
        station.write(bytes([0xFD, 255, 0, 0]) * 20)
    # The longest thing that the garbage may look like the beginning of is given up after 100 ms each.
    station.collect(3_000)
    station.command_long(UNSUPPORTED[0])
    assert station.ack(UNSUPPORTED[0]) == mavlink.MAV_RESULT_UNSUPPORTED
    assert not is_armed(station.wait("HEARTBEAT"))


def test_a_repeated_command_is_answered_again_and_changes_nothing(vehicle, station):
    climb(station)
    wait_mode(station, AUTO_LOITER)
    station.collect(2_000)
    for _ in range(3):
        station.command_long(ARM_DISARM, 1, confirmation=0)
        assert station.ack(ARM_DISARM) == mavlink.MAV_RESULT_ACCEPTED
    # Had the flight begun anew, it would be on its way to the ground.
    for _, message in station.collect(1_000):
        if message.get_type() == "LOCAL_POSITION_NED":
            assert abs(message.z - HOVER_Z_M) < 0.5


SENSORS = {
    name: getattr(mavlink, f"MAV_SYS_STATUS_SENSOR_{name}")
    for name in ("3D_GYRO", "3D_ACCEL", "3D_MAG", "ABSOLUTE_PRESSURE", "GPS", "BATTERY")
}


def test_the_sensors_and_the_battery_are_told(vehicle, station):
    status = station.wait("SYS_STATUS")
    for name, bit in SENSORS.items():
        assert status.onboard_control_sensors_present & bit, name
        assert status.onboard_control_sensors_health & bit, name
    # Four cells, full, and little is drawn from them.
    assert 16_000 < status.voltage_battery < 17_000
    assert 0 <= status.current_battery < 500
    assert 50 < status.battery_remaining <= 100, "by the voltage of its four cells at rest"


def test_the_estimator_tells_what_it_knows(vehicle, station):
    times = [m.time_usec for _, m in station.collect(5_000) if m.get_type() == "ESTIMATOR_STATUS"]
    assert len(times) >= 4 and all(b - a == 1_000_000 for a, b in zip(times, times[1:])), times
    status = station.wait("ESTIMATOR_STATUS")
    known = mavlink.ESTIMATOR_ATTITUDE | mavlink.ESTIMATOR_VELOCITY_HORIZ | mavlink.ESTIMATOR_VELOCITY_VERT
    assert status.flags == known | mavlink.ESTIMATOR_POS_HORIZ_REL | mavlink.ESTIMATOR_POS_HORIZ_ABS
    ratios = (status.vel_ratio, status.pos_horiz_ratio, status.pos_vert_ratio, status.mag_ratio)
    assert all(0 <= ratio < 1 for ratio in ratios), ratios
    assert 0 < status.pos_horiz_accuracy < 1 and 0 < status.pos_vert_accuracy < 1


def inject(station, unit, failure, instance=0):
    station.command_long(mavlink.MAV_CMD_INJECT_FAILURE, unit, failure, instance)
    return station.ack(mavlink.MAV_CMD_INJECT_FAILURE)


def gps_is_healthy(status):
    return bool(status.onboard_control_sensors_health & SENSORS["GPS"])


def test_without_satellites_it_lands(vehicle, station):
    climb(station)
    assert inject(station, mavlink.FAILURE_UNIT_SENSOR_GPS, mavlink.FAILURE_TYPE_OFF) == mavlink.MAV_RESULT_ACCEPTED
    station.wait("SYS_STATUS", lambda status: not gps_is_healthy(status), within_ms=3_000)
    station.wait("STATUSTEXT", lambda text: "osition estimate lost" in text.text, within_ms=10_000)
    station.wait("HEARTBEAT", lambda heartbeat: not is_armed(heartbeat), within_ms=60_000)
    # Where it is across the ground is unknown and not told; its height is.
    assert abs(station.wait("ALTITUDE").altitude_local) < 1
    assert all(message.get_type() != "LOCAL_POSITION_NED" for _, message in station.collect(2_000))
    assert inject(station, mavlink.FAILURE_UNIT_SENSOR_GPS, mavlink.FAILURE_TYPE_OK) == mavlink.MAV_RESULT_ACCEPTED
    station.wait("SYS_STATUS", gps_is_healthy, within_ms=10_000)


def test_failures_that_nothing_can_make_are_not_acknowledged(vehicle, station):
    for unit, failure in [
        (mavlink.FAILURE_UNIT_SYSTEM_SERVO, mavlink.FAILURE_TYPE_OFF),
        (mavlink.FAILURE_UNIT_SENSOR_MAG, mavlink.FAILURE_TYPE_SLOW),
        (mavlink.FAILURE_UNIT_SYSTEM_MOTOR, mavlink.FAILURE_TYPE_STUCK),
    ]:
        assert inject(station, unit, failure) == mavlink.MAV_RESULT_UNSUPPORTED, (unit, failure)
    off = mavlink.FAILURE_TYPE_OFF
    assert inject(station, mavlink.FAILURE_UNIT_SYSTEM_MOTOR, off, 5) == mavlink.MAV_RESULT_DENIED
    assert inject(station, math.nan, off) == mavlink.MAV_RESULT_DENIED


def test_an_empty_battery_brings_it_home(vehicle, station):
    climb(station)
    assert inject(station, mavlink.FAILURE_UNIT_SYSTEM_BATTERY, mavlink.FAILURE_TYPE_OFF) == mavlink.MAV_RESULT_ACCEPTED
    station.wait("STATUSTEXT", lambda text: "Battery low" in text.text, within_ms=5_000)
    station.wait("SYS_STATUS", lambda status: status.voltage_battery < 14_000, within_ms=1_000)
    station.wait("HEARTBEAT", lambda heartbeat: not is_armed(heartbeat), within_ms=60_000)


def test_faults_are_taken_in_lines(vehicle, station):
    vehicle.write("fault sensor=gnss kind=off")
    vehicle.says("fault: gnss off")
    station.wait("SYS_STATUS", lambda status: not gps_is_healthy(status), within_ms=3_000)
    vehicle.write("faults")
    vehicle.says("fault sensor=gnss kind=off")
    vehicle.write("clear")
    vehicle.says("no faults: 1 cleared")
    station.wait("SYS_STATUS", gps_is_healthy, within_ms=10_000)
    vehicle.write("fault sensor=gps kind=off")
    vehicle.says("there is no sensor `gps`")
    vehicle.end_input()
    station.collect(1_000)


def test_what_a_ground_station_does_is_printed(vehicle, station):
    climb(station)
    vehicle.says("ground station 255 connected from " + station.address)
    vehicle.says("ground station 255: arm: accepted")
    vehicle.says("armed")
    vehicle.says("ground station 255: take-off to 2 m: accepted")
    vehicle.write("land")
    vehicle.says("land: accepted")
    vehicle.says("landed: touched down at 0.")
    vehicle.says("disarmed")


@pytest.mark.parametrize("end, code", [("quit", 0), (signal.SIGINT, 130)])
def test_it_ends_in_order_and_says_how_long_was_flown(station, simulator_path, end, code):
    simulator = Simulator(station)
    station.wait("HEARTBEAT")
    if end == "quit":
        simulator.write(end)
    else:
        simulator.process.send_signal(end)
    _, told = simulator.process.communicate(timeout=HANG_S)
    assert simulator.process.returncode == code
    assert "x real time" in told.strip().splitlines()[-1]


def test_two_stations_are_both_served(vehicle, station):
    """The second one is not among the peers: it is answered because it has spoken."""
    station.wait("HEARTBEAT")
    second = Station()
    try:
        second.vehicle = station.vehicle
        second.command_long(UNSUPPORTED[0])
        assert second.ack(UNSUPPORTED[0], within_ms=1_000) == mavlink.MAV_RESULT_UNSUPPORTED
        station.wait("HEARTBEAT")
    finally:
        second.close()


def test_a_busy_port_is_one_line_and_exit_code_2(simulator_path):
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as busy:
        busy.bind(("127.0.0.1", 0))
        address = "127.0.0.1:%d" % busy.getsockname()[1]
        done = subprocess.run(
            [str(simulator_path), "serve", "--listen", address, "--peer", "127.0.0.1:9"],
            capture_output=True,
            text=True,
            timeout=HANG_S,
        )
    assert done.returncode == 2
    assert address in done.stderr and "--listen" in done.stderr
    assert len(done.stderr.strip().splitlines()) == 1, done.stderr


def test_what_it_knows_of_its_place_is_told(vehicle, station):
    """On the map: home and place before arming, in the units and frames of the protocol, well above the sea."""
    home = station.wait("HOME_POSITION")
    place = station.wait("GLOBAL_POSITION_INT")
    # A centimetre is 1e-7 degrees; the receiver's first fix is some metres off.
    for told, true in [(home.latitude, 473_977_000), (home.longitude, 85_456_000)]:
        assert abs(told - true) < 1_000, home
    assert abs(home.altitude - 488_000) < 8_000, home
    assert abs(place.lat - home.latitude) < 100 and abs(place.alt - home.altitude) < 1_000, (place, home)
    assert abs(place.relative_alt) < 1_000, place
    gps = station.wait("GPS_RAW_INT")
    assert (gps.fix_type, gps.alt) == (mavlink.GPS_FIX_TYPE_3D_FIX, gps.alt_ellipsoid), gps
    # 2026-01-01, noon.
    assert station.wait("SYSTEM_TIME").time_unix_usec // 1_000_000 - 1_767_268_800 in range(0, 600)


def test_a_ping_is_answered(vehicle, station):
    station.mav.ping_send(123_456, 7, 0, 0)
    answer = station.wait("PING", within_ms=500)
    assert (answer.seq, answer.time_usec, answer.target_system) == (7, 123_456, station.SYSTEM)
