"""The living programs of runs, as the system shows them."""

import contextlib
import os
import signal
import time
from dataclasses import dataclass
from pathlib import Path

CALLED = {"prterun": "mpirun"}      # what mpirun of Open MPI 5 goes on as


@dataclass
class Living:
    """A process that works for a run."""

    name: str           # of the participant
    program: str        # its executable
    pid: int


def _option(words, option):
    """The word behind an option, or None."""
    place = words.index(option) + 1 if option in words else len(words)
    return words[place] if place < len(words) else None


def _stat(pid):
    """What the system says of a process behind the name of its program. Throws OSError when there is none."""
    return Path(f"/proc/{pid}/stat").read_text(encoding="utf-8", errors="replace").rsplit(")", 1)[1].split()


def state_of(pid):
    """The letter the system shows for a process: R, S, D, T (stopped), Z (ended) ... Throws OSError when there is none."""
    return _stat(pid)[0]


def session_of(pid):
    """The session of a living process; 0 when there is none."""
    try:
        fields = _stat(pid)
    except (OSError, IndexError):
        return 0
    return 0 if fields[0] in "ZX" else int(fields[3])


def signal_to(pid, number):
    """Sends a signal to a process that may have ended."""
    with contextlib.suppress(ProcessLookupError):
        os.kill(pid, number)


def end_group(leader):
    """Kills what a process that leads a group has left in it, as a wrapper script its child."""
    with contextlib.suppress(ProcessLookupError, PermissionError):
        os.killpg(leader, signal.SIGKILL)


def namespace():
    """What pids are numbers of: each container has processes of its own, and may share folders with others. 0 where nobody says."""
    try:
        return Path("/proc/self/ns/pid").stat().st_ino
    except OSError:
        return 0


def start_time(pid):
    """Start of a living process in clock ticks since boot, which with the pid identifies it for good; 0 when there is none."""
    try:
        fields = _stat(pid)
    except OSError:
        return 0
    return 0 if fields[0] in "ZX" else int(fields[19])


def programs_of(directory):
    """The programs that work for the run in `directory`."""
    wanted = Path(directory).resolve()
    found = []
    for entry in Path("/proc").iterdir():
        if not entry.name.isdigit():
            continue
        try:
            words = [os.fsdecode(word) for word in (entry / "cmdline").read_bytes().split(b"\0")]
            if (folder := _option(words, "--run-dir")) is None:
                continue
            if state_of(entry.name) not in "ZX" and (Path(os.readlink(entry / "cwd")) / folder).resolve() == wanted:
                program = os.path.basename(words[0])
                found.append(Living(_option(words, "--name") or "reference", CALLED.get(program, program), int(entry.name)))
        except (OSError, IndexError):  # it has just ended, or is somebody else's
            continue
    return found


def until(condition, seconds):
    """Waits for `condition()` to hold; returns its value, false after `seconds`."""
    end = time.monotonic() + seconds
    while not (value := condition()) and time.monotonic() < end:
        time.sleep(0.02)
    return value
