"""Numbers and curves of a run, as the entries of problem.json ask for them."""

import json

import numpy as np

from fsi_launch.results import summary
from fsi_launch.failure import EXPECTATION_MISSED, Failure
from fsi_launch.plot.reading import data


def _columns(run, name):
    """{bare heading: values} of a table of the run."""
    table = data.read_table(run / f"{name}.csv")
    if table is None:
        raise Failure(EXPECTATION_MISSED, f"{run / name}.csv holds no numbers")
    return {heading.split(" [")[0]: values for heading, values in table.columns.items()}


def _of_table(run, wanted):
    columns = _columns(run, wanted["table"])
    t, values = columns["t"], columns[wanted["column"]] / wanted.get("over", 1)
    when = wanted["at"]
    if when == "largest":
        return float(values.max())
    if when == "time of the largest":
        return float(t[values.argmax()])
    if when == "end":
        return float(values[-1])
    return float(np.interp(when, t, values))


def number(run, wanted):
    """One number of a run: {"summary": PATH}, or {"table": NAME, "column": HEADING, "at": TIME or WORD, "over": SCALE}; None where the
    run has none."""
    if "summary" in wanted:
        return summary.value_at(json.loads((run / "summary.json").read_text(encoding="utf-8")), wanted["summary"])
    return _of_table(run, wanted)


def _last_output(run, program):
    path = next(path for path, name in data.files(run) if name == program)
    return data.read_output(path, len(data.output_times(path)) - 1)


def _abscissa(grid, over):
    if isinstance(over, str):
        return getattr(grid, over)
    x, y = over["distance_from"]
    return np.hypot(grid.x1 - x, grid.x2 - y)


def curve(run, wanted):
    """(abscissae, values) in their order: {"table": NAME, "x": HEADING, "y": HEADING, "over": SCALE} over time, or of all points of a
    program at the end {"program": NAME, "field": NAME, "over": "x1", "x2" or {"distance_from": [x, y]}}."""
    if "table" in wanted:
        columns = _columns(run, wanted["table"])
        return columns[wanted["x"]], columns[wanted["y"]] / wanted.get("scale", 1)
    x, y = [], []
    for grid in _last_output(run, wanted["program"]).grids:
        used = grid.used()
        values = getattr(grid, wanted["field"]) if wanted["field"] in ("x1", "x2") else grid[wanted["field"]]
        x.append(_abscissa(grid, wanted["over"])[used])
        y.append(values[used])
    x, y = np.concatenate(x), np.concatenate(y)
    order = np.argsort(x, kind="stable")
    return x[order], y[order]


def reference(path):
    """{column: values} of a data file; # begins a comment."""
    with open(path, encoding="utf-8") as file:
        lines = [line for line in file if line.strip() and not line.startswith("#")]
    heading, *rows = ([word.strip() for word in line.split(",")] for line in lines)
    return {name: np.array([float(row[k]) for row in rows]) for k, name in enumerate(heading)}


def distance(computed, known):
    """Mean distance of a computed curve from the known one over the range of the latter's values; where both are known."""
    (x, y), (x_known, y_known) = computed, known
    both = (x >= x_known.min()) & (x <= x_known.max())
    return float(np.abs(y[both] - np.interp(x[both], x_known, y_known)).mean() / np.ptp(y_known))
