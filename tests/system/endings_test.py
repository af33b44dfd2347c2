# SPDX-License-Identifier: Apache-2.0
"""However a run ends, no process is left, and the message says why."""
import os
import shutil
import signal
import subprocess
import tempfile
import time
import unittest

from clew_command import (CLEW, SOURCE, THIRD_PARTY, Run, command_line, components_of,
                          processes_of_session, wait_until, write_file)

IN_WORLD = ["--world", "unsolvable-behind-wall", "--json"]
GONE_WITHIN_S = 2.0


class LongRun:
    """A run that would last minutes, in a session of its own."""

    def __init__(self, *arguments, graph="krishna_kalra", pace="5x"):
        self.process = subprocess.Popen([CLEW, "run", graph, *IN_WORLD, "--pace", pace, *arguments], text=True,
                                        stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                                        stderr=subprocess.PIPE, start_new_session=True)
        self.session = self.process.pid

    def wait_for_components(self, count=5):
        """Process ids of the components by stage, when all have their participants."""
        def started():
            components = components_of(self.session)
            return len(components) == count and all(map(udp_sockets, components.values()))

        assert wait_until(started), "the components did not start"
        return components_of(self.session)

    def finish(self):
        out, err = self.process.communicate(timeout=20)
        return self.process.returncode, out, err

    def assert_nothing_left(self, test):
        wait_until(lambda: not processes_of_session(self.session), GONE_WITHIN_S)
        left = processes_of_session(self.session)
        for pid in left:
            os.kill(pid, signal.SIGKILL)
        test.assertEqual(left, [])


def treats(pid, number, how):
    """Whether the process has a handler for the signal ("SigCgt": it runs), or lets it wait
    ("SigBlk": it is about to)."""
    with open(f"/proc/{pid}/status", encoding="ascii") as file:
        mask = next(line for line in file if line.startswith(how))
    return bool(int(mask.split()[1], 16) >> (number - 1) & 1)


def udp_sockets(pid):
    """Whether the process has opened sockets: its participant lives."""
    try:
        links = [os.readlink(f"/proc/{pid}/fd/{fd}") for fd in os.listdir(f"/proc/{pid}/fd")]
    except OSError:
        return False
    return sum(link.startswith("socket:") for link in links) > 1


class Endings(unittest.TestCase):
    def test_interrupt_and_terminate_end_in_order(self):
        for number in (signal.SIGINT, signal.SIGTERM):
            for arguments in ([], ["--middleware", "fastdds"]):
                run = LongRun(*arguments)
                run.wait_for_components()

                os.kill(run.process.pid, number)
                status, out, err = run.finish()

                self.assertEqual(status, 130, err)
                self.assertIn('"outcome":"aborted"', out)
                self.assertIn(f"interrupted by signal {int(number)}", err)
                run.assert_nothing_left(self)

    def test_interrupt_of_a_composed_run(self):
        process = subprocess.Popen([CLEW, "run", "krishna_kalra", *IN_WORLD, "--pace", "5x", "--layout",
                                    "composed"], text=True,
                                   stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        self.assertTrue(wait_until(lambda: treats(process.pid, signal.SIGINT, "SigBlk")))

        process.send_signal(signal.SIGINT)
        out, err = process.communicate(timeout=10)

        self.assertEqual(process.returncode, 130, err)
        self.assertIn('"outcome":"aborted"', out)

    def test_an_aborted_run_says_where_it_was_and_compares_no_path(self):
        process = subprocess.Popen([CLEW, "run", "krishna_kalra", "--world", "open-field", "--pace",
                                    "5x", "--layout", "composed"], text=True,
                                   stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
        self.assertTrue(wait_until(lambda: treats(process.pid, signal.SIGINT, "SigBlk")))
        time.sleep(1.5)  # some ticks

        process.send_signal(signal.SIGINT)
        out = process.communicate(timeout=10)[0]

        self.assertRegex(out, r"aborted in open-field: \d+ ticks? .*, at \(-?\d")
        self.assertNotIn("x shortest", out)

    def test_a_signal_before_the_first_tick(self):
        circles = "\n".join(f"  - [{1 + i % 500 * 0.01}, {8 + i // 500 * 0.01}, 0.005]"
                            for i in range(50_000))
        world = write_file("format: clew-world/1\nname: many\nbounds: [0, 0, 10, 10]\n"
                           "start: [1, 1, 0]\ntarget: [9, 1]\ntarget_radius: 0.2\n"
                           f"circles:\n{circles}\n")
        for layout in ("composed", "processes"):
            process = subprocess.Popen([CLEW, "run", "reactive", "--world", world, "--json",
                                        "--layout", layout], text=True, stdout=subprocess.PIPE,
                                       stderr=subprocess.PIPE)
            self.assertTrue(wait_until(lambda: treats(process.pid, signal.SIGTERM, "SigBlk")))

            process.send_signal(signal.SIGTERM)
            out, err = process.communicate(timeout=60)

            self.assertEqual(process.returncode, 130, err)
            self.assertIn('"outcome":"aborted"', out)

    def test_a_component_that_crashes_again_and_again_is_named_with_its_signal(self):
        for victim in ("sense", "drive"):
            run = LongRun(pace="0.001x")  # no second tick while the test lasts
            deaths = 0
            while run.process.poll() is None and deaths < 10:
                pid = components_of(run.session).get(victim)
                if pid and udp_sockets(pid):
                    os.kill(pid, signal.SIGSEGV)
                    deaths += 1
                    wait_until(lambda: components_of(run.session).get(victim) != pid)
            status, out, err = run.finish()

            self.assertEqual(status, 1, err)
            self.assertIn("was killed by signal 11 (Segmentation fault); it does so every time",
                          err)
            self.assertIn('"outcome":"aborted"', out)
            run.assert_nothing_left(self)

    def test_a_component_of_someone_else_that_dies_is_named(self):
        graph = write_file("world: open-field\nrobot: disc-015\nsense: {behaviour: cones}\n"
                           f"control: {{exec: [{THIRD_PARTY}/straight_control, --without-guidance, "
                           "--crash-at, '5']}\ndrive: {behaviour: turn_then_step}\n")

        run = Run(["run", graph])

        self.assertEqual(run.status, 1)
        self.assertRegex(run.err, r"control \(process \d+\) was killed by signal 6 \(Aborted\)")

    def test_nobody_outlives_a_supervisor_that_is_killed(self):
        for arguments in ([], ["--middleware", "fastdds"]):
            run = LongRun(*arguments)
            run.wait_for_components()

            os.kill(run.process.pid, signal.SIGKILL)
            run.process.communicate(timeout=10)

            run.assert_nothing_left(self)

    def test_nobody_outlives_a_run_whom_a_component_of_someone_else_started(self):
        # A shell that waits for the component, as scripts that set up an environment do.
        graph = write_file("world: unsolvable-behind-wall\nrobot: disc-015\n"
                           "sense: {behaviour: cones}\ncontrol: {exec: [sh, -c, "
                           f"'{THIRD_PARTY}/straight_control --without-guidance & wait']}}\n"
                           "drive: {behaviour: turn_then_step}\n")
        for number in (signal.SIGKILL, signal.SIGTERM):
            run = LongRun(graph=graph)
            run.wait_for_components(2)
            self.assertTrue(wait_until(lambda: any("straight_control" in command_line(pid)[0]
                                                   for pid in processes_of_session(run.session))))

            os.kill(run.process.pid, number)
            run.process.communicate(timeout=10)

            run.assert_nothing_left(self)

    def test_a_missing_program_is_bad_input_with_its_place(self):
        graph = write_file("world: open-field\nrobot: disc-015\nsense: {behaviour: cones}\n"
                           "control: {exec: [./no-such-program]}\n"
                           "drive: {behaviour: turn_then_step}\n")

        run = Run(["run", graph])

        self.assertEqual(run.status, 2)
        self.assertIn(f"{graph}:4:10: exec of control: there is no program './no-such-program'",
                      run.err)

    def test_an_external_component_that_never_comes_does_not_hang_an_interrupt(self):
        run = LongRun("--external", "control")
        run.wait_for_components(4)

        os.kill(run.process.pid, signal.SIGINT)
        status, _, err = run.finish()

        self.assertEqual(status, 130)
        self.assertIn(f"{CLEW} component - control --domain", err)
        run.assert_nothing_left(self)


class External(unittest.TestCase):
    def test_a_person_starts_a_component(self):
        whole = Run(["run", "krishna_kalra", "--json"]).report["hash"]
        run = subprocess.Popen([CLEW, "run", "krishna_kalra", "--json", "--external", "control",
                                "--domain", "77"], text=True, stdout=subprocess.PIPE,
                               stderr=subprocess.DEVNULL)

        component = Run(["component", "krishna_kalra", "control", "--domain", "77"])
        out, _ = run.communicate(timeout=60)

        self.assertEqual(component.status, 0, component.err)
        self.assertIn(whole, out)

    def test_a_person_starts_it_anywhere_with_the_line_that_the_run_prints(self):
        directory = tempfile.mkdtemp(prefix="somebody's graphs ")
        self.addCleanup(shutil.rmtree, directory)
        shutil.copy(SOURCE / "configs/graphs/reactive.yaml", directory)
        run = subprocess.Popen([CLEW, "run", "./reactive.yaml", "--world", "open-field", "--json",
                                "--external", "control"], text=True, cwd=directory,
                               stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        line = run.stderr.readline()
        started = subprocess.run(line.split("start it with: ")[1], shell=True, cwd="/",
                                 env={"PATH": "/bin"}, timeout=60, capture_output=True, text=True,
                                 check=False)
        out, err = run.communicate(timeout=60)

        self.assertEqual(started.returncode, 0, line + started.stderr)
        self.assertEqual(run.returncode, 0, line + err)
        self.assertIn('"outcome":"reached"', out)

    def test_a_person_starts_a_program_of_someone_else_with_the_line_that_the_run_prints(self):
        directory = tempfile.mkdtemp(prefix="somebody's programs ")
        self.addCleanup(shutil.rmtree, directory)
        program = os.path.join(directory, "straight_control")
        os.symlink(THIRD_PARTY / "straight_control", program)
        graph = write_file("world: open-field\nrobot: disc-015\nsense: {behaviour: cones}\n"
                           f'control: {{exec: ["{program}", "--without-guidance"]}}\n'
                           "drive: {behaviour: turn_then_step}\n")
        run = subprocess.Popen([CLEW, "run", graph, "--json", "--external", "control"], text=True,
                               stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        line = run.stderr.readline()
        started = subprocess.Popen(line.split("start it with: ")[1], shell=True,
                                   start_new_session=True)
        out, err = run.communicate(timeout=60)
        os.killpg(started.pid, signal.SIGKILL)
        started.wait()

        self.assertEqual(run.returncode, 0, line + err)
        self.assertIn('"outcome":"reached"', out)

    def test_a_prefix_goes_before_the_component(self):
        run = Run(["run", "krishna_kalra", "--json", "--prefix", "control=env CLEW_TEST_PREFIX=1"])

        self.assertEqual(run.status, 0, run.err)
        self.assertEqual(run.report["outcome"], "reached")


if __name__ == "__main__":
    unittest.main()
