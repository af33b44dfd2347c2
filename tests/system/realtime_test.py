# SPDX-License-Identifier: Apache-2.0
"""In real time the robot arrives at the clock's pace, and rests while nobody tells it where to go."""
import itertools
import json
import os
import pathlib
import signal
import struct
import sys
import tempfile
import time
import unittest

from clew_command import THIRD_PARTY, Run, components_of, start, wait_until, write_file
from recorded_states import states_of

TICK_S = 0.05
CONTROL = "{behaviour: krishna_kalra_fuzzy}"

# A straight way of 3.8 m to the target's rim.
WORLD = """format: clew-world/1
name: lane
bounds: [0, 0, 6, 2]
start: [1, 1, 0]
target: [5, 1]
target_radius: 0.2
"""

LONG_WORLD = WORLD.replace("6, 2", "60, 2").replace("5, 1", "50, 1")
# Its readings are said to be noisy, and are all 1.2 m for ever.
FROZEN_SENSE = (f"{{exec: ['{THIRD_PARTY}/open_sense', '7', '1.2'], behaviour: cones, range_m: 1.5, "
                "noise_stddev_m: 0.01}")


class RealTime(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.directory = pathlib.Path(scratch.name)
        self.recording = self.directory / "r.mcap"

    def arguments(self, control=CONTROL, sense="{behaviour: cones}", world=WORLD):
        lane = self.directory / "lane.yaml"
        lane.write_text(world)
        graph = self.directory / "graph.yaml"
        graph.write_text(f"world: {lane}\nrobot: disc-015\nsense: {sense}\n"
                         f"control: {control}\n"
                         f"drive: {{behaviour: turn_then_step, tick_s: {TICK_S}}}\n")
        return ["run", graph, "--pace", "realtime", "--record", self.recording, "--json"]

    def test_the_robot_arrives_in_its_own_time(self):
        run = Run(self.arguments(), timeout_s=60)

        self.assertEqual(run.status, 0, run.err)
        self.assertEqual(run.report["outcome"], "reached")
        self.assertGreaterEqual(run.report["ticks"], 26)  # of 0.15 m at most
        # No tick begins before its time, and a late command does not hold up the next one.
        self.assertGreaterEqual(run.report["wall_s"], run.report["ticks"] * TICK_S)
        self.assertAlmostEqual(run.report["ticks_per_s"] * TICK_S, 1.0, delta=0.1)

    def test_a_wall_clock_that_is_set_back_by_minutes_changes_nothing(self):
        growing = pathlib.Path(f"{self.recording}.tmp~")
        offset = self.directory / "offset"
        offset.write_bytes(struct.pack("l", 0))
        # Of 12 s. With drive alone on the other vendor, the others are given up after a lease.
        run = start(["run", "default", "--pace", "realtime", "--middleware", "drive=fastdds",
                     "--max-ticks", "40", "--record", self.recording, "--json"],
                    env={**os.environ, "LD_PRELOAD": THIRD_PARTY / "libwall_clock.so",
                         "CLEW_CLOCK_OFFSET": offset})
        self.assertTrue(wait_until(lambda: growing.exists() and len(states_of(growing)) > 5))

        # Whoever waits for a time of that clock just then waits a minute longer: which thread that
        # is differs from time to time.
        for minutes in range(1, 9):
            with open(offset, "r+b") as file:
                file.write(struct.pack("l", -60 * minutes))
            time.sleep(0.37)
        out, err = run.communicate(timeout=60)

        self.assertEqual(run.returncode, 3, err)
        self.assertIn('"outcome":"timeout"', out)
        late = sum(state.command_late for state in states_of(self.recording))
        self.assertLess(late, 20, "half of the ticks")
        self.assertTrue(Run(["replay", self.recording, "--json"]).report["identical"])

    def test_the_robot_rests_while_control_is_frozen_and_the_recording_says_so(self):
        frozen_s = 1.0  # shorter than the two seconds after which a component is given up
        growing = pathlib.Path(f"{self.recording}.tmp~")
        run = start(self.arguments(), start_new_session=True)
        self.assertTrue(wait_until(lambda: growing.exists() and len(states_of(growing)) > 5))
        control = components_of(run.pid)["control"]

        os.kill(control, signal.SIGSTOP)
        time.sleep(frozen_s)
        os.kill(control, signal.SIGCONT)
        out, err = run.communicate(timeout=60)
        states = states_of(self.recording)
        # What a state says is of the tick before it, in which the robot then stood still.
        steps = list(zip(states, states[1:]))
        resting = max((list(group) for late, group in
                       itertools.groupby(steps, lambda step: step[1].command_late) if late), key=len)

        self.assertEqual(run.returncode, 0, err)
        self.assertIn('"outcome":"reached"', out)
        # The tick in which it was frozen may have had its command, and that in which it woke, too.
        self.assertGreaterEqual(len(resting), frozen_s / TICK_S - 2)
        for before, after in steps:
            if after.command_late:
                self.assertEqual(before[1:4], after[1:4], f"moved in tick {before.tick}")
        for way in (steps[:steps.index(resting[0])], steps[steps.index(resting[-1]) + 1:]):
            self.assertGreater(sum(after.x_m - before.x_m for before, after in way), 0.2)
        self.assertTrue(Run(["replay", self.recording, "--json"]).report["identical"])

    def events(self, kind):
        lines = Run(["events", self.recording, "--json"]).out.splitlines()
        return [event for event in map(json.loads, lines) if event["kind"] == kind]

    def rests(self, ticks=20):
        """Whether the robot takes no command, by the recording so far."""
        growing = pathlib.Path(f"{self.recording}.tmp~")
        states = states_of(growing) if growing.exists() else []
        return len(states) > ticks and all(state.command_late for state in states[-ticks:])

    def test_a_sensor_that_repeats_itself_stops_the_robot_until_somebody_says_go_on(self):
        growing = pathlib.Path(f"{self.recording}.tmp~")
        name = f"frozen-sensor-{os.getpid()}"
        run = start([*self.arguments(sense=FROZEN_SENSE, world=LONG_WORLD), "--name", name],
                    start_new_session=True)
        self.assertTrue(wait_until(self.rests), "the robot does not rest")
        stopped = states_of(growing)[-1]

        resumed = Run(["resume", name])

        self.assertEqual(resumed.status, 0, resumed.err)
        self.assertTrue(wait_until(lambda: states_of(growing)[-1].x_m > stopped.x_m))
        self.assertTrue(wait_until(self.rests), "the sensor is as frozen as before")
        run.send_signal(signal.SIGINT)
        _, err = run.communicate(timeout=30)
        self.assertEqual(run.returncode, 130, err)
        (frozen,) = [event for event in self.events("frozen_sensor") if event["stage"] == "control"]
        self.assertIn("the sensor is frozen: its readings are those of tick 0, to the bit",
                      frozen["text"])
        self.assertIn(f"the robot rests until 'clew resume {name}'", frozen["text"])
        self.assertIn("; the robot goes half as fast", self.events("stale_sensor")[0]["text"])
        self.assertTrue(Run(["replay", self.recording, "--json"]).report["identical"])

    def test_a_stale_sensor_lets_every_second_command_pass_before_the_robot_rests(self):
        # Stale for 0.1 s, ten ticks, before it counts as frozen. A busy machine makes more commands late.
        arguments = self.arguments(sense=FROZEN_SENSE, world=LONG_WORLD.replace("60, 2", "600, 2")
                                   .replace("50, 1", "590, 1"))
        graph = pathlib.Path(arguments[1])
        graph.write_text(graph.read_text().replace(f"tick_s: {TICK_S}", "tick_s: 0.01"))
        for _ in range(5):
            self.recording.unlink(missing_ok=True)
            run = Run(arguments, timeout_s=60)

            self.assertEqual(run.status, 1, run.err)
            stale, frozen = (self.events(kind)[0]["tick"] for kind in ("stale_sensor", "frozen_sensor"))
            states = states_of(self.recording)
            moved = [before[1:4] != after[1:4] for before, after in zip(states, states[1:])]
            slow = moved[stale + 2:frozen]
            if any(slow):
                break
        self.assertTrue(any(slow), "it does not move at all")
        self.assertFalse(any(a and b for a, b in zip(slow, slow[1:])), "as fast as before")
        self.assertFalse(any(moved[frozen + 2:]), "it does not rest")
        self.assertTrue(any(a and b for a, b in zip(moved[:stale], moved[1:stale])))

    def test_a_sensor_that_was_gone_stops_the_robot_until_somebody_says_go_on(self):
        growing = pathlib.Path(f"{self.recording}.tmp~")
        name = f"gone-sensor-{os.getpid()}"
        run = start([*self.arguments(world=LONG_WORLD), "--name", name], start_new_session=True)
        self.assertTrue(wait_until(lambda: growing.exists() and len(states_of(growing)) > 5))
        sense = components_of(run.pid)["sense"]

        os.kill(sense, signal.SIGSTOP)
        time.sleep(1.0)
        os.kill(sense, signal.SIGCONT)

        # It has been back for longer than it was away.
        self.assertTrue(wait_until(lambda: self.rests(ticks=40)), "the robot does not rest")
        stopped = states_of(growing)[-1]
        self.assertEqual(Run(["resume", name]).status, 0)
        self.assertTrue(wait_until(lambda: states_of(growing)[-1].x_m > stopped.x_m + 0.5))
        run.send_signal(signal.SIGINT)
        _, err = run.communicate(timeout=30)
        self.assertEqual(run.returncode, 130, err)
        for kind, says in (("stale_sensor", "the sensor is stale: it has written nothing since its"),
                           ("gone_sensor", f"; the robot rests until 'clew resume {name}'"),
                           ("fresh_sensor", "the sensor is fresh again")):
            self.assertIn(says, self.events(kind)[0]["text"])
        self.assertTrue(Run(["replay", self.recording, "--json"]).report["identical"])

    def test_a_frozen_sensor_ends_a_run_in_which_nobody_can_say_go_on(self):
        # Who steers makes no difference.
        program = f"{{exec: ['{THIRD_PARTY}/straight_control', --without-guidance]}}"
        for control in (CONTROL, program):
            with self.subTest(control=control):
                self.recording.unlink(missing_ok=True)

                run = Run(self.arguments(control, FROZEN_SENSE, LONG_WORLD), timeout_s=60)

                self.assertEqual(run.status, 1, run.err)
                self.assertIn("the sensor is frozen: its readings are those of tick", run.err)
                self.assertNotIn("ended in motion", run.err)
                states = states_of(self.recording)
                self.assertGreater(states[-1].x_m - states[0].x_m, 0.05)
                self.assertEqual(states[-2][1:4], states[-1][1:4])
                told = [event for event in self.events("frozen_sensor")
                        if event["text"].startswith("the sensor is frozen")]
                self.assertEqual(len(told), 1)

    def test_a_step_that_does_not_end_is_named_with_what_it_does(self):
        program = self.directory / "odd.py"
        control = f"{{exec: ['{sys.executable}', '{program}'], via: json_lines}}"
        for doing, says in (("time.sleep(2)", "waits, as in a sleep or a dead-lock"),
                            ("end = time.process_time() + 2\n"
                             "        while time.process_time() < end: pass",
                             "uses the processor, as a busy loop does")):
            with self.subTest(doing=doing):
                self.recording.unlink(missing_ok=True)
                program.write_text(
                    "import json, sys, time\nfor line in sys.stdin:\n"
                    f"    if json.loads(line)['tick'] == 10:\n        {doing}\n"
                    "    print('{\"command\": {\"motion\": {\"kind\": "
                    "\"COMMAND_TURN_AND_STEP\", \"step_m\": 0.1}}}', flush=True)\n")

                run = Run(self.arguments(control), timeout_s=60)

                self.assertEqual(run.status, 0, run.err)
                late = [event["text"] for event in self.events("late_component")
                        if event["stage"] == "control"]
                self.assertTrue(any(says in text for text in late), late)

    def test_a_component_that_is_stopped_is_named_before_it_is_given_up(self):
        run = self.moving()
        os.kill(components_of(run.pid)["sense"], signal.SIGSTOP)
        _, err = run.communicate(timeout=30)

        self.assertEqual(run.returncode, 1, err)
        late = [event["text"] for event in self.events("late_component")
                if event["stage"] == "sense"]
        self.assertTrue(any("its process is stopped" in text for text in late), late)
        self.assertTrue(Run(["replay", self.recording, "--json"]).report["identical"])

    def moving(self):
        """A run whose robot is on its way."""
        growing = pathlib.Path(f"{self.recording}.tmp~")
        self.recording.unlink(missing_ok=True)
        growing.unlink(missing_ok=True)
        run = start(self.arguments(), start_new_session=True)
        self.assertTrue(wait_until(lambda: growing.exists() and len(states_of(growing)) > 5))
        return run

    def test_the_robot_is_brought_to_rest_when_a_component_dies(self):
        for victim in ("control", "sense"):
            with self.subTest(victim=victim):
                run = self.moving()
                os.kill(components_of(run.pid)[victim], signal.SIGKILL)
                _, err = run.communicate(timeout=30)
                states = states_of(self.recording)

                self.assertEqual(run.returncode, 1)
                self.assertRegex(err, victim + r" \(process \d+\) was killed .*; in real time it is "
                                              "not restarted; bringing the robot to rest")
                # The last tick is one in which it did not move, and says why.
                self.assertTrue(states[-1].command_late)
                self.assertEqual(states[-2][1:4], states[-1][1:4])
                self.assertTrue(Run(["replay", self.recording, "--json"]).report["identical"])

    def test_a_signal_and_a_command_bring_the_robot_to_rest_too(self):
        run = self.moving()
        os.kill(run.pid, signal.SIGTERM)
        run.communicate(timeout=30)
        states = states_of(self.recording)

        self.assertEqual(run.returncode, 130)
        self.assertTrue(states[-1].command_late)
        self.assertEqual(states[-2][1:4], states[-1][1:4])

    def test_a_robot_whose_own_process_dies_ended_in_motion_and_the_run_says_so(self):
        run = self.moving()
        os.kill(components_of(run.pid)["drive"], signal.SIGKILL)
        _, err = run.communicate(timeout=30)

        self.assertEqual(run.returncode, 1)
        self.assertRegex(err, r"drive \(process \d+\) was killed .*; it ended in motion at "
                              r"\d+\.\d\d m/s")
        self.assertIn("it ended in motion at", Run(["info", self.recording]).out)

    def test_drive_outlives_its_supervisor_until_the_robot_rests_and_no_longer(self):
        run = self.moving()
        drive = components_of(run.pid)["drive"]
        os.kill(run.pid, signal.SIGKILL)
        run.communicate(timeout=30)

        self.assertTrue(wait_until(lambda: not pathlib.Path(f"/proc/{drive}").exists(), 3))

    def test_a_command_that_is_refused_is_a_late_one(self):
        at = 10
        run = Run([*self.arguments(f"{{exec: [{THIRD_PARTY}/straight_control, --without-guidance, "
                                   f"--nan-at, '{at}']}}"), "--on-record-error", "continue"])

        self.assertEqual(run.status, 0, run.err)
        self.assertEqual(run.report["outcome"], "reached")
        self.assertEqual(run.report["refused_samples"], 1)
        self.assertIn("drive refuses a sample of 'command': ", run.err)
        self.assertIn("motion.step_m is nan", run.err)
        self.assertIn(f"the recording lacks 'command' of tick {at}", run.err)
        self.assertTrue(states_of(self.recording)[at + 1].command_late)


if __name__ == "__main__":
    unittest.main()
