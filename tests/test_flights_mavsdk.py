"""Whole flights by MAVSDK, call by call as its own examples make them, on one vehicle that lands after each.

Only waiting differs: the examples sleep, by the wall clock; here the simulator's truth is waited for. MAVSDK repeats
set-points by itself, 20 times a second of the wall clock, and waits half a second for an answer, three times.
"""

import asyncio
import importlib
import itertools
import math
import os
import platform
import socket
import statistics

import pytest

from conftest import HANG_S, Simulator
from flight import ENDLESS, HEIGHT_M, MOVED_M, NEAR_M, Observer, place, turn
from test_mavsdk import CALL_S, CONNECT_S, Grpc, Native, Pilot, free_port

# Of `field`'s x500, and of a set-point's scale: half the thrust hovers.
HOVER_THRUST = 0.5
TAKEOFF_M = 2.5
SPEED = "10"


class Flyer(Pilot):
    """A pilot who flies, and whose waiting is done by who knows the truth."""

    def __init__(self, sdk):
        super().__init__(sdk, Observer(), SPEED, *ENDLESS)
        package = {"Grpc": "mavsdk_grpc", "Native": "mavsdk.asyncio.plugins"}[type(sdk).__name__]
        # Set-points and sticks, as the two packages name them alike.
        self.types = importlib.import_module(f"{package}.offboard")
        self.true = self.raw
        os.set_blocking(self.simulator.process.stdout.fileno(), False)
        # A busy machine delays what comes by the wall clock; at a multiple of real time the vehicle would miss it.
        for name, seconds in (("COM_OF_LOSS_T", 10.0), ("COM_RC_LOSS_T", 10.0)):
            self.do(sdk.param.set_param_float(name, seconds))
        self.wait("health_all_ok", bool)

    def call(self, plugin, name, *arguments):
        return self.do(getattr(getattr(self.sdk, plugin), name)(*arguments))

    def act(self, name, *arguments):
        return self.call("action", name, *arguments)

    def aim(self, name, kind, *values):
        """Gives a set-point, which MAVSDK repeats."""
        return self.call("offboard", f"set_{name}", getattr(self.types, kind)(*values))

    def wait_mode(self, name):
        self.wait("flight_mode", lambda mode: mode.name == name)

    async def call_and_see(self, call, name):
        """Makes a call and waits for a mode that may be over when the call returns."""
        seen = asyncio.Event()

        def look(mode):
            seen.set()
            return mode.name == name

        looking = asyncio.ensure_future(self.first("flight_mode", look))
        await seen.wait()
        await call()
        return await looking

    def take_off(self):
        """Arms and takes off; what is true before it does."""
        start = self.true.now()
        self.act("arm")
        mode = self.do(self.call_and_see(self.sdk.action.takeoff, "TAKEOFF"), 2 * CALL_S)
        assert not isinstance(mode, AssertionError), mode
        self.true.until(lambda truth: truth.up > TAKEOFF_M - HEIGHT_M and abs(truth.v_up) < 0.2, "hovering")
        return start

    def start_offboard(self):
        self.call("offboard", "start")
        self.wait_mode("OFFBOARD")

    def stop_offboard(self):
        self.call("offboard", "stop")
        self.wait_mode("HOLD")

    def land(self):
        self.act("land")
        return self.wait_down()

    def wait_down(self):
        landed = self.true.wait_landed()
        self.wait("armed", lambda armed: not armed)
        self.wait("landed_state", lambda state: state.name == "ON_GROUND")
        return landed

    def stream(self, send, condition, what):
        """Calls something again and again until something is true."""

        async def repeat():
            while True:
                await send()
                await asyncio.sleep(0.02)

        async def both():
            repeating = asyncio.ensure_future(repeat())
            try:
                return await asyncio.to_thread(self.true.until, condition, what)
            finally:
                repeating.cancel()

        return self.do(both(), HANG_S)

    def hold_sticks(self, x, y, z, r, condition, what):
        return self.stream(lambda: self.sdk.manual_control.set_manual_control_input(x, y, z, r), condition, what)

    def reset(self):
        """Down and disarmed for the next flight, also after one that went wrong."""
        self.raw.heartbeat()
        self.raw.catch_up()
        self.raw.command_long(21)
        self.raw.wait_armed(False, within_ms=60_000)
        # Shown with a test that fails.
        print(self.printed())

    def printed(self):
        """What `serve` has printed since the last time."""
        try:
            return os.read(self.simulator.process.stdout.fileno(), 65_536).decode()
        except BlockingIOError:
            return ""


@pytest.fixture(scope="module")
def flyer(request, simulator_path):
    if request.param is Native and (platform.system(), platform.machine()) != ("Linux", "x86_64"):
        pytest.skip("mavsdk 4.1.0 is published for Linux on x86-64 only")
    flyer = Flyer(request.param())
    yield flyer
    flyer.close()


def by(*packages):
    """A test of these packages."""
    return pytest.mark.parametrize("flyer", packages, indirect=True, ids=lambda package: package.__name__, scope="module")


# What each package packs into messages by itself is flown with both; the rest is the same library behind them.
by_both, by_one = by(Grpc, Native), by(Grpc)


@pytest.fixture
def pilot(flyer):
    yield flyer
    flyer.reset()


@by_both
def test_it_takes_off_and_lands(pilot):
    start = pilot.take_off()
    pilot.wait_mode("HOLD")
    pilot.wait("in_air", bool)
    above = pilot.true.now()
    assert abs(above.up - start.up - TAKEOFF_M) < HEIGHT_M and above.distance(start.north, start.east) < MOVED_M
    pilot.act("land")
    pilot.wait_mode("LAND")
    landed = pilot.wait_down()
    assert landed.distance(start.north, start.east) < MOVED_M


@by_both
def test_it_goes_to_a_location(pilot):
    """A second after the take-off has been asked for, while it still climbs."""
    start = pilot.true.now()
    ground = pilot.wait("home", lambda home: True).absolute_altitude_m
    pilot.act("arm")
    pilot.act("takeoff")
    pilot.true.pause(1)
    pilot.act("goto_location", *place(start.north + 15, start.east), ground + 20.0, 0.0)
    pilot.wait_mode("HOLD")
    there = pilot.true.wait_at(start.north + 15, start.east, start.up + 20)
    assert there.faces(0)
    pilot.act("goto_location", *place(start.north, start.east + 5), ground + 8.0, 90.0)
    pilot.true.until(lambda truth: truth.speed > 1, "on its way")
    pilot.act("hold")
    pilot.true.until(lambda truth: truth.speed < 0.3, "standing")
    pilot.act("goto_location", *place(start.north, start.east + 5), ground + 8.0, 90.0)
    there = pilot.true.wait_at(start.north, start.east + 5, start.up + 8)
    assert there.faces(90)
    landed = pilot.land()
    assert landed.distance(there.north, there.east) < MOVED_M


SQUARE = [(0, 0, -5, 0), (5, 0, -5, 90), (5, 10, -5, 90)]


def fly_positions(pilot):
    pilot.act("arm")
    pilot.aim("position_ned", "PositionNedYaw", 0.0, 0.0, 0.0, 0.0)
    pilot.start_offboard()
    for north, east, down, yaw in SQUARE:
        pilot.aim("position_ned", "PositionNedYaw", float(north), float(east), float(down), float(yaw))
        pilot.true.until(
            lambda truth: truth.is_at(north, east, -down) and truth.faces(yaw), f"at {north} {east} {down}, {yaw}°"
        )


@by_both
def test_offboard_positions(pilot):
    """Take-off by set-points too."""
    fly_positions(pilot)
    pilot.stop_offboard()
    pilot.land()


@by_one
def test_offboard_velocities(pilot):
    pilot.act("arm")
    pilot.aim("velocity_ned", "VelocityNedYaw", 0.0, 0.0, 0.0, 0.0)
    pilot.start_offboard()
    pilot.aim("velocity_ned", "VelocityNedYaw", 0.0, 0.0, -2.0, 0.0)
    pilot.true.until(lambda truth: truth.up > 4 and truth.v_up > 1.5, "climbing")
    for north, east, yaw in [(2, 0, 90), (-2, 0, 90), (0, 2, 90), (0, -2, 270)]:
        pilot.aim("velocity_ned", "VelocityNedYaw", float(north), float(east), 0.0, float(yaw))
        pilot.true.until(
            lambda truth: abs(truth.v_north - north) < 0.5 and abs(truth.v_east - east) < 0.5 and truth.faces(yaw),
            f"flying {north} {east}, {yaw}°",
        )
    pilot.aim("velocity_ned", "VelocityNedYaw", 0.0, 0.0, 0.0, 0.0)
    pilot.true.until(lambda truth: truth.speed < 0.5, "standing")
    pilot.stop_offboard()
    pilot.land()


@by_one
def test_offboard_velocities_of_the_body(pilot):
    pilot.act("arm")
    pilot.aim("velocity_body", "VelocityBodyYawspeed", 0.0, 0.0, 0.0, 0.0)
    pilot.start_offboard()
    for down, yawspeed, sign in [(-1, 60, 1), (0, -60, -1)]:
        pilot.aim("velocity_body", "VelocityBodyYawspeed", 0.0, 0.0, float(down), float(yawspeed))
        pilot.true.pause(3)
        truths = pilot.true.during(1)
        assert 45 < sign * turn(truths[0].heading, truths[-1].heading) < 75, "60° in a second"
    pilot.aim("velocity_body", "VelocityBodyYawspeed", 0.0, 0.0, 0.0, 0.0)
    pilot.true.pause(2)
    # A circle in the direction that it faces, and one sideways.
    for forward, right in [(5, 0), (0, -5)]:
        pilot.aim("velocity_body", "VelocityBodyYawspeed", float(forward), float(right), 0.0, 30.0)
        pilot.true.pause(5)
        for truth in pilot.true.during(3):
            # MAVSDK sends 20 times a second of the wall clock, and a set-point is for the heading in which it arrives.
            course = math.degrees(math.atan2(truth.v_east, truth.v_north))
            off = turn(truth.heading + math.degrees(math.atan2(right, forward)), course)
            assert abs(truth.speed - 5) < 1.2 and abs(off) < 40, (off, truth)
    pilot.aim("velocity_body", "VelocityBodyYawspeed", 0.0, 0.0, 0.0, 0.0)
    pilot.true.until(lambda truth: truth.speed < 0.5, "standing")
    pilot.stop_offboard()
    pilot.land()


@by_both
def test_offboard_attitudes(pilot):
    pilot.act("arm")
    pilot.aim("attitude", "Attitude", 0.0, 0.0, 0.0, 0.0)
    pilot.start_offboard()
    pilot.aim("attitude", "Attitude", 0.0, 0.0, 0.0, 0.6)
    pilot.true.until(lambda truth: truth.up > 3 and truth.v_up > 1, "climbing")
    for roll in (30, -30, 0):
        pilot.aim("attitude", "Attitude", float(roll), 0.0, 0.0, HOVER_THRUST)
        pilot.true.until(lambda truth: abs(truth.roll - roll) < 5, f"rolled by {roll}°")
        pilot.true.pause(1)
    pilot.stop_offboard()
    pilot.true.until(lambda truth: truth.speed < 0.5 and abs(truth.v_up) < 0.3, "standing")
    pilot.land()


@by_one
def test_offboard_rates(pilot):
    """From well above the ground, as nothing holds the height."""
    pilot.take_off()
    start = pilot.true.now()
    ground = pilot.wait("home", lambda home: True).absolute_altitude_m
    pilot.act("goto_location", *place(start.north, start.east), ground + 8, 0.0)
    pilot.true.until(lambda truth: truth.up > 7, "higher")
    pilot.aim("attitude_rate", "AttitudeRate", 0.0, 0.0, 0.0, HOVER_THRUST)
    pilot.start_offboard()
    before = pilot.true.now()
    pilot.aim("attitude_rate", "AttitudeRate", 0.0, 0.0, 60.0, HOVER_THRUST)
    pilot.true.until(lambda truth: turn(before.heading, truth.heading) > 60, "turned by 60°", within_s=3)
    pilot.aim("attitude_rate", "AttitudeRate", 30.0, 0.0, 0.0, HOVER_THRUST)
    pilot.true.until(lambda truth: truth.roll > 15, "rolled", within_s=2)
    pilot.aim("attitude_rate", "AttitudeRate", -30.0, 0.0, 0.0, HOVER_THRUST)
    pilot.true.until(lambda truth: truth.roll < 0, "level again", within_s=3)
    pilot.stop_offboard()
    pilot.true.until(lambda truth: truth.speed < 0.5 and abs(truth.v_up) < 0.3, "standing")
    pilot.land()


@by_one
def test_offboard_places(pilot):
    """Places on Earth, with each height that it has."""
    start = pilot.true.now()
    home = pilot.wait("home", lambda home: True)
    above = pilot.types.PositionGlobalYaw.AltitudeType
    pilot.act("arm")
    pilot.aim("position_global", "PositionGlobalYaw", *place(start.north, start.east), 0.0, 0.0, above.REL_HOME)
    pilot.start_offboard()
    for north, east, up, yaw, height, kind in [
        (0, 0, 5, 0, 5.0, above.REL_HOME),
        (8, 0, 5, 90, home.absolute_altitude_m + 5, above.AMSL),
        (8, 8, 7, 180, 7.0, above.REL_HOME),
    ]:
        north, east = start.north + north, start.east + east
        pilot.aim("position_global", "PositionGlobalYaw", *place(north, east), height, float(yaw), kind)
        pilot.true.until(lambda truth: truth.is_at(north, east, start.up + up) and truth.faces(yaw), f"at {north} {east}")
    pilot.stop_offboard()
    pilot.land()


@by_one
def test_offboard_trajectory(pilot):
    """Position, velocity and acceleration of a circle at once, sent anew by the script as it goes on."""
    start = pilot.take_off()
    # What is true reaches the script by the wall clock, and so does a set-point the vehicle: no faster than they can.
    pilot.simulator.write("speed 2")
    radius, turns_s = 3.0, 8.0
    w = 2 * math.pi / turns_s
    begun = pilot.true.now()

    def motion(s):
        c, s = math.cos(w * s), math.sin(w * s)
        north, east = start.north, start.east - radius
        return (
            pilot.types.PositionNedYaw(north + radius * s, east + radius * c, -5.0, 0.0),
            pilot.types.VelocityNedYaw(radius * w * c, -radius * w * s, 0.0, 0.0),
            pilot.types.AccelerationNed(-radius * w * w * s, -radius * w * w * c, 0.0),
        )

    pilot.call("offboard", "set_position_velocity_acceleration_ned", *motion(0.0))
    pilot.start_offboard()
    truths = [begun]

    async def follow():
        truths.append(await asyncio.to_thread(pilot.true.until, lambda truth: True, "a word of the simulator"))
        at = truths[-1].time_s - begun.time_s
        await pilot.sdk.offboard.set_position_velocity_acceleration_ned(*motion(at))

    async def fly():
        while truths[-1].time_s < begun.time_s + 3 * turns_s:
            await follow()

    pilot.do(fly(), HANG_S)
    pilot.simulator.write(f"speed {SPEED}")
    # Once it has joined. How late it is depends on the machine; how large its circle is, and how fast it goes round,
    # does not. The middle of all, because a machine that stands still for a second sends nothing meanwhile.
    truths = [truth for truth in truths if truth.time_s > begun.time_s + turns_s]
    wide = statistics.median(truth.distance(start.north, start.east - radius) for truth in truths)
    assert abs(wide - radius) < MOVED_M / 2, wide
    bearings = [math.degrees(math.atan2(truth.north - start.north, truth.east - start.east + radius)) for truth in truths]
    turned = sum(turn(before, after) for before, after in itertools.pairwise(bearings))
    assert abs(turned - 360 * (truths[-1].time_s - truths[0].time_s) / turns_s) < 45, turned
    assert abs(truths[-1].up - start.up - 5) < HEIGHT_M
    pilot.stop_offboard()
    pilot.land()


@by_one
def test_it_follows_someone(pilot):
    """Places that a script moves, one or two a second."""
    start = pilot.take_off()
    above = pilot.types.PositionGlobalYaw.AltitudeType.REL_HOME

    def aim(east):
        there = place(start.north + 4, start.east + east)
        pilot.aim("position_global", "PositionGlobalYaw", *there, 6.0, 90.0, above)

    aim(0.0)
    pilot.start_offboard()
    for step in range(1, 9):
        pilot.true.pause(0.7)
        aim(1.5 * step)
    there = pilot.true.wait_at(start.north + 4, start.east + 12, start.up + 6)
    assert there.faces(90)
    pilot.stop_offboard()
    pilot.land()


@pytest.mark.parametrize("control, mode", [("position", "POSCTL"), ("altitude", "ALTCTL")])
@by_both
def test_it_is_flown_by_sticks(pilot, control, mode):
    """Centred sticks before arming, a take-off, and then by hand."""
    pilot.act("arm")
    pilot.act("takeoff")
    pilot.true.until(lambda truth: truth.up > TAKEOFF_M - HEIGHT_M and abs(truth.v_up) < 0.2, "hovering")
    pilot.hold_sticks(0.0, 0.0, 0.5, 0.0, lambda truth: True, "a word of the simulator")
    pilot.call("manual_control", f"start_{control}_control")
    pilot.wait_mode(mode)
    before = pilot.true.now()
    pilot.hold_sticks(0.0, 0.0, 1.0, 0.0, lambda truth: truth.up > before.up + 2, "higher")
    pilot.hold_sticks(0.0, 0.0, 0.5, 0.7, lambda truth: turn(before.heading, truth.heading) > 45, "turned right")
    before = pilot.hold_sticks(0.0, 0.0, 0.5, 0.0, lambda truth: abs(truth.v_up) < 0.2, "holding its height")

    def moved(truth, ahead, aside):
        heading = math.radians(before.heading)
        north, east = truth.north - before.north, truth.east - before.east
        along = north * math.cos(heading) + east * math.sin(heading)
        across = east * math.cos(heading) - north * math.sin(heading)
        return along * ahead + across * aside > 2

    pilot.hold_sticks(0.6, 0.0, 0.5, 0.0, lambda truth: moved(truth, 1, 0), "forward")
    pilot.hold_sticks(0.0, 0.6, 0.5, 0.0, lambda truth: moved(truth, 0, 1), "to the right")
    after = pilot.true.now()
    assert abs(after.up - before.up) < HEIGHT_M
    pilot.land()


@by_one
def test_it_returns(pilot):
    """Faster than usual, by set_current_speed."""
    start = pilot.take_off()
    height = pilot.wait("home", lambda home: True).absolute_altitude_m + TAKEOFF_M
    pilot.act("set_return_to_launch_altitude", 5.0)
    pilot.act("set_current_speed", 2.0)
    pilot.act("goto_location", *place(start.north + 12, start.east), height, 0.0)
    pilot.true.until(lambda truth: truth.distance(start.north, start.east) > 6, "half-way")
    assert 1.5 < pilot.true.now().speed < 2.5
    pilot.act("set_current_speed", 4.0)
    pilot.true.wait_at(start.north + 12, start.east, start.up + TAKEOFF_M)
    pilot.act("return_to_launch")
    pilot.wait_mode("RETURN_TO_LAUNCH")
    pilot.true.until(lambda truth: truth.up > start.up + 5 - HEIGHT_M, "at the height of the return")
    pilot.true.until(lambda truth: truth.speed > 3, "as fast as it was told")
    landed = pilot.wait_down()
    assert landed.distance(start.north, start.east) < MOVED_M


def test_two_vehicles_fly_at_once(simulator_path):
    """Each on a connection of its own, commanded in turn; neither does what the other is told."""
    ports = consecutive_ports()
    first, second = Observer(1), Observer(2)
    simulator = Simulator(
        first, "--peer", second.address, "--onboard", f"127.0.0.1:{ports}", "--vehicles", "2", "--speed", SPEED
    )
    loop = asyncio.new_event_loop()
    pair = [Grpc(), Grpc()]
    try:
        for number, sdk in enumerate(pair):
            loop.run_until_complete(asyncio.wait_for(sdk.connect(f"udpin://127.0.0.1:{ports + number}"), HANG_S))
            loop.run_until_complete(asyncio.wait_for(sdk.wait_connected(), CONNECT_S))
        for truth in (first, second):
            truth.wait("SYS_STATUS", lambda status: status.onboard_control_sensors_health & 0x1000_0000, 20_000)
        heights = [3.0, 6.0]
        starts = [first.now(), second.now()]
        for call, arguments in [("set_takeoff_altitude", heights), ("arm", None), ("takeoff", None)]:
            for number, sdk in enumerate(pair):
                values = [arguments[number]] if arguments else []
                loop.run_until_complete(asyncio.wait_for(getattr(sdk.action, call)(*values), HANG_S))
        for truth, start, height in zip((first, second), starts, heights):
            truth.until(lambda t: abs(t.up - start.up - height) < HEIGHT_M and abs(t.v_up) < 0.2, f"at {height} m")
        loop.run_until_complete(asyncio.wait_for(pair[1].action.land(), HANG_S))
        second.wait_landed()
        assert abs(first.now().up - starts[0].up - heights[0]) < HEIGHT_M
        loop.run_until_complete(asyncio.wait_for(pair[0].action.land(), HANG_S))
        first.wait_landed()
    finally:
        simulator.stop()
        for sdk in pair:
            sdk.close()
        first.close()
        second.close()
        loop.close()


def consecutive_ports():
    """The first of two that follow each other."""
    while True:
        port = free_port(socket.SOCK_DGRAM)
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as probe:
            try:
                probe.bind(("127.0.0.1", port + 1))
                return port
            except OSError:
                continue


@pytest.fixture
def own_pilot(simulator_path):
    """On a vehicle of its own, which may end as it will."""
    pilot = Flyer(Grpc())
    yield pilot
    pilot.close()


def test_it_lands_by_a_set_point(own_pilot):
    """As the example of positions ends: with a place on the ground, stopped once it stands there."""
    pilot = own_pilot
    fly_positions(pilot)
    pilot.aim("position_ned", "PositionNedYaw", 0.0, 10.0, 0.0, 180.0)
    pilot.true.until(lambda truth: truth.up < 0.3, "down")
    assert pilot.true.most_tilt(6) < 15, "it stays level on the ground"
    landed = pilot.true.now()
    assert landed.faces(180) and landed.distance(0, 10) < NEAR_M
    pilot.wait_down()
    pilot.stop_offboard()


@by_both
def test_it_is_killed(pilot):
    """The last one: it falls."""
    pilot.take_off()
    pilot.act("kill")
    pilot.wait("armed", lambda armed: not armed)
    pilot.true.until(lambda truth: truth.v_up < -2, "falling", within_s=2)
