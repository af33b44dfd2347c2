# SPDX-License-Identifier: Apache-2.0
"""Runs, recordings and worlds from Python."""
import json
import os
import subprocess
import unittest

import numpy as np

import clew

COMMAND = os.environ["CLEW_COMMAND"]


def command(*arguments):
    """The JSON that the command prints."""
    done = subprocess.run([COMMAND, *map(str, arguments), "--json"], capture_output=True, text=True,
                          timeout=100, check=False)
    return json.loads(done.stdout.strip().splitlines()[-1])


class RunTest(unittest.TestCase):
    def test_a_run_has_the_hash_of_the_command(self):
        ours = clew.run("krishna_kalra", world="double-u", seed=3,
                        parameters={"sense.noise_stddev_m": 0.01},
                        parts={"recover.escape": ["fixed_sequence", "obstacle_following"]})
        theirs = command("run", "krishna_kalra", "--world", "double-u", "--seed", 3, "--set",
                         "sense.noise_stddev_m=0.01", "--with",
                         "recover.escape=fixed_sequence,obstacle_following", "--layout", "composed")

        self.assertEqual(ours.hash, theirs["hash"])
        self.assertEqual(ours.outcome, theirs["outcome"])
        self.assertEqual(ours.ticks, theirs["ticks"])
        self.assertEqual(ours.path_length_m, theirs["path_length_m"])

    def test_the_trajectory_is_the_path(self):
        run = clew.run("default")
        steps = np.diff(run.trajectory[:, :2], axis=0)

        self.assertEqual(run.trajectory.shape, (run.ticks + 1, 3))
        self.assertAlmostEqual(np.hypot(*steps.T).sum(), run.path_length_m, places=9)

    def test_bad_input_says_what_is_allowed(self):
        with self.assertRaisesRegex(clew.InputError, "did you mean 'u-trap'"):
            clew.run("default", world="u-tarp")
        with self.assertRaisesRegex(clew.InputError, "allowed: 0.1 to 20 m"):
            clew.run("default", parameters={"sense.range_m": 200})

    def test_steps_give_what_a_whole_run_gives(self):
        whole = clew.run("default")
        sim = clew.Simulation("default")
        xs = []
        while True:
            going = sim.step()
            xs.append(sim["state"]["pose_world_robot.x_m"])
            if not going:
                break

        self.assertEqual(xs, list(whole.trajectory[:, 0]))
        self.assertEqual(sim["scan"]["ranges_m"].shape, (7,))
        with self.assertRaisesRegex(KeyError, "no topic 'scn'"):
            _ = sim["scn"]

    def test_a_simulation_goes_on_from_a_saved_state(self):
        sim = clew.Simulation("krishna_kalra")
        sim.step(60)
        saved = sim.save()
        sim.step(40)
        other = clew.Simulation("krishna_kalra")
        other.load(saved)
        other.step(40)

        self.assertEqual(other.ticks, 100)
        self.assertEqual(other["state"]["pose_world_robot"]["x_m"],
                         sim["state"]["pose_world_robot"]["x_m"])
        with self.assertRaises(clew.InputError):
            other.load(saved[:-1])


class WorldTest(unittest.TestCase):
    def test_a_world_is_made_of_polygons_and_run(self):
        world = clew.World.build("pillar", bounds=(0, 0, 6, 4), start=(1, 2, 0), target=(5, 2),
                                 polygons=[[(2.8, 1.5), (3.2, 1.5), (3.2, 2.5), (2.8, 2.5)]])
        run = clew.run("default", world=world)
        world.save("pillar.yaml")

        self.assertEqual(run.outcome, "reached")
        self.assertEqual(clew.run("default", world="./pillar.yaml").hash, run.hash)

    def test_a_broken_one_is_refused(self):
        with self.assertRaisesRegex(clew.InputError, "start"):
            clew.World.build("bad", bounds=(0, 0, 1, 1), start=(5, 5, 0), target=(0.5, 0.5))

    def test_shipped_ones_are_found(self):
        self.assertIn("u-trap", clew.worlds())
        self.assertIn("default", clew.graphs())
        self.assertAlmostEqual(clew.World("u-trap").shortest_path_m, 9.519)


class RecordingTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.run_a = clew.run("krishna_kalra", record="a.mcap", force=True)
        cls.a = clew.Recording("a.mcap")

    def test_fields_are_arrays_over_ticks(self):
        ticks = self.run_a.ticks + 1

        np.testing.assert_array_equal(self.a["state"]["pose_world_robot.x_m"],
                                      self.run_a.trajectory[:, 0])
        self.assertEqual(self.a["scan"]["ranges_m"].shape, (ticks, 7))
        self.assertEqual(self.a["state"]["stamp"]["tick"].tolist(), list(range(ticks)))
        self.assertEqual(self.a["state"]["outcome"][-1].upper().split("_")[-1], "REACHED")
        self.assertEqual(self.a.hash, self.run_a.hash)
        with self.assertRaisesRegex(KeyError, "no field 'rangs_m'"):
            _ = self.a["scan"]["rangs_m"]

    def test_lists_of_different_lengths_are_filled_up(self):
        texts = [entry["rule"] for entry in self.a["event"]["entries"]]

        self.assertTrue(any("landmark_revisit" in column.tolist() for column in texts))

    def test_a_topic_is_a_frame(self):
        frame = self.a["state"].frame()

        self.assertEqual(frame.index.name, "tick")
        self.assertEqual(frame["path_length_m"].iloc[-1], self.run_a.path_length_m)

    def test_replay_diff_and_branch(self):
        same = clew.replay("a.mcap")
        changed = clew.replay(self.a, "recover", parameters={"recover.escape.leave": "paper"})
        branched = clew.branch(self.a, 100)
        clew.run("krishna_kalra", seed=1, parts={"recover.detector": "none"}, max_ticks=400,
                 record="b.mcap", force=True)
        difference = clew.diff("a.mcap", "b.mcap")

        self.assertEqual(len(same), 5)
        self.assertTrue(all(report["identical"] for report in same))
        self.assertFalse(changed[0]["identical"])
        self.assertEqual(branched.hash, self.run_a.hash)
        self.assertFalse(difference["identical"])
        self.assertGreater(difference["first_difference"]["tick"], 0)


if __name__ == "__main__":
    unittest.main()
