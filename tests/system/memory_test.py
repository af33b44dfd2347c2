# SPDX-License-Identifier: Apache-2.0
"""No process of a run grows with the run's length: what a long recorded run needs, a short one needs,
too, within a tenth; and a component needs what is said of its vendor at most."""
import pathlib
import sys
import tempfile
import unittest

from clew_command import CLEW, LAYOUTS, SOAK, SOURCE

sys.path.insert(0, str(SOURCE / "tools"))
from resident import ENDLESS, peaks_kib  # noqa: E402

SHORT, LONG = (10_000, 1_000_000) if SOAK else (2_500, 10_000)
# One process is over in a moment, and would not be looked at.
COMPOSED_TIMES = 16
# Peaks; drive, which has the world and keeps its inputs of late, needs most.
MOST_KIB = {"cyclonedds": 18 * 1024, "fastdds": 26 * 1024}


class Memory(unittest.TestCase):
    def test_a_long_run_needs_no_more_than_a_short_one(self):
        with tempfile.TemporaryDirectory() as directory:
            record = ["--record", pathlib.Path(directory) / "r.mcap", "--force"]
            for name in ("composed", "cyclonedds", "fastdds"):
                times = COMPOSED_TIMES if name == "composed" else 1
                short, long = (peaks_kib(CLEW, [*ENDLESS, *LAYOUTS[name], "--max-ticks", times * ticks,
                                                *record]) for ticks in (SHORT, LONG))

                self.assertIn("run", long)
                self.assertEqual(len(long), 1 if name == "composed" else 7)
                for process, peak in long.items():
                    with self.subTest(layout=name, process=process, ticks=LONG):
                        self.assertLess(peak, 1.1 * short[process])
                        if process not in ("run", "recorder"):
                            self.assertLess(peak, MOST_KIB[name])

    @unittest.skipUnless(SOAK, "takes half an hour")
    def test_a_long_secured_run_grows_by_a_megabyte_at_most(self):
        short, long = (peaks_kib(CLEW, [*ENDLESS, *LAYOUTS["cyclonedds"], "--secure", "--max-ticks", ticks])
                       for ticks in (20_000, 864_000))

        self.assertEqual(len(long), 6)
        for process, peak in long.items():
            with self.subTest(process=process):
                self.assertLess(peak, short[process] + 1024)


if __name__ == "__main__":
    unittest.main()
