# SPDX-License-Identifier: Apache-2.0
"""Runs the clew command as a user would, and looks at what it leaves behind."""
import contextlib
import importlib.machinery
import importlib.util
import json
import os
import pathlib
import socket
import subprocess
import tempfile
import time

SOURCE = pathlib.Path(__file__).resolve().parents[2]
CLEW = os.environ.get("CLEW_COMMAND", str(SOURCE / "build" / "clew"))
DEBUG_CLEW = os.environ.get("CLEW_DEBUG_COMMAND", str(SOURCE / "build-debug" / "clew"))
ASAN_CLEW = os.environ.get("CLEW_ASAN_COMMAND", str(SOURCE / "build-asan" / "clew"))
THIRD_PARTY = pathlib.Path(os.environ.get("CLEW_THIRD_PARTY", SOURCE / "build/tests/third_party"))
SOAK = os.environ.get("CLEW_SOAK") == "1"
# Other builds of the command, which must give the same bytes: tools/soak makes them. In tools/test the
# sanitized unit tests compare with the table of hashes (tests/replay/other_build_test.cpp).
OTHER_BUILDS = {"sanitized": ASAN_CLEW, "debug": DEBUG_CLEW} if SOAK else {}
# Of the libraries, not of ours: see tests/leaks_of_libraries.txt and cmake/ClewTests.cmake.
os.environ.setdefault("ASAN_OPTIONS", "new_delete_type_mismatch=0")
os.environ.setdefault("LSAN_OPTIONS",
                      f"suppressions={SOURCE / 'tests' / 'leaks_of_libraries.txt'}")
TIMEOUT_S = 120
# What a user keeps in a folder of his own changes no test, and no test writes there.
_NO_SETTINGS = tempfile.TemporaryDirectory(prefix="clew-no-settings-")
os.environ["XDG_CONFIG_HOME"] = _NO_SETTINGS.name

# Every way to run a graph, which must make no difference to a single byte.
LAYOUTS = {
    "composed": ["--layout", "composed"],
    "cyclonedds": ["--middleware", "cyclonedds"],
    "fastdds": ["--middleware", "fastdds"],
    "mixed": ["--middleware", "sense=fastdds", "--middleware", "recover=fastdds",
              "--middleware", "drive=fastdds"],
    "mixed the other way": ["--middleware", "classify=fastdds", "--middleware", "control=fastdds"],
}


def load_tool(name):
    """One of the project's Python programs, as a module."""
    loader = importlib.machinery.SourceFileLoader(name.replace("-", "_"),
                                                  str(SOURCE / "tools" / name))
    module = importlib.util.module_from_spec(
        importlib.util.spec_from_loader(loader.name, loader))
    loader.exec_module(module)
    return module


def layouts_of(graph):
    """The layouts, without what they say of stages that a shipped graph does not have."""
    stages = {line.split(":")[0] for line in
              (SOURCE / f"configs/graphs/{graph}.yaml").read_text(encoding="utf-8").splitlines()}

    def fits(option, value):
        return option != "--middleware" or "=" not in value or value.split("=")[0] in stages

    return {name: [word for option, value in zip(layout[::2], layout[1::2]) if fits(option, value)
                   for word in (option, value)]
            for name, layout in LAYOUTS.items()}


# Small and large, with and without traps.
WORLDS = ["bug-trap", "comb", "kk-fig07-clutter", "kk-fig10-bends-and-kinks",
          "kk-fig14-som-cannot-detect", "moving-crossing", "open-field", "two-rooms-door", "u-trap",
          "unsolvable-box"]


class Run:
    """A finished clew command."""

    def __init__(self, arguments, command=CLEW, cwd=None, environment=None, timeout_s=TIMEOUT_S):
        done = subprocess.run([command, *map(str, arguments)], capture_output=True, text=True,
                              timeout=timeout_s, cwd=cwd, stdin=subprocess.DEVNULL,
                              env={**os.environ, **(environment or {})}, check=False)
        self.status = done.returncode
        self.out = done.stdout
        self.err = done.stderr

    @property
    def report(self):
        """The JSON object that `run --json` prints last."""
        return json.loads(self.out.strip().splitlines()[-1])


def run_graph(graph, *arguments, command=CLEW):
    """clew run GRAPH --json with more arguments; returns the report."""
    done = Run(["run", graph, "--json", *arguments], command=command)
    assert done.out.strip(), f"no report, status {done.status}: {done.err}"
    return done.report


def start(arguments, **options):
    """Starts a clew command without waiting for it."""
    return subprocess.Popen([CLEW, *map(str, arguments)], text=True, stdin=subprocess.DEVNULL,
                            stdout=subprocess.PIPE, stderr=subprocess.PIPE, **options)


def processes_of_session(session):
    """Process ids of a session that are not zombies."""
    found = []
    for entry in pathlib.Path("/proc").iterdir():
        if not entry.name.isdigit():
            continue
        try:
            fields = (entry / "stat").read_text().rsplit(")", 1)[1].split()
        except (OSError, IndexError):
            continue
        if int(fields[3]) == session and fields[0] != "Z":
            found.append(int(entry.name))
    return found


def command_line(pid):
    """The words of a process's command; none if it is gone."""
    try:
        return pathlib.Path(f"/proc/{pid}/cmdline").read_bytes().decode().split("\0")
    except OSError:
        return []


def components_of(session):
    """Process ids of a session's component processes, by stage."""
    found = {}
    for pid in processes_of_session(session):
        words = command_line(pid)
        if "component" in words:
            found[words[words.index("component") + 2]] = pid
    return found


def recorder_of(session):
    """Process id of a session's recorder, if there is one."""
    for pid in processes_of_session(session):
        if command_line(pid)[1:2] == ["recorder"]:
            return pid
    return None


def wait_until(condition, seconds=20):
    """Whether the condition came true in time."""
    deadline = time.monotonic() + seconds
    while time.monotonic() < deadline:
        if condition():
            return True
    return False


def write_file(text, suffix=".yaml"):
    """A temporary file with this text; the caller's test removes its directory."""
    directory = tempfile.mkdtemp(prefix="clew-test-")
    path = pathlib.Path(directory) / f"file{suffix}"
    path.write_text(text)
    return path


def free_domains(count):
    """DDS domains on whose ports nobody listens."""
    found = []
    for domain in range(30, 100):
        with contextlib.closing(socket.socket(socket.AF_INET, socket.SOCK_DGRAM)) as probe:
            try:
                probe.bind(("127.0.0.1", 7400 + 250 * domain + 10))
            except OSError:
                continue
            found.append(domain)
            if len(found) == count:
                return found
    raise AssertionError("no free domains")
