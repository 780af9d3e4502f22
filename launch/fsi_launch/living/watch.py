"""`fsi run --monitor`: the monitor in front of the run it belongs to."""

import contextlib
import subprocess
import sys

from fsi_launch import paths

LEAVES_WITHIN = 15.0    # [s] after the end of the run, by itself or at a key


class Monitor:
    """The monitor on this terminal while the context is open. Without a terminal, or when it is left, the run goes on with
    the progress bar alone."""

    def __init__(self, run, say):
        self._run = run
        self._say = say
        self._process = None

    def __enter__(self):
        if sys.stdin.isatty() and sys.stdout.isatty():
            self._process = subprocess.Popen([paths.program("monitor"), self._run])
        else:
            self._say("--monitor needs a terminal; the run goes on without it")
        return self

    def in_front(self):
        """Does it have the terminal?"""
        if self._process is None:
            return False
        if (code := self._process.poll()) is None:
            return True
        self._process = None
        self._say(f"the monitor has ended{f' with exit code {code}' if code else ''}; the run goes on")
        return False

    def wait(self):
        """The run is over: shows its end until a key is pressed, but not for long."""
        if self._process:
            with contextlib.suppress(subprocess.TimeoutExpired, KeyboardInterrupt):
                self._process.wait(LEAVES_WITHIN)

    def __exit__(self, *_):
        if self._process and self._process.poll() is None:
            self._process.terminate()   # it gives the terminal back
            try:
                self._process.wait(LEAVES_WITHIN)
            except subprocess.TimeoutExpired:
                self._process.kill()
                self._process.wait()
