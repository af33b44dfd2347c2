# SPDX-License-Identifier: Apache-2.0
"""What drive wrote of itself, out of a recording: a few lines of MCAP and CDR, so that a test does
not ask the program that wrote the file what is in it."""
import collections
import struct

MAGIC = b"\x89MCAP0\r\n"
CHANNEL, MESSAGE, CHUNK = 4, 5, 6
# Stamp (tick, time, number), pose, speeds, path, outcome, late; after four bytes of encapsulation.
STATE = struct.Struct("<4xQdQ6dI?")

State = collections.namedtuple("State", "tick x_m y_m heading_rad command_late")


def records_of(content):
    """The records one after the other, up to the first that is not whole."""
    at = 0
    while at + 9 <= len(content):
        kind, size = struct.unpack_from("<BQ", content, at)
        at += 9
        if at + size > len(content):
            return
        yield kind, content[at:at + size]
        at += size


def in_chunk(record):
    """The records of an uncompressed chunk."""
    (length,) = struct.unpack_from("<I", record, 28)
    assert length == 0, "the recording is compressed"
    return records_of(record[40:])


def states_of(path):
    """The states of a recording that may still be growing, one a tick."""
    content = path.read_bytes()
    if not content:
        return []
    assert content.startswith(MAGIC), path
    channel = None
    states = {}
    for kind, outer in records_of(content[len(MAGIC):]):
        for inner_kind, record in in_chunk(outer) if kind == CHUNK else [(kind, outer)]:
            if inner_kind == CHANNEL and record[8:].startswith(b"/state"):
                (channel,) = struct.unpack_from("<H", record)
            if inner_kind == MESSAGE and struct.unpack_from("<H", record)[0] == channel:
                (tick, _, _, x_m, y_m, heading_rad, *_, late) = STATE.unpack_from(record, 22)
                states[tick] = State(tick, x_m, y_m, heading_rad, late)
    return [states[tick] for tick in sorted(states)]
