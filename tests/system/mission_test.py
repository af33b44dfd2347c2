# SPDX-License-Identifier: Apache-2.0
"""Way-points are visited one after the other: the same bytes in every layout, whatever is killed
meanwhile; replaced, cancelled and given while the run goes on."""
import json
import os
import pathlib
import random
import signal
import tempfile
import unittest

from clew_command import Run, components_of, run_graph, start, wait_until

# Two rooms with a door between them: there and back again.
WORLD = """format: clew-world/1
name: two-rooms
bounds: [0, 0, 8, 6]
walls: [[4, 0, 4, 2], [4, 3.4, 4, 6]]
start: [1, 1, 0]
waypoints: [[3, 3, 0.3], [6, 2.5]]
target: [7, 5]
target_radius: 0.2
"""
GRAPH = """world: ./two-rooms.yaml
robot: disc-015
mission: [[3, 3, 0.5], [6, 3], [2, 5, 0.3], [1, 1]]
sense: {behaviour: cones, range_m: 1.5}
recover: {detector: known_detour, escape: [remembered_map], immediate_memory: false}
control: {behaviour: fuzzy_behaviourist, guard_margin_m: 0.01}
drive: {behaviour: turn_then_step}
"""
# Replaced on the way, cancelled, and given anew.
CHANGES = ["--at", "30:goal=6,2,0.3/5,5", "--at", "60:goal=none", "--at", "90:goal=6,5/1,5,0.4/1,1"]
STAGES = ("sense", "recover", "control", "drive")

FAR_SIDE = """format: clew-world/1
name: island
bounds: [0, 0, 8, 6]
walls: [[4, 0, 4, 6]]
start: [1, 1, 0]
waypoints: [[6, 3]]
target: [2, 5]
target_radius: 0.2
"""


def last_tick(recording):
    """Of a file that is being written."""
    told = Run(["info", recording, "--json"])
    return told.report["last_tick"] or 0 if told.out.strip() else 0


class Mission(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.directory = tempfile.TemporaryDirectory()
        cls.folder = pathlib.Path(cls.directory.name)
        (cls.folder / "two-rooms.yaml").write_text(WORLD, encoding="utf-8")
        cls.graph = cls.folder / "tour.yaml"
        cls.graph.write_text(GRAPH.replace("./two-rooms.yaml", str(cls.folder / "two-rooms.yaml")),
                             encoding="utf-8")
        cls.recording = cls.folder / "tour.mcap"
        cls.report = run_graph(cls.graph, *CHANGES, "--layout", "composed", "--record",
                               cls.recording)

    @classmethod
    def tearDownClass(cls):
        cls.directory.cleanup()

    def waypoints(self, recording):
        return Run(["info", recording, "--json"]).report["waypoints"]

    def test_a_tour_of_a_graph_ends_at_its_last_point(self):
        recording = self.folder / "plain.mcap"
        report = run_graph(self.graph, "--layout", "composed", "--record", recording)

        self.assertEqual(report["outcome"], "reached")
        self.assertIsNone(report["shortest_path_m"])
        marks = self.waypoints(recording)
        self.assertEqual([(mark["number"], mark["of"]) for mark in marks],
                         [(1, 4), (2, 4), (3, 4), (4, 4)])
        for mark, (x, y, radius) in zip(marks, ((3, 3, 0.5), (6, 3, 0.2), (2, 5, 0.3), (1, 1, 0.2))):
            distance = ((mark["x_m"] - x) ** 2 + (mark["y_m"] - y) ** 2) ** 0.5
            self.assertLessEqual(distance, radius)
        self.assertEqual(marks[-1]["tick"], report["ticks"])
        self.assertIn("way-point  2 of 4 reached at tick", Run(["info", recording]).out)
        events = [json.loads(line) for line in
                  Run(["events", recording, "--json"]).out.splitlines()]
        told = [(event["tick"], event["stage"], event["text"]) for event in events
                if event["kind"] == "waypoint"]
        self.assertEqual(told, [(mark["tick"], "drive", f"{mark['number']} of 4") for mark in marks])

    def test_the_worlds_own_waypoints_are_visited_and_a_goal_replaces_them(self):
        graph = self.folder / "own.yaml"
        text = "".join(line + "\n" for line in self.graph.read_text().splitlines()
                       if not line.startswith("mission"))
        recording = self.folder / "own.mcap"

        for planner in ("", "plan: {behaviour: astar}\n", "plan: {behaviour: neural_map}\n"):
            with self.subTest(planner=planner):
                graph.write_text(text + planner, encoding="utf-8")
                report = run_graph(graph, "--layout", "composed", "--record", recording, "--force")
                self.assertEqual(report["outcome"], "reached")
                self.assertEqual([mark["number"] for mark in self.waypoints(recording)], [1, 2, 3])

        run_graph(graph, "--layout", "composed", "--at", "1:goal=1,2", "--record", recording,
                  "--force")
        self.assertEqual(self.waypoints(recording), [])

    def test_layouts_make_no_difference(self):
        for vendor in ("cyclonedds", "fastdds"):
            with self.subTest(vendor=vendor):
                path = self.folder / "other.mcap"
                report = run_graph(self.graph, *CHANGES, "--middleware", vendor, "--record", path,
                                   "--force")
                self.assertEqual(report["hash"], self.report["hash"])
                self.assertEqual(path.read_bytes(), self.recording.read_bytes())

    def test_a_mission_is_replaced_cancelled_and_given_anew(self):
        self.assertEqual(self.report["outcome"], "reached")
        self.assertEqual([(mark["number"], mark["of"]) for mark in self.waypoints(self.recording)
                          if mark["tick"] >= 90], [(1, 3), (2, 3), (3, 3)])
        poses = [json.loads(line)["pose_world_robot"] for line in
                 Run(["echo", self.recording, "state", "--jsonl"]).out.splitlines()]
        # A cancelled mission leaves the robot where it is, until there is another.
        self.assertEqual({json.dumps(pose) for pose in poses[60:90]}, {json.dumps(poses[60])})
        self.assertNotEqual(poses[89], poses[91])

    def test_a_replay_is_exact(self):
        for stage in STAGES:
            with self.subTest(stage=stage):
                done = Run(["replay", self.recording, "--component", stage, "--json"])
                self.assertEqual(done.status, 0, done.out + done.err)
                self.assertTrue(done.report["identical"])

    def paused(self, path):
        """A run of processes that waits at its beginning, and its name."""
        name = f"tour-test-{os.getpid()}-{path.stem}"
        process = start(["run", self.graph, *CHANGES, "--pace", "100x", "--name", name, "--record",
                         path, "--json"], start_new_session=True)
        self.addCleanup(process.kill)
        self.assertTrue(wait_until(lambda: Run(["pause", name]).status == 0))
        return process, name

    def test_kills_on_the_way_change_nothing(self):
        numbers = random.Random(18)
        path = self.folder / "killed.mcap"
        process, name = self.paused(path)
        # Before the first point, between two, while there is no mission, and on the last one.
        for ticks in (15, 10, 45, 30):
            self.assertEqual(Run(["step", name, ticks]).status, 0)
            victims = components_of(process.pid)
            self.assertEqual(set(victims), set(STAGES))
            for stage in {"drive", numbers.choice(STAGES)}:
                os.kill(victims[stage], signal.SIGKILL)
            self.assertTrue(wait_until(lambda old=victims: len(
                set(components_of(process.pid).values()) - {old["drive"]}) == len(STAGES)))
        self.assertEqual(Run(["resume", name]).status, 0)
        out, err = process.communicate(timeout=120)

        self.assertEqual(process.returncode, 0, err)
        report = json.loads(out.splitlines()[-1])
        self.assertGreaterEqual(report["restarts"], 4)
        self.assertEqual(report["hash"], self.report["hash"], err)

    def test_a_run_that_is_cut_off_in_the_middle_is_gone_on_with(self):
        path = self.folder / "cut.mcap"
        process, name = self.paused(path)
        self.assertEqual(Run(["step", name, 70]).status, 0)
        left = path.with_name(path.name + ".tmp~")
        # What is in the open chunk is left in the file from time to time.
        self.assertTrue(wait_until(lambda: last_tick(left) > 40))
        os.kill(process.pid, signal.SIGKILL)
        process.communicate(timeout=30)

        done = Run(["run", "--resume", path, "--layout", "composed", "--json"])

        self.assertEqual(done.status, 0, done.err)
        self.assertEqual(done.report["hash"], self.report["hash"])

    def test_a_command_gives_and_cancels_it_while_the_run_goes_on(self):
        name = f"mission-test-{os.getpid()}"
        for layout in (["--layout", "composed"], []):
            with self.subTest(layout=layout):
                process = start(["run", self.graph, *layout, "--pace", "100x", "--name", name,
                                 "--json"], start_new_session=True)
                self.addCleanup(process.kill)
                self.assertTrue(wait_until(lambda: Run(["pause", name]).status == 0))
                cancelled = Run(["goal", name, "--cancel", "--json"])
                self.assertEqual(cancelled.status, 0, cancelled.err)
                Run(["step", name, "10"])
                given = Run(["goal", name, "2,2,0.4", "1,3", "--json"])
                self.assertEqual(given.status, 0, given.err)
                self.assertEqual(Run(["resume", name]).status, 0)
                out, err = process.communicate(timeout=120)
                self.assertEqual(process.returncode, 0, err)

                planned = run_graph(self.graph, "--layout", "composed",
                                    "--at", f"{cancelled.report['tick']}:goal=none",
                                    "--at", f"{given.report['tick']}:goal=2,2,0.4/1,3")
                self.assertEqual(json.loads(out.splitlines()[-1])["hash"], planned["hash"])

    def test_bad_input_is_named_with_its_place(self):
        planned = self.folder / "planned.yaml"
        planned.write_text(self.graph.read_text() + "plan: {behaviour: astar}\n", encoding="utf-8")
        name = f"no-run-{os.getpid()}"
        for arguments, words in (
                (["run", self.graph, "--at", "5:goal=1,1/4,1"], "way-point 2 [4, 1] is inside or on"),
                (["run", self.graph, "--at", "5:goal=1,1/90,1"], "way-point 2 [90, 1] is not within"),
                (["run", self.graph, "--at", "5:goal=1,1,0/2,2"], "way-point 1's radius is 0 m"),
                (["run", self.graph, "--at", "5:goal=1,1/"], "way-point 2, ''"),
                (["run", self.graph, "--at", "5:goal=1,1/2,nan"], "way-point 2, '2,nan'"),
                (["run", planned, "--at", "5:plan=neural_map"],
                 "plan cannot be changed on a mission of several way-points"),
                (["goal", name, "1,2", "3"], "way-point 2, '3'"),
                (["goal", name, "1"], "expected goal=X,Y"),
                (["goal", name], "where to?"),
                (["goal", name, "1", "2", "--cancel"], "where to?"),
                (["goal", name, *["1,2"] * 257], "found 257 way-points; allowed: 256")):
            with self.subTest(words=words):
                done = Run(arguments)
                self.assertEqual(done.status, 2, done.err)
                self.assertIn(words, done.err)
        bad = self.folder / "bad.yaml"
        bad.write_text(self.graph.read_text().replace("[6, 3]", "[4, 1]"), encoding="utf-8")
        done = Run(["check", bad])
        self.assertEqual(done.status, 2)
        self.assertRegex(done.err, r"bad\.yaml:3:10: .*way-point 2 \[4, 1\] is inside or on")


class Solved(unittest.TestCase):
    def solve(self, text, *options):
        with tempfile.TemporaryDirectory() as directory:
            world = pathlib.Path(directory) / "world.yaml"
            solved = pathlib.Path(directory) / "solved.yaml"
            world.write_text(text)
            told = Run(["world", "solve", world, "--json", "-o", solved, *options])
            self.assertEqual(told.status, 0, told.err)
            return told.report, solved.read_text()

    def test_a_world_with_way_points_is_solved_leg_by_leg(self):
        told, written = self.solve(WORLD)

        # Each leg is free straight on: sqrt(8), sqrt(9.25) and sqrt(7.25).
        self.assertIs(told["solvable"], True)
        self.assertAlmostEqual(told["shortest_path_m"], 8**0.5 + 9.25**0.5 + 7.25**0.5, delta=0.01)
        self.assertIn("solvable: true", written)
        self.assertNotIn("shortest_path", written)  # which no file has beside way-points

    def test_it_cannot_be_solved_if_one_leg_cannot(self):
        told, written = self.solve(FAR_SIDE)

        self.assertIs(told["solvable"], False)
        self.assertIsNone(told["shortest_path_m"])
        self.assertEqual(told["undecided"], "")
        self.assertIn("solvable: false", written)


if __name__ == "__main__":
    unittest.main()
