# SPDX-License-Identifier: Apache-2.0
"""What `clew list`, `check`, `plot` and `train` tell programs."""
import json
import os
import pathlib
import shutil
import subprocess
import tempfile
import unittest

from clew_command import CLEW, SOURCE, Run, run_graph, write_file


def lines_of(*arguments):
    run = Run(arguments)
    assert run.status == 0, run.err
    return run.out.splitlines()


class Loading(unittest.TestCase):
    def test_a_command_maps_no_graphics(self):
        # Pictures are a module: each process of a run paid for 18 libraries of them.
        libraries = subprocess.run(["ldd", CLEW], capture_output=True, text=True, timeout=60,
                                   check=True).stdout

        self.assertIn("libc.so", libraries)
        for graphics in ("rsvg", "cairo", "pango", "libX11"):
            self.assertNotIn(graphics, libraries)


class MachineConfigs(unittest.TestCase):
    WORLD = """format: clew-world/1
name: shed
about: "{about}"
bounds: [0, 0, 4, 4]
start: [1, 1, 0]
target: [3, 3]
target_radius: 0.2
"""
    # A namespace of its own, in which /etc is a copy with a folder more.
    SCRIPT = """cp -a /etc/. "$1"/etc 2> /dev/null
mkdir -p "$1"/etc/clew/worlds && cp "$1"/machine.yaml "$1"/etc/clew/worlds/shed.yaml
mount --bind "$1"/etc /etc && shift && exec "$@"
"""

    def test_are_found_in_etc_behind_the_users_own(self):
        with tempfile.TemporaryDirectory(prefix="clew-etc-") as directory:
            folder = pathlib.Path(directory)
            (folder / "etc").mkdir()
            (folder / "machine.yaml").write_text(self.WORLD.format(about="of the machine"))
            own = folder / "own" / "clew" / "worlds"
            own.mkdir(parents=True)

            def about(*, home):
                done = subprocess.run(
                    ["unshare", "--map-root-user", "--mount", "sh", "-c", self.SCRIPT, "sh",
                     directory, CLEW, "list", "worlds", "shed"], capture_output=True, text=True,
                    check=False, env={**os.environ, "XDG_CONFIG_HOME": str(home)})
                self.assertEqual(done.returncode, 0, done.stderr)
                return done.stdout

            self.assertIn("of the machine", about(home=folder / "own"))
            (own / "shed.yaml").write_text(self.WORLD.format(about="of the user"))
            self.assertIn("of the user", about(home=folder / "own"))
            self.assertEqual(Run(["list", "worlds", "shed"]).status, 2)


class ListForPrograms(unittest.TestCase):
    def test_names_and_json_tell_of_the_same(self):
        for what in ("graphs", "worlds", "suites", "robots", "maps", "rulebases", "training",
                     "topics"):
            names = lines_of("list", what, "--names")
            objects = [json.loads(line) for line in lines_of("list", what, "--json")]
            self.assertTrue(names, what)
            key = "topic" if what == "topics" else "name"
            self.assertEqual([each[key] for each in objects], names)

    def test_one_file_is_told_with_its_text(self):
        (line,) = lines_of("list", "robots", "disc-015", "--json")
        told = json.loads(line)
        self.assertIn("radius_m: 0.15", told["text"])
        self.assertTrue(told["file"].endswith("disc-015.yaml"))

    def test_a_stage_is_told_with_ports_behaviours_and_parameters(self):
        (line,) = lines_of("list", "drive", "--json")
        drive = json.loads(line)
        self.assertEqual([(p["topic"], p["direction"], p["delayed"]) for p in drive["ports"]],
                         [("command", "in", True), ("state", "out", False),
                          ("target", "out", False), ("odometry", "out", False)])
        (unicycle,) = [b for b in drive["behaviours"] if b["name"] == "unicycle"]
        speed = {p["name"]: p for p in unicycle["parameters"]}["max_speed_mps"]
        self.assertEqual((speed["default"], speed["unit"], speed["range"]),
                         (0.6096, "m/s", [0.01, 10.0]))
        self.assertEqual(lines_of("list", "drive", "--names"),
                         [b["name"] for b in drive["behaviours"]])
        (one,) = json.loads(lines_of("list", "drive", "unicycle", "--json")[0])["behaviours"]
        self.assertEqual(one, unicycle)

    def test_a_users_own_files_come_after_those_that_clew_path_names(self):
        with tempfile.TemporaryDirectory() as directory:
            for place, about in (("config/clew", "of the user"), ("named", "named")):
                worlds = pathlib.Path(directory) / place / "worlds"
                worlds.mkdir(parents=True)
                shutil.copy(SOURCE / "configs/worlds/open-field.yaml", worlds / "my-hall.yaml")
                with (worlds / "my-hall.yaml").open("a", encoding="utf-8") as file:
                    file.write(f"# {about}\n")

            def text_of_hall(**environment):
                run = Run(["list", "worlds", "my-hall", "--json"], cwd=directory,
                          environment=environment)
                return json.loads(run.out)["text"] if run.status == 0 else run.err

            own = f"{directory}/config"
            self.assertIn("# of the user", text_of_hall(XDG_CONFIG_HOME=own))
            self.assertIn("# named", text_of_hall(XDG_CONFIG_HOME=own,
                                                  CLEW_PATH=f"{directory}/named"))
            # As the XDG Base Directory Specification says of a relative path; and then HOME counts.
            self.assertIn("unknown world 'my-hall'", text_of_hall(XDG_CONFIG_HOME="config",
                                                                  HOME="/nowhere"))
            os.makedirs(f"{directory}/home")
            os.rename(own, f"{directory}/home/.config")
            self.assertIn("# of the user", text_of_hall(XDG_CONFIG_HOME="",
                                                        HOME=f"{directory}/home"))

    def test_topics_name_who_writes_and_reads_them(self):
        topics = {t["topic"]: t for t in map(json.loads, lines_of("list", "topics", "--json"))}
        self.assertEqual(topics["command"]["writers"], ["control"])
        self.assertEqual(topics["command"]["readers"], ["drive"])
        self.assertEqual(topics["scan"]["type"], "clew::msg::Scan")

    def test_what_is_not_there_is_named(self):
        for arguments, words in ((["topics", "scna"], "did you mean 'scan'?"),
                                 (["drive", "unicycl"], "did you mean 'unicycle'?"),
                                 (["drive.behaviuor"], "unknown part of drive"),
                                 (["robts"], "did you mean 'robots'?")):
            run = Run(["list", *arguments, "--json"])
            self.assertEqual(run.status, 2, run.out)
            self.assertIn(words, run.err)

    def test_check_tells_the_wiring(self):
        told = json.loads(lines_of("check", "reactive", "--json")[0])
        self.assertEqual((told["graph"], told["tick_s"], told["radius_m"]), ("reactive", 0.3, 0.15))
        self.assertEqual([s["stage"] for s in told["stages"]], ["drive", "sense", "control"])
        self.assertIn({"topic": "command", "from": "control", "to": "drive", "delayed": True},
                      told["wiring"])

    def test_check_draws_a_graph_that_graphviz_reads(self):
        dot = "\n".join(lines_of("check", "krishna_kalra", "--dot"))
        self.assertIn('"control" -> "drive" [label="command", style=dashed];', dot)
        if shutil.which("dot"):
            svg = subprocess.run(["dot", "-Tsvg"], input=dot, capture_output=True, text=True,
                                 check=True).stdout
            self.assertIn("<svg", svg)

    def test_plot_and_train_tell_what_they_wrote(self):
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            run_graph("reactive", "--world", "open-field", "--layout", "composed", "--record",
                      folder / "a.mcap")
            told = json.loads(lines_of("plot", folder / "a.mcap", "-o", folder / "a.svg",
                                       "--json")[0])
            self.assertEqual(told, {"picture": str(folder / "a.svg"),
                                    "recordings": [str(folder / "a.mcap")], "tick": None})
        for what in ("som", "neuro-fuzzy"):
            refused = Run(["train", what, "--json"])
            self.assertEqual(refused.status, 2)
            self.assertIn("--output", refused.err)

    def test_help_has_every_command_under_a_heading_and_examples_that_run(self):
        text = Run(["--help"]).out
        self.assertNotIn("Subcommands:", text)
        for heading in ("Run:", "Look at recordings:", "Many runs:", "Examples:", "Environment:"):
            self.assertIn("\n" + heading, text)
        with tempfile.TemporaryDirectory() as directory:
            examples = [line.split()[2:] for line in text.splitlines() if line.startswith("  $ ")]
            self.assertEqual(len(examples), 4)
            for words in examples:
                if words[0] == "view":  # serves until it is told to end
                    words = ["info", words[1]]
                done = Run(words, cwd=directory)
                # A branch without a detector ends in the trap: that is a result, too.
                self.assertIn(done.status, (0, 3), f"{words}: {done.err}")

    def test_the_largest_seed_is_taken(self):
        run = Run(["run", "reactive", "--world", "open-field", "--layout", "composed", "--json",
                   "--seed", "9223372036854775807"])

        self.assertEqual(run.status, 0, run.err)
        self.assertEqual(run.report["seed"], 9223372036854775807)

    def test_a_picture_of_what_is_no_recording_is_refused(self):
        run = Run(["plot", write_file("no recording", ".mcap"), "-o", "/tmp/x.svg"])

        self.assertEqual(run.status, 2)
        self.assertIn("file.mcap", run.err)


if __name__ == "__main__":
    unittest.main()
