# SPDX-License-Identifier: Apache-2.0
"""Bags of ROS 2 as recordings, and worlds of others as worlds: what was imported is used."""
import json
import pathlib
import re
import tempfile
import unittest

from clew_command import Run

PICTURE = "P2\n# a room with a pillar\n20 12\n255\n" + "\n".join(
    " ".join("0" if row in (0, 11) or column in (0, 19) or (column == 9 and 3 < row < 8) else "254"
             for column in range(20)) for row in range(12)) + "\n"
MAP = ("image: room.pgm\nresolution: 0.5\norigin: [-5, -3, 0]\nnegate: 0\noccupied_thresh: 0.65\n"
       "free_thresh: 0.196\n")


class Import(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.directory = pathlib.Path(scratch.name)

    def record_and_export(self):
        recording = self.directory / "r.mcap"
        report = Run(["run", "krishna_kalra", "--world", "u-trap", "--layout", "composed",
                      "--record", recording, "--json"]).report
        bag = self.directory / "bag"
        exported = Run(["export", recording, "--rosbag2", bag])
        self.assertEqual(exported.status, 0, exported.err)
        return recording, bag, report

    def samples(self, recording, topic):
        done = Run(["echo", recording, topic, "--jsonl"])
        self.assertEqual(done.status, 0, done.err)
        return [json.loads(line) for line in done.out.splitlines()]

    def test_a_bag_feeds_our_stages_and_replays_exactly(self):
        recording, bag, report = self.record_and_export()
        imported = self.directory / "imported.mcap"

        run = Run(["import", bag, "-o", imported, "--graph", "krishna_kalra", "--target", 5.1, 9,
                   "--json"])

        self.assertEqual(run.status, 0, run.err)
        self.assertEqual(run.report["ticks"], report["ticks"] + 1)
        theirs = self.samples(recording, "scan")
        ours = self.samples(imported, "scan")
        for a, b in zip(theirs, ours, strict=True):
            for x, y in zip(a["ranges_m"], b["ranges_m"], strict=True):
                self.assertAlmostEqual(x, y, places=5)  # a bag has single precision
        for a, b in zip(self.samples(recording, "odometry"), self.samples(imported, "odometry")):
            self.assertEqual(a["pose_odom_robot"]["x_m"], b["pose_odom_robot"]["x_m"])
        for component in ("classify", "recover", "control"):
            replayed = Run(["replay", imported, "--component", component, "--json"])
            self.assertEqual(replayed.status, 0, replayed.err)
            self.assertTrue(replayed.report["identical"])
        # The stages see what they saw in the run, to single precision: the same classes.
        classes = [[sample["spatial_class"] for sample in self.samples(of, "landmark")]
                   for of in (recording, imported)]
        self.assertEqual(*classes)

    def test_a_bag_is_refused_with_its_reason(self):
        _, bag, _ = self.record_and_export()
        out = self.directory / "x.mcap"
        empty = self.directory / "empty"
        empty.mkdir()
        sqlite = self.directory / "sqlite"
        sqlite.mkdir()
        (sqlite / "bag_0.db3").write_bytes(b"SQLite")
        for arguments, words in (
                ([empty], "has no .mcap file"), ([sqlite], "is a bag of SQLite"),
                ([self.directory / "none"], "none"),
                ([bag, "--scan-topic", "/front"], "has no topic '/front' of "
                                                  "sensor_msgs/msg/LaserScan; it has /scan"),
                ([bag, "--graph", "none"], "none")):
            run = Run(["import", *arguments, "-o", out])
            self.assertEqual(run.status, 2, arguments)
            self.assertIn(words, run.err)
            self.assertFalse(out.exists())

    def test_a_map_of_ros_is_a_world_to_run_in(self):
        (self.directory / "room.pgm").write_text(PICTURE)
        source = self.directory / "room.yaml"
        source.write_text(MAP)
        world = self.directory / "world.yaml"

        done = Run(["world", "import", source, "-o", world])
        solved = Run(["world", "solve", world, "--json"])
        run = Run(["run", "krishna_kalra", "--world", world, "--layout", "composed", "--json"])

        self.assertEqual(done.status, 0, done.err)
        self.assertTrue(solved.report["solvable"])
        # From one corner of the room to the other, the pillar aside.
        self.assertGreater(solved.report["shortest_path_m"], 9.0)
        self.assertEqual(run.report["outcome"], "reached")

    def test_a_place_is_numbers_with_commas_or_without(self):
        (self.directory / "room.pgm").write_text(PICTURE)
        source, world = self.directory / "room.yaml", self.directory / "world.yaml"
        source.write_text(MAP)
        self.assertEqual(Run(["world", "import", source, "-o", world]).status, 0)
        whole = world.read_text()
        start = re.search(r"^start: \[(.*)\]$", whole, re.M).group(1).split(", ")
        for words in (start, [",".join(start)]):
            done = Run(["world", "import", source, "-o", world, "--start", *words])

            self.assertEqual((done.status, world.read_text()), (0, whole), done.err)
        refused = Run(["world", "import", source, "-o", world, "--start", "1,x,0"])
        self.assertIn("--start: found 'x'", refused.err)

    def test_severity_is_depth_over_range(self):
        done = Run(["world", "severity", "u-trap", "--range", "2", "--json"])
        solved = Run(["world", "solve", "u-trap", "--json"])
        of_graph = Run(["world", "severity", "u-trap", "--graph", "krishna_kalra", "--json"])

        self.assertEqual(done.status, 0, done.err)
        (trap,) = done.report["traps"]
        (same,) = solved.report["traps"]
        self.assertEqual(trap["depth_m"], same["depth_m"])
        self.assertEqual(trap["depth_ranges"], trap["depth_m"] / 2)
        self.assertEqual(done.report["severity_ranges"], trap["depth_ranges"])
        self.assertEqual(of_graph.report["range_m"], 1.5)
        self.assertEqual(done.report["nested_pockets"], 1)
        self.assertIsNone(trap["inside_of"])
        # A way beside the U only comes nearer.
        self.assertEqual(done.report["necessary_backtrack_m"], 0)
        self.assertGreater(done.report["bug2_bound_m"], solved.report["shortest_path_m"])
        self.assertEqual(done.report["resolution_m"], 0.05)

    def test_a_source_is_refused_with_its_place(self):
        bad = self.directory / "bad.yaml"
        bad.write_text(MAP + "mode: other\n")
        (self.directory / "room.pgm").write_text(PICTURE)
        for source, words in ((bad, "bad.yaml:7"), (self.directory / "none.map", "No such file"),
                              (self.directory / "a.txt", ".scen (MovingAI)")):
            run = Run(["world", "import", source, "-o", self.directory / "w.yaml"])
            self.assertEqual(run.status, 2)
            self.assertIn(words, run.err)


if __name__ == "__main__":
    unittest.main()
