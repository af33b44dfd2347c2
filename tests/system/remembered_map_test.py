# SPDX-License-Identifier: Apache-2.0
"""Recovery by all that was seen: it reaches what can be reached, and proves what cannot."""
import unittest

from clew_command import SOAK, SOURCE, run_graph, write_file

# Pockets, a maze, a gap of 1.2 robot diameters, and a world without a way.
SAMPLE = ["u-trap", "n-fig04-invisible-minimum", "maze-8x8", "narrow-gap", "unsolvable-box"]
FEW = ["u-trap", "unsolvable-box"]
SENSORS = {
    "cones": ["default"],
    "laser": ["default", "--with", "sense=laser", "--set", "sense.range_m=4"],
    "ring": ["any_sensor", "--with", "sense=sonar_ring"],
    "infrared": ["any_sensor", "--with", "sense=infrared"],
}


FAR_TARGET = """format: clew-world/1
name: far-target
bounds: [0, 0, 1000, 10]
start: [1, 5, 0]
target: [999, 5]
target_radius: 0.2
"""


def worlds(sample=None):
    """Name and text of the static worlds named, or of all, or without CLEW_SOAK of a sample."""
    for path in sorted((SOURCE / "configs" / "worlds").glob("*.yaml")):
        text = path.read_text(encoding="utf-8")
        chosen = SOAK or path.stem in SAMPLE if sample is None else path.stem in sample
        if "moving:" not in text and chosen:
            yield path.stem, text


# A wall across, 0.2 m thick, and in it a gap of 1.05 robot diameters, in line and 0.4 m beside it.
GAP = """format: clew-world/1
name: gap
bounds: [0, 0, 8, 6]
polygons: [[[3.9, 0], [4.1, 0], [4.1, {low}], [3.9, {low}]],
           [[3.9, {high}], [4.1, {high}], [4.1, 6], [3.9, 6]]]
start: [1.5, 3, 0]
target: [6.5, 3]
target_radius: 0.2
"""


class RememberedWays(unittest.TestCase):
    def run_everywhere(self, escape, sensor, sample=None):
        for world, text in worlds(sample):
            with self.subTest(escape=escape, sensor=sensor, world=world):
                run = run_graph(*SENSORS[sensor], "--with", f"recover.escape={escape}",
                                "--world", world, "--layout", "composed", "--no-hash",
                                "--max-ticks", "6000")

                solvable = "solvable: false" not in text
                self.assertEqual(run["outcome"], "reached" if solvable else "unreachable")
                self.assertEqual(run["collisions"], 0)

    def test_a_gap_that_holds_the_robot_is_no_proof(self):
        for sensor, graph in SENSORS.items():
            for middle in (3.0, 3.4):
                with self.subTest(sensor=sensor, middle=middle):
                    world = write_file(GAP.format(low=middle - 0.1575, high=middle + 0.1575))
                    run = run_graph(*graph, "--world", world, "--layout", "composed", "--no-hash",
                                    "--max-ticks", "2500")

                    self.assertIn(run["outcome"], ("reached", "timeout"))
                    self.assertEqual(run["collisions"], 0)

    def test_slits_narrower_than_the_robot_are_a_proof(self):
        for graph in (SENSORS["cones"], SENSORS["laser"], ["krishna_kalra"]):
            with self.subTest(graph=graph):
                run = run_graph(*graph, "--world", "unsolvable-behind-wall", "--layout",
                                "composed", "--no-hash", "--max-ticks", "6000")

                self.assertEqual(run["outcome"], "unreachable")

    def test_the_neural_map_with_seven_cones(self):
        self.run_everywhere("remembered_map", "cones")

    def test_the_neural_map_with_a_laser(self):
        self.run_everywhere("remembered_map", "laser")

    def test_the_neural_map_with_a_ring_of_sonars(self):
        self.run_everywhere("remembered_map", "ring", [*FEW, "narrow-gap"])

    def test_the_neural_map_with_four_infrared_rangers(self):
        self.run_everywhere("remembered_map", "infrared", FEW)

    def test_astar_with_seven_cones(self):
        self.run_everywhere("remembered_astar", "cones")

    def test_astar_with_a_laser(self):
        self.run_everywhere("remembered_astar", "laser")


class FarTargets(unittest.TestCase):
    def test_a_step_takes_no_longer_the_farther_the_target_is(self):
        # A step that takes longer than the watchdog's 2 s ends a run as processes.
        words = ["--world", write_file(FAR_TARGET), "--max-ticks", "60"]

        processes = run_graph("default", *words)
        composed = run_graph("default", *words, "--layout", "composed")

        self.assertEqual(processes["outcome"], "timeout")
        self.assertEqual(processes["hash"], composed["hash"])
        self.assertEqual(composed["restarts"], processes["restarts"])


if __name__ == "__main__":
    unittest.main()
