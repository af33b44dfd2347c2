# SPDX-License-Identifier: Apache-2.0
"""The supervisor's socket: whatever a stranger sends there, or does not read, leaves the run as it
is, and the supervisor always hears a signal."""
import json
import os
import pathlib
import random
import signal
import socket
import subprocess
import sys
import tempfile
import time
import unittest

from clew_command import CLEW, Run, components_of, start, wait_until

RUN = ["run", "krishna_kalra", "--world", "unsolvable-behind-wall", "--with",
       "recover.detector=none", "--max-ticks", "2000"]
# 200 s of simulated time: the run lasts at least 4 s, on the fastest machine, too.
PACE = ["--pace", "50x"]
DOMAIN = 87
NOBODY = 65534


def connect():
    """A connection; waits while as many as may stand there stand before the door."""
    stranger = socket.socket(socket.AF_UNIX, socket.SOCK_STREAM)
    stranger.connect(f"\0clew.domain.{DOMAIN}")
    stranger.settimeout(10)
    return stranger


def listens():
    with socket.socket(socket.AF_UNIX, socket.SOCK_STREAM) as stranger:
        return stranger.connect_ex(f"\0clew.domain.{DOMAIN}") == 0


def send(bytes_):
    """Sends all of it, or as much as the other side wants; returns the connection."""
    stranger = connect()
    try:
        stranger.sendall(bytes_)
    except OSError:
        pass
    return stranger


class Line(unittest.TestCase):
    def during_a_run(self, disturb, says):
        """Calls `disturb()` while a run goes on: it ends as without, and its recording says so."""
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        recording = pathlib.Path(scratch.name) / "r.mcap"
        composed = Run([*RUN, "--layout", "composed", "--json"]).report
        process = start([*RUN, *PACE, "--domain", DOMAIN, "--json", "--record", recording])
        self.assertTrue(wait_until(listens))
        kept = disturb()
        alive = process.poll() is None
        out, err = process.communicate(timeout=120)
        for stranger in kept:
            stranger.close()

        self.assertTrue(alive, "the run was over before the strangers came: " + err)
        self.assertEqual(process.returncode, 3, err)
        self.assertIn(f'"hash":"{composed["hash"]}"', out)
        self.assertIn('"restarts":0', out, err)
        events = map(json.loads, Run(["events", recording, "--json"]).out.splitlines())
        refused = [event["text"] for event in events if event["kind"] == "refused"]
        self.assertIn(says, refused)
        self.assertLess(len(refused), 10, "the same is told once")
        self.assertEqual(Run(["info", recording, "--json"]).report["incidents"],
                         {"refused": len(refused)})
        self.assertTrue(Run(["replay", recording, "--json"]).report["identical"])
        self.assertEqual(Run(["bisect", recording, recording]).status, 1, "no setting differs")

    def test_bytes_of_a_stranger_change_nothing(self):
        numbers = random.Random(4)
        self.during_a_run(lambda: [
            send(b"\x00\xff\xff\xff\xff"), send(b"\x00" * 64), send(b"GET / HTTP/1.1\r\n\r\n"),
            send(b"\x01\x00\x00\x00\x40" + b"x" * 4_000_000),
            *(send(numbers.randbytes(numbers.randrange(1, 3000))) for _ in range(40))],
            "a process has connected and said no hello; it is turned away")

    def test_connections_that_say_nothing_change_nothing(self):
        self.during_a_run(
            lambda: [connect() for _ in range(300)],
            "a process has connected and said nothing, and too many have come after it; it is "
            "turned away")

    @unittest.skipUnless(os.geteuid() == 0, "only root can act as another user")
    def test_another_user_is_not_let_in(self):
        program = (f"import os, socket\nos.setuid({NOBODY})\n"
                   "s = socket.socket(socket.AF_UNIX, socket.SOCK_STREAM)\ns.settimeout(10)\n"
                   f"s.connect('\\0clew.domain.{DOMAIN}')\n"
                   "try: print(s.recv(1))\nexcept ConnectionError: print(b'')\n")

        def come_as_another():
            done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True,
                                  check=False)
            self.assertEqual(done.stdout, "b''\n", done.stderr)
            return []

        self.during_a_run(come_as_another,
                          f"a process of user {NOBODY} has connected, and is turned away")

    def test_a_component_that_does_not_read_its_world_does_not_deafen_the_supervisor(self):
        # Its description is larger than any socket's buffer.
        walls = ", ".join(f"[{i % 300}, {i // 300 + 5}, {i % 300}.5, {i // 300 + 5}]"
                          for i in range(30000))
        with tempfile.TemporaryDirectory() as directory:
            world = pathlib.Path(directory) / "many-walls.yaml"
            world.write_text("format: clew-world/1\nname: many-walls\nbounds: [0, 0, 301, 110]\n"
                             f"walls: [{walls}]\nstart: [1, 1, 0]\ntarget: [3, 1]\n"
                             "target_radius: 0.2\n")
            process = subprocess.Popen(
                [CLEW, "run", "reactive", "--world", world, "--json"], text=True,
                stdout=subprocess.PIPE, stderr=subprocess.PIPE, start_new_session=True)
            self.assertTrue(wait_until(lambda: "sense" in components_of(process.pid)))
            os.kill(components_of(process.pid)["sense"], signal.SIGSTOP)
            time.sleep(1)

            process.send_signal(signal.SIGINT)
            out, err = process.communicate(timeout=20)

        self.assertEqual(process.returncode, 130, out + err)


if __name__ == "__main__":
    unittest.main()
