# SPDX-License-Identifier: Apache-2.0
"""Components in plain C on Cyclone DDS, without any Clew library, take the places of ours."""
import pathlib
import tempfile
import unittest

from clew_command import THIRD_PARTY, Run, write_file

HEAD = "world: {world}\nrobot: disc-015\nsense: {{behaviour: cones}}\n"
TAIL = "drive: {behaviour: turn_then_step}\n"


def graph(world, *arguments, recovery="", beside=""):
    words = ", ".join(f"'{word}'" for word in (str(THIRD_PARTY / "straight_control"), *arguments))
    return write_file(HEAD.format(world=world) + recovery + f"control: {{exec: [{words}]{beside}}}\n" + TAIL)


def drive(*arguments):
    """A drive in plain C in an empty world of its own, under a controller of ours."""
    words = ", ".join(f"'{word}'" for word in (str(THIRD_PARTY / "line_drive"), *arguments))
    return write_file(HEAD.format(world="open-field") + "control: {behaviour: krishna_kalra_fuzzy}\n"
                      f"drive: {{exec: [{words}], behaviour: turn_then_step}}\n")


def open_eyes(*arguments):
    """The whole system, with a sensor in plain C that sees nothing."""
    words = ", ".join(f"'{word}'" for word in (str(THIRD_PARTY / "open_sense"), *arguments))
    return write_file(
        f"world: open-field\nrobot: disc-015\nsense: {{exec: [{words}], behaviour: cones}}\n"
        "classify: {behaviour: krishna_kalra}\n"
        "recover: {detector: landmark_revisit, escape: [obstacle_following]}\n"
        "control: {behaviour: krishna_kalra_fuzzy}\n" + TAIL)


class ThirdParty(unittest.TestCase):
    def test_the_robot_arrives_whatever_the_others_use(self):
        path = graph("open-field", "--without-guidance")

        hashes = set()
        for vendor in ("cyclonedds", "fastdds"):
            run = Run(["run", path, "--json", "--middleware", vendor])
            self.assertEqual(run.status, 0, run.err)
            self.assertEqual(run.report["outcome"], "reached")
            self.assertEqual(run.report["collisions"], 0)
            hashes.add(run.report["hash"])

        self.assertEqual(len(hashes), 1)

    def test_it_follows_guidance_where_there_is_a_recovery(self):
        path = graph("open-field", recovery="recover: {detector: none, escape: []}\n")

        run = Run(["run", path, "--json"])

        self.assertEqual(run.status, 0, run.err)

    def test_what_it_writes_is_recorded(self):
        with tempfile.TemporaryDirectory() as directory:
            recording = pathlib.Path(directory) / "r.mcap"
            picture = pathlib.Path(directory) / "r.svg"

            run = Run(["run", graph("open-field", "--without-guidance"), "--record", recording])
            plot = Run(["plot", recording, "-o", picture])

            self.assertEqual(run.status, 0, run.err)
            self.assertIn(b"/command", recording.read_bytes())
            self.assertEqual(plot.status, 0, plot.err)

    def test_a_sensor_of_someone_elses_serves_controllers_that_need_its_arrangement(self):
        run = Run(["run", open_eyes(), "--json"])

        self.assertEqual(run.status, 0, run.err)
        self.assertEqual(run.report["outcome"], "reached")

    def test_scans_of_another_arrangement_than_declared_are_refused(self):
        run = Run(["run", open_eyes("3"), "--json"])

        self.assertEqual(run.status, 1)
        self.assertIn("refuses a sample of 'scan': scan: ranges_m is 3 values long; allowed: 7, as "
                      "sense cones has", run.err)

    def test_a_drive_of_someone_elses_judges_the_outcome(self):
        with tempfile.TemporaryDirectory() as directory:
            recording = pathlib.Path(directory) / "r.mcap"
            runs = [Run(["run", drive("4.0"), "--json", "--middleware", vendor, "--record", recording,
                         "--force"]) for vendor in ("cyclonedds", "fastdds")]

            for run in runs:
                self.assertEqual(run.status, 0, run.err)
                self.assertEqual(run.report["outcome"], "reached")
            # From (1, 1) to within 0.2 m of (4, 1).
            self.assertGreaterEqual(runs[0].report["path_length_m"], 2.8)
            self.assertLess(runs[0].report["path_length_m"], 3.0)
            self.assertEqual(runs[0].report["hash"], runs[1].report["hash"])
            self.assertIn("complete", Run(["info", recording]).out)

    def test_a_drive_without_an_outcome_ends_after_max_ticks(self):
        run = Run(["run", drive("400.0"), "--json", "--max-ticks", "30"])

        self.assertEqual(run.status, 1)
        self.assertIn("drive has no outcome after tick 30, which is max_ticks", run.err)

    def test_a_drive_of_someone_elses_keeps_its_own_pace(self):
        run = Run(["run", drive("4.0"), "--pace", "2x"])

        self.assertEqual(run.status, 2)
        self.assertIn("drive has exec, and keeps its own pace; allowed: lockstep, realtime", run.err)

    def test_one_without_a_state_is_started_again_and_changes_no_byte(self):
        with tempfile.TemporaryDirectory() as directory:
            crashes = ("--without-guidance", "--crash-once", str(pathlib.Path(directory) / "was"),
                       "50")
            plain = Run(["run", graph("open-field", "--without-guidance"), "--json"])

            run = Run(["run", graph("open-field", *crashes, beside=", restart: stateless"), "--json"])

            self.assertEqual(run.status, 0, run.err)
            self.assertIn("was killed by signal 6 (Aborted); restarting it", run.err)
            self.assertEqual(run.report["restarts"], 1)
            self.assertEqual(run.report["hash"], plain.report["hash"])

    def test_one_that_does_not_say_so_is_not(self):
        run = Run(["run", graph("open-field", "--without-guidance", "--crash-at", "20"), "--json"])

        self.assertEqual(run.status, 1)
        self.assertIn("is not restarted, unless its graph says 'restart: stateless'", run.err)
        # What was done before the end is told, though nobody has reported it yet.
        self.assertEqual(run.report["ticks"], 20)

    def test_a_recording_with_one_without_a_state_is_gone_on_with_and_branches(self):
        path = graph("open-field", "--without-guidance", beside=", restart: stateless")
        with tempfile.TemporaryDirectory() as directory:
            whole = pathlib.Path(directory) / "whole.mcap"
            cut = pathlib.Path(directory) / "cut.mcap"
            branch = pathlib.Path(directory) / "branch.mcap"
            self.assertEqual(Run(["run", path, "--record", whole]).status, 0)
            cut.write_bytes(whole.read_bytes()[:whole.stat().st_size // 2])

            named = ["--exec", f"{THIRD_PARTY}/straight_control --without-guidance"]
            resume = ["run", "--resume", cut]
            go_on = ["replay", whole, "--branch", "50", "--record", branch, "--json"]

            # A recording may come from a stranger: it alone starts no program.
            for command in (resume, [*resume, "--exec", "true"], go_on):
                refused = Run(command)
                self.assertEqual(refused.status, 2)
                self.assertIn("it is run only if you name it, too", refused.err)
            resumed = Run([*resume, *named])
            branched = Run([*go_on, *named])

            self.assertEqual(resumed.status, 0, resumed.err)
            self.assertEqual(cut.read_bytes(), whole.read_bytes())
            self.assertEqual(branched.status, 0, branched.err)
            self.assertEqual(branched.report["layout"], "processes")
            self.assertEqual(branch.read_bytes(), whole.read_bytes())

    def test_it_cannot_be_composed(self):
        run = Run(["run", graph("open-field", "--without-guidance"), "--layout", "composed"])

        self.assertEqual(run.status, 2)
        self.assertIn("control has exec", run.err)


if __name__ == "__main__":
    unittest.main()
