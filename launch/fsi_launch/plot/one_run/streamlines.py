"""Streamlines of the gas and the speed of the solids at output times (the paper's figure 21)."""

import contextlib
from functools import partial

import numpy as np
from matplotlib import pyplot, streamplot
from matplotlib.cm import ScalarMappable
from matplotlib.colors import Normalize
from matplotlib.path import Path
from matplotlib.tri import LinearTriInterpolator, Triangulation

from fsi_launch.plot.look import shading, style, units
from fsi_launch.plot.one_run import fields
from fsi_launch.plot.reading import data, mesh

MOST_TIMES = 8
PANEL = 4.4         # width [inch]
POINTS = 420        # of the longer side of the lattice on which streamlines are traced
STILL = 0.01        # of the largest speed: gas that hardly flows, where errors of the scheme would decide on the direction
DENSITY = 1.3
SHORTEST = 0.02     # streamline, part of the width of a panel


def _lattice(gas):
    """Even places over the used points of the gas, the outermost on its rim: what lies beyond has no velocity."""
    x, y = (np.concatenate([getattr(grid, name)[grid.used()] for grid in gas.grids]) for name in ("x1", "x2"))
    step = max(np.ptp(x), np.ptp(y)) / POINTS
    return [np.linspace(values.min(), values.max(), max(2, round(np.ptp(values) / step) + 1)) for values in (x, y)]


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


def _searched(cells, columns):
    """[(triangles, what finds the one of a point)]: one, or, of a grid that reaches over itself, as around a gap, those of parts of its columns
    that do not; matplotlib has none for triangles that cover each other."""
    try:
        return [(cells, cells.get_trifinder())]
    except RuntimeError:
        of_column = cells.triangles[:, 0] % columns
        low, high = of_column.min(), of_column.max()
        if low == high:
            return []
        halves = (of_column <= (low + high) // 2, of_column > (low + high) // 2)
        return [one for half in halves for one in _searched(Triangulation(cells.x, cells.y, cells.triangles[half]), columns)]


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
    here = [x[near] for x in points]
    for part, finder in _searched(cells, grid.x1.shape[1]):
        for key, values in zip(keys, found):
            known = np.where(grid.used(), grid.fields[key], 0).ravel()
            there = LinearTriInterpolator(part, known, trifinder=finder)(*here).filled(np.nan)
            values[near] = np.where(np.isnan(there), values[near], there)
    return found


def _velocity(gas, points):
    """(v1, v2) on the lattice; body-fitted grids, which come last, win; NaN where there is no gas."""
    v = [np.full(points[0].shape, np.nan) for _ in range(2)]
    for grid in gas.grids:
        for total, found in zip(v, _sample(grid, ("v1", "v2"), points)):
            total[:] = np.where(np.isnan(found), total, found)
    return v


@contextlib.contextmanager
def quick_tracing():
    """While it lasts, matplotlib traces streamlines through plain numbers: its masked arrays take ten times as long, for the same lines."""
    theirs, kept = streamplot.interpgrid, {}

    def interpolated(a, x, y):
        if isinstance(x, np.ndarray):
            return theirs(a, x, y)
        _, rows = kept.setdefault(id(a), (a, None))
        if rows is None:
            rows = np.ma.filled(a, np.nan).tolist()
            kept[id(a)] = a, rows
        i, j = int(x), int(y)
        low, high = rows[j], rows[min(j + 1, len(rows) - 1)]
        right, s, t = min(i + 1, len(low) - 1), x - i, y - j
        value = (low[i] * (1 - s) + low[right] * s) * (1 - t) + (high[i] * (1 - s) + high[right] * s) * t
        if value != value:      # a corner is masked
            raise streamplot.TerminateTrajectory
        return value

    streamplot.interpgrid = interpolated
    try:
        yield
    finally:
        streamplot.interpgrid = theirs


def _inside(solids, points):
    """Which points of the lattice a solid covers."""
    flat = np.column_stack([x.ravel() for x in points])
    covered = np.zeros(len(flat), dtype=bool)
    for solid in solids:
        for grid in solid.grids:
            for line in mesh.outer_lines(grid):
                if not grid.is_cartesian():
                    near = ((flat >= line.min(axis=0)) & (flat <= line.max(axis=0))).all(axis=1)
                    covered[near] |= Path(line).contains_points(flat[near])
    return covered.reshape(points[0].shape)


def _largest(outputs):
    """Largest speed of all these outputs."""
    return max(grid.speed()[grid.used()].max() for output in outputs for grid in output.grids)


def _solid_speed(axes, solids, most, colours):
    """What the colour bar needs; a solid that rests at all times (`most` is 0) is plain and needs none."""
    drawn = None
    for solid in solids:
        if not most:
            fields.fill(axes, solid.grids)
        for grid in solid.filled if most else ():
            drawn = shading.shade(axes, grid, np.where(grid.used(), grid.speed(), 0), colours, (0, most)) or drawn
        fields.outline(axes, solid.grids)
    return drawn


def _panel(axes, moment, most):
    """One time; `moment`: (gas, solids), `most`: their largest speeds at all times, which set the colours. Returns what the colour bar of
    the solids needs."""
    gas, solids = moment
    x, y = _lattice(gas)
    points = np.meshgrid(x, y)
    v1, v2 = _velocity(gas, points)
    covered = _inside(solids, points)
    speed = np.where(covered, 0, np.nan_to_num(np.hypot(v1, v2)))
    if speed.max() > STILL * most[0]:
        moving = np.isfinite(v1) & ~covered & (speed > STILL * most[0])
        hidden = [np.ma.array(np.nan_to_num(v), mask=~moving) for v in (v1, v2)]
        with quick_tracing(), np.errstate(over="ignore"):  # where the flow is uniform the estimated error is none: a step without bound
            axes.streamplot(x, y, *hidden, color=speed, cmap=style.GAS_MAP, norm=Normalize(0, most[0]), density=DENSITY, linewidth=0.6,
                            arrowsize=0.6, minlength=SHORTEST)
    axes.set_title(units.moment(gas.t), loc="left")
    return _solid_speed(axes, solids, most[1], style.GAS_MAP if most[0] == most[1] else style.SOLID_MAP)


def _bars(figure, panels, most, of_solids):
    """One bar for the gas and one for the solids, right of all panels; one for both where they have the same scale. `of_solids`: what
    their bar needs, None where they rest."""
    of_both = of_solids and most[0] == most[1]
    if of_solids and not of_both:
        style.bar(figure, panels, of_solids, "solid", beside=style.above_bar("gas", 0, most[0]))
    style.bar(figure, panels, ScalarMappable(Normalize(0, most[0]), style.GAS_MAP), "" if of_both else "gas")


def _panels(count, box):
    """Panels in two columns, one if there is one only."""
    columns = min(2, count)
    rows = -(-count // columns)
    height = PANEL * (box[3] - box[2]) / (box[1] - box[0])
    figure, axes = pyplot.subplots(rows, columns, figsize=((PANEL + 0.4) * columns + 1.6, (height + 0.4) * rows + 0.3),
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
    floor = size.floor(fields.SPEED.unit)
    if not moments or _largest([gas.outputs[k] for k in moments]) <= floor:
        return
    yield "streamlines", partial(_picture, series, gas, solids, moments, floor)


def _picture(series, gas, solids, moments, floor):
    """Streamlines at the outputs `moments`; speeds up to `floor` are round-off."""
    most = [_largest([one.outputs[k] for one in some for k in moments]) for some in ([gas], solids)]
    most[1] = most[1] if most[1] > floor else 0
    if most[1] > 0 and fields.comparable(*most):     # as in the pictures of the fields
        most = [max(most)] * 2
    box = fields.box_around([grid for one in series for output in one.outputs for grid in output.grids])
    figure, axes = _panels(len(moments), box)
    drawn = [_panel(one, (gas.outputs[index], [solid.outputs[index] for solid in solids]), most) for one, index in zip(axes, moments)]
    _bars(figure, axes, most, drawn[-1])
    figure.suptitle(f"streamlines of the gas; colours: {units.label('speed', fields.SPEED.unit)}", x=0.01, ha="left", fontsize=10)
    return figure
