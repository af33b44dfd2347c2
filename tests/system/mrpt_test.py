# SPDX-License-Identifier: Apache-2.0
"""MRPT's navigators as plug-ins, where Debian's libmrpt-nav-dev is installed: repeatable, in every
layout, and in a bench beside our own."""
import csv
import pathlib
import subprocess
import unittest

from clew_command import SOURCE
from installed import Installation

EXAMPLE = SOURCE / "examples" / "mrpt"
GRAPHS = ("mrpt_full_eval", "mrpt_nd")


def version_of_mrpt():
    """What Debian has installed of it; empty if it is not."""
    done = subprocess.run(["dpkg-query", "--show", "--showformat=${db:Status-Status} ${Version}",
                           "libmrpt-nav-dev"], capture_output=True, text=True, check=False)
    status, _, version = done.stdout.partition(" ")
    return version if status == "installed" else ""


class Mrpt(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        if not version_of_mrpt():
            raise unittest.SkipTest("SKIPPED: libmrpt-nav-dev is not installed (117 packages); "
                                    "'apt-get install libmrpt-nav-dev', or tools/soak, which does")
        cls.installation = Installation()
        cls.plugin = cls.installation.build(EXAMPLE, "mrpt") / "libmrpt.so"

    @classmethod
    def tearDownClass(cls):
        cls.installation.close()

    def clew(self, *arguments):
        """The installed command, which finds graphs and suite of the example."""
        return self.installation.clew(*arguments, "--plugin", self.plugin,
                                      environment={"CLEW_PATH": f"{EXAMPLE}:{self.plugin.parent}"})

    def run_graph(self, graph, *arguments):
        done = self.clew("run", graph, "--json", *arguments)
        self.assertIn(done.status, (0, 3), done.err)
        return done.report

    def test_it_is_the_version_that_the_results_are_of(self):
        self.assertIn("2.5.8", version_of_mrpt())

    def test_they_find_a_target_that_nothing_hides(self):
        for graph in GRAPHS:
            with self.subTest(graph=graph):
                report = self.run_graph(graph, "--world", "open-field", "--layout", "composed")

                self.assertEqual(report["outcome"], "reached")
                self.assertEqual(report["collisions"], 0)

    def test_they_do_the_same_again_and_in_every_layout(self):
        for graph in GRAPHS:
            with self.subTest(graph=graph):
                run = [graph, "--world", "comb", "--max-ticks", "150", "--layout"]
                hashes = {self.run_graph(*run, layout)["hash"]
                          for layout in ("composed", "composed", "processes")}

                self.assertEqual(len(hashes), 1)

    def test_they_go_on_from_what_was_recorded(self):
        recording = pathlib.Path(self.installation.work) / "a.mcap"
        self.run_graph("mrpt_nd", "--world", "comb", "--max-ticks", "100", "--layout", "composed",
                       "--record", recording)
        replayed = self.clew("replay", recording)
        branched = self.clew("replay", recording, "--branch", "50", "--max-ticks", "100", "--json")

        self.assertEqual(replayed.status, 0, replayed.out + replayed.err)
        self.assertEqual(branched.report["ticks"], 100, branched.err)

    def test_they_stand_in_a_bench_beside_ours(self):
        for name, ours in (("mrpt", {"planner", "default", "krishna_kalra"}),
                           ("mrpt_laser", {"planner", "any_sensor"})):
            with self.subTest(suite=name):
                whole = (EXAMPLE / "suites" / f"{name}.yaml").read_text(encoding="utf-8")
                head, _, _ = whole.partition("worlds:\n")
                suite = pathlib.Path(self.installation.work) / f"few-{name}.yaml"
                suite.write_text(head + "worlds:\n  some: [open-field, comb]\nmax_ticks: 300\n")
                out = pathlib.Path(self.installation.work) / name
                done = self.clew("bench", suite, "--out", out)

                self.assertEqual(done.status, 0, done.err)
                with open(out / "results.csv", encoding="utf-8", newline="") as file:
                    graphs = {row["graph"] for row in csv.DictReader(file)}
                self.assertEqual(graphs, {*ours, *GRAPHS})


if __name__ == "__main__":
    unittest.main()
