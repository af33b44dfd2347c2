# SPDX-License-Identifier: Apache-2.0
"""What commands tell beside their results: on standard error, and in files."""
import os
import pathlib
import re
import signal
import tempfile
import unittest

from clew_command import Run, components_of, start, wait_until

RUN = ["run", "krishna_kalra", "--world", "open-field", "--json"]
LINE = re.compile(r"\d{4}-\d\d-\d\dT\d\d:\d\d:\d\d\.\d{3}Z (debug|info|warning|error) clew.*\[\d+\]: .+")


class Log(unittest.TestCase):
    def setUp(self):
        directory = tempfile.TemporaryDirectory(prefix="clew-log-")
        self.addCleanup(directory.cleanup)
        self.directory = pathlib.Path(directory.name)

    def test_every_process_of_a_run_has_a_file(self):
        logs = self.directory / "logs"
        quiet = Run([*RUN, "--record", self.directory / "a.mcap"])
        told = Run([*RUN, "-v", "--log-dir", logs, "--record", self.directory / "b.mcap"])

        self.assertEqual(told.status, 0, told.err)
        self.assertEqual(told.report["hash"], quiet.report["hash"])
        files = {path.name: path.read_text() for path in logs.iterdir()}
        who = {re.sub(r"-\d{8}T\d{6}Z-\d+\.log$", "", name) for name in files}
        self.assertEqual(who, {"clew-run", "clew-recorder",
                               *(f"clew-component-{stage}" for stage in
                                 ("sense", "classify", "recover", "control", "drive"))})
        for name, text in files.items():
            for line in text.splitlines():
                self.assertRegex(line, LINE, name)
        sense = next(text for name, text in files.items() if "sense" in name)
        self.assertIn("debug clew component sense[", sense)
        self.assertIn("takes part in run ", sense)
        self.assertIn("has ended with the run", sense)

    def test_results_are_on_standard_output_alone(self):
        for options, level in ((["-q"], None), ([], "off"), (["-v"], None)):
            done = Run([*RUN, "--layout", "composed", *options],
                       environment={"CLEW_LOG_LEVEL": level} if level else None)

            self.assertEqual(done.status, 0, done.err)
            self.assertEqual(len(done.out.splitlines()), 1)
            self.assertEqual(done.report["outcome"], "reached")

    def test_notes_are_told_unless_the_command_is_to_be_quiet(self):
        box = ["run", "krishna_kalra", "--world", "open-field", "--layout", "composed",
               "--record-on", "trap", "--record"]
        note = "nothing happened that the black box writes for"

        self.assertIn(f"clew: {note}", Run([*box, self.directory / "a.mcap"]).err)
        self.assertEqual(Run([*box, self.directory / "b.mcap", "-q"]).err, "")
        timed = Run([*box, self.directory / "c.mcap", "-v"]).err
        self.assertRegex(timed, r"(?m)^\d\d:\d\d:\d\d\.\d{3} info clew: " + note)
        log = self.directory / "d.log"
        self.assertEqual(Run([*box, self.directory / "d.mcap", "-q", "--log", log]).err, "")
        self.assertRegex(log.read_text(), LINE)
        self.assertIn(note, log.read_text())

    def test_a_seed_that_changes_nothing_is_told(self):
        run = [*RUN[:-1], "--layout", "composed"]
        note = "seed 7 gives the run of every seed"
        hashes = set()
        for seed in ("7", "8"):
            done = Run([*run, "--seed", seed, "--json"])
            hashes.add(done.report["hash"])
            self.assertTrue(any(f"seed {seed} gives" in text for text in done.report["notes"]))
        self.assertEqual(len(hashes), 1)
        self.assertIn(note, Run([*run, "--seed", "7"]).err)
        self.assertNotIn("every seed", Run(run).err)
        for chance in ("sense.noise_stddev_m=0.01", "drive.drift_rad_per_sqrt_m=0.01",
                       "drive.slip_m_per_sqrt_m=0.01"):
            self.assertNotIn("every seed", Run([*run, "--seed", "7", "--set", chance]).err)
        self.assertIn(note, Run([*run, "--seed", "7", "--set", "drive.slip_m_per_m=0.1"]).err)

    def test_lines_of_the_supervisor_have_the_level_that_they_ask_for(self):
        log = self.directory / "run.log"
        run = start([*RUN, "--pace", "1x", "--external", "recover", "--log", log],
                    start_new_session=True)
        self.assertTrue(wait_until(lambda: log.exists() and "start it with" in log.read_text()))
        domain = re.search(r"--domain (\d+)", log.read_text()).group(1)
        other = start(["component", "krishna_kalra", "recover", "--domain", domain])
        self.assertTrue(wait_until(lambda: "sense" in components_of(run.pid)))
        os.kill(components_of(run.pid)["sense"], signal.SIGKILL)
        self.assertTrue(wait_until(lambda: "restarting it" in log.read_text()))
        run.send_signal(signal.SIGINT)
        run.wait(30)
        other.wait(30)

        levels = {what: re.search(rf"Z (\w+) clew.*{what}", log.read_text()).group(1)
                  for what in ("start it with", "restarting it")}
        self.assertEqual(levels, {"start it with": "info", "restarting it": "warning"})

    def test_errors_of_the_user_keep_their_form_and_are_never_hidden(self):
        plain = Run(["run", "no-such-graph"])
        log = self.directory / "a.log"
        quiet = Run(["run", "no-such-graph", "-qq", "--log", log])

        self.assertEqual((plain.status, quiet.status), (2, 2))
        self.assertTrue(plain.err.startswith("clew: "), plain.err)
        self.assertEqual(quiet.err, plain.err)
        self.assertIn("error clew[", log.read_text())

    def test_bad_settings_are_refused(self):
        for options, environment, what in (
                (["--log-dir", ""], {}, "clew: --log-dir: found '', expected a directory\n"),
                (["--log", ""], {}, "clew: --log: found '', expected a file\n"),
                (["--log", "a", "--log-dir", "b"], {}, "one of them is allowed"),
                (["-v", "-q"], {}, "one of them is allowed"),
                (["--log", str(self.directory)], {}, "Is a directory"),
                (["--log-dir", "/dev/null/logs"], {}, "cannot be made to log into"),
                ([], {"CLEW_LOG_LEVEL": "loud"}, "CLEW_LOG_LEVEL: unknown level 'loud'"),
                ([], {"CLEW_LOG_DIR": "/dev/null/logs"}, "cannot be made to log into")):
            refused = Run([*RUN, *options], environment=environment)

            self.assertEqual(refused.status, 2, refused.err)
            self.assertIn(what, refused.err)
            self.assertEqual(refused.out, "")


if __name__ == "__main__":
    unittest.main()
