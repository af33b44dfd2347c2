# SPDX-License-Identifier: Apache-2.0
"""Recordings of which something is missing: what info says of them, and how far they are replayed."""
import os
import pathlib
import signal
import tempfile
import unittest

from clew_command import Run, components_of, run_graph, start, wait_until

# Opcodes of MCAP records.
CHUNK, MESSAGE_INDEX, ATTACHMENT, DATA_END = 0x06, 0x07, 0x09, 0x0F
MAGIC = b"\x89MCAP0\r\n"


def without_records(mcap, opcodes, after=0):
    """The file without its summary, and without the records of these kinds behind so many chunks."""
    kept = MAGIC
    place = len(MAGIC)
    chunks = 0
    while mcap[place] != DATA_END:
        end = place + 9 + int.from_bytes(mcap[place + 1:place + 9], "little")
        chunks += mcap[place] == CHUNK
        if mcap[place] not in opcodes or (after and chunks <= after):
            kept += mcap[place:end]
        place = end
    data_end = bytes([DATA_END]) + (4).to_bytes(8, "little") + bytes(4)  # of no CRC
    footer = b"\x02" + (20).to_bytes(8, "little") + bytes(20)  # of no summary
    return kept + data_end + footer + MAGIC


class Partial(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.directory = pathlib.Path(scratch.name)

    def ran(self, arguments, status):
        run = Run(arguments)
        self.assertEqual(run.status, status, run.out + run.err)
        return run

    def start_recording(self, recording, at_least, *arguments):
        """A run over which the recording has grown to so many bytes."""
        process = start(["run", "krishna_kalra", *arguments, "--record", recording],
                        start_new_session=True)
        growing = pathlib.Path(f"{recording}.tmp~")
        self.assertTrue(wait_until(lambda: growing.exists() and growing.stat().st_size > at_least))
        return process


class Records(Partial):
    def setUp(self):
        super().setUp()
        whole = self.directory / "whole.mcap"
        run_graph("reactive", "--world", "comb", "--max-ticks", "150", "--layout", "composed",
                  "--record", whole)
        self.whole = whole.read_bytes()

    def test_a_recording_without_the_files_of_its_run(self):
        bare = self.directory / "bare.mcap"
        bare.write_bytes(without_records(self.whole, [ATTACHMENT]))

        info = self.ran(["info", bare, "--json"], 1).report

        self.assertFalse(info["complete"])
        self.assertIn("graph", info["cannot_be_replayed"])
        self.assertIn("bare.mcap: cannot be replayed: the bundle has no", self.ran(["info", bare], 1).out)
        self.assertIn("the bundle has no", self.ran(["replay", bare], 2).err)

    def test_a_recording_whose_last_ticks_are_gone_though_not_its_end(self):
        short = self.directory / "short.mcap"
        short.write_bytes(without_records(self.whole, [CHUNK, MESSAGE_INDEX],
                                          after=6))

        info = self.ran(["info", short, "--json"], 1).report

        self.assertFalse(info["complete"])
        self.assertEqual(info["missing_samples"], (151 - info["ticks"]) * len(info["topics"]))
        self.assertIn(f"short.mcap: lacks the last {151 - info['ticks']} ticks",
                      self.ran(["info", short], 1).out)


class Aborted(Partial):
    def replay_of_a_run_with_frozen_control(self, recording):
        process = self.start_recording(recording, 30_000, "--pace", "realtime",
                                       "--set", "drive.tick_s=0.05", "--force")
        os.kill(components_of(process.pid)["control"], signal.SIGSTOP)
        process.communicate(timeout=20)
        replay = self.ran(["replay", recording, "--json"], 0)

        self.assertEqual(process.returncode, 1)
        self.assertTrue(replay.report["identical"])
        self.assertIn("is of a run that was aborted (control", replay.err)
        return {one["component"]: one["ticks"] for one in replay.report["components"]}

    def test_in_real_time_after_the_last_command_of_a_frozen_control(self):
        # It is killed after two seconds, through which the others go on. A machine that stands
        # still for those two seconds lets nobody go on: hence more than one try.
        recording = self.directory / "frozen.mcap"
        for _ in range(3):
            ticks = self.replay_of_a_run_with_frozen_control(recording)
            if ticks["drive"] > ticks["control"] + 20:
                return
        self.fail(f"drive did not go on without control: {ticks}")

    def test_of_an_interrupted_run_goes_up_to_the_interrupt(self):
        for layout in (["--layout", "processes"], ["--layout", "composed"]):
            recording = self.directory / "interrupted.mcap"
            process = self.start_recording(recording, 100_000, "--with", "recover.detector=none",
                                           "--pace", "50x", "--max-ticks", "1000000", "--json",
                                           "--force", *layout)

            os.kill(process.pid, signal.SIGINT)
            out, _ = process.communicate(timeout=20)
            info = self.ran(["info", recording, "--json"], 0).report
            replay = self.ran(["replay", recording, "--json"], 0)

            self.assertEqual(process.returncode, 130)
            self.assertIn('"lost_samples":0', out)
            self.assertEqual(info["missing_samples"], 0)
            self.assertIn("interrupted by signal 2", info["aborted"])
            self.assertIn("the run was aborted: interrupted", self.ran(["info", recording], 0).out)
            self.assertTrue(replay.report["identical"])
            self.assertGreater(min(one["ticks"] for one in replay.report["components"]), 20)
            self.assertIn("aborted (interrupted by signal 2", replay.err)


if __name__ == "__main__":
    unittest.main()
