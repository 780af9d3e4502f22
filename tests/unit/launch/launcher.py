"""Makes the launcher's modules importable, and gives tests a folder of their own and programs that wait for each other."""

import os
import select
import signal
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[3]
sys.path.insert(0, str(ROOT / "launch"))
from fsi_launch.case import Case  # noqa: E402

# The beginning of a script that stands for a program. `here(name)` says that it has come so far, `wait(names)` waits until others
# have said so.
SCRIPT = """
import os, pathlib, signal, sys, time
folder = pathlib.Path(%r)
def here(name):
    (folder / (name + ".here")).touch()
def wait(*names):
    while not all((folder / (name + ".here")).exists() for name in names):
        time.sleep(0.01)
def linger():
    time.sleep(0.5)
def rest():
    while True:
        time.sleep(1)
"""


def ended(pidfd):
    """Waits until a process has ended, and closes what it is known by."""
    signal.alarm(600)   # a watchdog: it would go on for ever
    select.select([pidfd], [], [])
    signal.alarm(0)
    os.close(pidfd)


def piston():
    """A Case of three programs."""
    programs = {"fluid": "fluid_solver", "solid": "solid_solver_linear_elastic", "coupler": "coupler"}
    return Case(name="piston", text="", programs=programs, reference="none", expect=[])


class InScratch(unittest.TestCase):
    """Each test gets an empty folder `self.folder` that is removed afterwards."""

    def setUp(self):
        scratch = tempfile.TemporaryDirectory(prefix="fsi-launch-")
        self.addCleanup(scratch.cleanup)
        self.folder = Path(scratch.name)

    def script(self, body):
        """A program that does what `body` says, with the words above."""
        return SCRIPT % str(self.folder) + body
