# SPDX-License-Identifier: Apache-2.0
"""Makes the two crafted recordings beside this file anew: black boxes of sound runs, in each of which
one number of recover's state is one that no run comes to.

  python3 tests/hostile/make_recordings.py        with build/clew, or that of CLEW_COMMAND
"""
import os
import pathlib
import struct
import subprocess
import sys
import tempfile
import zlib

HERE = pathlib.Path(__file__).resolve().parent
CLEW = os.environ.get("CLEW_COMMAND", str(HERE.parents[1] / "build" / "clew"))
ATTACHMENT, DATA_END = 9, 15
TOPICS = 8
VISIT_BYTES = 56  # tick, pose, travel, two variances


def black_box(path, *words):
    command = [CLEW, "run", "krishna_kalra", "--world", "u-trap", "--layout", "composed",
               "--record", str(path), "--record-on", "trap", "--record-last", "12", *words]
    subprocess.run(command, check=False, capture_output=True)


def attachment(record):
    """Name, and where the data begins and ends in the record."""
    at = 16
    (size,) = struct.unpack_from("<I", record, at)
    name = record[at + 4:at + 4 + size].decode()
    at += 4 + size
    (size,) = struct.unpack_from("<I", record, at)
    at += 4 + size
    (size,) = struct.unpack_from("<Q", record, at)
    return name, at + 8, at + 8 + size


def tampered(content, change):
    """The file with recover's state changed in place, and its checksums as they must be."""
    content = bytearray(content)
    at = 8
    while at + 9 <= len(content):
        kind, size = struct.unpack_from("<BQ", content, at)
        at += 9
        if kind == ATTACHMENT:
            name, begin, end = attachment(content[at:at + size])
            if name == "state/recover":
                content[at + begin:at + end] = change(bytes(content[at + begin:at + end]))
                struct.pack_into("<I", content, at + end, zlib.crc32(content[at:at + end]))
        if kind == DATA_END:
            content[at:at + 4] = bytes(4)  # the checksum of the data section: none
            return bytes(content)
        at += size
    raise ValueError("the recording does not end")


def escape_index(state):
    """Behind the counts of the outputs: whether an escape is at work, and which."""
    at = TOPICS * 8 + 1
    return state[:at] + b"\xff\xff\xff\xff" + state[at + 4:]


def generation(state, at):
    """Where the numbers `next` of a generation of cells stand, and where it ends."""
    (count,) = struct.unpack_from("<Q", state, at)
    at += 8
    places = []
    for _ in range(count):
        _, following, visits = struct.unpack_from("<QIQ", state, at)
        if following >= 8 or not 1 <= visits <= 8:
            raise ValueError("no cell")
        places.append(at + 8)
        at += 20 + visits * VISIT_BYTES
    return places, at


def memory_next(state):
    """The first cell of the position memory, wherever that begins."""
    for at in range(TOPICS * 8, len(state) - 16):
        try:
            places, end = generation(state, at)
            _, end = generation(state, end)
        except (ValueError, struct.error):
            continue
        if len(places) > 3 and end <= len(state):
            return state[:places[0]] + b"\xff\xff\xff\xff" + state[places[0] + 4:]
    raise ValueError("there is no position memory")


def main():
    with tempfile.TemporaryDirectory() as directory:
        for name, change, words in (
                ("recover-escape-index", escape_index, ()),
                ("position-memory-next", memory_next,
                 ("--with", "recover.detector=position_revisit"))):
            sound = pathlib.Path(directory) / f"{name}.mcap"
            black_box(sound, *words)
            (HERE / f"{name}.mcap").write_bytes(tampered(sound.read_bytes(), change))
            print(f"wrote {name}.mcap")


if __name__ == "__main__":
    sys.exit(main())
