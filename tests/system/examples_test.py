# SPDX-License-Identifier: Apache-2.0
"""Third-party components, built and run exactly as docs/your-own-component.md says."""
import os
import pathlib
import re
import shutil
import subprocess
import tempfile
import unittest

from clew_command import SOURCE
from installed import Installation

BUILD_TIMEOUT_S = 600
PAGE = SOURCE / "docs" / "your-own-component.md"


def commands_of(section):
    """The commands of the section's first block, as the page prints them."""
    text = PAGE.read_text(encoding="utf-8")
    body = text.split(f"\n## {section}\n")[1].split("\n## ")[0]
    block = re.search(r"```sh\n(.*?)```", body, re.DOTALL).group(1)
    return [line for line in block.splitlines() if line]


class Examples(unittest.TestCase):
    """In a copy of the installed examples, with the installed clew in PATH and its folder idl/ in CLEW_IDL."""

    @classmethod
    def setUpClass(cls):
        cls.installation = Installation()
        cls.addClassCleanup(cls.installation.close)
        cls.directory = tempfile.TemporaryDirectory(prefix="clew-examples-")
        cls.share = cls.installation.prefix / "share"
        shutil.copytree(cls.share / "doc/libclew-dev/examples",
                        pathlib.Path(cls.directory.name) / "examples")

    @classmethod
    def tearDownClass(cls):
        cls.directory.cleanup()

    def follow(self, section):
        """Runs the page's commands of a section in one shell; returns what the last one printed."""
        script = "set -e\n" + "\n".join(commands_of(section))
        environment = {**os.environ, "CLEW_IDL": str(self.share / "clew/idl"),
                       "PATH": f"{self.installation.prefix}/bin:{os.environ['PATH']}"}
        done = subprocess.run(["sh", "-c", script], cwd=self.directory.name,
                              env=environment, capture_output=True, text=True, timeout=BUILD_TIMEOUT_S,
                              check=False)
        self.assertEqual(done.returncode, 0, f"{script}\n{done.stdout}{done.stderr}")
        return done.stdout.strip().splitlines()[-1]

    def test_c_on_cyclone_dds_cpp_on_fast_dds_and_python_over_json_lines_do_the_same(self):
        lines = [self.follow(section) for section in
                 ("C on Cyclone DDS", "C++ on Fast DDS", "Python over JSON lines")]

        for line in lines:
            self.assertIn("reached in open-field: ", line)
        # The same decisions by the same arithmetic: the same bytes, whatever carries them.
        hashes = {line.split("hash ")[1] for line in lines}
        self.assertEqual(len(hashes), 1, lines)


if __name__ == "__main__":
    unittest.main()
