# SPDX-License-Identifier: Apache-2.0
"""No process of a run grows with the run's length: what a long recorded run needs, a short one needs,
too, within a tenth."""
import pathlib
import tempfile
import time
import unittest

from clew_command import LAYOUTS, SOAK, command_line, processes_of_session, start

# In this world nobody arrives, and without a detector nobody gives up: every run has all ticks.
RUN = ["run", "krishna_kalra", "--world", "unsolvable-box", "--with", "recover.detector=none"]
SHORT, LONG = (10_000, 1_000_000) if SOAK else (2_500, 10_000)
# Samples come every few milliseconds; the last one before the end is near the peak.
PERIOD_S = 0.02


def role(pid):
    """What a process of a run is: `run`, `recorder`, or its stage."""
    words = command_line(pid)
    return words[3] if words[1:2] == ["component"] else (words[1:2] or [""])[0]


def peak_kib(pid):
    """The most memory that a process has had so far; none if it is gone."""
    try:
        status = pathlib.Path(f"/proc/{pid}/status").read_text(encoding="ascii")
    except OSError:
        return None
    lines = [line for line in status.splitlines() if line.startswith("VmHWM:")]
    return int(lines[0].split()[1]) if lines else None


def peaks_kib(ticks, layout, path):
    """The peak of each process of a recorded run, by role."""
    process = start([*RUN, *layout, "--max-ticks", ticks, "--record", path, "--force"],
                    start_new_session=True)
    peaks = {}
    while process.poll() is None:
        for pid in processes_of_session(process.pid):
            peak = peak_kib(pid)
            if peak and role(pid):
                peaks[role(pid)] = peak
        time.sleep(PERIOD_S)
    _, err = process.communicate()
    assert process.returncode == 3, err
    return peaks


class Memory(unittest.TestCase):
    def test_a_long_run_needs_no_more_than_a_short_one(self):
        with tempfile.TemporaryDirectory() as directory:
            path = pathlib.Path(directory) / "r.mcap"
            for name in ("composed", "cyclonedds", "fastdds"):
                short = peaks_kib(SHORT, LAYOUTS[name], path)
                long = peaks_kib(LONG, LAYOUTS[name], path)

                self.assertIn("run", long)
                self.assertEqual(len(long), 1 if name == "composed" else 7)
                for process, peak in long.items():
                    with self.subTest(layout=name, process=process, ticks=LONG):
                        self.assertLess(peak, 1.1 * short[process])


if __name__ == "__main__":
    unittest.main()
