# SPDX-License-Identifier: Apache-2.0
"""A live run on the wire of ROS 2: nodes with nothing of Clew in them, on either vendor, see what
rmw_cyclonedds and rmw_fastrtps would show them. Samples are decoded by npm's
@foxglove/rosmsg2-serialization with the official definitions."""
import json
import os
import pathlib
import signal
import subprocess
import tempfile
import threading
import time
import unittest

from clew_command import SOURCE, Run, free_domains, start, wait_until

FAR_SIDE = pathlib.Path(os.environ.get("CLEW_ROS2_TESTS", SOURCE / "build/tests/ros2"))
TYPES = {
    "rt/clock": "rosgraph_msgs/msg/Clock",
    "rt/r1/scan": "sensor_msgs/msg/LaserScan",
    "rt/r1/odom": "nav_msgs/msg/Odometry",
    "rt/tf": "tf2_msgs/msg/TFMessage",
    "rt/tf_static": "tf2_msgs/msg/TFMessage",
    "rt/r1/chart": "nav_msgs/msg/OccupancyGrid",
    "rt/r1/map_seen": "nav_msgs/msg/OccupancyGrid",
    "rt/r1/plan": "nav_msgs/msg/Path",
    "rt/r1/goal_pose": "geometry_msgs/msg/PoseStamped",
    "rt/diagnostics": "diagnostic_msgs/msg/DiagnosticArray",
    "rt/rosout": "rcl_interfaces/msg/Log",
    "rt/r1/markers": "visualization_msgs/msg/MarkerArray",
    "ros_discovery_info": "rmw_dds_common/msg/ParticipantEntitiesInfo",
}
LATCHED = {"rt/tf_static", "rt/r1/chart", "rt/r1/map_seen", "rt/r1/goal_pose", "rt/rosout",
           "rt/r1/markers", "ros_discovery_info"}
# A few of them as published by the distributions; tests/ros2 computes all of them anew.
HASHES = {
    "rt/r1/scan": "RIHS01_64c191398013af96509d518dac71d5164f9382553fce5c1f8cca5be7924bd828",
    "rt/tf": "RIHS01_e369d0f05a23ae52508854b66f6aa0437f3449d652e8cbf22d5abe85d020f087",
    "ros_discovery_info":
        "RIHS01_91a0593bacdcc50ea9bdcf849a938b128412cc1ea821245c663bcd26f83c295e",
}


class FarSide:
    """A node of ROS 2 that writes down what it sees."""

    def __init__(self, program, domain):
        self.process = subprocess.Popen([FAR_SIDE / program, str(domain)], text=True,
                                        stdin=subprocess.PIPE, stdout=subprocess.PIPE)
        assert self.process.stdout.readline() in ("ready\n",), "it did not start"
        self.lines = []
        self.thread = threading.Thread(target=lambda: self.lines.extend(self.process.stdout))
        self.thread.start()

    def close(self):
        self.process.stdin.close()
        self.thread.join(20)
        self.process.wait(20)

    def endpoints(self):
        """What discovery told, by topic: type, guid, reliability, durability, USER_DATA."""
        found = {}
        for line in self.lines:
            words = line.split()
            if words[0] == "endpoint":
                found[words[1]] = (words[2:] + [""])[:5]
        return found

    def samples(self):
        """The decoded samples, by topic."""
        kept = [line.split()[1:] for line in self.lines if line.startswith("sample ")]
        text = "".join(f"{TYPES[topic]} {data}\n" for topic, data in kept)
        decoded = subprocess.run(["node", "decode.mjs"], cwd=FAR_SIDE / "npm", input=text,
                                 capture_output=True, text=True, timeout=60, check=True).stdout
        by_topic = {}
        for (topic, _), line in zip(kept, decoded.splitlines(), strict=True):
            by_topic.setdefault(topic, []).append(json.loads(line))
        return by_topic


def seconds(stamp):
    return stamp["sec"] + stamp["nanosec"] * 1e-9


class Ros2Bridge(unittest.TestCase):
    def watch(self, listener, *options, environment=None):
        """Runs a graph, bridged to a far side; returns the run's report and the far side."""
        domain, ros_domain = free_domains(2)
        far_side = FarSide(listener, ros_domain)
        try:
            bridge = start(["bridge", "ros2", "--domain", domain, "--namespace", "r1", "--remap",
                            "map:=chart", *options],
                           env={**os.environ, "ROS_DOMAIN_ID": str(ros_domain),
                                **(environment or {})})
            run = start(["run", "krishna_kalra", "--world", "u-trap", "--pace", "1x", "--domain",
                         domain, "--json"])
            self.addCleanup(run.kill)
            # The robot does not move far before whoever looks on has joined.
            seen = wait_until(lambda: any(line.startswith("sample ") for line in far_side.lines))
            Run(["pace", domain, "40x"])
            report, err = run.communicate(timeout=60)
            self.assertTrue(seen, err)
            self.assertEqual(run.returncode, 0, err)
            out, err = bridge.communicate(timeout=30)
            self.assertEqual(bridge.returncode, 0, out + err)
        finally:
            far_side.close()
        return json.loads(report.splitlines()[-1]), far_side

    def check_endpoints(self, far_side, hashes):
        endpoints = far_side.endpoints()
        for topic, name in TYPES.items():
            group, _, short = name.split("/")
            dds_type, _, reliability, durability, user_data = endpoints[topic]
            self.assertEqual(dds_type, f"{group}::msg::dds_::{short}_")
            self.assertEqual(reliability, "best_effort" if topic == "rt/clock" else "reliable")
            self.assertEqual(durability, "transient_local" if topic in LATCHED else "volatile")
            self.assertEqual("typehash=RIHS01_" in user_data, hashes)
            self.assertRegex(user_data, r"clew_origin=[0-9]+-[0-9]+;clew_hops=1;")
            if hashes and topic in HASHES:
                self.assertTrue(user_data.startswith(f"typehash={HASHES[topic]};"), user_data)
        return endpoints

    def check_node(self, samples, endpoints):
        (info,) = samples["ros_discovery_info"][-1:]
        (node,) = info["node_entities_info_seq"]
        self.assertEqual((node["node_namespace"], node["node_name"]), ("/r1", "clew"))
        told = {bytes(gid["data"]).hex() for gid in node["writer_gid_seq"]}
        seen = {guid for topic, (_, guid, *_) in endpoints.items() if topic in TYPES
                and topic != "ros_discovery_info"}
        self.assertEqual(told, seen)
        self.assertEqual(bytes(info["gid"]["data"]).hex()[:24],
                         endpoints["rt/tf"][1][:24])

    def check_samples(self, samples, report):
        self.assertEqual(set(TYPES), set(samples))
        scan = samples["rt/r1/scan"][-1]
        self.assertEqual(scan["header"]["frame_id"], "r1/laser")
        self.assertEqual(len(scan["ranges"]), 7)
        self.assertTrue(all(r == "Infinity" or scan["range_min"] <= r <= scan["range_max"]
                            for r in scan["ranges"]))
        clock = [seconds(sample["clock"]) for sample in samples["rt/clock"]]
        self.assertEqual(clock, sorted(clock))
        self.assertAlmostEqual(clock[-1], report["sim_time_s"], delta=1.0)
        chart = samples["rt/r1/chart"][0]
        self.assertEqual((chart["info"]["width"], chart["info"]["height"]), (200, 200))
        self.assertEqual(chart["data"][100 * 200 + 60], 100)  # the U's left wall, at (3, 5)
        self.assertEqual(chart["data"][100 * 200 + 100], 0)   # inside it
        self.assertIn(100, samples["rt/r1/map_seen"][-1]["data"])
        # The odometry of this run is exact, so map and odom lie on each other at the start.
        goal = samples["rt/r1/goal_pose"][0]["pose"]["position"]
        path = samples["rt/r1/plan"][-1]["poses"]
        self.assertEqual(path[-1]["pose"]["position"], goal)
        tf = samples["rt/tf"][-1]["transforms"]
        self.assertEqual([(t["header"]["frame_id"], t["child_frame_id"]) for t in tf],
                         [("map", "r1/odom"), ("r1/odom", "r1/base_link")])
        logs = [log["msg"] for log in samples["rt/rosout"]]
        self.assertIn("outcome: reached", logs)
        self.assertTrue(any("trap" in log for log in logs), logs)
        traps = [m for m in samples["rt/r1/markers"][-1]["markers"] if m["ns"] == "traps"]
        self.assertEqual(len(traps), report["traps_detected"])
        status = samples["rt/diagnostics"][-1]["status"][0]
        self.assertEqual({v["key"]: v["value"] for v in status["values"]}["dropped_samples"], "0")

    def test_a_node_on_cyclone_dds_sees_a_robot(self):
        report, far_side = self.watch("cyclone_listener")
        alone = Run(["run", "krishna_kalra", "--world", "u-trap", "--layout", "composed", "--json"])

        self.assertEqual(report["hash"], alone.report["hash"])
        samples = far_side.samples()
        self.check_node(samples, self.check_endpoints(far_side, hashes=True))
        self.check_samples(samples, report)

    def test_a_node_on_fast_dds_sees_the_same(self):
        report, far_side = self.watch("fastdds_listener", "--middleware", "fastdds")

        samples = far_side.samples()
        self.check_node(samples, self.check_endpoints(far_side, hashes=True))
        self.check_samples(samples, report)

    def test_vendors_may_differ_and_humble_has_no_type_hashes(self):
        report, far_side = self.watch("cyclone_listener", "--middleware", "fastdds",
                                      "--ros-distro", "humble")

        self.check_endpoints(far_side, hashes=False)
        self.assertGreater(report["ticks"], 0)

    def test_a_bridge_that_is_killed_or_interrupted_leaves_the_run_alone(self):
        for number, status in ((signal.SIGKILL, -signal.SIGKILL), (signal.SIGINT, 130)):
            domain, ros_domain = free_domains(2)
            run = start(["run", "krishna_kalra", "--world", "u-trap", "--pace", "40x", "--domain",
                         domain, "--json"])
            bridge = start(["bridge", "ros2", "--domain", domain, "--ros-domain", ros_domain])
            self.assertIn(f"ROS domain {ros_domain} on 127.0.0.1", bridge.stderr.readline())
            bridge.send_signal(number)
            bridge.communicate(timeout=20)
            out, err = run.communicate(timeout=60)

            self.assertEqual(bridge.returncode, status)
            self.assertEqual(run.returncode, 0, err)
            self.assertEqual(json.loads(out.splitlines()[-1])["restarts"], 0)

    def test_goals_of_ros_are_taken_from_one_writer_and_replayed(self):
        domain, ros_domain = free_domains(2)
        recording = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory())) / "run.mcap"
        run = start(["run", "default", "--world", "open-field", "--pace", "1x", "--domain", domain,
                     "--json", "--record", recording])
        bridge = start(["bridge", "ros2", "--domain", domain, "--ros-domain", ros_domain,
                        "--take-goals"])
        self.assertIn("ROS domain", bridge.stderr.readline())
        goals = [subprocess.Popen([FAR_SIDE / "cyclone_goal", str(ros_domain), "rt/goal_pose",
                                   "map"], text=True, stdin=subprocess.PIPE,
                                  stdout=subprocess.PIPE) for _ in range(2)]
        try:
            for each in goals:
                self.assertEqual(each.stdout.readline(), "ready\n")
            goals[0].stdin.write("8 1.5\n")
            goals[0].stdin.flush()
            self.assertIn("goals are taken from the writer", bridge.stderr.readline())
            self.assertRegex(bridge.stderr.readline(), "goal=8,1.5 at tick [0-9]+")
            goals[1].stdin.write("2 5\n")
            goals[1].stdin.flush()
            self.assertIn("a goal of another writer is refused", bridge.stderr.readline())
            Run(["pace", domain, "50x"])
            out, err = run.communicate(timeout=60)
        finally:
            for each in goals:
                each.stdin.close()
                each.wait(20)
                each.stdout.close()
            bridge.communicate(timeout=20)
            run.kill()

        self.assertEqual(run.returncode, 0, err)
        self.assertEqual(json.loads(out.splitlines()[-1])["outcome"], "reached")
        events = Run(["info", recording, "--json"]).report["interventions"]
        changes = [event["changes"] for event in events if event["changes"]]  # not the pace
        self.assertEqual(changes, [["goal=8,1.5"]])
        replay = Run(["replay", recording, "--json"])
        self.assertEqual(replay.status, 0, replay.err)

    def test_a_path_of_ros_is_a_mission_of_waypoints(self):
        domain, ros_domain = free_domains(2)
        recording = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory())) / "run.mcap"
        run = start(["run", "default", "--world", "open-field", "--pace", "1x", "--domain", domain,
                     "--json", "--record", recording])
        bridge = start(["bridge", "ros2", "--domain", domain, "--ros-domain", ros_domain,
                        "--take-goals"])
        self.assertIn("ROS domain", bridge.stderr.readline())
        paths = subprocess.Popen([FAR_SIDE / "cyclone_goal", str(ros_domain), "rt/waypoints", "map",
                                  "path"], text=True, stdin=subprocess.PIPE, stdout=subprocess.PIPE)
        try:
            self.assertEqual(paths.stdout.readline(), "ready\n")
            paths.stdin.write("8 1.5 90 1\n")
            paths.stdin.flush()
            self.assertIn("goals are taken from the writer", bridge.stderr.readline())
            self.assertIn("way-point 2 [90, 1] is not within the bounds", bridge.stderr.readline())
            for line, goal in (("\n", "none"), ("8 1.5 4 1 3 3\n", "8,1.5/4,1/3,3")):
                paths.stdin.write(line)
                paths.stdin.flush()
                self.assertRegex(bridge.stderr.readline(), f"goal={goal} at tick [0-9]+")
            Run(["pace", domain, "50x"])
            out, err = run.communicate(timeout=60)
        finally:
            paths.stdin.close()
            paths.wait(20)
            paths.stdout.close()
            bridge.communicate(timeout=20)
            run.kill()

        self.assertEqual(run.returncode, 0, err)
        self.assertEqual(json.loads(out.splitlines()[-1])["outcome"], "reached")
        told = Run(["info", recording, "--json"]).report
        changes = [event["changes"] for event in told["interventions"] if event["changes"]]
        self.assertEqual(changes, [["goal=none"], ["goal=8,1.5/4,1/3,3"]])
        self.assertEqual([mark["number"] for mark in told["waypoints"]], [1, 2, 3])
        replay = Run(["replay", recording, "--json"])
        self.assertEqual(replay.status, 0, replay.err)

    def test_a_run_starts_its_bridge_itself(self):
        (ros_domain,) = free_domains(1)
        far_side = FarSide("cyclone_listener", ros_domain)
        try:
            run = Run(["run", "krishna_kalra", "--world", "u-trap", "--pace", "40x", "--ros2=r1",
                       "--json"], environment={"ROS_DOMAIN_ID": str(ros_domain)})
        finally:
            far_side.close()
        self.assertEqual(run.status, 0, run.err)
        told = [(log["name"], log["msg"]) for log in far_side.samples()["rt/rosout"]]
        self.assertIn("outcome: reached", [message for _, message in told])
        # What the bridge tells itself, which standard error has as well.
        self.assertTrue(any(name == "clew.bridge" and "ROS domain" in message
                            for name, message in told), told)
        self.assertIn("clew bridge: run ", run.err)
        composed = Run(["run", "reactive", "--ros2", "--layout", "composed"])
        self.assertEqual(composed.status, 2)
        self.assertIn("--ros2 need --layout processes", composed.err)

    def test_a_run_that_does_not_start_takes_its_bridge_along(self):
        (ros_domain,) = free_domains(1)
        began = time.monotonic()
        run = Run(["run", "krishna_kalra", "--world", "u-trap", "--ros2=r1", "--prefix",
                   "control=/nonexistent/program"], environment={"ROS_DOMAIN_ID": str(ros_domain)})
        self.assertNotEqual(run.status, 0)
        self.assertLess(time.monotonic() - began, 10.0)

    def test_bad_input_is_named(self):
        for arguments, words in (
                (["--domain", 3, "--ros-domain", 3], "the run's own"),
                (["--domain", 3, "--ros-domain", 100],
                 "--ros-domain: domain 100; allowed: 0 to 99"),
                (["--domain", 1000], "found '1000'; allowed: a domain's number, or a run's name"),
                (["--domain", "5.0"], "found '5.0'; allowed: a domain's number, or a run's name"),
                (["--domain=-1"], "found '-1'; allowed: a domain's number, or a run's name"),
                (["--domain", 3, "--ros-distro", "foxy"], "known: humble, jazzy"),
                (["--domain", 3, "--namespace", "a-b"], "--namespace: 'a-b' is no name of ROS"),
                (["--domain", 3, "--remap", "scan"], "--remap: 'scan' is no rule"),
                (["--domain", 3, "--middleware", "rti"], "allowed: cyclonedds, fastdds")):
            run = Run(["bridge", "ros2", *arguments])
            self.assertEqual(run.status, 2, arguments)
            self.assertIn(words, run.err)
        run = Run(["bridge", "ros2", "--domain", 3], environment={"ROS_DOMAIN_ID": "x"})
        self.assertEqual(run.status, 2)
        self.assertIn("ROS_DOMAIN_ID: found 'x'", run.err)


if __name__ == "__main__":
    unittest.main()
