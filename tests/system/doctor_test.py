# SPDX-License-Identifier: Apache-2.0
"""What `clew doctor` says of this machine, of one without a loopback, and of a run that goes on."""
import json
import signal
import subprocess
import unittest

from clew_command import CLEW, TIMEOUT_S, Run, start, wait_until


def by_check(text):
    return {each["check"]: each for each in map(json.loads, text.splitlines())}


class Doctor(unittest.TestCase):
    def test_this_machine_has_what_runs_need(self):
        done = Run(["doctor", "--json"])
        checks = by_check(done.out)

        self.assertEqual(done.status, 0, done.out)
        for sender in ("cyclonedds", "fastdds"):
            for receiver in ("cyclonedds", "fastdds"):
                self.assertRegex(checks[f"{sender}_to_{receiver}"]["found"], r"arrived after \d+ ms")
        for each in checks.values():
            self.assertEqual(sorted(each), ["check", "fix", "found", "ok"])
            self.assertEqual(each["fix"], "")
        self.assertIn(Run(["--version"]).out.strip(), checks["versions"]["found"])

    def test_a_run_that_goes_on_is_told(self):
        run = start(["run", "reactive", "--pace", "realtime", "--name", "for-the-doctor"])
        self.addCleanup(run.communicate, timeout=30)
        self.addCleanup(run.send_signal, signal.SIGINT)

        def told():
            return by_check(Run(["doctor", "--json"]).out)["runs"]["found"]

        self.assertTrue(wait_until(lambda: "run for-the-doctor" in told()), told())
        self.assertRegex(told(), r"domain \d+")

    def test_without_a_loopback_says_what_to_do(self):
        done = subprocess.run(["unshare", "--map-root-user", "--net", CLEW, "doctor"], text=True,
                              capture_output=True, timeout=TIMEOUT_S, check=False)

        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertRegex(done.stdout, r"BAD +loopback +no interface that is up has 127.0.0.1\n"
                                      r" +what to do: .*ip link set lo up")
        self.assertRegex(done.stdout, r"good +configs")

    def test_a_run_without_a_loopback_is_refused_and_a_composed_one_needs_none(self):
        without = ["unshare", "--map-root-user", "--net", CLEW, "run", "reactive", "--max-ticks", "3"]
        for vendor in ("cyclonedds", "fastdds"):
            done = subprocess.run([*without, "--middleware", vendor], text=True, capture_output=True,
                                  timeout=TIMEOUT_S, check=False)

            self.assertEqual((done.returncode, done.stdout), (2, ""), done.stderr)
            self.assertRegex(done.stderr, "^clew: no interface that is up has 127.0.0.1, .*"
                                          "'clew doctor' says what to do")
        composed = subprocess.run([*without, "--layout", "composed"], text=True, capture_output=True,
                                  timeout=TIMEOUT_S, check=False)

        self.assertEqual(composed.returncode, 3, composed.stderr)


if __name__ == "__main__":
    unittest.main()
