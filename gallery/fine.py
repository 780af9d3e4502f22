#!/usr/bin/python3
"""Writes the data files of the problems that are held against a run on a finer grid: gallery/fine.py NAME FOLDER_OF_THE_RUN.

The run is that of the problem, on the grid that is named here; without any code of the launcher, so that runs of other codes can be
brought into the same form."""

import csv
import sys
from pathlib import Path

ROUND_OFF = 1e-12
FOLDER = Path(__file__).resolve().parent
ELLIPSE = ("forces_ellipse", {name: name for name in ("centre1", "centre2", "velocity1", "velocity2", "angle", "force1", "force2")}, 2.0, 201)
# name: (the run, (table, {column: name in data.csv}, last time, lines))
PROBLEMS = {
    "cylinder_in_shock": ("grid.factor=32, h = 1/320", ("probes", {"front.p": "p"}, 1.5, 301)),
    "shocked_ellipse": ("grid.factor=8, h = 1/80", ELLIPSE),
    "shocked_rigid_ellipse": ("grid.factor=8, h = 1/80", ELLIPSE),
}


def columns(path):
    with open(path, encoding="utf-8", newline="") as file:
        heading, *rows = csv.reader(file)
    return {name.split(" [")[0]: [float(row[k]) for row in rows] for k, name in enumerate(heading)}


def at(x, xs, ys):
    """Linear between the rows of a table."""
    k = max(1, next((k for k, one in enumerate(xs) if one >= x), len(xs) - 1))
    return ys[k - 1] + (x - xs[k - 1]) / (xs[k] - xs[k - 1]) * (ys[k] - ys[k - 1])


def main(name, run):
    about, (table, wanted, end, lines) = PROBLEMS[name]
    known = columns(Path(run) / f"{table}.csv")
    with open(FOLDER / name / "data.csv", "w", encoding="utf-8", newline="") as file:
        file.write(f"# computed by this code with {about}; {table}.csv\n")
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(["t", *wanted.values()])
        for k in range(lines):
            t = end * k / (lines - 1)
            writer.writerow([f"{value if abs(value) > ROUND_OFF else 0:.7g}" for value in (t, *(at(t, known["t"], known[column]) for column in wanted))])


if __name__ == "__main__":
    main(*sys.argv[1:])
