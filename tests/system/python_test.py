# SPDX-License-Identifier: Apache-2.0
"""The Python module does what the command does, with the same bytes."""
import json
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

    def test_every_cell_of_the_notebook_prints_what_stands_in_it(self):
        with tempfile.TemporaryDirectory() as folder:
            done = run_python(SOURCE / "tools/python/run_notebook", SOURCE / "docs/python.ipynb",
                              cwd=folder)

        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertIn("cells run, 0 different", done.stdout)

    def test_a_notebook_that_prints_something_else_is_found(self):
        with tempfile.TemporaryDirectory() as folder:
            notebook = json.loads((SOURCE / "docs/python.ipynb").read_text(encoding="utf-8"))
            first = next(cell for cell in notebook["cells"] if cell["cell_type"] == "code")
            first["source"] = ["print(1 + 1)\n", "'a'"]
            first["outputs"] = [{"name": "stdout", "output_type": "stream", "text": ["3\n"]}]
            notebook["cells"] = [first]
            path = pathlib.Path(folder) / "wrong.ipynb"
            path.write_text(json.dumps(notebook), encoding="utf-8")
            done = run_python(SOURCE / "tools/python/run_notebook", path, cwd=folder)

        self.assertEqual(done.returncode, 1, done.stdout + done.stderr)
        self.assertIn("cell 1 prints something else", done.stdout)
        self.assertIn("+2", done.stdout)


if __name__ == "__main__":
    unittest.main()
