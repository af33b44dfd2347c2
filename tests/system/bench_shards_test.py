# SPDX-License-Identifier: Apache-2.0
"""clew bench in shards: killed, gone on with and merged, it is byte for byte one bench."""
import json
import pathlib
import shutil
import signal
import tempfile
import unittest

from clew_command import Run, start, wait_until, write_file

SUITE = """format: clew-suite/1
graphs: [krishna_kalra, reactive]
vary: {sense.noise_stddev_m: [0, 0.02]}
worlds: {shipped: [u-trap, open-field]}
generated: {seed: 3, count: 2, families: [u, clutter]}
seeds: [1, 2]
max_ticks: 1500
"""
RUNS = 2 * 2 * (2 + 4) * 2
MEASURED = ("start_s", "wall_s", "ticks_per_s")


def files_of(directory):
    """All files of a bench that must be the same, with their bytes."""
    directory = pathlib.Path(directory)
    return {str(path.relative_to(directory)): path.read_bytes()
            for path in sorted(directory.rglob("*"))
            if path.is_file() and path.name != "timing.jsonl"}


class BenchShards(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.suite = write_file(SUITE)
        cls.scratch = tempfile.TemporaryDirectory()
        cls.folder = pathlib.Path(cls.scratch.name)
        cls.one = cls.folder / "one"
        cls.first = Run(["bench", cls.suite, "--jobs", "1", "--out", cls.one])
        assert cls.first.status == 0, cls.first.err
        cls.shards = [cls.folder / f"shard{number}" for number in (1, 2, 3)]
        for number, shard in enumerate(cls.shards, 1):
            done = cls.run_shard(f"{number}/3", shard, "--jobs", 3 - number % 2)
            assert done.status == 0, done.err

    @classmethod
    def tearDownClass(cls):
        cls.scratch.cleanup()

    @classmethod
    def run_shard(cls, shard, out, *arguments):
        return Run(["bench", cls.suite, "--shard", shard, "--out", out, *arguments])

    def merge(self, shards, name):
        return Run(["bench", "--merge", *shards, "--out", self.folder / name])

    def test_the_files_of_one_bench_have_what_they_had(self):
        self.assertIn("results.jsonl", files_of(self.one))
        self.assertEqual(len((self.one / "results.jsonl").read_text().splitlines()), RUNS + 1)
        for line in (self.one / "results.jsonl").read_text().splitlines()[1:]:
            self.assertFalse(set(MEASURED) & set(json.loads(line)))
        timing = [json.loads(line) for line in (self.one / "timing.jsonl").read_text().splitlines()]
        self.assertEqual(len(timing), RUNS)
        self.assertTrue(all(run["wall_s"] > 0 and run["ticks_per_s"] > 0 for run in timing))

    def test_merged_shards_are_byte_for_byte_one_bench(self):
        done = self.merge(reversed(self.shards), "merged")

        self.assertEqual(done.status, 0, done.err)
        self.assertEqual(files_of(self.folder / "merged"), files_of(self.one))
        self.assertEqual(done.out.replace("merged", "one"), self.first.out)
        # The whole is a bench like any other: it can be gone on with, here with nothing to do.
        again = Run(["bench", self.suite, "--out", self.folder / "merged", "--json"])
        runs = [json.loads(line) for line in again.out.splitlines()]
        self.assertEqual(len(runs), RUNS)
        self.assertTrue(all(run["wall_s"] > 0 for run in runs))
        self.assertEqual(files_of(self.folder / "merged"), files_of(self.one))

    def test_more_workers_give_the_same_bytes(self):
        done = Run(["bench", self.suite, "--jobs", "4", "--out", self.folder / "four"])

        self.assertEqual(done.status, 0, done.err)
        self.assertEqual(files_of(self.folder / "four"), files_of(self.one))

    def test_a_killed_shard_goes_on_and_is_merged(self):
        killed = self.folder / "killed"
        results = killed / "results.jsonl"
        process = start(["bench", self.suite, "--shard", "2/3", "--out", killed, "--jobs", "1"])
        reached = wait_until(lambda: results.exists() and results.read_bytes().count(b"\n") > 3)
        process.send_signal(signal.SIGKILL)
        process.communicate()
        self.assertTrue(reached)
        with open(results, "ab") as stream:
            stream.write(b'{"graph":"krishna_kal')  # torn, as the end of a machine leaves it
        shards = [self.shards[0], killed, self.shards[2]]

        early = self.merge(shards, "early")
        self.assertEqual(early.status, 2)
        self.assertRegex(early.err, r"killed/results.jsonl:?.*(shard 2/3 is not whole|expected)")
        self.assertIn("go on with it by the command that began it", early.err)
        self.assertEqual(self.run_shard("2/3", killed).status, 0)
        done = self.merge(shards, "of_killed")

        self.assertEqual(done.status, 0, done.err)
        self.assertEqual(files_of(self.folder / "of_killed"), files_of(self.one))

    def test_compressed_results_are_the_same_and_go_on(self):
        done = Run(["bench", self.suite, "--out", self.folder / "compressed", "--compress"])
        merged = Run(["bench", "--merge", *self.shards, "--out", self.folder / "merged compressed",
                      "--compress"])
        self.assertEqual((done.status, merged.status), (0, 0), done.err + merged.err)
        files = files_of(self.folder / "compressed")
        self.assertEqual({name for name in files if name.startswith("results.jsonl")},
                         {"results.jsonl.zst"})
        files.pop("timing.jsonl.zst")
        of_merge = files_of(self.folder / "merged compressed")
        of_merge.pop("timing.jsonl.zst")
        self.assertEqual(of_merge, files)

        asked = Run(["query", self.folder / "compressed", "SELECT count(*) AS n FROM runs", "--json"])
        self.assertEqual(asked.out, f'{{"n":{RUNS}}}\n', asked.err)
        (self.folder / "compressed/results.sqlite").unlink()
        again = Run(["bench", self.suite, "--out", self.folder / "compressed"])
        self.assertEqual(again.status, 0, again.err)
        self.assertEqual(files_of(self.folder / "compressed"), files_of(self.one))

    def test_it_ends_when_enough_is_known_whoever_runs_it(self):
        suite = write_file("format: clew-suite/1\ngraphs: [reactive]\n"
                           "set: {sense.noise_stddev_m: 0.02}\n"
                           "worlds: {open: [open-field]}\nseeds: {count: 400}\n")
        arguments = ["bench", suite, "--until-width", "0.1", "--out"]
        done = Run([*arguments, self.folder / "known", "--jobs", "1"])
        self.assertEqual(done.status, 0, done.err)
        report = (self.folder / "known/report.md").read_text()
        # All succeed: (n + 1) 0.9^n falls below 0.05 from 68 to 69; looks are at 62, 69 and 76.
        self.assertIn("Ended after 69 of 400 batches", report)
        self.assertIn("69/69 100.00 % [90.03, 100.00]", report)
        self.assertEqual(len((self.folder / "known/results.jsonl").read_text().splitlines()), 70)

        many = self.folder / "known by many"
        process = start([*arguments, many, "--jobs", "3"])
        wait_until(lambda: (many / "results.jsonl").exists()
                   and (many / "results.jsonl").read_bytes().count(b"\n") > 20)
        process.send_signal(signal.SIGKILL)
        process.communicate()
        again = Run([*arguments, many, "--jobs", "3"])

        self.assertEqual(again.status, 0, again.err)
        self.assertEqual(files_of(many), files_of(self.folder / "known"))
        other = Run(["bench", suite, "--until-width", "0.2", "--out", many])
        self.assertEqual(other.status, 2)
        self.assertIn("it was made with 'until_width' 0.1, now it is 0.2", other.err)

    def test_a_shard_prints_its_runs(self):
        done = self.run_shard("1/3", self.shards[0], "--json")

        runs = [json.loads(line) for line in done.out.splitlines()]
        self.assertGreater(len(runs), RUNS / 5)
        self.assertLess(len(runs), RUNS / 2)
        self.assertTrue(all(set(MEASURED) <= set(run) for run in runs))
        self.assertRegex(self.run_shard("1/3", self.shards[0]).out, r"^shard 1/3: \d+ runs in ")

    def test_more_shards_than_runs_are_merged(self):
        suite = write_file("format: clew-suite/1\ngraphs: [reactive]\n"
                           "worlds: {open: [open-field]}\nseeds: [1, 2]\n")
        shards = [self.folder / f"small{number}" for number in range(1, 6)]
        for number, shard in enumerate(shards, 1):
            done = Run(["bench", suite, "--shard", f"{number}/5", "--out", shard])
            self.assertEqual(done.status, 0, done.err)

        done = self.merge(shards, "small")

        self.assertEqual(done.status, 0, done.err)
        whole = Run(["bench", suite, "--out", self.folder / "small whole"])
        self.assertEqual(whole.status, 0, whole.err)
        self.assertEqual(files_of(self.folder / "small"), files_of(self.folder / "small whole"))

    def test_the_cost_is_told_beforehand(self):
        out = self.folder / "dry"
        done = Run(["bench", self.suite, "--dry-run", "--jobs", "2", "--out", out])
        self.assertEqual(done.status, 0, done.err)
        self.assertRegex(done.out, rf"runs     {RUNS}: 4 variants x 6 worlds x 2 seeds\n"
                                   r"sample   32 runs in .* a run, the longest .*\n"
                                   r"in all   .* of one core; standard error \d+ %\n"
                                   r"tasks    1 of 2 cores on this machine, 2 cores at once: about ")
        self.assertFalse(out.exists())

        cost = json.loads(Run(["bench", self.suite, "--dry-run", "--jobs", "2", "--json"]).out)
        self.assertEqual((cost["runs"], cost["sampled"], cost["tasks"]), (RUNS, 32, 1))
        # Within a factor of what the bench took, on a machine that others use, too.
        timing = [json.loads(line) for line in (self.one / "timing.jsonl").read_text().splitlines()]
        took_s = sum(run["wall_s"] for run in timing)
        self.assertLess(took_s / 5, cost["core_s"])
        self.assertAlmostEqual(cost["wall_s"] * 2, cost["core_s"])

    def test_bad_input(self):
        foreign = self.folder / "foreign"
        other = write_file(SUITE.replace("seeds: [1, 2]", "seeds: [1, 3]"))
        self.assertEqual(Run(["bench", other, "--shard", "2/3", "--out", foreign]).status, 0)
        of_two = self.folder / "of two"
        self.assertEqual(self.run_shard("2/2", of_two).status, 0)
        out = ["--out", self.folder / "refused"]
        one, two, three = self.shards
        for arguments, text in [
                ([self.suite, "--shard", "4/3", *out], "--shard: found '4/3'; expected I/N"),
                ([self.suite, "--shard", "1/3"], "--shard: needs --out DIR"),
                ([self.suite, "--shard", "1/3", "--out", two],
                 "it was made with 'shard' 2/3, now it is 1/3"),
                ([self.suite, "--out", two], "it has 'shard', which is not asked for now"),
                (["--merge", one, two, three], "--merge: needs --out DIR"),
                (["--merge", one, two, three, "--out", two], "is a shard itself"),
                (["--merge", one, three, *out], "2 of 3 shards are there; missing: 2"),
                (["--merge", one, one, *out], "is shard 1/3, and so is"),
                (["--merge", one, of_two, three, *out], "is shard 2/2, but"),
                (["--merge", one, foreign, three, *out],
                 "is a shard of another bench than"),
                (["--merge", one, self.one, *out], "is no shard: it was made without --shard"),
                (["--merge", one, self.folder / "nowhere", *out], "nowhere/results.jsonl: cannot"),
                ([self.suite, "--merge", one, *out], "--merge"),
                ([self.suite, "--on", "sge", *out], "allowed: slurm, slurm:PARTITION"),
                ([self.suite, "--on", "slurm:", *out], "allowed: slurm, slurm:PARTITION"),
                ([self.suite, "--shards", "3", *out], "--on"),
                ([self.suite, "--on", "slurm", "--shards", "1001", *out], "--shards")]:
            with self.subTest(arguments=arguments):
                run = Run(["bench", *arguments])

                self.assertEqual(run.status, 2, run.err)
                self.assertIn(text, run.err)
        self.assertEqual(files_of(self.folder / "refused"), {})

    def test_another_program_is_refused_by_name(self):
        changed = self.folder / "changed"
        shutil.copytree(self.shards[1], changed)
        results = changed / "results.jsonl"
        results.write_text(results.read_text().replace('"clew":"', '"clew":"9.'))

        done = self.merge([self.shards[0], changed, self.shards[2]], "of_changed")

        self.assertEqual(done.status, 2)
        self.assertIn("is a shard of another bench than", done.err)
        self.assertIn("it was made with 'clew' 0.", done.err)


if __name__ == "__main__":
    unittest.main()
