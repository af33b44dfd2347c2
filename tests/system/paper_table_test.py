# SPDX-License-Identifier: Apache-2.0
"""What Krishna & Kalra 2000 say of their figures, and the tables in docs/notes/recover.md."""
import unittest

from clew_command import SOURCE, load_tool

paper_table = load_tool("paper-table")

TRAPS = ["kk-fig10-bends-and-kinks", "kk-fig11a-oscillation", "kk-fig11c-double-wall",
         "kk-fig12-hooks", "kk-fig14-som-cannot-detect", "kk-fig16a-concave-obstacle",
         "kk-fig16c-concave-obstacle-mirrored"]
MAZE = "kk-fig13-maze-four-loops"
NO_TRAPS = [world for world in paper_table.worlds("kk-*") if world not in [*TRAPS, MAZE]]


def run(world, variant):
    """The report of a run of the table."""
    return paper_table.run(world, paper_table.VARIANTS[variant])


class Figures(unittest.TestCase):
    def test_fuzzy_control_alone_passes_clutter_and_what_is_no_trap(self):
        for world in ("kk-fig07-clutter", "kk-fig15-not-trapped"):
            self.assertEqual(run(world, "reactive")["outcome"], "reached", world)

    def test_fuzzy_control_alone_is_trapped(self):
        for world in [*TRAPS, MAZE]:
            self.assertEqual(run(world, "reactive")["outcome"], "timeout", world)

    def test_the_full_system_notices_and_leaves_the_traps(self):
        for variant in ("SOM + ART", "as the paper"):
            for world in [*TRAPS, MAZE]:
                report = run(world, variant)
                self.assertEqual(report["outcome"], "reached", (world, variant))
                self.assertGreaterEqual(report["traps_detected"], 1, (world, variant))

    def test_art_alone_leads_out_of_the_maze(self):
        report = run(MAZE, "ART")

        self.assertEqual(report["outcome"], "reached")
        self.assertGreaterEqual(report["traps_detected"], 1)

    def test_art_notices_what_the_map_does_not_know(self):
        self.assertEqual(run("kk-fig14-som-cannot-detect", "SOM")["traps_detected"], 0)
        self.assertEqual(run("kk-fig14-som-cannot-detect", "ART")["traps_detected"], 1)

    def test_immediate_memory_shortens_the_corner(self):
        without = run("kk-fig08-right-angle-corner", "SOM + ART, no IMAS")

        self.assertLess(run("kk-fig08-right-angle-corner", "SOM + ART")["path_length_m"],
                        without["path_length_m"])

    def test_no_recovery_where_there_is_no_trap(self):
        for world in NO_TRAPS:
            for variant in ("SOM + ART", "SOM", "ART"):
                report = run(world, variant)
                self.assertEqual(report["outcome"], "reached", (world, variant))
                self.assertEqual(report["traps_detected"], 0, (world, variant))


class WangYangMeng(unittest.TestCase):
    """Figures 8 and 9: a room, a slow mover in it, and an obstacle that appears suddenly."""

    def run_variant(self, world, variant, *more):
        return paper_table.run(world, [*paper_table.NEURO_FUZZY[variant], *more])

    def test_nobody_is_touched(self):
        for world in paper_table.worlds("w-fig*"):
            for variant in paper_table.NEURO_FUZZY:
                report = self.run_variant(world, variant)
                self.assertEqual(report["collisions"], 0, (world, variant))
                # Rules that nobody trained stand in the slow mover's way once.
                most = (world, variant) == ("w-fig09-slow-obstacle", "untrained, no target")
                self.assertLessEqual(report["hit_by"], int(most), (world, variant))

    def test_the_target_term_makes_it_reach(self):
        for world in paper_table.worlds("w-fig*"):
            for variant in paper_table.WITH_TARGET:
                report = self.run_variant(world, variant)
                self.assertEqual(report["outcome"], "reached", (world, variant))
                self.assertLessEqual(report["safety_stops"], 2, (world, variant))

    def test_without_a_target_it_roams_the_room(self):
        for world in paper_table.worlds("w-fig*"):
            # 600 s at 0.2 m/s and more, less what turning takes.
            report = self.run_variant(world, "trained, no target")
            self.assertGreater(report["path_length_m"], 100.0, world)
            self.assertLess(report["safety_stops"], report["path_length_m"] / 5.0, world)

    def test_training_spares_the_safety_layer(self):
        def stops(variant):
            return sum(self.run_variant(world, variant)["safety_stops"]
                       for world in paper_table.worlds("w-fig*"))

        trained = stops("trained, no target")
        self.assertLess(2 * trained, stops("untrained, no target"))
        self.assertLess(10 * trained, stops("Table I as printed, no target"))

    def test_the_slow_mover_is_met_and_avoided(self):
        for variant in ("trained", "expert", "untrained"):
            still = self.run_variant("w-fig08-room-static", variant)
            moving = self.run_variant("w-fig09-slow-obstacle", variant)

            # The rooms are the same but for the mover: who never saw it would drive alike.
            self.assertNotEqual(moving["hash"], still["hash"], variant)
            self.assertEqual((moving["collisions"], moving["hit_by"]), (0, 0), variant)
            self.assertEqual(moving["outcome"], "reached", variant)

    def test_a_mover_is_shifted_along_its_way(self):
        text = "moving: [{circle: [0, 0, 0.4], path: [[0, 0, 0], [20, 2, -1], [40, 0, 0]], loop: true}]"

        # After 25 s it has turned and come back a quarter of the way.
        self.assertEqual(paper_table.paper_phases.shifted(text, 25),
                         "moving: [{circle: [1.5, -0.75, 0.4], path: [[0, 1.5, -0.75], [15, 0, 0], "
                         "[35, 2, -1], [40, 1.5, -0.75]], loop: true}]")

    def test_the_sudden_obstacle_lies_on_the_way(self):
        report = self.run_variant("w-fig09-sudden-obstacle", "trained")

        # Start and target are 8.40 m apart and the target has 0.2 m.
        self.assertGreater(report["path_length_m"], 8.4)

    def test_the_notes_hold_what_the_command_prints(self):
        notes = (SOURCE / "docs/notes/control.md").read_text(encoding="utf-8")

        self.assertIn(paper_table.table(paper_table.worlds("w-fig*"), paper_table.NEURO_FUZZY,
                                        paper_table.contact_cell), notes)
        self.assertIn(paper_table.neuro_fuzzy_totals(paper_table.WITH_TARGET), notes)
        self.assertIn(paper_table.slow_mover(), notes)


class Worlds(unittest.TestCase):
    def test_every_static_world_is_driven_safely(self):
        reached = 0
        for world in paper_table.worlds():
            if paper_table.moves(world):
                continue
            report = run(world, "SOM + ART")
            self.assertEqual(report["collisions"], 0, world)
            # Where there is no way, the map is followed into every gap that might be one.
            most_stops = report["path_length_m"] / 15 if world.startswith("unsolvable") else 5
            self.assertLessEqual(report["safety_stops"], most_stops, world)
            if world.startswith("unsolvable"):
                self.assertEqual(report["outcome"], "unreachable", world)
            else:
                self.assertNotEqual(report["outcome"], "unreachable", world)
                reached += report["outcome"] == "reached"

        # 58 are asked for; all 64 solvable ones are what it does.
        self.assertEqual(reached, 64)


class Tables(unittest.TestCase):
    def test_the_notes_hold_what_the_command_prints(self):
        notes = (SOURCE / "docs/notes/recover.md").read_text(encoding="utf-8")

        self.assertIn(paper_table.table(paper_table.worlds("kk-*"), paper_table.VARIANTS), notes)


if __name__ == "__main__":
    unittest.main()
