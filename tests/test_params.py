"""Parameters by raw frames: their list, reading and writing, what is refused, and that they are kept."""

import math
import struct

import pytest
from pymavlink.dialects.v20 import development as mavlink

from client import a, shared  # noqa: F401 (fixtures)
from client import (
    listen,
    parameter_list,
    serve,
    stop,
)


def code(value, kind):
    """A value in the float field: whole numbers by their bits."""
    if kind == mavlink.MAV_PARAM_TYPE_REAL32:
        return value
    return struct.unpack("<f", struct.pack("<i", value))[0]


def decode(message):
    """The value of a PARAM_VALUE. Its bits are taken from the frame, as Python changes some that are no numbers."""
    if message.param_type == mavlink.MAV_PARAM_TYPE_REAL32:
        return message.param_value
    start = 10 if message.get_msgbuf()[0] == 0xFD else 6
    raw = bytes(message.get_msgbuf())[start : start + 4]
    return struct.unpack("<i", raw)[0]


def read(client, name):
    return client.ask(
        lambda mav: mav.param_request_read_send(1, 1, name.encode(), -1),
        "PARAM_VALUE",
        lambda value: value.param_id == name,
    )


def write(client, name, coded, kind):
    """Asks for a value; what the vehicle then says it is, and the errors it names."""
    client.catch_up()
    client.mav.param_set_send(1, 1, name.encode(), coded, kind)
    heard = listen(client, [], 400)[client]
    values = [m for m in heard if m.get_type() == "PARAM_VALUE" and m.param_id == name]
    errors = [m for m in heard if m.get_type() == "PARAM_ERROR" and m.param_id == name]
    assert values, "the value is echoed"
    return values[-1], errors


def test_the_list_of_parameters_is_complete_and_always_the_same(a):
    values = parameter_list(a)
    count = values[0].param_count
    # The gains, the modes, the airframe, the estimator: it cannot be few.
    assert count >= 50
    assert [value.param_count for value in values] == [count] * count
    assert [value.param_index for value in values] == list(range(count))
    names = [value.param_id for value in values]
    assert len(set(names)) == count and all(0 < len(name) <= 16 for name in names)
    assert [value.param_id for value in parameter_list(a)] == names
    assert all(math.isfinite(decode(value)) for value in values)


# Without these QGroundControl's set-up pages show an error, or it takes the vehicle for one that was never configured.
QGROUNDCONTROL = """SYS_AUTOSTART SYS_AUTOCONFIG MAV_SYS_ID CAL_GYRO0_ID CAL_ACC0_ID CAL_MAG0_ID CAL_MAG1_ID CAL_MAG2_ID
COM_RC_IN_MODE RC_MAP_ROLL RC_MAP_PITCH RC_MAP_YAW RC_MAP_THROTTLE COM_FLTMODE1 COM_FLTMODE2 COM_FLTMODE3 COM_FLTMODE4
COM_FLTMODE5 COM_FLTMODE6 BAT1_SOURCE BAT1_N_CELLS RTL_LAND_DELAY RTL_DESCEND_ALT RTL_RETURN_ALT NAV_DLL_ACT NAV_RCL_ACT
NAV_ACC_RAD COM_RC_LOSS_T COM_DL_LOSS_T COM_LOW_BAT_ACT""".split()


def test_the_parameters_that_clients_look_for_exist(a):
    names = {value.param_id for value in parameter_list(a)}
    missing = [name for name in [*QGROUNDCONTROL, "MIS_TAKEOFF_ALT"] if name not in names]
    assert not missing, missing


def test_a_parameter_is_read_by_name_and_by_index(a):
    by_name = read(a, "MIS_TAKEOFF_ALT")
    by_index = a.ask(lambda mav: mav.param_request_read_send(1, 1, b"", by_name.param_index), "PARAM_VALUE")
    assert by_index.param_id == "MIS_TAKEOFF_ALT"
    assert (by_index.param_value, by_index.param_count) == (by_name.param_value, by_name.param_count)
    assert decode(read(a, "MAV_SYS_ID")) == 1


@pytest.mark.parametrize("name, index", [("NO_SUCH_NAME", -1), ("_HASH_CHECK", -1), ("", 32_000)])
def test_a_parameter_that_there_is_not_is_an_error(a, name, index):
    error = a.ask(lambda mav: mav.param_request_read_send(1, 1, name.encode(), index), "PARAM_ERROR")
    assert error.error == mavlink.MAV_PARAM_ERROR_DOES_NOT_EXIST
    assert (error.target_system, error.target_component) == (a.SYSTEM, a.COMPONENT)


def test_writing_a_parameter_that_there_is_not_is_an_error(a):
    real = mavlink.MAV_PARAM_TYPE_REAL32
    error = a.ask(lambda mav: mav.param_set_send(1, 1, b"NO_SUCH_NAME", 1.0, real), "PARAM_ERROR")
    assert error.error == mavlink.MAV_PARAM_ERROR_DOES_NOT_EXIST


def test_a_parameter_can_be_written(a):
    before = read(a, "MIS_TAKEOFF_ALT")
    for height in (before.param_value + 1, before.param_value):
        value, errors = write(a, "MIS_TAKEOFF_ALT", height, before.param_type)
        assert value.param_value == height and not errors
        assert read(a, "MIS_TAKEOFF_ALT").param_value == height


@pytest.mark.parametrize("bad", [1e9, -1e9, math.nan, math.inf])
def test_a_value_out_of_range_is_refused(a, bad):
    before = read(a, "MIS_TAKEOFF_ALT")
    value, errors = write(a, "MIS_TAKEOFF_ALT", bad, before.param_type)
    assert value.param_value == before.param_value
    assert [error.error for error in errors] == [mavlink.MAV_PARAM_ERROR_VALUE_OUT_OF_RANGE]


@pytest.mark.parametrize("bad", [-1, 256, 2**31 - 1])
def test_a_whole_number_out_of_range_is_refused(a, bad):
    before = read(a, "MAV_SYS_ID")
    value, errors = write(a, "MAV_SYS_ID", code(bad, before.param_type), before.param_type)
    assert decode(value) == decode(before) == 1
    assert [error.error for error in errors] == [mavlink.MAV_PARAM_ERROR_VALUE_OUT_OF_RANGE]


@pytest.mark.parametrize("name, coded, kind", [
    ("MIS_TAKEOFF_ALT", code(5, mavlink.MAV_PARAM_TYPE_INT32), mavlink.MAV_PARAM_TYPE_INT32),
    ("MAV_SYS_ID", 2.0, mavlink.MAV_PARAM_TYPE_REAL32),
])  # fmt: skip
def test_a_value_of_another_type_is_refused(a, name, coded, kind):
    before = read(a, name)
    assert before.param_type != kind
    value, errors = write(a, name, coded, kind)
    assert (decode(value), value.param_type) == (decode(before), before.param_type)
    assert errors and errors[0].error != mavlink.MAV_PARAM_ERROR_NO_ERROR


def test_a_parameter_is_kept_across_restarts(simulator_path, tmp_path):
    # The stored set begins empty, is made by the first start, and read by the second.
    arguments = ("--params", str(tmp_path / "params.bin"))
    chosen = None
    for _ in range(2):
        simulator, station = serve(*arguments, speed="5")
        try:
            value = read(station, "MIS_TAKEOFF_ALT")
            if chosen is None:
                chosen = value.param_value + 1.5
                value, errors = write(station, "MIS_TAKEOFF_ALT", chosen, value.param_type)
                assert not errors
            assert value.param_value == chosen
            listen(station, [], 2_000)
        finally:
            stop(simulator, station)
    # Another file, another set.
    simulator, station = serve("--params", str(tmp_path / "others.bin"), speed="5")
    try:
        assert read(station, "MIS_TAKEOFF_ALT").param_value != chosen
    finally:
        stop(simulator, station)
