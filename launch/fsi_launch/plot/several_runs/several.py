"""Several runs beside each other: what tells them apart, and which output times they share."""

import csv
import os
from pathlib import Path

import numpy as np

from fsi_launch.case import FORMULA, formulas
from fsi_launch.plot.look import caption, units
from fsi_launch.plot.reading import data
from fsi_launch.results import whole_file
from fsi_launch.telling import readable

MOST_TIMES = 3
TELLING = ("law", "factor", "projection", "multirate")
UNSAID = {"interface.projection": "simplified", "time.multirate": "false"}  # what a case without the key has


def entries(case):
    """{dotted key: value} of the text of a resolved case file."""
    result, path = {}, []
    for line in case.splitlines():
        key, colon, value = line.strip().partition(":")
        if not colon or line.strip().startswith(("#", "-")):
            continue
        depth = (len(line) - len(line.lstrip())) // 2
        path = path[:depth] + [key]
        if value := value.partition(FORMULA)[0].strip():
            result[".".join(path)] = value
    return result


def _rounded(value):
    """A number as people read it; other words as they are."""
    try:
        return f"{float(value):.6g}"
    except ValueError:
        return value


def short(key, value, solids):
    """One entry in few words, with its solid's name where a run has several. `solids`: the names of all."""
    *_, owner, last = ("", *key.split("."))
    if key == "grid.factor":
        return caption.spacing(float(value), units.symbol("length"))
    said = value.replace("_", " ") if last in ("law", "projection") else f"{last} = {_rounded(value)}"
    return f"{owner}: {said}" if len(solids) > 1 and owner in solids else said


def different(cases):
    """The keys in which cases differ, in their order. `cases`: what `entries` says of each."""
    return [key for key in dict.fromkeys(key for one in cases for key in one) if len({one.get(key) for one in cases}) > 1]


def derived(cases):
    """Keys of the parameters that have one formula in all cases: they differ because others do. `cases`: texts of case files."""
    found = [formulas(case) for case in cases]
    return {f"parameters.{name}" for name, formula in found[0].items() if all(one.get(name) == formula for one in found)}


def labels(cases, names):
    """What was written or set differently for each run, in few words; else the names of the folders. `cases`: texts of case files."""
    found, follow = [UNSAID | entries(case) for case in cases], derived(cases)
    keys = [key for key in different(found) if key not in follow and (key.startswith("parameters.") or key.rsplit(".", 1)[-1] in TELLING)]
    solids = {key.split(".")[1] for one in found for key in one if key.startswith("solids.")}
    result = [", ".join(short(key, one[key], solids) for key in keys if key in one) for one in found]
    return result if len(set(result)) == len(result) else list(names)


def names(directories):
    """Names of folders, with those above them as far as it takes to tell them apart."""
    places = [Path(os.path.abspath(one)).parts for one in directories]
    for depth in range(1, max(map(len, places)) + 1):
        found = ["/".join(parts[-depth:]) for parts in places]
        if len(set(found)) == len(found):
            break
    return [readable(one) for one in found]


def at(values, t):
    """The value of {time: value} at a time, or None."""
    return next((value for other, value in values.items() if data.same_time(other, t)), None)


def common_times(runs):
    """Times after the start at which each of the {time: value} has one."""
    first, *others = runs
    return [t for t in first if t > 0 and all(at(other, t) is not None for other in others)]


def few(times):
    """At most MOST_TIMES of them, spread evenly."""
    if len(times) <= MOST_TIMES:
        return times
    return [times[round(k)] for k in np.linspace(0, len(times) - 1, MOST_TIMES)]


def write_table(heading, rows, path):
    path.parent.mkdir(parents=True, exist_ok=True)
    with whole_file.writing(path, newline="") as file:
        writer = csv.writer(file)
        writer.writerow(heading)
        writer.writerows(rows)
