# SPDX-License-Identifier: Apache-2.0
"""What tools/bench/RESULTS.md says: a sample of it, and with CLEW_SOAK all of it."""
import csv
import json
import pathlib
import signal
import tempfile
import unittest

from clew_command import SOAK, SOURCE, Run, load_tool, start, wait_until, write_file

RESULTS = (SOURCE / "tools/bench/RESULTS.md").read_text(encoding="utf-8")
SAMPLE = """format: clew-suite/1
graphs: [krishna_kalra]
generated: {seed: 1, count: 12, families: [u, recursive-u]}
max_ticks: 6000
"""
# Our own recovery and its rival, in worlds with a pocket and in worlds without a way.
OWN_SAMPLE = """format: clew-suite/1
graphs: [any_sensor]
vary:
  sense: [{cones: {range_m: 1.5}}]
  recover.escape: [remembered_astar, remembered_map]
generated: {seed: 1, count: 4, families: [u, unreachable]}
max_ticks: 6000
"""
POCKETS = """format: clew-suite/1
graphs: [default]
generated: {seed: 1, count: 12, families: [u]}
max_ticks: 6000
"""
ARRIVALS_SAMPLE = """format: clew-suite/1
graphs: [default, krishna_kalra, reactive]
generated: {seed: 1, count: 6, families: [arrival-open, arrival-wall, arrival-corner, arrival-gap]}
max_ticks: 2000
"""
MOST_STOPS = 5  # of a run, with a sensor that sees what is ahead
NOISE = ["--vary", "sense.noise_stddev_m=0,0.01,0.03,0.1"]
DRIFT = ["--vary", "drive.drift_rad_per_sqrt_m=0,0.01,0.03,0.1"]
TRAPS = ["traps", "--graph", "krishna_kalra"]
OWN_TRAPS = ["traps", "--graph", "default"]
LONGEST_S = 30000
TIMING = ("wall_s", "ticks_per_s")


def rows(report):
    """The cells of every line of a table in Markdown."""
    return [line.strip("| ").split(" | ") for line in report.splitlines() if line.startswith("| ")]


def curve(report):
    """The rows of a curve as they are published: solvable ones reached, unsolvable told, stops."""
    [variants] = [part for part in report.split("\n## ") if part.startswith("All worlds")]
    return [[cells[0].split("=")[1].rstrip("]"), cells[2], " ".join(cells[3].split()[:1]), cells[7]]
            for cells in rows(variants)[1:]]


def behaviours(label):
    """Sensor and escape of a variant of our own suites."""
    return [part.split("=", 1)[1] for part in label.split("[")[1].rstrip("]").split(" ")]


def own_lines(runs, report):
    """The rows of a comparison of escapes with each other, as they are published."""
    parts = report.split("\n## ")
    [variants] = [part for part in parts if part.startswith("All worlds")]
    [pairs] = [part for part in parts if part.startswith("Compared in pairs")]
    over_rival = {cells[0]: cells[5] for cells in rows(pairs)[1:]}
    for cells in rows(variants)[1:]:
        most = max(run["safety_stops"] for run in runs if run["variant"] in cells[0])
        yield [*behaviours(cells[0]), cells[2], cells[3], cells[7], str(most), cells[8],
               over_rival.get(cells[0], "")]


class Published(unittest.TestCase):
    """Benches, and what is published of them."""

    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.out = pathlib.Path(scratch.name)

    def bench(self, suite, *arguments, name="out"):
        """The runs of a bench, and its report."""
        run = Run(["bench", suite, *arguments, "--out", self.out / name, "--json"],
                  timeout_s=LONGEST_S)
        self.assertEqual(run.status, 0, run.err)
        runs = [json.loads(line) for line in run.out.splitlines()]
        self.assertEqual(sum(run["collisions"] for run in runs), 0)
        return runs, (self.out / name / "report.md").read_text(encoding="utf-8")

    def assert_published(self, lines, text=RESULTS):
        """Every line of a table stands in RESULTS.md, or in another text."""
        for cells in lines:
            self.assertIn("| " + " | ".join(cells) + " |\n", text)

    def assert_few_stops(self, runs):
        """The safety layer hardly has to stop robots that see what is ahead."""
        for run in runs:
            if "infrared" not in run["variant"]:
                self.assertLessEqual(run["safety_stops"], MOST_STOPS, run["world"])

    def matrix(self, report):
        """The matrix of a report."""
        [matrix] = [part for part in report.split("\n## ")
                    if part.startswith("krishna_kalra: recover.detector x recover.escape")]
        return rows(matrix)


class Sample(Published):
    def test_how_hard_a_sample_of_the_worlds_is(self):
        done = Run(["world", "severity", "u-trap", "spir*", "unsolvable-box"])

        self.assertEqual(done.status, 0, done.err)
        table = rows(done.out)
        self.assertEqual(len(table), 5)
        self.assert_published(table)

    def test_a_sample_of_the_matrix(self):
        _, report = self.bench(
            write_file(SAMPLE), "--vary", "recover.detector=landmark_revisit,position_revisit,none",
            "--vary", "recover.escape=obstacle_following,virtual_obstacle,local_minimum_planner")

        matrix = self.matrix(report)
        self.assertEqual(len(matrix), 4)
        self.assert_published(matrix)

    def test_a_sample_of_the_curves(self):
        for variation in (NOISE, DRIFT):
            _, report = self.bench(write_file(SAMPLE), *variation, name=variation[1])

            levels = curve(report)
            self.assertEqual(len(levels), 4)
            for level, solvable, _, stops in levels:
                self.assert_published([[variation[1].split(".")[1].split("=")[0], level, solvable,
                                        stops]])

    def test_a_sample_of_our_own_recovery(self):
        runs, report = self.bench(write_file(OWN_SAMPLE))

        self.assertEqual(len(runs), 16)
        self.assert_published(own_lines(runs, report))
        self.assert_few_stops(runs)

    def test_a_sample_of_our_own_curves(self):
        for variation in ("sense.noise_stddev_m=0.03", "drive.drift_rad_per_sqrt_m=0.03"):
            runs, _ = self.bench(write_file(POCKETS), "--set", variation, name=variation)

            reached = sum(run["outcome"] == "reached" for run in runs)
            stops = sum(run["safety_stops"] for run in runs)
            self.assert_published([[*variation.split(".", 1)[1].split("="),
                                    f"{reached}/{len(runs)}", str(stops)]])

    def test_a_free_target_is_reached_on_a_short_path(self):
        self.bench(write_file(ARRIVALS_SAMPLE))

        with open(self.out / "out/results.csv", encoding="utf-8", newline="") as file:
            runs = list(csv.DictReader(file))
        self.assertEqual(len(runs), 72)
        counts = load_tool("arrivals-table").counts
        self.assertEqual([run["world"] for run in runs if not counts(run)], [])

    def test_false_alarms_in_clutter(self):
        runs, _ = self.bench("clutter")

        false_alarms = {}
        for run in runs:
            for detector in run["detectors"]:
                name = detector["rule"]
                false_alarms[name] = false_alarms.get(name, 0) + detector["false_alarms"]
        self.assertGreaterEqual(sum(count == 0 for count in false_alarms.values()), 3)
        self.assert_published([[name, str(count)] for name, count in false_alarms.items()])


@unittest.skipUnless(SOAK, "takes an hour")
class Whole(Published):
    def test_the_matrix(self):
        runs, report = self.bench("matrix")

        matrix = self.matrix(report)
        self.assertEqual(len(matrix), 8)
        self.assert_published(matrix)
        self.assertGreaterEqual(self.combinations_with(runs, 0.95), 3)

    def combinations_with(self, runs, share):
        """How many combinations reach at least that share of the solvable worlds."""
        reached = {}
        for run in runs:
            if run["solvable"]:
                reached.setdefault(run["variant"], []).append(run["outcome"] == "reached")
        return sum(sum(each) >= share * len(each) for each in reached.values())

    def test_the_curves(self):
        for traps in (TRAPS, OWN_TRAPS):
            _, noise = self.bench(*traps, *NOISE, name=f"noise of {traps[-1]}")
            _, drift = self.bench(*traps, *DRIFT, name=f"drift of {traps[-1]}")

            self.assert_published([a + b for a, b in zip(curve(noise), curve(drift))])

    def test_our_own_recovery(self):
        notes = (SOURCE / "docs/notes/recover.md").read_text(encoding="utf-8")
        for suite, text in (("own", notes), ("own_traps", RESULTS)):
            runs, report = self.bench(suite, name=suite)

            self.assert_published(own_lines(runs, report), text)
            for run in runs:
                if run["world"] == "unsolvable-behind-wall" and run["variant"].endswith(
                        "sense=laser(range_m=4) recover.escape=remembered_astar]"):
                    # Its slits are told again and again: docs/notes/recover.md.
                    self.assertEqual(run["outcome"], "timeout")
                elif "cones" in run["variant"] or "laser" in run["variant"]:
                    self.assertTrue(run["success"], (suite, run["variant"], run["world"]))

    def test_the_arrivals(self):
        arrivals = load_tool("arrivals-table")
        runs = [run for suite in arrivals.SUITES for run in arrivals.runs(suite)]

        self.assert_published(list(arrivals.lines(runs)))

    def test_detectors_that_widen_with_drift(self):
        self.bench("drift", name="drift")
        notes = (SOURCE / "docs/notes/recover.md").read_text(encoding="utf-8")

        self.assertIn(load_tool("drift-table").table(self.out / "drift"), notes)

    def test_the_worlds_by_how_hard_they_are(self):
        _, report = self.bench("severity")
        worlds = Run(["world", "severity", "*"], timeout_s=LONGEST_S)

        [table] = [part for part in report.split("\n## ") if part.startswith("By the depth")]
        self.assertIn(table[table.index("| group |"):].strip(), RESULTS)
        self.assertIn(worlds.out[worlds.out.index("| world |"):].strip(), RESULTS)

    def test_the_static_worlds(self):
        paper_table = load_tool("paper-table")
        notes = (SOURCE / "docs/notes/recover.md").read_text(encoding="utf-8")

        self.assertIn(paper_table.matrix(), notes)

    def test_workers_and_kills_change_nothing(self):
        once, _ = self.bench(*TRAPS, "--jobs", "1", name="one")
        arguments = ["bench", *TRAPS, "--jobs", "3", "--out", self.out / "killed"]
        file = self.out / "killed/results.jsonl"
        for wanted in (40, 120):
            process = start(arguments)
            self.assertTrue(wait_until(lambda count=wanted: file.exists()
                                       and file.read_bytes().count(b"\n") > count, 600))
            process.send_signal(signal.SIGKILL)
            process.communicate()
        resumed, _ = self.bench(*TRAPS, "--jobs", "3", name="killed")

        self.assertEqual(len(once), len(resumed))
        for run, other in zip(once, resumed):
            for key in TIMING:
                del run[key], other[key]
            self.assertEqual(run, other)


if __name__ == "__main__":
    unittest.main()
