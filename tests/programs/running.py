"""Runs `./launch/fsi` with the real programs in a scratch folder, and looks at what it starts and leaves behind."""

import json
import os
import signal
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(os.environ.get("FSI_ROOT") or Path(__file__).resolve().parents[2])
BIN = Path(os.environ.get("FSI_BIN") or ROOT / "build" / "release" / "bin")
FSI = ROOT / "launch" / "fsi"
WATCHDOG = 120.0  # [s] nothing here may take longer

sys.path.insert(0, str(ROOT / "launch"))
from fsi_launch import processes  # noqa: E402


def until(condition, seconds=30.0):
    """Waits for `condition()` to hold; returns its value, false after `seconds`."""
    return processes.until(condition, seconds)


class Launched:
    """A running `./launch/fsi run`; its results go to `directory`, or where the arguments say if `out` is None."""

    def __init__(self, folder, *arguments, out="run"):
        self.directory = folder / (out or "")
        self.runtime = folder / "runtime"
        self.runtime.mkdir(exist_ok=True)
        command = [str(FSI), "run", *arguments, *(["--out", str(self.directory)] if out else [])]
        environment = os.environ | {"FSI_BIN": str(BIN), "XDG_RUNTIME_DIR": str(self.runtime)}
        self.process = subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                                        stderr=subprocess.PIPE, text=True, env=environment, cwd=folder)
        self.stdout = self.stderr = ""

    def wait(self):
        """Exit code, once it has ended."""
        self.stdout, self.stderr = self.process.communicate(timeout=WATCHDOG)
        return self.process.returncode

    def until_stepping(self):
        """Waits until steps are being taken; returns the programs."""
        table = self.directory / "interface.csv"
        assert until(lambda: table.is_file() and table.stat().st_size > 2000), "the run does not get going"
        return self.programs()

    def programs(self):
        """{executable: pid} of its living programs."""
        return {program.program: program.pid for program in processes.programs_of(self.directory)}

    def summary(self):
        return json.loads((self.directory / "summary.json").read_text(encoding="utf-8"))

    def leftovers(self):
        """What should be gone after a run: processes and the entry in the registry."""
        return [*self.programs(), *(path.name for path in self.runtime.rglob("*.json"))]


class EndToEnd(unittest.TestCase):
    """Each test gets an empty folder; runs still going on when it ends are killed."""

    def setUp(self):
        scratch = tempfile.TemporaryDirectory(prefix="fsi-test-")
        self.addCleanup(scratch.cleanup)
        self.folder = Path(scratch.name)

    def launch(self, *arguments, out="run"):
        run = Launched(self.folder, *arguments, out=out)
        self.addCleanup(self._end, run)
        return run

    def complete(self, *arguments, out="run"):
        """A run that must end well."""
        run = self.launch(*arguments, out=out)
        self.assertEqual(run.wait(), 0, run.stdout + run.stderr)
        return run

    def _end(self, run):
        if run.process.poll() is None:
            run.process.kill()
        for pid in run.programs().values():
            os.kill(pid, signal.SIGKILL)
        for pipe in (run.process.stdout, run.process.stderr):
            pipe.close()
        run.process.wait()

    def assert_nothing_left(self, run):
        until(lambda: not run.leftovers(), 5)
        self.assertEqual(run.leftovers(), [])
