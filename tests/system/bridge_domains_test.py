# SPDX-License-Identifier: Apache-2.0
"""clew bridge domains: topics of a run on other domains, by both vendors, without loss or echo."""
import json
import pathlib
import signal
import tempfile
import time
import unittest

from clew_command import Run, free_domains, start, write_file

# The robot wanders before a wall, so the run is as long as its limit says.
RUN = ["krishna_kalra", "--world", "unsolvable-behind-wall", "--with", "recover.detector=none"]
TICKS = 300
SAMPLES = TICKS + 1
# 66 ticks a second: a run's writers keep 512 samples for who is late.
PACE = ["--pace", "20x"]
PATIENCE_S = 60


class Bridge:
    """A bridge that goes on until it is closed."""

    def __init__(self, directory, name, text):
        path = pathlib.Path(directory) / f"{name}.yaml"
        path.write_text(text, encoding="utf-8")
        self.process = start(["bridge", "domains", path, "--status", "0.2", "--json"])
        # It says of each of its domains that it is there.
        self.told = [self.process.stderr.readline() for _ in range(text.count("domain:"))]
        assert all(" is domain " in line for line in self.told), self.told

    def counts(self):
        """The next report: what became of the samples, by the topic's other name."""
        found = {}
        while True:
            line = json.loads(self.process.stdout.readline())
            if "overrun" in line:
                return found
            found[line["as"]] = line

    def wait_for(self, name, key, value):
        """Reports until a count has a value, or too long."""
        deadline = time.monotonic() + PATIENCE_S
        while time.monotonic() < deadline:
            count = self.counts().get(name, {}).get(key)
            if count == value:
                return count
        return count

    def close(self):
        """What it said to people, and its status."""
        self.process.send_signal(signal.SIGINT)
        out, err = self.process.communicate(timeout=PATIENCE_S)
        return out, "".join(self.told) + err, self.process.returncode


class BridgeDomains(unittest.TestCase):
    def bridge(self, directory, name, text):
        bridge = Bridge(directory, name, text)
        self.addCleanup(bridge.process.wait)
        self.addCleanup(bridge.process.kill)
        return bridge

    def test_a_ring_of_two_bridges_loses_nothing_and_echoes_nothing(self):
        run, site, far = free_domains(3)
        with tempfile.TemporaryDirectory() as directory:
            there = self.bridge(directory, "there", f"""format: clew-bridge/1
domains:
  run: {{domain: {run}, middleware: cyclonedds}}
  site: {{domain: {site}, middleware: fastdds}}
topics:
  - {{topic: odometry, from: run, to: site}}
  - {{topic: state, from: run, to: site, as: first/state, where: stamp.tick < 10}}
  - {{topic: scan, from: run, to: site, as: rare/scan, rate_hz: 0.001}}
""")
            back = self.bridge(directory, "back", f"""format: clew-bridge/1
domains:
  site: {{domain: {site}, middleware: cyclonedds}}
  run: {{domain: {run}, middleware: fastdds}}
topics:
  - {{topic: odometry, from: site, to: run}}
""")
            on = self.bridge(directory, "on", f"""format: clew-bridge/1
domains:
  site: {{domain: {site}, middleware: fastdds}}
  far: {{domain: {far}, middleware: cyclonedds}}
topics:
  - {{topic: "*", from: site, to: far, as: far/*}}
""")
            done = Run(["run", *RUN, *PACE, "--max-ticks", TICKS, "--domain", run, "--middleware",
                        "drive=fastdds", "--json"])

            self.assertEqual((done.report["outcome"], done.report["ticks"]), ("timeout", TICKS))
            self.assertEqual(there.wait_for("odometry", "passed", SAMPLES), SAMPLES)
            self.assertEqual(on.wait_for("far/odometry", "passed", SAMPLES), SAMPLES)
            self.assertEqual(back.wait_for("odometry", "refused", SAMPLES), SAMPLES)
            counts = there.counts()
            self.assertEqual((counts["first/state"]["passed"], counts["first/state"]["filtered"]),
                             (10, SAMPLES - 10))
            self.assertEqual((counts["rare/scan"]["passed"], counts["rare/scan"]["thinned"]),
                             (1, SAMPLES - 1))
            self.assertEqual(on.counts()["far/first/state"]["passed"], 10)
            self.assertEqual(back.counts()["odometry"]["passed"], 0)
            _, err, status = back.close()
            self.assertEqual(status, 0)
            self.assertIn("does not go to run", err)
            self.assertIn("it has been there", err)
            for bridge in (there, on):
                out, err, status = bridge.close()
                self.assertEqual(status, 0, err)
                last = [json.loads(line) for line in out.splitlines()]
                for line in last:
                    for key in ("dropped", "failed", "unreadable", "overrun", "unknown"):
                        self.assertEqual(line.get(key, 0), 0, line)

    def test_bad_files_are_refused_with_their_place(self):
        for text, words in (
                ("format: clew-bridge/1\n", "domains"),
                ("format: clew-bridge/1\ndomains: {a: {domain: 1}, b: {domain: 2}}\ntopics:\n"
                 "  - {topic: scan, from: a, to: c}\n", ":4:32: unknown domain 'c'"),
                ("format: clew-bridge/1\ndomains: {a: {domain: 1}, b: {domain: 1}}\ntopics:\n"
                 "  - {topic: scan, from: a, to: b}\n", "'a' and 'b' are the same domain")):
            done = Run(["bridge", "domains", write_file(text)])
            self.assertEqual(done.status, 2, done.err)
            self.assertIn(words, done.err)
        self.assertEqual(Run(["bridge", "domains", "none.yaml"]).status, 2)


if __name__ == "__main__":
    unittest.main()
