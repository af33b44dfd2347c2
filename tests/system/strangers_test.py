# SPDX-License-Identifier: Apache-2.0
"""A recording may come from a stranger, and others may touch a run's files: nothing is run that the
user did not name, nothing is overwritten, and no state harms the program that loads it."""
import os
import pathlib
import signal
import tempfile
import unittest

from clew_command import (LAYOUTS, SOURCE, THIRD_PARTY, Run, run_graph, start, wait_until,
                          write_file)

HOSTILE = SOURCE / "tests/hostile"
# Some seconds of ticks; the robot wanders before a wall.
RUN = ["krishna_kalra", "--world", "unsolvable-behind-wall", "--with", "recover.detector=none",
       "--max-ticks", "2000"]


class Strangers(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.directory = pathlib.Path(scratch.name)
        self.recording = self.directory / "r.mcap"
        self.growing = self.directory / "r.mcap.tmp~"

    def test_a_crafted_state_is_refused_wherever_it_is_loaded(self):
        commands = (["replay"], ["plot", "--tick", "240", "-o", self.directory / "p.svg"],
                    ["replay", "--branch", "240", "--record", self.directory / "b.mcap"])
        for path in sorted(HOSTILE.glob("*.mcap")):
            for command in commands:
                with self.subTest(file=path.name, command=command[0]):
                    done = Run([command[0], path, *command[1:]])
                    self.assertEqual(done.status, 2, done.err)
                    self.assertRegex(done.err, r"the saved state of recover is not one of this "
                                               r"component: .*, byte \d+ of \d+")

    def test_a_program_that_a_recording_names_is_run_only_if_it_is_named_again(self):
        program = f"{THIRD_PARTY}/straight_control --without-guidance"
        graph = write_file("world: open-field\nrobot: disc-015\nsense: {behaviour: cones}\n"
                           f"control: {{exec: [{', '.join(program.split())}]}}\n"
                           "drive: {behaviour: turn_then_step}\n")
        run_graph(graph, "--record", self.recording)
        replay = ["replay", self.recording, "--component", "control", "--publish", "--start"]

        for wrong in ([], ["--exec", "true"]):
            refused = Run([*replay, *wrong])
            self.assertEqual(refused.status, 2)
            self.assertIn("it is run only if you name it, too", refused.err)
        self.assertEqual(Run([*replay, "--exec", program]).status, 0)

    def test_texts_of_a_strangers_file_steer_no_terminal(self):
        graph = write_file("world: open-field\nrobot: disc-015\n\"a\\e[2Jb\\x9b\": 1\n")

        refused = Run(["check", graph])

        self.assertEqual(refused.status, 2)
        self.assertIn(r"unknown key 'a\x1b[2Jb\xc2\x9b'", refused.err)
        self.assertNotRegex(refused.err, "[\x00-\x08\x0b-\x1f\x7f-\x9f]")

    def test_names_of_files_steer_no_terminal(self):
        out = self.directory / "a\x1b[2Jb"

        done = Run(["hunt", "krishna_kalra", "--world", "open-field", "--property", "outcome == reached",
                    "--runs", "1", "--max-ticks", "100", "--out", out])

        self.assertEqual(done.status, 0, done.err)
        self.assertIn(r"a\x1b[2Jb/runs.jsonl", done.out)
        self.assertNotIn("\x1b", done.out)

    def test_a_run_that_dies_at_once_can_be_gone_on_with(self):
        whole = run_graph(*RUN, "--layout", "composed")
        process = start(["run", *RUN, "--record", self.recording], start_new_session=True)
        self.assertTrue(wait_until(self.growing.exists))
        self.assertTrue(wait_until(lambda: self.growing.stat().st_size > 0, 1))
        os.kill(process.pid, signal.SIGKILL)
        process.communicate(timeout=30)

        done = Run(["run", "--resume", self.recording, "--json"])

        self.assertEqual(done.status, 3, done.err)
        self.assertEqual(done.report["hash"], whole["hash"])

    def touched(self, layout, touch):
        """A recorded run during which `touch` does something to its file."""
        process = start(["run", *RUN, *layout, "--pace", "100x", "--record", self.recording])
        self.assertTrue(wait_until(
            lambda: self.growing.exists() and self.growing.stat().st_size > 100000))
        touch()
        _, err = process.communicate(timeout=60)
        self.assertEqual(process.returncode, 1, err)
        return err

    def test_a_file_that_somebody_cuts_is_noticed(self):
        for name in ("composed", "cyclonedds"):
            with self.subTest(layout=name):
                err = self.touched(LAYOUTS[name], lambda: os.truncate(self.growing, 0))
                self.assertIn("was cut by somebody else while it was written", err)
                self.growing.unlink()

    def test_a_file_that_takes_the_final_name_is_not_overwritten(self):
        for name in ("composed", "cyclonedds"):
            with self.subTest(layout=name):
                err = self.touched(LAYOUTS[name], lambda: self.recording.write_text("mine"))
                self.assertIn("has appeared while the run went on, and is not overwritten", err)
                self.assertEqual(self.recording.read_text(), "mine")
                self.assertGreater(Run(["info", self.growing, "--json"]).report["ticks"], 1999)
                self.growing.unlink()
                self.recording.unlink()


if __name__ == "__main__":
    unittest.main()
