# SPDX-License-Identifier: Apache-2.0
"""`clew bench barn` scores graphs in the worlds of BARN that a user has. The test has two of its
own, written as those are."""
import json
import math
import pathlib
import struct
import tempfile
import unittest

from clew_command import Run

START = (-2.25, 3.0)
GOAL = (-2.25, 13.0)


def world_text(cylinders):
    models = "".join(
        f"<model name='unit_cylinder_{i}'><pose frame=''>{x} {y} 0.5 0 0 0</pose><link name='link'>"
        "<collision name='collision'><geometry><cylinder><radius>0.075</radius><length>1</length>"
        "</cylinder></geometry></collision></link></model>"
        for i, (x, y) in enumerate(cylinders))
    return f"<sdf version='1.6'><world name='default'>{models}</world></sdf>"


def npy(cells):
    """N x 2 of int64, format 1.0 of NumPy."""
    header = f"{{'descr': '<i8', 'fortran_order': False, 'shape': ({len(cells)}, 2), }}".encode()
    header += b" " * (-(10 + len(header) + 1) % 64) + b"\n"
    numbers = [number for cell in cells for number in cell]
    return (b"\x93NUMPY\x01\x00" + struct.pack("<H", len(header)) + header +
            struct.pack(f"<{len(numbers)}q", *numbers))


def path_length_m(cells):
    places = [START, *((0.15 * i - 4.575, 0.15 * j + 5.075) for i, j in cells), GOAL]
    return sum(math.dist(a, b) for a, b in zip(places, places[1:]))


# Two sides far apart; and the same with a few pillars on the straight line.
SIDES = [(x, 0.15 * j + 0.075) for x in (-4.425, -0.075) for j in range(64)]
PILLARS = [(-2.25 + dx, 6.0 + dy) for dx in (-0.15, 0.0, 0.15) for dy in (0.0, 0.15)]
STRAIGHT = [(15, j) for j in range(30)]
ROUND = [(15, 0), (9, 6), (15, 12), (15, 29)]


class Barn(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.directory = tempfile.TemporaryDirectory()
        cls.folder = pathlib.Path(cls.directory.name)
        cls.data = cls.folder / "BARN"
        # As in the challenge's repository, paths in a folder of their own.
        (cls.data / "path_files").mkdir(parents=True)
        for number, cylinders, cells in ((3, SIDES, STRAIGHT), (12, SIDES + PILLARS, ROUND)):
            (cls.data / f"world_{number}.world").write_text(world_text(cylinders), encoding="utf-8")
            (cls.data / "path_files" / f"path_{number}.npy").write_bytes(npy(cells))

    @classmethod
    def tearDownClass(cls):
        cls.directory.cleanup()

    def bench(self, *arguments, out="out"):
        return Run(["bench", "barn", "--data", self.data, "--out", self.folder / out, *arguments])

    def test_scores_follow_from_time_and_the_length_of_the_path(self):
        done = self.bench("--graph", "planner", "--graph", "any_sensor", "--json")
        self.assertEqual(done.status, 0, done.err)
        runs = [json.loads(line) for line in done.out.splitlines()]

        self.assertEqual([(run["graph"], run["world"], run["family"]) for run in runs],
                         [(graph, world, "barn") for graph in ("planner", "any_sensor")
                          for world in ("barn-3", "barn-12")])
        for run in runs:
            optimal_s = path_length_m(STRAIGHT if run["world"] == "barn-3" else ROUND) / 2.0
            barn = run["barn"]
            arrived = run["outcome"] == "reached" and run["sim_time_s"] < 100.0
            self.assertAlmostEqual(barn["optimal_time_s"], optimal_s, 9)
            self.assertEqual(barn["arrived"], arrived)
            for least, key in ((2, "score"), (4, "score_2022")):
                time_s = min(max(run["sim_time_s"], least * optimal_s), 8 * optimal_s)
                self.assertAlmostEqual(barn[key], arrived * optimal_s / time_s, 9)
        self.assertTrue(any(run["barn"]["arrived"] for run in runs))

        report = (self.folder / "out" / "report.md").read_text(encoding="utf-8")
        mean = sum(run["barn"]["score"] for run in runs[:2]) / 2
        self.assertRegex(report, r"## BARN's score\n")
        self.assertIn(f"| planner | 2 | {mean:.4f} |", report)
        # An imported world can be run again by itself.
        again = Run(["run", "planner", "--world", self.folder / "out/worlds/barn-3.yaml",
                     "--layout", "composed", "--max-ticks", "3", "--json"])
        self.assertEqual(again.status, 3, again.err)

    def test_it_goes_on_and_is_merged_as_other_benches(self):
        arguments = ("--graph", "planner")
        self.assertEqual(self.bench(*arguments, out="whole").status, 0)
        for shard in ("1/2", "2/2"):
            done = self.bench(*arguments, "--shard", shard, out=f"shard-{shard[0]}")
            self.assertEqual(done.status, 0, done.err)
        merged = Run(["bench", "--merge", self.folder / "shard-1", self.folder / "shard-2", "--out",
                      self.folder / "merged"])

        self.assertEqual(merged.status, 0, merged.err)
        for name in ("results.jsonl", "report.md"):
            self.assertEqual((self.folder / "merged" / name).read_bytes(),
                             (self.folder / "whole" / name).read_bytes())

    def test_what_is_missing_is_named(self):
        empty = self.folder / "empty"
        empty.mkdir()
        lonely = self.folder / "lonely"
        lonely.mkdir()
        (lonely / "world_7.world").write_text(world_text(SIDES), encoding="utf-8")
        broken = self.folder / "broken"
        broken.mkdir()
        (broken / "world_7.world").write_text(world_text(SIDES), encoding="utf-8")
        (broken / "path_7.npy").write_bytes(npy(STRAIGHT)[:-3])
        for arguments, words in (
                (["barn"], "needs the worlds of BARN"),
                (["barn", "--data", empty], "has no world of BARN"),
                (["barn", "--data", self.folder / "nowhere"], "cannot be read"),
                (["barn", "--data", lonely], "has no path_7.npy beside it"),
                (["barn", "--data", broken], "path_7.npy"),
                (["smoke", "--data", self.data], "needs none; barn does")):
            with self.subTest(words=words):
                done = Run(["bench", *arguments, "--out", self.folder / "refused"])
                self.assertEqual(done.status, 2, done.out + done.err)
                self.assertIn(words, done.err)


if __name__ == "__main__":
    unittest.main()
