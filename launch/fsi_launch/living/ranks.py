"""Participants that several processes compute together (`fsi run --ranks`): who, how many, and how they are started.

Each such participant has an mpirun of its own, in a session of its own as every program; its ranks are in that session too. Only
rank 0 speaks with the other programs. mpirun passes SIGUSR1 on, which a rank takes for SIGTERM; a SIGTERM it would answer by killing
them. On this machine only: nothing listens on a network, since LOOPBACK is preloaded into mpirun.
"""

import contextlib
import functools
import math
import os
import re
import shutil
import signal
import subprocess
import tempfile
from dataclasses import dataclass
from pathlib import Path

from fsi_launch import paths
from fsi_launch.failure import UserMistake
from fsi_launch.living import processes
from fsi_launch.telling import AS_NAMED

MODULE = "libfsi_ranks_mpi.so"      # common/ranks/module.hpp
LOOPBACK = "libfsi_ranks_loopback.so"       # common/ranks/mpi/loopback.cpp
PACKAGES = "openmpi-bin libopenmpi-dev"
GAS = "fluid_solver"
SOLID = "solid_solver_"             # and the name of its law
ONE_RANK = ("solid_solver_rigid", "solid_solver_beam")      # few numbers, no grid
SHARED = Path("/dev/shm")           # what ranks share: Open MPI leaves its part there, and its folder in /tmp, where mpirun is killed
ON_DISK = Path("/tmp")              # where it is when that is too small
MIB = 1 << 20
OF_MPIRUN = 9 * MIB                 # there, of each mpirun (measured with Open MPI 4.1.4: 8.2 MiB)
FOLDER = "amp-fsi-ranks-"           # and who began with it: namespace of its pid, pid, its start, something new
MOST = 64
LEAST_POINTS = 20000                # a rank, where `auto` chooses
EXTRA = []                          # words for every rank (tests)


@dataclass(frozen=True)
class Told:
    """What an mpirun is told."""

    options: dict       # {word of its command: {name: value}}
    folders: tuple      # of its environment: where it and its ranks leave files
    segment: int        # [bytes] of such a file of each rank, at most


# By major version of Open MPI. Nothing leaves this machine; what wants the right to look into other processes is left out; and inside a
# job of Slurm, too, all ranks are where mpirun is.
TOLD = {
    "4": Told({"mca": {
        "btl": "self,vader", "pml": "ob1", "oob_tcp_if_include": "lo", "btl_vader_single_copy_mechanism": "none",
        "mpi_yield_when_idle": "1", "odls_base_sigkill_timeout": "1", "ras": "^slurm", "plm": "^slurm", "ess": "^slurm"}},
        ("OMPI_MCA_btl_vader_backing_directory", "OMPI_MCA_orte_tmpdir_base"), 4 * MIB),
    "5": Told({
        "mca": {"btl": "self,sm", "pml": "ob1", "smsc": "^cma,xpmem,knem", "mpi_yield_when_idle": "1"},
        "prtemca": {"ras": "^slurm", "plm": "^slurm", "ess": "^slurm"},
        "pmixmca": {"ptl_base_if_include": "lo"}},
        ("OMPI_MCA_btl_sm_backing_directory", "PRTE_MCA_prte_tmpdir_base"), 16 * MIB),
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
    missing = [*(f"{file} in {paths.BIN}" for file in (MODULE, LOOPBACK) if not (paths.BIN / file).is_file()),
               *([] if shutil.which("mpirun") else ["mpirun"])]
    if missing:
        raise UserMistake(f"--ranks: {' and '.join(missing)} is missing; install Open MPI (sudo apt-get install {PACKAGES}) and build "
                          "again, or leave --ranks away")
    if other := other_mpi():
        raise UserMistake(f"--ranks: mpirun is of {other}, and ranks go with Open MPI 4 and 5 (of Debian 12 and 13) alone; put the mpirun "
                          "of one of these first in PATH and build again, or leave --ranks away")


def told(mpirun=None):
    """What an mpirun, that in PATH or another one, is told; None where it is none that is known here."""
    return TOLD.get(_version(mpirun or shutil.which("mpirun"))[0])


def other_mpi():
    """What mpirun says it is, where that is no Open MPI that is known here; nothing where it is."""
    version, name = _version(shutil.which("mpirun"))
    return "" if version in TOLD else name


@functools.cache
def _version(mpirun):
    """(major version of Open MPI, all of what that mpirun calls itself); both are empty where there is none."""
    if mpirun is None:
        return "", ""
    said = subprocess.run([mpirun, "--version"], capture_output=True, **AS_NAMED, check=False).stdout.partition("\n")[0]
    found = re.search(r"Open MPI\) ((\d+)\S*)", said)
    return (found[2], f"Open MPI {found[1]}") if found else ("", said or "an unknown kind")


def command(words, number):
    """The command of a program that `number` ranks compute."""
    options = [word for option, values in told().options.items() for name, value in values.items() for word in (f"--{option}", name, value)]
    return [shutil.which("mpirun"), "-n", str(number), "--oversubscribe", "--bind-to", "none", *options, *words, "--ranks", str(number), *EXTRA]


def environment():
    """Of mpirun. That it may run as root goes without saying: so does everything else here."""
    return {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"} if os.geteuid() == 0 else {}


def _shared(numbers, known):
    """[bytes] that mpiruns with so many ranks each share, at most: who finds the memory full is killed by SIGBUS."""
    return sum(OF_MPIRUN + number * (known.segment + MIB // 8) for number in numbers)


def _room(folder):
    """[bytes] that may be written there."""
    try:
        found = os.statvfs(folder)
    except OSError:
        return 0
    if not os.access(folder, os.W_OK):
        return 0
    return found.f_bavail * found.f_frsize if found.f_blocks else math.inf      # a file system in memory without a bound


def _place(numbers, known):
    """Where the ranks of these mpiruns share memory; None where there is no room."""
    return next((folder for folder in (SHARED, ON_DISK) if _room(folder) >= _shared(numbers, known)), None)


def lack_of_room(numbers, mpirun=None):
    """Why mpiruns with so many ranks each cannot begin on this machine, and what to do; "" where they can."""
    known = told(mpirun) if numbers else None
    if known is None or _place(numbers, known):
        return ""
    free = " and ".join(f"{folder} has {_room(folder) // MIB} MB" for folder in (SHARED, ON_DISK))
    return (f"the ranks share up to {-(-_shared(numbers, known) // MIB)} MB, and of room for them {free}; enlarge {SHARED} (as root: mount -o "
            f"remount,size=1G {SHARED}; of a container: docker run --shm-size=1g), ask for fewer ranks, or leave --ranks away")


@contextlib.contextmanager
def memory(numbers, mpirun=None, programs=None):
    """Where the ranks of the mpiruns within this context share memory, as their environment; nothing of it is left behind.
    `numbers`: of ranks, of each mpirun; {} for none. `mpirun`, `programs`: it and the folder of our programs, where they are not those of
    this launcher."""
    known = told(mpirun) if numbers else None
    if known is None:
        yield {}
        return
    where = _place(numbers, known) or SHARED
    for folder in (SHARED, ON_DISK):
        _forget_dead(folder)
    own = f"{FOLDER}{processes.namespace()}-{os.getpid()}-{processes.start_time(os.getpid())}-"
    with tempfile.TemporaryDirectory(prefix=own, dir=where, ignore_cleanup_errors=True) as folder:
        yield dict.fromkeys(known.folders, folder) | _preloaded(Path(folder), programs or paths.BIN)


def _preloaded(folder, programs):
    """What loads LOOPBACK into an mpirun. A list of such files has no way to write a space or a colon, so it is found in `folder`."""
    link = folder / LOOPBACK
    link.symlink_to((programs / LOOPBACK).resolve())
    return {"LD_PRELOAD": ":".join([str(link), *filter(None, [os.environ.get("LD_PRELOAD")])])}


def _forget_dead(where):
    """Removes what is left of launchers of this user's that were killed with SIGKILL; of those of other containers nobody here knows."""
    for folder in where.glob(f"{FOLDER}{processes.namespace()}-*"):
        with contextlib.suppress(OSError, ValueError):      # gone meanwhile; a name of somebody else's
            pid, born = map(int, folder.name.removeprefix(FOLDER).split("-")[1:3])
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
