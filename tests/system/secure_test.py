# SPDX-License-Identifier: Apache-2.0
"""A secured run gives the same bytes as an open one, also after kills and with a component of
somebody else's. It starts only with keys that are good. Keys are made and checked with clew keys."""
import os
import pathlib
import signal
import tempfile
import time
import unittest

from clew_command import (LAYOUTS, THIRD_PARTY, Run, components_of, run_graph, start, wait_until,
                          write_file)

RUN = ["krishna_kalra", "--world", "u-trap", "--max-ticks", "300"]
ENDLESS = ["krishna_kalra", "--world", "unsolvable-behind-wall", "--with", "recover.detector=none",
           "--max-ticks", "3000"]
ON_THE_WIRE = {name: layout for name, layout in LAYOUTS.items() if name != "composed"}


class Secure(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.expected = run_graph(*RUN, "--layout", "composed")["hash"]
        scratch = tempfile.TemporaryDirectory()
        cls.addClassCleanup(scratch.cleanup)
        cls.keys = pathlib.Path(scratch.name) / "keys"
        for command in (["init"], ["mint"], ["check"]):
            done = Run(["keys", *command, cls.keys])
            assert done.status == 0, done.out + done.err
        cls.minted = done.out

    def test_every_layout_gives_the_same_hash(self):
        for name, layout in ON_THE_WIRE.items():
            with self.subTest(layout=name):
                self.assertEqual(run_graph(*RUN, *layout, "--secure")["hash"], self.expected)

    def test_keys_of_the_user_serve_runs_of_both_vendors(self):
        # Of each vendor: six stages, who looks on, and the run itself.
        self.assertEqual(self.minted, "good: 16 identities\n")
        self.assertEqual(run_graph(*RUN, *LAYOUTS["mixed"], f"--secure={self.keys}")["hash"],
                         self.expected)

    def test_killed_components_come_back_with_their_identities(self):
        whole = run_graph(*ENDLESS, "--layout", "composed")["hash"]
        process = start(["run", *ENDLESS, *LAYOUTS["mixed"], "--secure", "--json"],
                        start_new_session=True)
        for stage in ["recover", "drive", "classify"]:
            self.assertTrue(wait_until(lambda: len(components_of(process.pid)) == 5))
            time.sleep(0.3)
            os.kill(components_of(process.pid)[stage], signal.SIGKILL)
        out, err = process.communicate(timeout=120)

        self.assertEqual(process.returncode, 3, err)
        self.assertIn("; restarting it", err)
        self.assertIn(whole, out)

    def test_a_component_of_somebody_else_gets_its_identity(self):
        program = f"{THIRD_PARTY}/straight_control, --without-guidance"
        graph = ("world: open-field\nrobot: disc-015\nsense: {behaviour: cones}\n"
                 f"control: {{exec: [{program}]}}\ndrive: {{behaviour: turn_then_step}}\n")
        open_run = run_graph(write_file(graph))["hash"]

        for vendor in ("cyclonedds", "fastdds"):
            secured = run_graph(write_file(graph + "security: minted\n"), "--middleware", vendor)
            self.assertEqual(secured["hash"], open_run)

    def test_what_is_wrong_with_keys_is_told_before_anything_starts(self):
        key = self.keys / "recover.cyclonedds/private.key"
        os.chmod(key, 0o644)
        self.addCleanup(os.chmod, key, 0o600)
        told = f"{key}: may be read by others: its mode is 0644; allowed: 0600"

        checked = Run(["keys", "check", self.keys])
        run = Run(["run", *RUN, f"--secure={self.keys}"])

        self.assertEqual(checked.status, 1)
        self.assertEqual(checked.out, told + "\n")
        self.assertEqual(run.status, 2)
        self.assertIn(told, run.err)
        self.assertEqual(run.out, "")

    def test_a_graph_asks_for_more_than_a_key_allows(self):
        with tempfile.TemporaryDirectory() as scratch:
            keys = pathlib.Path(scratch) / "keys"
            self.assertEqual(Run(["keys", "init", keys]).status, 0)
            self.assertEqual(Run(["keys", "mint", keys, "reactive"]).status, 0)

            self.assertEqual(Run(["keys", "check", keys, "reactive"]).status, 0)
            run = Run(["run", *RUN, f"--secure={keys}"])

        self.assertEqual(run.status, 2)
        self.assertIn("classify.cyclonedds: is no directory of keys", run.err)

    def test_bad_input_is_refused(self):
        for words, told in ((["run", *RUN, "--secure=/nowhere"], "/nowhere: is no directory"),
                            (["run", *RUN, "--secure", "--layout", "composed"],
                             "--secure and --ros2 need --layout processes"),
                            (["keys", "init", self.keys], "an authority is never replaced"),
                            (["keys", "mint", "/nowhere"], "/nowhere: is no directory"),
                            (["keys", "mint", self.keys, "--days", "0"], "--days"),
                            (["keys", "check", "/nowhere"], "/nowhere"),
                            (["keys", "show", self.keys], "unknown command 'show'")):
            with self.subTest(words=words):
                done = Run(words)
                self.assertEqual(done.status, 2, done.out)
                self.assertIn(told, done.err)


if __name__ == "__main__":
    unittest.main()
