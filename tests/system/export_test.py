# SPDX-License-Identifier: Apache-2.0
"""Recordings in other formats: bags are read by npm's @mcap/core and decoded with the official
definitions of ROS 2, tables by Python's own csv."""
import csv
import json
import os
import pathlib
import subprocess
import tempfile
import unittest

from clew_command import SOURCE, Run

NPM = pathlib.Path(os.environ.get("CLEW_ROS2_TESTS", SOURCE / "build/tests/ros2")) / "npm"


def read_bag(path):
    done = subprocess.run(["node", "read_bag.mjs", path], cwd=NPM, capture_output=True, text=True,
                          timeout=120, check=False)
    assert done.returncode == 0, done.stderr
    head, *messages = map(json.loads, done.stdout.splitlines())
    return head, messages


class Export(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.scratch = tempfile.TemporaryDirectory()
        cls.directory = pathlib.Path(cls.scratch.name)
        cls.recording = cls.directory / "r.mcap"
        cls.report = Run(["run", "krishna_kalra", "--world", "u-trap", "--layout", "composed",
                          "--record", cls.recording, "--json"]).report

    @classmethod
    def tearDownClass(cls):
        cls.scratch.cleanup()

    def export(self, *arguments):
        return Run(["export", self.recording, *arguments])

    def test_a_bag_is_one_of_rosbag2(self):
        bag = self.directory / "bag"

        run = self.export("--rosbag2", bag, "--namespace", "r1")
        head, messages = read_bag(bag / "bag_0.mcap")

        self.assertEqual(run.status, 0, run.err)
        self.assertEqual(head["profile"], "ros2")
        ticks = self.report["ticks"] + 1
        for topic in ("/r1/scan", "/r1/odom", "/tf", "/clock", "/r1/plan"):
            self.assertEqual(head["counts"][topic], ticks, topic)
        self.assertEqual(head["topics"]["/r1/scan"]["type"], "sensor_msgs/msg/LaserScan")
        self.assertIn("reliability: reliable", head["topics"]["/r1/scan"]["qos"])
        self.assertIn("durability: transient_local", head["topics"]["/r1/map"]["qos"])
        times = [message["time_ns"] for message in messages]
        self.assertEqual(times, sorted(times))
        self.assertEqual(times[-1], round((ticks - 1) * 0.3 * 1e9))
        metadata = (bag / "metadata.yaml").read_text()
        self.assertEqual(metadata, head["rosbag2"]["serialized_metadata"])
        for line in ("version: 9", "storage_identifier: mcap", f"message_count: {len(messages)}",
                     "- bag_0.mcap", f"nanoseconds: {times[-1]}", "ros_distro: jazzy"):
            self.assertIn(line, metadata)

    def test_the_bag_says_what_the_recording_says(self):
        bag = self.directory / "same"
        self.assertEqual(self.export("--rosbag2", bag).status, 0)
        _, messages = read_bag(bag / "same_0.mcap")
        echoed = Run(["echo", self.recording, "odometry", "--jsonl"]).out.splitlines()
        scans = Run(["echo", self.recording, "scan", "--jsonl"]).out.splitlines()

        odometry = [m["message"] for m in messages if m["topic"] == "/odom"]
        self.assertEqual(len(echoed), len(odometry))
        for ours, theirs in zip(map(json.loads, echoed), odometry):
            position = theirs["pose"]["pose"]["position"]
            self.assertEqual((position["x"], position["y"]), (ours["pose_odom_robot"]["x_m"],
                                                             ours["pose_odom_robot"]["y_m"]))
            self.assertEqual(theirs["twist"]["twist"]["linear"]["x"], ours["speed_mps"])
        laser = [m["message"] for m in messages if m["topic"] == "/scan"]
        for ours, theirs in zip(map(json.loads, scans), laser, strict=True):
            # These beams go clockwise, those of a LaserScan never.
            self.assertLess(ours["bearing_step_rad"], 0)
            for range_m, distance in zip(reversed(ours["ranges_m"]), theirs["ranges"],
                                         strict=True):
                if range_m < ours["range_max_m"]:
                    self.assertAlmostEqual(distance, range_m + 0.15, places=5)
                else:
                    self.assertEqual(distance, "Infinity")
        logs = [m["message"]["msg"] for m in messages if m["topic"] == "/rosout"]
        self.assertIn("outcome: reached", logs)

    def test_the_same_recording_gives_the_same_bag(self):
        bytes_of = []
        for name in ("a/x", "b/x"):
            self.assertEqual(self.export("--rosbag2", self.directory / name).status, 0)
            bytes_of.append([(self.directory / name / file).read_bytes()
                             for file in ("x_0.mcap", "metadata.yaml")])

        self.assertEqual(bytes_of[0], bytes_of[1])

    def test_tables_have_a_line_a_sample(self):
        tables = self.directory / "tables"

        run = self.export("--csv", tables)

        self.assertEqual(run.status, 0, run.err)
        self.assertEqual(sorted(path.name for path in tables.iterdir()),
                         [f"{name}.csv" for name in ("command", "event", "guidance", "landmark",
                                                     "odometry", "scan", "state", "target")])
        with open(tables / "state.csv", newline="", encoding="utf-8") as file:
            rows = list(csv.DictReader(file))
        self.assertEqual(len(rows), self.report["ticks"] + 1)
        self.assertEqual(float(rows[-1]["path_length_m"]), self.report["path_length_m"])
        with open(tables / "scan.csv", newline="", encoding="utf-8") as file:
            self.assertIn("ranges_m[6]", next(csv.reader(file)))

    def test_what_is_there_is_kept_unless_told(self):
        for option in ("--csv", "--rosbag2"):
            place = self.directory / f"twice{option}"
            self.assertEqual(self.export(option, place).status, 0)
            again = self.export(option, place)
            forced = self.export(option, place, "--force")

            self.assertEqual(again.status, 2)
            self.assertIn("exists; --force replaces", again.err)
            self.assertEqual(forced.status, 0, forced.err)

    def test_bad_input_is_named(self):
        self.assertIn("give --csv DIR, --foxglove FILE or --rosbag2 DIR", self.export().err)
        self.assertEqual(self.export().status, 2)
        none = Run(["export", self.directory / "none.mcap", "--csv", self.directory / "n"])
        self.assertEqual(none.status, 2)
        self.assertIn("none.mcap", none.err)
        name = self.export("--rosbag2", self.directory / "n", "--namespace", "1r")
        self.assertEqual(name.status, 2)
        self.assertIn("--namespace: '1r' is no name of ROS", name.err)


if __name__ == "__main__":
    unittest.main()
