# SPDX-License-Identifier: Apache-2.0
"""What commands tell of recordings, worlds and runs: events, echo, world, lists, notes."""
import csv
import io
import json
import pathlib
import tempfile
import unittest

from clew_command import SOURCE, Run, run_graph, write_file

COMPOSED = ["--layout", "composed"]
DRIFT = ["--set", "drive.drift_rad_per_sqrt_m=0.03"]


class Told(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.scratch = tempfile.TemporaryDirectory()
        cls.folder = pathlib.Path(cls.scratch.name)
        cls.recording = cls.folder / "trap.mcap"
        cls.report = run_graph("krishna_kalra", "--world", "u-trap", *COMPOSED, "--record",
                               cls.recording)
        cls.reactive = cls.folder / "reactive.mcap"
        run_graph("reactive", "--world", "u-trap", *COMPOSED, "--max-ticks", 300, "--record",
                  cls.reactive)

    @classmethod
    def tearDownClass(cls):
        cls.scratch.cleanup()

    def lines(self, *arguments):
        run = Run(arguments)
        self.assertEqual(run.status, 0, run.err)
        return [json.loads(line) for line in run.out.splitlines()]

    def refused(self, arguments, *texts):
        run = Run(arguments)
        self.assertEqual(run.status, 2, run.err)
        for text in texts:
            self.assertIn(text, run.err)


class Events(Told):
    def test_a_line_an_event_with_the_earlier_visit_that_proves_a_trap(self):
        events = self.lines("events", self.recording, "--json")

        traps = [event for event in events if event["kind"] == "trap"]
        self.assertEqual(len(traps), self.report["traps_detected"])
        self.assertEqual(list(traps[0]), ["tick", "time_s", "stage", "kind", "rule", "x_m", "y_m",
                                          "text", "shadow", "earlier"])
        self.assertEqual((traps[0]["stage"], traps[0]["rule"], traps[0]["shadow"]),
                         ("recover", "landmark_revisit", False))
        self.assertLess(traps[0]["earlier"]["tick"], traps[0]["tick"])
        self.assertAlmostEqual(traps[0]["time_s"], 0.3 * traps[0]["tick"])
        begun = [event for event in events if event["kind"] == "escape_begun"]
        self.assertIsNone(begun[0]["earlier"])

    def test_people_read_the_same(self):
        run = Run(["events", self.recording])

        self.assertEqual(run.status, 0)
        self.assertRegex(run.out, r"tick +\d+ +[\d.]+ s  trap +landmark_revisit .*, as at tick \d+")

    def test_a_graph_without_recover_tells_none(self):
        run = Run(["events", self.reactive, "--json"])

        self.assertEqual((run.status, run.out), (0, ""))
        self.assertIn("no recover", run.err)


class Explain(Told):
    def test_an_object_a_stage_that_agrees_with_the_recording(self):
        trap = next(event for event in self.lines("events", self.recording, "--json")
                    if event["kind"] == "trap")

        told = self.lines("explain", self.recording, "--tick", trap["tick"], "--json")

        self.assertEqual([each["stage"] for each in told],
                         ["drive", "sense", "classify", "recover", "control"])
        self.assertEqual(list(told[0])[:5], ["stage", "behaviour", "tick", "text", "inside"])
        by_stage = {each["stage"]: each for each in told}
        recover = by_stage["recover"]
        self.assertEqual(recover["behaviour"], "landmark_revisit, obstacle_following, remembered_map")
        self.assertIn("it says trap: " + trap["text"], recover["text"])
        self.assertEqual(recover["inside"]["escape"]["name"], "obstacle_following")
        self.assertEqual(by_stage["classify"]["inside"]["classifier"]["som"]["distances_classes"]
                         ["rows"], 7)
        readings = self.lines("echo", self.recording, "scan", "--jsonl")[trap["tick"]]["ranges_m"]
        self.assertEqual(by_stage["sense"]["inside"]["readings_m"], readings)

    def test_people_read_a_paragraph_a_stage(self):
        run = Run(["explain", self.recording, "--tick", 0])

        self.assertEqual(run.status, 0, run.err)
        self.assertRegex(run.out, r"(?m)^drive \(turn_then_step\): The robot stands at its start\.")
        self.assertEqual(run.out.count("\n\n"), 4)
        self.assertLessEqual(max(map(len, run.out.splitlines())), 88)

    def test_one_component_alone(self):
        told = self.lines("explain", self.recording, "--tick", 7, "--component", "control",
                          "--json")

        command = self.lines("echo", self.recording, "command", "--jsonl")[7]
        self.assertEqual([each["stage"] for each in told], ["control"])
        inside = told[0]["inside"]
        self.assertEqual(inside["decided"], "controller")
        modules = (inside["controller"]["target_module"], inside["controller"]["obstacle_module"])
        turn = -sum(module[weight] * module["turn_clockwise_rad"]
                    for module, weight in zip(modules, ("strength_w1", "strength_w2")))
        if not inside["step_guard"]["changed_the_motion"]:
            self.assertAlmostEqual(turn, command["motion"]["turn_rad"])

    def test_bad_questions_are_refused(self):
        self.refused(["explain", self.recording, "--tick", 100000],
                     f"has no tick 100000; its last one is {self.report['ticks']}")
        self.refused(["explain", self.recording, "--tick", 5, "--component", "contro"], "control")
        self.refused(["explain", self.recording, "--tick", -1], "--tick")
        self.refused(["explain", self.recording], "--tick")
        self.refused(["explain", self.folder / "none.mcap", "--tick", 1], "none.mcap")

    def test_a_cut_recording_is_explained_as_far_as_it_goes(self):
        cut = self.folder / "cut.mcap"
        whole = pathlib.Path(self.recording).read_bytes()
        cut.write_bytes(whole[:len(whole) // 2])

        self.assertIn("The robot stands at its start.", Run(["explain", cut, "--tick", 0]).out)
        self.refused(["explain", cut, "--tick", self.report["ticks"]], "has no tick")


class Echo(Told):
    def test_a_line_a_sample_with_all_fields(self):
        states = self.lines("echo", self.recording, "state", "--jsonl")

        self.assertEqual([state["tick"] for state in states],
                         list(range(self.report["ticks"] + 1)))
        self.assertEqual(list(states[0])[:2], ["tick", "sequence"])
        self.assertEqual(states[-1]["path_length_m"], self.report["path_length_m"])
        self.assertEqual(states[7]["stamp"]["tick"], 7)
        scan = self.lines("echo", self.recording, "scan", "--jsonl", "--to", 0)[0]
        self.assertEqual(len(scan["ranges_m"]), 7)
        event = self.lines("echo", self.recording, "event", "--jsonl", "--to", 0)[0]
        self.assertIsInstance(event["entries"], list)

    def test_chosen_fields_and_ticks(self):
        chosen = self.lines("echo", self.recording, "/scan", "--jsonl", "--field", "ranges_m[3]",
                            "--field", "ranges_m", "--from", 5, "--to", 8)

        self.assertEqual([line["tick"] for line in chosen], [5, 6, 7, 8])
        self.assertEqual(list(chosen[0]), ["tick", "sequence", "ranges_m[3]", "ranges_m"])
        for line in chosen:
            self.assertEqual(line["ranges_m[3]"], line["ranges_m"][3])

    def test_a_table(self):
        run = Run(["echo", self.recording, "event", "--csv"])
        rows = list(csv.DictReader(io.StringIO(run.out)))

        self.assertEqual(run.status, 0, run.err)
        self.assertEqual(len(rows), self.report["ticks"] + 1)
        said = [row for row in rows if "TRAP" in row["entries[0].kind"]]
        self.assertEqual(said[0]["entries[0].rule"], "landmark_revisit")
        self.assertEqual(rows[0]["sequence"], "0")

    def test_what_is_not_there_is_refused_with_the_nearest(self):
        self.refused(["echo", self.recording, "stat"], "did you mean 'state'?")
        self.refused(["echo", self.recording, "state", "--field", "path_lenght_m"],
                     "unknown field of state 'path_lenght_m' (did you mean 'path_length_m'?)")
        self.refused(["echo", self.recording, "state", "--from", 9, "--to", 3], "from 9 to 3")
        self.refused(["echo", self.recording, "state", "--csv", "--jsonl"], "leave out one")


class World(Told):
    def test_solves_what_a_world_does_not_say(self):
        text = (SOURCE / "configs/worlds/u-trap.yaml").read_text(encoding="utf-8")
        bare = write_file("\n".join(line for line in text.splitlines()
                                    if not line.startswith(("solvable", "shortest_path"))) + "\n")
        solved = self.folder / "solved.yaml"

        [found] = self.lines("world", "solve", bare, "--json", "-o", solved)

        self.assertIs(found["solvable"], True)
        self.assertAlmostEqual(found["shortest_path_m"], 9.519, delta=0.1)
        self.assertEqual(len(found["traps"]), 1)
        self.assertGreater(found["traps"][0]["depth_m"], 1.0)
        self.assertEqual(set(found["traps"][0]), {"x_m", "y_m", "depth_m"})
        written = solved.read_text()
        self.assertIn("solvable: true\n", written)
        self.assertRegex(written, r"shortest_path: 9\.[45]")
        self.assertEqual(Run(["world", "check", solved]).status, 0)

    def test_an_unsolvable_world_has_no_path(self):
        [found] = self.lines("world", "solve", "unsolvable-box", "--json")

        self.assertEqual((found["solvable"], found["shortest_path_m"]), (False, None))
        self.assertIn(None, [trap["depth_m"] for trap in found["traps"]])

    def test_says_why_a_world_with_a_way_has_no_shortest_path(self):
        # The target lies on the wall's skin: within its radius there is room for the robot.
        near = write_file("format: clew-world/1\nname: near\nbounds: [0, 0, 9, 9]\n"
                          "walls: [[8, 1, 8, 8]]\nstart: [1, 5, 0]\ntarget: [7.9, 5]\n"
                          "target_radius: 0.2\n")

        told = Run(["world", "solve", near]).out

        self.assertIn("solvable: true\nshortest path: unknown, none ends on the target itself, only "
                      "within its radius\n", told)

    def test_says_of_what_moves_when_the_answer_holds(self):
        closes = write_file("format: clew-world/1\nname: closes\nbounds: [0, 0, 9, 9]\n"
                            "moving: [{circle: [5, 8, 0.3], path: [[0, 5, 8], [40, 8, 5]]}]\n"
                            "start: [1, 5, 0]\ntarget: [8, 5]\ntarget_radius: 0.2\n")
        comes = write_file("format: clew-world/1\nname: comes\nbounds: [0, 0, 9, 9]\n"
                           "moving: [{circle: [1, 8, 0.3], path: [[0, 1, 8], [40, 1, 5]]}]\n"
                           "start: [1, 5, 0]\ntarget: [8, 5]\ntarget_radius: 0.2\n")

        self.assertIn("solvable: false, once all has come to rest, after 40.0 s\n",
                      Run(["world", "solve", closes]).out)
        self.assertIn("solvable: unknown, what moves comes to rest on the start\n",
                      Run(["world", "solve", comes]).out)

    def test_a_world_that_is_too_large_is_left_undecided_at_once(self):
        huge = write_file("format: clew-world/1\nname: huge\nbounds: [0, 0, 1000, 1000]\n"
                          "start: [1, 1, 0]\ntarget: [999, 999]\ntarget_radius: 0.2\n")
        why = ("it has 400 million places 0.05 m apart, more than the 50 million that are looked "
               "at")

        [found] = self.lines("world", "solve", huge, "--json")

        self.assertEqual((found["solvable"], found["shortest_path_m"], found["undecided"]),
                         (None, None, why))
        self.assertIn("solvable: unknown, " + why, Run(["world", "check", huge]).out)
        self.assertEqual(Run(["world", "severity", huge]).out.splitlines()[1], why)
        self.refused(["world", "solve", huge, "-o", self.folder / "huge.yaml"],
                     "is not decided: " + why)

    def test_a_world_that_says_what_is_not_so_is_told(self):
        text = (SOURCE / "configs/worlds/unsolvable-box.yaml").read_text(encoding="utf-8")
        wrong = write_file(text.replace("solvable: false", "solvable: true"))

        run = Run(["world", "check", wrong, "--json"])

        self.assertEqual(run.status, 1)
        self.assertIn("it says solvable: true, and it is false", run.err)
        self.assertEqual(Run(["world", "check", "unsolvable-box"]).status, 0)

    def test_draws_a_world_as_every_kind_of_picture(self):
        for ending, beginning in (("svg", b"<svg"), ("png", b"\x89PNG"), ("pdf", b"%PDF")):
            picture = self.folder / f"world.{ending}"
            run = Run(["world", "picture", "double-u", "-o", picture])
            self.assertEqual(run.status, 0, run.err)
            self.assertIn(beginning, picture.read_bytes()[:200])
        self.refused(["world", "picture", "double-u", "-o", "x.gif"], "allowed: .svg, .png, .pdf")

    def test_draws_a_run_as_every_kind_of_picture(self):
        for ending, beginning in (("svg", b"<svg"), ("png", b"\x89PNG"), ("pdf", b"%PDF")):
            picture = self.folder / f"run.{ending}"
            run = Run(["plot", self.recording, self.reactive, "-o", picture])
            self.assertEqual(run.status, 0, run.err)
            self.assertIn(beginning, picture.read_bytes()[:200])

    def test_bad_worlds_are_refused(self):
        self.refused(["world", "solve", "u-trpa"], "did you mean 'u-trap'?")
        self.refused(["world", "solve", "u-trap", "--robot", "disc-15"], "unknown robot")
        self.refused(["world"], "--help")


class Words(Told):
    def test_lists_have_every_folder(self):
        for what, name in (("suites", "smoke"), ("robots", "disc-015"), ("maps", "office"),
                           ("rulebases", "pin_bender_fba"), ("training", "krishna_kalra_som")):
            run = Run(["list", what])
            self.assertEqual(run.status, 0, run.err)
            self.assertRegex(run.out, rf"(?m)^{name}\b")

    def test_an_unknown_world_is_answered_in_a_line_that_can_be_read(self):
        run = Run(["run", "reactive", "--world", "nowhere-at-all"])

        self.assertEqual(run.status, 2)
        self.assertIn("'clew list worlds' tells all", run.err)
        self.assertIn("CLEW_PATH", run.err)
        self.assertLess(len(run.err), 400)

    def test_a_recording_in_a_graphs_place_is_called_one(self):
        self.refused(["run", self.recording], "is a recording", "clew replay")
        self.refused(["check", "reactive", "--world", self.recording], "is a recording")

    def test_options_have_no_place_in_a_file(self):
        for option, text in (
                ("recover.rise=1", "--set recover.rise: unknown parameter of recover 'rise' (did "
                                   "you mean 'recover.detector.rise_m'?)"),
                ("sense.range_m=far", "--set sense.range_m: range_m: found 'far'"),
                ("control.process.middleware=none", "--set control.process.middleware: ")):
            self.refused(["check", "default", "--set", option], text)
        self.assertEqual(Run(["check", "default", "--set",
                              "control.process.middleware=fastdds"]).status, 0)

    def test_programs_that_are_missing_are_told_with_their_place(self):
        graph = write_file("world: open-field\nrobot: disc-015\nsense: {behaviour: cones}\n"
                           "control: {exec: [./no_such_control]}\n"
                           "drive: {behaviour: turn_then_step}\n")
        self.refused(["run", graph], f"{graph}:4:", "there is no program './no_such_control'")
        for word in ("./", "''"):
            path = write_file(graph.read_text().replace("./no_such_control", word))
            self.refused(["run", path], f"{path}:4:", "there is no program ")
        script = write_file("#!/usr/bin/no-such-interpreter -x\n", ".sh")
        script.chmod(0o755)
        path = write_file(graph.read_text().replace("./no_such_control", str(script)))
        self.refused(["run", path], f"{path}:4:", f"'{script}' names in its first line "
                     "'/usr/bin/no-such-interpreter', which is no program")
        self.refused(["run", "default", "--prefix", "control=no-such-debugger --args"],
                     "--prefix: there is no program 'no-such-debugger' (looked for in PATH)")
        drive = write_file("world: open-field\nrobot: disc-015\nsense: {behaviour: cones}\n"
                           "control: {behaviour: krishna_kalra_fuzzy}\ndrive: {exec: [./d]}\n")
        self.refused(["check", drive], f"{drive}:5:", "drive has exec", "whose tick and limits it has")

    def test_a_robot_that_stands_still_is_told_since_when_and_why(self):
        arguments = ["krishna_kalra", "--with", "recover.detector=none", "--with",
                     "control=nearest_virtual_target", "--world", "office", *COMPOSED,
                     "--max-ticks", 3000]

        report = run_graph(*arguments)
        shown = Run(["run", *arguments])

        self.assertEqual(report["outcome"], "timeout")
        since = report["still_since"]
        self.assertLess(since["tick"], 2000)
        self.assertAlmostEqual(since["time_s"], 0.3 * since["tick"])
        [note] = report["notes"]
        self.assertRegex(note, rf"has stood on one spot, .*, since tick {since['tick']} .*: "
                         "its controller leads nowhere, and recovery notices no trap")
        self.assertIn(note, shown.err)
        self.assertIsNone(self.report["still_since"])
        self.assertEqual(self.report["notes"], [])

    def test_the_report_names_graph_and_world_and_counts_late_commands(self):
        self.assertEqual((self.report["graph"], self.report["world"]), ("krishna_kalra", "u-trap"))
        self.assertEqual(self.report["late_commands"], 0)
        info = json.loads(Run(["info", self.recording, "--json"]).out)
        self.assertEqual(info["graph"], "krishna_kalra")
        self.assertIn("graph      krishna_kalra", Run(["info", self.recording]).out)

    def test_odometry_that_errs_is_named_where_unreachable_is_said(self):
        report = run_graph("krishna_kalra", "--world", "u-trap", *COMPOSED, *DRIFT)

        said = " ".join(report["notes"])
        self.assertEqual("odometry may be the reason" in said,
                         report["outcome"] == "unreachable", report)

    def test_diff_tells_where_behaviour_parts_though_topics_differ(self):
        run = Run(["diff", self.recording, self.reactive, "--json"])
        found = json.loads(run.out)

        self.assertEqual(run.status, 1)
        self.assertIn("event", found["topics_only_a"])
        self.assertEqual(found["topics_only_b"], [])
        self.assertIn(found["first_difference"]["topic"],
                      ("command", "odometry", "scan", "state", "target"))
        self.assertNotEqual(found["first_difference"]["field"], "(sample)")
        self.assertIn("only a has the topic event", Run(["diff", self.recording,
                                                         self.reactive]).out)

    def test_a_rate_holds_for_all_components_together(self):
        run = Run(["replay", self.reactive, "--to", 100, "--rate", 10, "--json"])
        report = json.loads(run.out)

        # Ticks of 0.3 s at ten times their speed, each component on its own in that time.
        self.assertEqual(run.status, 0, run.err)
        for component in report["components"]:
            self.assertLess(component["ticks_per_s"], 36.0)
            self.assertGreater(component["ticks_per_s"], 20.0)


if __name__ == "__main__":
    unittest.main()
