# SPDX-License-Identifier: Apache-2.0
"""The debugging session in README.md is what its commands print, and its picture what they draw."""
import unittest

from clew_command import load_tool

walkthrough = load_tool("walkthrough")


class Walkthrough(unittest.TestCase):
    def test_is_what_the_commands_print_and_draw(self):
        self.maxDiff = None
        hint = "run tools/walkthrough --write"

        text, picture = walkthrough.session()

        self.assertEqual(walkthrough.without_speeds(walkthrough.recorded()),
                         walkthrough.without_speeds(text), hint)
        self.assertTrue(walkthrough.PICTURE.read_bytes() == picture, hint)


if __name__ == "__main__":
    unittest.main()
