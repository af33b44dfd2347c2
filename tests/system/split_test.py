# SPDX-License-Identifier: Apache-2.0
"""Recordings in several files and of some topics: same run, same hash, read as one, and refused with
a reason where topics lack."""
import os
import pathlib
import resource
import signal
import tempfile
import unittest

from clew_command import Run, recorder_of, run_graph, start, wait_until

LAYOUTS = ("composed", "processes")


class Recordings(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.scratch = tempfile.TemporaryDirectory(prefix="clew-split-")
        cls.folder = pathlib.Path(cls.scratch.name)
        cls.whole = cls.folder / "whole.mcap"
        cls.hash = run_graph("krishna_kalra", "--layout", "composed", "--record", cls.whole)["hash"]

    @classmethod
    def tearDownClass(cls):
        cls.scratch.cleanup()

    def ran(self, arguments, status=0):
        run = Run(arguments)
        self.assertEqual(run.status, status, run.out + run.err)
        return run

    def info(self, recording):
        return self.ran(["info", recording, "--json"]).report

    def in_a_folder(self):
        scratch = tempfile.TemporaryDirectory(prefix="clew-split-")
        self.addCleanup(scratch.cleanup)
        return pathlib.Path(scratch.name)

    def record(self, *arguments):
        recording = self.in_a_folder() / "a.mcap"
        report = run_graph("krishna_kalra", *arguments, "--record", recording)
        self.assertEqual(report["hash"], self.hash)
        return recording


class Split(Recordings):
    def test_has_the_same_files_in_every_layout(self):
        files = {}
        for layout in LAYOUTS:
            recording = self.record("--layout", layout, "--split-s", "20")
            files[layout] = {path.name: path.read_bytes() for path in recording.parent.iterdir()}

        self.assertEqual(sorted(files["composed"]), ["a.mcap", "a_1.mcap", "a_2.mcap", "a_3.mcap"])
        self.assertEqual(files["composed"], files["processes"])

    def test_is_read_as_one(self):
        recording = self.record("--layout", "composed", "--split-size", "60kB")

        info = self.info(recording)
        self.assertGreater(info["pieces"], 3)
        self.assertEqual(info["hash"], self.hash)
        self.assertTrue(info["complete"])
        self.assertIn("identical", self.ran(["replay", recording]).out)
        self.assertIn("identical", self.ran(["diff", self.whole, recording]).out)
        # A picture names its recording.
        same_name = self.in_a_folder() / "a.mcap"
        same_name.write_bytes(self.whole.read_bytes())
        pictures = [path.with_suffix(".svg") for path in (recording, same_name)]
        for path, picture in zip((recording, same_name), pictures):
            self.ran(["plot", path, "-o", picture])
        self.assertEqual(*(picture.read_text(encoding="utf-8") for picture in pictures))
        self.assertEqual(self.ran(["events", recording]).out, self.ran(["events", self.whole]).out)
        for path in recording.parent.glob("*.mcap"):
            self.assertLess(path.stat().st_size, 100000)

    def test_is_a_report_of_all_of_its_files(self):
        recording = self.record("--layout", "composed", "--split-s", "20")
        report = recording.parent / "report.html"

        self.ran(["report", recording, "-o", report])
        self.assertGreater(report.read_text(encoding="utf-8").count("<script"), 2)
        (recording.parent / "a_1.mcap").unlink()
        lacks = self.ran(["report", recording, "-o", report])
        self.assertIn("lacks its next file", lacks.err)

    def test_names_the_file_that_is_gone(self):
        recording = self.record("--layout", "composed", "--split-s", "20")
        (recording.parent / "a_2.mcap").unlink()

        told = self.ran(["info", recording], 1).out

        self.assertIn("cut off: it lacks its next file,", told)
        self.assertIn("a_2.mcap; ", told)
        self.assertIn("a_3.mcap is there, but is not read", told)
        self.assertIn("is file 2 of a recording that is split", self.ran(
            ["info", recording.parent / "a_1.mcap"], 2).err)

    def test_is_gone_on_with_when_the_run_was_killed(self):
        reference = self.record("--layout", "composed", "--split-s", "10")
        recording = self.in_a_folder() / "a.mcap"
        process = start(["run", "krishna_kalra", "--layout", "composed", "--pace", "20x",
                         "--split-s", "10", "--record", recording], start_new_session=True)
        self.assertTrue(wait_until((recording.parent / "a_2.mcap").exists))
        os.killpg(process.pid, signal.SIGKILL)
        process.wait()

        resumed = self.ran(["run", "--resume", recording, "--layout", "composed", "--json"]).report

        self.assertEqual(resumed["outcome"], "reached")
        self.assertEqual({path.name: path.read_bytes() for path in recording.parent.iterdir()},
                         {path.name: path.read_bytes() for path in reference.parent.iterdir()})

    def test_survives_its_recorder(self):
        reference = self.record("--layout", "composed", "--split-s", "10")
        recording = self.in_a_folder() / "a.mcap"
        process = start(["run", "krishna_kalra", "--pace", "30x", "--split-s", "10", "--record",
                         recording], start_new_session=True)
        self.assertTrue(wait_until((recording.parent / "a_1.mcap").exists))
        os.kill(recorder_of(process.pid), signal.SIGKILL)

        self.assertEqual(process.wait(60), 0)
        self.assertEqual({path.name: path.read_bytes() for path in recording.parent.iterdir()},
                         {path.name: path.read_bytes() for path in reference.parent.iterdir()})

    def test_overwrites_older_files_only_when_told_to(self):
        recording = self.record("--layout", "composed", "--split-s", "10")
        recording.unlink()
        run = ["run", "krishna_kalra", "--layout", "composed", "--split-s", "40", "--record",
               recording]

        self.assertIn("a_1.mcap: exists", self.ran(run, 2).err)
        self.ran([*run, "--force"])

        self.assertEqual(self.info(recording)["pieces"], 2)
        self.assertEqual(sorted(path.name for path in recording.parent.iterdir()),
                         ["a.mcap", "a_1.mcap"])

    def test_leaves_files_of_others_behind_a_number_that_is_free(self):
        recording = self.in_a_folder() / "a.mcap"
        other = recording.parent / "a_2.mcap"
        other.write_bytes(b"somebody's")
        run = ["run", "krishna_kalra", "--layout", "composed", "--split-s", "10", "--record",
               recording]

        self.assertIn("a_2.mcap: exists; --force overwrites it", self.ran(run, 2).err)
        self.assertEqual([path.name for path in recording.parent.iterdir()], ["a_2.mcap"])
        self.assertEqual(other.read_bytes(), b"somebody's")
        self.ran([*run, "--force"])
        self.assertTrue(self.info(recording)["complete"])

    def test_does_not_write_a_lost_file_anew_before_one_that_is_there(self):
        recording = self.record("--layout", "composed", "--split-s", "10")
        (recording.parent / "a_1.mcap").unlink()
        files = {path.name: path.read_bytes() for path in recording.parent.iterdir()}

        told = self.ran(["run", "--resume", recording, "--layout", "composed"], 2).err

        self.assertIn("a_2.mcap: exists, and files before it lack", told)
        self.assertEqual(files,
                         {path.name: path.read_bytes() for path in recording.parent.iterdir()})

    def test_is_not_overwritten_while_it_is_written(self):
        for layout in LAYOUTS:
            with self.subTest(layout=layout):
                recording = self.in_a_folder() / "a.mcap"
                process = start(["run", "krishna_kalra", "--layout", layout, "--pace", "20x",
                                 "--split-s", "10", "--record", recording])
                self.assertTrue(wait_until((recording.parent / "a_1.mcap").exists))
                other = ["run", "krishna_kalra", "--layout", "composed", "--force", "--record",
                         recording]

                told = self.ran([*other, "--split-s", "10"], 2).err

                self.assertIn("is being written by another process", told)
                self.assertEqual(process.wait(60), 0)
                self.assertEqual(self.info(recording)["hash"], self.hash)

    def test_stays_whole_if_the_one_that_replaces_it_cannot_begin(self):
        recording = self.record("--layout", "composed", "--split-s", "10")
        files = {path.name: path.read_bytes() for path in recording.parent.iterdir()}

        limit = 1000  # as good as a full disk
        process = start(["run", "krishna_kalra", "--layout", "composed", "--split-s", "10",
                         "--force", "--record", recording],
                        preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE,
                                                              (limit, limit)))

        told = process.communicate(timeout=60)[1]
        self.assertEqual(process.returncode, 2, told)
        self.assertIn("File too large", told)
        self.assertEqual(files,
                         {path.name: path.read_bytes() for path in recording.parent.iterdir()})

    def test_is_refused_where_it_makes_no_sense(self):
        for arguments, text in (
                (["--split-s", "10"], "--split-s: needs --record FILE"),
                (["--split-s", "10", "--record", "/dev/null"], "cannot be split"),
                (["--split-size", "12XB", "--record", "x.mcap"], "found '12XB'"),
                (["--split-size", "1MB", "--record", "x.mcap", "--record-on", "trap"],
                 "a black box")):
            with self.subTest(arguments=arguments):
                self.assertIn(text, self.ran(["run", "krishna_kalra", *arguments], 2).err)
        self.assertIn("is split into files", self.ran(
            ["sign", self.record("--layout", "composed", "--split-s", "20")], 2).err)


class ChosenTopics(Recordings):
    def test_are_all_that_is_recorded_and_the_runs_hash_stands_there(self):
        for layout in LAYOUTS:
            recording = self.record("--layout", layout, "--record-topics", "guidance,/s*,odometry,command")
            info = self.info(recording)

            self.assertEqual([topic["topic"] for topic in info["topics"]],
                             ["command", "guidance", "odometry", "scan", "state"])
            self.assertEqual(info["left_out"], ["event", "landmark", "target"])
            self.assertEqual(info["run_hash"], self.hash)
            self.assertTrue(info["complete"])

    def test_replay_what_they_suffice_for(self):
        recording = self.record("--layout", "composed", "--record-topics",
                                "guidance,scan,odometry,command")

        replayed = self.ran(["replay", recording])

        self.assertIn("control: ", replayed.out)
        self.assertIn("ticks identical", replayed.out)
        self.assertNotIn("recover: ", replayed.out)
        self.assertIn("recover is left out: --record-topics left out 'event', 'landmark', 'target'",
                      replayed.err)
        for arguments, text in (
                (["replay", recording, "--component", "recover"],
                 "has no topic 'event' (--record-topics left it out), without which recover cannot"),
                (["run", "--resume", recording], "--record-topics left out: it cannot be continued"),
                (["replay", recording, "--branch", "20"], "--record-topics left it out")):
            with self.subTest(arguments=arguments):
                self.assertIn(text, self.ran(arguments, 2).err)

    def test_that_the_run_does_not_have_are_refused(self):
        told = self.ran(["run", "krishna_kalra", "--record", "x.mcap", "--record-topics", "skan"], 2)

        self.assertIn("unknown topic of this run 'skan' (did you mean 'scan'?)", told.err)
        self.assertFalse(pathlib.Path("x.mcap").exists())

    def test_may_be_split_too(self):
        recording = self.record("--layout", "processes", "--record-topics", "state", "--split-s",
                                "20")

        info = self.info(recording)
        self.assertEqual(info["pieces"], 4)
        self.assertEqual([topic["topic"] for topic in info["topics"]], ["state"])
        self.assertEqual(info["run_hash"], self.hash)


if __name__ == "__main__":
    unittest.main()
