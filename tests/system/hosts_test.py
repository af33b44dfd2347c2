# SPDX-License-Identifier: Apache-2.0
"""A run with components on another host gives the same bytes as on one, also after a kill there and
after the loss of the host. Only computers of one authority meet. Hosts are `clew host` over
loopback, and two network namespaces with a slow and lossy cable between them."""
import contextlib
import fcntl
import itertools
import json
import os
import pathlib
import re
import shutil
import signal
import socket
import subprocess
import tempfile
import unittest

from clew_command import CLEW, Run, command_line, processes_of_session, run_graph, start, wait_until

RUN = ["krishna_kalra", "--world", "u-trap", "--max-ticks", "300"]
ENDLESS = ["krishna_kalra", "--world", "unsolvable-behind-wall", "--with", "recover.detector=none",
           "--max-ticks", "800"]
# A tick is 0.3 s of simulated time: the run lasts for 5 s at least, and is under way when something is killed.
PACE = ["--pace", "50x"]
FAR = ["--host", "sense=robot", "--host", "drive=robot"]
NUMBERS = itertools.count()
VENDORS = {"cyclonedds": ["--middleware", "cyclonedds"], "fastdds": ["--middleware", "fastdds"]}


def has_done(name, ticks, space=None):
    """Whether each component of the run, maybe in a network namespace, has done so many ticks."""
    inside = ["ip", "netns", "exec", space] if space else []
    done = subprocess.run([*inside, CLEW, "top", name, "--once", "--json"], capture_output=True,
                          text=True, check=False)
    rows = [json.loads(line) for line in done.stdout.splitlines()] if done.returncode == 0 else []
    return bool(rows) and all(row["ticks"] >= ticks for row in rows)


def make_keys(scratch):
    """A directory of keys with a host, two who run graphs, and one of whom another authority says so."""
    keys = scratch / "keys"
    for command in (["init", keys], ["host", keys, "robot"], ["host", keys, "desk", "--role", "run"],
                    ["init", scratch / "others"],
                    ["host", scratch / "others", "desk", "--role", "run"]):
        done = Run(["keys", *command])
        assert done.status == 0, done.out + done.err
    return keys


def write_hosts(path, identity, address, here=None):
    path.write_text(f"identity: {identity}\n" + (f"here: {here}\n" if here else "") +
                    f"hosts:\n  robot: {address}\n", encoding="utf-8")
    return path


class Host:
    """`clew host`, and the components that it has started."""

    def __init__(self, identity, listen="127.0.0.1:0", prefix=(), options=()):
        # Its end is written to, wherever text() reads: both have one position in it.
        self.log = tempfile.TemporaryFile(mode="w+")
        fcntl.fcntl(self.log, fcntl.F_SETFL, fcntl.fcntl(self.log, fcntl.F_GETFL) | os.O_APPEND)
        self.process = subprocess.Popen(
            [*prefix, CLEW, "host", "--identity", identity, "--listen", listen, *options], text=True,
            stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=self.log,
            start_new_session=True)
        self.address = self.process.stdout.readline().strip().rpartition(" ")[2]

    def components(self):
        """Process ids by stage; they are of the host's session, whatever their group."""
        found = {}
        for pid in processes_of_session(self.process.pid):
            words = command_line(pid)
            if "--line" in words:
                found[words[words.index("component") + 2]] = pid
        return found

    def text(self):
        self.log.seek(0)
        return self.log.read()

    def stop(self, number=signal.SIGTERM):
        if self.log.closed:
            return
        if self.process.poll() is None:
            self.process.send_signal(number)
            self.process.wait(timeout=20)
        self.process.stdout.close()
        self.log.close()


class OnLoopback(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        scratch = tempfile.TemporaryDirectory()
        cls.addClassCleanup(scratch.cleanup)
        cls.scratch = pathlib.Path(scratch.name)
        cls.keys = make_keys(cls.scratch)
        cls.expected = run_graph(*RUN, "--layout", "composed")["hash"]
        cls.endless = run_graph(*ENDLESS, "--layout", "composed")["hash"]

    def host(self, **options):
        host = Host(self.keys / "robot.host", **options)
        self.addCleanup(host.stop)
        return host

    def begin(self, host, *arguments, hosts=None):
        """Starts a run with components on the host, and waits until they step; its name and process."""
        name = f"hosts-test-{os.getpid()}-{next(NUMBERS)}"
        process = start(["run", *ENDLESS, *PACE, *FAR, "--hosts", hosts or self.hosts_of(host),
                         "--json", "--name", name, *arguments])
        self.addCleanup(process.communicate)
        self.addCleanup(process.kill)
        self.assertTrue(wait_until(lambda: has_done(name, 20)), host.text())
        return name, process

    def hosts_of(self, host, identity="keys/desk.run"):
        return write_hosts(self.scratch / "hosts.yaml", identity, host.address)

    def test_the_hash_is_that_of_one_host_with_each_vendor(self):
        host = self.host()
        hosts = self.hosts_of(host)
        for name, vendor in VENDORS.items():
            with self.subTest(vendor=name):
                report = run_graph(*RUN, *vendor, *FAR, "--hosts", hosts)
                self.assertEqual(report["hash"], self.expected)
                self.assertEqual(report["restarts"], 0, host.text())
        # A run may be over a moment before its processes are.
        ended = re.compile(r"sense for desk \(.*\) exited with status 0")
        self.assertTrue(wait_until(lambda: len(ended.findall(host.text())) == 2), host.text())
        self.assertTrue(wait_until(lambda: not host.components()))

    def test_the_graph_says_where_a_stage_is(self):
        host = self.host()
        graph = self.scratch / "far.yaml"
        graph.write_text("world: open-field\nrobot: disc-015\nsense: {behaviour: cones}\n"
                         "control: {behaviour: krishna_kalra_fuzzy, process: {host: robot}}\n"
                         "drive: {behaviour: turn_then_step}\n", encoding="utf-8")
        near = run_graph(graph, "--layout", "composed")
        far = run_graph(graph, "--hosts", self.hosts_of(host))
        self.assertEqual(far["hash"], near["hash"])
        self.assertIn("control for desk", host.text())
        refused = Run(["run", graph])
        self.assertEqual(refused.status, 2)
        self.assertIn("control is to run on host 'robot'; which address has it? Give --hosts FILE, or "
                      "--host control=here", refused.err)

    def test_a_killed_component_comes_back_there(self):
        host = self.host()
        name, process = self.begin(host)
        for stage, ticks in (("sense", 20), ("drive", 150)):
            self.assertTrue(wait_until(lambda: has_done(name, ticks)), host.text())
            self.assertTrue(wait_until(lambda: len(host.components()) == 2), host.text())
            os.kill(host.components()[stage], signal.SIGKILL)
        out, err = process.communicate(timeout=120)

        self.assertEqual(process.returncode, 3, err)
        self.assertRegex(err, r"sense \(process \d+\) was killed by signal 9 \(Killed\); restarting it")
        self.assertIn(self.endless, out)

    def test_the_components_of_a_lost_host_go_on_here(self):
        host = self.host()
        _, process = self.begin(host, "--fallback", "local")
        host.stop(signal.SIGKILL)
        out, err = process.communicate(timeout=120)

        self.assertEqual(process.returncode, 3, err)
        self.assertRegex(err, r"sense: host robot \(.*\) is lost")
        self.assertRegex(err, r"drive: host robot \(.*\) does not answer: .*; the component runs here")
        self.assertIn(self.endless, out)

    def test_a_host_that_is_stopped_leaves_no_component_behind(self):
        host = self.host()
        _, process = self.begin(host, "--fallback", "local")
        host.process.send_signal(signal.SIGSTOP)
        self.addCleanup(host.process.send_signal, signal.SIGCONT)
        # Before it is given up and its components begin here, five seconds later, those there are gone.
        self.assertTrue(wait_until(lambda: not host.components(), 4.5))
        out, err = process.communicate(timeout=120)
        host.process.send_signal(signal.SIGCONT)

        self.assertEqual(process.returncode, 3, err)
        self.assertIn("the component runs here", err)
        self.assertIn(self.endless, out)
        ended = re.compile(r"(sense|drive) for desk \(.*\) was killed by signal 9")
        self.assertTrue(wait_until(lambda: len(ended.findall(host.text())) == 2), host.text())

    def test_the_components_of_a_lost_host_go_on_at_a_third(self):
        done = Run(["keys", "host", self.keys, "spare"])
        self.assertEqual(done.status, 0, done.err)
        spare = Host(self.keys / "spare.host")
        self.addCleanup(spare.stop)
        host = self.host()
        hosts = self.scratch / "three.yaml"
        hosts.write_text(f"identity: keys/desk.run\nhosts:\n  robot: {host.address}\n"
                         f"  spare: {spare.address}\n", encoding="utf-8")
        _, process = self.begin(host, "--fallback", "spare", hosts=hosts)
        host.stop(signal.SIGKILL)
        out, err = process.communicate(timeout=120)

        self.assertEqual(process.returncode, 3, err)
        self.assertRegex(err, r"drive: host robot \(.*\) does not answer: .*; the component runs on spare")
        self.assertIn("sense for desk", spare.text())
        self.assertIn(self.endless, out)

    def test_real_time_replays_and_rests_when_the_host_is_lost(self):
        host = self.host()
        recording = self.scratch / "realtime.mcap"
        name = f"hosts-test-{os.getpid()}-realtime"
        process = start(["run", *ENDLESS, *FAR, "--hosts", self.hosts_of(host), "--pace", "realtime",
                         "--name", name, "--record", recording])
        self.addCleanup(process.communicate)
        self.addCleanup(process.kill)
        self.assertTrue(wait_until(lambda: has_done(name, 5)), host.text())
        host.stop(signal.SIGKILL)
        _, err = process.communicate(timeout=30)

        self.assertEqual(process.returncode, 1, err)
        self.assertRegex(err, "host robot .* is lost")
        replayed = Run(["replay", recording])
        self.assertEqual(replayed.status, 0, replayed.out + replayed.err)
        lines = Run(["echo", recording, "state", "--jsonl"]).out.splitlines()[-2:]
        poses = [json.loads(line)["pose_world_robot"] for line in lines]
        # drive was there, so who is here can only say how it was.
        self.assertTrue(poses[0] == poses[1] or "ended in motion" in err, err)

    def test_the_components_of_a_host_that_comes_back_go_on_there(self):
        host = self.host()
        _, process = self.begin(host)
        host.stop(signal.SIGKILL)
        again = self.host(listen=host.address)
        out, err = process.communicate(timeout=120)

        self.assertEqual(process.returncode, 3, err)
        self.assertIn("sense for desk", again.text())
        self.assertIn(self.endless, out)

    def test_a_run_of_another_authority_is_refused(self):
        host = self.host()
        done = Run(["run", *RUN, *FAR, "--hosts", self.hosts_of(host, "others/desk.run"), "--json"])
        self.assertEqual(done.status, 1, done.err)
        self.assertIn("host robot", done.err)
        self.assertIn("certificate", done.err)
        self.assertNotIn("is process", host.text())

    def test_bad_hosts_are_refused_before_anything_starts(self):
        file = write_hosts(self.scratch / "bad.yaml", "keys/desk.run", "127.0.0.1:1")
        cases = [(["--host", "sense=robbot", "--hosts", file], "unknown host 'robbot'"),
                 (["--host", "sens=robot", "--hosts", file], "unknown stage of this graph 'sens'"),
                 (["--host", "sense", "--hosts", file], "--host: expected STAGE=NAME"),
                 (["--hosts", file], "--hosts: no stage is on a host"),
                 (["--host", "sense=robot"], "Give --hosts FILE"),
                 ([*FAR, "--hosts", file, "--external", "sense"], "sense is on another host"),
                 ([*FAR, "--hosts", file, "--fallback", "there"], "unknown choice 'there'"),
                 ([*FAR, "--hosts", file, "--layout", "composed"], "need --layout processes"),
                 ([*FAR, "--hosts", self.scratch / "none.yaml"], "none.yaml: cannot be read")]
        for arguments, fault in cases:
            with self.subTest(fault=fault):
                done = Run(["run", *RUN, *arguments])
                self.assertEqual(done.status, 2, done.err)
                self.assertIn(fault, done.err)
        key = self.keys / "desk.run" / "private.key"
        key.chmod(0o644)
        self.addCleanup(key.chmod, 0o600)
        done = Run(["run", *RUN, *FAR, "--hosts", file])
        self.assertEqual(done.status, 2)
        self.assertIn("private.key: may be read by others", done.err)

    def test_a_program_is_started_only_if_the_host_lists_it(self):
        program = self.scratch / "control.py"
        shutil.copy(pathlib.Path(__file__).parents[2] / "examples/json_lines/my_control.py", program)
        graph = self.scratch / "program.yaml"
        graph.write_text("world: open-field\nrobot: disc-015\nsense: {behaviour: cones}\n"
                         f"control: {{exec: [python3, {program}], via: json_lines}}\n"
                         "drive: {behaviour: turn_then_step}\n", encoding="utf-8")
        far = ["--host", "control=robot", "--max-ticks", "50"]
        host = self.host()
        done = Run(["run", graph, *far, "--hosts", self.hosts_of(host)])
        self.assertEqual(done.status, 1, done.err)
        self.assertIn("python3: this host does not start it for others", done.err)
        willing = self.host(options=["--allow", "python3"])
        near = run_graph(graph, "--max-ticks", "50")
        report = run_graph(graph, *far, "--hosts", self.hosts_of(willing))
        self.assertEqual(report["hash"], near["hash"])

    def test_strangers_change_nothing(self):
        host = self.host()
        address, port = host.address.split(":")
        strangers = [socket.create_connection((address, int(port))) for _ in range(100)]
        for number, stranger in enumerate(strangers):
            with contextlib.suppress(OSError):
                stranger.sendall(os.urandom(number * 40))
        report = run_graph(*RUN, *FAR, "--hosts", self.hosts_of(host))
        for stranger in strangers:
            stranger.close()
        self.assertEqual(report["hash"], self.expected)


def works(*words):
    return subprocess.run(words, capture_output=True, check=False).returncode == 0


class OverACable(unittest.TestCase):
    """Two network namespaces with a cable between them; only its own addresses are used."""

    @classmethod
    def setUpClass(cls):
        cls.spaces = [f"clew-{os.getpid()}-{side}" for side in ("desk", "robot")]
        desk, robot = cls.spaces
        for space in cls.spaces:
            if not works("ip", "netns", "add", space):
                raise unittest.SkipTest("network namespaces need root, and ip of iproute2")
            cls.addClassCleanup(works, "ip", "netns", "del", space)
        plugs = [f"cl{os.getpid()}{side}" for side in "dr"]
        if not works("ip", "link", "add", plugs[0], "netns", desk, "type", "veth", "peer", "name",
                     plugs[1], "netns", robot):
            raise unittest.SkipTest("the kernel has no virtual cable (veth)")
        for space, plug, address in zip(cls.spaces, plugs, ("10.213.7.1", "10.213.7.2")):
            for command in (["addr", "add", f"{address}/24", "dev", plug], ["link", "set", plug, "up"],
                            ["link", "set", "lo", "up"]):
                assert works("ip", "-n", space, *command), command
        cls.bad = [cls.spoil(space, plug) for space, plug in zip(cls.spaces, plugs)]
        elsewhere = ('table ip elsewhere { chain out { type filter hook output priority 0; '
                     'oifname != "lo" ip daddr != 10.213.7.0/24 counter; }; }')
        cls.counted = all(works("ip", "netns", "exec", space, "nft", elsewhere)
                          for space in cls.spaces)
        cls.plugs = plugs
        scratch = tempfile.TemporaryDirectory()
        cls.addClassCleanup(scratch.cleanup)
        cls.scratch = pathlib.Path(scratch.name)
        cls.keys = make_keys(cls.scratch)
        cls.hosts = write_hosts(cls.scratch / "hosts.yaml", "keys/desk.run", "10.213.7.2:7447",
                                "10.213.7.1")

    @staticmethod
    def spoil(space, plug):
        """A millisecond each way, and one packet of two hundred lost; else the loss only."""
        inside = ["ip", "netns", "exec", space]
        if works(*inside, "tc", "qdisc", "add", "dev", plug, "root", "netem", "delay", "1ms", "loss",
                 "0.5%"):
            return "slow, and loses packets"
        rules = ("table ip cable { chain in { type filter hook input priority 0; "
                 f'iifname "{plug}" numgen random mod 200 == 0 drop; }}; }}')
        if works(*inside, "nft", rules):
            return "loses packets (the kernel has no netem)"
        return "fast and loses nothing (the kernel has neither netem nor nft's numgen)"

    def setUp(self):
        print(f"the cable: {self.bad[0]}")
        self.host = Host(self.keys / "robot.host", "10.213.7.2:7447",
                         ["ip", "netns", "exec", self.spaces[1]])
        self.addCleanup(self.host.stop)

    def run_at_desk(self, *arguments, **options):
        return subprocess.Popen(
            ["ip", "netns", "exec", self.spaces[0], CLEW, "run", *map(str, arguments), "--json"],
            text=True, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
            **options)

    def test_hash_and_recording_are_those_of_one_host(self):
        short = [*RUN[:-1], "150"]
        near = self.scratch / "near.mcap"
        expected = run_graph(*short, "--layout", "composed", "--record", near)["hash"]
        for name, vendor in VENDORS.items():
            with self.subTest(vendor=name):
                far = self.scratch / f"{name}.mcap"
                process = self.run_at_desk(*short, *vendor, *FAR, "--hosts", self.hosts, "--record",
                                           far)
                out, err = process.communicate(timeout=120)
                self.assertIn(expected, out, err + self.host.text())
                same = Run(["diff", near, far])
                self.assertEqual(same.status, 0, same.out + same.err)
        if not self.counted:
            self.skipTest("the kernel has no nft, so nobody counts what goes elsewhere; the rest is good")
        for space in self.spaces:
            rules = subprocess.run(["ip", "netns", "exec", space, "nft", "list", "table", "ip",
                                    "elsewhere"], capture_output=True, text=True, check=True).stdout
            self.assertIn("counter packets 0 bytes 0", rules)

    def test_a_cable_that_is_cut_is_a_lost_host(self):
        robot, plug = self.spaces[1], self.plugs[1]
        name = f"hosts-test-{os.getpid()}-cable"
        process = self.run_at_desk(*ENDLESS, *PACE, *FAR, "--hosts", self.hosts, "--fallback",
                                   "local", "--name", name)
        self.addCleanup(process.communicate)
        self.addCleanup(process.kill)
        self.assertTrue(wait_until(lambda: has_done(name, 20, self.spaces[0])), self.host.text())
        self.assertTrue(works("ip", "-n", robot, "link", "set", plug, "down"))
        self.addCleanup(works, "ip", "-n", robot, "link", "set", plug, "up")
        self.assertTrue(wait_until(lambda: not self.host.components(), 10), self.host.text())
        out, err = process.communicate(timeout=120)

        expected = run_graph(*ENDLESS, "--layout", "composed")["hash"]
        self.assertIn(expected, out, err)
        self.assertIn("the component runs here", err)


if __name__ == "__main__":
    unittest.main()
