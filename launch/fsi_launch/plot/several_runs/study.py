"""What `fsi study` found: each quantity over the value that was varied, one line for each combination of the others."""

import itertools

import numpy as np
from matplotlib import pyplot

from fsi_launch.plot.look import caption, units
from fsi_launch.plot.one_run import curves

MARKERS = "os^vD<>ph*"
DASHES = ("-", "--", ":", "-.")     # so that lines over each other are both seen
DECADES = 1.3       # values of one sign that span more of them are drawn over a logarithmic axis
COLUMNS = 3
ROUND_OFF = 1e-13   # errors up to this one are none
FAILED = {"color": "#b5281e", "marker": "x", "linestyle": "", "clip_on": False, "label": "failed"}


def _is_number(text):
    try:
        float(text)
    except ValueError:
        return False
    return True


def _scale(values):
    values = np.asarray([value for value in values if value is not None and np.isfinite(value)])
    if len(values) < 2 or values.min() <= 0:
        return "linear"
    return "log" if np.log10(values.max() / values.min()) > DECADES else "linear"


def _abscissa(vary):
    """The key over which is drawn: the first whose values are numbers; None where there is none."""
    return next((key for key, values in vary.items() if len(values) > 1 and all(map(_is_number, values))), None)


def _short(keys):
    """{key: its last part, or all of it where several end alike}"""
    last = [key.rpartition(".")[2] for key in keys]
    return {key: one if last.count(one) == 1 else key for key, one in zip(keys, last)}


def _title(result, quantity):
    """The quantity with its unit: of a column that of its heading, of an error that of its field."""
    known = result.get("units", {}).get(quantity, "")
    return units.label(quantity, known or (curves.unit_of(quantity) if quantity.startswith("errors.") else ""))


def _lines(result, key):
    """{label of the other values: rows in the order of `key`}"""
    lines, short = {}, _short(list(result["vary"]))
    for row in result["rows"]:
        others = ", ".join(f"{short[name]} = {value}" for name, value in row["values"].items() if name != key)
        lines.setdefault(others, []).append(row)
    return {label: sorted(rows, key=lambda row: float(row["values"][key])) for label, rows in lines.items()}


def _failures(axes, result, key):
    """Marks at the upper edge, over the values with which a run failed."""
    at = [float(row["values"][key]) for row in result["rows"] if row["status"] == "failed"]
    if at:
        axes.plot(at, np.full(len(at), 0.97), transform=axes.get_xaxis_transform(), **FAILED)


def _panel(axes, result, key, quantity):
    found = [row["quantities"][quantity] for row in result["rows"]]
    _failures(axes, result, key)
    lines = _lines(result, key)
    for (label, rows), marker, dash in zip(lines.items(), itertools.cycle(MARKERS), itertools.cycle(DASHES)):
        points = [(float(row["values"][key]), row["quantities"][quantity]) for row in rows if row["quantities"][quantity] is not None]
        axes.plot(*zip(*points) if points else ((), ()), dash, marker=marker, markersize=4.5, markerfacecolor="none", label=label or None)
    axes.set_xscale(_scale([float(value) for value in result["vary"][key]]))
    if quantity.startswith("errors.") and max(abs(value) for value in found if value is not None) <= ROUND_OFF:
        axes.set_ylim(-1, 1)
        axes.set_yticks([0])
    else:
        axes.set_yscale(_scale(found))
    axes.set_title(_title(result, quantity), loc="left")
    axes.set_xlabel(key.removeprefix("parameters."))
    axes.grid(color="#e4e4e4", linewidth=0.6)


def pictures(result):
    """(name, figure); none where nothing was varied that can be an axis."""
    key = _abscissa(result["vary"]) if result else None
    shown = [name for name in result["quantities"] if any(row["quantities"][name] is not None for row in result["rows"])] if key else []
    if not shown:
        return
    columns = min(COLUMNS, len(shown))
    rows = -(-len(shown) // columns)
    figure, panels = pyplot.subplots(rows, columns, figsize=(3.4 * columns, 2.7 * rows), squeeze=False)
    for axes, quantity in zip(panels.flat, shown):
        _panel(axes, result, key, quantity)
    for axes in list(panels.flat)[len(shown):]:
        axes.set_visible(False)
    if len(result["vary"]) > 1 or any(row["status"] == "failed" for row in result["rows"]):
        panels.flat[0].legend()
    caption.head(figure, result["case"])
    yield "study", figure
