# SPDX-License-Identifier: Apache-2.0
"""Clew as it is installed: complete, movable, and enough for programs of somebody else."""
import re
import unittest

from clew_command import Run, SOURCE
from installed import CLEW, Installation, call, without_source_tree


class InstallTest(unittest.TestCase):
    """All tests look at one installation."""

    @classmethod
    def setUpClass(cls):
        cls.installation = Installation()
        cls.prefix = cls.installation.prefix

    @classmethod
    def tearDownClass(cls):
        cls.installation.close()

    def files(self):
        """Every installed file."""
        return [path for path in self.prefix.rglob("*") if path.is_file()]

    def test_it_runs_where_there_is_no_source_tree_and_gives_the_same_hash(self):
        ours = Run(["run", "default", "--layout", "composed", "--json"], command=CLEW).report
        printed = without_source_tree(self.installation.command, "run", "default", "--layout",
                                      "composed", "--json", cwd=self.installation.work)

        self.assertIn(ours["hash"], printed)

    def test_its_processes_run_as_well(self):
        composed = self.installation.clew("run", "default", "--layout", "composed", "--json")
        processes = self.installation.clew("run", "default", "--json")

        self.assertEqual(processes.status, 0, processes.err)
        self.assertEqual(processes.report["hash"], composed.report["hash"])

    def test_it_can_be_moved(self):
        moved = self.installation.work / "moved"
        self.prefix.rename(moved)
        try:
            done = Run(["list", "graphs"], command=str(moved / "bin" / "clew"))
        finally:
            moved.rename(self.prefix)

        self.assertEqual(done.status, 0, done.err)
        self.assertIn("krishna_kalra", done.out)

    def test_no_file_tells_where_it_was_built(self):
        place = str(SOURCE).encode()

        self.assertEqual([str(path) for path in self.files() if place in path.read_bytes()], [])

    def test_public_headers_include_only_public_headers(self):
        root = next(self.prefix.glob("include/clew"))
        missing = []
        for header in root.rglob("*.h*"):
            for name in re.findall(r'^#include "([^"]+)"', header.read_text(encoding="utf-8"), re.M):
                if not (root / name).is_file():
                    missing.append(f"{header.relative_to(root)}: {name}")

        self.assertEqual(missing, [])

    def test_there_is_a_manual_page_for_every_command(self):
        pages = {path.name for path in self.prefix.glob("share/man/man1/*")}
        commands = re.findall(r"^  ([a-z][a-z-]+) ", self.installation.clew("--help").out, re.M)

        self.assertIn("run", commands)
        for command in commands:
            self.assertIn(f"clew-{command}.1.gz", pages)

    def test_bash_completes_commands_options_and_names(self):
        script = self.prefix / "share" / "bash-completion" / "completions" / "clew"

        def completed(*words):
            typed = " ".join(f"'{word}'" for word in words)
            return call("bash", "-c", f"source '{script}'; COMP_WORDS=('{self.installation.command}'"
                        f" {typed}); COMP_CWORD={len(words)}; _clew; echo \"${{COMPREPLY[@]}}\"")

        self.assertIn("replay", completed("re"))
        self.assertIn("--record", completed("run", "default", "--rec"))
        self.assertIn("krishna_kalra", completed("run", "kri"))
        self.assertIn("u-trap", completed("run", "default", "--world", "u-"))

    def test_a_program_of_somebody_else_runs_records_and_replays(self):
        folder = self.installation.build(SOURCE / "tests/third_party/consumer", "consumer")
        share = self.prefix / "share" / "clew"
        ours = Run(["run", "default", "--layout", "composed", "--json"], command=CLEW).report
        printed = without_source_tree(folder / "consumer", share, "default", "a.mcap",
                                      cwd=self.installation.work)

        self.assertEqual(printed.split(), [ours["hash"], "5"])


if __name__ == "__main__":
    unittest.main()
