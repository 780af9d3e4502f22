"""`fsi run`: one case from its file to its summary."""

import contextlib
import json
import os
import shlex
import shutil
import subprocess
import sys
import time
from dataclasses import dataclass, field
from pathlib import Path

from fsi_launch import case as cases
from fsi_launch import paths
from fsi_launch.living import hosts, interrupts, ranks, registry
from fsi_launch.results import alone, folder, former, probes, replaced, restart, summary, verdict, whole_file
from fsi_launch.failure import (DONE, EXPECTATION_MISSED, Failure, INTERRUPTED, NUMBERS_BROKE, OUTPUT_FAILED, PEER_LOST, TERMINATED,
                                USER_MISTAKE, UserMistake)
from fsi_launch.living.progress import Progress
from fsi_launch.living.supervise import Outcome, Program, Supervisor
from fsi_launch.living.watch import Monitor
from fsi_launch.telling import AS_NAMED, tell


FRAMES = 60     # of a movie
COUPLER = "coupler"     # the participant of that name looks after the others


@dataclass
class Request:
    """What a person asks for."""

    case: str
    overrides: list = field(default_factory=list)
    laws: list = field(default_factory=list)
    out: str = None
    overwrite: bool = False
    restart: str = None     # folder of the run to go on with
    progress: bool = True
    monitor: bool = False   # in front, on a terminal
    pause_at: int = None    # after so many steps
    quiet: bool = False
    judge: bool = True      # hold the results against the case's expectations
    protection: str = None  # of the bus: off, sign or encrypt; None: sign, between machines encrypt
    ranks: str = None       # NAME=N,.. or auto: processes that compute a participant together
    hosts: str = None       # NAME=HOST,..: participants that run on other machines
    remote_shell: str = None    # how they are reached
    frames: bool = False    # output times for a movie besides those of the case, unless the overrides say how many


@dataclass
class Result:
    """What became of it."""

    code: int
    directory: Path
    summary: dict


# --- the programs


def _programs(case, directory, entry, checkpoint, reports, memory, request):
    """`reports`: {name: file in memory} for a copy of what each leaves. `memory`: of ranks on this machine."""
    asked = ranks.wanted(request.ranks, case)
    far = hosts.wanted(request.hosts, case)
    networks = hosts.networks(far)
    cores = ranks.cores({name: number for name, number in asked.items() if name not in far})
    for left in directory.glob("parts/*.rank*.json"):
        left.unlink(missing_ok=True)
    common = ["--case", str(directory / "case.yaml"), "--run-dir", str(directory), "--run", entry.run]
    if checkpoint:
        common += ["--restart", str(checkpoint.path)]
    own = {case.speaker(): [] if request.pause_at is None else ["--pause-at", str(request.pause_at)]}
    programs = []
    for name, program in case.programs.items():
        command, number = [paths.program(program), *common, "--name", name, *own.get(name, [])], asked.get(name, 1)
        environment = {"AMP_FSI_KEY": entry.key, "AMP_FSI_BIN": str(paths.BIN.resolve())} | (ranks.environment() if number > 1 else {})
        if number > 1 and name not in far:
            environment |= memory
        if networks:
            environment["AMP_FSI_NETWORK"] = networks[far[name].address if name in far else ""]
        programs.append(Program(
            name, command if number == 1 else ranks.command(command, number), listen=name == case.speaker(), environment=environment,
            report=reports[name], tell_pids=name == COUPLER, ranks=number, cores=cores.get(name),
            place=hosts.Place(far[name], request.remote_shell) if name in far else None))
    return programs


@contextlib.contextmanager
def _in_memory(names):
    """{name: descriptor of a file that no full disk stops}"""
    with contextlib.ExitStack() as stack:
        reports = {}
        for name in names:
            reports[name] = os.memfd_create(f"report of {name}")
            stack.callback(os.close, reports[name])
        yield reports


def _copies(reports):
    """{name: text of the report}"""
    return {name: os.pread(report, os.fstat(report).st_size, 0).decode("utf-8", "replace") for name, report in reports.items()}


def _reference(case, directory):
    """The program that computes this case's reference solution, if it has one of its own."""
    program = cases.REFERENCE_PROGRAMS.get(case.reference)
    if program is None:
        return []
    command = [paths.program(program), "--case", str(directory / "case.yaml"), "--run-dir", str(directory)]
    return [Program("reference", command)]


def _write_xdmf(directory):
    """DIR/run.xmf for ParaView."""
    answer = subprocess.run([paths.program("fsi_xdmf"), str(directory)], stdin=subprocess.DEVNULL,
                            capture_output=True, **AS_NAMED, check=False)
    if answer.returncode != 0:
        raise Failure(OUTPUT_FAILED, answer.stderr.strip() or "fsi_xdmf failed")


def _write_exact(case, directory):
    """DIR/reference.h5 of a run whose solution is known in formulas, at the places it computed."""
    if case.reference not in cases.EXACT_KINDS:
        return
    answer = subprocess.run([paths.program("reference_exact"), "--case", str(directory / "case.yaml"), "--run-dir", str(directory)],
                            stdin=subprocess.DEVNULL, capture_output=True, **AS_NAMED, check=False)
    if answer.returncode != 0:
        raise Failure(OUTPUT_FAILED, answer.stderr.strip() or "reference_exact failed")


def _finish(case, directory):
    """What the launcher adds to the results when the programs have ended, as far as it can be written. Returns the first Failure, or None."""
    failures = []
    for add in (lambda: probes.merge(directory, case.programs), lambda: _write_xdmf(directory), lambda: _write_exact(case, directory)):
        try:
            add()
        except Failure as failure:
            failures.append(failure)
        except OSError as error:
            failures.append(Failure(OUTPUT_FAILED, f"cannot write {error.filename or directory}: {error.strerror}; make room there, and the run can "
                                                   "go on from its last checkpoint"))
    return next(iter(failures), None)


# --- the whole


def _supervise(case, directory, programs, progress, tick):
    """Runs the reference program, then the programs of the run."""
    outcome = Outcome()
    for programs in (_reference(case, directory), programs):
        supervisor = Supervisor(directory / "log", progress.hear, tick)
        outcome = supervisor.run(programs)
        if outcome.signal or verdict.root_cause(outcome.endings):
            break
    return outcome


def _watched(case, directory, programs, run, request, say, checkpoint=None):
    """(Outcome of all programs, {t, steps} they last said), while a person sees how far they are. The former record of a run that goes
    on from a `checkpoint` counts until a step has been taken."""
    progress = Progress(request.progress and not request.quiet)
    with contextlib.ExitStack() as stack:
        monitor = stack.enter_context(Monitor(run, say)) if request.monitor else None

        def tick():
            if checkpoint and (progress.reached() or {"steps": 0})["steps"] > checkpoint.step:
                former.drop(directory)
            if monitor is None or not monitor.in_front():
                progress.tick()

        outcome = _supervise(case, directory, programs, progress, tick)
        if monitor and not outcome.signal:
            monitor.wait()
    progress.close()
    return outcome, progress.reached()


def needed(case):
    """The programs a run of this case takes, besides those of every run."""
    others = [cases.REFERENCE_PROGRAMS.get(case.reference),
              "reference_exact" if case.reference in cases.EXACT_KINDS else None,
              "fsi_credentials" if any("/" in program for program in case.programs.values()) else None]
    return [*case.programs.values(), "fsi_start", *filter(None, others)]


def _ranks_here(request, case):
    """Numbers of ranks of those who have several, on this machine."""
    far = hosts.wanted(request.hosts, case)
    return [number for name, number in ranks.wanted(request.ranks, case).items() if name not in far]


def _for_another_law(case, request, say):
    """What --set would say to leave out the expectations that an exact solution of the case's own law cannot meet with another one. They
    leave the case of the run itself, so that a restart does not judge by them either."""
    if not (request.laws and request.judge) or case.reference == "none" or case.reference in cases.REFERENCE_PROGRAMS:
        return []
    say("the reference solution is for the case's own law, this run has another law: its errors are not judged")
    kept = [entry for entry in case.expect if not entry["quantity"].startswith("errors.")]
    return ["expect={}", *(f"expect.{entry['quantity']}.{bound}={json.dumps(entry[bound])}"
                           for entry in kept for bound in ("min", "max", "equals") if entry[bound] is not None)]


def _resolved(request, say, path, own=None):
    """The checked Case, all of whose programs are there, built if need be."""
    case = cases.resolve(path, request.overrides, request.laws, own)
    more = _for_another_law(case, request, say)
    if request.frames and not any(entry.startswith("output.every") for entry in request.overrides):
        more.append(f"output.every={case.end / FRAMES:.17g}")
    if more:
        case = cases.resolve(path, [*request.overrides, *more], request.laws, own)
    paths.expect(case.programs)
    paths.build([*needed(case), *(["monitor"] if request.monitor else [])])
    ranks.expect_mpi(ranks.wanted(request.ranks, case))
    if far := hosts.wanted(request.hosts, case, request.ranks, request.protection):
        hosts.expect_shell(request.remote_shell)
        hosts.networks(far)
    if lack := ranks.lack_of_room(_ranks_here(request, case)):
        raise UserMistake(f"--ranks {request.ranks}: {lack}")
    return case


def _begin(request, say, until):
    """(Case, folder, folders that were made for it or None, checkpoint or None) of a run; the folder is there, and no other command works
    in it `until` the end of this contextlib.ExitStack."""
    if request.restart is None:
        if request.case is None:
            raise UserMistake("run: name a case, or a run with --restart DIR")
        case = _resolved(request, say, request.case)
        directory, made = folder.make(request.out, case.name, request.overwrite, until)
        checkpoint = None
    else:
        if request.out is not None or request.overwrite:
            raise UserMistake("--restart goes on in the folder of the run; leave --out and --overwrite away")
        directory, made = Path(request.restart), None
        until.enter_context(alone.at_work(directory, f"--restart {directory}", restart.REMEDY))
        restart.expect_run(directory)
        own = str(directory / "case.yaml")
        case = _resolved(request, say, request.case or own, own)
        checkpoint = restart.choose(directory, say, case.digest)
        restart.expect_ahead(checkpoint, case.end, request.pause_at)
        say(f"goes on from the checkpoint of step {checkpoint.step}, t = {checkpoint.t:.6g}")
        if case.end <= checkpoint.t * (1 + 1e-12):
            say("that is time.end: the run is complete; --set time.end=.. goes on to a later one")
        former.lay_aside(directory)
        (directory / "log").mkdir(exist_ok=True)    # somebody may have removed it
    return case, directory, made, checkpoint


def _write_case(case, directory):
    """DIR/case.yaml; one that is there is replaced."""
    whole_file.write(directory / "case.yaml", case.text)


def _look_around(far, case, directory, request):
    """All machines see what the programs need. Throws UserMistake."""
    ranked = ranks.wanted(request.ranks, case)
    programs = {name: [paths.program(program), paths.program("fsi_start"), *([shutil.which("mpirun")] if name in ranked else [])]
                for name, program in case.programs.items()}
    hosts.expect_all(far, request.remote_shell, directory, programs, ranked)


def run(request):
    """Runs a case to its end. Throws UserMistake before anything is started; everything later is in the Result."""
    say = (lambda text: None) if request.quiet else tell
    with contextlib.ExitStack() as until:
        case, directory, made, checkpoint = _begin(request, say, until)
        with folder.kept_if_begun(directory, made), former.kept(directory):
            _write_case(case, directory)
            if far := hosts.wanted(request.hosts, case):
                _look_around(far, case, directory, request)
            return _run(case, directory, checkpoint, request, say)


def _refused(code, directory, result, checkpoint):
    """Has a restart ended before it took a step? A solution that breaks in the first one is a result."""
    return former.is_aside(directory) and code not in (DONE, NUMBERS_BROKE) and result["steps"] <= checkpoint.step


def _put_back(code, directory, result):
    """The end of a restart that took no step: the record is that of the run before it, and what went wrong is told here alone."""
    former.put_back(directory)
    tell(f"fsi: {result['reason']}")
    if code in (INTERRUPTED, TERMINATED, PEER_LOST):
        _advise_restart(directory, result["restart"]["step"])
    return Result(code, directory, result)


def _run(case, directory, checkpoint, request, say):
    """A run whose folder is ready."""
    # Two that begin together may read the same time; then they would hear each other where the bus is not protected.
    identity = f"{case.name}-{time.strftime('%H%M%S')}-{time.time_ns() % 10**9:09d}-{os.getpid()}"
    say(f"{case.name}: {', '.join(case.programs.values())}")
    for remark in case.remarks:
        say(f"note: {remark}")

    start = time.monotonic()
    with _in_memory(case.programs) as reports:
        far = hosts.wanted(request.hosts, case)
        protection = request.protection or ("encrypt" if far else "sign")
        network = hosts.networks(far).get("", "")
        entered = registry.Entry(identity, directory.resolve(), case.name, protection, case.programs, network)
        with interrupts.held(), entered as entry, ranks.memory(_ranks_here(request, case)) as memory, interrupts.heard():
            programs = _programs(case, directory, entry, checkpoint, reports, memory, request)
            replaced.drop(directory)
            outcome, told = _watched(case, directory, programs, identity, request, say, checkpoint)
        parts = summary.read_parts(directory, case.programs, _copies(reports))
    found = verdict.judge(outcome, case, directory, parts)
    code, status, reason = found.code, found.status, found.reason
    advice = advice_after(code, case.projection)
    failure = found.failure and dict(found.failure)
    if advice:
        reason, failure = without_remedy(reason), failure and failure | {"what": without_remedy(failure["what"])}
    begun_from = {"t": checkpoint.t, "steps": checkpoint.step} if checkpoint else None
    result = summary.merge(parts, case, status, reason, time.monotonic() - start, summary.last_known(directory, told, begun_from),
                           {ending.name for ending in outcome.endings if ending.code == 0 and not ending.early})
    if failure:
        result["failure"] = failure
    if checkpoint:
        result["restart"] = {"step": checkpoint.step, "t": checkpoint.t}
    if _refused(code, directory, result, checkpoint):
        return _put_back(code, directory, result)
    former.drop(directory)
    failure = _finish(case, directory)
    if failure and code == DONE:
        code, result["status"], result["reason"] = failure.code, "failed", str(failure)
    expect = case.expect if request.judge and status == "completed" else []
    missed = summary.missed_expectations(result, expect)
    try:
        summary.write(directory, result)
    except OSError as error:
        _report(result, directory, missed, request.quiet, case.digest if code != USER_MISTAKE else None)
        raise Failure(OUTPUT_FAILED, f"cannot write {directory / 'summary.json'}: {error.strerror}; the run itself {status} at "
                                     f"t = {result['t']:g}{f': {reason}' if reason else ''}") from None
    _report(result, directory, missed, request.quiet, case.digest if code != USER_MISTAKE else None)
    if advice and code == found.code:
        tell(f"fsi: {advice}")
    return Result(EXPECTATION_MISSED if code == DONE and missed else code, directory, result)


def without_remedy(reason):
    """What broke, without what its program would do about its own scheme."""
    return reason.split("; try ")[0]


def advice_after(code, projection):
    """What else to try after a run with this projection that ended with this code; "" for nothing."""
    if code == NUMBERS_BROKE and projection == "traditional":   # the simplified one has limits of its own: no promise
        return ("the traditional scheme breaks where the solid is light (docs/theory_coupler.md); --set interface.projection=simplified "
                "may not")
    return ""


def _report(result, directory, missed, quiet, restarts):
    """Prints the summary, and each offence on a line of its own. `restarts`: digest of the case whose checkpoints would help."""
    if not quiet:
        tell(summary.describe(result, directory, shutil.get_terminal_size().columns if sys.stdout.isatty() else None), sys.stdout)
    for line in missed + ([result["reason"]] if result["status"] == "failed" else []):
        tell(f"fsi: {line}")
    if result["status"] != "completed" and restarts and (found := restart.latest(directory, digest=restarts)):
        _advise_restart(directory, found.step)


def _advise_restart(directory, step):
    tell(f"fsi: {paths.COMMAND} run --restart {shlex.quote(str(directory))} goes on from step {step}")
