# SPDX-License-Identifier: Apache-2.0
"""What the papers say of the scenes that show their recovery, and docs/notes/recover.md of it."""
import unittest

from clew_command import SOURCE, load_tool

paper_table = load_tool("paper-table")

# Why is in docs/notes/recover.md.
NOT_AS_TOLD = {("Krishna & Kalra 16c", "the same, mirrored"),
               ("Nakhaeinia 10", "two virtual targets lead out of the recursive U")}


class TrapScenes(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.table, cls.reports = paper_table.trap_scenes()

    def test_come_out_as_told(self):
        for (figure, claim, _, _, holds), reports in zip(paper_table.SCENES, self.reports):
            with self.subTest(figure=figure, claim=claim):
                self.assertEqual(holds(*reports), (figure, claim) not in NOT_AS_TOLD)

    def test_collide_with_nothing(self):
        for (figure, *_), reports in zip(paper_table.SCENES, self.reports):
            self.assertEqual(sum(report["collisions"] for report in reports), 0, figure)

    def test_are_told_by_the_notes(self):
        notes = (SOURCE / "docs/notes/recover.md").read_text(encoding="utf-8")

        self.assertIn(self.table, notes)


if __name__ == "__main__":
    unittest.main()
