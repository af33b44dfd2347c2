# SPDX-License-Identifier: Apache-2.0
"""A run on a terminal shows how far it is, and ends when Ctrl-C is pressed."""
import json
import math
import os
import pathlib
import re
import subprocess
import tempfile
import unittest

from clew_command import CLEW, TIMEOUT_S, Run, components_of, processes_of_session, wait_until
from recorded_states import states_of
from terminal import Terminal

PROGRESS = re.compile(rb"tick (\d+)  distance (\d+\.\d\d) m  (\w+)  (\d+) ticks/s")
LAYOUTS = (["--layout", "composed"], ["--middleware", "fastdds"])
GONE_WITHIN_S = 2.0
TARGET = (5.1, 9.0)  # of u-trap


class OnATerminal(unittest.TestCase):
    def run_shown(self, *arguments):
        """A terminal, and a run on it with its report in a pipe. Neither outlives the test."""
        terminal = Terminal()
        self.addCleanup(terminal.close)
        process = terminal.start([CLEW, "run", "krishna_kalra", "--json", *arguments],
                                 stdout=subprocess.PIPE)

        def end():
            process.kill()
            process.communicate()

        self.addCleanup(end)
        return terminal, process


class Dumb(unittest.TestCase):
    def test_a_terminal_without_control_codes_gets_none(self):
        terminal = Terminal("dumb")
        self.addCleanup(terminal.close)
        run = terminal.start([CLEW, "run", "krishna_kalra", "--world", "u-trap", "--layout",
                              "composed", "--pace", "200x"], stdout=subprocess.PIPE)
        while terminal.read(0.1) or run.poll() is None:
            pass
        out, _ = run.communicate()

        self.assertEqual(run.returncode, 0)
        self.assertIn(b"reached in u-trap", out)
        self.assertEqual(terminal.shown, b"")


class Colour(unittest.TestCase):
    def shown(self, *arguments, kind="xterm", no_colour=None):
        terminal = Terminal(kind)
        self.addCleanup(terminal.close)
        prefix = ["env", f"NO_COLOR={no_colour}"] if no_colour is not None else []
        run = terminal.start([*prefix, CLEW, *arguments])
        while terminal.read(0.1) or run.poll() is None:
            pass
        return terminal.shown

    def test_marks_an_outcome_unless_somebody_wants_none(self):
        run = ["run", "krishna_kalra", "--world", "open-field", "--layout", "composed", "-q"]
        late = [*run, "--max-ticks", "3"]

        self.assertIn(b"\x1b[32mreached\x1b[0m in open-field", self.shown(*run))
        self.assertIn(b"\x1b[33mtimeout\x1b[0m in open-field", self.shown(*late))
        # An empty value is none, as https://no-color.org has it.
        self.assertIn(b"\x1b[32mreached", self.shown(*run, no_colour=""))
        for plain in (self.shown(*run, no_colour="1"), self.shown(*run, kind="dumb")):
            self.assertIn(b"reached in open-field", plain)
            self.assertNotIn(b"\x1b", plain)

    def test_is_in_no_pipe(self):
        done = subprocess.run([CLEW, "run", "krishna_kalra", "--world", "open-field", "--layout",
                               "composed"], capture_output=True, check=True)

        self.assertNotIn(b"\x1b", done.stdout + done.stderr)


class Progress(OnATerminal):
    def test_is_shown_on_a_terminal(self):
        for layout in LAYOUTS:
            with self.subTest(layout=layout), tempfile.TemporaryDirectory() as directory:
                recording = pathlib.Path(directory) / "r.mcap"
                terminal, run = self.run_shown("--world", "u-trap", "--pace", "100x", "--record",
                                               recording, *layout)
                while terminal.read(0.1) or run.poll() is None:
                    pass
                states = states_of(recording)
                shown = PROGRESS.findall(terminal.shown)

                self.assertEqual(run.returncode, 0)
                # One line that is written over: no line break, and nothing left of it.
                self.assertNotIn(b"\n", terminal.shown)
                self.assertTrue(terminal.shown.endswith(b"\r\x1b[K"), terminal.shown)
                # 252 ticks of 0.3 s at 100 times their speed are 0.75 s: ten times a second.
                self.assertGreater(len(shown), 4)
                for tick, distance_m, _, _ in shown:
                    state = states[int(tick)]
                    self.assertAlmostEqual(float(distance_m), math.dist(TARGET, state[1:3]),
                                           delta=0.0051)  # two decimals
                self.assertEqual({mode for _, _, mode, _ in shown}, {b"seek", b"recover"})
                # 100 / 0.3 s, or less on a loaded machine; rounded, and not from a first tick on time.
                self.assertTrue(100 < float(shown[-1][3]) < 360, shown)

    def test_is_not_shown_in_a_pipe(self):
        for layout in LAYOUTS:
            run = Run(["run", "krishna_kalra", "--world", "open-field", "--pace", "50x", *layout])

            self.assertEqual(run.status, 0)
            self.assertEqual(run.err, "")
            self.assertEqual(len(run.out.splitlines()), 1)


class CtrlC(OnATerminal):
    def test_ends_the_run_and_all_its_processes(self):
        # Only a component with a prefix, a debugger maybe, shares the terminal and gets the signal.
        for layout, sharing in [*((layout, set()) for layout in LAYOUTS),
                                (["--prefix", "control=env"], {"control"})]:
            with self.subTest(layout=layout), tempfile.TemporaryDirectory() as directory:
                recording = pathlib.Path(directory) / "r.mcap"
                terminal, run = self.run_shown("--world", "unsolvable-behind-wall", "--pace", "5x",
                                               "--record", recording, *layout)
                terminal.wait_for(b" ticks/s", TIMEOUT_S)
                components = components_of(run.pid)
                self.assertEqual(len(components), 0 if "composed" in layout else 5)
                self.assertEqual({stage for stage, pid in components.items()
                                  if os.getpgid(pid) == run.pid}, sharing)

                terminal.press(b"\x03")
                terminal.wait_for(b"interrupted by signal 2 (Interrupt)", GONE_WITHIN_S)
                report = json.loads(run.stdout.read())
                status = run.wait(GONE_WITHIN_S)

                self.assertEqual(status, 130)
                self.assertTrue(wait_until(lambda: not processes_of_session(run.pid), GONE_WITHIN_S))
                self.assertEqual(report["outcome"], "aborted")
                # Where the robot stopped is where the recording ends, and no component was blamed.
                self.assertEqual(states_of(recording)[-1].tick, report["ticks"])
                self.assertNotIn(b"was killed", terminal.shown)
                self.assertEqual(report["restarts"], 0)


if __name__ == "__main__":
    unittest.main()
