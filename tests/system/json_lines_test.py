# SPDX-License-Identifier: Apache-2.0
"""Programs that speak JSON lines take the places of stages; what they do wrong is named."""
import json
import os
import pathlib
import signal
import sys
import tempfile
import unittest

from clew_command import SOURCE, Run, components_of, start, wait_until

EXAMPLE = SOURCE / "examples" / "json_lines" / "my_control.py"
STOP = '{"command": {"motion": {"kind": "COMMAND_STOP"}}}'

# A point on an empty plane, which goes where it is told and has arrived after 20 ticks.
DRIVE = """
import json, os, sys
tick_s = float(os.environ["CLEW_TICK_S"])
x_m = 1.0
for line in sys.stdin:
    tick = json.loads(line)
    if tick["command"] is not None:
        x_m += tick["command"]["motion"]["step_m"]
    pose = {"x_m": x_m, "y_m": 1.0, "heading_rad": 0.0}
    outcome = "OUTCOME_REACHED" if tick["tick"] == 20 else "OUTCOME_RUNNING"
    print(json.dumps({"state": {"pose_world_robot": pose, "outcome": outcome},
                      "odometry": {"pose_odom_robot": pose},
                      "target": {"x_m": 9.0, "y_m": 1.0, "radius_m": 0.2}}), flush=True)
"""


class JsonLines(unittest.TestCase):
    def setUp(self):
        self.directory = tempfile.TemporaryDirectory(prefix="clew-lines-")
        self.path = pathlib.Path(self.directory.name)

    def tearDown(self):
        self.directory.cleanup()

    def graph(self, control, drive="{behaviour: turn_then_step}", world="open-field"):
        path = self.path / "graph.yaml"
        path.write_text(f"world: {world}\nrobot: disc-015\nsense: {{behaviour: cones}}\n"
                        "recover: {detector: none, escape: []}\n"
                        f"control: {control}\ndrive: {drive}\n")
        return path

    def program(self, text):
        """`exec` of a program with this text, over JSON lines."""
        path = self.path / "program.py"
        path.write_text(text)
        return f"exec: [{sys.executable}, {path}], via: json_lines"

    def answering(self, code):
        """A program that answers each tick with what `code` makes of `tick`, a number."""
        return self.program("import json, sys, time\nfor line in sys.stdin:\n"
                            f"    tick = json.loads(line)['tick']\n    {code}\n")

    def refused(self, code, text, tick=5):
        stop = f"print('{STOP}', flush=True) if tick != {tick} else {code}"
        run = Run(["run", self.graph(f"{{{self.answering(stop)}}}"), "--json"])

        self.assertEqual(run.status, 1, run.err)
        self.assertIn(f"control: at tick {tick}: {text}", run.err)
        self.assertEqual(run.report["outcome"], "aborted")

    def test_makes_the_same_bytes_with_either_vendor(self):
        graph = self.graph(f"{{exec: [{sys.executable}, {EXAMPLE}], via: json_lines}}")

        runs = [Run(["run", graph, "--json", "--middleware", vendor])
                for vendor in ("cyclonedds", "fastdds")]

        self.assertEqual([run.status for run in runs], [0, 0], runs[0].err + runs[1].err)
        self.assertEqual(len({run.report["hash"] for run in runs}), 1)

    def test_an_answer_that_is_none_is_named(self):
        for code, text in (
                ("print('no', flush=True)", "its line 'no' is no object of JSON"),
                ("print('{}', flush=True)", "its line lacks 'command'"),
                ("""print('{"comand": {}}', flush=True)""", "unknown key of its line 'comand' (did you "
                 "mean 'command'?); allowed: tick, command"),
                ("""print('{"command": {"motion": {"step_m": "1"}}}', flush=True)""",
                 'command.motion.step_m is "1"; allowed: a number'),
                ("""print('{"command": {"motion": {"kind": "COMMAND_TURN_AND_STEP", '
                 '"turn_rad": 4}}}', flush=True)""", "command: motion.turn_rad is 4; allowed"),
                ("""print('{"tick": 4, "command": {}}', flush=True)""", "its line is of tick 4"),
                ("sys.exit(3)", "it exited with status 3")):
            with self.subTest(text):
                self.refused(code, text)

    def test_a_second_line_is_named_with_the_next_tick(self):
        # In one piece, so that both are there at once.
        twice = (f"sys.stdout.write('{STOP}\\n' * (2 if tick == 4 else 1))\n"
                 "    sys.stdout.flush()")
        run = Run(["run", self.graph(f"{{{self.answering(twice)}}}")])

        self.assertEqual(run.status, 1)
        self.assertRegex(run.err, "control: at tick 5: it wrote '.*' without being asked: one line is "
                         "allowed for each")

    def test_a_program_that_is_not_there(self):
        run = Run(["run", self.graph("{exec: [./nothing], via: json_lines}")])

        self.assertEqual(run.status, 2)
        self.assertIn("there is no program './nothing'", run.err)

    def test_a_stateless_one_that_is_killed_changes_no_byte(self):
        graph = self.graph(f"{{exec: [{sys.executable}, {EXAMPLE}], via: json_lines, "
                           "restart: stateless}")
        undisturbed = Run(["run", graph, "--json"]).report
        run = start(["run", graph, "--json", "--pace", "20x"], start_new_session=True)
        self.assertTrue(wait_until(lambda: "control" in components_of(run.pid)))
        self.assertTrue(wait_until(lambda: self.killed(run.pid)))
        out, err = run.communicate(timeout=60)

        report = json.loads(out.strip().splitlines()[-1])
        self.assertEqual(run.returncode, 0, err)
        self.assertEqual(report["hash"], undisturbed["hash"])
        self.assertGreaterEqual(report["restarts"], 1)
        self.assertIn("restarting it", err)

    @staticmethod
    def killed(session):
        """Kills the program, once it is there."""
        for entry in pathlib.Path("/proc").iterdir():
            try:
                words = (entry / "cmdline").read_bytes().decode().split("\0")
                own = os.getsid(int(entry.name)) == session
            except (OSError, ValueError):
                continue
            if own and str(EXAMPLE) in words and words[0] == sys.executable:
                os.kill(int(entry.name), signal.SIGKILL)
                return True
        return False

    def test_another_one_is_not_started_again(self):
        self.refused("sys.exit(0)", "it exited with status 0")

    def test_a_drive(self):
        drive = f"{{{self.program(DRIVE)}, behaviour: turn_then_step}}"
        recording = self.path / "r.mcap"

        run = Run(["run", self.graph("{behaviour: krishna_kalra_fuzzy}", drive), "--json",
                   "--record", recording])

        self.assertEqual(run.status, 0, run.err)
        self.assertEqual(run.report["outcome"], "reached")
        self.assertEqual(run.report["ticks"], 20)
        self.assertEqual(Run(["info", recording]).status, 0)
        # What is fed to the others is what it wrote.
        self.assertEqual(Run(["replay", recording]).status, 0)

    def test_a_recording_with_a_stateless_one_is_gone_on_with_and_branches(self):
        graph = self.graph(f"{{exec: [{sys.executable}, {EXAMPLE}], via: json_lines, "
                           "restart: stateless}")
        whole, cut, branch = (self.path / f"{name}.mcap" for name in ("whole", "cut", "branch"))
        self.assertEqual(Run(["run", graph, "--record", whole]).status, 0)
        cut.write_bytes(whole.read_bytes()[:whole.stat().st_size // 2])

        named = ["--exec", f"{sys.executable} {EXAMPLE}"]
        resumed = Run(["run", "--resume", cut, *named])
        changed = Run(["replay", whole, "--branch", "50", "--record", branch, "--json",
                       "--set", "drive.safety=false", *named])

        self.assertEqual(resumed.status, 0, resumed.err)
        self.assertEqual(cut.read_bytes(), whole.read_bytes())
        self.assertEqual(changed.status, 0, changed.err)
        # A field without obstacles needs no safety layer, so only the graph differs.
        self.assertEqual(Run(["diff", whole, branch]).status, 0)

    def test_a_bench(self):
        graph = self.graph(f"{{exec: [{sys.executable}, {EXAMPLE}], via: json_lines}}")
        suite = self.path / "suite.yaml"
        suite.write_text(f"format: clew-suite/1\ngraphs: [{graph}]\nworlds: {{open: [open-field]}}\n"
                         "seeds: [1]\nmax_ticks: 2000\n")

        run = Run(["bench", suite, "--out", self.path / "out", "--json"])

        self.assertEqual(run.status, 0, run.err)
        one = json.loads(run.out.strip().splitlines()[0])
        self.assertEqual((one["outcome"], one["layout"]), ("reached", "processes"))
        self.assertEqual(one["hash"], Run(["run", graph, "--json"]).report["hash"])


if __name__ == "__main__":
    unittest.main()
