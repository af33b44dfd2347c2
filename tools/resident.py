# SPDX-License-Identifier: Apache-2.0
"""How much memory each process of a run takes at its peak."""
import pathlib
import subprocess
import tempfile
import time

# In this world nobody arrives, and without a detector nobody gives up: every run has all ticks.
ENDLESS = ["run", "krishna_kalra", "--world", "unsolvable-behind-wall", "--with", "recover.detector=none"]
# Samples come every few milliseconds; the last one before the end is near the peak.
PERIOD_S = 0.02


def command_line(pid):
    """The words of a process's command; none if it is gone."""
    try:
        return pathlib.Path(f"/proc/{pid}/cmdline").read_bytes().decode().split("\0")
    except OSError:
        return []


def session_of(pid):
    """The session of a process; none if it is gone."""
    try:
        return int(pathlib.Path(f"/proc/{pid}/stat").read_text().rsplit(")", 1)[1].split()[3])
    except (OSError, IndexError):
        return None


def role(pid):
    """What a process of a run is: `run`, `recorder`, or its stage; empty before it is any of these."""
    words = command_line(pid)
    # Between fork and exec a process has the words of the one that started it.
    if words[1:2] == ["component"] and len(words) > 3:
        return words[3]
    return words[1] if words[1:2] in (["run"], ["recorder"]) else ""


def peak_kib(pid):
    """The most memory that a process has had so far; none if it is gone."""
    try:
        status = pathlib.Path(f"/proc/{pid}/status").read_text(encoding="ascii")
    except OSError:
        return None
    lines = [line for line in status.splitlines() if line.startswith("VmHWM:")]
    return int(lines[0].split()[1]) if lines else None


def peaks_kib(clew, arguments):
    """The peak of each process of a run that ends at its last tick, by role; `clew` is the command."""
    # A pipe that nobody empties would hold up a run that says much.
    with tempfile.TemporaryFile("w+", encoding="utf-8", errors="replace") as said:
        process = subprocess.Popen([clew, *map(str, arguments)], stdin=subprocess.DEVNULL,
                                   stdout=subprocess.DEVNULL, stderr=said, start_new_session=True)
        peaks = {}
        while process.poll() is None:
            for pid in [int(entry.name) for entry in pathlib.Path("/proc").iterdir()
                        if entry.name.isdigit()]:
                peak = peak_kib(pid) if session_of(pid) == process.pid else None
                called = role(pid) if peak else ""
                if called:
                    peaks[called] = peak
            time.sleep(PERIOD_S)
        said.seek(0)
        assert process.returncode == 3, said.read()
    return peaks
