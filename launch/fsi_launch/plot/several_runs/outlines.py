"""Boundary curves of several runs on one plot (the paper's figure 17), and how far they are apart."""

import itertools
import textwrap
from dataclasses import dataclass

import numpy as np
from matplotlib import pyplot
from matplotlib.colors import to_rgb
from matplotlib.lines import Line2D

from fsi_launch.plot.look import style, units
from fsi_launch.plot.reading import data, mesh
from fsi_launch.plot.several_runs import several
from fsi_launch.telling import tell

HEADING = ("solid", "run", "other run", "t [time]", "largest distance [length]")
COLOURS = ("#2b5ea8", "#1d8a3d", "#b5281e", "#8a5a00", "#7a3fa0", "#3b3b3b")
LINES = ("-", "--", "-.", ":")
CLOSED = 1e-9       # part of its length by which a closed curve's ends are apart
PALEST = 0.4        # part of its colour that the earliest outline has, the rest is white
AXES = (400, 310)   # size of the axes in the picture at most [points]
NARROWEST = 160     # that they are, and 0.5 of it their least height [points]
LABEL = (52, 12)    # room that the name of a time takes [points]
UNDER = 9           # a curve, that much [points]
BESIDE = 20         # letters of a label that stands beside the axes; longer ones stand under them
LETTER = 4.6        # of a label [points]


@dataclass
class Body:
    """Outlines of one solid: {t: points (n, 2)}; of a closed one the last point is the first again."""

    name: str
    outlines: dict


def _length(curve):
    return np.hypot(*np.diff(curve, axis=0).T).sum()


def _longer_rim(grid, rows=(0, -1)):
    return max((np.column_stack([grid.x1[row], grid.x2[row]]) for row in rows), key=_length)


def ring(grids):
    """The longer rim of the last closed grid, or None."""
    closed = [grid for grid in grids if grid.closed]
    return _longer_rim(closed[-1]) if closed else None


def outline(grids):
    """The same; of a body that stands on walls that of its fitted grid, between the walls, and of a block all of its rim. None where none
    of its grids follows it."""
    if (found := ring(grids)) is not None:
        return found
    if len(grids) == 1 and not grids[0].fan:
        return max(mesh.outer_lines(grids[0]), key=_length)
    fitted = [grid for grid in grids if not grid.is_cartesian()]
    rows = [row for row in (0, -1) if (fitted[-1].kind[row] != data.INTERPOLATED).mean() > 0.5] if fitted else []
    return _longer_rim(fitted[-1], rows or (0, -1)) if fitted else None


def of(series, outline_of=outline):
    """The bodies of a run that have an outline; `outline_of`: their grids."""
    bodies = [Body(one.name, {output.t: outline_of(output.grids) for output in one.outputs})
              for one in series if not one.is_gas()]
    return [body for body in bodies if all(line is not None for line in body.outlines.values())]


def distance(points, curve):
    """Largest distance of points from the lines between those of a curve."""
    a, b = curve[:-1], curve[1:]
    along = b - a
    length2 = np.maximum((along ** 2).sum(axis=1), 1e-300)
    worst = 0.0
    for point in points:
        part = np.clip(((point - a) * along).sum(axis=1) / length2, 0, 1)
        worst = max(worst, np.hypot(*(a + part[:, None] * along - point).T).min())
    return worst


def apart(one, other):
    """Largest distance of two outlines. Of a rigid body before a gas no more may be known than the side that meets it: that is compared with
    the whole rim of another run's, not the rim with it."""
    ways = [(a, b) for a, b in ((one, other), (other, one)) if _is_closed(b) or not _is_closed(a)]
    return max(distance(a, b) for a, b in ways)


def _is_closed(curve):
    return np.hypot(*(curve[-1] - curve[0])) <= CLOSED * _length(curve)


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


def _name_times(axes, curves, scale):
    """Times under the lowest points of their curves, on lines of their own where they would overlap.
    `curves`: {t: outlines}; `scale`: points in a unit of length."""
    lowest = [min((line[line[:, 1].argmin()] for line in lines), key=lambda point: point[1]) for lines in curves.values()]
    down = levels([scale * at for at in lowest])
    parts = shades(list(curves))
    for t, at, level in zip(curves, lowest, down):
        axes.annotate(units.moment(t), at, xytext=(0, -UNDER - level * LABEL[1]), textcoords="offset points", ha="center", va="top",
                      fontsize=8, color=_shaded("black", parts[t]), arrowprops={"arrowstyle": "-", "linewidth": 0.4, "color": "#888888"} if level else None,
                      zorder=4 - 0.01 * level, bbox={"facecolor": "white", "edgecolor": "none", "pad": 0.5})   # over the lines to those below
    (bottom, top), ends = axes.get_ylim(), [at[1] - (UNDER + (level + 1) * LABEL[1]) / scale for at, level in zip(lowest, down)]
    axes.set_ylim(min(bottom, *ends), top)


def _name_runs(axes, names, width):
    """Which line is which run: beside the axes, or under them, over `width` [points], where that takes more than a few letters."""
    handles = [Line2D([], [], color=COLOURS[k % len(COLOURS)], linestyle=LINES[k % len(LINES)], label=label)
               for k, label in enumerate(names)]
    if max(map(len, names)) <= BESIDE:
        axes.legend(handles=handles, loc="upper left", bbox_to_anchor=(1.0, 1.0), handlelength=2.2)
        return 0
    for handle, label in zip(handles, names):
        handle.set_label(textwrap.fill(label, max(BESIDE, int(width / LETTER) - 6), break_long_words=False))
    axes.legend(handles=handles, loc="upper left", bbox_to_anchor=(0.0, 0.0), borderaxespad=4.5, borderpad=0, handlelength=2.2)
    return sum(handle.get_label().count("\n") + 1 for handle in handles)


def _picture(name, bodies, names):
    times = several.few(several.common_times([body.outlines for body in bodies]))
    if not times:
        return None
    curves = {t: [several.at(body.outlines, t) for body in bodies] for t in times}
    width, height = np.ptp(np.concatenate([line for lines in curves.values() for line in lines]), axis=0)
    scale = min(AXES[0] / max(width, 1e-300), AXES[1] / max(height, 1e-300))
    room = max(scale * width, NARROWEST), max(scale * height, 0.5 * NARROWEST)
    figure, axes = pyplot.subplots()
    for k in range(len(bodies)):
        for lines, part in zip(curves.values(), shades(times).values()):
            axes.plot(*lines[k].T, color=_shaded(COLOURS[k % len(COLOURS)], part), linestyle=LINES[k % len(LINES)], linewidth=1.3)
    axes.set_aspect("equal")
    axes.margins(0.06, 0.1)
    _name_times(axes, curves, scale)
    axes.set_title(f"boundary of {name}", loc="left")
    style.name_axes(np.array([[axes]]))
    rows = _name_runs(axes, names, room[0])
    bottom, top = axes.get_ylim()
    figure.set_size_inches((1.12 * room[0] + (60 if rows else 75 + LETTER * max(map(len, names)))) / 72,
                           (max(scale * (top - bottom), room[1]) + 80 + 13 * rows) / 72)
    return figure


def table(name, bodies, names):
    """[(solid, run, other run, t, largest distance of their outlines)] of every run against the next one."""
    rows = []
    for (a, label), (b, other) in zip(zip(bodies, names), zip(bodies[1:], names[1:])):
        for t in a.outlines:
            if t > 0 and (curve := several.at(b.outlines, t)) is not None:
                rows.append((name, label, other, t, apart(a.outlines[t], curve)))
    return rows


def pictures(series, told, out, but=()):
    """(name, figure) for each solid that is in all runs. `series`: those of each run; `told`: what to call the runs; `but`: names of those
    of which other pictures say more."""
    named = [{body.name: body for body in of(one)} for one in series]
    rows = []
    for name in dict.fromkeys(solid.name for one in series for solid in one if not solid.is_gas() and solid.name not in but):
        bodies = [one.get(name) for one in named]
        if None in bodies:
            tell(f"outlines: {name} is left out: it is not in all of these runs, or has no outline by one grid")
            continue
        if figure := _picture(name, bodies, told):
            yield f"outlines_{name}", figure
            rows += table(name, bodies, told)
    if rows:
        several.write_table(HEADING, rows, out / "outlines.csv")
        for name, label, other, t, largest in rows:
            far = f"{largest:.2e} {units.symbol('length')}".rstrip()
            print(f"{name}: outlines of {label} and {other} at {units.moment(t)} are up to {far} apart")
