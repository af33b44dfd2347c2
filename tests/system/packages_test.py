# SPDX-License-Identifier: Apache-2.0
"""The Debian packages, as somebody gets them: the same from two builds in two folders, and enough for a
newcomer on a machine with nothing but Debian 12 on it. Takes two whole builds: tools/soak runs it, as root."""
import json
import os
import pathlib
import shutil
import subprocess
import tempfile
import unittest

from clew_command import CLEW, Run, SOAK, SOURCE

TIMEOUT_S = 7200
MIRROR = os.environ.get("CLEW_DEBIAN_MIRROR", "http://deb.debian.org/debian")
PACKAGES = ("clew", "libclew-dev", "python3-clew")

PYTHON = """
import json
import clew
result = clew.run("default", record="python.mcap")
path_m = clew.Recording("python.mcap")["state"]["path_length_m"]
print(json.dumps({"hash": result.hash, "samples": len(path_m)}))
"""


def call(*command, **options):
    """Runs a program that must succeed; returns what it printed."""
    done = subprocess.run([str(word) for word in command], capture_output=True, text=True, check=False,
                          timeout=TIMEOUT_S, stdin=subprocess.DEVNULL, **options)
    if done.returncode != 0:
        raise AssertionError(f"{command} ended with {done.returncode}:\n"
                             f"{done.stdout[-4000:]}{done.stderr[-4000:]}")
    return done.stdout


class BareDebian:
    """A Debian 12 in a folder, with what every Debian has, and a user `somebody`."""

    def __init__(self, folder):
        self.folder = folder
        call("debootstrap", "--variant=minbase", "bookworm", folder, MIRROR)
        shutil.copy("/etc/resolv.conf", folder / "etc/resolv.conf")
        self.as_root("useradd --create-home somebody")

    def as_root(self, script):
        """Runs a shell script there; what it mounts and starts is gone when it ends."""
        enter = ('mount --rbind /dev "$1/dev" && mount -t tmpfs none "$1/dev/shm" && '
                 'mount -t proc none "$1/proc" && exec chroot "$1" /bin/sh -ec "$2"')
        return call("unshare", "--mount", "--pid", "--fork", "--kill-child", "sh", "-c", enter, "sh",
                    self.folder, script, env={"PATH": "/usr/sbin:/usr/bin:/sbin:/bin", "LC_ALL": "C.UTF-8",
                                              "DEBIAN_FRONTEND": "noninteractive"})

    def as_user(self, script):
        """Runs a shell script in the home of `somebody`."""
        (self.folder / "home/somebody/script").write_text(f"set -e\n{script}\n", encoding="utf-8")
        return self.as_root("exec su - somebody -c 'sh ./script'")

    def install(self, *packages):
        self.as_root("apt-get update -qq && apt-get install -qq --no-install-recommends "
                     + " ".join(packages) + " >/dev/null")


class PackagesTest(unittest.TestCase):
    """All tests look at the packages of one build, in one bare Debian."""

    @classmethod
    def setUpClass(cls):
        if not SOAK:
            raise unittest.SkipTest("SKIPPED: builds Clew twice; tools/soak runs it")
        if os.geteuid() != 0:
            raise RuntimeError("debootstrap needs root: run tools/soak as root")
        cls.scratch = tempfile.TemporaryDirectory(prefix="clew-packages-")
        cls.addClassCleanup(cls.scratch.cleanup)
        cls.folder = pathlib.Path(cls.scratch.name)
        cls.packages = cls.build("one")
        cls.debian = BareDebian(cls.folder / "root")
        for name, package in cls.packages.items():
            shutil.copy(package, cls.folder / "root" / f"{name}.deb")
        cls.debian.install(*(f"/{name}.deb" for name in PACKAGES), "g++", "cmake", "make")
        cls.ours = Run(["run", "default", "--layout", "composed", "--json"], command=CLEW).report

    @classmethod
    def build(cls, folder):
        """The packages that tools/package, which refuses errors of lintian, makes of a clone in `folder`."""
        clone, out = cls.folder / folder, cls.folder / f"packages-{folder.replace('/', '-')}"
        call("git", "clone", "-q", SOURCE, clone)
        call("tools/package", out, cwd=clone, env={**os.environ, "CCACHE_DISABLE": "1"})
        shutil.rmtree(clone)
        found = {path.name.split("_")[0]: path for path in out.glob("*.deb")}
        assert sorted(found) == sorted(PACKAGES), found
        return found

    def test_two_builds_in_two_folders_give_the_same_bytes(self):
        others = self.build("another/folder/of_another_length")

        for name in PACKAGES:
            self.assertEqual(self.packages[name].read_bytes(), others[name].read_bytes(), name)

    def test_the_demo_runs_there_and_gives_our_hash(self):
        printed = self.debian.as_user("clew run default --record u-trap.mcap --json\n"
                                      "clew plot u-trap.mcap -o u-trap.svg >/dev/null\n"
                                      "clew report u-trap.mcap -o u-trap.html >/dev/null\n"
                                      "test -s u-trap.svg && test -s u-trap.html\n"
                                      "clew replay u-trap.mcap >/dev/null")

        self.assertEqual(json.loads(printed.splitlines()[0])["hash"], self.ours["hash"])

    def test_a_plug_in_is_written_built_checked_and_run_there(self):
        printed = self.debian.as_user(
            "clew new detector far_from_home >/dev/null\n"
            "cmake -S far_from_home -B far_from_home/build >/dev/null\n"
            "cmake --build far_from_home/build >/dev/null\n"
            "ctest --test-dir far_from_home/build --output-on-failure >/dev/null\n"
            "clew check-plugin far_from_home/build/libfar_from_home.so >/dev/null\n"
            "clew run far_from_home/graph.yaml --plugin far_from_home/build/libfar_from_home.so --json")

        self.assertEqual(json.loads(printed)["outcome"], "reached")

    def test_a_python_script_runs_there_and_gives_our_hash(self):
        (self.debian.folder / "home/somebody/mine.py").write_text(PYTHON, encoding="utf-8")
        printed = json.loads(self.debian.as_user("python3 mine.py"))

        self.assertEqual(printed, {"hash": self.ours["hash"], "samples": self.ours["ticks"] + 1})


if __name__ == "__main__":
    unittest.main()
