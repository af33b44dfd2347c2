# SPDX-License-Identifier: Apache-2.0
"""The READMEs' parameter tables are what the command says, and no behaviour lacks its table."""
import os
import re
import subprocess
import sys
import unittest

from clew_command import CLEW, SOURCE

TOOL = SOURCE / "tools" / "parameter-tables"
STAGES = ["sense", "classify", "recover", "plan", "control", "drive"]


class ParameterTables(unittest.TestCase):
    def test_the_tables_are_up_to_date(self):
        ended = subprocess.run([sys.executable, "-B", TOOL, "--check"], capture_output=True,
                               text=True, check=False,
                               env={**os.environ, "CLEW_COMMAND": str(CLEW)})

        self.assertEqual(ended.returncode, 0, ended.stdout + ended.stderr)

    def test_every_behaviour_with_parameters_has_its_table(self):
        for stage in STAGES:
            listed = subprocess.run([CLEW, "list", stage], capture_output=True, text=True,
                                    check=True).stdout
            readme = (SOURCE / "components" / stage / "README.md").read_text(encoding="utf-8")
            # A behaviour's line is followed by its parameters, which are further to the right.
            behaviours = re.findall(r"^  (\S+) (\S+): [^\n]*\n    \S", listed, re.MULTILINE)
            self.assertTrue(behaviours)
            for part, name in behaviours:
                # A shadow is a detector that only watches: its table is the detector's.
                part = part.replace("recover.shadow", "recover.detector")
                with self.subTest(part=part, behaviour=name):
                    self.assertIn(f"<!-- parameters {part} {name} -->", readme)


if __name__ == "__main__":
    unittest.main()
