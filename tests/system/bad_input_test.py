# SPDX-License-Identifier: Apache-2.0
"""Bad input is answered: what was found, where, and what is allowed; with the right status."""
import os
import pathlib
import random
import subprocess
import tempfile
import unittest

from clew_command import CLEW, SOURCE, Run, write_file

GRAPH = """world: open-field
robot: disc-015
sense: {behaviour: cones}
control: {behaviour: krishna_kalra_fuzzy}
drive: {behaviour: turn_then_step}
"""

WORLD = """format: clew-world/1
name: made-up
bounds: [0, 0, 10, 10]
start: [1, 1, 0]
target: [9, 9]
target_radius: 0.2
"""


class BadInput(unittest.TestCase):
    def refused(self, run, *texts, status=2):
        """Asserts status and message; and that nothing pretends to be a result."""
        self.assertEqual(run.status, status, run.err)
        for text in texts:
            self.assertIn(text, run.err)
        self.assertNotIn("outcome", run.out)

    def refused_graph(self, text, *texts):
        path = write_file(text)
        self.refused(Run(["check", path]), *texts)
        self.refused(Run(["run", path, "--json"]), *texts)

    def refused_world(self, text, *texts):
        self.refused(Run(["run", "reactive", "--json", "--world", write_file(text)]), *texts)


class Graphs(BadInput):
    def test_missing_file(self):
        self.refused(Run(["run", "no/such.yaml"]), "no/such.yaml", "No such file or directory")

    def test_unknown_graph_with_the_nearest(self):
        self.refused(Run(["run", "defualt"]), "unknown graph 'defualt'", "did you mean 'default'?")

    def test_a_file_that_is_there_and_was_named_like_a_shipped_one_is_pointed_at(self):
        with tempfile.TemporaryDirectory() as directory:
            (pathlib.Path(directory) / "mine.yaml").write_text(GRAPH)
            (pathlib.Path(directory) / "run.mcap").write_bytes(b"")

            self.refused(Run(["run", "mine"], cwd=directory), "unknown graph 'mine'",
                         "'mine.yaml' is a file here: a path has a slash or ends in .yaml")
            self.refused(Run(["world", "check", "run.mcap"], cwd=directory),
                         "'run.mcap' is a file here: 'clew info', 'clew replay' and 'clew view' read")

    def test_a_file_of_another_kind_is_called_by_its_format(self):
        self.refused(Run(["check", write_file(WORLD)]), "file.yaml:1:9: found a file of the format "
                     "'clew-world/1', expected a graph, which has none")
        self.refused(Run(["run", "reactive", "--robot", write_file(WORLD)]),
                     "file.yaml:1:9: found 'clew-world/1', expected clew-robot/1")
        self.refused(Run(["bench", SOURCE / "configs/graphs/default.yaml"]),
                     "missing key 'format', expected clew-suite/")

    def test_a_directory_is_no_graph(self):
        self.refused(Run(["run", "./configs"], cwd=None), "cannot be read")

    def test_broken_yaml(self):
        self.refused_graph(GRAPH + "recover: {detector: [", "file.yaml:6")

    def test_unknown_key_with_the_nearest(self):
        self.refused_graph(GRAPH.replace("robot:", "robto:"), "file.yaml:2:1: unknown key 'robto'",
                           "did you mean 'robot'?")

    def test_unknown_parameter_with_the_nearest(self):
        self.refused_graph(GRAPH.replace("cones}", "cones, rnage_m: 2}"), "file.yaml:3",
                           "'rnage_m'", "did you mean 'range_m'?")

    def test_duplicate_key(self):
        self.refused_graph(GRAPH + "world: u-trap\n", "file.yaml:6", "world")

    def test_missing_key(self):
        self.refused_graph(GRAPH.replace("world: open-field\n", ""), "world")

    def test_wrong_type(self):
        self.refused_graph(GRAPH.replace("cones}", "cones, range_m: far}"), "file.yaml:3",
                           "range_m", "'far'", "number")

    def test_value_out_of_range_names_what_is_allowed(self):
        self.refused_graph(GRAPH.replace("cones}", "cones, range_m: -1}"), "range_m is -1",
                           "allowed:")

    def test_not_a_number(self):
        self.refused_graph(GRAPH.replace("cones}", "cones, range_m: .nan}"), "range_m", ".nan")

    def test_unknown_behaviour_lists_the_known_ones(self):
        self.refused_graph(GRAPH.replace("cones}", "cone}"), "'cone'", "cones")

    def test_required_input_without_a_writer(self):
        self.refused_graph(GRAPH.replace("sense: {behaviour: cones}\n", ""),
                           "control needs 'scan'", "no stage of this graph writes it")

    def test_a_detector_without_the_landmarks_that_it_needs(self):
        self.refused_graph(
            GRAPH + "recover: {detector: landmark_revisit, escape: [obstacle_following]}\n",
            "recover.detector 'landmark_revisit' needs 'landmark'")

    def test_what_a_graph_names_and_is_not_there(self):
        for old, new, text in (
                ("open-field", "opne-field",
                 "file.yaml:1:8: unknown world 'opne-field' (did you mean 'open-field'?)"),
                ("open-field", "./no-world",
                 f"file.yaml:1:8: world: ./no-world: cannot be read: No such file or directory (a "
                 f"path from the working directory, {os.getcwd()})"),
                ("disc-015", "disc-1",
                 "file.yaml:2:8: unknown robot 'disc-1'"),
                ("_fuzzy}", "_fuzzy, rules: no-rules}",
                 "file.yaml:4:50: unknown rule base 'no-rules'"),
                ("_fuzzy}", "_fuzzy, rules: krishna_kalra_som}",
                 "file.yaml:4:50: rules: ")):
            with self.subTest(text=text):
                self.refused_graph(GRAPH.replace(old, new), text)

    def test_parts_that_do_not_fit_say_where_and_what_both_sides_are(self):
        self.refused_graph(GRAPH.replace("cones}", "laser}"),
                           "file.yaml:4:10: control: krishna_kalra_fuzzy needs seven beams", "'laser'")

    def test_empty_file(self):
        self.refused_graph("", "file.yaml")


class Options(BadInput):
    def test_each_option_says_what_it_takes(self):
        for arguments, text in [
                (["--pace", "fast"], "lockstep, realtime"),
                (["--pace", "0x"], "allowed"),
                (["--pace", "nanx"], "allowed"),
                (["--layout", "threads"], "processes, composed"),
                (["--middleware", "opendds"], "cyclonedds, fastdds"),
                (["--middleware", "sense=opendds"], "cyclonedds, fastdds"),
                (["--middleware", "sens=fastdds"], "did you mean 'sense'?"),
                (["--domain", "100"], "0 to 99"),
                (["--external", "contrl"], "did you mean 'control'?"),
                (["--prefix", "control"], "STAGE='command'"),
                (["--profile", "trace.json"], "--profile needs --layout composed"),
                (["--middleware", "fastdds", "--middleware", "cyclonedds"],
                 "--middleware: is given twice"),
                (["--middleware", "sense=fastdds", "--middleware", "sense=cyclonedds"],
                 "--middleware: is given twice for sense"),
                (["--prefix", "sense=nice", "--prefix", "sense=time"], "is given twice for sense"),
                (["--external", "sense", "--external", "sense"], "is given twice for sense"),
                (["--set", "sense.range_m=1", "--set", "sense.range_m=2"],
                 "--set sense.range_m: is given twice"),
                (["--with", "sense=cones", "--with", "sense=laser"],
                 "--with sense: is given twice"),
                (["--record", ""], "the name is empty"),
                (["--name", ""], "--name: the name is empty"),
                (["--record", "a.mcap", "--record", "b.mcap"],
                 "--record: is given more than once; once is allowed"),
                (["--domain", "x"], "--domain: found 'x'; allowed: a number"),
                (["--domain", "1.5"], "--domain: found '1.5'; allowed: a whole number"),
                (["--set", "sense.range_m"], "'='"),
                (["--set", "sense.rnage_m=2"], "did you mean 'range_m'?"),
                (["--set", "sens.range_m=2"], "did you mean 'sense'?"),
                (["--set", "sense.range_m=1e9"], "allowed"),
                (["--with", "control=fuzzy"], "krishna_kalra_fuzzy"),
                (["--with", "recover.detectr=none"], "did you mean 'detector'?"),
                (["--world", "u-trpa"], "did you mean 'u-trap'?"),
                (["--robot", "disc-015x"], "disc-015"),
                (["--layout", "composed", "--external", "sense"], "--layout processes"),
                (["--seed", "x"], "clew: --seed: found 'x'; allowed: a whole number from 0 to "),
                (["--seed", "1.5"], "--seed: found '1.5'; allowed: a whole number"),
                (["--seed", "18446744073709551615"], "a whole number from 0 to 9223372036854775807"),
                (["--record-last", "x"], "clew: --record-last"),
                (["--set", "sense.x=1"], "unknown parameter of sense 'x'; allowed: range_m"),
                (["--max-ticks", "-5"], "--max-ticks"),
                (["--no-such-option"], "--no-such-option")]:
            with self.subTest(arguments=arguments):
                self.refused(Run(["run", "krishna_kalra", "--json", *arguments]), text)

    def test_no_command_takes_a_file_without_a_name(self):
        for command, option in (("replay none.mcap --branch 3", "--record"), ("bench smoke", "--out"),
                                ("plot none.mcap", "--output"), ("train som", "--output"),
                                ("train neuro-fuzzy", "--curves")):
            with self.subTest(command):
                self.refused(Run([*command.split(), option, ""]), "the name is empty")

    def test_what_is_no_number_passes_no_range(self):
        for command, option, allowed in (
                ("run reactive", "--record-last", "0.001 to 86400"),
                ("run reactive", "--realtime-priority", "1 to 99"),
                ("replay none.mcap --publish scan", "--wait", "0.1 to 86400"),
                ("replay none.mcap", "--rate", "0.001 to 1000"),
                ("diff none.mcap none.mcap", "--tolerance", "0 to "),
                ("bench smoke", "--jobs", "1 to 1024")):
            for value in ("nan", "-nan", "inf", "-inf", "1e999", "", "1x"):
                with self.subTest(option=option, value=value):
                    self.refused(Run([*command.split(), f"{option}={value}"]), option,
                                 f"found '{value}'; allowed: {allowed}" if value else option)

    def test_no_number_begins_with_a_zero(self):
        for command, option in (("run reactive", "--seed"), ("run reactive", "--max-ticks"),
                                ("run reactive", "--domain"), ("bench smoke", "--jobs"),
                                ("view none.mcap", "--port"),
                                ("plot none.mcap", "--tick")):
            with self.subTest(option=option):
                self.refused(Run([*command.split(), f"{option}=010"]), option,
                             "found '010'; allowed: ", " without leading zeros")

    def test_no_command_is_told_where_they_are_listed(self):
        self.refused(Run([]), "clew: what shall it do? 'clew --help' lists the commands")
        self.refused(Run(["world"]), "clew: what shall 'world' do? 'clew world --help' lists its commands")

    def test_help_is_a_command_too(self):
        for words in ([], ["run"], ["world", "check"]):
            helped = Run(["help", *words])
            self.assertEqual((helped.status, helped.out), (0, Run([*words, "--help"]).out))
        self.refused(Run(["help", "rnu"]), "unknown command 'rnu' (did you mean 'run'?)")

    def test_no_command_and_an_unknown_one(self):
        self.assertEqual(Run([]).status, 2)
        self.refused(Run(["chekc", "reactive"]), "did you mean 'check'?")
        self.refused(Run(["train", "smo"]), "clew: unknown command 'smo' (did you mean 'som'?)")
        self.refused(Run(["train"]), "clew: what shall 'train' do?")

    def test_an_unknown_option_is_named_before_what_is_missing(self):
        for command, option, nearest in (("plot", "--tikc", "--tick"), ("info", "--jsno", "--json"),
                                         ("bench", "--jbos", "--jobs")):
            self.refused(Run([command, option, "3"]), f"unknown option '{option}'",
                         f"did you mean '{nearest}'?")

    def test_help_and_version(self):
        for arguments in ([], *([command] for command in (
                "run", "bench", "check", "list", "component", "plot", "info", "diff", "replay",
                "train"))):
            for flag in ("--help", "--version"):
                run = Run([*arguments, flag])
                self.assertEqual(run.status, 0, run.err)
                self.assertTrue(run.out)

    def test_a_component_on_a_domain_that_cannot_be(self):
        self.refused(Run(["component", "reactive", "sense", "--domain", "300"]), "0 to 99")
        for text in ("abc", "3x", "", "99999999999"):
            self.refused(Run(["component", "-", "sense"], environment={"CLEW_DOMAIN_ID": text}),
                         f"CLEW_DOMAIN_ID: found '{text}', expected the number of a DDS domain")

    def test_a_component_of_a_stage_that_the_graph_does_not_have(self):
        self.refused(Run(["component", "reactive", "contrl", "--domain", "98"]),
                     "reactive: unknown stage of this graph 'contrl' (did you mean 'control'?); "
                     "allowed: drive, sense, control")

    def test_a_component_without_a_run_says_what_it_waits_for(self):
        with subprocess.Popen([CLEW, "component", "reactive", "control", "--domain", "98"],
                              stderr=subprocess.PIPE, text=True) as component:
            line = component.stderr.readline()
            component.kill()

        self.assertRegex(line, "^clew component control: waiting up to (59|60) s for a run on "
                         "domain 98$")


class Worlds(BadInput):
    def test_start_in_an_obstacle(self):
        self.refused_world(WORLD + "circles: [[1.1, 1, 0.5]]\n", "start", "circle")

    def test_start_too_near_for_the_robot(self):
        self.refused_world(WORLD + "walls: [[1.1, 0, 1.1, 2]]\n", "start", "wall")

    def test_target_outside(self):
        self.refused_world(WORLD.replace("target: [9, 9]", "target: [11, 9]"), "target")

    def test_not_a_number(self):
        self.refused_world(WORLD + "walls: [[.nan, 0, 1, 2]]\n", ".nan")

    def test_self_crossing_polygon(self):
        self.refused_world(WORLD + "polygons: [[[4,4],[6,6],[6,4],[4,6]]]\n", "cross")

    def test_a_map_of_ros_is_pointed_to_the_import(self):
        self.refused_world("image: room.pgm\nresolution: 0.05\n", ".yaml:1:8: is a map of ROS, not a world",
                           "clew world import")

    def test_empty_world(self):
        self.refused_world("", "file.yaml")

    def test_no_bounds_worth_the_name(self):
        self.refused_world(WORLD.replace("[0, 0, 10, 10]", "[0, 0, 0, 10]"), "bounds")

    def test_a_world_of_a_hundred_thousand_segments_is_driven_fast(self):
        numbers = random.Random(1)
        walls = []
        while len(walls) < 100_000:
            x, y = numbers.uniform(0, 300), numbers.uniform(0, 300)
            # A lane of 3 m around the diagonal stays free.
            if abs(x - y) > 3.0 and 0.1 < x < 299.8 and 0.1 < y < 299.8:
                walls.append(f"[{x:.3f},{y:.3f},{x + 0.1:.3f},{y + 0.1:.3f}]")
        world = write_file("format: clew-world/1\nname: huge\nbounds: [0, 0, 300, 300]\n"
                           f"walls: [{','.join(walls)}]\nstart: [1, 1, 0.785]\n"
                           "target: [299, 299]\ntarget_radius: 0.2\n")

        run = Run(["run", "reactive", "--world", world, "--layout", "composed", "--json"])

        self.assertEqual(run.status, 0, run.err)
        # Measured: as fast as in a small world, about 100,000 ticks/s.
        self.assertGreater(run.report["ticks_per_s"], 5_000)

        # Reading it takes each process that knows the world a second or more.
        run = Run(["run", "reactive", "--world", world, "--max-ticks", 20, "--json"])

        self.assertEqual(run.status, 3, run.err)
        self.assertEqual(run.report["restarts"], 0)


if __name__ == "__main__":
    unittest.main()
