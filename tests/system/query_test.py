# SPDX-License-Identifier: Apache-2.0
"""clew query: the results of a bench, asked by SQL."""
import csv
import io
import json
import pathlib
import sqlite3
import tempfile
import unittest

from clew_command import Run, write_file

SUITE = """format: clew-suite/1
graphs: [krishna_kalra, reactive]
worlds: {shipped: [u-trap, open-field, moving-crossing]}
seeds: [1, 2]
max_ticks: 1500
"""


class Query(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.scratch = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.scratch.cleanup)
        cls.out = pathlib.Path(cls.scratch.name) / "out"
        done = Run(["bench", write_file(SUITE), "--out", cls.out, "--json"])
        assert done.status == 0, done.err
        cls.runs = [json.loads(line) for line in done.out.splitlines()]

    def ask(self, sql, *arguments):
        return Run(["query", self.out, sql, *arguments])

    def test_every_key_of_a_run_is_a_column_with_its_value(self):
        done = self.ask("SELECT * FROM runs", "--json")

        self.assertEqual(done.status, 0, done.err)
        rows = [json.loads(line) for line in done.out.splitlines()]
        self.assertEqual(len(rows), len(self.runs))
        for row, run in zip(rows, self.runs):
            self.assertLessEqual(set(run), set(row))
            for key, value in run.items():
                if isinstance(value, (list, dict)):
                    self.assertEqual(json.loads(row[key]), value, key)
                else:
                    self.assertEqual(row[key], value, key)

    def test_prints_tables_json_and_csv(self):
        sql = ("SELECT graph, sum(success) AS successes, count(*) AS n FROM runs "
               "WHERE world = 'u-trap' GROUP BY graph")

        self.assertEqual(self.ask(sql).out, "graph          successes  n\n"
                                            "krishna_kalra          2  2\n"
                                            "reactive               0  2\n")
        rows = [{"graph": "krishna_kalra", "successes": 2, "n": 2},
                {"graph": "reactive", "successes": 0, "n": 2}]
        self.assertEqual([json.loads(line) for line in self.ask(sql, "--json").out.splitlines()],
                         rows)
        table = csv.DictReader(io.StringIO(self.ask(sql, "--csv").out))
        self.assertEqual(list(table), [{key: str(value) for key, value in row.items()}
                                       for row in rows])

    def test_the_examples_of_the_manual_work(self):
        manual = pathlib.Path(__file__).resolve().parents[2] / "tools/query/README.md"
        block = manual.read_text(encoding="utf-8").split("```")[1]
        examples = [text.split('"')[0] for text in block.split(' "SELECT')[1:]]
        self.assertEqual(len(examples), 3)
        for example in examples:
            done = self.ask("SELECT" + example)
            self.assertEqual(done.status, 0, done.err)
            self.assertGreater(len(done.out.splitlines()), 1, done.out)

    def test_others_can_open_the_database(self):
        self.assertEqual(self.ask("SELECT 1").status, 0)
        with sqlite3.connect(self.out / "results.sqlite") as database:
            [[count]] = database.execute("SELECT count(*) FROM runs")
        self.assertEqual(count, len(self.runs))

    def test_bad_input(self):
        for arguments, text in [
                ([self.out, "SELECT word FROM runs"], "clew: SQL:1:8: no such column: word; 'runs' "
                                                      "has graph, variant"),
                ([self.out, "SELECT FROM runs"], 'SQL:1:8: near "FROM": syntax error'),
                ([self.out, "DELETE FROM runs"], "a query reads 'runs' only"),
                ([self.out, ""], "SQL: is empty"),
                ([self.out], "sql"),
                ([self.out, "SELECT 1", "--json", "--csv"], "--csv"),
                ([self.out / "nowhere", "SELECT 1"], "nowhere/results.jsonl: cannot be read"),
                ([self.out, "SELECT 1, 1", "--json"], "two columns are called '1'")]:
            with self.subTest(arguments=arguments):
                run = Run(["query", *arguments])

                self.assertEqual(run.status, 2, run.err)
                self.assertIn(text, run.err)
                self.assertEqual(run.out, "")


if __name__ == "__main__":
    unittest.main()
