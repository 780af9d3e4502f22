"""Where things are: the repository and its programs."""

import os
import re
import shlex
import shutil
import subprocess
from pathlib import Path

from fsi_launch.failure import Failure, INTERNAL_ERROR, UserMistake

ROOT = Path(__file__).resolve().parents[2]
BUILD = ROOT / "build" / "release"
BIN = Path(os.environ.get("FSI_BIN") or BUILD / "bin")
COMMAND = shlex.quote(os.environ.get("FSI_COMMAND") or "./launch/fsi")  # for what a person is told to type


_built = set()  # by this command


def targets():
    """Programs that the build knows; none with FSI_BIN."""
    if os.environ.get("FSI_BIN"):
        return set()
    return set(re.findall(r"^build bin/(\w+):", (BUILD / "build.ninja").read_text(encoding="utf-8"), flags=re.M))


def build(names):
    """Builds those of the programs that the build knows and that are missing or out of date. With FSI_BIN nothing is built. Ends the
    command where that fails; the reason is told by then."""
    wanted = [f"bin/{name}" for name in dict.fromkeys(names) if name in targets() - _built]
    if not wanted:
        return
    leash = ["setpriv", "--pdeathsig", "TERM"] if shutil.which("setpriv") else []   # ends with this command, even if that is killed
    code = subprocess.run([*leash, ROOT / "launch" / "fsi", "--build", *wanted], stdin=subprocess.DEVNULL, check=False).returncode
    if code != 0:
        raise SystemExit(code)
    _built.update(names)


def expect(programs):
    """Throws UserMistake where one that a case names, {participant: name}, neither is there nor can be built."""
    for participant, name in programs.items():
        if "/" in name:
            program(name)
        elif not os.access(BIN / name, os.X_OK) and name not in targets():
            raise UserMistake(f"'{participant}': there is no program {name} in {BIN}; write ./{name} for one in this folder, or its path")


def program(name):
    """Path of one of our programs; a name with a / in it is a path itself: a solid of somebody else's."""
    if "/" in name:
        path = Path(name).resolve()
        if not path.is_file() or not os.access(path, os.X_OK):
            raise UserMistake(f"the program {path} does not exist or cannot be executed")
        return str(path)
    path = BIN / name
    if not os.access(path, os.X_OK):
        raise Failure(INTERNAL_ERROR, f"the program {name} is not in {BIN}")
    return str(path)

