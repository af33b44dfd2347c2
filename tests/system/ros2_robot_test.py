# SPDX-License-Identifier: Apache-2.0
"""A robot of ROS 2 in the place of sense and drive. The robot is a program with nothing of Clew in
it, on either vendor, without a watchdog of its own: if it stands in the end, it was told to."""
import json
import os
import pathlib
import signal
import subprocess
import tempfile
import threading
import unittest

from clew_command import SOURCE, Run, components_of, free_domains, start, wait_until

ROBOTS = pathlib.Path(os.environ.get("CLEW_ROS2_TESTS", SOURCE / "build/tests/ros2"))
WALLS = [(0, 0, 4, 0), (4, 0, 4, 3), (4, 3, 0, 3), (0, 3, 0, 0), (1.6, 1.1, 1.6, 1.9)]
START = (0.6, 1.5, 0.0)
TARGET = (2.8, 1.5)
WORLD = f"""format: clew-world/1
name: robot-room
about: "The walls are for pictures: what the robot meets is the robot's."
bounds: [0, 0, 4, 3]
walls: [[1.6, 1.1, 1.6, 1.9]]
start: {list(START)}
target: {list(TARGET)}
target_radius: 0.15
"""
GRAPH = """world: ./world.yaml
robot: disc-015
sense: {{ros2: {{{settings}}}, behaviour: laser, range_m: 3, field_deg: 350, beams: 71}}
recover: {{detector: known_detour, escape: [remembered_map], immediate_memory: false}}
control: {{behaviour: fuzzy_behaviourist, guard_margin_m: 0.05}}
drive: {{ros2: {{{settings}}}, behaviour: unicycle, max_speed_mps: 0.8, max_acceleration_mps2: 1.5}}
"""


class Robot:
    """The far side."""

    def __init__(self, program, domain, pose=START, namespace="r1", more=()):
        walls = [",".join(map(str, wall)) for wall in WALLS]
        self.process = subprocess.Popen(
            [ROBOTS / program, str(domain), namespace, *map(str, pose), *walls, *more],
            text=True,
            stdin=subprocess.PIPE, stdout=subprocess.PIPE)
        assert self.process.stdout.readline() == "ready\n", "it did not start"
        self.commands = []
        self.places = []
        self.thread = threading.Thread(target=self.read)
        self.thread.start()

    def read(self):
        for line in self.process.stdout:
            word, *values = line.split()
            values = [float(value) for value in values]
            (self.commands if word == "command" else self.places).append(values)

    def order(self, text):
        self.process.stdin.write(text + "\n")
        self.process.stdin.flush()

    def is_told(self, moving):
        return bool(self.commands) and any(self.commands[-1]) == moving

    def where(self):
        """Pose, speeds, contacts, number of commands, and of zeros at their end, as of now."""
        before = len(self.places)
        self.order("where")
        assert wait_until(lambda: len(self.places) > before)
        return self.places[-1]

    def close(self):
        if self.process.poll() is None:
            self.process.stdin.close()
        self.thread.join(20)
        self.process.wait(20)
        self.process.stdout.close()


def state_of(pid):
    """The letter of /proc: T is stopped."""
    return pathlib.Path(f"/proc/{pid}/stat").read_text(encoding="utf-8").rpartition(")")[2].split()[0]


def parts_of(pid):
    """The components of a run that shares its session, as a shell's jobs do."""
    def parent_of(process):
        stat = pathlib.Path(f"/proc/{process}/stat").read_text(encoding="utf-8")
        return int(stat.rpartition(")")[2].split()[1])

    return {stage: part for stage, part in components_of(os.getsid(pid)).items()
            if parent_of(part) == pid}


class Launched:
    """A run under way, in a session or only a group of its own, and what it says meanwhile."""

    def __init__(self, arguments, as_job=False, **options):
        own = {"process_group": 0} if as_job else {"start_new_session": True}
        self.process = start(arguments, **own, **options)
        self.pid = self.process.pid
        self.lines = []
        self.thread = threading.Thread(target=self.read)
        self.thread.start()

    def read(self):
        for line in self.process.stderr:
            self.lines.append(line)

    @property
    def err(self):
        return "".join(self.lines)

    def says(self, text):
        return wait_until(lambda: text in self.err)

    def wait(self):
        """What it printed; its last line is the report."""
        self.process.wait(60)
        self.thread.join(20)
        return self.process.stdout.read()

    def close(self):
        if self.process.poll() is None:
            self.process.kill()
        self.wait()
        self.process.stdout.close()
        self.process.stderr.close()


class Ros2Robot(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))
        (self.folder / "world.yaml").write_text(WORLD, encoding="utf-8")
        self.ros_domain, self.domain = free_domains(2)

    def graph(self, **settings):
        settings = {"namespace": "r1", "timeout_s": 0.3, **settings}
        text = ", ".join(f"{key}: {value}" for key, value in settings.items())
        (self.folder / "graph.yaml").write_text(GRAPH.format(settings=text), encoding="utf-8")
        return "graph.yaml"

    def meet(self, program, pose=START, more=()):
        robot = Robot(program, self.ros_domain, pose, more=more)
        self.addCleanup(robot.close)
        return robot

    def environment(self):
        return {**os.environ, "ROS_DOMAIN_ID": str(self.ros_domain)}

    def launch(self, *arguments, as_job=False, **settings):
        run = Launched(["run", self.graph(**settings), "--domain", self.domain, "--json",
                        *arguments], as_job, cwd=self.folder, env=self.environment())
        self.addCleanup(run.close)
        return run

    def finish(self, run, status=0):
        out = run.wait()
        self.assertEqual(run.process.returncode, status, out + run.err)
        return json.loads(out.splitlines()[-1])

    def check_stands(self, robot):
        """The robot was told to stand, and does, and has touched nothing."""
        self.assertTrue(wait_until(lambda: robot.is_told(moving=False)), robot.commands[-3:])
        self.assertTrue(wait_until(lambda: robot.where()[3:5] == [0, 0]))
        self.assertEqual(robot.where()[5], 0)

    def check_arrives(self, robot, run):
        self.assertEqual(self.finish(run)["outcome"], "reached", run.err)
        self.check_stands(robot)
        x, y = robot.where()[:2]
        # It rolls out after the tick in which it arrives.
        self.assertLess(((x - TARGET[0]) ** 2 + (y - TARGET[1]) ** 2) ** 0.5, 0.5)

    def check_goes_on(self, robot, run):
        """It moves again; that it can arrive is known. The run is told to end."""
        self.assertTrue(wait_until(lambda: robot.is_told(moving=True)), run.err)
        os.kill(run.pid, signal.SIGINT)
        self.check_stands(robot)
        self.finish(run, status=130)

    def test_a_robot_on_cyclone_dds_reaches_its_target_and_replays_exactly(self):
        robot = self.meet("cyclone_robot")

        self.check_arrives(robot, self.launch("--record", "run.mcap"))

        replay = Run(["replay", "run.mcap", "--json"], cwd=self.folder)
        self.assertEqual(replay.status, 0, replay.out + replay.err)
        self.assertTrue(replay.report["identical"])
        self.assertIn("sense is a robot of ROS 2", replay.err)
        refused = Run(["replay", "run.mcap", "--component", "drive"], cwd=self.folder)
        self.assertNotEqual(refused.status, 0)
        self.assertIn("drive was a robot of ROS 2: what it told is in the recording", refused.err)

    def test_a_robot_on_fast_dds_with_a_wrong_clock_and_losses_reaches_it_too(self):
        robot = self.meet("fastdds_robot")
        robot.order("skew -3600")
        robot.order("loss 20")
        run = self.launch(middleware="fastdds", command="twist_stamped", distro="humble")
        self.assertTrue(wait_until(lambda: robot.is_told(moving=True)), run.err)

        robot.order("skew 3600")  # as when ntp sets it

        self.check_arrives(robot, run)

    def test_a_robot_that_is_not_heard_is_told_to_stand_still(self):
        robot = self.meet("cyclone_robot")
        robot.order("scan off")
        run = self.launch(middleware="fastdds")  # each vendor understands the other
        # What the bridge says of this run must not be taken for the robot's own word.
        bridge = Launched(["bridge", "ros2", "--domain", self.domain, "--namespace", "r1"],
                          env=self.environment())
        self.addCleanup(bridge.close)
        self.assertTrue(bridge.says("ROS domain"), run.err)
        robot.order("scan on")
        self.assertTrue(wait_until(lambda: robot.is_told(moving=True)), run.err)

        for count, (order, topic) in enumerate(
                (("scan off", "scan"), ("scan frozen", "scan"), ("odom off", "odom")), 1):
            robot.order(order)
            said = f"nothing new on /r1/{topic} for "
            self.assertTrue(wait_until(lambda: run.err.count("the robot is told to stand still")
                                       == count and said in run.err), order + run.err)
            self.assertTrue(wait_until(lambda: robot.where()[3:5] == [0, 0]), order)
            robot.order(topic + " on")
            self.assertTrue(wait_until(lambda: run.err.count("the robot is heard again") == count),
                            order + run.err)

        self.check_goes_on(robot, run)

    def test_a_robot_may_be_started_anew(self):
        robot = self.meet("cyclone_robot")
        run = self.launch()
        self.assertTrue(wait_until(lambda: robot.is_told(moving=True)), run.err)
        pose = robot.where()[:3]
        robot.close()

        second = self.meet("cyclone_robot", pose)

        self.check_goes_on(second, run)

    def test_a_robot_that_stays_silent_ends_the_run(self):
        robot = self.meet("cyclone_robot")
        run = self.launch(give_up_s=1)
        self.assertTrue(wait_until(lambda: robot.is_told(moving=True)), run.err)

        robot.order("scan off")

        self.assertEqual(self.finish(run, status=1)["outcome"], "aborted")
        self.assertIn("drive: nothing new on /r1/scan for 1 s", run.err)
        self.check_stands(robot)

    def test_however_the_run_ends_the_robot_stands(self):
        for number, victim in ((signal.SIGINT, None), (signal.SIGKILL, None),
                               (signal.SIGKILL, "drive"), (signal.SIGSTOP, "drive"),
                               (signal.SIGKILL, "control")):
            with self.subTest(signal=number.name, of=victim or "the run"):
                robot = self.meet("cyclone_robot")
                run = self.launch()
                self.assertTrue(wait_until(lambda: robot.is_told(moving=True)), run.err)
                pid = components_of(run.pid)[victim] if victim else run.pid

                os.kill(pid, number)

                self.check_stands(robot)
                run.wait()
                robot.close()

    def test_a_robot_whose_scans_come_late_touches_nothing(self):
        robot = self.meet("cyclone_robot")
        robot.order("lag 5")  # 0.25 s, in which it goes 0.2 m

        self.check_arrives(robot, self.launch(timeout_s=0.6))

    def test_the_place_of_the_laser_must_be_known(self):
        robot = self.meet("cyclone_robot", more=["no-mount"])

        run = Run(["run", self.graph(), "--domain", self.domain], cwd=self.folder,
                  environment=self.environment())

        self.assertEqual(run.status, 1, run.out)
        self.assertIn("lacks where 'r1/laser' is on 'r1/base_link' in /tf_static and /tf (or give "
                      "laser_x_m, laser_y_m and laser_heading_deg)", run.err)
        self.assertEqual(robot.commands, [])

        self.check_goes_on(robot, self.launch(laser_x_m=0.05, laser_y_m=0, laser_heading_deg=0))

    def test_the_last_word_is_said_several_times(self):
        robot = self.meet("cyclone_robot")
        run = self.launch()
        self.assertTrue(wait_until(lambda: robot.is_told(moving=True)), run.err)

        os.kill(components_of(run.pid)["drive"], signal.SIGKILL)

        # Drive, which told it to go, says no more; what is heard now are sense's last words.
        self.assertTrue(wait_until(lambda: robot.where()[7] >= 5), robot.places[-1])
        self.check_stands(robot)
        run.wait()

    def test_a_supervisor_that_is_stopped_leaves_the_robot_to_the_watchdog_of_drive(self):
        for number in (signal.SIGTSTP, signal.SIGSTOP):
            with self.subTest(signal=number.name):
                robot = self.meet("cyclone_robot")
                # A group that no shell looks after would not be stopped by SIGTSTP.
                run = self.launch(as_job=True)
                self.assertTrue(wait_until(lambda: robot.is_told(moving=True)), run.err)
                parts = parts_of(run.pid)
                self.assertEqual(set(parts), {"sense", "recover", "control", "drive"})

                os.killpg(run.pid, number)  # as Ctrl-Z does

                self.assertTrue(wait_until(lambda: state_of(run.pid) == "T"))
                self.check_stands(robot)
                self.assertNotIn("T", {state_of(pid) for pid in parts.values()})
                # Nobody goes on without it, however long that lasts.
                commands = len(robot.commands)
                heard = robot.where()[6]
                self.assertTrue(wait_until(lambda: robot.where()[6] > heard + 20))
                self.assertEqual(len(robot.commands), commands)

                os.killpg(run.pid, signal.SIGCONT)
                self.check_goes_on(robot, run)
                robot.close()

    def test_while_the_run_is_paused_the_robot_stands(self):
        robot = self.meet("cyclone_robot")
        run = self.launch()
        self.assertTrue(wait_until(lambda: robot.is_told(moving=True)), run.err)

        paused = Run(["pause", self.domain])

        self.assertEqual(paused.status, 0, paused.err)
        self.check_stands(robot)
        resumed = Run(["resume", self.domain])
        self.assertEqual(resumed.status, 0, resumed.err)
        self.check_goes_on(robot, run)

    def test_the_goal_may_be_changed_on_the_way(self):
        robot = self.meet("cyclone_robot")
        run = self.launch("--record", "run.mcap")
        self.assertTrue(wait_until(lambda: robot.is_told(moving=True)), run.err)

        goal = Run(["goal", self.domain, 0.7, 2.3, 0.15])
        self.assertEqual(goal.status, 0, goal.err)

        self.assertEqual(self.finish(run)["outcome"], "reached", run.err)
        self.check_stands(robot)
        x, y = robot.where()[:2]
        self.assertLess(((x - 0.7) ** 2 + (y - 2.3) ** 2) ** 0.5, 0.5)
        replay = Run(["replay", "run.mcap", "--json"], cwd=self.folder)
        self.assertEqual(replay.status, 0, replay.out + replay.err)

    def test_what_is_missing_or_wrong_is_named(self):
        run = Run(["run", self.graph(), "--domain", self.domain], cwd=self.folder,
                  environment=self.environment())
        self.assertEqual(run.status, 1, run.out)
        self.assertIn(f"the robot is not there: ROS domain {self.ros_domain} on 127.0.0.1 lacks "
                      "/r1/scan, /r1/odom, a reader of /r1/cmd_vel", run.err)
        for arguments, settings, words in (
                (["--pace", "2x"], {}, "--pace: a robot of ROS 2 takes part; allowed: realtime"),
                ([], {"scna": "x"}, "ros2 of drive: unknown key of ros2 'scna' (did you mean 'scan'"),
                (["--layout", "composed"], {}, "has ros2: a robot is a process"),
                (["--with", "drive=differential"], {}, "allowed: unicycle"),
                (["--domain", self.ros_domain], {}, "is the run's own: ROS needs another one")):
            run = Run(["run", self.graph(**settings), *arguments], cwd=self.folder,
                      environment=self.environment())
            self.assertEqual(run.status, 2, run.err)
            self.assertIn(words, run.err)
        bench = Run(["bench", "smoke", "--graph", self.folder / self.graph(), "--out",
                     self.folder / "bench"], environment=self.environment())
        self.assertEqual(bench.status, 2, bench.out)
        self.assertRegex(bench.err, "graph.yaml:[0-9]+:[0-9]+: (sense|drive) has ros2: a robot runs "
                                    "once, in real time; a bench takes graphs whose robot is simulated")


if __name__ == "__main__":
    unittest.main()
