"""The vehicle as a program by MAVSDK sees it: both of its Python packages, on a link of their own each.

mavsdk-grpc (`mavsdk_grpc`) talks to a process of its own, mavsdk_server; mavsdk (`mavsdk.asyncio`) calls the library.
Their calls have the same names, and nearly the same values. MAVSDK's own time-outs are the wall clock's: half a second
for a command, three times. The vehicle answers in milliseconds, and a test only asks that it was not a time-out.
"""

import asyncio
import contextlib
import math
import platform
import socket

import pytest

from client import Client
from conftest import HANG_S, PREARM_CHECK, Simulator

# The longest until a vehicle is found, and that a call may take with MAVSDK's repetitions and a busy machine, s.
CONNECT_S, CALL_S = 20, 15
# Where it stands: latitude and longitude (°), height above the ellipsoid (m).
LATITUDE_DEG, LONGITUDE_DEG, HEIGHT_M = 47.3977, 8.5456, 488.0


def is_home(place):
    return abs(place.latitude_deg - LATITUDE_DEG) < 1e-3 and abs(place.longitude_deg - LONGITUDE_DEG) < 1e-3


def is_height(height_m):
    # Above the sea it is the ellipsoid's less the geoid's, some 47 m here, where that is known.
    return abs(height_m - HEIGHT_M) < 60


def norm(*components):
    return math.sqrt(sum(component**2 for component in components))


def is_unit(q):
    return abs(norm(q.w, q.x, q.y, q.z) - 1) < 1e-3


def is_small(limit, *values):
    return all(math.isfinite(value) and abs(value) < limit for value in values)


def is_level(angle):
    return is_small(5, angle.roll_deg, angle.pitch_deg) and is_small(360.1, angle.yaw_deg)


def is_imu(imu):
    """At rest: one g upwards, no rotation, and the magnetic field of Europe, 0.48 gauss."""
    force, turn, field = imu.acceleration_frd, imu.angular_velocity_frd, imu.magnetic_field_frd
    return (
        abs(force.down_m_s2 + 9.81) < 0.5
        and is_small(1, force.forward_m_s2, force.right_m_s2)
        and is_small(0.2, turn.forward_rad_s, turn.right_rad_s, turn.down_rad_s)
        and 0.4 < norm(field.forward_gauss, field.right_gauss, field.down_gauss) < 0.6
    )


def is_odometry(odometry):
    place, speed = odometry.position_body, odometry.velocity_body
    return is_unit(odometry.q) and is_small(5, place.x_m, place.y_m, place.z_m) and is_small(1, *vars(speed).values())


def is_at_rest(both):
    place, speed = both.position, both.velocity
    return is_small(5, place.north_m, place.east_m, place.down_m) and is_velocity(speed)


def is_velocity(speed):
    return is_small(1, speed.north_m_s, speed.east_m_s, speed.down_m_s)


def is_raw_gps(gps):
    return (
        is_home(gps)
        and is_height(gps.absolute_altitude_m)
        and abs(gps.altitude_ellipsoid_m - HEIGHT_M) < 20
        and 0 < gps.horizontal_uncertainty_m < 20
        and 0 < gps.vertical_uncertainty_m < 40
        and gps.velocity_m_s < 1
    )


def is_metrics(metrics):
    return (
        is_small(1, metrics.groundspeed_m_s, metrics.climb_rate_m_s)
        and 0 <= metrics.throttle_percentage <= 100
        and 0 <= metrics.heading_deg <= 360
        and is_height(metrics.absolute_altitude_m)
    )


def is_altitude(altitude):
    return is_height(altitude.altitude_amsl_m) and is_small(5, altitude.altitude_relative_m, altitude.altitude_local_m)


def is_position(position):
    return is_home(position) and is_height(position.absolute_altitude_m) and is_small(5, position.relative_altitude_m)


# Every subscription that a PX4 SITL answers with a quadrotor on the ground, and what makes sense there. One that needs
# an event (status_text) or a sensor that there is not (distance_sensor) is not among them; nor are messages that PX4
# sends only when it is told to (actuator_output_status, actuator_control_target, raw_imu).
SUBSCRIPTIONS = {
    "altitude": is_altitude,
    "armed": lambda armed: not armed,
    "attitude_angular_velocity_body": lambda rate: is_small(0.2, rate.roll_rad_s, rate.pitch_rad_s, rate.yaw_rad_s),
    "attitude_euler": is_level,
    "attitude_quaternion": is_unit,
    # Four cells, full; a part of one or per cent of a hundred, by the package's version.
    "battery": lambda battery: 14 < battery.voltage_v < 17.5 and 0 < battery.remaining_percent <= 100,
    "fixedwing_metrics": is_metrics,
    "flight_mode": lambda mode: mode.name == "HOLD",
    "gps_info": lambda info: info.num_satellites >= 4 and info.fix_type.name.startswith("FIX_3D"),
    "ground_truth": lambda truth: is_home(truth) and is_height(truth.absolute_altitude_m),
    "heading": lambda heading: 0 <= heading.heading_deg <= 360,
    "health": lambda health: all(vars(health).values()),
    "health_all_ok": bool,
    "home": lambda home: is_home(home) and is_height(home.absolute_altitude_m),
    "imu": is_imu,
    "in_air": lambda in_air: not in_air,
    "landed_state": lambda state: state.name == "ON_GROUND",
    "odometry": is_odometry,
    "position": is_position,
    "position_velocity_ned": is_at_rest,
    "raw_gps": is_raw_gps,
    "rc_status": lambda status: not status.is_available,
    "scaled_imu": is_imu,
    # Of the standard atmosphere at 488 m.
    "scaled_pressure": lambda pressure: abs(pressure.absolute_pressure_hpa - 956) < 10,
    # After 2020, before 2100.
    "unix_epoch_time": lambda time_us: 1_577_836_800 < time_us / 1e6 < 4_102_444_800,
    "velocity_ned": is_velocity,
    # On the ground it has not felt any yet, and says so by the accuracy.
    "wind": lambda wind: norm(wind.wind_x_ned_m_s, wind.wind_y_ned_m_s) < 10 and wind.horizontal_wind_speed_accuracy_m_s > 0,
}

# Rates can be asked for of these.
RATES = """position home in_air landed_state attitude_quaternion attitude_euler velocity_ned gps_info raw_gps battery
odometry position_velocity_ned fixedwing_metrics imu scaled_imu unix_epoch_time altitude health""".split()
# Of this one not: there is no such sensor. The answer is no, not silence.
NO_RATES = ["distance_sensor"]


def free_port(kind):
    """A port that was free a moment ago, for a program that has to be told one."""
    with socket.socket(socket.AF_INET, kind) as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


class Grpc:
    """mavsdk-grpc: a server process, and stubs."""

    async def connect(self, url):
        from mavsdk_grpc import System

        self.system = System(port=free_port(socket.SOCK_STREAM))
        await self.system.connect(url)
        for plugin in ("action", "info", "manual_control", "offboard", "param", "telemetry"):
            setattr(self, plugin, getattr(self.system, plugin))

    async def wait_connected(self):
        async for state in self.system.core.connection_state():
            if state.is_connected:
                return

    def subscribe(self, name):
        return getattr(self.telemetry, name)()

    @staticmethod
    def reason(error):
        return error._result.result.name

    def close(self):
        process = self.system._server_process
        process.kill()
        process.wait()


class Native:
    """mavsdk: the library within this process."""

    async def connect(self, url):
        from mavsdk import ComponentType
        from mavsdk.asyncio import Configuration, Mavsdk

        self.mavsdk = Mavsdk(Configuration.create_with_component_type(ComponentType.GROUND_STATION))
        await self.mavsdk.add_any_connection(url)

    async def wait_connected(self):
        from mavsdk.asyncio.plugins.action import ActionAsync
        from mavsdk.asyncio.plugins.info import InfoAsync
        from mavsdk.asyncio.plugins.manual_control import ManualControlAsync
        from mavsdk.asyncio.plugins.offboard import OffboardAsync
        from mavsdk.asyncio.plugins.param import ParamAsync
        from mavsdk.asyncio.plugins.telemetry import TelemetryAsync

        system = await self.mavsdk.first_autopilot(timeout_s=-1.0)
        self.action, self.info, self.param, self.telemetry = (
            plugin(system) for plugin in (ActionAsync, InfoAsync, ParamAsync, TelemetryAsync)
        )
        self.manual_control, self.offboard = ManualControlAsync(system), OffboardAsync(system)

    def subscribe(self, name):
        return getattr(self.telemetry, f"subscribe_{name}")()

    @staticmethod
    def reason(error):
        return error.result.name

    def close(self):
        self.mavsdk.destroy()


class Pilot:
    """A program that is connected to a vehicle of its own, at three times real time."""

    def __init__(self, sdk, raw=None, speed="3", *arguments):
        self.loop = asyncio.new_event_loop()
        self.sdk = sdk
        self.raw = raw or Client()
        port = free_port(socket.SOCK_DGRAM)
        self.simulator = Simulator(self.raw, "--onboard", f"127.0.0.1:{port}", "--speed", speed, *arguments)
        self.do(sdk.connect(f"udpin://127.0.0.1:{port}"), HANG_S)
        self.do(sdk.wait_connected(), CONNECT_S)
        self.raw.wait("SYS_STATUS", lambda status: status.onboard_control_sensors_health & PREARM_CHECK)

    def do(self, call, within_s=CALL_S):
        """Runs one call to its end."""
        return self.loop.run_until_complete(asyncio.wait_for(call, within_s))

    async def first(self, name, condition=lambda value: True, within_s=CALL_S):
        """The first value of a subscription that meets a condition; otherwise how it did not."""
        last = "nothing"

        async def search():
            nonlocal last
            async with contextlib.aclosing(self.sdk.subscribe(name)) as values:
                async for last in values:
                    if condition(last):
                        return last

        try:
            return await asyncio.wait_for(search(), within_s)
        except asyncio.TimeoutError:
            return AssertionError(f"{name}: {shown(last)} after {within_s} s")

    def wait(self, name, condition, within_s=HANG_S):
        value = self.do(self.first(name, condition, within_s), 2 * within_s)
        if isinstance(value, AssertionError):
            raise value
        return value

    def refused(self, call):
        """The reason for which a call fails."""
        with pytest.raises(Exception) as caught:
            self.do(call)
        assert not isinstance(caught.value, asyncio.TimeoutError)
        return self.sdk.reason(caught.value)

    def close(self):
        running = self.simulator.is_running()
        self.simulator.stop()
        self.raw.close()
        self.sdk.close()
        self.loop.run_until_complete(asyncio.sleep(0))
        self.loop.close()
        assert running, "the simulator ended by itself"


def shown(value):
    return vars(value) if hasattr(value, "__dict__") else value


@pytest.fixture(scope="module", params=[Grpc, Native], ids=["mavsdk_grpc", "mavsdk"])
def pilot(request, simulator_path):
    if request.param is Native and (platform.system(), platform.machine()) != ("Linux", "x86_64"):
        pytest.skip("mavsdk 4.1.0 is published for Linux on x86-64 only")
    pilot = Pilot(request.param())
    yield pilot
    pilot.close()


@pytest.fixture(scope="module")
def values(pilot):
    """Every subscription at once, each until its value makes sense."""

    async def all_of_them():
        return await asyncio.gather(*(pilot.first(name, sound) for name, sound in SUBSCRIPTIONS.items()))

    return dict(zip(SUBSCRIPTIONS, pilot.do(all_of_them(), HANG_S)))


@pytest.mark.parametrize("name", SUBSCRIPTIONS)
def test_a_subscription_is_answered(pilot, values, name):
    if isinstance(values[name], AssertionError):
        raise values[name]


@pytest.mark.parametrize("name", RATES)
def test_a_rate_is_accepted(pilot, name):
    pilot.do(getattr(pilot.sdk.telemetry, f"set_rate_{name}")(5.0))


@pytest.mark.parametrize("name", NO_RATES)
def test_a_rate_of_what_there_is_not_is_refused(pilot, name):
    assert pilot.refused(getattr(pilot.sdk.telemetry, f"set_rate_{name}")(5.0)) in ("UNSUPPORTED", "COMMAND_DENIED")


def test_the_origin_is_told(pilot):
    origin = pilot.do(pilot.sdk.telemetry.get_gps_global_origin())
    assert is_home(origin) and is_height(origin.altitude_m)


def test_it_says_who_it_is(pilot):
    version = pilot.do(pilot.sdk.info.get_version())
    assert (version.flight_sw_major, version.flight_sw_minor) >= (1, 4), "what QGroundControl takes for an old PX4"
    pilot.do(pilot.sdk.info.get_identification())
    pilot.do(pilot.sdk.info.get_product())


def test_it_says_how_fast_its_time_passes(pilot):
    """By its time stamps and the wall clock: 3, or less on a busy machine. MAVSDK knows once it has heard enough."""

    async def speed():
        while True:
            with contextlib.suppress(Exception):
                factor = await pilot.sdk.info.get_speed_factor()
                if math.isfinite(factor):
                    return factor
            await asyncio.sleep(0.2)

    assert 0 < pilot.do(speed(), HANG_S) < 4


# ------------------------------------------------------------------------------------------------- parameters


def test_all_parameters_are_read(pilot):
    pilot.raw.catch_up()
    pilot.raw.mav.param_request_list_send(1, 1)
    count = pilot.raw.wait("PARAM_VALUE").param_count
    everything = pilot.do(pilot.sdk.param.get_all_params(), HANG_S)
    names = [p.name for p in [*everything.int_params, *everything.float_params, *everything.custom_params]]
    assert len(names) == len(set(names)) == count and count >= 50
    assert {"MAV_SYS_ID", "BAT1_N_CELLS"} <= {p.name for p in everything.int_params}
    assert {"MIS_TAKEOFF_ALT", "RTL_RETURN_ALT"} <= {p.name for p in everything.float_params}


def test_a_number_is_read_and_written(pilot):
    param = pilot.sdk.param
    before = pilot.do(param.get_param_float("MIS_TAKEOFF_ALT"))
    for height in (before + 1.5, before):
        pilot.do(param.set_param_float("MIS_TAKEOFF_ALT", height))
        assert pilot.do(param.get_param_float("MIS_TAKEOFF_ALT")) == pytest.approx(height)


def test_a_whole_number_is_read_and_written(pilot):
    param = pilot.sdk.param
    assert pilot.do(param.get_param_int("MAV_SYS_ID")) == 1
    before = pilot.do(param.get_param_int("BAT1_N_CELLS"))
    for cells in (before + 1, before):
        pilot.do(param.set_param_int("BAT1_N_CELLS", cells))
        assert pilot.do(param.get_param_int("BAT1_N_CELLS")) == cells


def test_a_parameter_that_there_is_not_is_an_error(pilot):
    param = pilot.sdk.param
    calls = [
        param.get_param_int("NO_SUCH_NAME"),
        param.get_param_float("NO_SUCH_NAME"),
        param.set_param_int("NO_SUCH_NAME", 1),
        param.set_param_float("NO_SUCH_NAME", 1.0),
    ]
    assert [pilot.refused(call) for call in calls] == ["DOES_NOT_EXIST"] * 4


def test_a_value_out_of_range_is_an_error(pilot):
    param = pilot.sdk.param
    before = pilot.do(param.get_param_float("MIS_TAKEOFF_ALT"))
    assert pilot.refused(param.set_param_float("MIS_TAKEOFF_ALT", 1e9)) == "VALUE_OUT_OF_RANGE"
    assert pilot.do(param.get_param_float("MIS_TAKEOFF_ALT")) == before


def test_a_value_of_another_type_is_an_error(pilot):
    assert pilot.refused(pilot.sdk.param.get_param_int("MIS_TAKEOFF_ALT")) in ("WRONG_TYPE", "TYPE_MISMATCH")


def test_heights_of_flight_are_parameters(pilot):
    action = pilot.sdk.action
    pilot.do(action.set_takeoff_altitude(3.0))
    assert pilot.do(action.get_takeoff_altitude()) == pytest.approx(3.0)
    height = pilot.do(action.get_return_to_launch_altitude())
    pilot.do(action.set_return_to_launch_altitude(height + 1))
    assert pilot.do(action.get_return_to_launch_altitude()) == pytest.approx(height + 1)


# ------------------------------------------------------------------------------------------------------ flight


def test_a_refusal_is_told_in_words(pilot):
    """A return of what is disarmed."""

    async def land_and_read():
        text = asyncio.ensure_future(pilot.first("status_text", lambda text: "disarmed" in text.text))
        await asyncio.sleep(0.3)
        with pytest.raises(Exception) as caught:
            await pilot.sdk.action.return_to_launch()
        return await text, caught.value

    text, error = pilot.do(land_and_read(), 2 * CALL_S)
    assert pilot.sdk.reason(error).startswith("COMMAND_DENIED")
    assert not isinstance(text, AssertionError), text


def test_it_holds_and_disarms_on_the_ground(pilot):
    """What examples do before they arm: asked for on the ground, neither is an error."""
    pilot.do(pilot.sdk.action.hold())
    pilot.do(pilot.sdk.action.disarm())


def test_it_flies(pilot):
    action = pilot.sdk.action
    pilot.do(action.set_takeoff_altitude(3.0))
    pilot.wait("health_all_ok", bool, CALL_S)
    pilot.do(action.arm())
    pilot.wait("armed", bool)
    pilot.do(action.takeoff())
    pilot.wait("landed_state", lambda state: state.name == "IN_AIR")
    pilot.wait("in_air", bool)
    pilot.wait("position", lambda position: abs(position.relative_altitude_m - 3) < 0.5)
    pilot.do(action.hold())
    pilot.wait("flight_mode", lambda mode: mode.name == "HOLD")
    assert pilot.refused(action.disarm()).startswith("COMMAND_DENIED")
    pilot.do(action.return_to_launch())
    pilot.wait("flight_mode", lambda mode: mode.name == "RETURN_TO_LAUNCH")
    pilot.do(action.land())
    pilot.wait("flight_mode", lambda mode: mode.name == "LAND")
    pilot.wait("landed_state", lambda state: state.name == "ON_GROUND")
    pilot.wait("armed", lambda armed: not armed)


def test_it_can_be_killed(pilot):
    """The last one: it falls."""
    action = pilot.sdk.action
    pilot.do(action.arm())
    pilot.do(action.takeoff())
    pilot.wait("landed_state", lambda state: state.name == "IN_AIR")
    pilot.do(action.kill())
    pilot.wait("armed", lambda armed: not armed)
