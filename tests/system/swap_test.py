# SPDX-License-Identifier: Apache-2.0
"""A run may be changed while it goes on: the same changes give the same bytes in every layout,
whatever is killed meanwhile, and a replay repeats them."""
import json
import os
import pathlib
import random
import signal
import tempfile
import time
import unittest

from clew_command import (LAYOUTS, SOAK, Run, components_of, run_graph, start, wait_until)

# Some seconds of ticks; the robot wanders before a wall.
RUN = ["krishna_kalra", "--world", "unsolvable-behind-wall", "--with", "recover.detector=none",
       "--max-ticks", "2000"]
# A behaviour and its parameters, another stage, and back again; and another goal.
CHANGES = ["--at", "100:recover.detector=landmark_revisit", "--at", "400:control=fuzzy_behaviourist",
           "--at", "700:recover.detector=none", "--at", "700:control=krishna_kalra_fuzzy",
           "--at", "1000:goal=1.5,1.5,0.1"]
KILLS = 500 if SOAK else 8


def tick_of(run):
    return run.report["tick"]


class Swap(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.directory = tempfile.TemporaryDirectory()
        cls.folder = pathlib.Path(cls.directory.name)
        cls.recording = cls.folder / "changed.mcap"
        cls.report = run_graph(*RUN, *CHANGES, "--layout", "composed", "--record", cls.recording)

    @classmethod
    def tearDownClass(cls):
        cls.directory.cleanup()

    def test_changes_make_a_difference_and_are_the_same_in_every_layout(self):
        plain = run_graph(*RUN, "--layout", "composed")

        self.assertNotEqual(plain["hash"], self.report["hash"])
        self.assertIsNone(self.report["shortest_path_m"])
        for name, layout in LAYOUTS.items():
            with self.subTest(layout=name):
                path = self.folder / "other.mcap"
                report = run_graph(*RUN, *CHANGES, *layout, "--record", path, "--force")
                self.assertEqual(report["hash"], self.report["hash"])
                self.assertEqual(path.read_bytes(), self.recording.read_bytes())

    def test_the_recording_tells_them(self):
        found = Run(["info", self.recording, "--json"]).report["interventions"]

        self.assertEqual([change["tick"] for change in found], [100, 400, 700, 1000])
        self.assertEqual(found[2]["changes"],
                         ["recover.detector=none", "control=krishna_kalra_fuzzy"])
        self.assertIn("changed    at tick 1000: goal=1.5,1.5,0.1",
                      Run(["info", self.recording]).out)

    def test_a_replay_repeats_them(self):
        for stage in ("sense", "classify", "recover", "control", "drive"):
            with self.subTest(stage=stage):
                done = Run(["replay", self.recording, "--component", stage, "--json"])
                self.assertEqual(done.status, 0, done.out + done.err)
                self.assertTrue(done.report["identical"])

    def test_kills_in_between_change_nothing(self):
        numbers = random.Random(2026)
        kills = 0
        while kills < KILLS:
            path = self.folder / "killed.mcap"
            process = start(["run", *RUN, *CHANGES, "--record", path, "--force", "--json"],
                            start_new_session=True)
            self.assertTrue(wait_until(lambda: len(components_of(process.pid)) == 5))
            for _ in range(4):
                time.sleep(numbers.uniform(0.0, 0.15))
                victims = components_of(process.pid)
                for stage in numbers.sample(["recover", "control", "drive"], 2):
                    if stage in victims:
                        os.kill(victims[stage], signal.SIGKILL)
                        kills += 1
            _, err = process.communicate(timeout=120)
            self.assertEqual(process.returncode, 0, err)
            self.assertEqual(path.read_bytes(), self.recording.read_bytes(), err)

    def test_a_run_that_is_cut_off_is_gone_on_with(self):
        path = self.folder / "cut.mcap"
        process = start(["run", *RUN, *CHANGES, "--record", path, "--pace", "100x"],
                        start_new_session=True)
        left = path.with_name(path.name + ".tmp~")
        self.assertTrue(wait_until(lambda: left.exists() and left.stat().st_size > 300000))
        os.kill(process.pid, signal.SIGKILL)
        process.communicate(timeout=30)

        done = Run(["run", "--resume", path, "--layout", "composed", "--json"])

        self.assertEqual(done.status, 0, done.err)
        self.assertEqual(done.report["hash"], self.report["hash"])
        self.assertEqual(path.read_bytes(), self.recording.read_bytes())

    def live(self, layout, name):
        """Changes a run that is paused, lets it go, and returns its report and the tick."""
        process = start(["run", *RUN, *layout, "--pace", "300x", "--name", name, "--json"],
                        start_new_session=True)
        self.addCleanup(process.kill)
        self.assertTrue(wait_until(lambda: Run(["pause", name]).status == 0))
        refused = Run(["swap", name, "control=nobody"])
        self.assertEqual(refused.status, 2)
        self.assertIn("unknown control behaviour 'nobody'", refused.err)
        stepped = tick_of(Run(["step", name, "3", "--json"]))
        changed = Run(["swap", name, "control=fuzzy_behaviourist", "--json"])
        self.assertEqual(changed.status, 0, changed.err)
        self.assertGreaterEqual(tick_of(changed), stepped)
        late = Run(["swap", name, "control=krishna_kalra_fuzzy", "--at", "1"])
        self.assertEqual(late.status, 2)
        self.assertRegex(late.err, r"at tick \d+ already; the earliest is tick \d+")
        never = Run(["goal", name, "1", "1", "--at", str(2**63 - 1)])
        self.assertEqual(never.status, 2)
        self.assertRegex(never.err, r"tick 9223372036854775807 never comes: the run ends at tick "
                                    r"\d+, its max_ticks")
        self.assertEqual(Run(["resume", name]).status, 0)
        out, err = process.communicate(timeout=120)
        self.assertEqual(process.returncode, 3, err)
        return json.loads(out.strip().splitlines()[-1]), tick_of(changed)

    def test_a_change_while_it_runs_is_that_of_one_that_was_planned(self):
        for name, layout in (("composed", ["--layout", "composed"]), ("processes", [])):
            with self.subTest(layout=name):
                report, tick = self.live(layout, f"swap-test-{os.getpid()}")
                planned = run_graph(*RUN, "--layout", "composed", "--at",
                                    f"{tick}:control=fuzzy_behaviourist")
                self.assertEqual(report["hash"], planned["hash"])

    def test_a_run_is_stopped(self):
        name = f"stop-test-{os.getpid()}"
        process = start(["run", *RUN, "--pace", "1x", "--name", name])
        self.assertTrue(wait_until(lambda: Run(["stop", name]).status == 0))
        _, err = process.communicate(timeout=30)
        self.assertEqual(process.returncode, 1)
        self.assertIn("stopped by a command", err)
        self.assertIn(f"no run is called '{name}'", Run(["stop", name]).err)

    def test_a_change_that_comes_after_the_end_is_told(self):
        for layout in ([], ["--layout", "composed"]):
            with self.subTest(layout=layout):
                done = Run(["run", "reactive", "--max-ticks", "9", "--json", "--at", "5:goal=1,1",
                            "--at", "50:goal=2,2", *layout])

                self.assertEqual(done.status, 3, done.err)
                self.assertEqual(done.report["notes"],
                                 ["the change at tick 50 did not come to pass: the run ended at tick 9"])

    def test_what_cannot_be_changed_is_said_before_anything_starts(self):
        for change, why in (("5:drive=unicycle", "only its goal can be changed"),
                            ("5:sense=laser", "the scan would have other beams"),
                            ("5:recover.detector=none", "as it is already"),
                            ("5:goal=1000,0", "not within the bounds"),
                            ("0:control=fuzzy_behaviourist", "tick 0 is where the run begins"),
                            ("x", "expected TICK:")):
            with self.subTest(change=change):
                done = Run(["run", *RUN, "--at", change])
                self.assertEqual(done.status, 2, done.err)
                self.assertIn(why, done.err)


if __name__ == "__main__":
    unittest.main()
