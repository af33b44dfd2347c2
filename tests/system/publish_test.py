# SPDX-License-Identifier: Apache-2.0
"""Recordings on the wire: live components are fed, compared, stepped, lost and stopped."""
import json
import os
import pathlib
import shutil
import signal
import subprocess
import tempfile
import termios
import time
import unittest

from clew_command import (CLEW, THIRD_PARTY, TIMEOUT_S, Run, components_of, processes_of_session,
                          run_graph, wait_until, write_file)
from terminal import Terminal

CHANGE = ["--set", "control.guard_turn_deg=20"]
VENDORS = ["cyclonedds", "fastdds"]
INPUTS = {"drive": ["command"], "sense": ["state"], "classify": ["odometry", "scan"],
          "recover": ["landmark", "odometry", "scan", "target"],
          "control": ["guidance", "odometry", "scan"]}


class Replay:
    """A replay under way in a session of its own, steered by lines."""

    def __init__(self, *arguments, **options):
        self.process = subprocess.Popen([CLEW, "replay", *map(str, arguments), "--commands"],
                                        stdin=subprocess.PIPE, stdout=subprocess.PIPE,
                                        stderr=subprocess.PIPE, text=True, start_new_session=True,
                                        **options)
        self.err = ""

    def say(self, line):
        self.process.stdin.write(line + "\n")
        self.process.stdin.flush()

    def wait_for(self, text):
        """Reads stderr until it has the text."""
        while text not in self.err:
            line = self.process.stderr.readline()
            assert line, f"ended without '{text}': {self.err}"
            self.err += line

    def end(self):
        out, err = self.process.communicate(timeout=TIMEOUT_S)
        self.err += err
        return out

    @property
    def status(self):
        return self.process.returncode


class Published(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.directory = pathlib.Path(tempfile.mkdtemp(prefix="clew-publish-"))
        cls.recording = cls.directory / "a.mcap"
        run_graph("krishna_kalra", "--layout", "composed", "--record", cls.recording)
        cls.comb = cls.directory / "comb.mcap"
        run_graph("reactive", "--world", "comb", "--max-ticks", "150", "--layout", "composed",
                  "--record", cls.comb)

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.directory)

    def replayed(self, arguments, status):
        run = Run(["replay", *arguments])
        self.assertEqual(run.status, status, run.out + run.err)
        return run

    def refused(self, arguments, text):
        run = self.replayed(arguments, 2)
        self.assertEqual(run.out, "")
        self.assertIn(text, run.err)


class Topics(Published):
    def ticks_of(self, samples):
        """The ticks of what byte_reader wrote: each sample's first field, behind four bytes of
        length and four of encapsulation."""
        data = samples.read_bytes()
        ticks = []
        while data:
            length = int.from_bytes(data[:4], "little")
            ticks.append(int.from_bytes(data[8:16], "little"))
            data = data[4 + length:]
        return ticks

    def test_are_played_again_from_any_tick(self):
        read = self.directory / "seek.samples"
        replay = Replay(self.comb, "--publish", "scan", "--reader",
                        f"{THIRD_PARTY}/byte_reader scan {read}", "--start-paused", "--json")
        replay.wait_for("paused before tick 0")
        replay.say("step 10")
        replay.wait_for("paused before tick 10")
        replay.say("seek 3")
        replay.wait_for("paused before tick 3")
        replay.say("step 2")
        replay.wait_for("paused before tick 5")
        replay.say("seek 149")
        replay.wait_for("paused before tick 149")
        replay.say("seek -1")
        replay.wait_for("unknown command 'seek -1'")
        replay.say("resume")
        report = json.loads(replay.end())

        self.assertEqual(replay.status, 0, replay.err)
        self.assertEqual(report["published_ticks"], 10 + 2 + 2)
        self.assertEqual(self.ticks_of(read), [*range(10), 3, 4, 149, 150])

    def test_are_looped_until_told_to_end(self):
        read = self.directory / "loop.samples"
        replay = Replay(self.comb, "--publish", "scan", "--reader",
                        f"{THIRD_PARTY}/byte_reader scan {read}", "--loop",
                        "--from", "100", "--to", "119", "--start-paused", "--json")
        replay.wait_for("paused before tick 100")
        replay.say("step 50")
        replay.wait_for("paused before tick 110")
        replay.say("end")
        report = json.loads(replay.end())

        self.assertEqual(replay.status, 0, replay.err)
        self.assertEqual(report["published_ticks"], 50)
        self.assertEqual(self.ticks_of(read), [*range(100, 120), *range(100, 120),
                                               *range(100, 110)])

    def test_are_published_under_other_names(self):
        replay = Replay(self.comb, "--publish", "scan", "odometry", "--remap", "scan:=front/scan",
                        "--reader", "sleep 30", "--start-paused")
        replay.wait_for("publishes on domain ")
        domain = replay.err.split("publishes on domain ")[1].split()[0]
        topics = set()
        self.assertTrue(wait_until(lambda: topics.update(
            json.loads(line)["topic"] for line in
            Run(["topic", "list", "--domain", domain, "--json"]).out.splitlines())
            or len(topics) >= 2))
        replay.process.send_signal(signal.SIGINT)
        replay.end()

        self.assertEqual(topics, {"front/scan", "odometry"})

    def test_of_a_component_are_neither_looped_nor_renamed(self):
        component = [self.comb, "--component", "control", "--publish"]
        self.refused([*component, "--loop"], "a component's ticks only go on: leave out --loop")
        self.refused([*component, "--remap", "scan:=front"], "control reads 'scan' under its own name")
        self.refused([self.comb, "--publish", "scan", "--remap", "scan:=odometry"],
                     "two topics would be called 'odometry'")
        self.refused([self.comb, "--publish", "scan", "--remap", "scan=front"],
                     "expected TOPIC:=NAME")
        self.refused([self.comb, "--loop"], "need --publish")


class Component(Published):
    def test_of_every_stage_does_what_it_did(self):
        for vendor in VENDORS:
            for stage, inputs in INPUTS.items():
                with self.subTest(vendor=vendor, stage=stage):
                    report = self.replayed([self.recording, "--component", stage, "--publish",
                                            "--start", "--middleware", vendor, "--json"], 0).report

                    self.assertTrue(report["identical"])
                    self.assertEqual(report["component"], stage)
                    self.assertGreater(report["ticks"], 200)
                    self.assertEqual(report["published"],
                                     {topic: report["ticks"] for topic in inputs})

    def test_with_a_change_differs_where_it_does_offline(self):
        offline = self.replayed([self.comb, "--component", "control", *CHANGE, "--json"], 1).report

        arguments = [self.comb, "--component", "control", "--publish", "--start", *CHANGE]
        live = self.replayed([*arguments, "--json"], 1).report
        text = self.replayed(arguments, 1).out
        before = self.replayed([*arguments, "--json", "--to",
                                offline["first_difference"]["tick"] - 1], 0).report

        for key in ("identical", "ticks", "different_ticks", "first_difference", "inputs"):
            self.assertEqual(live[key], offline[key], key)
        self.assertIn(f"tick {offline['first_difference']['tick']}, command", text)
        self.assertIn("motion.turn_rad", text)
        self.assertTrue(before["identical"])

    def test_is_the_one_that_a_person_starts(self):
        for vendor in VENDORS:
            with self.subTest(vendor=vendor):
                replay = Replay(self.recording, "--component", "recover", "--publish",
                                "--middleware", vendor)
                replay.wait_for(f"start it with: {CLEW} component - recover --domain ")
                domain = replay.err.split("--domain ")[1].split()[0]

                component = Run(["component", "krishna_kalra", "recover", "--domain", domain])
                out = replay.end()

                self.assertEqual(component.status, 0, component.err)
                self.assertEqual(replay.status, 0, replay.err)
                self.assertIn("ticks identical", out)

    def test_may_be_there_before_the_replay(self):
        # A domain that the replay before this one has had, and that is free again.
        domain = self.replayed([self.comb, "--component", "sense", "--publish", "--start", "--json"],
                               0).report["domain"]
        with subprocess.Popen([CLEW, "component", "reactive", "sense", "--domain", str(domain)],
                              stdin=subprocess.DEVNULL) as component:
            report = self.replayed([self.comb, "--publish", "state", "--domain", domain, "--json"],
                                   0).report

            self.assertEqual(component.wait(TIMEOUT_S), 0)
        # Nobody asked for sense, but all that it needs is published.
        self.assertEqual(report["component"], "sense")
        self.assertTrue(report["identical"])
        self.assertEqual(report["ticks"], 151)

    def test_that_would_lack_an_input_is_turned_away(self):
        replay = Replay(self.comb, "--publish", "scan", "--wait", "60")
        replay.wait_for("publishes on domain ")
        domain = replay.err.split("publishes on domain ")[1].split()[0]

        control = Run(["component", "reactive", "control", "--domain", domain])
        sense = Run(["component", "reactive", "sense", "--domain", domain])
        replay.say("end")
        replay.end()

        self.assertEqual((control.status, sense.status), (1, 1))
        self.assertIn("'odometry', which control needs, is not published", control.err)
        self.assertIn("sense writes 'scan' itself", sense.err)

    def test_of_someone_else_is_fed_like_ours(self):
        graph = write_file("world: open-field\nrobot: disc-015\nsense: {behaviour: cones}\n"
                           f"control: {{exec: [{THIRD_PARTY}/straight_control, "
                           "--without-guidance]}\ndrive: {behaviour: turn_then_step}\n")
        recording = self.directory / "theirs.mcap"
        run_graph(graph, "--record", recording)

        report = self.replayed([recording, "--component", "control", "--publish", "--start",
                                "--exec", f"{THIRD_PARTY}/straight_control --without-guidance",
                                "--json"], 0).report

        self.assertTrue(report["identical"])
        self.assertGreater(report["ticks"], 10)

    def test_that_dies_is_named_with_its_tick(self):
        for vendor in VENDORS:
            with self.subTest(vendor=vendor):
                replay = Replay(self.recording, "--component", "control", "--publish", "--start",
                                "--start-paused", "--middleware", vendor)
                replay.wait_for("paused before tick 0")
                replay.say("step 9")
                replay.wait_for("paused before tick 9")

                session = replay.process.pid
                os.kill(components_of(session)["control"], signal.SIGKILL)
                replay.wait_for("was killed by signal 9 (Killed) at tick 9")
                out = replay.end()

                self.assertEqual(replay.status, 1)
                self.assertIn("published 9 ticks", out)

    def test_that_never_comes_is_missed(self):
        run = self.replayed([self.recording, "--component", "control", "--publish", "--wait", "0.5"],
                            1)

        self.assertIn("control has not reported", run.err)
        self.assertIn("replay has not found the reader of 'guidance' in control", run.err)


class Steered(Published):
    def test_by_lines_in_single_ticks(self):
        replay = Replay(self.comb, "--component", "control", "--publish", "--start",
                        "--start-paused", *CHANGE)
        replay.wait_for("paused before tick 0  control identical")
        replay.say("step 3")
        replay.wait_for("paused before tick 3  control identical")
        replay.say("jump")
        replay.wait_for("unknown command 'jump'; allowed: pause, resume, step [N]")
        replay.say("rate 1000")
        replay.say("step 100")
        replay.wait_for("paused before tick 103  control differs in ")
        replay.say("end")
        out = replay.end()

        self.assertEqual(replay.status, 1)
        self.assertIn("published 103 ticks of odometry, scan, target", out)

    def test_from_the_first_tick_that_is_compared(self):
        replay = Replay(self.comb, "--component", "control", "--publish", "--start",
                        "--start-paused", "--from", "60", "--to", "70", "--json")
        # What comes before builds the component's state and is not held up.
        replay.wait_for("paused before tick 60")
        replay.process.stdin.close()
        replay.process.stdin = None
        out = replay.end()

        self.assertEqual(replay.status, 0, replay.err)
        self.assertIn('"ticks":11,"identical":true', out)
        self.assertIn('"published_ticks":71', out)

    def test_by_keys_on_a_terminal_that_is_left_as_it_was(self):
        terminal = Terminal()
        before = termios.tcgetattr(terminal.end)
        process = terminal.start([CLEW, "replay", self.comb, "--component", "sense", "--publish",
                                  "--start", "--start-paused"])
        terminal.wait_for(b"paused  sense identical  [space] pause", TIMEOUT_S)
        terminal.press(b"n.")
        terminal.wait_for(b"tick 2  0.6 s  paused", TIMEOUT_S)
        terminal.press(b"-")
        terminal.press(b" ")
        terminal.wait_for(b" s  1x", TIMEOUT_S)
        terminal.press(b"q")
        terminal.wait_for(b"ticks \x1b[32midentical", TIMEOUT_S)

        self.assertEqual(process.wait(TIMEOUT_S), 0, terminal.shown)
        self.assertEqual(termios.tcgetattr(terminal.end), before)
        terminal.close()

    def test_keeps_to_its_rate(self):
        began = time.monotonic()
        report = self.replayed([self.comb, "--component", "sense", "--publish", "--start", "--rate",
                                "30", "--to", "50", "--json"], 0).report

        # 50 ticks of 0.3 s at 30 times their speed.
        self.assertGreaterEqual(time.monotonic() - began, 0.5)
        self.assertLess(report["ticks_per_s"], 110)

    def test_is_interrupted(self):
        for number, name in ((signal.SIGINT, "Interrupt"), (signal.SIGTERM, "Terminated")):
            with self.subTest(signal=name):
                replay = Replay(self.comb, "--component", "control", "--publish", "--start",
                                "--start-paused")
                replay.wait_for("paused before tick 0")

                replay.process.send_signal(number)
                replay.end()

                self.assertEqual(replay.status, 130)
                self.assertIn(name, replay.err)
                self.assertTrue(wait_until(lambda: not processes_of_session(replay.process.pid)))


class Refused(Published):
    def test_topics_are_named(self):
        self.refused([self.comb, "--publish", "scann"], "did you mean 'scan'?")
        self.refused([self.comb, "--publish", "landmark"], "allowed: command, odometry, scan, state")
        self.refused([self.comb, "--publish"], "nothing to publish: name topics, or a stage")
        self.refused([self.comb, "--publish", "scan", "--component", "sense"],
                     "sense writes 'scan' itself")

    def test_options_are_told(self):
        component = ["--component", "control"]
        for arguments, text in [
                (["--publish", "scan", "--middleware", "fastds"], "did you mean 'fastdds'?"),
                (["--publish", "scan", "--domain", "100"], "domain 100; allowed: 0 to 99"),
                (["--publish", "scan", "--start"], "--start needs --component"),
                (["--publish", "scan", "--branch", "5"], "leave out one"),
                (["--publish", "scan", "--from", "9", "--to", "5"], "no tick is from 9 to 5"),
                (["--publish", *component, "--prefix", "sense=gdb"], "--component is 'control'"),
                (["--publish", *component, "--prefix", "gdb"], "expected STAGE='command'"),
                (["--publish", "--component", "contrl"], "did you mean 'control'?"),
                (["--publish", "scan", "--wait", "0"], "--wait"),
                ([*component, "--start"], "need --publish"),
                (["--start-paused"], "need --publish")]:
            with self.subTest(arguments=arguments):
                self.refused([self.comb, *arguments], text)
        self.refused(["--publish", self.comb], "'clew replay RECORDING --publish [TOPIC...]'")

    def test_a_domain_that_is_taken(self):
        replay = Replay(self.comb, "--publish", "scan", "--wait", "60")
        replay.wait_for("publishes on domain ")
        domain = replay.err.split("publishes on domain ")[1].split()[0]

        self.refused([self.comb, "--publish", "scan", "--domain", domain],
                     f"domain {domain} is held by another run")
        replay.say("end")
        replay.end()

    def test_drive_where_it_cannot_be_fed_in_step(self):
        branch = self.directory / "branch.mcap"
        self.replayed([self.comb, "--branch", "70", "--set", "control.guard_turn_deg=40",
                       "--record", branch, "--force", "--json"], 3)

        self.refused([branch, "--component", "drive", "--publish", "--start"],
                     "branched off at tick 70")

    def test_nobody_listens(self):
        run = self.replayed([self.comb, "--publish", "scan", "target", "--wait", "0.5", "--json"], 1)

        self.assertIn("startup timed out after 0.5 s", run.err)
        self.assertIn("replay has not found a reader of 'scan'", run.err)
        self.assertIn("replay has not found a reader of 'target'", run.err)
        self.assertEqual(run.report["ticks"], 0)


if __name__ == "__main__":
    unittest.main()
