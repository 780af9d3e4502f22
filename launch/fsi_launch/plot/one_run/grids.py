"""Pictures of the component grids (the paper's figure 9), unused points left out; close-ups of interfaces."""

from functools import partial

import numpy as np
from matplotlib import pyplot
from matplotlib.collections import LineCollection
from matplotlib.lines import Line2D
from matplotlib.patches import Patch, Rectangle

from fsi_launch.plot.look import style, units
from fsi_launch.plot.one_run import fields
from fsi_launch.plot.reading import data, mesh
from fsi_launch.plot.reading.data import DISCRETISED, INTERPOLATED

MOST_LINES = 170     # of a background grid in the picture of the whole; of finer grids every n-th line is drawn
CLOSE_UP = 14        # half the width of a close-up, in grid spacings
DOT = {"marker": "o", "linestyle": "", "markersize": 3.2}
INTERFACE = 0.3      # points of gas and solid this close, in spacings, are on their interface


def _lines(grid, step):
    """Every `step`-th line of both directions and always the last one, broken at unused points."""
    lines = []
    for x1, x2, used in ((grid.x1, grid.x2, grid.used()), (grid.x1.T, grid.x2.T, grid.used().T)):
        for k in sorted({*range(0, len(x1), step), len(x1) - 1}):
            lines += [np.column_stack([x1[k][run], x2[k][run]]) for run in mesh.runs(used[k])]
    return lines


def _looks(series, index):
    """{(program, grid): (colour, label)} of all component grids: body-fitted ones differ from the background and from each other, bodies
    of one grid from other bodies, gases from other gases."""
    looks, turn = {}, {style.GAS_GRIDS: 0, style.SOLID_GRIDS: 0}
    before = {True: 0, False: 0}    # gases, bodies
    for one in series:
        grids = one.outputs[index].grids
        colours = style.GAS_GRIDS if one.is_gas() else style.SOLID_GRIDS
        background, fitted = colours
        if not one.has_an_inside():
            looks |= {(one.name, grid.name): (style.SOLID_EDGE, one.name) for grid in grids}
            continue
        first = before[one.is_gas()] == 0
        plain, other_gas = len(grids) == 1 and first, one.is_gas() and not first
        before[one.is_gas()] += 1
        for grid in grids:
            colour = background
            if other_gas or not (plain or grid.is_cartesian()):
                colour = fitted[turn[colours] % len(fitted)]
                turn[colours] += 1
            looks[one.name, grid.name] = colour, f"{'gas' if one.is_gas() else one.name}: {grid.name}"
    return looks


def _fill(axes, grids):
    """A body without a grid: its cells, or what lies within its outline where no run has given it any: both its lines are that, then."""
    fields.fill(axes, grids)
    for grid in grids:
        if np.array_equal(grid.x1[0], grid.x1[-1]) and np.array_equal(grid.x2[0], grid.x2[-1]):
            axes.fill(grid.x1[0], grid.x2[0], color=style.SOLID_FILL, linewidth=0)
    fields.outline(axes, grids)


def _draw(axes, series, index, step, width):
    """All component grids at output `index`, bodies that have none as they are; returns handles for the legend."""
    handles, looks = [], _looks(series, index)
    for one in series:
        if not one.has_an_inside():
            _fill(axes, one.outputs[index].grids)
            handles.append(Patch(facecolor=style.SOLID_FILL, edgecolor=style.SOLID_EDGE, label=one.name))
            continue
        for grid in one.outputs[index].grids:
            colour, label = looks[one.name, grid.name]
            axes.add_collection(LineCollection(_lines(grid, step), colors=colour, linewidths=width))
            handles.append(Line2D([], [], color=colour, label=label))
    return handles


def _mark_interpolated(axes, series, index):
    """Dots at interpolation points; returns handles for the legend."""
    shown, looks = False, _looks(series, index)
    for one in series:
        for grid in one.outputs[index].grids:
            at = grid.kind == INTERPOLATED
            shown = shown or at.any()
            axes.plot(grid.x1[at], grid.x2[at], color=looks[one.name, grid.name][0], **DOT)
    return [Line2D([], [], color="black", label="interpolated", **DOT)] if shown else []


def _legend(axes, handles):
    axes.legend(handles=handles, loc="upper left", bbox_to_anchor=(1.02, 1), handlelength=1.4, borderaxespad=0)


def _rim(grid):
    """The points on a grid's sides where its region ends: discretised ones."""
    sides = (np.s_[0, :], np.s_[-1, :]) + (() if grid.closed else (np.s_[:, 0], np.s_[:, -1]))
    return np.concatenate([np.column_stack([grid.x1[s], grid.x2[s]])[grid.kind[s] == DISCRETISED] for s in sides])


def _interface(gas, solid):
    """(points of the solid's rim that lie on the rim of the gas, True if they close on themselves)."""
    wall = np.concatenate([_rim(grid) for grid in gas])
    for grid in reversed(solid):
        rim = _rim(grid)
        near = [point for point in rim if np.hypot(*(wall - point).T).min() < INTERFACE * grid.spacing()]
        if len(near) > 2:
            return np.array(near), grid.closed
    return np.empty((0, 2)), False


def _places(series, index):
    """(name, points, closed) of what deserves a picture: interfaces, or body-fitted grids of a program alone."""
    gas = [grid for one in series if one.is_gas() for grid in one.outputs[index].grids]
    solids = [one for one in series if not one.is_gas()]
    if gas and solids:
        found = [(one.name, *_interface(gas, one.outputs[index].grids)) for one in solids]
    else:
        found = [(grid.name, _rim(grid), grid.closed) for one in series if len(one.outputs[index].grids) > 1
                 for grid in one.outputs[index].grids if not grid.is_cartesian()]
    return [place for place in found if len(place[1])]


def _spacing(series, index):
    return max(grid.spacing() for one in series for grid in one.outputs[index].grids if grid.level == 0)


def _window(centre, half, box):
    """(lower left, upper right) of a square, cut where everything ends."""
    return np.maximum(np.subtract(centre, half), box[0::2]), np.minimum(np.add(centre, half), box[1::2])


def _frame(axes, low, high):
    axes.set_aspect("equal")
    axes.set_xlim(low[0], high[0])
    axes.set_ylim(low[1], high[1])


def _place_picture(series, index, box, place):
    """Left the surroundings of the place, right a few cells: at the upper right of a body, the middle of a line."""
    name, points, closed = place
    h = _spacing(series, index)
    middle = 0.5 * (points.min(axis=0) + points.max(axis=0))
    whole = 0.5 * np.ptp(points, axis=0).max() + CLOSE_UP * h
    at = points[points.sum(axis=1).argmax()] if closed else points[len(points) // 2]
    close = _window(at, min(CLOSE_UP * h, 0.6 * whole), box)
    figure, (left, right) = pyplot.subplots(1, 2, figsize=(11.2, 4.9))
    handles = _draw(left, series, index, 1, 0.3)
    _frame(left, *_window(middle, whole, box))
    left.add_patch(Rectangle(close[0], *(close[1] - close[0]), fill=False, edgecolor="black", linewidth=0.9, zorder=3, clip_on=False))
    left.set_title(f"grids around {name}, {units.moment(series[0].outputs[index].t)}", loc="left")
    _draw(right, series, index, 1, 0.7)
    handles += _mark_interpolated(right, series, index)
    _frame(right, *close)
    right.set_title("the part framed on the left", loc="left")
    _legend(right, handles)
    style.name_axes(np.array([[left, right]]))
    return figure


def _whole_picture(series, index, box):
    grids = [grid for one in series for grid in one.outputs[index].grids]
    lines = max(max(grid.x1.shape) for grid in [g for g in grids if g.is_cartesian()] or grids)
    figure, (axes,) = fields.panels(1, box, 1.4 if len(grids) > 1 else 0)
    handles = _draw(axes, series, index, -(-lines // MOST_LINES), 0.35)
    axes.set_title(f"grids at {units.moment(series[0].outputs[index].t)}", loc="left")
    if len(grids) > 1:
        _legend(axes, handles)
    return figure


def pictures(series):
    """(name, function that draws it) of all grids at the last output, and of each interface."""
    if not series:
        return
    index = min(len(one.outputs) for one in series) - 1
    box = fields.box_around([grid for one in series for grid in one.outputs[index].grids])
    yield "grid", partial(_whole_picture, series, index, box)
    composite = any(len(one.outputs[index].grids) > 1 for one in series)
    if not composite and 4 * CLOSE_UP * _spacing(series, index) > max(box[1] - box[0], box[3] - box[2]):
        return  # the grids are so coarse that the whole shows all there is
    for place in _places(series, index):
        yield f"grid_{place[0]}", partial(_place_picture, series, index, box, place)


# --- of a case, before anything is started

CLOSE_UPS = 3       # beside the whole, at most
WIDEST = 11.0       # picture [inch]
WALLS = ("slip_wall", "symmetry")
SIDES = {"left": np.s_[:, 0], "right": np.s_[:, -1], "bottom": np.s_[0, :], "top": np.s_[-1, :]}
SIDE_LOOKS = {  # of the gas: (label, line)
    "wall": {"color": "black", "linewidth": 1.8},
    "open": {"color": "black", "linewidth": 1.1, "linestyle": (0, (5, 4))},
    "periodic": {"color": "#7a3fa0", "linewidth": 1.4, "linestyle": (0, (1, 1.5))},
    "surface of a body": {"color": style.SOLID_EDGE, "linewidth": 1.8},
}


def _side_kind(word):
    """What a side of the gas is to the eye; those without a word are open."""
    if word == "interface":
        return "surface of a body"
    if word == "periodic":
        return word
    return "wall" if word in WALLS else "open"


def _used_runs(grid, side):
    """The parts of a side of a grid between used points, as lines."""
    return [np.column_stack([grid.x1[side][run], grid.x2[side][run]]) for run in mesh.runs(grid.used()[side])]


def _kinds_of_sides(gas, case):
    """{side of the background: what it is} of one gas. `case`: the entries of the resolved case."""
    path = "fluid" if gas.name == "fluid" else f"fluids.{gas.name}"
    return {name: _side_kind(case.get(f"{path}.boundary.{name}.kind", case.get(f"{path}.boundary.{name}", ""))) for name in SIDES}


def _side_below(line, background, kinds):
    """What the side of the background is on which the end of a fitted grid lies."""
    def distance(name):
        rim = np.column_stack([background.x1[SIDES[name]], background.x2[SIDES[name]]])
        return max(np.hypot(*(rim - point).T).min() for point in line)
    return kinds[min(SIDES, key=distance)]


def _fitted_sides(grid, background, kinds, bodies):
    """[(kind, line)] of a fitted grid: its curve, a wall unless a body has it, and its ends on sides of the background."""
    curve = max((SIDES["bottom"], SIDES["top"]), key=lambda side: (grid.kind[side] == DISCRETISED).sum())
    sides = []
    for line in _used_runs(grid, curve):
        middle = line[len(line) // 2]
        of_body = any(np.hypot(*(body - middle).T).min() < INTERFACE * grid.spacing() for body in bodies)
        sides.append(("surface of a body" if of_body else "wall", line))
    if not grid.closed:
        sides += [(_side_below(line, background, kinds), line)
                  for name in ("left", "right") for line in _used_runs(grid, SIDES[name])]
    return sides


def _gas_sides(series, case):
    """[(kind, line)] of the rims of the gases. `case`: the entries of the resolved case."""
    sides, bodies = [], [line for _, line in _bodies(series)]
    for gas in (one for one in series if one.is_gas()):
        background = gas.outputs[0].background()
        fitted = [grid for grid in gas.outputs[0].grids if grid is not background]
        kinds = _kinds_of_sides(gas, case)
        sides += [(kinds[name], line) for name, side in SIDES.items() for line in _used_runs(background, side)]
        for grid in fitted:
            sides += _fitted_sides(grid, background, kinds, bodies)
    return _without_twice(sides)


def _joined(lines, along):
    """Of lines on one straight line those that overlap as one, each in the order of the coordinate `along`."""
    joined = []
    for line in sorted((line[np.argsort(line[:, along])] for line in lines), key=lambda line: line[0, along]):
        if joined and line[0, along] <= joined[-1][-1, along]:
            joined[-1] = np.vstack([joined[-1], line[line[:, along] > joined[-1][-1, along]]])
        else:
            joined.append(line)
    return joined


def _without_twice(sides):
    """The same lines, but where two of one kind lie on each other on an upright or level line it is one: their dashes would fill each
    other's gaps."""
    result, straight = [], {}
    for kind, line in sides:
        across = int(np.argmin(np.ptp(line, axis=0)))
        if np.ptp(line[:, across]) > 1e-9 * np.ptp(line):
            result.append((kind, line))
        else:
            straight.setdefault((kind, across, round(line[0, across], 9)), []).append(line)
    return result + [(kind, line) for (kind, across, _), lines in straight.items() for line in _joined(lines, 1 - across)]


def _bodies(series):
    """Lines around the solids."""
    return [("surface of a body", line) for one in series if not one.is_gas()
            for grid in one.outputs[0].grids for line in mesh.outer_lines(grid)]


def _draw_sides(axes, sides):
    """Returns handles for the legend."""
    for kind, line in sides:
        axes.plot(*line.T, zorder=4, **SIDE_LOOKS[kind])
    shown = {kind for kind, _ in sides}
    return [Line2D([], [], label=kind, **look) for kind, look in SIDE_LOOKS.items() if kind in shown]


def _frames(series, box):
    """[(title, window)] of the close-ups: around each body and fitted grid."""
    h = _spacing(series, 0)
    frames = []
    for name, points, _ in _places(series, 0)[:CLOSE_UPS]:
        low, high = points.min(axis=0), points.max(axis=0)
        half = np.full(2, 0.5 * np.ptp(points, axis=0).max() + CLOSE_UP * h)
        middle = 0.5 * (low + high)
        window = (max(middle[0] - half[0], box[0]), min(middle[0] + half[0], box[1]),
                  max(middle[1] - half[1], box[2]), min(middle[1] + half[1], box[3]))
        if (window[1] - window[0]) * (window[3] - window[2]) < 0.5 * (box[1] - box[0]) * (box[3] - box[2]):
            frames.append((f"around {name}", window))
    return frames


def _layout(box, frames):
    """(figure, axes of the whole, axes of the close-ups below it)."""
    whole = min(7.0, max(2.0, (WIDEST - 3) * (box[3] - box[2]) / (box[1] - box[0])))
    heights = [whole] + ([4.6] if frames else [])
    figure = pyplot.figure(figsize=(WIDEST, sum(heights) + 0.8))
    rows = figure.add_gridspec(len(heights), 1, height_ratios=heights)
    top = figure.add_subplot(rows[0])
    below = rows[1].subgridspec(1, len(frames)) if frames else []
    return figure, top, [figure.add_subplot(below[k]) for k in range(len(frames))]


def case_picture(series, case, title):
    """All grids of a case at t = 0: unused points left out, the rim of the gas by what it is, a close-up of each body. `series`: from
    fsi_grids; `case`: the entries of the resolved case."""
    box = fields.box_around([grid for one in series for grid in one.outputs[0].grids])
    frames = _frames(series, box)
    figure, top, below = _layout(box, frames)
    sides = _gas_sides(series, case) + _bodies(series)
    lines = max(max(grid.x1.shape) for one in series for grid in one.outputs[0].grids)
    step = -(-lines // MOST_LINES)
    handles = _draw(top, series, 0, step, 0.35)
    handles += _draw_sides(top, sides)
    _legend(top, handles)
    for axes, (name, window) in zip([top, *below], [(title, box), *frames]):
        axes.set_aspect("equal")
        axes.set_xlim(window[0], window[1])
        axes.set_ylim(window[2], window[3])
        axes.set_title(name if axes is not top or step == 1 else f"{name} (one line in {step})", loc="left")
        axes.set_xlabel(units.label("x", "length"), labelpad=1)
        axes.set_ylabel(units.label("y", "length"), labelpad=3)
    for axes in below:
        _draw(axes, series, 0, 1, 0.45)
        _draw_sides(axes, sides)
    return figure
