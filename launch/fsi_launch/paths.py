"""Where things are: the repository, its programs, its cases."""

import difflib
import os
from pathlib import Path

from fsi_launch.failure import Failure, INTERNAL_ERROR, UserMistake

ROOT = Path(__file__).resolve().parents[2]
BUILD = ROOT / "build" / "release"
BIN = Path(os.environ.get("FSI_BIN") or BUILD / "bin")
CONFIGS = ROOT / "configs"


def program(name):
    """Path of one of our programs."""
    path = BIN / name
    if not os.access(path, os.X_OK):
        raise Failure(INTERNAL_ERROR, f"the program {name} is not in {BIN}")
    return str(path)


def case_file(text):
    """The case file meant by `text`: a path, or the name of a file in configs/."""
    if os.path.isfile(text):
        return text
    named = CONFIGS / f"{text}.yaml"
    if "/" not in text and named.is_file():
        return os.path.relpath(named) if named.is_relative_to(Path.cwd()) else str(named)
    names = sorted(path.stem for path in CONFIGS.glob("*.yaml"))
    if "/" in text or text.endswith((".yaml", ".yml")):
        raise UserMistake(f"no case file '{text}'")
    near = difflib.get_close_matches(text, names, 1)
    hint = f"did you mean '{near[0]}'?" if near else "there are: " + ", ".join(names)
    raise UserMistake(f"no case '{text}' in configs/; {hint}")
