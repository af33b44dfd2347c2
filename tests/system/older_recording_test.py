# SPDX-License-Identifier: Apache-2.0
"""A recording whose message types were others: shown and exported by its own schema, not replayed."""
import csv
import json
import pathlib
import tempfile
import unittest

from clew_command import SOURCE, Run

OLDER = SOURCE / "tests" / "golden" / "older" / "default.mcap"
FINGERPRINT = "909fcf761c239b955a230bbbd53100e1"


class OlderRecording(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.directory = pathlib.Path(scratch.name)

    def good(self, *words):
        run = Run(list(words))
        self.assertEqual(run.status, 0, run.err)
        return run.out

    def test_info_holds_its_hash_and_says_that_its_types_are_not_todays(self):
        facts = json.loads(self.good("info", OLDER, "--json"))

        self.assertEqual(facts["idl_fingerprint"], FINGERPRINT)
        self.assertFalse(facts["idl_is_ours"])
        self.assertEqual(facts["hash"], facts["recorded_hash"])

    def test_events_and_echo_tell_what_it_holds(self):
        events = [json.loads(line) for line in self.good("events", OLDER, "--json").splitlines()]
        samples = [json.loads(line) for line in
                   self.good("echo", OLDER, "odometry", "--jsonl").splitlines()]
        guidance = [json.loads(line) for line in
                    self.good("echo", OLDER, "guidance", "--jsonl").splitlines()]

        self.assertIn("trap", {event["kind"] for event in events})
        self.assertEqual([sample["tick"] for sample in samples], list(range(len(samples))))
        self.assertIn("pose_odom_robot", samples[0])
        self.assertNotIn("covariance", samples[0])
        self.assertTrue(any(sample["target_is_virtual"] for sample in guidance))
        self.assertNotIn("target_has_heading", guidance[0])
        refused = Run(["echo", OLDER, "odometry", "--field", "covariance"])
        self.assertEqual(refused.status, 2)

    def test_it_is_drawn_and_exported(self):
        self.good("plot", OLDER, "-o", self.directory / "run.svg")
        self.good("plot", OLDER, "--field", "odometry.pose_odom_robot.x_m", "-o",
                  self.directory / "field.svg")
        self.assertIn("odometry.pose_odom_robot.x_m",
                      (self.directory / "field.svg").read_text(encoding="utf-8"))
        refused = Run(["plot", OLDER, "--field", "odometry.covariance[0]", "-o",
                       self.directory / "none.svg"])
        self.assertEqual(refused.status, 2)
        self.assertIn("unknown number of odometry 'covariance[0]'", refused.err)
        self.good("export", OLDER, "--csv", self.directory / "tables")
        self.good("export", OLDER, "--foxglove", self.directory / "run.mcap")
        self.good("export", OLDER, "--rosbag2", self.directory / "bag")
        self.good("report", OLDER, "-o", self.directory / "run.html")

        self.assertIn("<svg", (self.directory / "run.svg").read_text())
        with open(self.directory / "tables" / "target.csv", encoding="utf-8") as file:
            rows = list(csv.DictReader(file))
        self.assertGreater(float(rows[0]["radius_m"]), 0.0)
        self.assertNotIn("has_heading", rows[0])

    def test_replay_refuses_it_and_names_both_versions(self):
        run = Run(["replay", OLDER])

        self.assertEqual(run.status, 2)
        self.assertIn(FINGERPRINT, run.err)
        self.assertIn("than this version has (IDL ", run.err)


if __name__ == "__main__":
    unittest.main()
