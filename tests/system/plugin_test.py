# SPDX-License-Identifier: Apache-2.0
"""Plug-ins of somebody else, built against an installation: used everywhere, and refused safely."""
import json
import re
import unittest

from clew_command import SOAK, SOURCE
from installed import Installation, call

STAGNATION = ["--with", "recover.detector=stagnation"]


class PluginTest(unittest.TestCase):
    """All tests use the same installation and the same three plug-ins."""

    @classmethod
    def setUpClass(cls):
        cls.installation = Installation()
        cls.clew = staticmethod(cls.installation.clew)
        cls.work = cls.installation.work
        cls.built = cls.installation.build(SOURCE / "tests/third_party/plugins", "plugins")
        cls.stagnation = cls.built / "libstagnation.so"

    @classmethod
    def tearDownClass(cls):
        cls.installation.close()

    def test_a_detector_takes_less_than_80_lines(self):
        text = (SOURCE / "tests/third_party/plugins/stagnation.cpp").read_text(encoding="utf-8")

        self.assertLess(len(text.splitlines()), 80)

    def test_they_keep_the_rules_that_ours_keep(self):
        for name in ["stagnation", "random_walk", "potential_field"]:
            done = self.clew("check-plugin", self.built / f"lib{name}.so", "--json")
            checks = [json.loads(line) for line in done.out.splitlines()]

            self.assertEqual([check for check in checks if not check["ok"]], [])
            self.assertEqual(done.status, 0, done.err)
            self.assertGreaterEqual(len(checks), 6)

    def test_one_is_listed_with_its_parameters(self):
        done = self.clew("list", "recover.detector", "stagnation", "--plugin", self.stagnation)

        self.assertIn("stagnation (plug-in stagnation)", done.out)
        self.assertIn("progress_m = 0.5 m (0.01 to 100)", done.out)

    def test_names_are_found_along_the_path_and_explained_where_not(self):
        found = self.clew("list", "recover.detector", "stagnation", "--plugin", "stagnation",
                          environment={"CLEW_PATH": str(self.built)})
        missing = self.clew("list", "recover", "--plugin", "stagnation")

        self.assertEqual(found.status, 0, found.err)
        self.assertEqual(missing.status, 2)
        self.assertIn("there is no plug-in 'stagnation'", missing.err)
        self.assertIn("CLEW_PATH", missing.err)

    def run_stagnation(self, *arguments):
        """A run with the detector in command; returns the report."""
        done = self.clew("run", "krishna_kalra", "--plugin", self.stagnation, *STAGNATION, "--json",
                         *arguments)
        self.assertEqual(done.status, 0, done.err)
        return done.report

    def test_a_run_is_the_same_in_one_process_and_in_several(self):
        composed = self.run_stagnation("--layout", "composed")
        processes = self.run_stagnation()

        self.assertGreaterEqual(composed["traps_detected"], 1)
        self.assertEqual(processes["hash"], composed["hash"])

    def test_a_graph_may_name_it(self):
        graph = self.work / "named.yaml"
        text = (self.installation.prefix / "share/clew/graphs/krishna_kalra.yaml").read_text(
            encoding="utf-8")
        ours = "detector: {landmark_revisit: {still_s: 15}}"
        self.assertIn(ours, text)
        graph.write_text(text.replace(ours, "detector: stagnation") + "plugins: [stagnation]\n",
                         encoding="utf-8")
        path = {"CLEW_PATH": str(self.built)}
        named = self.clew("run", graph, "--layout", "composed", "--json", environment=path)
        unknown = self.clew("run", graph, "--layout", "composed")

        self.assertEqual(named.status, 0, named.err)
        self.assertEqual(named.report["hash"], self.run_stagnation("--layout", "composed")["hash"])
        self.assertEqual(unknown.status, 2)
        self.assertRegex(unknown.err, r"named\.yaml:\d+:\d+: there is no plug-in 'stagnation'")

    def test_a_recording_names_it_and_loads_nothing_by_itself(self):
        recording = self.work / "a.mcap"
        self.run_stagnation("--layout", "composed", "--record", recording, "--force")
        path = {"CLEW_PATH": str(self.built)}
        without = self.clew("replay", recording, environment=path)
        replayed = self.clew("replay", recording, "--plugin", self.stagnation, "--json")
        branched = self.clew("replay", recording, "--plugin", self.stagnation, "--branch", 50,
                             "--set", "recover.detector.allowance_s=60", "--json")

        self.assertEqual(without.status, 2)
        self.assertIn("needs the plug-in 'stagnation' (digest ", without.err)
        self.assertIn("--plugin stagnation", without.err)
        self.assertTrue(replayed.report["identical"], replayed.err)
        self.assertEqual(replayed.err, "")
        self.assertIn(branched.status, [0, 3, 5], branched.err)
        self.assertEqual(branched.report["layout"], "composed")

    def test_another_digest_is_told(self):
        recording = self.work / "b.mcap"
        self.run_stagnation("--layout", "composed", "--record", recording, "--force")
        other = self.work / "other.so"
        other.write_bytes(self.stagnation.read_bytes() + b"\0")
        done = self.clew("replay", recording, "--plugin", other)

        self.assertEqual(done.status, 0, done.err)
        self.assertRegex(done.err, r"plug-in 'stagnation' .* has digest [0-9a-f]{32}; recorded with")

    def test_a_bench_compares_it_with_ours(self):
        suite = self.work / "suite.yaml"
        suite.write_text("format: clew-suite/1\nabout: one world\ngraphs: [krishna_kalra]\n"
                         "seeds: [1]\nworlds:\n  traps: [u-trap]\n", encoding="utf-8")
        done = self.clew("bench", suite, "--plugin", self.stagnation, "--vary",
                         "recover.detector=stagnation,landmark_revisit", "--json", "--force")

        self.assertEqual(done.status, 0, done.err)
        self.assertEqual(len(done.out.splitlines()), 2)

    def test_what_does_not_fit_is_refused_before_any_of_its_code_runs(self):
        early = self.work / "early.so"
        ran = self.work / "ran"
        call("cc", "-shared", "-fPIC", "-o", early,
             SOURCE / "tests/third_party/plugins/early.c")
        note = self.work / "note"
        call("objcopy", "--dump-section", f".note.clew={note}", self.stagnation, "/dev/null")
        bytes_of_note = note.read_bytes()
        fingerprint = re.search(rb"[0-9a-f]{32}", bytes_of_note).group()
        cases = {
            "headers of another clew": bytes_of_note.replace(fingerprint, b"0" * 32),
            "of interface 7": bytes_of_note[:20] + b"\x07\0\0\0" + bytes_of_note[24:],
            "lay out types": bytes_of_note[:-4] + b"\x63\0\0\0"}
        for message, changed in cases.items():
            text = ", ".join(str(byte) for byte in changed)
            source = self.work / "early.c"
            source.write_text((SOURCE / "tests/third_party/plugins/early.c").read_text("utf-8") +
                              '__attribute__((section(".note.clew"), used, aligned(4)))'
                              f"static const unsigned char kNote[] = {{{text}}};\n", "utf-8")
            call("cc", "-shared", "-fPIC", "-o", early, source)
            done = self.clew("list", "--plugin", early, environment={"CLEW_EARLY_FILE": str(ran)})

            self.assertEqual(done.status, 2, message)
            self.assertIn(message, done.err)
            self.assertFalse(ran.exists(), message)
        # The library itself does what it is there for.
        call("python3", "-c", f"import ctypes; ctypes.CDLL('{early}')",
             environment={"CLEW_EARLY_FILE": str(ran)})
        self.assertTrue(ran.exists())

    def test_what_is_no_plugin_is_refused(self):
        whole = self.stagnation.read_bytes()
        cases = {"is no shared library": b"plain text",
                 "is cut off": whole[:len(whole) // 2]}
        for message, content in cases.items():
            broken = self.work / "broken.so"
            broken.write_bytes(content)
            done = self.clew("list", "--plugin", broken)

            self.assertEqual(done.status, 2)
            self.assertIn(message, done.err)
        done = self.clew("list", "--plugin", "./no-such.so")
        self.assertEqual(done.status, 2)
        self.assertIn("No such file", done.err)

    def test_a_new_project_builds_passes_its_tests_and_runs(self):
        kinds = ["detector", "escape", "controller", "classifier", "sensor", "drive"]
        for kind in kinds if SOAK else ["sensor", "classifier"]:
            name = f"my_{kind}"
            made = self.clew("new", kind, name)
            self.assertEqual(made.status, 0, made.err)
            built = self.installation.build(self.work / name, name)
            call("ctest", "--test-dir", built, "--output-on-failure")
            done = self.clew("run", f"{name}/graph.yaml", "--plugin", built / f"lib{name}.so")

            self.assertEqual(done.status, 0, done.err)
            again = self.clew("new", kind, name)
            self.assertEqual(again.status, 2)
            self.assertIn("is there already", again.err)

    def test_new_refuses_kinds_and_names_that_are_none(self):
        for arguments, message in [(["detectr", "a"], "did you mean 'detector'"),
                                   (["drive", "My-Drive"], "all small"),
                                   (["escape", "test"], "CMake keeps for itself")]:
            done = self.clew("new", *arguments)

            self.assertEqual(done.status, 2)
            self.assertIn(message, done.err)


if __name__ == "__main__":
    unittest.main()
