# SPDX-License-Identifier: Apache-2.0
"""Failures that are found, repeated and made small, as a user does it."""
import json
import pathlib
import shlex
import tempfile
import unittest
from xml.etree import ElementTree

from clew_command import CLEW, Run

ARRIVES = "outcome == reached and path_ratio < 3"


class Hunt(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.directory = pathlib.Path(scratch.name)

    def hunt(self, *arguments, out="hunt"):
        return Run(["hunt", "reactive", "--property", ARRIVES, "--family", "u", "--family", "clutter",
                    "--runs", 32, "--max-ticks", 400, "--out", self.directory / out, "--json",
                    *arguments])

    def test_a_failure_is_found_repeated_and_shrunk(self):
        hunt = self.hunt()

        self.assertEqual(hunt.status, 1, hunt.err)
        self.assertEqual(hunt.report["runs"], 32)
        self.assertGreater(hunt.report["failed"], 0)
        case = hunt.report["cases"][0]
        again = Run(["hunt", "--case", case["case"], "--json"])
        self.assertEqual(again.status, 1, again.err)
        self.assertFalse(again.report["holds"])
        self.assertTrue(again.report["as_recorded"])
        self.repeat_by_its_command(case)

        shrunk = Run(["shrink", case["case"], "-o", self.directory / "minimal.yaml", "--json"])

        self.assertEqual(shrunk.status, 0, shrunk.err)
        self.assertTrue(shrunk.report["minimal"])
        self.assertLessEqual(shrunk.report["parts_after"], shrunk.report["parts_before"])
        ElementTree.parse(shrunk.report["picture"])
        self.assertEqual(Run(["hunt", "--case", shrunk.report["case"]]).status, 1)
        run = Run([*shlex.split(shrunk.report["command"])[1:], "--json"])
        self.assertEqual(run.report["hash"], shrunk.report["hash"])
        checked = Run(["world", "check", shrunk.report["world"]])
        self.assertEqual(checked.status, 0, checked.err)

    def repeat_by_its_command(self, case):
        """The first line of a case file is the command that runs it."""
        line = pathlib.Path(case["case"]).read_text().splitlines()[0]
        run = Run([*shlex.split(line.lstrip("# "))[1:], "--json"])
        self.assertEqual(run.report["hash"], case["hash"])
        self.assertEqual(run.report["outcome"], case["outcome"])

    def test_jobs_change_nothing(self):
        one = self.hunt("--jobs", 1, out="one")
        two = self.hunt("--jobs", 2, out="two")

        self.assertEqual((one.status, two.status), (1, 1))
        self.assertEqual((self.directory / "one/runs.jsonl").read_bytes(),
                         (self.directory / "two/runs.jsonl").read_bytes())

    def test_a_property_that_holds_is_no_failure(self):
        done = Run(["hunt", "reactive", "--property", "hit_by == 0", "--world", "open-field",
                    "--keep-start", "--runs", 4, "--out", self.directory / "none", "--json"])

        self.assertEqual(done.status, 0, done.err)
        self.assertEqual((done.report["failed"], done.report["held"]), (0, 4))
        self.assertEqual(done.report["cases"], [])
        for line in (self.directory / "none/runs.jsonl").read_text().splitlines():
            self.assertTrue(json.loads(line)["holds"])

    def test_what_is_there_is_not_lost_by_mistake(self):
        self.hunt(out="there")

        self.assertEqual(self.hunt(out="there").status, 2)
        self.assertEqual(self.hunt("--force", out="there").status, 1)

    def test_a_property_that_holds_is_not_shrunk(self):
        done = Run(["shrink", "u-trap", "--graph", "krishna_kalra", "--property",
                    "outcome == reached", "-o", self.directory / "x.yaml"])

        self.assertEqual(done.status, 1)
        self.assertIn("the property holds there (outcome reached)", done.err)
        self.assertFalse((self.directory / "x.yaml").exists())

    def test_the_setting_that_matters_is_found_in_two_recordings(self):
        changed = ["--with", "recover.detector=none", "--set", "control.guard_margin_m=0.4",
                   "--set", "classify.capacity=64"]
        for name, more in (("a", []), ("b", changed)):
            Run(["run", "krishna_kalra", "--layout", "composed", "--max-ticks", 400, "--record",
                 self.directory / f"{name}.mcap", *more])

        done = Run(["bisect", self.directory / "a.mcap", self.directory / "b.mcap", "--json"])
        same = Run(["bisect", self.directory / "a.mcap", self.directory / "a.mcap", "--json"])
        graphs = Run(["bisect", "krishna_kalra", "reactive", "--max-ticks", 400])

        self.assertEqual(done.status, 0, done.err)
        self.assertEqual(done.report["cause"], ["recover.detector"])
        self.assertEqual((done.report["outcome_a"], done.report["outcome_b"]),
                         ("reached", "timeout"))
        settings = {one["setting"]: one for one in done.report["settings"]}
        self.assertEqual(set(settings),
                         {"recover.detector", "control.guard_margin_m", "classify.capacity"})
        self.assertIsNone(settings["classify.capacity"]["first_difference"])
        self.assertEqual(settings["control.guard_margin_m"]["first_difference"]["tick"], 140)
        self.assertEqual(same.status, 1)
        self.assertEqual(same.report["settings"], [])
        self.assertEqual(graphs.status, 0, graphs.err)

    def record(self):
        recording = self.directory / "a.mcap"
        Run(["run", "krishna_kalra", "--layout", "composed", "--max-ticks", 400, "--record",
             recording])
        return recording

    def test_the_tick_is_found_from_which_on_a_change_is_too_late(self):
        recording = self.record()
        change = ["--with", "recover.detector=none"]

        done = Run(["bisect", recording, "--ticks", *change, "--json"])
        same = Run(["bisect", recording, "--ticks", "--set", "classify.capacity=64", "--json"])

        self.assertEqual(done.status, 0, done.err)
        last = done.report["last_tick"]
        outcomes = {probe["tick"]: probe["outcome"] for probe in done.report["probes"]}
        self.assertEqual((outcomes[0], outcomes[last], outcomes[last + 1]),
                         ("timeout", "timeout", "reached"))
        self.assertEqual(done.report["turns"], 1)
        for tick, outcome in ((last, "timeout"), (last + 1, "reached")):
            branch = Run(["replay", recording, "--branch", tick, *change, "--json"])
            self.assertEqual(branch.report["outcome"], outcome)
        self.assertEqual(same.status, 1, same.err)
        self.assertIsNone(same.report["last_tick"])

    def test_the_component_of_another_version_that_matters_is_found(self):
        recording = self.record()
        # Another version of *recover*: the same command with another word in its guidance.
        own = pathlib.Path(CLEW)
        text = own.read_bytes()
        self.assertIn(b"wall on ", text)
        other = self.directory / "other"
        other.mkdir()
        for library in own.parent.glob("libclew-*.so"):
            (other / library.name).symlink_to(library)
        (other / "clew").write_bytes(text.replace(b"wall on ", b"WALL on "))
        (other / "clew").chmod(0o755)

        done = Run(["bisect", recording, "--other-version", other / "clew", "--json"])
        same = Run(["bisect", recording, "--other-version", own, "--json"])
        none = Run(["bisect", recording, "--other-version", "/bin/true"])

        self.assertEqual(done.status, 0, done.err)
        self.assertEqual(done.report["first"], "recover")
        for stage in done.report["stages"]:
            first = stage["first_difference"]
            if stage["stage"] == "recover":
                # When the escape begins to follow the wall: `clew echo` shows its words.
                self.assertEqual(first, {"tick": 140, "topic": "guidance"})
            else:
                self.assertIsNone(first)
        self.assertFalse(done.report["verdicts_differ"])
        self.assertEqual((same.status, same.report["first"]), (1, None), same.err)
        self.assertEqual(none.status, 2)
        self.assertIn("/bin/true: as the program of every component", none.err)

    def test_bad_input_is_told_with_its_place(self):
        shrink = ["shrink", "u-trap", "-o", self.directory / "x.yaml"]
        bad = self.directory / "bad.case.yaml"
        bad.write_text("format: clew-case/1\nproperty: ticks < 1\ngraph: reactive\nworlds: a\n")
        for arguments, words in (
                (["hunt"], "expected either a graph or --case FILE"),
                (["hunt", "reactive"], "--property: is missing"),
                (["hunt", "reactive", "--property", "outcome == arrived"],
                 "--property:1:12: unknown outcome 'arrived'; allowed: reached, collided"),
                (["hunt", "reactive", "--property", "path_rato < 2"], "did you mean 'path_ratio'?"),
                (["hunt", "reactiv", "--property", "ticks < 9"], "did you mean 'reactive'?"),
                (["hunt", "reactive", "--property", "ticks < 9", "--family", "uu"],
                 "--family: unknown family 'uu'"),
                (["hunt", "reactive", "--property", "ticks < 9", "--worlds", "none"], "none"),
                (["hunt", "reactive", "--property", "ticks < 9", "--set", "sense.range_m=2..1"],
                 "--set sense.range_m: the range 2..1 is empty"),
                (["hunt", "reactive", "--property", "ticks < 9", "--set", "sense.rnge_m=1..2"],
                 "range_m"),
                (["hunt", "reactive", "--property", "ticks < 9", "--runs", "0"], "allowed: 1"),
                (["bisect", "krishna_kalra", "none"], "none"),
                (["bisect", "krishna_kalra"], "b is required"),
                (["bisect", "krishna_kalra", "--ticks"], "--ticks needs the change"),
                (["bisect", "krishna_kalra", "--ticks", "--with", "recover.detector=none"],
                 "krishna_kalra"),
                (["bisect", "a.mcap", "--ticks", "--set", "sense.range_m=1", "--max-ticks", 9],
                 "found another: leave it out"),
                (["bisect", "a.mcap", "b.mcap", "--ticks"], "takes one run; found a second"),
                (["bisect", "a.mcap", "b.mcap", "--set", "sense.range_m=1"], "found no --ticks"),
                (["bisect", "krishna_kalra", "--other-version", "nix"],
                 "nix: is no program that can be started"),
                (["hunt", "--case", bad], "bad.case.yaml:4"),
                ([*shrink, "--property", "ticks < 9"], "--graph: is missing"),
                ([*shrink, "--graph", "reactive"], "--property: is missing"),
                (["shrink", "no-such-world", "--graph", "reactive", "--property", "ticks < 9", "-o",
                  self.directory / "x.yaml"], "no-such-world")):
            done = Run(arguments)
            self.assertEqual(done.status, 2, (arguments, done.err))
            self.assertIn(words, done.err)


if __name__ == "__main__":
    unittest.main()
