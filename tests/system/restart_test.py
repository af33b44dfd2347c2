# SPDX-License-Identifier: Apache-2.0
"""Any component, and the recorder, may be killed or frozen at any moment: the run ends with the
recording that it would have made, byte for byte."""
import os
import pathlib
import random
import signal
import subprocess
import tempfile
import time
import unittest

from clew_command import (CLEW, SOAK, Run, components_of, recorder_of, wait_until, write_file)

# Some seconds of ticks; the robot wanders before a wall.
RUN = ["krishna_kalra", "--world", "unsolvable-behind-wall", "--with", "recover.detector=none",
       "--max-ticks", "4000"]
STAGES = ["sense", "classify", "recover", "control", "drive", "recorder"]
KILLS = 200 if SOAK else 12
VENDORS = {"cyclonedds": ["--middleware", "cyclonedds"], "fastdds": ["--middleware", "fastdds"],
           "mixed": ["--middleware", "sense=fastdds", "--middleware", "recover=fastdds"]}


class Restart(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.directory = tempfile.TemporaryDirectory()
        cls.undisturbed = pathlib.Path(cls.directory.name) / "undisturbed.mcap"
        run = Run(["run", *RUN, "--layout", "composed", "--record", cls.undisturbed])
        assert run.status == 3, run.err

    @classmethod
    def tearDownClass(cls):
        cls.directory.cleanup()

    def disturb(self, layout, disturbance):
        """A run during which `disturbance(processes)` is called until it returns False."""
        def processes():
            found = components_of(process.pid)
            recorder = recorder_of(process.pid)
            return {**found, "recorder": recorder} if recorder else found

        path = pathlib.Path(self.directory.name) / "disturbed.mcap"
        process = subprocess.Popen([CLEW, "run", *RUN, *layout, "--record", path, "--force",
                                    "--json"], text=True, stdout=subprocess.PIPE,
                                   stderr=subprocess.PIPE, start_new_session=True)
        self.assertTrue(wait_until(lambda: len(processes()) == 6))
        while process.poll() is None and disturbance(processes()):
            pass
        out, err = process.communicate(timeout=120)
        self.assertEqual(process.returncode, 3, err)
        self.assertEqual(path.read_bytes(), self.undisturbed.read_bytes(), err)
        return out, err

    def test_killed_components_lose_nothing(self):
        numbers = random.Random(2000)
        for name, layout in VENDORS.items():
            with self.subTest(vendor=name):
                kills = 0
                while kills < KILLS:
                    left = min(4, KILLS - kills)

                    def kill(components):
                        nonlocal kills, left
                        time.sleep(numbers.uniform(0.0, 0.3))
                        # One at a time, or two at once.
                        for stage in numbers.sample(STAGES, numbers.choice([1, 1, 2])):
                            if stage in components:
                                try:
                                    os.kill(components[stage], signal.SIGKILL)
                                except ProcessLookupError:
                                    continue
                                kills += 1
                                left -= 1
                        return left > 0

                    self.disturb(layout, kill)

    def freeze(self, layout, victim, seconds):
        def stop_and_continue(components):
            os.kill(components[victim], signal.SIGSTOP)
            time.sleep(seconds)
            try:
                os.kill(components[victim], signal.SIGCONT)
            except ProcessLookupError:
                pass  # it did not report, and was killed
            return False

        out, _ = self.disturb(layout, stop_and_continue)
        self.assertIn('"outcome":"timeout"', out)

    def test_a_frozen_process_loses_nothing(self):
        cases = [(name, "classify") for name in VENDORS] + [("cyclonedds", "recorder")]
        if SOAK:
            cases = [(name, stage) for name in VENDORS for stage in STAGES]
        for name, victim in cases:
            with self.subTest(vendor=name, victim=victim):
                self.freeze(VENDORS[name], victim, 3.0)

    def test_a_process_that_comes_back_about_when_its_lease_ends_loses_nothing(self):
        # Some of the others have forgotten it by then, and some have not.
        for seconds in ([0.9, 1.2, 1.45, 1.55, 1.75, 1.9, 2.3] if SOAK else [1.45, 1.75]):
            with self.subTest(seconds=seconds):
                self.freeze(["--middleware", "sense=fastdds"], "sense", seconds)

    def test_restarts_are_counted_and_told(self):
        for victim in ("recover", "recorder"):
            def kill_once(components):
                os.kill(components[victim], signal.SIGKILL)
                return False

            out, err = self.disturb(VENDORS["cyclonedds"], kill_once)

            self.assertIn('"restarts":1', out)
            self.assertRegex(err, victim + r" \(process \d+\) was killed by signal 9 \(Killed\); "
                                  "restarting it")

    def test_the_limit_of_the_graph_ends_the_run(self):
        graph = write_file("world: unsolvable-box\nrobot: disc-015\nsense: {behaviour: cones, "
                           "process: {restart_limit: 0}}\ncontrol: {behaviour: "
                           "krishna_kalra_fuzzy}\ndrive: {behaviour: turn_then_step}\n")
        process = subprocess.Popen([CLEW, "run", graph, "--pace", "5x"], text=True,
                                   stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                                   start_new_session=True)
        self.assertTrue(wait_until(lambda: len(components_of(process.pid)) == 3))

        os.kill(components_of(process.pid)["sense"], signal.SIGKILL)
        _, err = process.communicate(timeout=30)

        self.assertEqual(process.returncode, 1)
        self.assertIn("it was restarted 0 times, which is its limit", err)


if __name__ == "__main__":
    unittest.main()
