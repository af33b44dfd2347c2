# SPDX-License-Identifier: Apache-2.0
"""--realtime-priority: every thread of every component has it, it changes no byte, and who may not
ask for it is told so."""
import os
import pathlib
import subprocess
import sys
import unittest

from clew_command import CLEW, SOURCE, Run, components_of, start, wait_until

sys.path.insert(0, str(SOURCE / "tools"))
from resident import ENDLESS  # noqa: E402

MAY = subprocess.run(["chrt", "--fifo", "1", "true"], capture_output=True, check=False).returncode == 0


def threads(pid):
    return [int(thread.name) for thread in pathlib.Path(f"/proc/{pid}/task").iterdir()]


def serving(session):
    """The components that have the bus's threads besides their own."""
    return {stage: pid for stage, pid in components_of(session).items() if len(threads(pid)) > 3}


def scheduling(pid):
    """Policy and priority of each thread of a process."""
    return {(os.sched_getscheduler(thread), os.sched_getparam(thread).sched_priority)
            for thread in threads(pid)}


class RealtimePriority(unittest.TestCase):
    @unittest.skipUnless(MAY, "this user may not have real-time priorities")
    def test_is_that_of_every_thread_that_serves_the_bus(self):
        process = start([*ENDLESS, "--max-ticks", 1_000_000, "--pace", "10x", "--json",
                         "--realtime-priority", 3], start_new_session=True)
        try:
            self.assertTrue(wait_until(lambda: len(serving(process.pid)) == 5))

            for pid in serving(process.pid).values():
                self.assertEqual(scheduling(pid), {(os.SCHED_FIFO, 3)})
            self.assertEqual(scheduling(process.pid), {(os.SCHED_OTHER, 0)})
        finally:
            process.terminate()
            process.communicate(timeout=10)

    @unittest.skipUnless(MAY, "this user may not have real-time priorities")
    def test_changes_no_byte(self):
        graph = ["run", "krishna_kalra", "--json"]

        self.assertEqual(Run([*graph, "--realtime-priority", 1]).report["hash"],
                         Run([*graph, "--layout", "composed"]).report["hash"])

    def test_is_refused_where_it_is_not_allowed(self):
        arguments = ["setpriv", "--bounding-set=-sys_nice", "--inh-caps=-sys_nice",
                     "prlimit", "--rtprio=0", CLEW, "run", "reactive", "--realtime-priority", "1"]
        done = subprocess.run(arguments, capture_output=True, text=True, timeout=60, check=False)

        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertIn("real-time priority 1: Operation not permitted", done.stderr)

    def test_is_for_processes_and_within_bounds(self):
        for arguments in (["--layout", "composed", "--realtime-priority", 1],
                          ["--realtime-priority", 0], ["--realtime-priority", 100]):
            run = Run(["run", "reactive", *arguments])

            self.assertEqual(run.status, 2)
            self.assertIn("--realtime-priority", run.err)


if __name__ == "__main__":
    unittest.main()
