# SPDX-License-Identifier: Apache-2.0
"""Where the time goes: the profile of a run, and two builds side by side."""
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

from clew_command import CLEW, SOURCE, Run

RUN = ["run", "reactive", "--world", "u-trap", "--layout", "composed", "--max-ticks", "50", "--json"]


class Profile(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def test_the_hash_is_the_same_and_every_component_has_its_row(self):
        run = Run([*RUN, "--profile", self.folder / "trace.json"])

        self.assertEqual(run.report["hash"], Run(RUN).report["hash"])
        rows = self.rows(run)
        self.assertEqual(sorted(row for row in rows[:-2] if row[0] != " "),
                         ["control", "drive", "sense"])
        self.assertEqual(rows[-2:], ["samples", "tick"])

    def test_map_detector_escape_and_controller_have_rows_of_their_own(self):
        run = Run(["run", "default", "--world", "u-trap", "--layout", "composed", "--json",
                   "--profile", self.folder / "trace.json"])

        rows = self.rows(run)
        recover = rows.index("recover")
        self.assertEqual(set(rows[recover + 1:recover + 5]),
                         {"  map", "  known_detour", "  remembered_map", "  shadows"})
        self.assertIn("  controller", rows[rows.index("control"):])

    def test_a_run_that_maps_allocates_and_the_guard_does_not(self):
        run = Run(["run", "default", "--world", "u-trap", "--layout", "composed", "--json",
                   "--profile", self.folder / "trace.json"])

        allocations = {line.split()[0]: float(line.split()[-1])
                       for line in run.err.splitlines() if "%" in line}
        self.assertGreater(allocations["tick"], 0.0)
        self.assertEqual(allocations["guard"], 0.0)

    @staticmethod
    def rows(run):
        """The names of the table's rows, those of parts set in."""
        return [line[:20].rstrip() for line in run.err.splitlines() if "%" in line]

    def test_the_trace_holds_every_tick_with_its_steps(self):
        Run([*RUN, "--profile", self.folder / "trace.json"])

        spans = json.loads((self.folder / "trace.json").read_text())["traceEvents"]
        whole = {span["args"]["tick"]: span for span in spans if span["name"] == "tick"}
        self.assertEqual(sorted(whole), list(range(len(whole))))
        for span in spans:
            tick = whole[span["args"]["tick"]]
            self.assertGreaterEqual(span["ts"], tick["ts"])
            # Both are rounded to a nanosecond.
            self.assertLessEqual(span["ts"] + span["dur"], tick["ts"] + tick["dur"] + 0.003)

    def test_a_file_that_cannot_be_written_is_refused_before_the_run(self):
        run = Run([*RUN, "--profile", self.folder / "nowhere" / "trace.json"])

        self.assertEqual(run.status, 2)
        self.assertEqual(run.out, "")
        self.assertIn("nowhere/trace.json", run.err)


class Comparison(unittest.TestCase):
    def compare(self, *words):
        return subprocess.run([sys.executable, "-B", SOURCE / "tools" / "benchmark", "--compare",
                               *words], capture_output=True, text=True, check=False,
                              env={**os.environ, "CLEW_COMMAND": str(CLEW)})

    def test_a_build_beside_itself_has_the_same_hash(self):
        with tempfile.TemporaryDirectory() as folder:
            (pathlib.Path(folder) / "clew").symlink_to(CLEW)

            ended = self.compare(folder, "--rounds", "2", "--graph", "default", "--world", "u-trap")

        self.assertEqual(ended.returncode, 0, ended.stderr)
        self.assertRegex(ended.stdout, r"default +u-trap .* ticks/s .* times +same hash +[0-9.]+ of the bar")

    def test_a_folder_without_a_build_is_refused(self):
        ended = self.compare("/nowhere")

        self.assertNotEqual(ended.returncode, 0)
        self.assertIn("/nowhere holds no command clew", ended.stderr)


if __name__ == "__main__":
    unittest.main()
