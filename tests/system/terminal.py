# SPDX-License-Identifier: Apache-2.0
"""A command on a terminal, as a shell starts it: its own session, in the foreground."""
import fcntl
import os
import pty
import select
import subprocess
import termios
import time


class Terminal:
    """A pseudo-terminal; what is written to it are keys."""

    def __init__(self, kind="xterm"):
        self.kind = kind  # as TERM says it
        self.keys, self.end = pty.openpty()
        self.shown = b""

    def start(self, command, **streams):
        """Starts a command whose controlling terminal this is. Streams that are not named are on it,
        too."""
        streams = {"stdin": self.end, "stdout": self.end, "stderr": self.end, **streams}
        return subprocess.Popen(command, start_new_session=True, preexec_fn=take_terminal,
                                env={**os.environ, "TERM": self.kind}, **streams)

    def press(self, keys):
        """Types."""
        os.write(self.keys, keys)

    def read(self, seconds):
        """Waits for more to be shown; whether there was any."""
        ready, _, _ = select.select([self.keys], [], [], max(0.0, seconds))
        if ready:
            self.shown += os.read(self.keys, 4096)
        return bool(ready)

    def wait_for(self, text, seconds):
        """Reads what is shown until it has the text, from here on."""
        begin = len(self.shown)
        deadline = time.monotonic() + seconds
        while text not in self.shown[begin:]:
            assert self.read(deadline - time.monotonic()), f"no {text} in {self.shown}"

    def close(self):
        """Hangs up."""
        os.close(self.keys)
        os.close(self.end)


def take_terminal():
    """Makes stdin the controlling terminal of a new session, as a shell does."""
    fcntl.ioctl(0, termios.TIOCSCTTY, 0)
