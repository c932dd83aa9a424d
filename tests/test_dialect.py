"""Our subset of MAVLink's definitions against the official ones: the same on the wire, the same names."""

from pathlib import Path

import pytest
from pymavlink.dialects.v20 import common
from pymavlink.generator import mavparse

DEFINITIONS = Path(__file__).resolve().parent.parent / "firmware" / "dialect" / "glissade.xml"
OURS = mavparse.MAVXML(str(DEFINITIONS), wire_protocol_version="2.0")


@pytest.mark.parametrize("message", OURS.message, ids=lambda message: message.name)
def test_a_message_is_the_official_one(message):
    official = common.mavlink_map[message.id]
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
        if not entry.end_marker:
            assert official[entry.value].name == entry.name
