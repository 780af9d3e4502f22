"""Where things are: the repository and its programs."""

import os
from pathlib import Path

from fsi_launch.failure import Failure, INTERNAL_ERROR, UserMistake

ROOT = Path(__file__).resolve().parents[2]
BUILD = ROOT / "build" / "release"
BIN = Path(os.environ.get("FSI_BIN") or BUILD / "bin")


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

