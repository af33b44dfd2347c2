# SPDX-License-Identifier: Apache-2.0
"""The Python module does what the command does, with the same bytes."""
import os
import pathlib
import subprocess
import tempfile
import unittest

from clew_command import CLEW, SOURCE
from installed import BUILD

# Debian's, which has numpy and pandas and for which the module is built.
PYTHON = "/usr/bin/python3"
TESTS = SOURCE / "tests" / "python"


def run_python(*arguments, cwd):
    """Runs Debian's Python with the module that was built."""
    return subprocess.run([PYTHON, "-B", *map(str, arguments)], capture_output=True, text=True,
                          timeout=200, cwd=cwd, check=False, stdin=subprocess.DEVNULL,
                          env={**os.environ, "PYTHONPATH": str(BUILD / "python"),
                               "CLEW_COMMAND": CLEW})


class PythonTest(unittest.TestCase):
    """The tests themselves are run by the interpreter that has the module."""

    def test_the_module_keeps_its_contract(self):
        with tempfile.TemporaryDirectory() as folder:
            done = run_python("-m", "unittest", "discover", "-s", TESTS, "-p", "*_test.py", cwd=folder)

        self.assertEqual(done.returncode, 0, done.stderr)

    def test_the_tutorial_runs_as_it_is(self):
        with tempfile.TemporaryDirectory() as folder:
            done = run_python(SOURCE / "tools/python/tutorial/tutorial.py", cwd=folder)

            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertTrue((pathlib.Path(folder) / "tutorial.mcap").exists())
        self.assertIn("reached", done.stdout)


if __name__ == "__main__":
    unittest.main()
