# SPDX-License-Identifier: Apache-2.0
"""tools/demo in a tree of its own, where nothing is installed or built: what it runs, and what it says
can be typed next."""
import os
import pathlib
import shutil
import signal
import subprocess
import tempfile
import unittest

from clew_command import CLEW, SOURCE, TIMEOUT_S

WORLD = """format: clew-world/1
name: somewhere
bounds: [0, 0, 4, 2]
start: [1, 1, 0]
target: [3, 1]
target_radius: 0.2
"""


def write_program(path, text):
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text("#!/bin/sh\n" + text)
    path.chmod(0o755)


class Demo(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory(prefix="clew demo ")
        self.addCleanup(scratch.cleanup)
        self.tree = pathlib.Path(scratch.name) / "tree"
        write_program(self.tree / "tools/install-packages", "")
        write_program(self.tree / "bin/cmake", "")
        shutil.copy(SOURCE / "tools/demo", self.tree / "tools/demo")
        (self.tree / "build").mkdir()
        (self.tree / "build/clew").symlink_to(pathlib.Path(CLEW).resolve())
        self.elsewhere = pathlib.Path(scratch.name) / "else where"
        self.elsewhere.mkdir()

    def run_shown(self, command, cwd):
        return subprocess.run(command, cwd=cwd, capture_output=True, text=True, timeout=TIMEOUT_S,
                              env={**os.environ, "PATH": f"{self.tree}/bin:{os.environ['PATH']}"},
                              shell=isinstance(command, str), check=False)

    def first_line_of(self, command):
        """Of a command that goes on until Ctrl-C."""
        with subprocess.Popen(f"exec {command}", cwd=self.tree, stdout=subprocess.PIPE, text=True,
                              shell=True) as process:
            line = process.stdout.readline()
            process.send_signal(signal.SIGINT)
            process.communicate(timeout=TIMEOUT_S)
        return line

    def demo(self, *arguments):
        return self.run_shown([self.tree / "tools/demo", *arguments], self.elsewhere)

    def names_left(self):
        return sorted(path.name for path in (self.tree / "out").glob("*"))

    def test_of_a_file_says_what_can_be_typed_next(self):
        (self.elsewhere / "some where.yaml").write_text(WORLD)

        demo = self.demo("some where.yaml")
        commands = [line.split("  ")[1] for line in demo.stdout.splitlines()
                    if line.startswith("  build/clew")]

        self.assertEqual(demo.returncode, 0, demo.stderr)
        self.assertIn("reached in ", demo.stdout)
        self.assertEqual(self.names_left(), ["some where.html", "some where.mcap", "some where.svg"])
        self.assertEqual(demo.stdout.splitlines()[-1],
                         f"Look at it: {(self.tree.resolve() / 'out/some where.html').as_uri()}")
        self.assertEqual(len(commands), 6, demo.stdout)
        self.assertEqual(sum("--world" in command for command in commands), 3)
        view, *others = commands
        self.assertTrue(self.first_line_of(view).startswith("view http://127.0.0.1:"), view)
        for command in others:
            typed = self.run_shown(command, self.tree)
            self.assertEqual(typed.returncode, 0, command + typed.stderr)

    def test_of_a_world_that_is_refused_ends_with_its_message(self):
        broken = self.elsewhere / "broken.yaml"
        broken.write_text(WORLD.replace("start: [1, 1, 0]", "start: [9, 1, 0]"))
        (self.tree / "out").mkdir()
        (self.tree / "out/broken.mcap").write_text("of an earlier world of this name")

        for world, what in (("u-trpa", "did you mean 'u-trap'?"), (broken, "start")):
            demo = self.demo(world)

            self.assertEqual(demo.returncode, 2)
            self.assertEqual(demo.stdout, "")
            self.assertIn(what, demo.stderr)
            self.assertEqual(demo.stderr.count("clew: "), 2, demo.stderr)  # that it builds, and why not
        self.assertEqual(self.names_left(), ["broken.mcap"])

    def test_without_a_page_does_the_rest(self):
        (self.tree / "build/clew").unlink()
        write_program(self.tree / "build/clew", f'''[ "$1" = report ] && exit 2
exec "{pathlib.Path(CLEW).resolve()}" "$@"
''')

        demo = self.demo("u-trap")

        self.assertEqual(demo.returncode, 0, demo.stderr)
        self.assertEqual(demo.stdout.splitlines()[-1], "Look at it: no page, see above")
        self.assertEqual(self.names_left(), ["u-trap.mcap", "u-trap.svg"])

    def test_of_a_mission_that_fails_shows_the_path(self):
        (self.elsewhere / "shut.yaml").write_text(
            WORLD + "walls: [[2, 0, 2, 2]]\nsolvable: false\n")

        demo = self.demo("./shut.yaml")

        self.assertEqual(demo.returncode, 5, demo.stderr)
        self.assertIn("unreachable in ", demo.stdout)
        self.assertEqual(self.names_left(), ["shut.html", "shut.mcap", "shut.svg"])


if __name__ == "__main__":
    unittest.main()
