# SPDX-License-Identifier: Apache-2.0
"""An installation of the build tree in a folder of its own, and what others build against it."""
import os
import pathlib
import subprocess
import tempfile

from clew_command import CLEW, Run, SOURCE

BUILD = pathlib.Path(os.environ.get("CLEW_BUILD", SOURCE / "build"))
TIMEOUT_S = 300


def call(*command, cwd=None, environment=None):
    """Runs a program that must succeed."""
    done = subprocess.run([str(word) for word in command], capture_output=True, text=True,
                          timeout=TIMEOUT_S, cwd=cwd, check=False, stdin=subprocess.DEVNULL,
                          env={**os.environ, **(environment or {})})
    if done.returncode != 0:
        raise AssertionError(f"{command} ended with {done.returncode}:\n{done.stdout}{done.stderr}")
    return done.stdout


class Installation:
    """What `cmake --install` makes, and a folder to work in beside it."""

    def __init__(self):
        self._folder = tempfile.TemporaryDirectory(prefix="clew-installed-")
        self.work = pathlib.Path(self._folder.name)
        self.prefix = self.work / "prefix"
        call("cmake", "--install", BUILD, "--prefix", self.prefix)

    def close(self):
        """Removes all of it."""
        self._folder.cleanup()

    @property
    def command(self):
        """The installed command."""
        return str(self.prefix / "bin" / "clew")

    def clew(self, *arguments, environment=None):
        """Runs the installed command in the folder to work in."""
        return Run(arguments, command=self.command, cwd=self.work, environment=environment)

    def build(self, source, name):
        """Builds a project of somebody else against the installation; returns its build folder."""
        folder = self.work / "build" / name
        call("cmake", "-S", source, "-B", folder, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release",
             f"-DCMAKE_PREFIX_PATH={self.prefix}", "-DCMAKE_CXX_FLAGS=-Wall -Wextra -Werror")
        call("cmake", "--build", folder)
        return folder


def without_source_tree(*command, cwd):
    """Runs a program to which the source tree, with the build in it, is an empty folder."""
    script = 'mount -t tmpfs none "$1" && shift && exec "$@"'
    return call("unshare", "--map-root-user", "--mount", "sh", "-c", script, "sh", SOURCE, *command,
                cwd=cwd)


__all__ = ["BUILD", "CLEW", "Installation", "call", "without_source_tree"]
