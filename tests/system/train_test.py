# SPDX-License-Identifier: Apache-2.0
"""clew train neuro-fuzzy: from the expert, from a recording, and what it refuses."""
import pathlib
import re
import tempfile
import unittest

from clew_command import SOAK, SOURCE, Run, run_graph, write_file

SHIPPED = SOURCE / "configs/rulebases/wang_yang_meng_trained.yaml"
RECIPE = (SOURCE / "configs/training/wang_yang_meng.yaml").read_text(encoding="utf-8")


def train(*arguments):
    """A finished training."""
    return Run(["train", "neuro-fuzzy", *arguments])


def test_errors(text):
    """The errors over the test groups that a trained file tells, by name."""
    line = re.search(r"test_errors_mps: {(.*)}", text).group(1)
    return {name: float(value) for name, value in re.findall(r"(\w+): ([\d.]+)", line)}


class Expert(unittest.TestCase):
    def test_training_beats_the_rules_and_tables_of_four_times_their_number(self):
        errors = test_errors(SHIPPED.read_text(encoding="utf-8"))

        # 0.0078 m/s, against 0.092, 0.091 and 0.028.
        self.assertLess(errors["trained"], 0.009)
        self.assertLess(10 * errors["trained"], errors["rules"])
        self.assertLess(10 * errors["trained"], errors["rules_128_interpolated"])
        self.assertLess(3 * errors["trained"], errors["rules_128_filled"])

    def test_it_does_so_for_every_seed_and_for_more_groups(self):
        for seed in range(2, 32 if SOAK else 5):
            recipe = write_file(RECIPE.replace("seed: 1", f"seed: {seed}"))
            errors = test_errors(train("--recipe", recipe).out)

            self.assertLess(errors["trained"], min(errors["rules_128_filled"], 0.03), seed)
        if SOAK:
            errors = test_errors(train("--recipe", "wang_yang_meng_large").out)
            self.assertLess(3 * errors["trained"], errors["rules_128_filled"])

    def test_the_learning_curves_are_a_picture_and_the_same_every_time(self):
        with tempfile.TemporaryDirectory() as directory:
            pictures = [pathlib.Path(directory) / name for name in ("a.svg", "b.svg")]
            for picture in pictures:
                self.assertEqual(train("--curves", picture).status, 0)

            svg = pictures[0].read_text(encoding="utf-8")
            self.assertEqual(svg, pictures[1].read_text(encoding="utf-8"))
            for text in ("training groups", "test groups", "128 rules, filled", "30000"):
                self.assertIn(text, svg)


    def test_training_that_ends_worse_than_it_began_says_so(self):
        hasty = RECIPE.replace("iterations: 30000", "iterations: 50")
        hasty = re.sub("learning_rates: {.*}", "learning_rates: {centres: 100000, widths: 100000, "
                       "outputs: 1}", hasty)

        trained = train("--recipe", write_file(hasty))

        self.assertEqual(trained.status, 1)
        self.assertRegex(trained.err, r"training made it worse: 0\.092 m/s over the test groups "
                         r"before it, 0\.1\d\d after; nothing was written")
        self.assertIn("sets: readings", trained.err)
        self.assertEqual(trained.out, "")


class Recording(unittest.TestCase):
    def setUp(self):
        directory = tempfile.TemporaryDirectory()
        self.addCleanup(directory.cleanup)
        self.directory = pathlib.Path(directory.name)

    def record(self, graph, *arguments):
        path = self.directory / "run.mcap"
        run_graph(graph, "--layout", "composed", "--record", path, "--force", *arguments)
        return path

    def test_the_networks_learn_what_another_controller_did(self):
        recording = self.record("wang_yang_meng", "--with", "control=infrared_expert", "--set",
                                "control.target_term=false", "--max-ticks", "3000")

        trained = train("--recording", recording)

        self.assertEqual(trained.status, 0, trained.err)
        errors = test_errors(trained.out)
        self.assertLess(2 * errors["trained"], errors["rules"])
        self.assertEqual(train("--recording", recording).out, trained.out)
        # And what it learned drives the robot.
        rules = write_file(trained.out)
        report = run_graph("wang_yang_meng", "--layout", "composed", "--set",
                           f"control.rules={rules}")
        self.assertEqual(report["outcome"], "reached")

    def test_for_another_curve_the_sets_are_laid_over_the_readings(self):
        # As if the sensor had been changed: a gain of 8 m and an offset of 20 give 155 to 225.
        curve = ("--set", "sense.curve_gain_m=8", "--set", "sense.curve_offset=20", "--set",
                 "control.target_term=false", "--max-ticks", "6000")
        recording = self.record("wang_yang_meng", "--with", "control=infrared_expert", *curve)
        self.refused(train("--recording", recording), "run.mcap", "wang_yang_meng_readings")

        trained = train("--recipe", "wang_yang_meng_readings", "--recording", recording)

        self.assertEqual(trained.status, 0, trained.err)
        rules = write_file(trained.out)
        stops = {name: run_graph("wang_yang_meng", "--layout", "composed", *words)["safety_stops"]
                 for name, words in {"old": ("--set", "control.target_term=false", "--max-ticks",
                                             "6000"),
                                     "new": ("--set", f"control.rules={rules}", *curve),
                                     "not trained anew": curve}.items()}
        self.assertLessEqual(stops["new"], stops["old"])
        self.assertLess(stops["new"], stops["not trained anew"])

    def test_velocities_are_learned_as_wheel_speeds(self):
        recording = self.record("wang_yang_meng", "--with", "control=fuzzy_behaviourist",
                                "--world", "forest", "--max-ticks", "3000")

        trained = train("--recording", recording)

        self.assertEqual(trained.status, 0, trained.err)
        self.assertIn("recording: ", trained.out)

    def refused(self, trained, *texts):
        """Asserts that nothing was trained, and why."""
        self.assertEqual(trained.status, 2, trained.err)
        self.assertEqual(trained.out, "")
        for text in texts:
            self.assertIn(text, trained.err)

    def test_a_sensor_that_does_not_fit_is_refused(self):
        recording = self.record("reactive", "--max-ticks", "50")

        self.refused(train("--recording", recording), "run.mcap",
                     "needs four infrared rays, ahead, back, left and right; 'cones' gives 7")

    def test_too_few_groups_are_refused(self):
        recording = self.record("wang_yang_meng", "--world", "open-field")

        self.refused(train("--recording", recording), "run.mcap", "different combinations of "
                     "readings; the recipe needs 100 groups to train and 56 to test")

    def test_what_is_no_recording_is_refused(self):
        self.refused(train("--recording", self.directory / "none.mcap"), "none.mcap")
        self.refused(train("--recording", SHIPPED), "wang_yang_meng_trained.yaml")

    def test_a_recipe_that_is_none_is_refused(self):
        self.refused(train("--recipe", "wang_yang_mong"), "wang_yang_mong")
        self.refused(train("--recipe", "krishna_kalra_som"), "unknown key")
        unknown_world = write_file(RECIPE.replace("- forest", "- florest"))
        self.refused(train("--recipe", unknown_world), "florest")

    def test_an_output_that_cannot_be_written_is_refused(self):
        self.refused(train("-o", self.directory), "cannot be written")
        self.refused(train("--curves", self.directory / "no" / "curves.svg"), "cannot be written")


if __name__ == "__main__":
    unittest.main()
