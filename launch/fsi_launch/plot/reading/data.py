"""Reads what a run wrote (layout: docs/output.md): fields of each program over its output times, and tables."""

import contextlib
import csv
import functools
import json
from dataclasses import dataclass, replace

import h5py
import numpy as np

from fsi_launch.failure import UserMistake
from fsi_launch.results import probes
from fsi_launch.telling import AS_NAMED

NOT_FIELDS = ("x", "x1", "x2", "kind", "vtkGhostType")  # "x" holds x1 and x2 side by side, for ParaView
UNUSED, DISCRETISED, INTERPOLATED = 0, 1, 2
FILLED = 17         # lines of a body that has two, in pictures
SAME_TIME = 1e-9    # part of the time by which an output may differ from the one asked for


@dataclass
class Grid:
    """One component grid at one output time; arrays are indexed [j, i], j along the second grid direction.

    A grid that closes on itself along i has its first column once more at the end, so that it is drawn without a gap.
    """

    name: str
    x1: np.ndarray
    x2: np.ndarray
    kind: np.ndarray   # UNUSED, DISCRETISED or INTERPOLATED
    fields: dict
    closed: bool
    level: int = 0     # of a background of several levels; 0 is the finest one
    fan: bool = False  # a body without a grid: from its outline to a line inside it, or to its centre

    def __getitem__(self, name):
        """A field by its name; "speed", and of a gas "T", are made of the others."""
        if name == "speed":
            return self.speed()
        if name == "T" and "rho" in self.fields:
            return self.fields["p"] / self.fields["rho"]
        return self.fields[name]

    def filled(self):
        """The same with lines between its two, if it has no more: what is linear there, the velocity of a rigid body, has a size that is not."""
        if not self.fan:
            return self
        share = np.linspace(0, 1, FILLED)[:, None]

        def between(values):
            return values[:1] + share * (values[1:] - values[:1])
        return replace(self, x1=between(self.x1), x2=between(self.x2), kind=np.repeat(self.kind[1:], FILLED, axis=0),
                       fields={key: between(values) for key, values in self.fields.items()})

    def speed(self):
        return np.hypot(self.fields["v1"], self.fields["v2"])

    def used(self):
        return self.kind != UNUSED

    def is_cartesian(self):
        """True for a background grid: lines parallel to the axes (a solid's before it deforms)."""
        x1, x2 = self.fields.get("x1_bar", self.x1), self.fields.get("x2_bar", self.x2)
        return np.ptp(x1, axis=0).max() == 0 and np.ptp(x2, axis=1).max() == 0

    def spacing(self):
        """A typical distance between neighbours."""
        return np.median(np.hypot(np.diff(self.x1, axis=1), np.diff(self.x2, axis=1)))


class Output:
    """All grids of one program at one output time. `grids`: a list, or the function that reads them when they are first asked for: what
    compares runs needs few times, and of a gas often nothing. `number`: its place among all outputs of the run, from 0."""

    def __init__(self, t, grids, number=0):
        self.t = t
        self._grids = grids
        self.number = number

    @functools.cached_property
    def grids(self):
        return self._grids() if callable(self._grids) else self._grids

    @functools.cached_property
    def filled(self):
        """The grids as colours show them."""
        return [grid.filled() for grid in self.grids]

    def background(self):
        """Of several levels the finest one."""
        return next(grid for grid in self.grids if grid.level == 0)


@dataclass
class Series:
    """The outputs of one program: `name` is "fluid", or that of one gas of several or of the solid."""

    name: str
    outputs: list
    of_gas: bool = False

    def is_gas(self):
        return self.of_gas or self.name == "fluid"

    def has_an_inside(self):
        """False of rigid bodies and beams, which are two lines of points."""
        return not self.outputs[0].grids[0].fan


@dataclass
class Table:
    """A table of numbers over time: {column: values}."""

    name: str
    columns: dict


def _closes(x1, x2):
    """True if the last column is a neighbour of the first one, as on a ring."""
    if x1.shape[1] < 4:
        return False
    gap = np.hypot(x1[:, -1] - x1[:, 0], x2[:, -1] - x2[:, 0])
    return bool((gap <= 1.5 * np.hypot(np.diff(x1, axis=1), np.diff(x2, axis=1)).max(axis=1)).all())


def _is_there_again(x1, x2):
    """True if the last column is the first one already."""
    gap = np.hypot(x1[:, -1] - x1[:, 0], x2[:, -1] - x2[:, 0])
    return bool((gap <= 1e-9 * np.hypot(np.ptp(x1), np.ptp(x2))).all())


def _read_grid(name, group):
    arrays = {key: np.asarray(group[key]) for key in group if key != "x"}
    arrays.setdefault("kind", np.full(arrays["x1"].shape, DISCRETISED))  # a program with one grid uses all of it
    closed = _closes(arrays["x1"], arrays["x2"])
    if closed and not _is_there_again(arrays["x1"], arrays["x2"]):
        arrays = {key: np.concatenate([values, values[:, :1]], axis=1) for key, values in arrays.items()}
    fields = {key: values for key, values in arrays.items() if key not in NOT_FIELDS}
    return Grid(name, arrays["x1"], arrays["x2"], arrays["kind"].astype(int), fields, closed, fan=len(arrays["x1"]) == 2)


def _read_grids(group):
    """Background grids first, of several levels the coarsest: pictures lay the finer and the body-fitted ones over them. Only grids
    with used points: a coarse level has none while finer ones cover all of the gas."""
    grids = [grid for grid in (_read_grid(name, group[name]) for name in group) if grid.used().any()]
    backgrounds = sorted((grid for grid in grids if grid.is_cartesian()), key=Grid.spacing)
    for level, grid in enumerate(backgrounds):
        grid.level = level
    return backgrounds[::-1] + [grid for grid in grids if not grid.is_cartesian()]


def _read_output(group):
    return Output(float(group.attrs["t"]), _read_grids(group))


@contextlib.contextmanager
def _sound(path):
    """What is read within from `path` is what was written there; else it is the user's to put right."""
    try:
        yield
    except PermissionError:
        raise
    except (ValueError, KeyError, TypeError, csv.Error, OSError) as error:
        raise UserMistake(f"'{path}' is damaged: {str(error) or type(error).__name__}; make the run again, or take the file away") from None


def _json(path):
    """What is in it, or None where there is none."""
    if not path.is_file():
        return None
    with _sound(path):
        found = json.loads(path.read_text(**AS_NAMED))
        if not isinstance(found, dict):
            raise ValueError("it holds no results")
        return found


@contextlib.contextmanager
def _opened(path):
    try:
        with h5py.File(path, "r") as file:
            if "outputs" not in file.attrs:
                raise UserMistake(f"'{path}' is not the series of outputs of a program: give the folder of a run, "
                                "as fsi run --out named it")
            yield file
    except (KeyError, OSError) as error:
        raise UserMistake(f"'{path}', or a file in fields/ that it names, is damaged: {error.args[0]}; fsi run --restart names it") from None


def _is_of_gas(path):
    return path.stem == "fluid" or path.stem.startswith("fluid_")


def _grids_at(path, key):
    with _opened(path) as file:
        return _read_grids(file[key])


def _read_series(path, name):
    with _opened(path) as file:
        outputs = [Output(float(file[key].attrs["t"]), functools.partial(_grids_at, path, key), number)
                   for number, key in enumerate(sorted(file))]
    return Series(name, outputs, _is_of_gas(path))


def output_times(path):
    """The times in the file of a program."""
    with _opened(path) as file:
        return [float(file[key].attrs["t"]) for key in sorted(file)]


def read_output(path, k):
    """One Output of it."""
    with _opened(path) as file:
        return _read_output(file[sorted(file)[k]])


def files(directory):
    """(path of the fields, name of the program): the gas or the gases by name first, then the solids by name."""
    return [*((path, "fluid") for path in directory.glob("fluid.h5")),
            *((path, path.stem.removeprefix("fluid_")) for path in sorted(directory.glob("fluid_*.h5"))),
            *((path, path.stem.removeprefix("solid_")) for path in sorted(directory.glob("solid_*.h5")))]


def all_series(directory):
    """The gas first, then the solids by name."""
    return [one for one in (_read_series(path, name) for path, name in files(directory)) if one.outputs]


def gas_of(series):
    """The Series of the gas, that of several gases with the grids of all of them; None where there is no gas."""
    gases = [one for one in series if one.is_gas()]
    if len(gases) < 2:
        return gases[0] if gases else None

    def grids_of(outputs):
        return [grid for output in outputs for grid in output.grids]

    outputs = [Output(together[0].t, functools.partial(grids_of, together), together[0].number)
               for together in zip(*(one.outputs for one in gases))]
    return Series(" and ".join(one.name for one in gases), outputs, True)


def same_time(a, b):
    """True if an output at a is one that was asked for at b."""
    return abs(a - b) <= SAME_TIME * max(abs(a), abs(b))


def _at(one, times):
    """The outputs of a program at these times, in their order; one that is not there is the user's mistake."""
    chosen = [output for output in one.outputs if any(same_time(output.t, t) for t in times)]
    for t in times:
        if not any(same_time(output.t, t) for output in chosen):
            there = ", ".join(f"{output.t:g}" for output in one.outputs)
            raise UserMistake(f"{one.name} has no output at t = {t:g}: it has {there}; name these, or add the time to output.times")
    return replace(one, outputs=chosen)


def at_times(series, times):
    """The series with their outputs at `times` alone; all of them where no time is given."""
    return [_at(one, times) for one in series] if times else series


def last_state(directory):
    """Series of the one state that each program left where the solution diverged; none of other runs."""
    series = []
    for path, name in files(directory / "last_state"):
        with _sound(path), h5py.File(path, "r") as file:
            series.append(Series(name, [_read_output(file)], _is_of_gas(path)))
    return series


def read_table(path):
    """The Table in a CSV, or None where it has less than two lines of numbers."""
    with _sound(path), open(path, **AS_NAMED, newline="") as file:
        return _table(path.stem, [row for row in csv.reader(file) if row])


def joined_probes(directory):
    """The Table that probes.csv will be when the run has ended, or None where it has less than two lines of numbers."""
    with _sound(directory / "parts"):
        return _table("probes", probes.joined(directory))


def _table(name, rows):
    if len(rows) < 3:
        return None
    heading, body = rows[0], [row for row in rows[1:] if len(row) == len(rows[0])]
    columns = {}
    for k, column in enumerate(heading):
        try:
            columns[column] = np.array([float(row[k] or "nan") for row in body])
        except ValueError:
            columns[column] = np.array([row[k] for row in body])
    return Table(name, columns)


def all_tables(directory):
    """Every CSV of the run that has at least two lines of numbers; the probes of a run that goes on, or whose launcher was killed, from
    what each program wrote."""
    parts = probes.in_parts(directory)
    tables = [read_table(path) for path in sorted(directory.glob("*.csv")) if not (parts and path.stem == "probes")]
    tables += [joined_probes(directory)] if parts else []
    return [table for table in tables if table]


def convergence(directory):
    """The table of errors, or of differences between levels, `fsi converge` left in the folder, or None."""
    return _json(directory / "converge.json")


def finest_level(directory):
    """The run on the finest grid in a folder of `fsi converge`; the folder itself where it is that of a run."""
    levels = [path for path in directory.glob("level_*") if path.name.removeprefix("level_").isdecimal()]
    return max(levels, key=lambda path: int(path.name.removeprefix("level_")), default=directory)


def study(directory):
    """What `fsi study` left in the folder, or None."""
    return _json(directory / "study.json")


def disk_reference(directory):
    """{t: {"gas" or "solid": {column: values}}} of a rotating disk over its radius; empty for other runs."""
    return _reference(directory, "r")


def piston_reference(directory):
    """The same of a piston or a tube along its axis; of a gas alone without "solid"."""
    return _reference(directory, "x")


def _reference(directory, coordinate):
    """The one-dimensional solution beside a run, if it is one over this coordinate of the gas."""
    path = directory / "reference.h5"
    if not path.is_file():
        return {}
    with _sound(path), h5py.File(path, "r") as file:
        if not all(coordinate in group.get("gas", ()) for group in file.values()):
            return {}
        return {float(group.attrs["t"]): {part: {key: np.asarray(group[part][key]) for key in group[part]}
                                          for part in ("gas", "solid") if part in group} for group in file.values()}
