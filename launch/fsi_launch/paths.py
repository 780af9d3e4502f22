"""Where things are: the repository and its programs."""

import os
from pathlib import Path

from fsi_launch.failure import Failure, INTERNAL_ERROR

ROOT = Path(__file__).resolve().parents[2]
BUILD = ROOT / "build" / "release"
BIN = Path(os.environ.get("FSI_BIN") or BUILD / "bin")


def program(name):
    """Path of one of our programs."""
    path = BIN / name
    if not os.access(path, os.X_OK):
        raise Failure(INTERNAL_ERROR, f"the program {name} is not in {BIN}")
    return str(path)

