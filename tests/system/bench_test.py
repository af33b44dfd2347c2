# SPDX-License-Identifier: Apache-2.0
"""clew bench: the same results with any number of workers, killed and gone on with or not."""
import csv
import json
import pathlib
import resource
import signal
import tempfile
import unittest

from clew_command import SOURCE, Run, processes_of_session, start, wait_until, write_file

SUITE = """format: clew-suite/1
graphs: [krishna_kalra, reactive]
worlds: {shipped: [u-trap, open-field, unsolvable-box, moving-crossing]}
generated: {seed: 3, count: 2, families: [u, spiral, clutter, closing-door]}
seeds: [1, 2]
max_ticks: 2000
"""
RUNS = 2 * (4 + 4 * 2) * 2
TIMING = ("start_s", "wall_s", "ticks_per_s")


def results(directory):
    """The lines of results, in any order, without what a clock measured."""
    lines = (pathlib.Path(directory) / "results.jsonl").read_text().splitlines()[1:]
    runs = [json.loads(line) for line in lines]
    return sorted(json.dumps({key: value for key, value in run.items() if key not in TIMING})
                  for run in runs)


class Bench(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.suite = write_file(SUITE)
        cls.scratch = tempfile.TemporaryDirectory()
        cls.one = pathlib.Path(cls.scratch.name) / "one"
        cls.first = Run(["bench", cls.suite, "--jobs", "1", "--out", cls.one, "--json"])

    @classmethod
    def tearDownClass(cls):
        cls.scratch.cleanup()

    def out(self, name):
        """A directory of this test's own."""
        return pathlib.Path(self.scratch.name) / name

    def test_prints_every_run_in_order(self):
        self.assertEqual(self.first.status, 0, self.first.err)
        runs = [json.loads(line) for line in self.first.out.splitlines()]

        self.assertEqual(len(runs), RUNS)
        self.assertEqual([run["seed"] for run in runs[:4]], [1, 2, 1, 2])
        self.assertEqual(runs[0]["graph"], "krishna_kalra")
        self.assertEqual(runs[-1]["graph"], "reactive")
        for run in runs:
            for key in ("graph", "world", "family", "outcome", "ticks", "path_length_m",
                        "shortest_path_m", "traps_detected", "collisions", "hash", "success",
                        "captures", "detectors"):
                self.assertIn(key, run)
        by_key = {(run["graph"], run["world"], run["seed"]): run for run in runs}
        trapped = by_key["reactive", "u-trap", 1]
        self.assertEqual((trapped["outcome"], trapped["success"], trapped["captures"],
                          trapped["held_at_end"]), ("timeout", False, 1, True))
        noticed = by_key["krishna_kalra", "u-trap", 1]
        self.assertEqual(noticed["detectors"][0]["noticed"], 1)
        self.assertTrue(by_key["krishna_kalra", "unsolvable-box", 1]["success"])
        self.assertIsNone(by_key["reactive", "moving-crossing", 1]["captures"])
        self.assertIsNone(by_key["reactive", "moving-crossing", 1]["bug1_bound_m"])

    def test_tells_how_hard_its_worlds_are(self):
        runs = {(run["graph"], run["world"]): run for run in map(json.loads,
                                                                 self.first.out.splitlines())}
        trapped = runs["krishna_kalra", "u-trap"]
        closed = runs["krishna_kalra", "unsolvable-box"]
        severity = Run(["world", "severity", "u-trap", "--graph", "krishna_kalra", "--json"]).report

        for key in ("severity_ranges", "nested_pockets", "necessary_backtrack_m",
                    "necessary_backtrack_ranges", "bug1_bound_m", "bug2_bound_m"):
            self.assertEqual(trapped[key], severity[key], key)
        self.assertEqual(trapped["depth_ranges"], trapped["severity_ranges"])
        self.assertLess(trapped["path_length_m"], trapped["bug1_bound_m"])
        self.assertEqual((closed["severity_ranges"], closed["necessary_backtrack_m"]), (None, None))
        self.assertGreater(closed["nested_pockets"], 0)
        by_severity = [json.loads(line) for line in
                       (self.one / "groups.jsonl").read_text().splitlines()]
        self.assertEqual({line["by"] for line in by_severity}, {"severity"})
        self.assertEqual(by_severity[-1]["group"], "unknown")
        # Every world has one robot, one sensor and so one group; moving-crossing is the unknown one.
        self.assertEqual(sum(line["worlds"] for line in by_severity if line["graph"] == "reactive"),
                         4 + 4 * 2)

    def test_groups_can_be_asked_for_afterwards(self):
        again = Run(["bench", self.suite, "--jobs", 1, "--out", self.one, "--by", "nesting"])
        report = (self.one / "report.md").read_text()
        Run(["bench", self.suite, "--jobs", 1, "--out", self.one])
        unknown = Run(["bench", self.suite, "--by", "nestin"])

        self.assertEqual(again.status, 0, again.err)
        for text in (again.out, report):
            self.assertIn("## By the number of nested pockets", text)
        self.assertEqual(unknown.status, 2)
        self.assertIn("--by: unknown grouping 'nestin' (did you mean 'nesting'?)", unknown.err)

    def test_is_what_run_reports(self):
        first = json.loads(self.first.out.splitlines()[0])

        run = Run(["run", first["graph"], "--world", first["world"], "--layout", "composed",
                   "--max-ticks", 2000, "--json"]).report

        for key, value in run.items():
            if key not in TIMING:
                self.assertEqual(first[key], value, key)

    def test_a_generated_world_can_be_run_from_its_file(self):
        of_bench = [json.loads(line) for line in self.first.out.splitlines()]
        [wanted] = [run for run in of_bench if run["world"] == "spiral-s3-02"
                    and run["graph"] == "krishna_kalra" and run["seed"] == 1]

        run = Run(["run", "krishna_kalra", "--world", self.one / "worlds/spiral-s3-02.yaml",
                   "--layout", "composed", "--max-ticks", 2000, "--json"]).report

        self.assertEqual(run["path_length_m"], wanted["path_length_m"])

    def test_the_report_has_tables_and_pictures(self):
        report = (self.one / "report.md").read_text()

        self.assertIn("| spiral |", report)
        self.assertIn("Compared in pairs", report)
        self.assertRegex(report, r"\| reactive \| krishna_kalra \| 0 \| [1-9]")
        pictures = list((self.one / "pictures").iterdir())
        self.assertEqual(sorted(path.suffix for path in pictures), [".svg", ".svg"])
        for picture in pictures:
            self.assertIn(f"pictures/{picture.name}", report)
            self.assertTrue(picture.read_text().rstrip().endswith("</svg>"))
        lines = (self.one / "results.csv").read_text().splitlines()
        self.assertEqual(len(lines), RUNS + 1)

    def test_more_workers_give_the_same(self):
        for jobs in (2, 7):
            run = Run(["bench", self.suite, "--jobs", jobs, "--out", self.out(f"jobs{jobs}")])

            self.assertEqual(run.status, 0, run.err)
            self.assertEqual(results(self.out(f"jobs{jobs}")), results(self.one))

    def test_tells_how_often_what_decided_and_what_never_did(self):
        suite = write_file("""format: clew-suite/1
graphs: [krishna_kalra, nakhaeinia, pin_bender]
worlds: {shipped: [u-trap]}
seeds: [1]
max_ticks: 300
""")
        out = self.out("coverage")
        run = Run(["bench", suite, "--coverage", "--jobs", "2", "--out", out, "--json"])
        self.assertEqual(run.status, 0, run.err)
        runs = {line["graph"]: line for line in map(json.loads, run.out.splitlines())}
        plain = Run(["bench", suite, "--jobs", "2", "--out", self.out("plain"), "--json"])
        self.assertEqual([line["hash"] for line in runs.values()],
                         [json.loads(line)["hash"] for line in plain.out.splitlines()])

        with open(out / "coverage.csv", newline="", encoding="utf-8") as file:
            rows = list(csv.DictReader(file))
        of = {}
        for row in rows:
            of.setdefault((row["graph"], row["stage"], row["choice"]), []).append(row)
        for graph, choice, count in [("nakhaeinia", "controller.rule_strengths", 15),
                                     ("pin_bender", "controller.rules", 13),
                                     ("krishna_kalra", "controller.strengths", 8)]:
            rules = of[graph, "control", choice]
            said = Run(["rules", graph, "--json"]).out.splitlines()
            [base] = [base for base in map(json.loads, said) if base["stage"] == "control"]
            self.assertEqual([row["case"] for row in rules], base["rules"], graph)
            self.assertEqual(len(rules), count)
            # Wherever the controller decided one rule was the strongest.
            [controller] = [row for row in of[graph, "control", "decided"]
                            if row["case"] == "controller"]
            self.assertEqual({row["ticks"] for row in rules}, {controller["decided"]})
            self.assertEqual(sum(int(row["decided"]) for row in rules), int(controller["decided"]))
            # Of every tick it is known who decided.
            self.assertEqual(int(controller["ticks"]), runs[graph]["ticks"] + 1)
        neurons = of["krishna_kalra", "classify", "classifier.som.distances_classes"]
        self.assertEqual(len(neurons), 49)
        self.assertGreater(sum(int(row["decided"]) for row in neurons), 0)
        report = (out / "report.md").read_text()
        self.assertIn("## What decided", report)
        never = [row["case"] for row in of["nakhaeinia", "control", "controller.rule_strengths"]
                 if row["decided"] == "0"]
        self.assertIn(never[0], report)

        killed = Run(["bench", suite, "--jobs", "2", "--out", out])
        self.assertEqual(killed.status, 2, "results with and without coverage are not one bench")
        self.assertIn("coverage", killed.err)

    def test_a_killed_bench_is_gone_on_with_and_leaves_no_worker(self):
        out = self.out("killed")
        file = out / "results.jsonl"
        for wanted in (5, 20):
            process = start(["bench", self.suite, "--jobs", "2", "--out", out],
                            start_new_session=True)
            reached = wait_until(lambda count=wanted: file.exists()
                                 and file.read_bytes().count(b"\n") > count)
            process.send_signal(signal.SIGKILL)
            process.communicate()
            self.assertTrue(reached)
            self.assertTrue(wait_until(lambda pid=process.pid: not processes_of_session(pid)))
        # As the kill of a machine would leave it.
        with open(file, "ab") as stream:
            stream.write(b'{"graph":"krishna_kal')

        done = Run(["bench", self.suite, "--out", out, "--json"])

        self.assertEqual(done.status, 0, done.err)
        self.assertEqual(results(out), results(self.one))
        self.assertEqual((out / "results.csv").read_text(), (self.one / "results.csv").read_text())

    def test_an_interrupted_bench_says_how_to_go_on(self):
        out = self.out("interrupted")
        process = start(["bench", self.suite, "--out", out])
        wait_until(lambda: (out / "results.jsonl").exists()
                   and (out / "results.jsonl").read_bytes().count(b"\n") > 3)
        process.send_signal(signal.SIGINT)
        _, err = process.communicate()

        self.assertEqual(process.returncode, 130)
        self.assertIn("goes on from", err)

    def test_another_configuration_is_refused_by_name(self):
        for arguments, text in ((["--graph", "reactive"], "graph krishna_kalra"),
                                (["--set", "sense.range_m=1.2"], "graph krishna_kalra"),
                                (["--vary", "sense.range_m=1.2,1.5"], "graph krishna_kalra")):
            run = Run(["bench", self.suite, "--out", self.one, *arguments])

            self.assertEqual(run.status, 2)
            self.assertIn(text, run.err)
            self.assertIn("--force", run.err)
        self.assertEqual(len(results(self.one)), RUNS)

    def test_variations_make_a_matrix(self):
        out = self.out("matrix")

        run = Run(["bench", self.suite, "--graph", "krishna_kalra", "--out", out, "--vary",
                   "recover.detector=landmark_revisit,none", "--vary",
                   "recover.escape=obstacle_following,none"])

        self.assertEqual(run.status, 0, run.err)
        self.assertIn("| landmark_revisit | ", (out / "report.md").read_text())
        self.assertEqual(len(results(out)), RUNS * 2)

    def test_writes_worlds_and_pictures(self):
        out = self.out("worlds")

        run = Run(["bench", self.suite, "--write-worlds", out])

        self.assertEqual(run.status, 0, run.err)
        names = sorted(path.name for path in out.iterdir())
        self.assertEqual(len(names), 2 * 4 * 2)
        self.assertIn("closing-door-s3-01.svg", names)
        self.assertEqual((out / "u-s3-01.yaml").read_text(),
                         (self.one / "worlds/u-s3-01.yaml").read_text())

    def bench(self, suite, name):
        """A bench of a suite's text, and its report."""
        run = Run(["bench", write_file(suite), "--out", self.out(name)])
        self.assertEqual(run.status, 0, run.err)
        return run, (self.out(name) / "report.md").read_text()

    def test_worlds_are_given_by_paths_and_wildcards(self):
        folder = self.out("my worlds")
        (folder / "inner").mkdir(parents=True)
        world = (SOURCE / "configs/worlds/open-field.yaml").read_text()
        for number, name in enumerate(("b.yaml", "a.yaml", "inner/c.yaml")):
            # One world by several names would be refused.
            (folder / name).write_text(f"{world}# {number}\n")
        (folder / "notes.txt").write_text("no world")

        run, report = self.bench(
            f"""format: clew-suite/1
graphs: [reactive]
worlds: {{mine: ["{folder}/*", "{folder}/inner/c.yaml"]}}
""", "paths")

        self.assertIn("| reactive | 3/3 100 %", run.out)
        lines = (self.out("paths") / "results.csv").read_text().splitlines()[1:]
        self.assertEqual([line.split(",")[3] for line in lines],
                         [f"{folder}/a.yaml", f"{folder}/b.yaml", f"{folder}/inner/c.yaml"])
        [picture] = (self.out("paths") / "pictures").iterdir()
        self.assertIn(f"(pictures/{picture.name})", report)
        self.assertTrue(picture.name.endswith("-my-worlds-a.yaml-1.svg"), picture.name)

    def test_equal_runs_are_one_sample(self):
        run, report = self.bench("""format: clew-suite/1
graphs: [reactive]
vary: {sense.noise_stddev_m: [0, 0.05]}
worlds: {open: [open-field, forest]}
seeds: [1, 2, 3]
""", "seeds")

        for text in (run.out, report):
            self.assertIn("4 of 12 runs equal another one of the same graph in the same world", text)
            self.assertIn("Seeds make no difference to reactive [sense.noise_stddev_m=0]: no noise "
                          "is on", text)
        self.assertRegex(run.out, r"\| reactive \[sense.noise_stddev_m=0\] \| 2/2 ")
        self.assertRegex(run.out, r"\| reactive \[sense.noise_stddev_m=0.05\] \| 6/6 ")

    def test_a_suite_sets_values_and_varies_parameters_of_one_behaviour(self):
        _, report = self.bench("""format: clew-suite/1
graphs: [any_sensor]
set: {recover.escape: remembered_map, drive.drift_rad_per_sqrt_m: 0.01}
vary: {sense: [{laser: {range_m: 2}}, {laser: {range_m: 4}}]}
worlds: {open: [open-field]}
seeds: [1, 2]
""", "sets")

        for range_m in (2, 4):
            self.assertIn(f"| any_sensor [sense=laser(range_m={range_m})] | 2/2 100 %", report)
        self.assertNotIn("Seeds make no difference", report)

    def test_unknown_solvability_stands_apart(self):
        text = (SOURCE / "configs/worlds/open-field.yaml").read_text()
        unknown = write_file("\n".join(line for line in text.splitlines()
                                       if not line.startswith(("solvable", "shortest_path"))))

        run, report = self.bench(f"""format: clew-suite/1
graphs: [reactive]
worlds: {{open: [open-field, "{unknown}"]}}
""", "unknown")

        self.assertRegex(run.out, r"\| reactive \| 2/2 [^|]*\| 1/1 [^|]*\|  \| 1/1 ")
        self.assertIn("| open (solvable: unknown) | 1/1", report)
        self.assertIn("1 of 2 worlds do not say whether they can be solved", run.out)

    def test_a_disk_that_is_full_is_named_with_the_reason(self):
        def limit():
            resource.setrlimit(resource.RLIMIT_FSIZE, (3000, 3000))

        process = start(["bench", self.suite, "--out", self.out("full"), "--jobs", "1"],
                        preexec_fn=limit)
        _, err = process.communicate(timeout=60)

        self.assertEqual(process.returncode, 2)
        self.assertIn("results.jsonl: cannot be written: File too large", err)

    def test_bad_input(self):
        varied = write_file(SUITE + "vary: {sesne.range_m: [1, 2]}\n")
        for arguments, text in [
                (["smkoe"], "did you mean 'smoke'?"),
                ([write_file(SUITE.replace("graphs:", "grpahs:"))], "did you mean 'graphs'?"),
                ([self.suite, "--graph", "raective"], "did you mean 'reactive'?"),
                ([self.suite, "--vary", "recover.detector"], "PATH=VALUE"),
                ([self.suite, "--vary", "recover.detector=revisit"], "landmark_revisit"),
                ([self.suite, "--vary", "sesne.range_m=1,2"], "--vary sesne.range_m: "),
                ([self.suite, "--vary", "sense.range=1,2"], "--vary sense.range: "),
                ([varied, "--graph", "reactive"], f"{varied}:7:"),
                ([self.suite, "--jobs", "0"], "--jobs"),
                ([self.suite, "--out", "/proc/bench"], "/proc/bench"),
                ([], "suite")]:
            with self.subTest(arguments=arguments):
                run = Run(["bench", *arguments])

                self.assertEqual(run.status, 2, run.err)
                self.assertIn(text, run.err)


if __name__ == "__main__":
    unittest.main()
