"""Numerical schlieren of the gas with the speed of the solids (the paper's figure 16): grey is exp(-STRENGTH |grad rho| / scale)."""

from dataclasses import dataclass, replace
from functools import partial

import numpy as np
from matplotlib import pyplot
from matplotlib.collections import LineCollection

from fsi_launch.plot.look import shading, style, units
from fsi_launch.plot.one_run import fields
from fsi_launch.plot.reading import data, mesh

STRENGTH = 12.0
TYPICAL = 99.9     # percentile of |grad rho| that is drawn as exp(-STRENGTH)
STEEP = 0.02       # density jumps by this part of itself between neighbours: a shock to be shown,
STANDS_OUT = 2.5   # if by so many times what it does at four fifths of the points: it is not just a coarse grid
USUAL = 80         # percentile
MOST_TIMES = 6
PANEL = 4.1        # width [inch]
LOWEST = 1.0       # height [inch]
PANELS_IN_A_ROW = 3
SPEED_MAP = "plasma"
LEVEL_LINES = {"colors": "tab:blue", "linewidths": 0.35}


def _slope(values, axis):
    """Differences along an axis, central where both neighbours are known, one-sided beside unknown ones (NaN)."""
    values = np.moveaxis(values, axis, 0)
    ahead = np.full(values.shape, np.nan)
    ahead[:-1] = np.diff(values, axis=0)
    behind = np.full(values.shape, np.nan)
    behind[1:] = ahead[:-1]
    central = 0.5 * (ahead + behind)
    result = np.where(np.isnan(central), np.where(np.isnan(ahead), behind, ahead), central)
    return np.moveaxis(result, 0, axis)


def gradient(grid, key):
    """|grad f| on one component grid, zero where it is not known."""
    f = np.where(grid.used(), grid.fields[key], np.nan)
    x1, x2 = (np.where(grid.used(), x, np.nan) for x in (grid.x1, grid.x2))
    (f_r, x_r, y_r), (f_s, x_s, y_s) = ([_slope(one, axis) for one in (f, x1, x2)] for axis in (1, 0))
    if grid.closed:  # the first column is there once more at the end: both have neighbours on both sides
        for slopes, values in ((f_r, f), (x_r, x1), (y_r, x2)):
            slopes[:, 0] = slopes[:, -1] = 0.5 * (values[:, 1] - values[:, -2])
    area = x_r * y_s - x_s * y_r
    size = np.hypot(f_r * y_s - f_s * y_r, f_s * x_r - f_r * x_s) / np.abs(area)
    return np.nan_to_num(size, nan=0.0, posinf=0.0)


def has_shocks(gas):
    """True where the density of an output changes steeply between some neighbours, and not so between most."""
    for grid in gas.grids:
        rho = np.where(grid.used(), grid.fields["rho"], np.nan)
        for axis in (0, 1):
            jump = np.abs(np.diff(rho, axis=axis))
            jump = jump[np.isfinite(jump)]
            if jump.size and jump.max() > max(STEEP * np.nanmean(rho), STANDS_OUT * np.percentile(jump, USUAL)):
                return True
    return False


@dataclass
class Scales:
    """What all pictures of a run share."""

    gradient: float     # of the density, drawn nearly black
    speed: float        # of the solids; 0 without solids and where they rest


def scales(gas_outputs, solid_outputs):
    sizes = [gradient(grid, "rho")[grid.used()] for gas in gas_outputs for grid in gas.grids]
    speeds = [grid.speed()[grid.used()].max() for outputs in solid_outputs for one in outputs for grid in one.grids]
    return Scales(np.percentile(np.concatenate(sizes), TYPICAL), max(speeds, default=0.0))


def _colour(axes, solids, speed):
    """Speed of the solids; returns what a colour bar needs. Solids that rest at all times (`speed` is 0) are plain and need none."""
    drawn = None
    for one in solids:
        if not speed:
            fields.fill(axes, one.grids)
        for grid in one.filled if speed else ():
            drawn = shading.shade(axes, grid, np.where(grid.used(), grid.speed(), 0), SPEED_MAP, (0, speed)) or drawn
        lines = [line for grid in one.grids for line in mesh.outer_lines(grid)]
        axes.add_collection(LineCollection(lines, colors="black", linewidths=0.6))
    return drawn


def box(gas, solids):
    """((x_a, x_b), (y_a, y_b)) of all gases, and of solids beside them."""
    shown = [grid for one in (gas, *solids) for grid in one.grids]
    return tuple((min(values.min() for values in x), max(values.max() for values in x))
                 for x in ([grid.x1[grid.used()] for grid in shown], [grid.x2[grid.used()] for grid in shown]))


def draw(axes, gas, solids, size):
    """One output on one pair of axes; returns what a colour bar of the solids' speed needs."""
    axes.set_facecolor(style.WALL_FILL)
    for grid in gas.grids:
        shading.shade(axes, grid, np.exp(-STRENGTH * np.minimum(gradient(grid, "rho") / size.gradient, 1)), "gray", (0, 1))
    for grid in gas.grids:
        if grid.level > 0:
            axes.add_collection(LineCollection(mesh.level_outline(grid), **LEVEL_LINES), autolim=False)
    drawn = _colour(axes, solids, size.speed)
    shown = box(gas, solids)
    axes.set_xlim(*shown[0])
    axes.set_ylim(*shown[1])
    axes.set_aspect("auto" if fields.is_thin(*map(np.ptp, shown)) else "equal")
    axes.set_title(units.moment(gas.t), loc="left")
    return drawn


def height_of_panel(width, shown):
    """Of a panel so wide [inch] that shows this box: low ones keep room for their numbers."""
    return max(width * np.ptp(shown[1]) / np.ptp(shown[0]), LOWEST)


def _chosen(gas):
    """Numbers of the outputs to show: some time has passed, and a few of them only."""
    after = [k for k, output in enumerate(gas.outputs) if output.t > 0]
    if len(after) <= MOST_TIMES:
        return after
    return sorted({after[round(k)] for k in np.linspace(0, len(after) - 1, MOST_TIMES)})


def pictures(series, natural):
    """(name, function that draws it) of a run whose gas has shocks; `natural`: the run's scales."""
    gas = data.gas_of(series)
    solids = [one for one in series if not one.is_gas()]
    count = min((len(one.outputs) for one in series), default=0)
    chosen = [k for k in _chosen(gas) if k < count] if gas else []
    if not chosen or not any(has_shocks(gas.outputs[k]) for k in chosen):
        return
    yield "schlieren", partial(_picture, gas, solids, chosen, natural)


def _picture(gas, solids, chosen, natural):
    """The gas at the outputs `chosen`; `natural`: the run's scales."""
    size = scales([gas.outputs[k] for k in chosen], [[one.outputs[k] for k in chosen] for one in solids])
    rests = size.speed <= natural.floor("length/time")
    size = replace(size, speed=0.0) if rests else size
    columns = 2 if len(chosen) == 4 else min(len(chosen), PANELS_IN_A_ROW)
    rows = -(-len(chosen) // columns)
    shown = box(gas.outputs[0], [one.outputs[0] for one in solids])
    height = height_of_panel(PANEL, shown)
    figure, axes = pyplot.subplots(rows, columns, figsize=(PANEL * columns + 0.8, (height + 0.45) * rows + 0.3), squeeze=False)
    for one in axes.flat[len(chosen):]:
        one.set_visible(False)
    style.name_axes(axes)
    for one, k in zip(axes.flat, chosen):
        drawn = draw(one, gas.outputs[k], [solid.outputs[k] for solid in solids], size)
    if drawn is not None:
        bar = figure.colorbar(drawn, ax=list(axes.flat), shrink=0.7, aspect=28, pad=0.01)
        bar.outline.set_visible(False)
        bar.ax.set_title(units.label("$|\\bar v|$", "length/time"), fontsize=9)
    figure.suptitle("numerical schlieren of the gas" + (", speed of the solid" if solids and not rests else ""), x=0.01, ha="left",
                    fontsize=10)
    return figure
