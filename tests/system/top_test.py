# SPDX-License-Identifier: Apache-2.0
"""clew top tells how the components of a live run are: of processes, groups and composed runs."""
import itertools
import json
import os
import pathlib
import signal
import unittest

from clew_command import CLEW, Run, components_of, start, wait_until
from terminal import Terminal

# Many seconds of ticks; the robot wanders before a wall.
RUN = ["krishna_kalra", "--world", "unsolvable-behind-wall", "--with", "recover.detector=none"]
STAGES = ["drive", "sense", "classify", "recover", "control"]
# A tick is 0.3 s of simulated time.
PACE = ["--pace", "60x"]
RATE_HZ = 200
NUMBERS = itertools.count()


def top(name, *arguments):
    return Run(["top", name, *arguments])


class Top(unittest.TestCase):
    def begin(self, *arguments):
        """Starts a run; its name and process, once it has begun."""
        name = f"top-test-{os.getpid()}-{next(NUMBERS)}"
        process = start(["run", *RUN, *PACE, *arguments, "--name", name], start_new_session=True)
        self.addCleanup(process.communicate)
        self.addCleanup(process.kill)
        self.assertTrue(wait_until(lambda: Run(["resume", name]).err.endswith("not paused\n")))
        return name, process

    def rows(self, name):
        done = top(name, "--once", "--json")
        self.assertEqual(done.status, 0, done.err)
        rows = [json.loads(line) for line in done.out.splitlines()]
        self.assertEqual([row["stage"] for row in rows], STAGES)
        return rows

    def check(self, row):
        self.assertAlmostEqual(row["rate_hz"], RATE_HZ, delta=0.3 * RATE_HZ)
        self.assertGreater(row["step_us"]["p50"], 0)
        self.assertLessEqual(row["step_us"]["p50"], row["step_us"]["p99"])
        # A step is over before the next tick.
        self.assertLess(row["step_us"]["p50"], 1e6 / RATE_HZ)
        self.assertGreaterEqual(row["cpu_percent"], 0)
        pages = int(pathlib.Path(f"/proc/{row['pid']}/statm").read_text().split()[1])
        self.assertAlmostEqual(row["rss_bytes"], pages * os.sysconf("SC_PAGE_SIZE"),
                               delta=0.3 * row["rss_bytes"])

    def test_each_process_is_told(self):
        name, process = self.begin("--middleware", "sense=fastdds")
        rows = self.rows(name)

        for row in rows:
            self.check(row)
            self.assertEqual((row["restarts"], row["refused_samples"]), (0, 0))
            self.assertLess(row["silent_s"], 1)
        self.assertEqual({row["stage"]: row["pid"] for row in rows}, components_of(process.pid))

    def test_a_restart_is_counted(self):
        name, process = self.begin()
        killed = components_of(process.pid)["control"]
        os.kill(killed, signal.SIGKILL)

        self.assertTrue(wait_until(lambda: self.rows(name)[4]["restarts"] == 1))
        self.assertTrue(wait_until(lambda: self.rows(name)[4]["pid"] not in (None, killed)))
        self.assertEqual([row["restarts"] for row in self.rows(name)], [0, 0, 0, 0, 1])

    def test_stages_of_a_group_are_told_each(self):
        groups = [word for stage in STAGES[1:4]
                  for word in ("--set", f"{stage}.process.group=eyes")]
        name, _ = self.begin(*groups)
        rows = self.rows(name)

        self.assertEqual([row["process"] for row in rows], ["drive"] + ["eyes"] * 3 + ["control"])
        self.assertEqual(len({row["pid"] for row in rows[1:4]}), 1)
        for row in rows:
            self.check(row)

    def test_a_composed_run_is_told_as_well(self):
        name, process = self.begin("--layout", "composed")

        for row in self.rows(name):
            self.check(row)
            self.assertEqual(row["pid"], process.pid)

    def test_a_run_that_is_paused_has_no_rate(self):
        name, _ = self.begin()
        self.assertEqual(Run(["pause", name]).status, 0)
        # What was started when it was paused has been done by the second look.
        self.assertTrue(wait_until(lambda: all(row["rate_hz"] == 0 for row in self.rows(name))))
        told = top(name, "--once")
        self.assertIn(", paused\n", told.out)
        self.assertEqual(len(told.out.splitlines()), 2 + len(STAGES))

    def test_a_terminal_has_one_screen(self):
        name, process = self.begin()
        terminal = Terminal()
        self.addCleanup(terminal.close)
        command = terminal.start([CLEW, "top", name])
        self.addCleanup(command.kill)
        # Twice on the same place of the screen.
        for _ in range(2):
            terminal.wait_for(b"\x1b[H\x1b[Jrun " + name.encode(), 20)
        process.kill()
        terminal.wait_for(b"is over", 20)
        self.assertEqual(command.wait(timeout=20), 0)

    def test_a_run_that_is_not_there_is_said(self):
        done = top("nobody-is-called-so", "--once", "--json")
        self.assertEqual(done.status, 2)
        self.assertIn("no run is called 'nobody-is-called-so'", done.err)


if __name__ == "__main__":
    unittest.main()
