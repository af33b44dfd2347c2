# SPDX-License-Identifier: Apache-2.0
"""Third-party components that break the contract, and strangers, over real DDS: what they did is
named, and the run ends or is not changed by it."""
import json
import pathlib
import re
import tempfile
import unittest

from clew_command import SOURCE, THIRD_PARTY, Run, write_file

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
        # A Command without virtual targets is 88 bytes with its header.
        for other, what in (("target", "84 bytes: too short for its content; it ends in virtual_targets"),
                            ("state", "96 bytes: too long; its content ends after 88")):
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

    def beside(self, stranger, says, kind="refused"):
        """A run with a stranger on the wire, on either vendor: it is as without, and `says` so, in
        its log and in its recording."""
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        recording = pathlib.Path(scratch.name) / "r.mcap"
        for vendor in ("cyclonedds", "fastdds"):
            with self.subTest(stranger=stranger, vendor=vendor):
                options = ["run", "reactive", "--world", "open-field", "--json", "--middleware",
                           vendor]
                alone = Run(options)

                # Slow enough for discovery to tell of the stranger while the run lasts.
                run = Run([*options, "--pace", "10x", "--record", recording, "--force",
                           "--prefix", f"sense={THIRD_PARTY}/{stranger} --beside"])

                self.assertEqual(run.status, 0, run.err)
                self.assertEqual(run.report["hash"], alone.report["hash"])
                self.assertIn(says, run.err)
                self.assertEqual(run.report["restarts"], 0)
                events = map(json.loads,
                             Run(["events", recording, "--json"]).out.splitlines())
                told = [event["text"] for event in events if event["kind"] == kind]
                self.assertTrue(any(says in text for text in told), told)

    def test_an_uninvited_writer_changes_nothing(self):
        self.beside("rogue_writer scan", "refuses the writer of 'scan'")

    def test_a_writer_that_says_it_is_a_stage_of_the_run_changes_nothing(self):
        self.beside("rogue_writer control", "it says that it is of control, but has not the seal of "
                                            "this run")
        self.beside("rogue_writer sense", "it says that it is of sense, but has not the seal")

    def test_a_reader_that_asks_for_more_than_there_is_ends_nothing(self):
        self.beside("rogue_reader persistent", "incompatible QoS policy DURABILITY")

    def test_a_reader_of_somebody_elses_is_named(self):
        self.beside("rogue_reader never-takes", "somebody else listens: a reader of 'scan' "
                    "(process ", kind="foreign_reader")

    def test_a_reader_that_takes_nothing_holds_nothing_up(self):
        # Longer than any history is.
        options = ["run", "krishna_kalra", "--world", "unsolvable-behind-wall", "--with",
                   "recover.detector=none", "--max-ticks", "1500", "--json"]
        alone = Run([*options, "--layout", "composed"]).report
        for vendor in ("cyclonedds", "fastdds"):
            for pace in ("lockstep", "1000x"):
                with self.subTest(vendor=vendor, pace=pace):
                    run = Run([*options, "--middleware", vendor, "--pace", pace, "--prefix",
                               f"sense={THIRD_PARTY}/rogue_reader never-takes --beside"])

                    self.assertEqual(run.status, 3, run.err)
                    self.assertEqual(run.report["hash"], alone["hash"])

    def test_a_reader_that_takes_nothing_holds_nothing_up_beside_a_drive_of_somebody_elses(self):
        # In steps of a millimetre, so that it takes longer than any history is.
        shipped = (SOURCE / "configs/rulebases/krishna_kalra_control.yaml").read_text()
        rules = write_file(re.sub(r"(_step_m: ).*", r"\g<1>0.001", shipped))
        graph = write_file("world: open-field\nrobot: disc-015\nsense: {behaviour: cones}\n"
                           f"control: {{behaviour: krishna_kalra_fuzzy, rules: {rules}}}\n"
                           f"drive: {{exec: ['{THIRD_PARTY}/line_drive'], "
                           "behaviour: turn_then_step}\n")
        for vendor in ("cyclonedds", "fastdds"):
            with self.subTest(vendor=vendor):
                options = ["run", graph, "--json", "--max-ticks", "4000", "--middleware", vendor]
                alone = Run(options)
                self.assertGreater(alone.report["ticks"], 1100)

                run = Run([*options, "--prefix",
                           f"sense={THIRD_PARTY}/rogue_reader never-takes --beside"])

                self.assertEqual(run.status, 0, run.err)
                self.assertEqual(run.report["hash"], alone.report["hash"])


if __name__ == "__main__":
    unittest.main()
