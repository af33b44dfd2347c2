# SPDX-License-Identifier: Apache-2.0
"""clew bench on Slurm: real daemons, a node that is lost, cancelled and gone on with, and the bytes
of one worker."""
import json
import pathlib
import signal
import tempfile
import time
import unittest

from bench_shards_test import files_of
from clew_command import CLEW, SOAK, Run, load_tool, start, wait_until, write_file

slurm_cluster = load_tool("slurm-cluster")

SUITE = f"""format: clew-suite/1
graphs: [krishna_kalra]
vary: {{sense.noise_stddev_m: [0.01, 0.03]}}
generated: {{seed: 5, count: {12 if SOAK else 2}, families: [u, comb]}}
seeds: {{first: 1, count: {100 if SOAK else 40}}}
max_ticks: 4000
"""
WHOLE_S = 3600 if SOAK else 100


def lines_in(folder):
    """Runs that all shards have so far."""
    return sum(max(0, path.read_bytes().count(b"\n") - 1)
               for path in (folder / "shards").glob("*/results.jsonl"))


def soon(condition):
    """Whether it came true within a minute; leaves the processor to what is waited for."""
    return wait_until(lambda: condition() or time.sleep(0.02), 60)


def without_shards(directory):
    return {name: content for name, content in files_of(directory).items()
            if not name.startswith("shards/")}


class Slurm(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        missing = slurm_cluster.missing()
        assert not missing, f"tools/install-packages test; not installed: {missing}"
        cls.scratch = tempfile.TemporaryDirectory()
        cls.folder = pathlib.Path(cls.scratch.name)
        cls.suite = write_file(SUITE)
        cls.one = cls.folder / "one"
        done = Run(["bench", cls.suite, "--jobs", "1", "--out", cls.one], timeout_s=WHOLE_S)
        assert done.status == 0, done.err
        cls.first = done
        cls.runs = len((cls.one / "results.jsonl").read_text().splitlines()) - 1
        cls.cluster = slurm_cluster.SlurmCluster()
        cls.addClassCleanup(cls.scratch.cleanup)
        cls.addClassCleanup(cls.cluster.stop)

    def bench(self, out, *arguments):
        return Run(["bench", self.suite, "--on", "slurm", "--out", out, *arguments],
                   environment=self.cluster.environment, timeout_s=WHOLE_S)

    def test_a_sweep_outlives_a_node_and_its_own_command(self):
        out = self.folder / "sweep"
        process = start(["bench", self.suite, "--on", "slurm", "--out", out, "--shards", "6"],
                        env={**self.cluster.environment})
        with self.subTest("a node is lost in the middle"):
            self.assertTrue(soon(lambda: lines_in(out) > self.runs // 10))
            self.cluster.kill_node("n2")
            self.assertLess(lines_in(out), self.runs)
        with self.subTest("Ctrl-C cancels the array"):
            self.assertTrue(soon(lambda: lines_in(out) > self.runs // 4))
            process.send_signal(signal.SIGINT)
            _, err = process.communicate(timeout=60)
            self.assertEqual(process.returncode, 130, err)
            self.assertRegex(err, r"Slurm array \d+: 6 of 6 shards")
            self.assertRegex(err, r"array \d+ is cancelled; the same command goes on")
            self.assertLess(lines_in(out), self.runs)
        self.cluster.start_node("n2")
        with self.subTest("the command dies, the array does not"):
            process = start(["bench", self.suite, "--on", "slurm", "--out", out],
                            env={**self.cluster.environment})
            self.assertTrue(soon(lambda: lines_in(out) > self.runs // 2))
            process.kill()
            _, err = process.communicate()
            self.assertRegex(err, r"Slurm array \d+: ")

            done = self.bench(out)

            self.assertEqual(done.status, 0, done.err)
            self.assertRegex(done.err, r"array \d+ is still in the queue: going on with it")
        self.assertEqual(without_shards(out), without_shards(self.one))
        self.assertEqual(done.out.replace(str(out), str(self.one)), self.first.out)

    def test_a_shard_that_cannot_run_is_told_with_its_last_words(self):
        out = self.folder / "broken"
        broken = self.folder / "broken.yaml"
        broken.write_text(SUITE)
        process = start(["bench", broken, "--on", "slurm:small", "--shards", "2", "--out", out],
                        env={**self.cluster.environment})
        self.assertTrue(soon((out / "shards/job").exists))
        broken.write_text("format: clew-suite/1\n")

        _, err = process.communicate(timeout=90)

        self.assertEqual(process.returncode, 2, err)
        self.assertRegex(err, r"shard [12]/2 ended 3 times without another run; its log ends: .*"
                              r"broken.yaml.*'graphs'")
        self.assertEqual(self.cluster.jobs(), [])

    def test_the_cost_is_told_beforehand(self):
        done = self.bench(self.folder / "dry", "--dry-run", "--json")

        self.assertEqual(done.status, 0, done.err)
        cost = json.loads(done.out)
        # Two a core of the four cores of both nodes, or of the one that is left.
        self.assertIn((cost["tasks"], cost["cores_at_once"]), [(8, 4), (4, 2)])
        self.assertEqual(cost["runs"], self.runs)
        self.assertEqual(self.cluster.jobs(), [])
        self.assertFalse((self.folder / "dry").exists())

    def test_a_partition_that_is_not_there_is_refused(self):
        done = Run(["bench", self.suite, "--on", "slurm:large", "--out", self.folder / "refused"],
                   environment=self.cluster.environment)

        self.assertEqual(done.status, 2, done.err)
        self.assertIn("--on: there is no partition 'large'", done.err)

    def test_without_slurm_the_package_is_named(self):
        tools = self.folder / "tools"
        tools.mkdir()
        (tools / "clew").symlink_to(CLEW)

        done = Run(["bench", self.suite, "--on", "slurm", "--out", self.folder / "none"],
                   environment={"PATH": str(tools)})

        self.assertEqual(done.status, 2)
        self.assertIn("sinfo: cannot be started: No such file or directory; is Slurm installed here",
                      done.err)


if __name__ == "__main__":
    unittest.main()
