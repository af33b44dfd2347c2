# SPDX-License-Identifier: Apache-2.0
"""A run whose recording was cut off goes on, in any layout, and ends with the recording that it
would have made, byte for byte."""
import os
import pathlib
import random
import shutil
import signal
import tempfile
import unittest

from clew_command import LAYOUTS, SOAK, THIRD_PARTY, Run, components_of, start, wait_until, write_file

# Walls, landmarks, traps and events; 500 ticks or so.
RUN = ["run", "krishna_kalra", "--world", "double-u", "--max-ticks", "400"]
TEARS = 200 if SOAK else 3


def first_chunk(recording):
    """Where the first chunk begins: before, the file does not say yet of which run it is."""
    place = 8
    while recording[place] != 0x06:
        place += 9 + int.from_bytes(recording[place + 1:place + 9], "little")
    return place


class Resume(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.scratch = tempfile.TemporaryDirectory()
        cls.directory = pathlib.Path(cls.scratch.name)
        cls.whole = {}
        for compression in ("none", "zstd"):
            path = cls.directory / f"{compression}.mcap"
            run = Run([*RUN, "--json", "--layout", "composed", "--record", path, "--compression",
                       compression])
            assert run.status in (0, 3), run.err
            cls.whole[compression] = path.read_bytes()
            cls.status = run.status
            cls.report = run.report

    @classmethod
    def tearDownClass(cls):
        cls.scratch.cleanup()

    def setUp(self):
        self.path = self.directory / "torn.mcap"
        self.cut_off = self.directory / "torn.mcap.tmp~"
        self.clear()

    def clear(self):
        for path in (self.path, self.cut_off):
            path.unlink(missing_ok=True)

    def assert_goes_on(self, named, layout, whole):
        run = Run(["run", "--resume", named, "--json", *layout])

        self.assertEqual(run.status, self.status, run.err)
        self.assertEqual(run.report["hash"], self.report["hash"])
        self.assertEqual(run.report["ticks"], self.report["ticks"])
        self.assertEqual(run.report["path_length_m"], self.report["path_length_m"])
        self.assertEqual(run.report["traps_detected"], self.report["traps_detected"])
        self.assertEqual(run.report["recording"], str(self.path))
        self.assertEqual(self.path.read_bytes(), whole)
        self.assertFalse(self.cut_off.exists())

    def test_a_tear_at_any_byte_in_every_layout(self):
        numbers = random.Random(3)
        for compression, whole in self.whole.items():
            described = first_chunk(whole)
            for name, layout in LAYOUTS.items():
                for tear in [len(whole) - 1] + [numbers.randrange(described, len(whole))
                                                for _ in range(TEARS - 1)]:
                    with self.subTest(compression=compression, layout=name, tear=tear):
                        self.clear()
                        named = numbers.choice([self.path, self.cut_off])
                        named.write_bytes(whole[:tear])
                        self.assert_goes_on(named, layout, whole)

    def test_a_planned_change_that_brings_a_file_goes_on(self):
        changed = [*RUN, "--json", "--at", "50:control=fuzzy_behaviourist"]
        whole = self.directory / "changed.mcap"
        run = Run([*changed, "--layout", "composed", "--record", whole])
        self.assertIn(run.status, (0, 3), run.err)
        content = whole.read_bytes()
        for name in ("composed", "cyclonedds"):
            # Before the change, and behind it.
            for tear in (first_chunk(content) + 2000, len(content) - 1):
                with self.subTest(layout=name, tear=tear):
                    self.clear()
                    self.cut_off.write_bytes(content[:tear])
                    resumed = Run(["run", "--resume", self.path, "--json", *LAYOUTS[name]])

                    self.assertEqual(resumed.status, run.status, resumed.err)
                    self.assertEqual(resumed.report["hash"], run.report["hash"])
                    self.assertEqual(self.path.read_bytes(), content)

    def test_the_name_that_it_would_have_had_is_enough(self):
        whole = self.whole["none"]
        self.cut_off.write_bytes(whole[:len(whole) // 2])

        self.assert_goes_on(self.path, LAYOUTS["composed"], whole)

    def test_a_run_that_was_interrupted_goes_on(self):
        whole = self.whole["none"]
        for layout in (LAYOUTS["composed"], LAYOUTS["cyclonedds"]):
            process = start([*RUN, "--pace", "100x", "--record", self.path, "--force", *layout],
                            start_new_session=True)
            self.assertTrue(wait_until(lambda: self.cut_off.exists() and
                                       self.cut_off.stat().st_size > len(whole) // 4))
            os.kill(process.pid, signal.SIGINT)
            process.communicate(timeout=20)
            self.assertEqual(process.returncode, 130)

            self.assert_goes_on(self.path, LAYOUTS["fastdds"], whole)

    def test_components_that_die_after_it_went_on_lose_nothing(self):
        whole = self.whole["none"]
        self.path.write_bytes(whole[:len(whole) // 3])
        process = start(["run", "--resume", self.path, "--pace", "100x"], start_new_session=True)
        self.assertTrue(wait_until(lambda: len(components_of(process.pid)) == 5 and
                                   self.cut_off.exists() and
                                   self.cut_off.stat().st_size > len(whole) // 2))

        os.kill(components_of(process.pid)["control"], signal.SIGKILL)
        _, err = process.communicate(timeout=60)

        self.assertEqual(process.returncode, self.status, err)
        self.assertIn("restarting it", err)
        self.assertEqual(self.path.read_bytes(), whole)

    def test_a_copy_can_go_on_instead(self):
        whole = self.whole["zstd"]
        torn = self.directory / "evidence.mcap"
        torn.write_bytes(whole[:len(whole) // 2])

        run = Run(["run", "--resume", torn, "--record", self.path, "--layout", "composed"])

        self.assertEqual(run.status, self.status, run.err)
        self.assertEqual(self.path.read_bytes(), whole)
        self.assertEqual(torn.read_bytes(), whole[:len(whole) // 2])


class Refused(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.path = pathlib.Path(scratch.name) / "r.mcap"
        run = Run(["run", "reactive", "--world", "open-field", "--layout", "composed", "--record",
                   self.path])
        assert run.status == 0, run.err
        self.whole = self.path.read_bytes()

    def refused(self, *arguments):
        before = self.path.read_bytes()
        run = Run(["run", *arguments])
        self.assertEqual(run.status, 2, run.err)
        self.assertEqual(self.path.read_bytes(), before)
        return run.err

    def test_a_whole_recording(self):
        self.assertRegex(self.refused("--resume", self.path),
                         r"r.mcap: is complete: the run ended at tick \d+, nothing is left")

    def test_what_the_recording_decides(self):
        self.path.write_bytes(self.whole[:-100])
        for arguments in (["--world", "u-trap"], ["--robot", "disc-015"], ["--seed", "2"],
                          ["--set", "sense.range_m=1"], ["--with", "control.behaviour=stop"],
                          ["--max-ticks", "9"], ["--compression", "lz4"]):
            self.assertIn(f"leave out {arguments[0]}",
                          self.refused("--resume", self.path, *arguments))
        self.assertIn("leave out a graph", self.refused("reactive", "--resume", self.path))
        self.assertIn("real time", self.refused("--resume", self.path, "--pace", "realtime"))
        self.assertIn("did you mean 'sense'?",
                      self.refused("--resume", self.path, "--middleware", "sens=fastdds"))

    def test_what_is_no_recording_or_does_not_describe_its_run(self):
        self.path.write_bytes(b"nothing")
        self.assertIn("is too short to be an MCAP file", self.refused("--resume", self.path))
        self.path.write_bytes(self.whole[:2000])
        self.assertIn("r.mcap", self.refused("--resume", self.path))
        self.assertIn("No such file", self.refused("--resume", "/nowhere.mcap"))

    def test_two_files_of_which_either_could_be_meant(self):
        self.path.write_bytes(self.whole[:-100])
        other = self.path.with_suffix(".mcap.tmp~")
        shutil.copy(self.path, other)

        self.assertIn("which one", self.refused("--resume", self.path))
        self.assertIn("would be overwritten", self.refused("--resume", other))

    def test_a_component_of_someone_else(self):
        graph = write_file("world: open-field\nrobot: disc-015\nsense: {behaviour: cones}\n"
                           f"control: {{exec: [{THIRD_PARTY}/straight_control, "
                           "--without-guidance]}\ndrive: {behaviour: turn_then_step}\n")
        self.assertEqual(Run(["run", graph, "--record", self.path, "--force"]).status, 0)
        self.path.write_bytes(self.path.read_bytes()[:-100])

        self.assertIn("control has exec", self.refused("--resume", self.path))

    def test_neither_a_graph_nor_a_recording(self):
        self.assertIn("which graph", Run(["run"]).err)


if __name__ == "__main__":
    unittest.main()
