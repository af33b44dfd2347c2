# SPDX-License-Identifier: Apache-2.0
"""What the papers say of the scenes that show their recovery, and docs/notes/recover.md of it. With
CLEW_SOAK from all moved starts."""
import unittest

from clew_command import SOAK, SOURCE, load_tool

paper_table = load_tool("paper-table")
SCENES = paper_table.paper_scenes.SCENES
NOTES = (SOURCE / "docs/notes/recover.md").read_text(encoding="utf-8")
# One of each paper, of those that do not last.
SHORT = ("Krishna & Kalra 8, 9, mirrored", "Krishna & Kalra 15", "Nakhaeinia 3")


class TrapScenes(unittest.TestCase):
    def test_come_out_as_the_notes_tell(self):
        for scene, reports in zip(SCENES, paper_table.all_scene_reports(SCENES, starts=1)):
            with self.subTest(figure=scene.figure):
                self.assertIn(paper_table.scene_told(scene, reports), NOTES)
                if "the controller alone" not in scene.figure:
                    self.assertEqual(sum(report["collisions"] for report in reports[0]), 0)

    def test_do_so_from_moved_starts(self):
        scenes = [scene for scene in SCENES if SOAK or scene.figure in SHORT]
        for scene, reports in zip(scenes, paper_table.all_scene_reports(scenes)):
            with self.subTest(figure=scene.figure):
                self.assertIn(paper_table.scene_row(scene, reports), NOTES)

    def test_no_row_says_yes_for_less_than_it_measures(self):
        rows = [line.strip("| ").split(" | ") for line in NOTES.splitlines()
                if line.endswith((" | yes |", " | **no** |")) and ": " in line]

        self.assertEqual(len(rows), len(SCENES))
        for figure, _, _, one, share, told in rows:
            holds = one.startswith("yes: ") and int(share) >= paper_table.paper_scenes.LEAST_SHARE
            self.assertEqual(told == "yes", holds, figure)

    def test_moved_starts_are_others_and_the_same_every_time(self):
        text = (SOURCE / "configs/worlds/kk-fig15-not-trapped.yaml").read_text(encoding="utf-8")
        moved = list(paper_table.paper_scenes.moved_starts(text))

        self.assertEqual(len(set(moved)), 17)
        self.assertEqual(moved[0], text)
        self.assertEqual(moved, list(paper_table.paper_scenes.moved_starts(text)))

    def test_the_mirror_image_of_the_mirror_image_is_the_world(self):
        text = (SOURCE / "configs/worlds/kk-fig08-right-angle-corner.yaml").read_text(
            encoding="utf-8")
        mirrored = paper_table.paper_scenes.mirrored

        self.assertIn("target: [9.0, 8.2]", mirrored(text))
        self.assertEqual(mirrored(mirrored(mirrored(text))), mirrored(text))


if __name__ == "__main__":
    unittest.main()
