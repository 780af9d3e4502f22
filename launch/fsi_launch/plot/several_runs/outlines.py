"""Boundary curves of several runs on one plot (the paper's figure 17), and how far they are apart."""

import itertools
from dataclasses import dataclass

import numpy as np
from matplotlib import pyplot
from matplotlib.colors import to_rgb
from matplotlib.lines import Line2D

from fsi_launch.plot.look import style, units
from fsi_launch.plot.several_runs import several

HEADING = ("solid", "run", "other run", "t [time]", "largest distance [length]")
COLOURS = ("#2b5ea8", "#1d8a3d", "#b5281e", "#8a5a00", "#7a3fa0", "#3b3b3b")
LINES = ("-", "--", "-.", ":")
PALEST = 0.4        # part of its colour that the earliest outline has, the rest is white
AXES = (360, 300)   # size of the axes in the picture, roughly [points]
LABEL = (52, 12)    # room that the name of a time takes [points]


@dataclass
class Body:
    """Closed outlines of one solid: {t: points (n, 2), the last one the first again}."""

    name: str
    outlines: dict


def outline(grids):
    """The longer rim of the last closed grid, or None."""
    closed = [grid for grid in grids if grid.closed]
    if not closed:
        return None
    rims = [np.column_stack([closed[-1].x1[row], closed[-1].x2[row]]) for row in (0, -1)]
    return max(rims, key=lambda rim: np.hypot(*np.diff(rim, axis=0).T).sum())


def of(series):
    """The bodies of a run that have an outline."""
    bodies = [Body(one.name, {output.t: outline(output.grids) for output in one.outputs})
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


# --- comparison


def levels(places):
    """How many lines each label goes down so that none lies over an earlier one. `places`: their upper ends [points]."""
    width, height = LABEL
    down = []
    for x, y in places:
        taken = [other[1] - height * k for other, k in zip(places, down) if abs(x - other[0]) < width]
        down.append(next(k for k in itertools.count() if all(abs(y - height * k - other) >= height for other in taken)))
    return down


def shades(times):
    """{time: part of the colour}, the later the more."""
    return dict(zip(times, np.linspace(PALEST, 1, len(times)) if len(times) > 1 else (1.0,)))


def _shaded(colour, part):
    return tuple(1 - part * (1 - channel) for channel in to_rgb(colour))


def _name_times(axes, curves):
    """Times under the lowest points of their curves, on lines of their own where they would overlap.
    `curves`: {t: outlines}."""
    lowest = [min((line[line[:, 1].argmin()] for line in lines), key=lambda point: point[1]) for lines in curves.values()]
    (left, right), (bottom, top) = axes.get_xlim(), axes.get_ylim()
    scale = min(AXES[0] / (right - left), AXES[1] / (top - bottom))  # at least as large as the axes will be drawn
    down = levels([scale * at for at in lowest])
    parts = shades(list(curves))
    for t, at, level in zip(curves, lowest, down):
        axes.annotate(units.moment(t), at, xytext=(0, -9 - level * LABEL[1]), textcoords="offset points", ha="center", va="top",
                      fontsize=8, color=_shaded("black", parts[t]), arrowprops={"arrowstyle": "-", "linewidth": 0.4, "color": "#888888"} if level else None,
                      zorder=4 - 0.01 * level, bbox={"facecolor": "white", "edgecolor": "none", "pad": 0.5})   # over the lines to those below
    axes.set_ylim(bottom - max(down) * LABEL[1] / scale, top)


def _picture(name, bodies, names):
    times = several.few(several.common_times([body.outlines for body in bodies]))
    if not times:
        return None
    figure, axes = pyplot.subplots(figsize=(7.4, 5.2))
    for k, body in enumerate(bodies):
        for t, part in shades(times).items():
            axes.plot(*several.at(body.outlines, t).T, color=_shaded(COLOURS[k % len(COLOURS)], part), linestyle=LINES[k % len(LINES)],
                      linewidth=1.3)
    axes.set_aspect("equal")
    axes.margins(0.06, 0.1)
    _name_times(axes, {t: [several.at(body.outlines, t) for body in bodies] for t in times})
    axes.set_title(f"boundary of {name}", loc="left")
    style.name_axes(np.array([[axes]]))
    handles = [Line2D([], [], color=COLOURS[k % len(COLOURS)], linestyle=LINES[k % len(LINES)], label=label)
               for k, label in enumerate(names)]
    axes.legend(handles=handles, loc="upper left", bbox_to_anchor=(1.0, 1.0), handlelength=2.2)
    return figure


def table(name, bodies, names):
    """[(solid, run, other run, t, largest distance of their outlines)] of every run against the next one."""
    rows = []
    for (a, label), (b, other) in zip(zip(bodies, names), zip(bodies[1:], names[1:])):
        for t in a.outlines:
            if t > 0 and (curve := several.at(b.outlines, t)) is not None:
                apart = max(distance(a.outlines[t], curve), distance(curve, a.outlines[t]))
                rows.append((name, label, other, t, apart))
    return rows


def pictures(series, told, out):
    """(name, figure) for each solid that is in all runs. `series`: those of each run; `told`: what to call the runs."""
    named = [{body.name: body for body in of(one)} for one in series]
    rows = []
    for name in named[0]:
        bodies = [one.get(name) for one in named]
        if None in bodies:
            continue
        if figure := _picture(name, bodies, told):
            yield f"outlines_{name}", figure
            rows += table(name, bodies, told)
    if rows:
        several.write_table(HEADING, rows, out / "outlines.csv")
        for name, label, other, t, apart in rows:
            far = f"{apart:.2e} {units.symbol('length')}".rstrip()
            print(f"{name}: outlines of {label} and {other} at {units.moment(t)} are up to {far} apart")
