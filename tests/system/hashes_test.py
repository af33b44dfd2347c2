# SPDX-License-Identifier: Apache-2.0
"""Every shipped graph behaves in every shipped world as the committed table of hashes says, and what
earlier versions recorded replays to the byte."""
import os
import pathlib
import subprocess
import sys
import unittest

from clew_command import CLEW, SOURCE

TOOL = SOURCE / "tools" / "hashes"
RECORDINGS = sorted((SOURCE / "tests" / "golden").glob("*.mcap"))


def hashes(*words):
    return subprocess.run([sys.executable, "-B", TOOL, *words], capture_output=True, text=True,
                          check=False, env={**os.environ, "CLEW_COMMAND": str(CLEW)})


class Hashes(unittest.TestCase):
    def test_every_graph_in_every_world_has_the_hash_of_the_table(self):
        ended = hashes()

        self.assertEqual(ended.returncode, 0, ended.stdout + ended.stderr)
        graphs = len(list((SOURCE / "configs/graphs").glob("*.yaml")))
        worlds = len(list((SOURCE / "configs/worlds").glob("*.yaml")))
        count = graphs * worlds
        self.assertIn(f"{count} of {count} hashes are those of the table", ended.stdout)

    def test_the_table_is_only_made_whole(self):
        ended = hashes("--update", "--quick")

        self.assertEqual(ended.returncode, 2)
        self.assertIn("--update writes the whole table", ended.stderr)

    def test_a_recording_of_an_earlier_version_replays_to_the_byte(self):
        self.assertTrue(RECORDINGS)
        for recording in RECORDINGS:
            with self.subTest(recording=pathlib.Path(recording).name):
                ended = subprocess.run([CLEW, "replay", recording, "--json"], capture_output=True,
                                       text=True, check=False)

                self.assertEqual(ended.returncode, 0, ended.stdout + ended.stderr)


if __name__ == "__main__":
    unittest.main()
