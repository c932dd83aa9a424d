"""Our subset of MAVLink's definitions against the official ones: the same on the wire, the same names."""

from pathlib import Path

import pytest
from pymavlink.dialects.v20 import common, development
from pymavlink.generator import mavparse

DEFINITIONS = Path(__file__).resolve().parent.parent / "firmware" / "dialect" / "glissade.xml"
OURS = mavparse.MAVXML(str(DEFINITIONS), wire_protocol_version="2.0")
# pymavlink 2.4.50 does not have these: name, checksum seed and lengths by the definitions at mavlink.io.
NEWER = {("MAV_RESULT", 9), ("MAV_PARAM_ERROR", 7)}
ELSEWHERE = {300: ("PROTOCOL_VERSION", 217, 22), 291: ("ESC_STATUS", 10, 57)}


@pytest.mark.parametrize("message", OURS.message, ids=lambda message: message.name)
def test_a_message_is_the_official_one(message):
    if message.id in ELSEWHERE:
        assert (message.name, message.crc_extra, message.wire_length) == ELSEWHERE[message.id]
        return
    official = common.mavlink_map.get(message.id) or development.mavlink_map[message.id]
    assert message.name == official.msgname
    assert message.crc_extra == official.crc_extra
    # The checksum covers all but the extension fields, at the end, of which either side may know more.
    pairs = list(zip(message.ordered_fieldnames, official.ordered_fieldnames))
    assert all(ours == theirs for ours, theirs in pairs)
    types = dict(zip(official.fieldnames, official.fieldtypes))
    assert all(types.get(name, kind) == kind for name, kind in zip(message.fieldnames, message.fieldtypes))


@pytest.mark.parametrize("enum", OURS.enum, ids=lambda enum: enum.name)
def test_an_enum_is_part_of_the_official_one(enum):
    official = common.enums[enum.name]
    for entry in enum.entry:
        if not entry.end_marker and (enum.name, entry.value) not in NEWER:
            assert official[entry.value].name == entry.name
