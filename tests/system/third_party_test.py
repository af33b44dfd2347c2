# SPDX-License-Identifier: Apache-2.0
"""Components in plain C on Cyclone DDS, without any Clew library, take the places of ours."""
import pathlib
import tempfile
import unittest

from clew_command import THIRD_PARTY, Run, write_file

HEAD = "world: {world}\nrobot: disc-015\nsense: {{behaviour: cones}}\n"
TAIL = "drive: {behaviour: turn_then_step}\n"


def graph(world, *arguments, recovery=""):
    words = ", ".join(f"'{word}'" for word in (str(THIRD_PARTY / "straight_control"), *arguments))
    return write_file(HEAD.format(world=world) + recovery + f"control: {{exec: [{words}]}}\n" + TAIL)


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

    def test_it_cannot_be_composed(self):
        run = Run(["run", graph("open-field", "--without-guidance"), "--layout", "composed"])

        self.assertEqual(run.status, 2)
        self.assertIn("control has exec", run.err)


if __name__ == "__main__":
    unittest.main()
