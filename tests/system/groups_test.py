# SPDX-License-Identifier: Apache-2.0
"""Stages that share a process give the same bytes as stages that do not, however they are grouped, on
either vendor, when their process is killed, and when one of them is swapped."""
import itertools
import os
import pathlib
import random
import re
import shlex
import signal
import subprocess
import tempfile
import time
import unittest

from clew_command import Run, components_of, run_graph, start, wait_until, write_file

STAGES = ["sense", "classify", "recover", "control", "drive"]
RUN = ["krishna_kalra", "--world", "u-trap"]
ENDLESS = ["krishna_kalra", "--world", "unsolvable-behind-wall", "--with", "recover.detector=none"]
# Stages of either group, both at once, and the goal, which drive knows.
CHANGES = ["--at", "100:recover.detector=landmark_revisit", "--at", "400:control=fuzzy_behaviourist",
           "--at", "700:recover.detector=none", "--at", "700:control=krishna_kalra_fuzzy",
           "--at", "1000:goal=1.5,1.5,0.1", "--max-ticks", "2000"]
VENDORS = {"cyclonedds": ["--middleware", "cyclonedds"], "fastdds": ["--middleware", "fastdds"]}
# Two processes: who steers, and who perceives; and its other half on the other vendor.
TWO = {"robot": ["drive", "control"], "mind": ["sense", "classify", "recover"]}
MIXED = ["--middleware", "drive=fastdds", "--middleware", "control=fastdds"]


def grouped(groups):
    """The options that put stages into groups: {name: stages}."""
    return [word for name, stages in groups.items() for stage in stages
            for word in ("--set", f"{stage}.process.group={name}")]


class Groups(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.ticks = ["--max-ticks", "300"]
        cls.expected = run_graph(*RUN, *cls.ticks, "--layout", "composed")["hash"]

    def test_every_pair_and_all_of_them_give_the_same_hash(self):
        groupings = [{"pair": pair} for pair in itertools.combinations(STAGES, 2)]
        groupings += [{"all": STAGES}, TWO]
        for index, groups in enumerate(groupings):
            # A pair on one vendor, the next on the other; all and the two on both.
            names = list(VENDORS) if len(groups.get("pair", [])) == 0 else [
                list(VENDORS)[index % 2]]
            for name in names:
                with self.subTest(groups=groups, vendor=name):
                    report = run_graph(*RUN, *self.ticks, *grouped(groups), *VENDORS[name])

                    self.assertEqual(report["hash"], self.expected)
        with self.subTest(groups=TWO, vendor="mixed"):
            self.assertEqual(run_graph(*RUN, *self.ticks, *grouped(TWO), *MIXED)["hash"],
                             self.expected)

    def test_a_killed_group_comes_back_with_all_its_stages(self):
        with tempfile.TemporaryDirectory() as directory:
            whole = pathlib.Path(directory) / "whole.mcap"
            killed = pathlib.Path(directory) / "killed.mcap"
            ticks = ["--max-ticks", "4000"]
            run = Run(["run", *ENDLESS, *ticks, "--layout", "composed", "--record", whole])
            self.assertEqual(run.status, 3, run.err)
            for name, layout in {**VENDORS, "mixed": MIXED}.items():
                with self.subTest(vendor=name):
                    process = start(["run", *ENDLESS, *ticks, *grouped(TWO), *layout, "--record",
                                     killed, "--force"], start_new_session=True)
                    for group in ["mind", "robot"]:
                        self.assertTrue(wait_until(
                            lambda: set(components_of(process.pid)) == {"robot", "mind"}))
                        time.sleep(0.3)
                        os.kill(components_of(process.pid)[group], signal.SIGKILL)
                    _, err = process.communicate(timeout=120)

                    self.assertEqual(process.returncode, 3, err)
                    self.assertIn("mind (process ", err)
                    self.assertIn("; restarting it", err)
                    self.assertEqual(killed.read_bytes(), whole.read_bytes(), err)

    def test_a_graph_says_its_layout_and_the_command_line_outranks_it(self):
        with tempfile.TemporaryDirectory() as directory:
            graph = pathlib.Path(directory) / "two.yaml"
            graph.write_text(
                "layout: composed\nworld: u-trap\nrobot: disc-015\n"
                "sense: {behaviour: cones, process: {group: mind}}\n"
                "control: {behaviour: krishna_kalra_fuzzy, process: {group: mind}}\n"
                "drive: {behaviour: turn_then_step}\n", encoding="utf-8")
            check = Run(["check", graph])
            self.assertEqual(check.status, 0, check.err)
            self.assertIn("layout: composed\ngroup mind: sense, control in one process\n",
                          check.out)

            composed = run_graph(graph, *self.ticks)
            processes = run_graph(graph, *self.ticks, "--layout", "processes")

            self.assertEqual(composed["layout"], "composed")
            self.assertEqual(processes["layout"], "processes")
            self.assertEqual(composed["hash"], processes["hash"])

    def test_swaps_in_a_group_and_kills_in_between_change_no_byte(self):
        numbers = random.Random(14)
        with tempfile.TemporaryDirectory() as directory:
            whole = pathlib.Path(directory) / "whole.mcap"
            killed = pathlib.Path(directory) / "killed.mcap"
            run_graph(*ENDLESS, *CHANGES, "--layout", "composed", "--record", whole)
            for name, layout in VENDORS.items():
                with self.subTest(vendor=name):
                    # At a pace at which the run lasts until it is killed.
                    process = start(["run", *ENDLESS, *CHANGES, *grouped(TWO), *layout, "--pace",
                                     "300x", "--record", killed, "--force"],
                                    start_new_session=True)
                    self.assertTrue(wait_until(lambda: len(components_of(process.pid)) == 2))
                    for group in ("mind", "robot", "mind"):
                        time.sleep(numbers.uniform(0.1, 0.3))
                        if group in components_of(process.pid):
                            os.kill(components_of(process.pid)[group], signal.SIGKILL)
                    _, err = process.communicate(timeout=120)

                    self.assertEqual(process.returncode, 0, err)
                    self.assertIn("; restarting it", err)
                    self.assertEqual(killed.read_bytes(), whole.read_bytes(), err)

    def test_a_run_of_groups_is_paused_and_changed(self):
        name = f"groups-test-{os.getpid()}"
        process = start(["run", *ENDLESS, "--max-ticks", "2000", *grouped(TWO), "--pace", "300x",
                         "--name", name, "--json"], start_new_session=True)
        self.addCleanup(process.kill)
        self.assertTrue(wait_until(lambda: Run(["pause", name]).status == 0))
        stepped = Run(["step", name, "3", "--json"])
        changed = Run(["swap", name, "control=fuzzy_behaviourist", "--json"])
        self.assertEqual((stepped.status, changed.status), (0, 0), stepped.err + changed.err)
        self.assertEqual(Run(["resume", name]).status, 0)
        out, err = process.communicate(timeout=120)

        self.assertEqual(process.returncode, 3, err)
        planned = run_graph(*ENDLESS, "--max-ticks", "2000", "--layout", "composed", "--at",
                            f"{changed.report['tick']}:control=fuzzy_behaviourist")
        self.assertIn(planned["hash"], out)

    def test_a_stage_of_a_group_is_replayed_alone(self):
        with tempfile.TemporaryDirectory() as directory:
            recording = pathlib.Path(directory) / "grouped.mcap"
            run_graph(*RUN, *self.ticks, *grouped(TWO), "--record", recording)
            for stage in ("sense", "drive"):
                for how in ([], ["--publish", "--start"]):
                    with self.subTest(stage=stage, how=how):
                        done = Run(["replay", recording, "--component", stage, *how, "--json"])

                        self.assertEqual(done.status, 0, done.out + done.err)
                        self.assertTrue(done.report["identical"])

    def test_a_group_of_one_is_a_process_of_its_name(self):
        process = start(["run", *ENDLESS, "--max-ticks", "2000", *grouped({"eye": ["sense"]}),
                         "--pace", "300x"], start_new_session=True)
        self.addCleanup(process.kill)

        self.assertTrue(wait_until(lambda: set(components_of(process.pid)) ==
                                   {"eye", "classify", "recover", "control", "drive"}))

        process.send_signal(signal.SIGINT)
        process.communicate(timeout=30)

    def test_a_person_starts_a_group_by_its_name(self):
        process = start(["run", *RUN, *self.ticks, *grouped(TWO), "--external", "sense", "--json"],
                        start_new_session=True)
        self.addCleanup(process.kill)
        line = process.stderr.readline()
        found = re.search(r"waiting for mind; start it with: (.* component - mind --domain \d+)$",
                          line)
        self.assertIsNotNone(found, line)
        mind = subprocess.Popen(shlex.split(found[1]))
        out, err = process.communicate(timeout=120)

        self.assertEqual(mind.wait(timeout=30), 0)
        self.assertIn(self.expected, out, err)

    def test_a_group_has_one_middleware(self):
        run = Run(["run", *RUN, *grouped(TWO), "--middleware", "control=fastdds"])

        self.assertEqual(run.status, 2)
        self.assertIn("--middleware: the stages of group 'robot' share a process, and so one "
                      "middleware; found ", run.err)


if __name__ == "__main__":
    unittest.main()
