"""Participants that several processes compute together (`fsi run --ranks`): who, how many, and how they are started.

Each such participant has an mpirun of its own, in a session of its own as every program; its ranks are in that session too. Only
rank 0 speaks with the other programs. mpirun passes SIGUSR1 on, which a rank takes for SIGTERM; a SIGTERM it would answer by killing
them. On this machine only: nothing listens on a network.
"""

import contextlib
import os
import re
import shutil
import signal
import subprocess
import tempfile
from pathlib import Path

from fsi_launch import paths
from fsi_launch.failure import UserMistake
from fsi_launch.living import processes

MODULE = "libfsi_ranks_mpi.so"      # common/ranks/module.hpp
PACKAGES = "openmpi-bin libopenmpi-dev"
GAS = "fluid_solver"
SOLID = "solid_solver_"             # and the name of its law
ONE_RANK = ("solid_solver_rigid", "solid_solver_beam")      # few numbers, no grid
SHARED = Path("/dev/shm")           # what ranks share: Open MPI leaves its part there, and its folder in /tmp, where mpirun is killed
FOLDER = "amp-fsi-ranks-"           # and who began with it: pid, its start, something new
MOST = 64
LEAST_POINTS = 20000                # a rank, where `auto` chooses
EXTRA = []                          # words for every rank (tests)
OPTIONS = {
    "btl": "self,vader", "pml": "ob1", "oob_tcp_if_include": "lo",      # nothing leaves this machine
    "btl_vader_single_copy_mechanism": "none",      # the other ones want the right to look into other processes
    "mpi_yield_when_idle": "1", "odls_base_sigkill_timeout": "1",
    "ras": "^slurm", "plm": "^slurm", "ess": "^slurm",      # inside a job of Slurm too: all ranks are where mpirun is
}


def wanted(text, case):
    """{participant: ranks}, of those with more than one, from `fluid=2,..`, `auto` or None."""
    able = [name for name, program in case.programs.items() if knows_ranks(program)]
    if text is None:
        return {}
    if text == "auto":
        others = len(case.programs) - len(able) - (len(case.programs) > 1)      # the coupler hardly computes
        return _shared_out(able, len(os.sched_getaffinity(0)) - others, case.cost)
    asked = {}
    for word in text.split(","):
        name, _, number = word.partition("=")
        if not number.isdecimal() or not 1 <= int(number) <= MOST:
            raise UserMistake(f"--ranks {text}: '{word}' is not NAME=N with N from 1 to {MOST}; write --ranks fluid=2, or auto")
        if name not in case.programs:
            raise UserMistake(f"--ranks {text}: the case has no participant '{name}'; it has {', '.join(case.programs)}")
        if name not in able and int(number) > 1:
            raise UserMistake(f"--ranks {text}: {name} ({case.programs[name]}) computes in one process only; several can compute a gas "
                              f"or a solid with a grid: {', '.join(able) or 'this case has none'}")
        asked[name] = int(number)
    return {name: number for name, number in asked.items() if number > 1}


def knows_ranks(program):
    """Gases, and solids with a law; not rigid bodies and beams, nor programs of somebody else's."""
    return program == GAS or program.startswith(SOLID) and program not in ONE_RANK


def _shared_out(able, cores, cost):
    """One core after the other to whoever of those with ranks has most left to do in a step, while it pays."""
    numbers = {name: 1 for name in able}

    def work(name):
        return cost.get(name, {}).get("seconds_a_step", 1) / numbers[name]

    while sum(numbers.values()) < cores:
        open_to = [name for name in able if numbers[name] < MOST and
                   cost.get(name, {}).get("points", LEAST_POINTS * MOST) >= (numbers[name] + 1) * LEAST_POINTS]
        if not open_to:
            break
        numbers[max(open_to, key=work)] += 1
    return {name: number for name, number in numbers.items() if number > 1}


def expect_mpi(asked):
    """Throws UserMistake where participants shall have ranks, but cannot."""
    if not asked:
        return
    missing = [what for what, there in ((f"{MODULE} in {paths.BIN}", (paths.BIN / MODULE).is_file()),
                                        ("mpirun", shutil.which("mpirun"))) if not there]
    if missing:
        raise UserMistake(f"--ranks: {' and '.join(missing)} is missing; install Open MPI (sudo apt-get install {PACKAGES}) and build "
                          "again, or leave --ranks away")
    if other := other_mpi():
        raise UserMistake(f"--ranks: mpirun is of {other}, and ranks go with Open MPI 4 (of Debian 12) alone: its successor takes other options and "
                          "finds no network on the loopback interface; leave --ranks away")


def other_mpi():
    """What mpirun says it is, where that is not Open MPI 4; nothing where it is."""
    said = subprocess.run(["mpirun", "--version"], capture_output=True, text=True, check=False).stdout.partition("\n")[0]
    found = re.search(r"Open MPI\) ((\d+)\S*)", said)
    return "" if found and found[2] == "4" else f"Open MPI {found[1]}" if found else said or "an unknown kind"


def command(words, number):
    """The command of a program that `number` ranks compute."""
    options = [word for name, value in OPTIONS.items() for word in ("--mca", name, value)]
    return [shutil.which("mpirun"), "-n", str(number), "--oversubscribe", "--bind-to", "none", *options, *words,
            "--ranks", str(number), *EXTRA]


def environment():
    """Of mpirun. That it may run as root goes without saying: so does everything else here."""
    return {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"} if os.geteuid() == 0 else {}


@contextlib.contextmanager
def memory(number):
    """Where the ranks of the mpiruns within this context share memory, as their environment; nothing of it is left behind.
    `number`: of ranks; {} for one."""
    if number == 1 or not os.access(SHARED, os.W_OK):
        yield {}
        return
    _forget_dead()
    with tempfile.TemporaryDirectory(prefix=f"{FOLDER}{os.getpid()}-{processes.start_time(os.getpid())}-", dir=SHARED,
                                     ignore_cleanup_errors=True) as folder:
        yield {"OMPI_MCA_btl_vader_backing_directory": folder, "OMPI_MCA_orte_tmpdir_base": folder}


def _forget_dead():
    """Removes what is left of launchers of this user's that were killed with SIGKILL."""
    for folder in SHARED.glob(f"{FOLDER}*"):
        with contextlib.suppress(OSError, ValueError):      # gone meanwhile; a name of somebody else's
            pid, born = map(int, folder.name.removeprefix(FOLDER).split("-")[:2])
            if folder.lstat().st_uid == os.getuid() and processes.start_time(pid) != born:
                shutil.rmtree(folder, ignore_errors=True)


def cores(asked):
    """{participant: cores of its own}, where there are enough for all ranks; else {}: the system shares them out."""
    free = sorted(os.sched_getaffinity(0))
    if sum(asked.values()) > len(free) - 1:
        return {}
    return {name: {free.pop() for _ in range(number)} for name, number in asked.items()}


def members(session):
    """Processes of a session, its leader left out."""
    found = []
    for entry in Path("/proc").iterdir():
        if entry.name.isdigit() and int(entry.name) != session and processes.session_of(entry.name) == session:
            found.append(int(entry.name))
    return found


def send(process, number):
    """A signal to mpirun and what it has started."""
    if number == signal.SIGKILL:
        for pid in members(process.pid):
            processes.signal_to(pid, number)
    process.send_signal(signal.SIGUSR1 if number == signal.SIGTERM else number)
    for pid in members(process.pid):
        processes.signal_to(pid, signal.SIGCONT)
