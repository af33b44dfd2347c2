# SPDX-License-Identifier: Apache-2.0
"""Third-party components that break the contract, over real DDS: what they did is named, and
the run ends or is not changed by it."""
import unittest

from clew_command import THIRD_PARTY, Run, write_file

GRAPH = """world: open-field
robot: disc-015
sense: {behaviour: cones}
control: {behaviour: krishna_kalra_fuzzy}
drive: {behaviour: turn_then_step}
"""


class Rogues(unittest.TestCase):
    def control(self, program, *arguments):
        words = ", ".join(f"'{word}'" for word in (str(THIRD_PARTY / program),
                                                   "--without-guidance", *arguments))
        return write_file("start_timeout_s: 3\n" + GRAPH.replace(
            "{behaviour: krishna_kalra_fuzzy}", f"{{exec: [{words}]}}"))

    def test_a_command_that_is_no_number(self):
        for vendor in ("cyclonedds", "fastdds"):
            run = Run(["run", self.control("straight_control", "--nan-at", "5"), "--middleware",
                       vendor, "--json"])

            self.assertEqual(run.status, 1)
            self.assertIn("refuses a sample of 'command': ", run.err)
            self.assertIn("motion.step_m is nan", run.err)
            self.assertEqual(run.report["refused_samples"], 1)

    def test_a_command_of_a_wrong_size(self):
        # A Command is 84 bytes with its header; DDS pads samples to multiples of 4.
        for other, what in (("target", "52 bytes: too short for its content"),
                            ("state", "96 bytes: too long; allowed: at most 84")):
            for vendor in ("cyclonedds", "fastdds"):
                with self.subTest(other=other, vendor=vendor):
                    run = Run(["run", self.control("straight_control", "--write-as", other),
                               "--middleware", vendor, "--json"])

                    self.assertEqual(run.status, 1)
                    self.assertIn("refuses a sample of 'command': ", run.err)
                    self.assertIn(what, run.err)
                    self.assertEqual(run.report["outcome"], "aborted")
                    self.assertEqual(run.report["refused_samples"], 1)

    def test_a_component_that_leaves_out_a_tick_is_named(self):
        run = Run(["run", self.control("straight_control", "--skip", "5")])

        self.assertEqual(run.status, 1)
        # The others wait for what it did not write in the sixth tick.
        self.assertIn("no tick was completed for 10 s; ticks done: drive 6 sense 6 control 5", run.err)

    def test_a_program_built_from_changed_idl(self):
        for vendor in ("cyclonedds", "fastdds"):
            run = Run(["run", self.control("stale_control"), "--middleware", vendor])

            self.assertEqual(run.status, 1)
            self.assertIn("was built from other IDL files: its fingerprint is "
                          "00000000000000000000000000000000", run.err)
            for reader in ("drive", "the run"):
                self.assertIn(f"{reader} has not found the writer of 'command' in control", run.err)

    def test_an_incompatible_qos_names_the_policy(self):
        for vendor in ("cyclonedds", "fastdds"):
            run = Run(["run", self.control("straight_control", "--best-effort"), "--middleware",
                       vendor])

            self.assertEqual(run.status, 1)
            self.assertIn("incompatible QoS policy RELIABILITY; expected RELIABLE, TRANSIENT_LOCAL, "
                          "XCDR1; the history may be any", run.err)

    def test_an_uninvited_writer_changes_nothing(self):
        for vendor in ("cyclonedds", "fastdds"):
            arguments = ["run", "reactive", "--world", "open-field", "--json", "--middleware",
                         vendor]
            alone = Run(arguments).report

            # Slow enough for discovery to tell of the writer while the run lasts.
            run = Run([*arguments, "--pace", "10x", "--prefix",
                       f"sense={THIRD_PARTY}/rogue_writer --beside"])

            self.assertEqual(run.status, 0, run.err)
            self.assertEqual(run.report["hash"], alone["hash"])
            self.assertIn("refuses the writer of 'scan'", run.err)


if __name__ == "__main__":
    unittest.main()
