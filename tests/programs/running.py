"""Runs `./launch/fsi` with the real programs in a scratch folder, and looks at what it starts and leaves behind."""

import contextlib
import json
import os
import signal
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

ROOT = Path(os.environ.get("FSI_ROOT") or Path(__file__).resolve().parents[2])
BIN = Path(os.environ.get("FSI_BIN") or ROOT / "build" / "release" / "bin")
FSI = ROOT / "launch" / "fsi"
WATCHDOG = 900.0  # [s] nothing here takes as long on any machine: who waits for so long waits for ever

# Steps so small that no machine comes to the end of the run while a test lasts: it is in its middle whenever something is done
# to it. It has one output behind it after ten steps.
LONG = ("elastic_piston", "--set", "grid.factor=2", "--set", "time.dt=1e-7", "--set", "output.times=[1e-6, 0.8]",
        "--set", "expect={}")

sys.path.insert(0, str(ROOT / "launch"))
from fsi_launch.living import processes  # noqa: E402

# A shell starts what runs in its background with SIGINT ignored, and so would everything below.
signal.signal(signal.SIGINT, signal.default_int_handler)


def until(condition):
    """Waits for `condition()` to hold; returns its value, false where it never does."""
    return processes.until(condition, WATCHDOG)


def let_pass(seconds):
    """Time in which nothing must happen. What a test says about it holds however slow the machine is; it never stands for the
    time that something takes."""
    time.sleep(seconds)


# A launcher that waits for programs to end by themselves instead of ending them after a while, or when it is asked again.
PATIENT = ("from fsi_launch.living import supervise\n"
           "supervise.GRACE = supervise.AFTER_STOP = supervise.STOP_GRACE = supervise.ASKED_AGAIN = 1e6\n")


class Launched:
    """A running `./launch/fsi run`; its results go to `directory`, or where the arguments say if `out` is None. `script`: lines of
    Python that the launcher executes before. `before`: words before its command."""

    def __init__(self, folder, *arguments, out="run", script=None, before=()):
        self.before = before
        self.directory = folder / (out or "")
        self.runtime = folder / "runtime"
        self.runtime.mkdir(exist_ok=True)
        main = "import sys\nfrom fsi_launch.command import cli\nsys.exit(cli.main(sys.argv[1:]))"
        begin = [str(FSI)] if script is None else ["/usr/bin/python3", "-s", "-B", "-c", f"{script}\n{main}"]
        command = [*before, *begin, "run", *arguments, *(["--out", str(self.directory)] if out else [])]
        environment = os.environ | {"FSI_BIN": str(BIN), "XDG_RUNTIME_DIR": str(self.runtime), "PYTHONPATH": str(ROOT / "launch")}
        self.process = subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                                        stderr=subprocess.PIPE, encoding="utf-8", errors="surrogateescape", env=environment,
                                        cwd=folder)
        self.stdout = self.stderr = ""

    def wait(self):
        """Exit code, once it has ended."""
        self.stdout, self.stderr = self.process.communicate(timeout=WATCHDOG)
        return self.process.returncode

    def until_stepping(self):
        """Waits until steps are being taken; returns the programs."""
        assert until(lambda: self.written() > 2000), "the run does not get going"
        return self.programs()

    def until_further(self, size=5000):
        """Waits until more steps have been taken."""
        before = self.written()
        assert until(lambda: self.written() > before + size), "the run does not go on"

    def until_paused(self):
        """Waits until a run with --pause-at has come there; returns the programs."""
        assert until(lambda: " paused after " in self.log(self.speaker)), "the run does not pause"
        return self.programs()

    speaker = "coupler"

    def log(self, name):
        """What a program has logged so far."""
        path = self.directory / "log" / f"{name}.log"
        return path.read_text(encoding="utf-8", errors="replace") if path.is_file() else ""

    def written(self):
        """Bytes of the table that has a line per step."""
        table = self.directory / "interface.csv"
        return table.stat().st_size if table.is_file() else 0

    def table(self):
        """Its lines."""
        return (self.directory / "interface.csv").read_text(encoding="utf-8").splitlines()

    def ctl(self, word):
        """Asks the run for something."""
        environment = os.environ | {"FSI_BIN": str(BIN), "XDG_RUNTIME_DIR": str(self.runtime)}
        subprocess.run([*self.before, str(FSI), "ctl", str(self.directory), word], check=True, env=environment, timeout=WATCHDOG,
                       capture_output=True, stdin=subprocess.DEVNULL)

    def checkpoints(self):
        """Steps of its whole sets."""
        return sorted(int(path.parent.name) for path in self.directory.glob("checkpoints/*/manifest.json"))

    def part(self, name):
        """What a program has left."""
        return json.loads((self.directory / "parts" / f"{name}.json").read_text(encoding="utf-8"))

    def programs(self):
        """{executable: pid} of its living programs."""
        return {program.program: program.pid for program in processes.programs_of(self.directory)}

    def summary(self):
        return json.loads((self.directory / "summary.json").read_text(encoding="utf-8"))

    def leftovers(self):
        """What should be gone after a run: processes and the entry in the registry."""
        return [*self.programs(), *(path.name for path in self.runtime.rglob("*.json"))]


class EndToEnd(unittest.TestCase):
    """Each test gets an empty folder; runs still going on when it ends are killed. `before`: of their commands."""

    before = ()

    def setUp(self):
        scratch = tempfile.TemporaryDirectory(prefix="fsi-test-")
        self.addCleanup(scratch.cleanup)
        self.folder = Path(scratch.name)
        self.launched = []

    def launch(self, *arguments, out="run", script=None):
        run = Launched(self.folder, *arguments, out=out, script=script, before=self.before)
        self.launched.append(run)
        self.addCleanup(self._end, run)
        return run

    def complete(self, *arguments, out="run"):
        """A run that must end well."""
        run = self.launch(*arguments, out=out)
        self.assertEqual(run.wait(), 0, run.stdout + run.stderr)
        return run

    def _end(self, run):
        for one in self.launched:   # first all launchers: one that sees its programs die ends the run, and writes
            if one.process.poll() is None:
                one.process.kill()
                one.process.wait()
        for pid in run.programs().values():
            with contextlib.suppress(ProcessLookupError):
                os.kill(pid, signal.SIGKILL)
        until(lambda: not run.programs())   # which may still write into a folder that is being taken away
        for pipe in (run.process.stdout, run.process.stderr):
            pipe.close()

    def assert_as_undisturbed(self, run):
        """Stops a run of LONG, which whoever looked at it or spoke to it has changed in no digit of how both sides differ, at no step."""
        run.ctl("stop")
        self.assertEqual(run.wait(), 0, run.stderr)
        alone = self.launch(*LONG, out="alone")
        self.assertTrue(until(lambda: alone.written() > run.written()))
        alone.ctl("stop")
        self.assertEqual(alone.wait(), 0, alone.stderr)
        self.assertEqual(run.table(), alone.table()[:len(run.table())])

    def assert_nothing_left(self, run):
        until(lambda: not run.leftovers())
        self.assertEqual(run.leftovers(), [])
