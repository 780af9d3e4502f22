"""`fsi faults`: signals to the programs of a run at random moments, many times. After each one the run must have ended
as it should (or gone on), with nothing left behind, and its restart must give the numbers of a run that was never
disturbed."""

import collections
import concurrent.futures
import contextlib
import json
import os
import random
import shutil
import signal
import subprocess
import tempfile
import time
from dataclasses import asdict, dataclass, field
from pathlib import Path

from fsi_launch import paths
from fsi_launch.results import restart, whole_file
from fsi_launch.failure import DONE, EXPECTATION_MISSED, Failure, INTERNAL_ERROR
from fsi_launch.living import ranks
from fsi_launch.living.processes import programs_of, until
from fsi_launch.living.supervise import leashed
from fsi_launch.telling import AS_NAMED, tell

PEER_TIMEOUT = 4.0      # [s] of the runs: a stopped program is lost after it
STOP_FOR = 1.0          # [s] and goes on as if nothing had been
WATCHDOG = 900.0        # [s] nothing here takes so long: what does hangs
CASE = ("elastic_piston", "--set", "grid.factor=2", "--set", "time.dt=1e-3", "--set", "output.every=0.1",
        "--set", "output.checkpoint_every=40", "--set", f"time.peer_timeout={PEER_TIMEOUT:g}", "--set", "expect={}")
PROGRAMS = {"fluid": "fluid_solver", "solid": "solid_solver_linear_elastic", "coupler": "coupler"}

# What is done to whom, and how it ends (exit code; 0: the run goes on to its end). How long that takes is told, not judged: it says
# more about the machine. What is judged is that nobody had to be killed.
FAULTS = {
    "kill a program": ("SIGKILL", PROGRAMS, 4),
    "kill the launcher": ("SIGKILL", ["launcher"], -signal.SIGKILL),
    "stop a program": ("SIGSTOP", PROGRAMS, 4),
    "stop and continue a program": ("SIGCONT", PROGRAMS, 0),
    "stop and continue the launcher": ("SIGCONT", ["launcher"], 0),
    "terminate a program": ("SIGTERM", PROGRAMS, 4),
    "terminate the launcher": ("SIGTERM", ["launcher"], 143),
    "interrupt a program": ("SIGINT", PROGRAMS, 4),
    "interrupt the launcher": ("SIGINT", ["launcher"], 130),
}


@dataclass
class Trial:
    """One fault and what came of it. `flaws`: what should not have happened."""

    number: int
    fault: str
    target: str
    after: float                # [s] from the start of the run to the signal
    code: int = None
    seconds: float = None       # from the signal to the end of everything
    restarted: str = "no checkpoint yet"
    late: bool = False          # the run was over before the signal came
    flaws: list = field(default_factory=list)


class Run:
    """A run of the launcher in a folder of its own."""

    def __init__(self, folder, *arguments):
        self.folder = folder
        runtime = folder.parent / "runtime"
        runtime.mkdir(exist_ok=True)
        self.process = subprocess.Popen(
            leashed([str(paths.ROOT / "launch" / "fsi"), "run", *arguments]), stdin=subprocess.DEVNULL,
            stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, **AS_NAMED, cwd=folder.parent,
            env=os.environ | {"FSI_BIN": str(paths.BIN), "XDG_RUNTIME_DIR": str(runtime)})
        self.words = ""

    def wait(self):
        """Exit code."""
        _, self.words = self.process.communicate(timeout=WATCHDOG)
        return self.process.returncode

    def programs(self):
        """{participant: pid} of its living programs."""
        return {program.name: program.pid for program in programs_of(self.folder)}

    def end_all(self):
        """Whatever is left after a flaw."""
        for pid in [*self.programs().values(), *([self.process.pid] if self.process.poll() is None else [])]:
            os.kill(pid, signal.SIGKILL)
        self.process.wait()


def results(directory):
    """{path: content} of all files of a run that do not depend on the time of day."""
    skipped = ("log/", "checkpoints/", "parts/", "case.yaml", "summary.json")
    return {name: path.read_bytes() for path in sorted(directory.rglob("*")) if path.is_file()
            and not (name := path.relative_to(directory).as_posix()).startswith(skipped)
            and not name.endswith(".part")}


def _unreadable(directory):
    """What of the output does not open."""
    import h5py
    for path in directory.glob("*.h5"):
        try:
            with h5py.File(path) as file:
                outputs = sum("t" in output.attrs for output in file.values())
                # What is written once at the end, whole, is no series.
                if outputs != (len(file) if path.name == "reference.h5" else file.attrs["outputs"]):
                    yield f"{path.name} lacks outputs"
        except (OSError, KeyError) as error:
            yield f"{path.name} does not open: {error}"
    for path in directory.glob("*.csv"):
        lines = path.read_text(encoding="utf-8").splitlines()
        if any(line.count(",") != lines[0].count(",") for line in lines):
            yield f"{path.name} has half a line"


def _as_a_shell_says(code):
    """128 + the signal's number for a launcher that was interrupted before it had begun with anything."""
    return 128 - code if code in (-signal.SIGINT, -signal.SIGTERM) else code


def _reason(directory):
    return json.loads((directory / "summary.json").read_text(encoding="utf-8"))["reason"]


def _shared_memory():
    """Of this user, without that of ranks: the runs here have none, other runs may."""
    found = set()
    for entry in ranks.SHARED.iterdir():
        with contextlib.suppress(FileNotFoundError):
            if not entry.name.startswith(ranks.FOLDER) and entry.lstat().st_uid == os.getuid():
                found.add(entry.name)
    return found


# --- one trial


def _signal(run, trial):
    """Does it; returns the moment, or None where the target is gone already."""
    kind = FAULTS[trial.fault][0]
    pid = run.process.pid
    if trial.target != "launcher":
        until(lambda: run.programs() or run.process.poll() is not None, WATCHDOG)
        pid = run.programs().get(trial.target)
    if pid is None or run.process.poll() is not None:
        return None
    moment = time.monotonic()
    try:
        if kind == "SIGCONT":
            os.kill(pid, signal.SIGSTOP)
            time.sleep(STOP_FOR)
            os.kill(pid, signal.SIGCONT)
        else:
            os.kill(pid, signal.Signals[kind])
    except ProcessLookupError:
        return None
    return moment


def _check_end(run, trial, before):
    _, _, code = FAULTS[trial.fault]
    if trial.code != code:
        trial.flaws.append(f"exit code {trial.code}, not {code}: {run.words.strip()[-300:]}")
    others = [name for name in PROGRAMS if name != trial.target and code == 4]
    if killed := [name for name in others if not (run.folder / "parts" / f"{name}.json").is_file()]:
        trial.flaws.append(f"did not end by themselves: {killed}")
    if left := run.programs():
        trial.flaws.append(f"left behind: {left}")
    if trial.fault != "kill the launcher" and (entries := list((run.folder.parent / "runtime").rglob("*.json"))):
        trial.flaws.append(f"left in the registry: {entries}")
    if left := _shared_memory() - before:
        trial.flaws.append(f"left in /dev/shm: {left}")
    if code == 4 and trial.target not in (reason := _reason(run.folder)):
        trial.flaws.append(f"the reason does not name {trial.target}: {reason}")
    trial.flaws += _unreadable(run.folder)


def _check_restart(run, trial, undisturbed):
    if trial.code == 0:
        trial.restarted = "not needed"
        again = run
    elif restart.latest(run.folder) is None:
        return
    else:
        again = Run(run.folder, "--restart", str(run.folder))
        code = again.wait()
        trial.restarted = "yes"
        if code != 0:
            trial.flaws.append(f"restart: exit code {code}: {again.words.strip()[-300:]}")
            again.end_all()
            return
    now = results(again.folder)
    if now.keys() != undisturbed.keys():
        trial.flaws.append(f"other files: {sorted(now.keys() ^ undisturbed.keys())}")
    if differing := [name for name in now if now[name] != undisturbed.get(name)]:
        trial.flaws.append(f"not the same bits: {differing}")


def _try(trial, folder, undisturbed):
    """One run, one fault."""
    place = folder / f"trial{trial.number}"
    place.mkdir()
    before = _shared_memory()
    patient = ["--set", "time.peer_timeout=600"] if FAULTS[trial.fault][0] == "SIGCONT" else []
    run = Run(place / "run", *CASE, *patient, "--out", str(place / "run"))
    try:
        time.sleep(trial.after)
        moment = _signal(run, trial)
        trial.code = _as_a_shell_says(run.wait())
        until(lambda: not run.programs(), WATCHDOG)
        over = trial.code == 0 and FAULTS[trial.fault][2] != 0      # who has done all there was to do minds no signal
        trial.late = moment is None or over
        trial.seconds = None if trial.late else time.monotonic() - moment
        if not trial.late:
            _check_end(run, trial, before)
        if not trial.late or over:
            _check_restart(run, trial, undisturbed)
    except (subprocess.TimeoutExpired, OSError) as error:
        trial.flaws.append(str(error))
    finally:
        run.end_all()
        if not trial.flaws:
            shutil.rmtree(place)
    return trial


# --- the campaign


def _trials(count, seed, duration):
    """Every fault in turn, targets and moments at random."""
    choice = random.Random(seed)
    for number in range(count):
        fault = list(FAULTS)[number % len(FAULTS)]
        yield Trial(number, fault, choice.choice(list(FAULTS[fault][1])), choice.uniform(0.1, 0.95) * duration)


def table(trials):
    """Lines of text: one row per fault."""
    rows = [("fault", "times", "flawless", "longest end [s]", "restarts, bits the same")]
    for fault, (_, _, code) in FAULTS.items():
        mine = [trial for trial in trials if trial.fault == fault and not trial.late]
        ends = [trial.seconds for trial in mine if code]
        rows.append((fault, str(len(mine)), str(sum(not trial.flaws for trial in mine)),
                     f"{max(ends):.1f}" if ends else "-" if code else "goes on",
                     str(sum(trial.restarted == "yes" and not trial.flaws for trial in mine)) if code else "-"))
    widths = [max(len(row[k]) for row in rows) for k in range(len(rows[0]))]
    return ["  ".join(cell.ljust(w) if k == 0 else cell.rjust(w) for k, (cell, w) in enumerate(zip(row, widths)))
            for row in rows]


def _undisturbed(folder):
    """(results, seconds) of a run that nothing happens to."""
    start = time.monotonic()
    run = Run(folder / "undisturbed", *CASE, "--out", str(folder / "undisturbed"))
    if run.wait() != 0:
        raise Failure(INTERNAL_ERROR, f"the undisturbed run fails: {run.words}")
    return results(run.folder), time.monotonic() - start


def main(options):
    """Runs the campaign; exit 0 where nothing was wrong."""
    folder = Path(tempfile.mkdtemp(prefix="fsi-faults-"))
    undisturbed, duration = _undisturbed(folder)
    done = []
    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        tasks = [pool.submit(_try, trial, folder, undisturbed)
                 for trial in _trials(options.count, options.seed, duration)]
        for task in concurrent.futures.as_completed(tasks):
            trial = task.result()
            done.append(trial)
            for flaw in trial.flaws:
                tell(f"trial {trial.number}, {trial.fault} ({trial.target}) after {trial.after:.2f} s: {flaw}")
    done.sort(key=lambda trial: trial.number)
    flawed = [trial for trial in done if trial.flaws]
    print("\n".join(table(done)))
    late = sum(trial.late for trial in done)
    print(f"{len(done)} trials, seed {options.seed}: {len(flawed)} with flaws, {late} too late to hit anything; "
          f"restarts: {dict(collections.Counter(trial.restarted for trial in done if not trial.late))}")
    if options.out:
        whole_file.write(options.out, json.dumps([asdict(trial) for trial in done], indent=1) + "\n")
    if flawed:
        tell(f"fsi: what the flawed runs left is in {folder}")
        return EXPECTATION_MISSED
    shutil.rmtree(folder)
    return DONE
