"""Boundary curves of several runs on one plot (the paper's figures 17 to 19), and how far they are apart."""

import csv
from dataclasses import dataclass

import numpy as np
from matplotlib import pyplot
from matplotlib.lines import Line2D

from fsi_launch.plot import style

SAME_TIME = 1e-9
MOST_TIMES = 3
COLOURS = ("#2b5ea8", "#1d8a3d", "#b5281e", "#8a5a00", "#7a3fa0", "#3b3b3b")
LINES = ("-", "--", "-.", ":")


@dataclass
class Body:
    """Closed outlines of one solid: {t: points (n, 2), the last one the first again}."""

    name: str
    outlines: dict


def _outline(grids):
    """The longer rim of the last closed grid, or None."""
    closed = [grid for grid in grids if grid.closed]
    if not closed:
        return None
    rims = [np.column_stack([closed[-1].x1[row], closed[-1].x2[row]]) for row in (0, -1)]
    return max(rims, key=lambda rim: np.hypot(*np.diff(rim, axis=0).T).sum())


def of(series):
    """The bodies of a run that have an outline."""
    bodies = [Body(one.name, {output.t: _outline(output.grids) for output in one.outputs})
              for one in series if not one.is_gas()]
    return [body for body in bodies if all(line is not None for line in body.outlines.values())]


def distance(points, curve):
    """Largest distance of points from a closed polygon."""
    a, b = curve[:-1], curve[1:]
    along = b - a
    length2 = np.maximum((along ** 2).sum(axis=1), 1e-300)
    worst = 0.0
    for point in points:
        part = np.clip(((point - a) * along).sum(axis=1) / length2, 0, 1)
        worst = max(worst, np.hypot(*(a + part[:, None] * along - point).T).min())
    return worst


# --- what tells the runs apart


def _entries(case):
    """{dotted key: value} of a resolved case file."""
    result, path = {}, []
    for line in case.splitlines():
        key, colon, value = line.strip().partition(":")
        if not colon or line.strip().startswith(("#", "-")):
            continue
        depth = (len(line) - len(line.lstrip())) // 2
        path = path[:depth] + [key]
        if value.strip():
            result[".".join(path)] = value.strip()
    return result


def _short(key, value):
    last = key.rsplit(".", 1)[-1]
    if key == "grid.factor":
        return f"h = 1/{10 * float(value):g}"
    return value.replace("_", " ") if last in ("law", "projection") else f"{last} = {value}"


TELLING = ("law", "factor", "projection", "multirate")


def labels(cases, names):
    """What is different about each run, in few words; else the names of the folders."""
    entries = [_entries(case) for case in cases]
    keys = [key for key in dict.fromkeys(key for one in entries for key in one)
            if len({one.get(key) for one in entries}) > 1
            and (key.startswith("parameters.") or key.rsplit(".", 1)[-1] in TELLING)]
    result = [", ".join(_short(key, one[key]) for key in keys if key in one) for one in entries]
    return result if len(set(result)) == len(result) else list(names)


# --- comparison


def _common_times(bodies):
    first, *others = bodies
    times = [t for t in first.outlines if t > 0 and all(_at(body, t) is not None for body in others)]
    if len(times) <= MOST_TIMES:
        return times
    return [times[round(k)] for k in np.linspace(0, len(times) - 1, MOST_TIMES)]


def _at(body, t):
    return next((line for other, line in body.outlines.items() if abs(other - t) < SAME_TIME), None)


def _picture(name, bodies, names):
    times = _common_times(bodies)
    if not times:
        return None
    figure, axes = pyplot.subplots(figsize=(7.4, 5.2))
    for k, body in enumerate(bodies):
        for t in times:
            axes.plot(*_at(body, t).T, color=COLOURS[k % len(COLOURS)], linestyle=LINES[k % len(LINES)], linewidth=1.3)
    for t in times:
        low = min((_at(body, t) for body in bodies), key=lambda line: line[:, 1].min())
        at = low[low[:, 1].argmin()]
        axes.annotate(f"t = {t:g}", at, xytext=(0, -9), textcoords="offset points", ha="center", va="top", fontsize=8)
    axes.set_aspect("equal")
    axes.margins(0.06, 0.1)
    axes.set_title(f"boundary of {name}", loc="left")
    handles = [Line2D([], [], color=COLOURS[k % len(COLOURS)], linestyle=LINES[k % len(LINES)], label=label)
               for k, label in enumerate(names)]
    axes.legend(handles=handles, loc="upper left", bbox_to_anchor=(1.0, 1.0), handlelength=2.2)
    return figure


def table(name, bodies, names):
    """[(solid, run, other run, t, largest distance of their outlines)] of every run against the next one."""
    rows = []
    for (a, label), (b, other) in zip(zip(bodies, names), zip(bodies[1:], names[1:])):
        for t in a.outlines:
            if t > 0 and (curve := _at(b, t)) is not None:
                apart = max(distance(a.outlines[t], curve), distance(curve, a.outlines[t]))
                rows.append((name, label, other, t, apart))
    return rows


def write_table(rows, path):
    with open(path, "w", encoding="utf-8", newline="") as file:
        writer = csv.writer(file)
        writer.writerow(["solid", "run", "other run", "t [time]", "largest distance [length]"])
        writer.writerows(rows)


def pictures(runs, cases, names, out):
    """(name, figure) for each solid that is in all runs. `runs`: the series of each, `cases`: the texts of their cases."""
    named = [{body.name: body for body in of(series)} for series in runs]
    told = labels(cases, names)
    rows = []
    for name in named[0]:
        bodies = [one.get(name) for one in named]
        if None in bodies:
            continue
        if figure := _picture(name, bodies, told):
            yield f"outlines_{name}", figure
            rows += table(name, bodies, told)
    if rows:
        write_table(rows, out / "outlines.csv")
        for name, label, other, t, apart in rows:
            print(f"{name}, {label} against {other}, t = {t:g}: {apart:.2e}")
