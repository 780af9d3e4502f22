"""Streamlines of the gas and the speed of the solids at output times (the paper's figure 21)."""

from functools import partial

import numpy as np
from matplotlib import pyplot
from matplotlib.path import Path
from matplotlib.tri import LinearTriInterpolator

from fsi_launch.plot.look import shading, style, units
from fsi_launch.plot.one_run import fields
from fsi_launch.plot.reading import data, mesh

MOST_TIMES = 8
PANEL = 4.4         # width [inch]
POINTS = 420        # of the longer side of the lattice on which streamlines are traced
STILL = 0.01        # of the largest speed: gas that hardly flows, where errors of the scheme would decide on the direction
DENSITY = 1.3
SHORTEST = 0.02     # streamline, part of the width of a panel


def _lattice(box):
    step = max(box[1] - box[0], box[3] - box[2]) / POINTS
    x = np.arange(box[0], box[1] + 0.5 * step, step)
    y = np.arange(box[2], box[3] + 0.5 * step, step)
    return x, y


def _sample_lattice(grid, values, points):
    """Bilinear interpolation on a Cartesian grid, NaN outside and in cells with unused points."""
    x, y = grid.x1[0], grid.x2[:, 0]
    r = (points[0] - x[0]) / (x[-1] - x[0]) * (len(x) - 1)
    s = (points[1] - y[0]) / (y[-1] - y[0]) * (len(y) - 1)
    i, j = np.clip(r.astype(int), 0, len(x) - 2), np.clip(s.astype(int), 0, len(y) - 2)
    r, s = r - i, s - j
    low = (1 - r) * values[j, i] + r * values[j, i + 1]
    high = (1 - r) * values[j + 1, i] + r * values[j + 1, i + 1]
    inside = (r >= 0) & (r <= 1) & (s >= 0) & (s <= 1)
    return np.where(inside, (1 - s) * low + s * high, np.nan)


def _sample(grid, keys, points):
    """Fields of one grid on the lattice, NaN outside."""
    if grid.is_cartesian():
        return [_sample_lattice(grid, np.where(grid.used(), grid.fields[key], np.nan), points) for key in keys]
    cells, found = mesh.triangles(grid), [np.full(points[0].shape, np.nan) for _ in keys]
    if not cells:
        return found
    near = np.ones(points[0].shape, dtype=bool)     # to find the triangle of a point takes long: only of those in the grid's box
    for x, of_grid in zip(points, (grid.x1, grid.x2)):
        near &= (x >= of_grid.min()) & (x <= of_grid.max())
    here, finder = [x[near] for x in points], cells.get_trifinder()
    for key, values in zip(keys, found):
        known = np.where(grid.used(), grid.fields[key], 0).ravel()
        values[near] = LinearTriInterpolator(cells, known, trifinder=finder)(*here).filled(np.nan)
    return found


def _velocity(gas, points):
    """(v1, v2) on the lattice; body-fitted grids, which come last, win; NaN where there is no gas."""
    v = [np.full(points[0].shape, np.nan) for _ in range(2)]
    for grid in gas.grids:
        for total, found in zip(v, _sample(grid, ("v1", "v2"), points)):
            total[:] = np.where(np.isnan(found), total, found)
    return v


def _inside(solids, points):
    """Which points of the lattice a solid covers."""
    flat = np.column_stack([x.ravel() for x in points])
    covered = np.zeros(len(flat), dtype=bool)
    for solid in solids:
        for grid in solid.grids:
            for line in mesh.outer_lines(grid):
                if not grid.is_cartesian():
                    covered |= Path(line).contains_points(flat)
    return covered.reshape(points[0].shape)


def _solid_speed(axes, solids, floor):
    """(mesh for the colour bar, True if the solids rest); speeds up to `floor` are round-off."""
    most = max(grid.speed()[grid.used()].max() for solid in solids for grid in solid.grids)
    rests, drawn = most <= floor, None
    for solid in solids:
        for grid in solid.grids:
            values = np.where(grid.used() & (not rests), grid.speed(), 0)
            drawn = shading.shade(axes, grid, values, style.SOLID_MAP, (0, 1 if rests else most)) or drawn
        fields.outline(axes, solid.grids)
    return drawn, rests


def _panel(figure, axes, moment, box, floor):
    """One time; `moment`: (gas, solids)."""
    gas, solids = moment
    x, y = _lattice(box)
    points = np.meshgrid(x, y)
    v1, v2 = _velocity(gas, points)
    covered = _inside(solids, points)
    speed = np.where(covered, 0, np.nan_to_num(np.hypot(v1, v2)))
    if speed.max() > floor:
        moving = np.isfinite(v1) & ~covered & (speed > STILL * speed.max())
        hidden = [np.ma.array(np.nan_to_num(v), mask=~moving) for v in (v1, v2)]
        with np.errstate(over="ignore"):  # where the flow is uniform the estimated error is none: a step without bound
            stream = axes.streamplot(x, y, *hidden, color=speed, cmap=style.GAS_MAP, density=DENSITY, linewidth=0.6,
                                     arrowsize=0.6, minlength=SHORTEST)
        style.bar(figure, axes, stream.lines, "gas")
    drawn, rests = _solid_speed(axes, solids, floor)
    style.bar(figure, axes, drawn, "solid", 0.0 if rests else None)
    axes.set_title(units.moment(gas.t), loc="left")


def _panels(count, box):
    """Panels in two columns, one if there is one only."""
    columns = min(2, count)
    rows = -(-count // columns)
    height = PANEL * (box[3] - box[2]) / (box[1] - box[0])
    figure, axes = pyplot.subplots(rows, columns, figsize=((PANEL + 1.4) * columns, (height + 0.4) * rows + 0.3),
                                   squeeze=False)
    for one in axes.flat:
        one.set_aspect("equal")
        one.set_xlim(box[0], box[1])
        one.set_ylim(box[2], box[3])
    for one in list(axes.flat)[count:]:
        one.set_visible(False)
    style.name_axes(axes)
    return figure, list(axes.flat)


def pictures(series, size):
    """(name, function that draws it) of streamlines at up to MOST_TIMES output times after the start; `size`: the run's scales."""
    gas = data.gas_of(series)
    solids = [one for one in series if not one.is_gas()]
    if not gas or not solids or len(gas.outputs[0].grids) <= sum(one.is_gas() for one in series):
        return
    count = min(len(one.outputs) for one in series)
    moments = [k for k in range(count) if gas.outputs[k].t > 0]
    if len(moments) > MOST_TIMES:
        moments = sorted({moments[round(k)] for k in np.linspace(0, len(moments) - 1, MOST_TIMES)})
    if not moments:
        return
    yield "streamlines", partial(_picture, series, gas, solids, moments, size)


def _picture(series, gas, solids, moments, size):
    """Streamlines at the outputs `moments`."""
    box = fields.box_around([grid for one in series for output in one.outputs for grid in output.grids])
    figure, axes = _panels(len(moments), box)
    for one, index in zip(axes, moments):
        _panel(figure, one, (gas.outputs[index], [solid.outputs[index] for solid in solids]), box, size.floor(fields.SPEED.unit))
    figure.suptitle("streamlines of the gas, speed of the solid", x=0.01, ha="left", fontsize=10)
    return figure
