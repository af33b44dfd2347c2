# SPDX-License-Identifier: Apache-2.0
"""A bad cable between two network namespaces: a TAP device in each, and between them a relay that
drops, delays, duplicates, reorders and flips frames, as numbers from a seed say.

  bad_cable.py FAULTS SECONDS A B      the relay, between open TAP devices of descriptors A and B

Each line of standard input is FAULTS as JSON, which hold from then on; when it closes, or SECONDS are
over, the relay prints what it did as JSON and ends. Without netem: few kernels of virtual machines
have it, and its numbers have no seed."""
import collections
import dataclasses
import fcntl
import heapq
import json
import os
import random
import select
import struct
import subprocess
import sys
import time

MOST_FRAMES = 4096  # on their way at once; what comes then is dropped, as by a full queue
FRAME_BYTES = 65536
ETHERNET, UDP = 14, 17


@dataclasses.dataclass
class Faults:
    """Chances are per frame and direction."""
    seed: int = 1
    loss: float = 0.0
    duplicate: float = 0.0
    reorder: float = 0.0      # held back for longer than those after it
    flip: float = 0.0         # a bit is another one: the checksum of UDP or TCP no longer holds
    flip_unseen: float = 0.0  # in what UDP carries, without a checksum: whoever takes it has to see it
    delay_ms: float = 0.0
    jitter_ms: float = 0.0    # more delay, evenly spread; frames overtake each other

    @staticmethod
    def of(text):
        return Faults(**json.loads(text))


class Relay:
    """Frames from one side to the other. Deciding is apart from passing on, so that it can be tested."""

    def __init__(self, faults):
        self.numbers = random.Random(faults.seed)
        self.faults = faults
        self.counts = collections.Counter()

    def copies(self, frame):
        """What becomes of a frame: (delay in s, bytes) of each copy that arrives."""
        faults, chance = self.faults, self.numbers.random
        self.counts["frames"] += 1
        if chance() < faults.loss:
            self.counts["lost"] += 1
            return []
        number = 1
        if chance() < faults.duplicate:
            self.counts["duplicated"] += 1
            number = 2
        if chance() < faults.flip:
            self.counts["flipped"] += 1
            frame = self.flipped(frame, ETHERNET)
        if chance() < faults.flip_unseen:
            frame = self.flipped_unseen(frame)
        return [(self.delay_s(), frame) for _ in range(number)]

    def delay_s(self):
        faults = self.faults
        delay_ms = faults.delay_ms + self.numbers.random() * faults.jitter_ms
        if self.numbers.random() < faults.reorder:
            self.counts["reordered"] += 1
            delay_ms += 2 * faults.jitter_ms + 5
        return delay_ms / 1000

    def flipped(self, frame, begin):
        changed = bytearray(frame)
        bit = self.numbers.randrange(8 * begin, 8 * len(frame))
        changed[bit // 8] ^= 1 << bit % 8
        return bytes(changed)

    def flipped_unseen(self, frame):
        """With the checksum 0, which says that there is none. Fragments have no such field."""
        whole = len(frame) > ETHERNET + 20 and frame[12:14] == b"\x08\x00" and \
            frame[ETHERNET + 9] == UDP and int.from_bytes(frame[20:22], "big") & 0x3fff == 0
        payload = ETHERNET + 4 * (frame[ETHERNET] & 15) + 8 if whole else 0
        if not whole or len(frame) <= payload:
            return frame
        changed = bytearray(self.flipped(frame, payload))
        changed[payload - 2:payload] = b"\0\0"
        self.counts["flipped unseen"] += 1
        return bytes(changed)

    def run(self, sides, until_s):
        """Passes frames on until standard input ends."""
        other = {sides[0]: sides[1], sides[1]: sides[0]}
        on_their_way, order = [], 0
        while time.monotonic() < until_s:
            now_s = time.monotonic()
            while on_their_way and on_their_way[0][0] <= now_s:
                _, _, to, frame = heapq.heappop(on_their_way)
                try:
                    os.write(to, frame)
                except OSError:
                    self.counts["turned away"] += 1  # the device is down, or full
            wait_s = min(on_their_way[0][0] - now_s, 0.1) if on_their_way else 0.1
            ready = select.select([0, *sides], [], [], max(wait_s, 0))[0]
            for side in ready:
                if side == 0:
                    line = sys.stdin.readline()
                    if not line:
                        return
                    self.faults = Faults.of(line)
                    continue
                for delay_s, frame in self.copies(os.read(side, FRAME_BYTES)):
                    if len(on_their_way) < MOST_FRAMES:
                        order += 1
                        heapq.heappush(on_their_way, (time.monotonic() + delay_s, order,
                                                      other[side], frame))


class NoCable(Exception):
    """This machine, or this user, cannot make one."""


def ip(*words):
    done = subprocess.run(["ip", *words], capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise NoCable(f"ip {' '.join(words)}: {done.stderr.strip()}")


def tap(name):
    """An open TAP device of this name: frames are bytes, with whole checksums."""
    try:
        device = os.open("/dev/net/tun", os.O_RDWR | os.O_CLOEXEC)
        # TUNSETIFF with IFF_TAP | IFF_NO_PI
        fcntl.ioctl(device, 0x400454ca, struct.pack("16sH22x", name.encode(), 0x0002 | 0x1000))
    except OSError as error:
        raise NoCable(f"/dev/net/tun: {error.strerror}") from None
    return device


class Cable:
    """Namespaces `spaces` with addresses 10.213.8.1 and .2, and the relay between them."""
    addresses = ["10.213.8.1", "10.213.8.2"]

    def __init__(self, faults=None, seconds=300):
        self.spaces, self.taps, self.relay = [], [], None
        self.mark = f"{os.getpid()}{id(self) % 1000}"
        try:
            for side, address in zip("ab", self.addresses):
                self.add_end(side, address)
        except NoCable:
            self.close()
            raise
        self.relay = subprocess.Popen(
            [sys.executable, "-B", __file__, self.text(faults or {}), str(seconds), *map(str, self.taps)],
            stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True, pass_fds=self.taps)

    def add_end(self, side, address):
        space, plug = f"clew-{self.mark}-{side}", f"cb{self.mark}{side}"
        ip("netns", "add", space)
        self.spaces.append(space)
        self.taps.append(tap(plug))
        ip("link", "set", plug, "netns", space)
        ip("-n", space, "addr", "add", f"{address}/24", "dev", plug)
        ip("-n", space, "link", "set", plug, "up")
        ip("-n", space, "link", "set", "lo", "up")

    @staticmethod
    def text(faults):
        return json.dumps(dataclasses.asdict(Faults(**faults)))

    def become(self, **faults):
        """From now on the cable has these faults and no others."""
        self.relay.stdin.write(self.text(faults) + "\n")
        self.relay.stdin.flush()

    def inside(self, side):
        """What to put before a command that runs at an end."""
        return ["ip", "netns", "exec", self.spaces[side]]

    def close(self):
        """Takes it away; what the relay did, by kind."""
        counts = {}
        if self.relay:
            out = self.relay.communicate(timeout=20)[0]
            counts = json.loads(out) if out else {}
        for device in self.taps:
            os.close(device)
        for space in self.spaces:
            subprocess.run(["ip", "netns", "del", space], check=False, capture_output=True)
        self.relay, self.taps, self.spaces = None, [], []
        return counts


def main(faults, seconds, *sides):
    relay = Relay(Faults.of(faults))
    relay.run([int(side) for side in sides], time.monotonic() + float(seconds))
    print(json.dumps(relay.counts))


if __name__ == "__main__":
    main(*sys.argv[1:])
