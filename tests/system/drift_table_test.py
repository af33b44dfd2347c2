# SPDX-License-Identifier: Apache-2.0
"""What tools/drift-table makes of the results of a bench."""
import json
import pathlib
import tempfile
import unittest

from clew_command import load_tool

drift_table = load_tool("drift-table")


def result(world, sigmas, success, path_m, text_hash):
    """A run, as a bench writes it."""
    return {"graph": "g", "world": world, "seed": 1, "success": success, "path_length_m": path_m,
            "traps_detected": sigmas, "hash": text_hash,
            "variant": f"drive.drift_rad_per_sqrt_m=0.03 recover.detector.drift_sigmas={sigmas}"}


class DriftTable(unittest.TestCase):
    def test_counts_pairs_of_the_same_world(self):
        runs = [result("a", 0, True, 10.0, "1"), result("a", 2, True, 12.0, "2"),
                result("b", 0, True, 10.0, "3"), result("b", 2, False, 99.0, "4"),
                result("c", 0, False, 99.0, "5"), result("c", 2, False, 99.0, "5"),
                result("d", 0, True, 10.0, "6"), result("d", 2, True, 10.0, "6")]
        with tempfile.TemporaryDirectory() as folder:
            lines = [json.dumps({"format": "clew-bench/2"}), *map(json.dumps, runs)]
            (pathlib.Path(folder) / "results.jsonl").write_text("\n".join(lines), encoding="utf-8")
            rows = drift_table.table(folder).splitlines()

        self.assertEqual(len(rows), 3)
        self.assertEqual(rows[2], "| g | 0.03 | 2 | 4 | 3/4 [30, 95] | 2/4 [15, 85] | 1, 0 | 2 | "
                                  "0, 8 | 1.10 |")

    def test_an_interval_of_a_median_needs_six_values(self):
        self.assertEqual(drift_table.median([]), "")
        self.assertEqual(drift_table.median([1, 2, 3, 4, 5]), "3.00")
        self.assertEqual(drift_table.median([6, 5, 4, 3, 2, 1]), "3.50 [1.00, 6.00]")
        self.assertEqual(drift_table.median(range(1, 10)), "5.00 [2.00, 8.00]")


if __name__ == "__main__":
    unittest.main()
