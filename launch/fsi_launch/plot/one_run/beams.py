"""Centrelines of beams (the paper's figures 22 and 23): solids that stand on a wall with both ends of their outline."""

import itertools
import re
from dataclasses import dataclass

import numpy as np
from matplotlib import pyplot
from matplotlib.tri import LinearTriInterpolator

from fsi_launch.case import formulas
from fsi_launch.plot.look import style, units
from fsi_launch.plot.reading import mesh, scales
from fsi_launch.plot.several_runs import several

HEADING = ("beam", "coarse", "fine", "t", "largest distance")
SLENDER = 3         # a beam is so many times longer than it is thick
STATIONS = 201      # along a centreline
NARROW = 0.1        # room of all lines, width over height, below which the two directions have scales of their own
LINES = {"full": "-", "dashed": "--", "dotted": ":", "dash-dot": "-.", "long dashes": (0, (9, 3)), "wide dots": (0, (1, 4))}
UNTOLD = ("grid.factor", "name", "title", "units", "expect.", "output.", "reference.")   # entries in which runs of one panel may differ


@dataclass
class Beam:
    """Centrelines of one solid: {t: positions (stations, 2)}; stations by their distance from the wall at rest."""

    name: str
    stations: np.ndarray
    lines: dict


@dataclass
class Run:
    """A run and what tells it from others: the entries of its case, and apart the grid factor and the laws of its beams."""

    entries: dict
    factor: float
    beams: list
    laws: str = ""

    def beam(self, name):
        return next((beam for beam in self.beams if beam.name == name), None)


# --- centrelines


def _axis(grid):
    """Reference ends of the centreline of the body a fitted grid belongs to, or None where it is no beam."""
    outline = np.column_stack([grid.fields["x1_bar"][0], grid.fields["x2_bar"][0]])
    foot = 0.5 * (outline[0] + outline[-1])
    across = outline[-1] - outline[0]
    width = np.hypot(*across)
    along = np.array([-across[1], across[0]]) / width
    heights = (outline - foot) @ along
    heights = heights if heights.max() > -heights.min() else -heights
    if heights.max() < SLENDER * width:
        return None
    return foot, foot + heights.max() * np.sign((outline[heights.argmax()] - foot) @ along) * along


def _displacement(grids, x, y):
    """Displacements (len(x), 2) at reference positions; grids that come last win."""
    u = np.full((len(x), 2), np.nan)
    for grid in grids:
        cells = mesh.triangles(grid)
        if not cells:
            continue
        cells = type(cells)(grid.fields["x1_bar"].ravel(), grid.fields["x2_bar"].ravel(), cells.triangles)
        for c in (0, 1):
            values = np.where(grid.used(), grid.fields[f"u{c + 1}"], 0).ravel()
            found = LinearTriInterpolator(cells, values)(x, y).filled(np.nan)
            u[:, c] = np.where(np.isnan(found), u[:, c], found)
    return u


def _displacement_of_line(grid, ends, s):
    """Displacements (len(s), 2) along the centreline of a body that is a beam by law: its second line of points goes up one side of
    the centreline, just beside it, and down the other; their mean is that of the centreline."""
    axis = ends[1] - ends[0]
    places = np.column_stack([grid.fields["x1_bar"][1], grid.fields["x2_bar"][1]])
    heights = (places - ends[0]) @ axis / (axis @ axis)
    top = heights.argmax()
    up, down = np.s_[:top + 1], np.s_[:top - 1 if top else None:-1]
    return np.column_stack([np.mean([np.interp(s, heights[side], u[side]) for side in (up, down)], axis=0)
                            for u in (grid.fields["u1"][1], grid.fields["u2"][1])])


def _beam(one):
    """The beam a program computed, or None: a rigid body, two lines of points without a rotation of their own, is none."""
    fitted = [grid for grid in one.outputs[0].grids if not grid.is_cartesian() and not grid.closed]
    rigid = len(fitted) == 1 and fitted[0].fan and "theta" not in fitted[0].fields
    ends = _axis(fitted[0]) if len(fitted) == 1 and not rigid else None
    if ends is None:
        return None
    s = np.linspace(0, 1 - 1e-9, STATIONS)[:, None]
    reference = (1 - s) * ends[0] + s * ends[1]
    if "theta" in fitted[0].fields:
        lines = {output.t: reference + _displacement_of_line(output.grids[0], ends, s[:, 0]) for output in one.outputs}
    else:
        lines = {output.t: reference + _displacement(output.grids, *reference.T) for output in one.outputs}
    known = np.isfinite(np.concatenate(list(lines.values()), axis=1)).all(axis=1)
    stations = s[known, 0] * np.hypot(*(ends[1] - ends[0]))
    return Beam(one.name, stations, {t: position[known] for t, position in lines.items()})


def of(series):
    """All beams among the programs of a run."""
    return [beam for beam in map(_beam, (one for one in series if not one.is_gas())) if beam]


def run_of(series, case):
    """A run for comparison; `case`: the text of its case file. Parameters with one formula differ only because others do."""
    entries = several.entries(case) | {f"parameters.{name}": formula for name, formula in formulas(case).items()}
    factor = float(entries.get("grid.factor", 0))
    found = of(series)
    unsaid = {key: value for key, value in several.UNSAID.items() if key not in entries}
    return Run(entries | unsaid, factor, found, ", ".join(entries.get(f"solids.{beam.name}.law", "").replace("_", " ") for beam in found))


# --- comparison


def distances(a, b):
    """{t: largest distance between the same stations of two centrelines}."""
    stations = np.linspace(0, min(a.stations[-1], b.stations[-1]), STATIONS)

    def at(beam, line):
        return np.array([np.interp(stations, beam.stations, x) for x in line.T])

    return {t: np.hypot(*(at(a, a.lines[t]) - at(b, several.at(b.lines, t)))).max()
            for t in several.common_times([a.lines, b.lines])}


def _telling(one, other):
    """The entries in which two runs differ besides their grid, what they write and their laws; a solid with another law has other entries."""
    keys = [key for key in several.different([one.entries, other.entries]) if not key.startswith(UNTOLD)]
    laws = {key.removesuffix("law") for key in keys if re.fullmatch(r"solids\.[^.]+\.law", key)}
    return [key for key in keys if not key.startswith(tuple(laws))]


def _groups(runs):
    """Lists of runs that differ in their grid or their laws only, the finest first."""
    groups = []
    for run in runs:
        for group in groups:
            if not _telling(group[0], run):
                group.append(run)
                break
        else:
            groups.append([run])
    return [sorted(group, key=lambda run: -run.factor) for group in groups]


def _label(run, runs):
    """The entries in which the runs differ."""
    keys = dict.fromkeys(key for other in runs for key in _telling(run, other) if key in run.entries)
    return ", ".join(several.short(key, run.entries[key], [beam.name for beam in run.beams]) for key in keys)


def table(runs):
    """[(label, coarse factor, fine factor, t, largest distance)] of runs that differ in their grid or their laws only."""
    rows = []
    for group in _groups(runs):
        for fine, coarse in zip(group, group[1:]):
            for beam in fine.beams:
                other = coarse.beam(beam.name)
                found = distances(beam, other) if other else {}
                label = _label(fine, runs) or beam.name
                if fine.laws != coarse.laws:
                    label += f": {coarse.laws} against {fine.laws}"
                rows += [(label, coarse.factor, fine.factor, t, d) for t, d in found.items()]
    return rows


# --- pictures


def _draw(axes, beam, line, colours):
    """`colours`: {time: colour}."""
    for t, positions in sorted(beam.lines.items()):
        axes.plot(*positions.T, linestyle=line, color=colours[t], linewidth=1.1, label=f"{t:.4g}")


def _colours(times):
    """{time: colour}"""
    return dict(zip(times, pyplot.get_cmap(style.GAS_MAP)(np.linspace(0, 0.9, len(times)))))


def _panel(axes, group, title):
    """The runs of a group: the finest, or the first, in full lines, others broken."""
    times = sorted({t for run in group for beam in run.beams for t in beam.lines})
    for run, line in zip(group, itertools.cycle(LINES.values())):
        for beam in run.beams:
            _draw(axes, beam, line, _colours(times))
    handles = list({handle.get_label(): handle for handle in reversed(axes.get_lines())}.items())
    handles = [handle for _, handle in sorted(handles, key=lambda one: float(one[0]))]
    axes.legend(handles=handles, title=units.label("t", "time"), loc="center left", bbox_to_anchor=(1.0, 0.5), handlelength=1.2)
    axes.set_title(title, loc="left")
    same_grid, same_laws = len({run.factor for run in group}) == 1, len({run.laws for run in group}) == 1
    told = [", ".join([*([] if same_laws else [run.laws]), *([] if same_grid and not same_laws else [f"j = {run.factor:g}"])]) for run in group]
    lines = [f"{one} {name}" for one, name in zip(told, itertools.cycle(LINES))]
    axes.set_xlabel(units.label("x", "length") + (f"      ({', '.join(lines)})" if len(group) > 1 else ""))


def _scale(panels):
    """The same scale both ways, unless beams bend so little that nothing could be seen."""
    lines = [line for axes in panels for line in axes.get_lines()]
    places = {name: np.concatenate([getattr(line, f"get_{name}data")() for line in lines]) for name in "xy"}
    x, y = (np.ptp(places[name]) for name in "xy")
    for name, size in (("x", x), ("y", y)):
        if size <= scales.NEGLIGIBLE * max(x, y):   # straight: round-off is not worth a scale
            middle, half = np.mean(places[name]), 0.5 * NARROW * max(x, y)
            for axes in panels:
                getattr(axes, f"set_{name}lim")(middle - half, middle + half)
    if min(x, y) > NARROW * max(x, y):
        for axes in panels:
            axes.set_aspect("equal")


def picture(runs):
    """Centrelines of all runs, one panel for runs that differ in their grid or their laws only; None where there are no beams."""
    groups = _groups([run for run in runs if run.beams])
    if not groups:
        return None
    columns = min(2, len(groups))
    rows = -(-len(groups) // columns)
    figure, panels = pyplot.subplots(rows, columns, figsize=(4.6 * columns, 3.9 * rows), squeeze=False,
                                    sharex=True, sharey=True)
    for axes, group in zip(panels.flat, groups):
        _panel(axes, group, _label(group[0], [run for other in groups for run in other]) or "centreline")
    _scale(panels.flat[:len(groups)])
    for axes in list(panels.flat)[len(groups):]:
        axes.set_visible(False)
    for axes in panels[:, 0]:
        axes.set_ylabel(units.label("y", "length"))
    return figure


def pictures(series):
    """(name, figure) of the centrelines of one run."""
    beams = of(series)
    if beams:
        yield "centrelines", picture([Run({}, 0.0, beams)])
