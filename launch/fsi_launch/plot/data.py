"""Reads what a run wrote (layout: docs/output.md): fields of each program over its output times, and tables."""

import csv
from dataclasses import dataclass

import h5py
import numpy as np

COORDINATES = ("x", "x1", "x2", "x1_bar", "x2_bar")  # "x" holds x1 and x2 side by side, for ParaView


@dataclass
class Grid:
    """One component grid at one output time; arrays are indexed [j, i], j along the second grid direction."""

    name: str
    x1: np.ndarray
    x2: np.ndarray
    fields: dict

    def speed(self):
        return np.hypot(self.fields["v1"], self.fields["v2"])


@dataclass
class Output:
    """All grids of one program at one output time."""

    t: float
    grids: list


@dataclass
class Series:
    """The outputs of one program: `name` is "fluid" or the solid's name."""

    name: str
    outputs: list

    def is_gas(self):
        return self.name == "fluid"


@dataclass
class Table:
    """A table of numbers over time: {column: values}."""

    name: str
    columns: dict


def _read_grid(name, group):
    fields = {key: np.asarray(group[key]) for key in group if key not in COORDINATES}
    return Grid(name, np.asarray(group["x1"]), np.asarray(group["x2"]), fields)


def _read_series(path, name):
    outputs = []
    with h5py.File(path, "r") as file:
        for key in sorted(file):
            group = file[key]
            outputs.append(Output(float(group.attrs["t"]), [_read_grid(grid, group[grid]) for grid in group]))
    return Series(name, outputs)


def all_series(directory):
    """The gas first, then the solids by name."""
    series = [_read_series(path, "fluid") for path in directory.glob("fluid.h5")]
    for path in sorted(directory.glob("solid_*.h5")):
        series.append(_read_series(path, path.stem.removeprefix("solid_")))
    return [one for one in series if one.outputs]


def _read_table(path):
    with open(path, encoding="utf-8", newline="") as file:
        rows = [row for row in csv.reader(file) if row]
    if len(rows) < 3:
        return None
    heading, body = rows[0], [row for row in rows[1:] if len(row) == len(rows[0])]
    columns = {}
    for k, name in enumerate(heading):
        try:
            columns[name] = np.array([float(row[k] or "nan") for row in body])
        except ValueError:
            columns[name] = np.array([row[k] for row in body])
    return Table(path.stem, columns)


def all_tables(directory):
    """Every CSV of the run that has at least two lines of numbers."""
    tables = [_read_table(path) for path in sorted(directory.glob("*.csv"))]
    return [table for table in tables if table]
