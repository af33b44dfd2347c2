# SPDX-License-Identifier: Apache-2.0
"""The table of paths in docs/notes/plan.md is what build/path-table prints, but for the times."""
import os
import subprocess
import unittest

from clew_command import SOURCE

PATH_TABLE = os.environ.get("CLEW_PATH_TABLE", str(SOURCE / "build/path-table"))


def rows(text):
    """The table's cells by method, without the last column, which is the time."""
    table = [[cell.strip() for cell in line.strip("| ").split(" | ")]
             for line in text.splitlines() if line.startswith("| ")]
    return {cells[0]: cells[1:-1] for cells in table}


class PathTable(unittest.TestCase):
    def test_the_notes_tell_the_table(self):
        printed = rows(subprocess.run([PATH_TABLE], capture_output=True, text=True,
                                      check=True).stdout)
        told = rows((SOURCE / "docs/notes/plan.md").read_text(encoding="utf-8"))

        self.assertEqual(len(printed), 8)
        for method, cells in printed.items():
            self.assertEqual(told.get(method), cells, method)

    def test_an_argument_is_refused(self):
        done = subprocess.run([PATH_TABLE, "--cells"], capture_output=True, text=True, check=False)

        self.assertEqual((done.returncode, done.stdout), (2, ""))
        self.assertIn("'--cells'", done.stderr)


if __name__ == "__main__":
    unittest.main()
