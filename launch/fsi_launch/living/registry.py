"""Which runs are going on here: one small file per run, for the monitor and for control from outside. It holds the key
of the run: who has it takes part in the run on the bus. So nobody but its user may read it."""

import json
import os
import socket
import stat
from pathlib import Path

from fsi_launch.living import processes
from fsi_launch.failure import Failure, OUTPUT_FAILED

KEY_BYTES = 32


def _is_own(path):
    """A folder of this user's, in which nobody else can make a name first."""
    try:
        found = os.stat(path)
    except OSError:
        return False
    return stat.S_ISDIR(found.st_mode) and found.st_uid == os.getuid() and os.access(path, os.W_OK)


def folder():
    """Where the entries of this user's runs lie. monitor/registry.cpp looks at the same places in the same order."""
    for runtime in (os.environ.get("XDG_RUNTIME_DIR"), f"/run/user/{os.getuid()}"):
        if runtime and _is_own(runtime):
            return Path(runtime) / "amp-fsi"
    if (home := os.environ.get("HOME")) and _is_own(home):
        return Path(home) / ".cache" / "amp-fsi" / socket.gethostname()
    return Path(f"/tmp/amp-fsi-{os.getuid()}")


def _make_folder(path):
    """The folder of the entries, which only its user can read or write."""
    path.mkdir(mode=0o700, parents=True, exist_ok=True)
    found = path.lstat()
    if not stat.S_ISDIR(found.st_mode) or found.st_uid != os.getuid():
        raise Failure(OUTPUT_FAILED, f"{path} belongs to somebody else; set XDG_RUNTIME_DIR or HOME to a folder of your own")
    if stat.S_IMODE(found.st_mode) != 0o700:
        path.chmod(0o700)


def _by_descriptor(directory):
    """A folder whose name is no UTF-8, which JSON cannot say, opened: others find it by that. -1 for any other."""
    try:
        os.fsencode(directory).decode("utf-8")
    except UnicodeDecodeError:
        return os.open(directory, os.O_PATH | os.O_CLOEXEC)
    return -1


class Entry:
    """A run's entry; exists while the context is open. `key`: what programs and monitors of the run share
    (common/bus/peers/credentials.hpp). `protection`: "off", "sign" or "encrypt". `participants`: names of those who will speak. `network`: where they meet, if they
    are on several machines."""

    def __init__(self, run, directory, case, protection, participants, network=""):
        self.path = folder() / f"{run}.json"
        self.run = run
        self.key = "" if protection == "off" else f"{protection}:{os.urandom(KEY_BYTES).hex()}"
        self._folder = _by_descriptor(directory)    # -1: not needed
        where = str(directory) if self._folder < 0 else f"/proc/{os.getpid()}/fd/{self._folder}"
        self.content = {"run": run, "dir": where, "case": case, "pid": os.getpid(),
                        "born": processes.start_time(os.getpid()), "pids": processes.namespace(), "key": self.key, "participants": list(participants)} | ({"network": network} if network else {})

    def __enter__(self):
        _make_folder(self.path.parent)
        _forget_dead_runs(self.path.parent)
        with open(os.open(self.path, os.O_WRONLY | os.O_CREAT | os.O_EXCL, 0o600), "w", encoding="utf-8") as file:
            try:
                file.write(json.dumps(self.content) + "\n")
                file.flush()
            except OSError as error:
                self.path.unlink(missing_ok=True)
                raise OSError(error.errno, error.strerror, str(self.path)) from None
        return self

    def __exit__(self, *_):
        self.path.unlink(missing_ok=True)
        if self._folder >= 0:
            os.close(self._folder)


def running_in(directory):
    """Process of the launcher whose run lives in `directory`, or None."""
    _forget_dead_runs(folder())
    for path in folder().glob("*.json"):
        try:
            entry = json.loads(path.read_text(encoding="utf-8"))
            if Path(entry["dir"]).resolve() == Path(directory).resolve():
                return int(entry["pid"])
        except (OSError, ValueError, KeyError, TypeError):
            continue
    return None


def _forget_dead_runs(entries):
    """Removes what launchers left behind that were killed with SIGKILL. Another process may have their number by now; those of other
    containers have numbers of their own."""
    here = processes.namespace()
    for path in entries.glob("*.json"):
        try:
            entry = json.loads(path.read_text(encoding="utf-8"))
            if entry.get("pids", here) != here:
                continue
            born = processes.start_time(int(entry["pid"]))
        except (OSError, ValueError, KeyError, TypeError):
            continue
        if born == 0 or born != entry.get("born", born):
            path.unlink(missing_ok=True)
