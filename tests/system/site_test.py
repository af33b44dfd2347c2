# SPDX-License-Identifier: Apache-2.0
"""The documentation as a site: every page and the reference are there, no link leads nowhere, and
nothing is loaded from elsewhere."""
import pathlib
import re
import subprocess
import tempfile
import unittest

from clew_command import SOURCE, load_tool


class Site(unittest.TestCase):
    def test_every_page_is_there_and_needs_no_network(self):
        with tempfile.TemporaryDirectory() as directory:
            done = subprocess.run([SOURCE / "tools/site", "--out", directory], capture_output=True,
                                  text=True, check=False)
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)

            out = pathlib.Path(directory)
            self.assertIn("landmark_revisit", (out / "reference/recover.html").read_text())
            self.assertIn("clew replay", (out / "reference/commands.html").read_text())
            self.assertTrue((out / "docs/debug-a-run.svg").exists())
            for page in out.rglob("*.html"):
                self.assertEqual(re.findall(r'<(?:script|link|img)[^>]*(?:src|href)="https?:[^"]*"',
                                            page.read_text()), [], page)

    def test_a_link_to_nothing_is_named(self):
        site = load_tool("site")
        with tempfile.TemporaryDirectory() as directory:
            site.SOURCE = pathlib.Path(directory) / "source"
            (site.SOURCE / "folder").mkdir(parents=True)
            (site.SOURCE / "there.txt").write_text("text")
            (site.SOURCE / "page.md").write_text(
                "[a](there.txt) [b](nowhere.md#part) [c](folder) [d](https://example.org/e)")

            broken = site.copy_page(pathlib.PurePath("page.md"), pathlib.Path(directory) / "out")

            self.assertEqual(broken, ["page.md: nowhere.md: there is no such file"])
            self.assertTrue((pathlib.Path(directory) / "out/there.txt").exists())


if __name__ == "__main__":
    unittest.main()
