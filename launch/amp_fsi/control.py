"""Starts runs and steers them, through the same command that a person types."""

import contextlib
import json
import os
import subprocess
import sys
import time
from pathlib import Path

from amp_fsi.results import Run
from fsi_launch import paths
from fsi_launch.living import processes, registry
from fsi_launch.failure import EXPECTATION_MISSED
from fsi_launch.results import new_folder
from fsi_launch.telling import AS_NAMED

POLL = 0.05     # [s] between two looks


class RunFailed(RuntimeError):
    """A run that did not end well. `code`: the exit code of `fsi run` (docs/output.md); `run`: what is there of it, or None."""

    def __init__(self, code, message, run=None):
        super().__init__(message)
        self.code, self.run = code, run


def _command():
    """launch/fsi of the checkout: the one these modules lie in, or the one AMP_FSI_HOME names."""
    home = Path(os.environ.get("AMP_FSI_HOME") or paths.ROOT)
    command = home / "launch" / "fsi"
    if not command.is_file():
        raise FileNotFoundError(f"no launch/fsi in '{home}': set AMP_FSI_HOME to the folder AMP-FSI was cloned to")
    return str(command)


def _plain(value):
    """Numbers and arrays of numpy as Python has them."""
    if not hasattr(value, "tolist"):
        raise TypeError(f"{value!r} is no value of a case: write a number, a text, a list or a dict of these")
    return value.tolist()


def _text(value):
    """A value as a case file has it."""
    return value if isinstance(value, str) else json.dumps(value, default=_plain)


def _list(values, text=str):
    """Several with commas between them; what is one text already stays."""
    return values if isinstance(values, str) else ",".join(map(text, values))


def _words(case, set, solids):
    words = [str(case)] + [f"--set={key}={_text(value)}" for key, value in (set or {}).items()]
    return words + [f"--solid={name}={law}" for name, law in (solids or {}).items()]


def _folder(case, out):
    if out is not None:
        return Path(out)
    return new_folder.claimed(Path(str(case)).stem)


def _moment(directory):
    """When its summary was written [ns], or None."""
    path = directory / "summary.json"
    return path.stat().st_mtime_ns if path.is_file() else None


class Running:
    """A run that goes on."""

    def __init__(self, process, directory, former=None):
        self.process, self.directory = process, directory
        self._former = former   # moment of the summary that was there before
        self._said = None   # on stderr, when it has ended

    def state(self):
        """What its programs said last: status, t, step, dt, participants, interfaces .. (docs/output.md)."""
        answer = self._ask("monitor", str(self.directory), "--once", "--json")
        return json.loads(answer)

    def pause(self):
        """Asks it to wait after the present step."""
        self._ask("ctl", str(self.directory), "pause")

    def resume(self):
        """Asks it to go on."""
        self._ask("ctl", str(self.directory), "resume")

    def checkpoint(self):
        """Asks for a checkpoint, from which `start(restart=..)` goes on."""
        self._ask("ctl", str(self.directory), "checkpoint")

    def stop(self):
        """Asks it to write a checkpoint and to end; wait() returns its Run."""
        self._ask("ctl", str(self.directory), "stop")

    def going(self):
        """True until it has ended."""
        return self.process.poll() is None

    def until(self, condition, poll=POLL):
        """Waits until `condition()` holds or the run has ended; returns what the condition gave."""
        while not (value := condition()) and self.going():
            time.sleep(poll)
        return value

    def wait(self, check=True):
        """The Run when it has ended. @raises RunFailed unless it completed or was stopped on request, or `check` is false"""
        if self._said is None:
            self._said = self.process.communicate()[1].strip().splitlines()
        said = self._said
        there = (self.directory / "case.yaml").is_file()
        run = Run(self.directory) if there else None
        # A restart that is refused leaves the summary of the run before it.
        status = run.summary.get("status") if run and _moment(self.directory) != self._former else None
        well = self.process.returncode == 0 or (self.process.returncode == EXPECTATION_MISSED and status in ("completed", "stopped"))
        if check and not well:
            reason = "\n".join(line.removeprefix("fsi: ") for line in said if line.startswith("fsi: ")) or "\n".join(said[-3:])
            raise RunFailed(self.process.returncode, reason, run)
        return run

    def _ask(self, *words):
        answer = subprocess.run([_command(), *words], stdin=subprocess.DEVNULL, capture_output=True, **AS_NAMED, check=False)
        if answer.returncode != 0:
            raise RunFailed(answer.returncode, answer.stderr.strip().removeprefix("fsi: "))
        return answer.stdout


def start(case=None, *, set=None, solids=None, out=None, restart=None, overwrite=False):
    """Starts a run and returns at once when it has been accepted. `case`: a file, or a name in configs/. `set`: {key of the case:
    value}. `solids`: {solid: law}. `out`: folder of the results (by default a new one in runs/). `restart`: folder of a run to go
    on with. @returns Running @raises RunFailed where the case is wrong"""
    directory = Path(restart) if restart else _folder(case, out)
    words = ["run", *(_words(case, set, solids) if case else _words("", set, solids)[1:])]
    words += ["--restart", str(restart)] if restart else ["--out", str(directory)]
    words += ["--overwrite"] if overwrite else []
    former = _moment(directory)
    process = subprocess.Popen([_command(), *words, "--no-progress"], stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                               stderr=subprocess.PIPE, **AS_NAMED)
    running = Running(process, directory, former)
    running.until(lambda: registry.running_in(directory) == process.pid and processes.programs_of(directory))
    if not running.going():
        try:
            running.wait()
        finally:
            with contextlib.suppress(OSError):
                directory.rmdir()   # that of a run which was refused: it is empty
    return running


def run(case=None, **options):
    """Makes a run from its beginning to its end; options as for start(). @returns Run @raises RunFailed"""
    return start(case, **options).wait()


def study(case, vary, *, set=None, solids=None, show=(), jobs=1, out=None):
    """A case with every combination of values (`fsi study`). `vary`: {key of the case: values}. `show`: quantities of the table, or one of
    them. @returns what study.json holds (docs/python.md) @raises RunFailed where a run failed; study.json has the table all the same"""
    directory = _folder(f"study-{Path(str(case)).stem}", out)
    words = ["study", *_words(case, set, solids), "--jobs", str(jobs), "--out", str(directory)]
    words += [f"--vary={key}={_list(values, _text)}" for key, values in vary.items()]
    words += ["--show", _list(show)] if show else []
    answer = subprocess.run([_command(), *words], stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, **AS_NAMED,
                            check=False)
    if answer.returncode != 0:
        raise RunFailed(answer.returncode, answer.stderr.strip())
    sys.stderr.write(answer.stderr)
    return json.loads((directory / "study.json").read_text(**AS_NAMED))
