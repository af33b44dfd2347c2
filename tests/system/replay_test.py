# SPDX-License-Identifier: Apache-2.0
"""Recordings on the command line: what info, diff, replay and branches print, and how they end."""
import pathlib
import re
import shutil
import tempfile
import unittest

from clew_command import (OTHER_BUILDS, SOAK, SOURCE, THIRD_PARTY, Run, run_graph,
                          write_file)

CHANGE = ["--set", "control.guard_turn_deg=20"]  # matters in the comb, from tick 50 on


class Recordings(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.directory = pathlib.Path(tempfile.mkdtemp(prefix="clew-replay-"))
        cls.recording = cls.directory / "a.mcap"
        cls.report = run_graph("reactive", "--world", "comb", "--max-ticks", "150", "--layout",
                               "composed", "--record", cls.recording)
        cls.changed = cls.directory / "b.mcap"
        run_graph("reactive", "--world", "comb", "--max-ticks", "150", "--layout", "composed",
                  "--record", cls.changed, *CHANGE)
        whole = cls.recording.read_bytes()
        cls.torn = cls.directory / "torn.mcap"
        cls.torn.write_bytes(whole[:len(whole) // 2])

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.directory)

    def ran(self, arguments, status):
        run = Run(arguments)
        self.assertEqual(run.status, status, run.out + run.err)
        return run

    def refused(self, arguments, *texts):
        run = self.ran(arguments, 2)
        self.assertEqual(run.out, "")
        for text in texts:
            self.assertIn(text, run.err)


class Info(Recordings):
    def test_tells_what_a_recording_holds(self):
        info = self.ran(["info", self.recording, "--json"], 0).report

        self.assertTrue(info["complete"])
        self.assertIsNone(info["torn"])
        self.assertEqual(info["ticks"], 151)
        self.assertAlmostEqual(info["duration_s"], 45.0)
        self.assertEqual(info["hash"], self.report["hash"])
        self.assertEqual(info["recorded_hash"], self.report["hash"])
        self.assertEqual((info["world"], info["robot"], info["seed"]), ("comb", "disc-015", 1))
        self.assertEqual(info["stages"]["control"], {"behaviour": ["krishna_kalra_fuzzy"], "reaction": []})
        self.assertEqual([topic["topic"] for topic in info["topics"]],
                         ["command", "odometry", "scan", "state", "target"])
        for topic in info["topics"]:
            self.assertEqual((topic["samples"], topic["first_tick"], topic["last_tick"],
                              topic["missing_ticks"]), (151, 0, 150, 0))
        self.assertIn("world.yaml", info["files"])

    def test_tells_it_to_people(self):
        run = self.ran(["info", self.recording], 0)

        for text in ("complete", "0 to 150", f"{self.report['hash']} (as recorded)", "world      comb",
                     "behaviour krishna_kalra_fuzzy", "clew::msg::Odometry"):
            self.assertIn(text, run.out)

    def test_says_that_a_recording_is_torn(self):
        info = self.ran(["info", self.torn, "--json"], 1).report
        text = self.ran(["info", self.torn], 1).out

        self.assertFalse(info["complete"])
        self.assertGreater(info["torn"]["at_byte"], 0)
        self.assertIsNone(info["recorded_hash"])
        self.assertIn("torn at byte", text)

    def test_a_flipped_bit_is_no_recording(self):
        damaged = self.directory / "damaged.mcap"
        content = bytearray(self.recording.read_bytes())
        content[len(content) // 2] ^= 1
        damaged.write_bytes(content)

        self.refused(["info", damaged], "damaged.mcap", "CRC")


class Diff(Recordings):
    def test_of_a_copy_is_identical(self):
        copy = self.directory / "copy.mcap"
        shutil.copy(self.recording, copy)

        diff = self.ran(["diff", self.recording, copy, "--json"], 0).report

        self.assertTrue(diff["identical"])
        self.assertIsNone(diff["first_difference"])
        self.assertEqual(diff["configuration"], [])
        self.assertEqual(diff["topics"]["scan"], {"samples_a": 151, "samples_b": 151, "equal": 151,
                                                  "different": 0, "only_a": 0, "only_b": 0})

    def test_names_the_first_field_and_the_configuration(self):
        diff = self.ran(["diff", self.recording, self.changed, "--json"], 1).report
        text = self.ran(["diff", self.recording, self.changed], 1).out

        first = diff["first_difference"]
        self.assertEqual((first["topic"], first["field"]), ("command", "motion.turn_rad"))
        self.assertAlmostEqual(abs(first["a"]), 0.2617993877991494, places=15)
        self.assertAlmostEqual(abs(first["b"]), 0.3490658503988659, places=15)
        self.assertEqual(diff["configuration"][0]["what"], "graph.yaml")
        self.assertIn("guard_turn_deg: 20", diff["configuration"][0]["b"])
        self.assertIn(f"tick {first['tick']}, command", text)
        self.assertTrue(text.endswith("different\n"))

    def test_takes_a_tolerance_on_request(self):
        wide = self.ran(["diff", self.recording, self.changed, "--json", "--tolerance", "1e9"], 0)

        self.assertTrue(wide.report["identical"])
        self.refused(["diff", self.recording, self.changed, "--tolerance", "-1"], "--tolerance")

    def test_with_a_torn_one_goes_up_to_the_tear(self):
        run = self.ran(["diff", self.recording, self.torn, "--json"], 1)

        self.assertEqual(run.report["first_difference"]["field"], "(sample)")
        self.assertIsNone(run.report["first_difference"]["b"])
        self.assertIn("torn.mcap: was cut off", run.err)

    def test_refuses_what_is_no_recording(self):
        self.refused(["diff", self.recording, "no/such.mcap"], "no/such.mcap")
        self.refused(["diff", self.recording, write_file("text")], "file.yaml")
        self.refused(["diff", self.recording], "required")


class Replay(Recordings):
    def test_of_every_component_is_identical(self):
        replay = self.ran(["replay", self.recording, "--json"], 0).report
        text = self.ran(["replay", self.recording], 0).out

        self.assertIsNone(replay["component"])
        self.assertTrue(replay["identical"])
        self.assertEqual([one["component"] for one in replay["components"]],
                         ["drive", "sense", "control"])
        self.assertEqual({one["ticks"] for one in replay["components"]}, {151})
        self.assertIn("sense: 151 ticks identical", text)

    def test_of_one_component(self):
        replay = self.ran(["replay", self.recording, "--component", "control", "--json"], 0).report

        self.assertEqual(replay["component"], "control")
        self.assertEqual(replay["ticks"], 151)
        self.assertTrue(replay["identical"])
        self.assertIsNone(replay["first_difference"])
        self.assertGreater(replay["ticks_per_s"], 0)

    def test_shows_where_a_change_first_matters_with_the_inputs(self):
        arguments = ["replay", self.recording, "--component", "control", *CHANGE]
        replay = self.ran([*arguments, "--json"], 1).report
        text = self.ran(arguments, 1).out
        diff = self.ran(["diff", self.recording, self.changed, "--json"], 1).report

        # Up to there the changed run had the same inputs.
        self.assertEqual(replay["first_difference"], diff["first_difference"])
        self.assertFalse(replay["identical"])
        self.assertEqual(replay["inputs"]["odometry"]["stamp.tick"],
                         replay["first_difference"]["tick"])
        self.assertIn("scan.ranges_m = [", text)
        self.assertIn("motion.turn_rad", text)

    def test_of_a_range(self):
        tick = self.ran(["diff", self.recording, self.changed, "--json"],
                        1).report["first_difference"]["tick"]
        arguments = ["replay", self.recording, "--component", "control", *CHANGE, "--json"]

        before = self.ran([*arguments, "--to", tick - 1], 0).report
        there = self.ran([*arguments, "--from", tick, "--to", tick], 1).report

        self.assertEqual(before["ticks"], tick)
        self.assertEqual(there["ticks"], 1)
        self.refused([*arguments, "--from", 1000], "has no tick from 1000 on; it has 151")
        self.refused([*arguments, "--to", 1000], "has no tick 1000; its last one is 150")
        self.refused([*arguments, "--from", 5, "--to", 4], "no tick is from 5 to 4")

    def test_of_a_torn_recording_goes_up_to_the_tear(self):
        run = self.ran(["replay", self.torn, "--component", "sense", "--json"], 0)

        self.assertTrue(run.report["identical"])
        self.assertLess(run.report["ticks"], 151)
        self.assertIn("torn.mcap: was cut off", run.err)

    def test_feeds_a_controller_the_scans_that_were_recorded_whatever_sense_would_be(self):
        recording = self.directory / "four.mcap"
        self.ran(["run", "wang_yang_meng", "--layout", "composed", "--max-ticks", "20", "--record",
                  recording], 3)

        self.refused(["replay", recording, "--component", "control", "--with", "sense=cones",
                      "--with", "control=krishna_kalra_fuzzy"],
                     "needs seven beams", "'infrared' gives 4")

    def test_says_what_each_option_takes(self):
        for arguments, text in [
                (["--component", "contrl"], "did you mean 'control'?"),
                (["--component", "recover"], "recover"),
                (["--set", "control.guard_trun_deg=20"], "did you mean 'guard_turn_deg'?"),
                (["--set", "control.guard_turn_deg=500"], "allowed: 1 to 90"),
                (["--with", "control=fuzzy"], "krishna_kalra_fuzzy"),
                (["--set", "control.rules=no-such-rules"], "no-such-rules"),
                (["--record", "x.mcap"], "need --branch"),
                (["--max-ticks", "5"], "need --branch"),
                (["--rate", "0"], "--rate"),
                (["--from", "-1"], "--from"),
                (["--branch", "10", "--to", "20"], "leave out --from and --to")]:
            with self.subTest(arguments=arguments):
                self.refused(["replay", self.recording, *arguments], text)

    def test_of_a_run_over_dds(self):
        recording = self.directory / "processes.mcap"
        run_graph("krishna_kalra", "--max-ticks", "150", "--record", recording)

        self.assertTrue(self.ran(["replay", recording, "--json"], 0).report["identical"])

    def test_leaves_components_of_someone_else_out(self):
        graph = write_file("world: open-field\nrobot: disc-015\nsense: {behaviour: cones}\n"
                           f"control: {{exec: [{THIRD_PARTY}/straight_control, "
                           "--without-guidance]}\ndrive: {behaviour: turn_then_step}\n")
        recording = self.directory / "theirs.mcap"
        run_graph(graph, "--record", recording)

        run = self.ran(["replay", recording, "--json"], 0)

        self.assertEqual([one["component"] for one in run.report["components"]],
                         ["drive", "sense"])
        self.assertIn("control is a third-party component", run.err)
        self.refused(["replay", recording, "--component", "control"], "third-party")
        self.refused(["replay", recording, "--branch", "5"],
                     "control has exec, and no recording has its state; allowed: one that is "
                     "'restart: stateless'")


@unittest.skipUnless(OTHER_BUILDS, "tools/soak makes the other builds")
class Builds(unittest.TestCase):
    """A recording of the Release build is what every other build does."""

    def test_replay_every_behaviour_identically(self):
        behaviours = registered_behaviours()
        graphs = [path.stem for path in sorted((SOURCE / "configs/graphs").glob("*.yaml"))]
        self.assertGreaterEqual(len(behaviours), 10)
        with tempfile.TemporaryDirectory() as directory:
            for choice in behaviours:
                with self.subTest(behaviour=choice):
                    recording = pathlib.Path(directory) / f"{choice}.mcap"
                    fitting = next(graph for graph in graphs if recorded(graph, choice, recording))
                    for command in OTHER_BUILDS.values():
                        replay = Run(["replay", recording, "--json"], command=command)

                        self.assertEqual(replay.status, 0, fitting + replay.err + replay.out)
                        self.assertTrue(replay.report["identical"])


def registered_behaviours():
    """All that `clew list` knows, as --with takes them: `recover.detector=none`."""
    listed = "".join(Run(["list", stage]).out
                     for stage in ("drive", "sense", "classify", "recover", "plan", "control"))
    return [f"{part}={name}" for part, name in re.findall(r"^  (\w+\.\w+) (\w+): ", listed, re.M)]


def recorded(graph, choice, recording):
    """Whether a graph runs with a behaviour, and is recorded."""
    run = Run(["run", graph, "--layout", "composed", "--max-ticks", "150", "--with", choice,
               "--record", recording])
    return run.status != 2


class Branch(Recordings):
    def test_without_a_change_is_the_same_recording(self):
        branch = self.directory / "same.mcap"

        run = self.ran(["replay", self.recording, "--branch", "70", "--record", branch, "--json"],
                       3)

        self.assertEqual(run.report["branch_tick"], 70)
        self.assertEqual(run.report["hash"], self.report["hash"])
        self.assertEqual(run.report["recording"], str(branch))
        self.assertEqual(branch.read_bytes(), self.recording.read_bytes())

    def test_with_a_change_keeps_the_past_and_goes_on_from_there(self):
        branch = self.directory / "branch.mcap"
        arguments = ["replay", self.recording, "--branch", "70", "--max-ticks", "120",
                     "--set", "drive.safety=false", "--set", "control.guard_turn_deg=40"]

        run = self.ran([*arguments, "--record", branch], 3)
        diff = self.ran(["diff", self.recording, branch, "--json"], 1).report
        info = self.ran(["info", branch, "--json"], 0).report
        replay = self.ran(["replay", branch, "--json"], 0)

        self.assertIn("timeout in comb: 120 ticks", run.out)
        self.assertGreaterEqual(diff["first_difference"]["tick"], 70)
        self.assertEqual(info["branch_tick"], 70)
        self.assertEqual(replay.report["ticks"], 51)
        self.assertIn("branched at tick 70", replay.err)
        self.refused([*arguments, "--record", branch], "branch.mcap")
        self.ran([*arguments, "--record", branch, "--force"], 3)

    def test_refuses_a_tick_that_the_run_does_not_have(self):
        left = self.directory / "left.mcap"

        self.refused(["replay", self.recording, "--branch", "151", "--record", left],
                     "the run ended at tick 150")
        self.refused(["replay", self.recording, "--branch", "9999", "--record", left],
                     "has 151 ticks")
        self.assertEqual(list(self.directory.glob("left*")), [])


if __name__ == "__main__":
    unittest.main()
