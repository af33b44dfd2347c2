# SPDX-License-Identifier: Apache-2.0
"""A recording is whole, or the run says what is wrong with it; what was written stays readable."""
import os
import pathlib
import resource
import signal
import subprocess
import tempfile
import unittest

from clew_command import (CLEW, LAYOUTS, THIRD_PARTY, Run, components_of, processes_of_session,
                          recorder_of, start, wait_until, write_file)

# 4.5 MB of samples.
RUN = ["run", "krishna_kalra", "--world", "unsolvable-behind-wall", "--with", "recover.detector=none",
       "--max-ticks", "4000", "--json"]
SHORT = [LAYOUTS["composed"], LAYOUTS["cyclonedds"]]


def info(path):
    return Run(["info", path, "--json"]).report


class Scratch(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.directory = pathlib.Path(scratch.name)
        self.path = self.directory / "r.mcap"
        self.cut_off = self.directory / "r.mcap.tmp~"


class FullDisk(Scratch):
    def mount(self, *options):
        """A file system of its own in the scratch directory."""
        done = subprocess.run(["mount", "-t", "tmpfs", *options, "tmpfs", self.directory],
                              capture_output=True, text=True, check=False)
        if done.returncode != 0:
            self.skipTest(f"needs to mount a tmpfs: {done.stderr.strip()}")
        self.addCleanup(subprocess.run, ["umount", self.directory], check=True)

    def assert_prefix_is_readable(self):
        self.assertFalse(self.path.exists())
        found = info(self.cut_off)
        self.assertGreater(found["ticks"], 100)
        self.assertEqual(found["missing_samples"], 0)

    def test_a_full_disk_stops_the_run(self):
        self.mount("-o", "size=1m")
        for layout in SHORT:
            run = Run([*RUN, *layout, "--record", self.path, "--force"])

            self.assertEqual(run.status, 1, run.err)
            self.assertEqual(run.report["outcome"], "aborted")
            self.assertRegex(run.err, "clew: the recording failed: .*r.mcap.tmp~: cannot be written "
                                      "on: No space left on device; the [0-9]+ bytes written before "
                                      "can still be read")
            self.assert_prefix_is_readable()

    def test_a_run_goes_on_without_its_recording_if_told_to(self):
        limit = 1 << 20  # as good as a full disk, and no privilege is needed
        for layout in SHORT:
            whole = Run([*RUN, *layout]).report["hash"]

            done = subprocess.run([CLEW, *RUN, *layout, "--record", self.path, "--force",
                                   "--on-record-error", "continue"], capture_output=True, text=True,
                                  timeout=60, check=False, preexec_fn=lambda: resource.setrlimit(
                                      resource.RLIMIT_FSIZE, (limit, limit)))

            self.assertEqual(done.returncode, 3, done.stderr)
            self.assertIn(whole, done.stdout)
            self.assertIn("the recording failed:", done.stderr)
            self.assertIn("File too large", done.stderr)
            self.assert_prefix_is_readable()

    def test_a_disk_that_is_full_already_is_the_same_in_every_layout(self):
        self.mount("-o", "size=16k")
        (self.directory / "filling").write_bytes(bytes(16 * 1024))
        for layout in SHORT:
            with self.subTest(layout=layout):
                short = ["run", "reactive", "--world", "open-field", *layout, "--record", self.path]
                refused = Run(short)
                goes_on = Run([*short, "--on-record-error", "continue"])

                self.assertEqual(refused.status, 2)
                self.assertIn("No space left on device", refused.err)
                self.assertEqual(goes_on.status, 0, goes_on.err)
                self.assertIn("the run is not recorded: ", goes_on.err)

    def test_a_read_only_place_is_refused_before_anything_runs(self):
        self.mount("-o", "ro")

        run = Run([*RUN, "--record", self.path])

        self.assertEqual(run.status, 2)
        self.assertIn("r.mcap.tmp~: cannot be written: Read-only file system", run.err)


class RemovedFile(Scratch):
    def test_a_file_that_is_removed_stops_the_run(self):
        for layout in SHORT:
            process = start([*RUN, *layout, "--pace", "100x", "--record", self.path, "--force"])
            self.assertTrue(wait_until(lambda: self.cut_off.exists() and
                                       self.cut_off.stat().st_size > 100_000))

            self.cut_off.unlink()
            _, err = process.communicate(timeout=30)

            self.assertEqual(process.returncode, 1, err)
            self.assertIn("r.mcap.tmp~: was removed while it was written", err)


class LostSamples(Scratch):
    def run_that_skips(self, *arguments):
        graph = write_file("world: open-field\nrobot: disc-015\nsense: {behaviour: cones}\n"
                           f"control: {{exec: [{THIRD_PARTY}/straight_control, --without-guidance, "
                           "--skip, '5']}\ndrive: {behaviour: turn_then_step, tick_s: 0.1}\n")
        return Run(["run", graph, "--pace", "realtime", "--max-ticks", "15", "--json", "--record",
                    self.path, "--force", *arguments])

    def test_a_sample_that_nobody_wrote_fails_the_run(self):
        run = self.run_that_skips()

        self.assertEqual(run.status, 1, run.err)
        self.assertIn("clew: the recording lacks 'command' of tick 5\n", run.err)
        self.assertEqual(run.report["lost_samples"], 1)
        self.assertEqual(info(self.path)["missing_samples"], 1)

    def test_it_does_not_if_the_run_shall_go_on(self):
        run = self.run_that_skips("--on-record-error", "continue")

        self.assertEqual(run.status, 3, run.err)
        self.assertIn("clew: the recording lacks 'command' of tick 5\n", run.err)


class DeadSupervisor(Scratch):
    def test_what_was_recorded_is_readable_and_nobody_is_left(self):
        # A chunk lasts two seconds of the wall clock; the open one is written every half.
        run = start([*RUN, "--pace", "0.5x", "--set", "drive.tick_s=0.05", "--record", self.path],
                    start_new_session=True)
        self.assertTrue(wait_until(lambda: recorder_of(run.pid) and len(components_of(run.pid)) == 5))
        self.assertTrue(wait_until(lambda: self.cut_off.stat().st_size > 0 and
                                   info(self.cut_off)["ticks"] > 3))

        os.kill(run.pid, signal.SIGKILL)
        run.communicate(timeout=10)

        self.assertTrue(wait_until(lambda: not processes_of_session(run.pid), 2.0))
        found = info(self.cut_off)
        self.assertGreater(found["ticks"], 3)
        self.assertEqual(found["missing_samples"], 0)


class Compression(Scratch):
    def test_every_compression_gives_the_same_run_in_every_layout(self):
        sizes = {}
        hashes = set()
        for compression in ("none", "zstd", "lz4"):
            contents = set()
            for layout in SHORT:
                run = Run(["run", "krishna_kalra", "--json", *layout, "--record", self.path, "--force",
                           "--compression", compression])
                self.assertEqual(run.status, 0, run.err)
                hashes.add(run.report["hash"])
                contents.add(self.path.read_bytes())
            self.assertEqual(len(contents), 1, compression)
            sizes[compression] = self.path.stat().st_size
            self.assertEqual(info(self.path)["hash"], run.report["hash"])
            replayed = Run(["replay", self.path])
            self.assertEqual(replayed.status, 0, replayed.out)

        self.assertEqual(len(hashes), 1)
        self.assertLess(sizes["zstd"], sizes["lz4"])
        self.assertLess(sizes["lz4"], sizes["none"])

    def test_recordings_of_different_compressions_are_the_same_run(self):
        other = self.directory / "zstd.mcap"
        Run(["run", "krishna_kalra", *LAYOUTS["composed"], "--record", self.path])
        Run(["run", "krishna_kalra", *LAYOUTS["composed"], "--record", other, "--compression", "zstd"])

        diff = Run(["diff", self.path, other])

        self.assertEqual(diff.status, 0, diff.out)

    def test_an_unknown_choice_is_refused_with_the_known_ones(self):
        compression = Run(["run", "krishna_kalra", "--compression", "zst"])
        choice = Run(["run", "krishna_kalra", "--on-record-error", "ignore"])

        self.assertEqual((compression.status, choice.status), (2, 2))
        self.assertIn("--compression", compression.err)
        self.assertIn("zstd", compression.err)
        self.assertIn("continue", choice.err)


if __name__ == "__main__":
    unittest.main()
