# SPDX-License-Identifier: Apache-2.0
"""Pipes, devices and pictures from other systems in a file's place: answered at once."""
import os
import pathlib
import resource
import subprocess
import tempfile
import unittest

from clew_command import CLEW, SOURCE, Run, run_graph

LONGEST_S = 10  # of a command that only has to say no


class OddFiles(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = pathlib.Path(scratch.name)
        self.pipe = self.folder / "pipe"
        os.mkfifo(self.pipe)

    def refused(self, arguments, *texts):
        run = Run(arguments, timeout_s=LONGEST_S)
        self.assertEqual(run.status, 2, run.err)
        for text in texts:
            self.assertIn(text, run.err)

    def test_a_pipe_or_a_device_is_no_recording(self):
        for path in (self.pipe, "/dev/zero", "/dev/null", self.folder):
            for arguments in (["info", path], ["replay", path], ["diff", path, path],
                              ["plot", path, "-o", self.folder / "x.svg"],
                              ["run", "--resume", path],
                              ["replay", path, "--publish", "scan"],
                              ["train", "neuro-fuzzy", "--recording", path]):
                with self.subTest(arguments=arguments):
                    self.refused(arguments, f"{path}: is no regular file")

    def test_a_long_comment_takes_no_time(self):
        world = self.folder / "world.yaml"
        shipped = (SOURCE / "configs/worlds/u-trap.yaml").read_text(encoding="utf-8")
        world.write_text("#" + 10_000_000 * "x" + "\n" + shipped, encoding="utf-8")

        # Of the processor's time, so that a busy machine makes no difference.
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        run = Run(["world", "check", world])
        after = resource.getrusage(resource.RUSAGE_CHILDREN)

        self.assertEqual(run.status, 0, run.err)
        self.assertLess(after.ru_utime - before.ru_utime, 3.0)

    def test_few_open_files_are_an_error_and_no_crash(self):
        for files in (6, 8, 10, 12):
            with self.subTest(files=files):
                done = subprocess.run(
                    [CLEW, "run", "reactive", "--max-ticks", "5"], capture_output=True, text=True,
                    check=False, timeout=60, preexec_fn=lambda files=files: resource.setrlimit(
                        resource.RLIMIT_NOFILE, (files, files)))

                self.assertIn(done.returncode, (1, 2, 3), done.stderr)
                self.assertNotIn("signal 11", done.stderr)

    def test_a_file_that_cannot_be_written_whole_stays_what_it_was(self):
        recording, picture = self.folder / "r.mcap", self.folder / "r.png"
        self.assertEqual(Run(["run", "reactive", "--layout", "composed", "--world", "open-field",
                              "--record", recording]).status, 0)
        self.assertEqual(Run(["plot", recording, "-o", picture]).status, 0)
        whole, rights = picture.read_bytes(), 0o640
        picture.chmod(rights)

        for name in ("r.png", "new.png"):
            done = subprocess.run([CLEW, "plot", recording, "-o", self.folder / name],
                                  capture_output=True, text=True, check=False, timeout=60,
                                  preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE,
                                                                        (4096, 4096)))
            self.assertEqual(done.returncode, 2)
            self.assertIn(f"{name}: cannot be written: File too large", done.stderr)

        self.assertEqual(picture.read_bytes(), whole)
        self.assertEqual(sorted(os.listdir(self.folder)), ["pipe", "r.mcap", "r.png"])
        self.assertEqual(Run(["plot", recording, "-o", picture]).status, 0)
        self.assertEqual((picture.read_bytes(), picture.stat().st_mode & 0o777), (whole, rights))

    def test_a_picture_is_written_through_a_link(self):
        (self.folder / "link.svg").symlink_to(self.folder / "there.svg")

        self.assertEqual(Run(["world", "picture", "u-trap", "-o", self.folder / "link.svg"]).status, 0)

        self.assertTrue((self.folder / "link.svg").is_symlink())
        self.assertIn("<svg", (self.folder / "there.svg").read_text(encoding="utf-8"))

    def test_nothing_is_recorded_into_a_pipe(self):
        for layout in ("composed", "processes"):
            self.refused(["run", "reactive", "--layout", layout, "--record", self.pipe],
                         f"{self.pipe}: is a pipe, a socket or a disk")
            self.refused(["run", "reactive", "--layout", layout, "--record", self.pipe, "--force"],
                         f"{self.pipe}: is a pipe, a socket or a disk")

    def test_a_pipe_under_the_temporary_name_holds_nobody_up(self):
        os.mkfifo(self.folder / "r.mcap.tmp~")

        self.refused(["run", "reactive", "--record", self.folder / "r.mcap", "--force"],
                     "r.mcap.tmp~: cannot be written")

    def test_a_pipe_is_no_configuration(self):
        for arguments in (["run", self.pipe], ["check", "reactive", "--world", self.pipe],
                          ["check", "reactive", "--robot", self.pipe], ["bench", self.pipe],
                          ["train", "som", "--recipe", self.pipe]):
            with self.subTest(arguments=arguments):
                self.refused(arguments, f"{self.pipe}: cannot be read: it is no regular file")

    def test_a_map_whose_head_ends_lines_with_cr_and_lf_is_the_same_map(self):
        head = (SOURCE / "configs/maps/office.yaml").read_text(encoding="utf-8")
        picture = (SOURCE / "configs/maps/office.pgm").read_bytes()
        kind, size, white, data = picture.split(b"\n", 3)
        (self.folder / "crlf.yaml").write_text(head.replace("office.pgm", "crlf.pgm"))
        (self.folder / "crlf.pgm").write_bytes(b"\r\n".join((kind, size, white, data)))

        arguments = ["neural_map", "--world", "office", "--layout", "composed", "--set",
                     "plan.map=file", "--set"]
        plain = run_graph(*arguments, "plan.map_file=office")
        crlf = run_graph(*arguments, f"plan.map_file={self.folder}/crlf.yaml")

        for key in ("outcome", "ticks", "path_length_m", "hash"):
            self.assertEqual(plain[key], crlf[key])

    def test_a_map_of_another_place_is_refused_before_the_start(self):
        self.refused(["run", "neural_map", "--world", "office", "--set", "plan.map=file", "--set",
                      f"plan.map_file={self.elsewhere()}"],
                     "the map covers x from 100 to 116 m", "the start is at")

    def elsewhere(self):
        """The office's map, a hundred metres away."""
        head = (SOURCE / "configs/maps/office.yaml").read_text(encoding="utf-8").splitlines()
        moved = ["origin: [100, 0, 0]" if line.startswith("origin") else line for line in head]
        (self.folder / "moved.yaml").write_text("\n".join(moved) + "\n")
        (self.folder / "office.pgm").write_bytes(
            (SOURCE / "configs/maps/office.pgm").read_bytes())
        return self.folder / "moved.yaml"


if __name__ == "__main__":
    unittest.main()
