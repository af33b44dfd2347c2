# SPDX-License-Identifier: Apache-2.0
"""The same graph, world and seed give the same bytes in every layout, on either vendor, in either
build, and under load."""
import concurrent.futures
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

from clew_command import (CLEW, LAYOUTS, OTHER_BUILDS, SOAK, SOURCE, WORLDS, Run, components_of,
                          layouts_of, run_graph, wait_until)

TICKS = "6000" if SOAK else "1500"
REPEATS = 20
# Where nothing is seen, the first step of neural_map takes one to ten seconds.
FAR = """format: clew-world/1
name: far
bounds: [0, 0, 1000, 10]
start: [1, 5, 0]
target: [999, 5]
target_radius: 0.2
"""
PROCESS_LAYOUTS = {name: layout for name, layout in LAYOUTS.items() if name != "composed"}


def all_worlds():
    return sorted(path.stem for path in (SOURCE / "configs/worlds").glob("*.yaml"))


def reports_of(runs):
    """The report of each run_graph(*run), three at a time: most of a short run is waiting until its
    processes have found each other."""
    with concurrent.futures.ThreadPoolExecutor(3) as pool:
        return list(pool.map(lambda run: run_graph(*run), runs))


class Layouts(unittest.TestCase):
    def test_every_layout_gives_the_same_hash(self):
        for world in all_worlds() if SOAK else WORLDS:
            reports = reports_of(("krishna_kalra", "--world", world, "--max-ticks", TICKS, *layout)
                                 for layout in LAYOUTS.values())
            hashes = {name: report["hash"] for name, report in zip(LAYOUTS, reports)}

            self.assertEqual(len(set(hashes.values())), 1, f"{world}: {hashes}")
            self.assertRegex(hashes["composed"], "^[0-9a-f]{32}$")

    def test_a_target_a_kilometre_away_is_no_reason_to_kill_anybody(self):
        with tempfile.TemporaryDirectory() as directory:
            world = pathlib.Path(directory) / "far.yaml"
            world.write_text(FAR, encoding="utf-8")
            for graph in ("default", "any_sensor", "neural_map"):
                with self.subTest(graph=graph):
                    arguments = [graph, "--world", str(world), "--max-ticks", "50"]
                    composed = run_graph(*arguments, "--layout", "composed")
                    processes = run_graph(*arguments)

                    self.assertEqual(processes["hash"], composed["hash"])
                    self.assertEqual(processes["outcome"], "timeout")
                    self.assertEqual(processes["restarts"], 0)

    def test_stacks_that_are_limited_to_little_change_nothing(self):
        # The C library takes the limit for every thread; one of DDS needs more than 128 KiB.
        wanted = run_graph("default", "--max-ticks", "50", "--layout", "composed")["hash"]
        for vendor in ("cyclonedds", "fastdds"):
            with self.subTest(vendor=vendor):
                done = subprocess.run(
                    ["sh", "-c", 'ulimit -S -s 64; exec "$@"', "sh", CLEW, "run", "default", "--json",
                     "--max-ticks", "50", "--middleware", vendor], capture_output=True, text=True,
                    timeout=120, check=False)

                self.assertEqual(done.returncode, 3, done.stderr)
                self.assertEqual(json.loads(done.stdout)["hash"], wanted)

    def test_stacks_that_no_run_fits_in_are_refused(self):
        # It crashed with 64 KiB, as processes and in a bench.
        done = subprocess.run(["sh", "-c", 'ulimit -S -s 64; ulimit -H -s 64; exec "$@"', "sh", CLEW,
                               "run", "default", "--max-ticks", "5"],
                              capture_output=True, text=True, timeout=60, check=False)

        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertEqual(done.stderr, "clew: the hard limit of the stack is 64 KiB; allowed: at least "
                                      "256 KiB ('ulimit -H -s' shows it)\n")

    def test_every_shipped_graph_gives_one_hash_however_often_it_runs(self):
        ticks = ["--max-ticks", "1000" if SOAK else "300"]
        for graph in sorted(path.stem for path in (SOURCE / "configs/graphs").glob("*.yaml")):
            layouts = list(layouts_of(graph).items()) * (100 if SOAK else 1)
            reports = reports_of((graph, *ticks, *layout) for _, layout in layouts)
            hashes = {report["hash"]: (name, report)
                      for (name, _), report in zip(layouts, reports)}

            self.assertEqual(len(hashes), 1, f"{graph}: {hashes}")

    @unittest.skipUnless(OTHER_BUILDS, "tools/soak makes the other builds")
    def test_other_builds_give_the_same_hash(self):
        for world in all_worlds() if SOAK else WORLDS:
            arguments = ["--world", world, "--layout", "composed", "--max-ticks", TICKS]
            release = run_graph("krishna_kalra", *arguments, command=CLEW)

            for build, command in OTHER_BUILDS.items():
                other = run_graph("krishna_kalra", *arguments, command=command)

                self.assertEqual(other["hash"], release["hash"], f"{world}, {build}")

    @unittest.skipUnless(OTHER_BUILDS, "tools/soak makes the other builds")
    def test_other_builds_give_the_same_hash_as_processes(self):
        # The two mixed ones have each stage on either vendor.
        names = PROCESS_LAYOUTS if SOAK else ["mixed", "mixed the other way"]
        for world in WORLDS if SOAK else ["u-trap"]:
            arguments = ["--world", world, "--max-ticks", TICKS]
            release = run_graph("krishna_kalra", *arguments, *LAYOUTS["composed"])

            for build, command in OTHER_BUILDS.items():
                for name in names:
                    other = run_graph("krishna_kalra", *arguments, *LAYOUTS[name], command=command)

                    self.assertEqual(other["hash"], release["hash"], f"{world}, {name}, {build}")

    def test_repeats_under_full_load_give_the_same_hash(self):
        # In tools/soak each layout of processes 20 times in each of the ten worlds; in tools/test 20
        # runs in one world, the layouts in turn.
        load = [subprocess.Popen([sys.executable, "-c", "while True: pass"])
                for _ in range(os.cpu_count())]
        try:
            for world in WORLDS if SOAK else ["u-trap"]:
                arguments = ["krishna_kalra", "--world", world, "--max-ticks", TICKS]
                composed = run_graph(*arguments, *LAYOUTS["composed"])["hash"]

                layouts = list(PROCESS_LAYOUTS.items())
                layouts *= REPEATS if SOAK else REPEATS // len(layouts)
                reports = reports_of((*arguments, *layout) for _, layout in layouts)

                self.assertEqual(len(reports), 4 * REPEATS if SOAK else REPEATS)
                for (name, _), report in zip(layouts, reports):
                    self.assertEqual(report["hash"], composed, f"{world}, {name}")
        finally:
            for process in load:
                process.kill()
                process.wait()

    def test_noise_depends_on_the_seed_alone(self):
        arguments = ["--set", "sense.noise_stddev_m=0.02", "--set", "sense.drop_out_ratio=0.05"]

        first = run_graph("krishna_kalra", *arguments, "--seed", "7", *LAYOUTS["composed"])
        again = run_graph("krishna_kalra", *arguments, "--seed", "7", *LAYOUTS["mixed"])
        other = run_graph("krishna_kalra", *arguments, "--seed", "8", *LAYOUTS["composed"])

        self.assertEqual(again["hash"], first["hash"])
        self.assertNotEqual(other["hash"], first["hash"])

    def test_recordings_are_the_same_file_in_every_layout(self):
        with tempfile.TemporaryDirectory() as directory:
            contents = set()
            for name, layout in LAYOUTS.items():
                path = pathlib.Path(directory) / (name.replace(" ", "-") + ".mcap")
                report = run_graph("krishna_kalra", "--record", path, *layout)
                self.assertEqual(report["recording"], str(path))
                contents.add(path.read_bytes())

            self.assertEqual(len(contents), 1)

    def test_recording_changes_no_hash(self):
        with tempfile.TemporaryDirectory() as directory:
            plain = run_graph("krishna_kalra", "--middleware", "fastdds")
            recorded = run_graph("krishna_kalra", "--middleware", "fastdds", "--record",
                                 pathlib.Path(directory) / "r.mcap")

            self.assertEqual(recorded["hash"], plain["hash"])


class Isolation(unittest.TestCase):
    def test_runs_at_the_same_time_do_not_meet(self):
        alone = {vendor: run_graph("krishna_kalra", "--middleware", vendor)["hash"]
                 for vendor in ("cyclonedds", "fastdds")}
        together = [(vendor, subprocess.Popen([CLEW, "run", "krishna_kalra", "--json", "--middleware",
                                               vendor], stdout=subprocess.PIPE, text=True))
                    for vendor in ("cyclonedds", "fastdds", "cyclonedds", "fastdds")]

        for vendor, process in together:
            out, _ = process.communicate(timeout=60)
            self.assertIn(alone[vendor], out)

    def test_nothing_is_left_in_shared_memory(self):
        before = set(os.listdir("/dev/shm"))

        for vendor in ("cyclonedds", "fastdds"):
            run_graph("krishna_kalra", "--middleware", vendor)

        self.assertEqual(set(os.listdir("/dev/shm")) - before, set())

    def test_a_domain_that_is_held_is_refused(self):
        holder = subprocess.Popen([CLEW, "run", "krishna_kalra", "--world", "unsolvable-box", "--pace", "1x",
                                   "--domain", "42"], stderr=subprocess.DEVNULL,
                                  stdout=subprocess.DEVNULL, start_new_session=True)
        try:
            # Its components come after it has taken the domain.
            self.assertTrue(wait_until(lambda: components_of(holder.pid)))
            refused = Run(["run", "krishna_kalra", "--domain", "42", "--max-ticks", "1"])
            self.assertEqual(refused.status, 2)
            self.assertIn("domain 42 is held by another run", refused.err)
        finally:
            holder.terminate()
            holder.wait(timeout=10)


class Paces(unittest.TestCase):
    def test_a_scaled_run_has_the_same_hash_and_takes_its_time(self):
        free = run_graph("krishna_kalra", "--world", "pillar-on-line")
        for layout in ("composed", "cyclonedds"):
            scaled = run_graph("krishna_kalra", "--world", "pillar-on-line", "--pace", "20x",
                               *LAYOUTS[layout])

            self.assertEqual(scaled["hash"], free["hash"])
            # Tick N begins at N ticks of 0.3 s / 20.
            self.assertGreaterEqual(scaled["wall_s"], scaled["ticks"] * 0.3 / 20.0)


if __name__ == "__main__":
    unittest.main()
