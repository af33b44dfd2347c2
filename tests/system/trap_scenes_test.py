# SPDX-License-Identifier: Apache-2.0
"""What the papers say of the scenes in which their recovery is shown."""
import unittest

from clew_command import run_graph


def report(graph, world, *arguments):
    """The report of a composed run."""
    return run_graph(graph, "--world", world, "--layout", "composed", "--max-ticks", "6000",
                     "--no-hash", *arguments)


def detector(name):
    """Another detector."""
    return ["--with", f"recover.detector={name}"]


def leave(rule):
    """Another leaving rule."""
    return ["--set", f"recover.escape.leave={rule}"]


class KrishnaKalraSection45(unittest.TestCase):
    """The comparison with Huang & Lee."""

    def test_the_160_degree_rule_misfires_where_there_is_no_trap(self):
        world = "kk-fig15-not-trapped"

        misled = report("krishna_kalra", world, *detector("heading_reversal"))

        self.assertGreaterEqual(misled["traps_detected"], 1)
        self.assertEqual(report("krishna_kalra", world)["traps_detected"], 0)

    def test_the_papers_leaving_rule_is_shorter_than_collinear_in_figure_16a(self):
        world = "kk-fig16a-concave-obstacle"
        rule = detector("heading_reversal")

        papers = report("krishna_kalra", world, *rule, *leave("paper"))
        collinear = report("krishna_kalra", world, *rule, *leave("collinear"))

        self.assertEqual(papers["outcome"], "reached")
        self.assertEqual(collinear["outcome"], "reached")
        self.assertLess(papers["path_length_m"], collinear["path_length_m"])


class PinBenderFigures4And5(unittest.TestCase):
    def test_without_memory_the_robot_stays_in_the_chamber(self):
        run = report("pin_bender", "pb-fig04-dead-end-chamber", *detector("none"))

        self.assertEqual(run["outcome"], "timeout")

    def test_virtual_obstacles_fill_the_chamber_and_then_the_goal_is_reached(self):
        others = ["--with", "recover.escape=virtual_obstacle", *detector("position_revisit")]
        for graph, arguments in (("pin_bender", []), ("krishna_kalra", others)):
            run = report(graph, "pb-fig04-dead-end-chamber", *arguments)

            self.assertEqual(run["outcome"], "reached", graph)
            self.assertGreaterEqual(run["virtual_targets"], 2, graph)
            self.assertEqual(run["collisions"], 0, graph)


class NakhaeiniaFigures(unittest.TestCase):
    def test_the_controller_alone_leaves_a_visible_minimum(self):
        for arguments in ([], detector("none")):
            run = report("nakhaeinia", "n-fig03-visible-minimum", *arguments)

            self.assertEqual(run["outcome"], "reached")
            self.assertEqual(run["virtual_targets"], 0)

    def test_minima_that_hold_the_controller_are_left_by_virtual_targets(self):
        for world, targets in (("n-fig09-local-minimum", 1), ("n-fig13a-complicated", 2)):
            held = report("nakhaeinia", world, *detector("none"))
            run = report("nakhaeinia", world)

            self.assertEqual(held["outcome"], "timeout", world)
            self.assertEqual(run["outcome"], "reached", world)
            self.assertEqual(run["virtual_targets"], targets, world)

    def test_surrounded_and_complicated_places_are_left(self):
        for world in ("n-fig12-surrounded", "n-fig13b-complicated", "n-fig13c-complicated"):
            self.assertEqual(report("nakhaeinia", world)["outcome"], "reached", world)


if __name__ == "__main__":
    unittest.main()
