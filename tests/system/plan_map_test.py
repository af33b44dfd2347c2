# SPDX-License-Identifier: Apache-2.0
"""Planning on a map of ROS's map_server, and on what the robot has seen: as processes over DDS."""
import json
import pathlib
import tempfile
import unittest

from clew_command import SOURCE, Run, layouts_of, run_graph

FROM_FILE = ["neural_map", "--world", "office", "--set", "plan.map=file",
             "--set", "plan.map_file=office"]
AS_SEEN = ["neural_map", "--world", "office", "--set", "plan.map=seen"]


class PlanMap(unittest.TestCase):
    def run_in_every_layout(self, arguments):
        """The report of a run that must reach its target, the same in all layouts."""
        layouts = layouts_of("neural_map")
        reports = [run_graph(*arguments, *layouts[name])
                   for name in ("composed", "cyclonedds", "fastdds", "mixed")]
        self.assertEqual(len({report["hash"] for report in reports}), 1, arguments)
        self.assertEqual(reports[0]["outcome"], "reached")
        self.assertEqual(reports[0]["collisions"], 0)
        return reports[0]

    def test_a_map_of_map_server_leads_through_the_office(self):
        report = self.run_in_every_layout(FROM_FILE)

        self.assertLess(report["path_length_m"], 1.1 * report["shortest_path_m"])

    def test_what_was_seen_leads_through_the_office(self):
        report = self.run_in_every_layout(AS_SEEN)

        self.assertLess(report["path_length_m"], 1.25 * report["shortest_path_m"])

    def test_a_recording_replays_without_the_map_files(self):
        with tempfile.TemporaryDirectory() as directory:
            folder = pathlib.Path(directory)
            for kind in ("yaml", "pgm"):
                (folder / f"office.{kind}").write_bytes(
                    (SOURCE / f"configs/maps/office.{kind}").read_bytes())
            recording = folder / "run.mcap"
            run_graph(*FROM_FILE[:-1], f"plan.map_file={folder / 'office.yaml'}", "--layout",
                      "composed", "--record", recording)
            (folder / "office.yaml").unlink()
            (folder / "office.pgm").unlink()

            replayed = Run(["replay", recording, "--component", "plan"])

            self.assertEqual(replayed.status, 0, replayed.out + replayed.err)

    def test_a_map_that_is_missing_or_broken_is_refused(self):
        def refusal(name):
            checked = Run(["run", *FROM_FILE[:-1], f"plan.map_file={name}"])
            self.assertEqual(checked.status, 2)
            return checked.err

        self.assertIn("offize", refusal("offize"))
        with tempfile.TemporaryDirectory() as directory:
            broken = pathlib.Path(directory) / "broken.yaml"
            broken.write_text((SOURCE / "configs/maps/office.yaml").read_text(encoding="utf-8"),
                              encoding="utf-8")
            self.assertIn("office.pgm", refusal(broken))
            (pathlib.Path(directory) / "office.pgm").write_bytes(b"P5\n160 100\n255\n\0\0")
            self.assertIn("ends at pixel 2 of 16000", refusal(broken))


class FloorPlans(unittest.TestCase):
    def test_the_neural_map_leads_through_every_door(self):
        with tempfile.TemporaryDirectory() as directory:
            bench = Run(["bench", "floor_plans", "--graph", "neural_map", "--json", "--out",
                         str(pathlib.Path(directory) / "results")])
        runs = [json.loads(line) for line in bench.out.splitlines()]

        self.assertEqual(len(runs), 60, bench.err)
        for run in runs:
            self.assertEqual(run["outcome"], "reached", run["world"])
            self.assertLessEqual(run["safety_stops"], 5, run["world"])
            self.assertEqual(run["collisions"], 0, run["world"])


if __name__ == "__main__":
    unittest.main()
