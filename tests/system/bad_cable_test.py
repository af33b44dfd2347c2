# SPDX-License-Identifier: Apache-2.0
"""A run over hosts whose cable loses, delays, repeats, reorders and flips has the hash of one process;
also after all is lost for seconds. What the cable does comes from a seed: bad_cable.py."""
import collections
import itertools
import json
import os
import pathlib
import subprocess
import tempfile
import time
import unittest

from bad_cable import Cable, Faults, NoCable, Relay
from clew_command import CLEW, SOAK, SOURCE, run_graph, wait_until
from hosts_test import FAR, Host, has_done, make_keys, write_hosts

VENDORS = {"cyclonedds": ["--middleware", "cyclonedds"], "fastdds": ["--middleware", "fastdds"],
           "mixed": ["--middleware", "sense=fastdds", "--middleware", "control=fastdds"]}
BAD = {"loss": 0.03, "duplicate": 0.05, "reorder": 0.05, "flip": 0.02, "flip_unseen": 0.02,
       "delay_ms": 1, "jitter_ms": 1}
COUNTED = {"loss": "lost", "duplicate": "duplicated", "reorder": "reordered", "flip": "flipped",
           "flip_unseen": "flipped unseen"}
# Each kind by itself, at full counts.
SWEEP = [*({"loss": loss, "delay_ms": 1} for loss in (0.01, 0.05, 0.1, 0.2)),
         {"delay_ms": 20}, {"delay_ms": 1, "jitter_ms": 10}, {"duplicate": 0.3},
         {"reorder": 0.3, "jitter_ms": 1}, {"flip": 0.1}, {"flip_unseen": 0.1}, BAD]
CASES = [(vendor, {**faults, "seed": seed}) for vendor, faults, seed in
         itertools.product(VENDORS, SWEEP, (1, 2, 3))] if SOAK else [("mixed", BAD)]


class Decisions(unittest.TestCase):
    """What becomes of frames, without any."""
    FRAME = bytes(12) + b"\x08\x00" + bytes([0x45, 0, 0, 128, 0, 0, 0, 0, 64, 17]) + bytes(118)

    def copies(self, **faults):
        relay = Relay(Faults(**faults))
        return [relay.copies(self.FRAME) for _ in range(1000)], relay.counts

    def test_a_good_cable_changes_nothing(self):
        copies, counts = self.copies()
        self.assertEqual(copies, [[(0.0, self.FRAME)]] * 1000)
        self.assertEqual(counts, {"frames": 1000})

    def test_a_seed_gives_the_same_again(self):
        faults = {"loss": 0.2, "duplicate": 0.1, "flip": 0.1, "jitter_ms": 3, "reorder": 0.1}
        self.assertEqual(self.copies(seed=7, **faults), self.copies(seed=7, **faults))
        self.assertNotEqual(self.copies(seed=7, **faults), self.copies(seed=8, **faults))

    def test_each_fault_is_as_frequent_as_asked(self):
        _, counts = self.copies(loss=0.2, duplicate=0.1, reorder=0.3, flip=0.05)
        self.assertAlmostEqual(counts["lost"], 200, delta=50)
        self.assertAlmostEqual(counts["duplicated"], 80, delta=30)
        self.assertAlmostEqual(counts["reordered"], 260, delta=60)
        self.assertAlmostEqual(counts["flipped"], 40, delta=25)

    def test_a_flip_is_one_bit_and_an_unseen_one_has_no_checksum(self):
        copies, _ = self.copies(flip=1.0)
        for ((_, frame),) in copies:
            changed = int.from_bytes(frame, "big") ^ int.from_bytes(self.FRAME, "big")
            self.assertEqual(changed.bit_count(), 1)
        copies, counts = self.copies(flip_unseen=1.0)
        self.assertEqual(counts["flipped unseen"], 1000)
        for ((_, frame),) in copies:
            self.assertEqual(frame[:40], self.FRAME[:40])
            self.assertEqual(frame[40:42], b"\0\0")


class BadCable(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        scratch = tempfile.TemporaryDirectory()
        cls.addClassCleanup(scratch.cleanup)
        cls.scratch = pathlib.Path(scratch.name)
        cls.keys = make_keys(cls.scratch)
        cls.hosts = write_hosts(cls.scratch / "hosts.yaml", "keys/desk.run",
                                f"{Cable.addresses[1]}:7447", Cable.addresses[0])
        # A start at a loss of 20 % may take longer than thirty seconds.
        cls.graph = cls.scratch / "patient.yaml"
        text = (SOURCE / "configs/graphs/krishna_kalra.yaml").read_text(encoding="utf-8")
        cls.graph.write_text(f"{text}\nstart_timeout_s: 60\n", encoding="utf-8")

    def lay(self, faults=None):
        """A cable, and a host at its other end."""
        try:
            cable = Cable(faults, seconds=600)
        except NoCable as error:
            self.skipTest(str(error))
        self.addCleanup(cable.close)
        host = Host(self.keys / "robot.host", f"{Cable.addresses[1]}:7447", cable.inside(1))
        self.addCleanup(host.stop)
        return cable, host

    def begin(self, cable, *words):
        process = subprocess.Popen(
            [*cable.inside(0), CLEW, "run", self.graph, "--world", "u-trap", *map(str, words), *FAR,
             "--hosts", self.hosts, "--json"], text=True, stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        self.addCleanup(process.communicate)
        self.addCleanup(process.kill)
        return process

    def expected(self, ticks):
        return run_graph(self.graph, "--world", "u-trap", "--max-ticks", ticks, "--layout",
                         "composed")["hash"]

    def test_what_a_bad_cable_does_changes_nothing(self):
        ticks = "60"
        expected = self.expected(ticks)
        done = collections.Counter()
        for vendor, faults in CASES:
            with self.subTest(vendor=vendor, **faults):
                cable, host = self.lay(faults)
                process = self.begin(cable, "--max-ticks", ticks, *VENDORS[vendor])
                out, err = process.communicate(timeout=180)
                counts = cable.close()
                host.stop()
                self.assertIn(expected, out, err)
                print(vendor, faults, counts, "restarts", json.loads(out)["restarts"], flush=True)
                for kind, name in COUNTED.items():
                    self.assertEqual(faults.get(kind, 0) > 0, counts.get(name, 0) > 0, counts)
                done["runs"] += 1
        print(f"{done['runs']} of {len(CASES)} runs over a bad cable have the hash of one process")

    def test_total_loss_for_five_seconds_loses_nothing(self):
        for vendor in VENDORS if SOAK else ["mixed"]:
            with self.subTest(vendor=vendor):
                cable, host = self.lay()
                name = f"bad-cable-{os.getpid()}-{vendor}"
                process = self.begin(cable, "--max-ticks", "300", "--pace", "50x", "--name", name,
                                     *VENDORS[vendor])
                self.assertTrue(wait_until(lambda: has_done(name, 20, cable.spaces[0])), host.text())
                cable.become(loss=1.0)
                time.sleep(5)
                cable.become()
                out, err = process.communicate(timeout=120)

                self.assertIn(self.expected("300"), out, err)
                self.assertIn("was not heard for 2 s", err)
                self.assertGreater(cable.close()["lost"], 0)
                host.stop()


if __name__ == "__main__":
    unittest.main()
