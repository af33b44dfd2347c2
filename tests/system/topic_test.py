# SPDX-License-Identifier: Apache-2.0
"""clew topic looks at live runs, of both vendors, and at publishers of somebody else; nothing that it
does changes a run or holds it up."""
import itertools
import json
import os
import pathlib
import signal
import subprocess
import tempfile
import unittest

from clew_command import CLEW, THIRD_PARTY, Run, run_graph, start, wait_until

# Many seconds of ticks; the robot wanders before a wall.
RUN = ["krishna_kalra", "--world", "unsolvable-behind-wall", "--with", "recover.detector=none"]
# Ticks a second: a tick is 0.3 s of simulated time.
PACE = ["--pace", "60x"]
RATE_HZ = 200
TYPES = {"command": "Command", "event": "Event", "guidance": "Guidance", "landmark": "Landmark",
         "odometry": "Odometry", "scan": "Scan", "state": "State", "target": "Target"}
LONE_DOMAIN = "77"
NUMBERS = itertools.count()
# A Cyclone DDS that speaks on this host only, as our participants do.
ON_LOOPBACK = ("<General><Interfaces><NetworkInterface address='127.0.0.1'/></Interfaces>"
               "<AllowMulticast>false</AllowMulticast></General><Discovery>"
               "<ParticipantIndex>auto</ParticipantIndex>"
               "<MaxAutoParticipantIndex>119</MaxAutoParticipantIndex>"
               "<Peers><Peer Address='127.0.0.1'/></Peers></Discovery>")


def lines(done):
    return [json.loads(line) for line in done.out.splitlines()]


def topic(verb, *arguments, **options):
    return Run(["topic", verb, *arguments], **options)


class OfARun(unittest.TestCase):
    def begin(self, *layout):
        """Starts a run and returns its name, once it has begun."""
        name = f"topic-test-{os.getpid()}-{next(NUMBERS)}"
        process = start(["run", *RUN, *PACE, *layout, "--name", name])
        self.addCleanup(process.communicate)
        self.addCleanup(process.kill)
        self.assertTrue(wait_until(lambda: Run(["resume", name]).err.endswith("not paused\n")))
        return name

    def test_a_list_tells_every_topic_its_type_and_who_has_it(self):
        for vendor in ("cyclonedds", "fastdds"):
            with self.subTest(vendor=vendor):
                name = self.begin("--middleware", vendor)
                found = {row["topic"]: row for row in lines(topic("list", "--domain", name, "--json"))}

                self.assertEqual({name: row["type"] for name, row in found.items()},
                                 {name: f"clew::msg::{of}" for name, of in TYPES.items()})
                self.assertEqual({row["writers"] for row in found.values()}, {1})
                # classify, recover and control read the scan.
                self.assertEqual(found["scan"]["readers"], 3)
                self.assertEqual(found["command"]["readers"], 1)
                self.assertEqual(Run(["stop", name]).status, 0)

    def test_info_names_the_stages_and_their_qos(self):
        name = self.begin()

        told = lines(topic("info", "scan", "--domain", name, "--json"))[0]

        ends = told["endpoints"]
        self.assertEqual([end["stage"] for end in ends if end["kind"] == "writer"], ["sense"])
        self.assertEqual({end["stage"] for end in ends if end["kind"] == "reader"},
                         {"classify", "recover", "control"})
        self.assertEqual({(end["reliability"], end["durability"]) for end in ends},
                         {("reliable", "transient_local")})
        self.assertTrue(all(pathlib.Path(f"/proc/{end['pid']}").exists() for end in ends))
        self.assertEqual(topic("find", "Scan", "--domain", name).out, "scan\n")
        self.assertEqual(topic("find", "clew::msg::State", "-c", "--domain", name).out, "1\n")

    def test_echo_prints_what_the_recording_has(self):
        with tempfile.TemporaryDirectory() as directory:
            recording = pathlib.Path(directory) / "r.mcap"
            name = self.begin("--middleware", "control=fastdds", "--record", recording)
            live = start(["topic", "echo", "scan", "--domain", name, "--json"])
            seen = [json.loads(live.stdout.readline()) for _ in range(50)]
            csv = topic("echo", "/odometry", "--once", "--csv", "--field", "pose_odom_robot",
                        "--domain", name)
            self.assertEqual(Run(["stop", name]).status, 0)
            live.communicate(timeout=30)
            # Its writer is gone, so there is nothing more to come.
            self.assertEqual(live.returncode, 0)
            self.assertTrue(wait_until(recording.exists))
            recorded = {row["tick"]: row for row in
                        lines(Run(["echo", recording, "scan", "--jsonl"]))}

            self.assertEqual(seen, [recorded[row["tick"]] for row in seen])
            self.assertEqual(csv.status, 0, csv.err)
            self.assertRegex(csv.out.splitlines()[0], r"^tick,sequence,pose_odom_robot\.x_m,")

    def test_rate_bandwidth_and_delay_are_told(self):
        name = self.begin()

        rate = lines(topic("hz", "scan", "--once", "--json", "--domain", name))[0]
        width = lines(topic("bw", "scan", "--once", "--json", "--domain", name))[0]
        delay = lines(topic("delay", "command", "--once", "--json", "--domain", name))[0]

        self.assertAlmostEqual(rate["rate_hz"], RATE_HZ, delta=0.2 * RATE_HZ)
        self.assertAlmostEqual(rate["window"] + rate["lost"], RATE_HZ, delta=0.4 * RATE_HZ)
        self.assertAlmostEqual(width["bytes_per_s"] / width["mean_bytes"], RATE_HZ,
                               delta=0.2 * RATE_HZ)
        # A command follows from its tick's state through four processes, well before the next tick.
        self.assertGreater(delay["mean_s"], 0)
        self.assertLess(delay["mean_s"], 1 / RATE_HZ)
        refused = topic("delay", "state", "--domain", name)
        self.assertEqual(refused.status, 2)
        self.assertIn("state is what begins a tick", refused.err)

    def test_a_reader_that_stands_still_holds_nothing_up(self):
        name = f"topic-test-{os.getpid()}-frozen"
        process = start(["run", *RUN, *PACE, "--max-ticks", "6000", "--name", name, "--json"])
        self.addCleanup(process.kill)
        self.assertTrue(wait_until(lambda: Run(["resume", name]).err.endswith("not paused\n")))
        reader = subprocess.Popen([CLEW, "topic", "echo", "scan", "--domain", name],
                                  stdout=subprocess.PIPE, stderr=subprocess.DEVNULL)
        self.addCleanup(reader.communicate)
        self.addCleanup(reader.kill)
        self.assertTrue(reader.stdout.readline())
        os.kill(reader.pid, signal.SIGSTOP)

        self.assertEqual(Run(["pace", name, "lockstep"]).status, 0)
        out, err = process.communicate(timeout=90)
        report = json.loads(out.splitlines()[-1])
        self.assertEqual((report["outcome"], report["restarts"]), ("timeout", 0), err)
        self.assertEqual(report["hash"], run_graph(*RUN, "--max-ticks", "6000", "--layout",
                                                   "composed")["hash"])

    def test_what_is_not_there_is_said(self):
        name = self.begin()
        for words, status, why in (
                (["echo", "scann"], 2, "did you mean 'scan'"),
                (["echo", "scan", "clew::msg::State"], 2, "unknown type of topic scan"),
                (["echo", "scan", "--field", "ranges"], 2, "did you mean 'ranges_m'"),
                (["find", "sensor_msgs::msg::LaserScan"], 1, "unknown type on this domain"),
                (["echo", "scan", "--csv", "--json"], 2, "leave out the other")):
            with self.subTest(words=words):
                done = topic(*words, "--domain", name)
                self.assertEqual(done.status, status, done.out + done.err)
                self.assertIn(why, done.err)
        for words, status, why in (
                (["list", "--domain", "76", "--spin-time", "0.3"], 1, "nobody is on domain 76"),
                (["list", "--domain", "100"], 2, "--domain"),
                (["list", "--domain", "nobody-is-called-so"], 2, "no run is called"),
                (["list"], 2, "which domain?")):
            with self.subTest(words=words):
                done = topic(*words)
                self.assertEqual(done.status, status, done.out + done.err)
                self.assertIn(why, done.err)


class OfAStranger(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.writer = subprocess.Popen(
            [THIRD_PARTY / "lone_writer"], stdout=subprocess.PIPE, text=True,
            env={**os.environ, "CLEW_DOMAIN_ID": LONE_DOMAIN, "CYCLONEDDS_URI": ON_LOOPBACK})
        assert cls.writer.stdout.readline() == "writing\n"

    @classmethod
    def tearDownClass(cls):
        cls.writer.kill()
        cls.writer.communicate()

    def test_its_topics_are_listed(self):
        rows = lines(topic("list", "--domain", LONE_DOMAIN, "--json"))

        self.assertEqual(rows, [
            {"topic": "clock", "type": "clew::msg::TickStamp", "writers": 1, "readers": 0},
            {"topic": "odd", "type": "clew::msg::Scan", "writers": 2, "readers": 0},
            {"topic": "scan", "type": "clew::msg::Scan", "writers": 1, "readers": 0}])
        told = lines(topic("info", "scan", "--domain", LONE_DOMAIN, "--json"))[0]
        self.assertEqual(told["endpoints"][0]["stage"], None)
        self.assertEqual(told["endpoints"][0]["pid"], self.writer.pid)
        self.assertEqual(told["endpoints"][0]["reliability"], "best_effort")

    def test_what_it_writes_is_read(self):
        scan = lines(topic("echo", "scan", "--once", "--json", "--domain", LONE_DOMAIN))[0]
        rate = lines(topic("hz", "clock", "--once", "--json", "--domain", LONE_DOMAIN))[0]

        self.assertEqual(scan["ranges_m"], [0.5, 1.0, 1.25])
        self.assertEqual(scan["tick"], scan["sequence"])
        self.assertAlmostEqual(rate["rate_hz"], 20, delta=4)

    def test_what_is_no_message_is_left_out_and_the_rest_is_shown(self):
        reader = start(["topic", "echo", "odd", "--json", "--domain", LONE_DOMAIN])
        try:
            self.assertIn("a sample of odd is no clew::msg::Scan and is left out",
                          reader.stderr.readline())
            shown = [json.loads(reader.stdout.readline()) for _ in range(3)]
        finally:
            reader.send_signal(signal.SIGINT)
            reader.communicate(timeout=20)

        for scan in shown:
            self.assertEqual(scan["ranges_m"], [0.5, 1.0, 1.25])
        self.assertEqual(reader.returncode, 0)

    def test_lists_are_cut_where_that_is_asked_for(self):
        whole = topic("echo", "scan", "--once", "--field", "ranges_m", "--domain", LONE_DOMAIN)
        cut = topic("echo", "scan", "--once", "--field", "ranges_m", "-l", "2", "--domain",
                    LONE_DOMAIN)

        self.assertIn("ranges_m = [0.5, 1, 1.25]", whole.out)
        self.assertIn("ranges_m = [0.5, 1]", cut.out)

    def test_a_topics_type_is_told(self):
        self.assertEqual(topic("type", "clock", "--domain", LONE_DOMAIN).out,
                         "clew::msg::TickStamp\n")

    def test_a_type_that_is_none_of_ours_is_bytes(self):
        refused = topic("echo", "clock", "--domain", LONE_DOMAIN)
        raw = topic("echo", "clock", "--raw", "--once", "--json",
                    environment={"CLEW_DOMAIN_ID": LONE_DOMAIN})

        self.assertEqual(refused.status, 2)
        self.assertIn("clew::msg::TickStamp, which is none of Clew's; --raw shows its bytes",
                      refused.err)
        # Encapsulation, tick, time (0), sequence: the tick.
        data = bytes.fromhex(lines(raw)[0]["bytes"])
        self.assertEqual((len(data), data[:4]), (28, b"\x00\x01\x00\x00"))
        self.assertEqual(data[4:12], data[20:28])


if __name__ == "__main__":
    unittest.main()
