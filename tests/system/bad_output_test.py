# SPDX-License-Identifier: Apache-2.0
"""Where a result cannot be put, that is said, and nothing that was there is lost."""
import json
import os
import pathlib
import subprocess
import tempfile
import time
import unittest
from xml.etree import ElementTree

from bad_input_test import BadInput
from clew_command import CLEW, Run


class Output(BadInput):
    def test_unwritable_recording(self):
        for path in ("/no/such/directory/r.mcap", "/proc/r.mcap"):
            self.refused(Run(["run", "reactive", "--record", path]), path)

    def test_what_cannot_be_written_says_why(self):
        self.refused(Run(["train", "som", "-o", "/no/such/directory/som.yaml"]),
                     "/no/such/directory/som.yaml: cannot be written: No such file or directory")

    def test_a_recording_is_not_overwritten_without_force(self):
        with tempfile.TemporaryDirectory() as directory:
            path = pathlib.Path(directory) / "r.mcap"
            path.write_text("precious")

            self.refused(Run(["run", "reactive", "--record", path]), str(path), "exists")
            self.assertEqual(path.read_text(), "precious")
            self.assertEqual(Run(["run", "reactive", "--world", "open-field", "--record", path,
                                  "--force"]).status, 0)

    def test_a_recording_of_the_name_of_a_link_to_nothing_is_refused_before_the_run(self):
        with tempfile.TemporaryDirectory() as directory:
            path = pathlib.Path(directory) / "r.mcap"
            path.symlink_to("/no/such/directory/r.mcap")

            self.refused(Run(["run", "reactive", "--record", path]), str(path),
                         "is a symbolic link to what is not there")
            self.assertEqual(os.listdir(directory), ["r.mcap"])

    def test_a_refused_command_leaves_nothing_in_the_way_of_the_right_one(self):
        with tempfile.TemporaryDirectory() as directory:
            for option, wrong in (("--middleware", "sens=fastdds"), ("--external", "sens"),
                                  ("--prefix", "sens=time"), ("--middleware", "opendds")):
                self.refused(Run(["run", "reactive", "--record", f"{directory}/r.mcap", option,
                                  wrong]), option)
                self.assertEqual(os.listdir(directory), [])

    def test_standard_output_that_takes_nothing(self):
        for arguments in (["list", "worlds"], ["check", "reactive"],
                          ["run", "reactive", "--layout", "composed", "--world", "open-field", "--json"]):
            with open("/dev/full", "wb") as full:
                done = subprocess.run([CLEW, *arguments], stdout=full, stderr=subprocess.PIPE,
                                      text=True, check=False)
            self.assertEqual(done.returncode, 1)
            self.assertIn("standard output: No space left on device", done.stderr)

    @unittest.skipUnless(os.path.isdir("/proc/self/fd"), "looks at a process's files")
    def test_no_file_takes_the_place_of_a_closed_stream(self):
        with tempfile.TemporaryDirectory() as directory:
            recording = pathlib.Path(directory) / "r.mcap"
            run = subprocess.Popen(["sh", "-c", 'exec "$@" <&- >&- 2>&-', "sh", CLEW, "run", "reactive",
                                    "--layout", "composed", "--pace", "realtime", "--record", recording])
            try:
                while not pathlib.Path(f"{recording}.tmp~").exists():
                    self.assertIsNone(run.poll())
                    time.sleep(0.01)
                streams = [os.readlink(f"/proc/{run.pid}/fd/{stream}") for stream in (0, 1, 2)]
            finally:
                run.terminate()
                run.wait(timeout=60)

            self.assertEqual(streams, 3 * ["/dev/null"])
            self.assertEqual(Run(["info", recording]).status, 0)

    def test_a_reader_that_has_gone_is_no_crash(self):
        for arguments in (["list", "worlds"], ["check", "default", "--expand"]):
            reader, writer = os.pipe()
            os.close(reader)
            with open(writer, "wb") as pipe:
                done = subprocess.run([CLEW, *arguments], stdout=pipe, stderr=subprocess.PIPE,
                                      text=True, check=False)

            self.assertEqual((done.returncode, done.stderr), (1, ""))

    def test_names_that_are_no_utf8_give_json_and_svg_all_the_same(self):
        with tempfile.TemporaryDirectory() as directory:
            path = os.fsencode(directory) + b"/caf\xe9.mcap"
            picture = os.path.join(directory, "a.svg")
            ran = subprocess.run([CLEW, "run", "reactive", "--layout", "composed", "--world",
                                  "open-field", "--json", "--record", path], capture_output=True,
                                 check=False)
            told = subprocess.run([CLEW, "info", "--json", path], capture_output=True, check=False)
            drawn = subprocess.run([CLEW, "plot", path, "-o", picture], check=False)

            self.assertEqual((ran.returncode, told.returncode, drawn.returncode), (0, 0, 0))
            self.assertIn("caf\ufffd.mcap", json.loads(ran.stdout)["recording"])
            json.loads(told.stdout)
            ElementTree.parse(picture)


if __name__ == "__main__":
    unittest.main()
