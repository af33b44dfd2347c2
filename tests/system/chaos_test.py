# SPDX-License-Identifier: Apache-2.0
"""Random graphs, broken at random, end as they would have ended undisturbed; what fails is found,
made smaller and told as a command line that repeats it."""
import json
import os
import random
import stat
import subprocess
import sys
import tempfile
import unittest

from clew_command import CLEW, SOAK, SOURCE

sys.path.insert(0, str(SOURCE / "tools"))
import chaos_cases  # noqa: E402

TOOL = SOURCE / "tools" / "chaos"
# In soak: kind and cases.
COUNTS = [("storms", 1000), ("realtime", 1000)]
# At a restart; while 10 MB are read; of all processes, and then of a new recorder.
FREEZES = [["--seed", "1", "--cases", "1000"]] if SOAK else [["--seed", "17", "--cases", "2"],
                                                             ["--seed", "25", "--cases", "1"]]
# A few cases, the same as long as graphs and worlds are, or as many as an hour takes.
EXTENT = ["--seed", "1000", "--minutes", "60"] if SOAK else ["--seed", "1", "--cases", "6"]


def chaos(*words, command=CLEW):
    return subprocess.run([sys.executable, "-B", TOOL, *words], capture_output=True, text=True,
                          check=False, env={**os.environ, "CLEW_COMMAND": str(command)})


class Chaos(unittest.TestCase):
    def test_random_cases_hold(self):
        done = chaos(*EXTENT, "--json")

        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        figures = json.loads(done.stdout.splitlines()[-1])
        print(figures, file=sys.stderr)
        self.assertGreater(figures["runs"], 0)
        self.assertGreater(sum(figures["faults"].values()), 0, "nothing was broken")
        self.assertEqual(figures["failures"], 0)

    def test_freezes_of_any_length_hold(self):
        for extent in FREEZES:
            done = chaos("--only", "freezes", *extent, "--json")

            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
            figures = json.loads(done.stdout.splitlines()[-1])
            print(figures, file=sys.stderr)
            self.assertGreater(sum(figures["faults"].values()), 0, "nothing was frozen")
            self.assertEqual(figures["failures"], 0)

    @unittest.skipUnless(SOAK, "takes hours")
    def test_storms_and_kills_in_real_time_hold(self):
        for kind, count in COUNTS:
            with self.subTest(kind=kind):
                done = chaos("--only", kind, "--seed", "1", "--cases", str(count), "--keep-going", "--json")
                print(kind, done.stdout.splitlines()[-1], file=sys.stderr)
                self.assertEqual(done.returncode, 0, done.stdout + done.stderr)

    def test_a_command_that_loses_bytes_fails_and_its_case_is_small(self):
        # It records one byte too many wherever a run is spread over processes.
        with tempfile.TemporaryDirectory() as folder:
            broken = f"{folder}/clew"
            with open(broken, "w", encoding="utf-8") as file:
                file.write(f"#!/bin/sh\n{CLEW} \"$@\"; status=$?\nfor word; do\n"
                           "  case $word in */disk/r.mcap) [ -f $word ] && echo >> $word;; esac\n"
                           "done\nexit $status\n")
            os.chmod(broken, stat.S_IRWXU)

            done = chaos("--seed", "1", "--cases", "1", command=broken)

        self.assertEqual(done.returncode, 1, done.stdout + done.stderr)
        self.assertIn("FAILED: the recording is another one", done.stdout)
        self.assertRegex(done.stdout, r"repeat: tools/chaos --case '\{.*\"faults\":\[\].*\}'")

    def test_the_same_seed_gives_the_same_case(self):
        def case(seed):
            return chaos_cases.random_case(random.Random(seed), ["kill", "freeze"])

        self.assertEqual(case(7), case(7))
        self.assertNotEqual(case(7), case(8))

    def test_bad_usage(self):
        self.assertEqual(chaos("--minutes", "0").returncode, 2)
        self.assertEqual(chaos("--case", "no case").returncode, 2)


if __name__ == "__main__":
    unittest.main()
