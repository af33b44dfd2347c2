# SPDX-License-Identifier: Apache-2.0
"""A black box writes the same file in every layout, whatever dies meanwhile, and only if something
happens; what it wrote is a recording like any other."""
import os
import pathlib
import random
import signal
import subprocess
import tempfile
import time
import unittest

from clew_command import (CLEW, LAYOUTS, SOAK, Run, components_of, recorder_of, wait_until)

# A trap after a thousand ticks: what is kept is forgotten many times before.
LATE_TRAP = ["krishna_kalra", "--world", "unsolvable-behind-wall", "--with",
             "recover.detector=no_progress", "--set", "recover.detector.no_progress.of=target",
             "--set", "recover.detector.no_progress.allowance_s=300",
             "--with", "recover.escape=none", "--max-ticks", "3000"]
BOX = ["--record-on", "trap", "--record-last", "60", "--json"]
KILLS = 60 if SOAK else 6


class BlackBox(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.directory = pathlib.Path(scratch.name)
        self.path = self.directory / "box.mcap"

    def record(self, *arguments):
        return Run(["run", *arguments, "--record", self.path, "--force", *BOX])

    def test_every_layout_writes_the_same_bytes(self):
        written = {}
        for name, layout in LAYOUTS.items():
            run = self.record(*LATE_TRAP, *layout)

            self.assertEqual(run.status, 3, run.err)
            self.assertEqual(run.report["recording"], str(self.path))
            written[name] = self.path.read_bytes()
        self.assertEqual(len(set(written.values())), 1)
        facts = Run(["info", self.path, "--json"]).report
        self.assertGreater(facts["first_tick"], 500)
        self.assertEqual(facts["black_box"]["first_tick"], facts["first_tick"] + 1)
        self.assertIn("no_progress noticed a trap at tick", facts["black_box"]["why"])

    def test_what_it_wrote_is_replayed_branched_and_drawn(self):
        self.record(*LATE_TRAP, "--layout", "composed")
        first = Run(["info", self.path, "--json"]).report["black_box"]["first_tick"]

        replay = Run(["replay", self.path, "--json"])
        self.assertEqual(replay.status, 0, replay.out)
        self.assertTrue(replay.report["identical"])
        self.assertEqual(replay.report["ticks"], 3000 - first + 1)

        branch = self.directory / "branch.mcap"
        run = Run(["replay", self.path, "--branch", first + 100, "--with",
                   "recover.escape=obstacle_following", "--record", branch, "--json"])
        self.assertIn(run.status, (3, 5), run.err)
        self.assertEqual(Run(["replay", branch]).status, 0)
        picture = self.directory / "path.svg"
        self.assertEqual(Run(["plot", self.path, branch, "-o", picture]).status, 0)
        self.assertIn("<svg", picture.read_text(encoding="utf-8"))

        too_early = Run(["replay", self.path, "--branch", first - 1])
        self.assertEqual(too_early.status, 2)
        self.assertIn(f"is a black box, which begins at tick {first}", too_early.err)
        self.assertEqual(Run(["run", "--resume", self.path]).status, 2)

    def test_processes_that_are_killed_change_nothing(self):
        self.record(*LATE_TRAP, "--layout", "composed")
        expected = self.path.read_bytes()
        numbers = random.Random(7)
        kills = 0
        while kills < KILLS:
            process = subprocess.Popen([CLEW, "run", *LATE_TRAP, "--record", self.path, "--force",
                                        *BOX], text=True, stdout=subprocess.PIPE,
                                       stderr=subprocess.PIPE, start_new_session=True)
            self.assertTrue(wait_until(lambda: len(components_of(process.pid)) == 5))
            for _ in range(3):
                # A moment of the run, not a wait for a result.
                time.sleep(numbers.uniform(0.0, 0.3))
                victims = {**components_of(process.pid), "recorder": recorder_of(process.pid)}
                victim = numbers.choice(["recorder", "recover", "drive"])
                if process.poll() is None and victims.get(victim):
                    os.kill(victims[victim], signal.SIGKILL)
                    kills += 1
            _, err = process.communicate(timeout=120)

            self.assertEqual(process.returncode, 3, err)
            self.assertEqual(self.path.read_bytes(), expected, err)

    def test_nothing_happens_nothing_is_written(self):
        for layout in (LAYOUTS["composed"], LAYOUTS["cyclonedds"]):
            run = self.record("krishna_kalra", "--world", "open-field", *layout)

            self.assertEqual(run.status, 0, run.err)
            self.assertIsNone(run.report["recording"])
            self.assertIn("nothing happened that the black box writes for", run.err)
            self.assertEqual(list(self.directory.iterdir()), [])

    def test_an_interrupted_run_is_written(self):
        process = subprocess.Popen([CLEW, "run", "krishna_kalra", "--world", "open-field",
                                    "--pace", "1x", "--record", self.path, *BOX], text=True,
                                   stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                                   start_new_session=True)
        self.addCleanup(process.kill)
        self.assertTrue(wait_until(lambda: len(components_of(process.pid)) == 5))
        # Long enough for a few ticks of 0.3 s; how many does not matter.
        time.sleep(2.0)
        process.send_signal(signal.SIGTERM)
        _, err = process.communicate(timeout=30)

        self.assertEqual(process.returncode, 130, err)
        facts = Run(["info", self.path, "--json"]).report
        self.assertIn("the run was aborted", facts["black_box"]["why"])

    def test_bad_options_are_answered(self):
        cases = [(["--record-on", "trap"], "--record-on: needs --record FILE"),
                 (["--record", self.path, "--record-on", "trip"], "unknown occasion 'trip'"),
                 (["--record", self.path, "--record-last", "5"], "needs --record-on trap"),
                 (["--record", self.path, "--record-on", "trap", "--record-last", "-1"],
                  "--record-last")]
        for options, message in cases:
            run = Run(["run", "krishna_kalra", *options])

            self.assertEqual(run.status, 2, run.err)
            self.assertIn(message, run.err)
            self.assertEqual(list(self.directory.iterdir()), [])


if __name__ == "__main__":
    unittest.main()
