"""The validated problems of gallery/: what each is, which case it takes and what that is compared with (gallery/README.md)."""

import json
import shlex
from dataclasses import dataclass, field
from pathlib import Path

from fsi_launch import paths
from fsi_launch.failure import UserMistake

FOLDER = paths.ROOT / "gallery"


@dataclass(frozen=True)
class Problem:
    """One folder of the gallery. `numbers` and `curves` are as problem.json has them."""

    name: str
    title: str
    source: str         # of the data
    case: str           # a path, or a name in configs/
    set: list = field(default_factory=list)
    solid: list = field(default_factory=list)
    numbers: list = field(default_factory=list)
    curves: list = field(default_factory=list)

    def command(self):
        """The run as a person would type it."""
        words = [self.case, *(word for one in self.set for word in ("--set", one)), *(word for one in self.solid for word in ("--solid", one))]
        return f"./launch/fsi run {shlex.join(words)}"

    def data(self):
        """Path of the reference data, {column: [numbers]} in a CSV."""
        return FOLDER / self.name / "data.csv"

    def others(self):
        """{code: path} of what other codes found: CSVs with columns of the reference data."""
        return {path.stem: path for path in sorted((FOLDER / self.name / "others").glob("*.csv"))}


def names():
    return sorted(path.parent.name for path in FOLDER.glob("*/problem.json"))


def problem(name):
    """The Problem of this name. Throws UserMistake with the names there are."""
    path = FOLDER / name / "problem.json"
    if name not in names():
        raise UserMistake(f"gallery: no problem '{name}'; there are {', '.join(names())}")
    described = json.loads(path.read_text(encoding="utf-8"))
    own = path.parent / described["case"]
    if own.is_file():
        described["case"] = str(own.relative_to(Path.cwd())) if own.is_relative_to(Path.cwd()) else str(own)
    return Problem(name=name, **described)
