# SPDX-License-Identifier: Apache-2.0
"""Whom tools/chaos breaks, and small disks: what is no matter of a case."""
import os
import pathlib
import subprocess


def processes_of(session):
    """Process ids of a session that are not zombies, with the words of each."""
    found = {}
    for entry in pathlib.Path("/proc").iterdir():
        if not entry.name.isdigit():
            continue
        try:
            fields = (entry / "stat").read_text().rsplit(")", 1)[1].split()
            if int(fields[3]) == session and fields[0] != "Z":
                found[int(entry.name)] = (entry / "cmdline").read_bytes().decode().split("\0")
        except (OSError, IndexError):
            continue
    return found


def victims_of(session):
    """Process ids by stage; `recorder`, and `run` for the supervisor."""
    found = {}
    for pid, words in processes_of(session).items():
        if "component" in words[1:2]:
            found[words[3]] = pid
        elif words[1:2] in (["recorder"], ["run"]):
            found[words[1]] = pid
    return found


def send(pid, number):
    try:
        os.kill(pid, number)
    except (ProcessLookupError, TypeError):
        pass  # it has ended, or was never there


class SmallDisk:
    """A file system of its own for a recording, if the case has a full disk."""

    def __init__(self, folder, fault):
        self.folder, self.fault = folder, fault

    def __enter__(self):
        if self.fault:
            subprocess.run(["mount", "-t", "tmpfs", "-o", f"size={self.fault['size_k']}k", "tmpfs",
                            self.folder], check=True)

    def __exit__(self, *_):
        if self.fault:
            subprocess.run(["umount", "--lazy", self.folder], check=True)

    @staticmethod
    def enlarge(folder):
        subprocess.run(["mount", "-o", "remount,size=256m", folder], check=True)
