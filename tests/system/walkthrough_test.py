# SPDX-License-Identifier: Apache-2.0
"""The sessions in the README and in docs/ are what their commands print, and the pictures what they
draw."""
import pathlib
import tempfile
import unittest

from clew_command import load_tool

walkthrough = load_tool("walkthrough")

PAGE = """<!-- session -->
<!-- file note.txt -->
```
two
```

```
$ cat note.txt; clew list nothing >/dev/null; cp note.txt picture.svg
two
clew: {error}
```
![Two](picture.svg)
<!-- end -->
"""


class Walkthrough(unittest.TestCase):
    def test_sessions_are_what_the_commands_print_and_draw(self):
        pages = walkthrough.pages_with_sessions()

        self.assertGreater(len(pages), 1)
        for page in pages:
            with self.subTest(page=page.name):
                self.assertEqual("\n".join(walkthrough.differences(page)), "",
                                 "run tools/walkthrough --write")

    def test_what_is_no_longer_so_is_found_and_written_anew(self):
        with tempfile.TemporaryDirectory() as directory:
            page = pathlib.Path(directory) / "page.md"
            page.write_text(PAGE.replace("{error}", "all is well"))

            told = walkthrough.differences(page)
            walkthrough.write(page)

            self.assertIn("-clew: all is well", told)
            self.assertTrue(told[-1].endswith("picture.svg is not the picture that the session makes"))
            self.assertIn("clew: unknown list 'nothing'", page.read_text())
            self.assertEqual((page.parent / "picture.svg").read_text(), "two\n")
            self.assertEqual(walkthrough.differences(page), [])


if __name__ == "__main__":
    unittest.main()
