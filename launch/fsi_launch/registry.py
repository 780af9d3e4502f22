"""Which runs are going on here: one small file per run, for the monitor and for control from outside."""

import json
import os
from pathlib import Path


def folder():
    """Where the entries of this user's runs lie."""
    runtime = os.environ.get("XDG_RUNTIME_DIR")
    if runtime and os.path.isdir(runtime) and os.access(runtime, os.W_OK):
        return Path(runtime) / "amp-fsi"
    return Path(f"/tmp/amp-fsi-{os.getuid()}")


class Entry:
    """A run's entry; exists while the context is open."""

    def __init__(self, run, directory, case):
        self.path = folder() / f"{run}.json"
        self.content = {"run": run, "dir": str(directory), "case": case, "pid": os.getpid()}

    def __enter__(self):
        self.path.parent.mkdir(mode=0o700, parents=True, exist_ok=True)
        _forget_dead_runs(self.path.parent)
        self.path.write_text(json.dumps(self.content) + "\n", encoding="utf-8")
        return self

    def __exit__(self, *_):
        self.path.unlink(missing_ok=True)


def running_in(directory):
    """Process of the launcher whose run lives in `directory`, or None."""
    _forget_dead_runs(folder())
    for path in folder().glob("*.json"):
        try:
            entry = json.loads(path.read_text(encoding="utf-8"))
            if Path(entry["dir"]) == Path(directory).resolve():
                return int(entry["pid"])
        except (OSError, ValueError, KeyError):
            continue
    return None


def _forget_dead_runs(entries):
    """Removes what launchers left behind that were killed with SIGKILL."""
    for path in entries.glob("*.json"):
        try:
            os.kill(int(json.loads(path.read_text(encoding="utf-8"))["pid"]), 0)
        except ProcessLookupError:
            path.unlink(missing_ok=True)
        except (OSError, ValueError, KeyError):
            continue
