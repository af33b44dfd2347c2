# SPDX-License-Identifier: Apache-2.0
"""Behaviours written in Python, in any stage."""
import math
import unittest

import clew


@clew.controller("py_straight", "straight for the target", step_m=clew.number(0.1, "m", 0.01, 1.0))
class Straight:
    def __init__(self, setup, step_m):
        self.step_m = step_m

    def step(self, odometry, scan, target):
        return clew.turn_and_step(odometry.pose.bearing_rad(*target), self.step_m)


@clew.detector("py_too_far", "the path is too long", limit_m=clew.number(6.0, "m", 0.1, 1000.0))
class TooFar:
    def __init__(self, setup, limit_m):
        self.limit_m = limit_m
        self.next_m = limit_m

    def observe(self, situation):
        if situation.odometry.travel_m < self.next_m:
            return None
        self.next_m = situation.odometry.travel_m + self.limit_m
        return "too far"


@clew.escape("py_turn", "turns about and lets go")
class Turn:
    def __init__(self, setup):
        self.left = 0

    def begin(self, situation, text):
        self.left = 3

    def step(self, situation, request):
        self.left -= 1
        request.motion = clew.turn_and_step(1.0, 0.0)
        request.why = "turns"
        return "active" if self.left > 0 else "ended"


@clew.sensor("py_ring", "rays all around")
class Ring:
    def __init__(self, setup):
        self.radius_m = setup["robot_radius_m"] if setup["robot_radius_m"] else 0.15

    def layout(self):
        return 16, math.pi, -math.pi / 8, 0.0, 2.0

    def measure(self, world, pose, time_s, random):
        return [min(max(world.cone_distance_m(pose.x_m, pose.y_m,
                                              pose.heading_rad + math.pi - i * math.pi / 8, 0.0,
                                              2.0 + self.radius_m, time_s) - self.radius_m, 0.0), 2.0)
                for i in range(16)]


@clew.classifier("py_blocked", "whether something is near")
class Blocked:
    def __init__(self, setup):
        self.ticks = 0

    def step(self, odometry, scan):
        self.ticks += 1
        return (0 if scan.ranges_m.min() < 0.3 else 8), self.ticks


@clew.planner("py_direct", "the target itself")
class Direct:
    def __init__(self, setup):
        pass

    def step(self, odometry, target, target_radius_m, subgoals):
        return (*target, target_radius_m)


@clew.drive("py_slow", "a turn and a short step")
class Slow:
    def __init__(self, setup):
        pass

    def tick_s(self):
        return 0.3

    def limits(self):
        return 0.2, 10.0

    def legs(self, motion, speed_mps, turn_rate_radps):
        turn_rad, step_m = motion.as_turn_and_step(0.3, 0.3)
        return [(turn_rad, min(max(step_m, 0.0), 0.06), 0.3, 0.0)]


class BehaviourTest(unittest.TestCase):
    def test_every_stage_takes_one(self):
        for graph, parts in [("reactive", {"control": "py_straight"}),
                             ("reactive", {"drive": "py_slow"}),
                             ("neural_map", {"plan": "py_direct"}),
                             ("krishna_kalra", {"classify": "py_blocked",
                                                "recover.detector": "position_revisit"}),
                             ("krishna_kalra", {"recover.detector": "py_too_far",
                                                "recover.escape": "py_turn"})]:
            run = clew.run(graph, world="open-field", parts=parts, max_ticks=600)

            self.assertEqual(run.outcome, "reached", (graph, parts))
            self.assertEqual(run.hash,
                             clew.run(graph, world="open-field", parts=parts, max_ticks=600).hash)

    def test_a_sensor_measures_as_ours_does(self):
        ours = clew.run("any_sensor", world="open-field", parts={"sense": "py_ring"}, max_ticks=600)

        self.assertEqual(ours.outcome, "reached")

    def test_a_detector_in_python_says_trap_and_its_escape_is_begun(self):
        clew.run("krishna_kalra", parts={"recover.detector": "py_too_far",
                                         "recover.escape": "py_turn"},
                 max_ticks=200, record="py.mcap", force=True)
        entries = clew.Recording("py.mcap")["event"]["entries"][0]

        self.assertIn("py_too_far", entries["rule"].tolist())

    def test_state_is_saved_with_the_run(self):
        parts = {"recover.detector": "py_too_far", "recover.escape": "py_turn"}
        sim = clew.Simulation("krishna_kalra", parts=parts)
        sim.step(61)
        saved = sim.save()
        sim.step(60)
        other = clew.Simulation("krishna_kalra", parts=parts)
        other.load(saved)
        other.step(60)

        self.assertEqual(other["state"]["pose_world_robot.x_m"],
                         sim["state"]["pose_world_robot.x_m"])
        self.assertEqual(other["guidance"]["why"], sim["guidance"]["why"])

    def test_an_exception_reaches_the_caller(self):
        @clew.controller("py_broken", "fails")
        class Broken:  # pylint: disable=unused-variable
            def __init__(self, setup):
                pass

            def step(self, odometry, scan, target):
                raise RuntimeError("on purpose")

        with self.assertRaisesRegex(RuntimeError, "on purpose"):
            clew.run("reactive", parts={"control": "py_broken"})

    def test_names_and_methods_are_checked(self):
        with self.assertRaisesRegex(clew.InputError, "already"):
            clew.controller("py_straight")(Straight)
        with self.assertRaisesRegex(TypeError, "needs the method observe"):
            clew.detector("py_nothing")(Slow)


if __name__ == "__main__":
    unittest.main()
