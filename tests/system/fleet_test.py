# SPDX-License-Identifier: Apache-2.0
"""Several robots in one world: one hash, recordings that replay by themselves, and encounters."""
import json
import pathlib
import signal
import subprocess
import tempfile
import time
import unittest

from clew_command import CLEW, SOURCE, Run

FLEETS = sorted((SOURCE / "configs/fleets").glob("*.yaml"))


class Fleet(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.directory = pathlib.Path(scratch.name)

    def test_shipped_fleets_have_one_hash_and_recordings_that_replay(self):
        self.assertGreaterEqual(len(FLEETS), 2)
        listed = Run(["list", "fleets", "--names"])
        self.assertEqual(listed.out.split(), [file.stem for file in FLEETS])
        for file in FLEETS:
            with self.subTest(file.stem):
                folder = self.directory / "not" / "there" / file.stem
                one = Run(["run", file.stem, "--max-ticks", 120, "--threads", 1, "--json"])
                two = Run(["run", file, "--max-ticks", 120, "--threads", 2, "--json",
                           "--record", folder])
                self.assertEqual(one.report["hash"], two.report["hash"], one.err + two.err)
                self.assertEqual(one.report["contacts"], 0)
                for robot in two.report["robots"][:4]:
                    info = Run(["info", robot["recording"], "--json"])
                    self.assertEqual(info.report["hash"], robot["hash"])
                    replay = Run(["replay", robot["recording"]])
                    self.assertEqual(replay.status, 0, replay.out + replay.err)

    def test_recordings_are_not_overwritten_unasked(self):
        order = ["run", "two_at_a_gap", "--max-ticks", 5, "--record", self.directory, "--json"]
        self.assertEqual(Run(order).status, 3)
        again = Run(order)
        self.assertEqual(again.status, 2)
        self.assertIn("west.mcap", again.err)
        self.assertEqual(Run([*order, "--force"]).status, 3)

    def test_options_of_one_robot_are_refused(self):
        for option in (["--name", "mine"], ["--with", "recover.detector=none"],
                       ["--world", "u-trap"], ["--pace", "realtime"], ["--hosts", "hosts.yaml"],
                       ["--host", "sense=far"], ["--fallback", "local"]):
            refused = Run(["run", "two_at_a_gap", *option])
            self.assertEqual(refused.status, 2)
            self.assertIn(option[0], refused.err)
            self.assertIn("allowed: --record", refused.err)
        self.assertEqual(Run(["run", "reactive", "--threads", 2]).status, 2)
        checked = Run(["check", SOURCE / "configs/fleets/two_at_a_gap.yaml"])
        self.assertEqual(checked.status, 2)

    def test_four_robots_as_twenty_processes_have_the_hash_of_one_process(self):
        fleet = self.four_robots()
        alone = Run(["run", fleet, "--json"])
        logs, folder = self.directory / "logs", self.directory / "out"
        vendors = ["--middleware", "cyclonedds", "--middleware", "plan=fastdds"]
        apart = Run(["run", fleet, "--layout", "processes", *vendors, "--record", folder,
                     "--log-dir", logs, "--json"])
        self.assertEqual(apart.status, alone.status, apart.err)
        self.assertEqual(apart.report["hash"], alone.report["hash"])
        stages = ["control", "drive", "plan", "recover", "sense"]
        names = [file.name for file in logs.iterdir()]
        for stage in stages:
            self.assertEqual(sum(stage in name for name in names), 4, names)
        for robot in apart.report["robots"]:
            replay = Run(["replay", robot["recording"]])
            self.assertEqual(replay.status, 0, replay.out + replay.err)
            self.assertIn(robot["hash"], Run(["info", robot["recording"]]).out)
        self.assertEqual(Run(["run", fleet, "--layout", "processes", "--record", folder]).status, 2)
        refused = Run(["run", fleet, "--middleware", "fastdds"])
        self.assertEqual(refused.status, 2)
        self.assertIn("--middleware: needs --layout processes", refused.err)
        unknown = Run(["run", fleet, "--layout", "processes", "--middleware", "fly=fastdds"])
        self.assertEqual(unknown.status, 2)
        self.assertIn("fly", unknown.err)

    def test_an_interrupt_ends_robots_that_run_as_processes(self):
        # Both stay in the trap: a run of some seconds as processes.
        fleet = self.directory / "endless.yaml"
        fleet.write_text("format: clew-fleet/1\nworld: u-trap\nmax_ticks: 20000\nrobots:\n" + "".join(
            f"  - {{name: r{x}, graph: reactive, start: [{x}, 1.5, 1.571], target: [{x}, 9]}}\n"
            for x in (4, 6)), encoding="utf-8")
        process = subprocess.Popen(
            [CLEW, "run", str(fleet), "--layout", "processes", "--log-dir",
             str(self.directory / "logs"), "--json"],
            stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        self.addCleanup(process.kill)
        self.wait_for(lambda: list(self.directory.glob("logs/*drive*")), process)
        process.send_signal(signal.SIGINT)
        out, err = process.communicate(timeout=60)
        self.assertEqual(process.returncode, 130, out + err)
        self.assertEqual(json.loads(out)["outcome"], "aborted")

    def wait_for(self, is_there, process):
        """Until what a process makes is there; it must not end before."""
        deadline = time.monotonic() + 120
        while not is_there():
            self.assertIsNone(process.poll(), "it ended before it was interrupted")
            self.assertLess(time.monotonic(), deadline, "what is waited for did not come")
            time.sleep(0.05)

    def four_robots(self):
        """They start at the sides of a field and meet in its middle."""
        places = [("west", "2, 3, 0", "8, 3"), ("east", "8, 3, 3.14", "2, 3"),
                  ("south", "5, 1, 1.57", "5, 5"), ("north", "5, 5, -1.57", "5, 1")]
        # With time to start 20 processes on a busy machine.
        graph = self.directory / "patient.yaml"
        graph.write_text((SOURCE / "configs/graphs/among_robots.yaml").read_text(encoding="utf-8") +
                         "\nstart_timeout_s: 60\n", encoding="utf-8")
        file = self.directory / "four.yaml"
        file.write_text("format: clew-fleet/1\nworld: open-field\nmax_ticks: 80\n"
                        "robots:\n" + "".join(
                            f"  - {{name: {name}, graph: {graph}, start: [{start}], "
                            f"target: [{target}]}}\n" for name, start, target in places),
                        encoding="utf-8")
        return file

    def test_an_interrupt_closes_the_recordings(self):
        folder = self.directory / "cut"
        process = subprocess.Popen(
            [CLEW, "run", "twenty_in_a_hall", "--max-ticks", "25000", "--json", "--record",
             str(folder)], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        self.addCleanup(process.kill)
        self.wait_for(folder.is_dir, process)
        time.sleep(0.5)
        process.send_signal(signal.SIGINT)
        out, err = process.communicate(timeout=120)
        self.assertEqual(process.returncode, 130, err)
        report = json.loads(out)
        self.assertEqual(report["outcome"], "aborted")
        self.assertEqual(len(report["robots"]), 20)
        info = Run(["info", report["robots"][0]["recording"]])
        self.assertEqual(info.status, 0, info.err)

    def test_encounters_are_repeatable_and_can_be_written(self):
        order = ["encounters", "--robots", "2", "--count", 1, "--families", "crossing,door"]
        first = Run([*order, "--json"])
        self.assertEqual(first.status, 0, first.err)
        results = [json.loads(line) for line in first.out.splitlines()]
        self.assertEqual([result["robots"] for result in results], [2, 2])
        for result in results:
            self.assertEqual((result["reached"], result["contacts"]), (2, 0))
        folder = self.directory / "it's \"mine\""
        self.assertEqual(Run([*order, "--write", folder]).status, 0)
        self.assertEqual(Run([*order, "--write", folder]).status, 2)
        self.assertEqual(Run([*order, "--write", folder, "--force"]).status, 0)
        for result in results:
            run = Run(["run", folder / (result["encounter"] + ".yaml"), "--json"])
            self.assertEqual(run.status, 0, run.err)
            self.assertEqual(run.report["hash"], result["hash"])
        self.assertIn("crossing, corridor, door", Run(["encounters", "--families", "gap"]).err)
        for twice in (["--robots", "2,3,2"], ["--families", "door,door"]):
            refused = Run(["encounters", *twice])
            self.assertEqual(refused.status, 2)
            self.assertIn(twice[0] + ": found " + twice[1].rsplit(",")[0] + " twice", refused.err)


if __name__ == "__main__":
    unittest.main()
