"""Numerical schlieren of several runs side by side, of two with their difference (the paper's figures 16, 18 and 19)."""

import textwrap

import numpy as np
from matplotlib import pyplot
from matplotlib.colors import LogNorm

from fsi_launch.plot.look import style, units
from fsi_launch.plot.one_run import fields, schlieren
from fsi_launch.plot.reading import data
from fsi_launch.plot.several_runs import outlines, several

PANEL = 4.6        # width [inch]
LEAST = 1e-4       # differences are drawn from this part of the largest density up
MOST_RUNS = 4
MOST_LETTERS = 56   # of a line above a panel
DIFFERENCE_MAP = "magma_r"


def _at(series, t):
    return several.at({output.t: output for output in series.outputs}, t)


def _parts(series):
    """(gas, solids) of a run."""
    return data.gas_of(series), [one for one in series if not one.is_gas()]


def on_common_points(one, other):
    """(x1, x2, [densities]) of two backgrounds at the points of the coarser one, NaN where one has no value; None unless those
    are points of the finer one too."""
    coarse, fine = (one, other) if one.x1.size <= other.x1.size else (other, one)
    steps = [divmod(b - 1, a - 1) for a, b in zip(coarse.x1.shape, fine.x1.shape)]
    if any(rest for _, rest in steps):
        return None
    there = np.s_[::steps[0][0], ::steps[1][0]]
    if not (np.allclose(coarse.x1, fine.x1[there]) and np.allclose(coarse.x2, fine.x2[there])):
        return None
    both = coarse.used() & fine.used()[there]
    return coarse.x1, coarse.x2, [np.where(both, rho, np.nan) for rho in (coarse.fields["rho"], fine.fields["rho"][there])]


def _difference(figure, axes, gases, bodies):
    """|difference of the densities| on the background and the outlines of the solids: full those of the first run."""
    found = on_common_points(*(gas.background() for gas in gases))
    if found is None:
        axes.set_visible(False)
        return
    x1, x2, (a, b) = found
    apart = np.abs(a - b) / np.nanmax(b)
    h1, h2 = x1[0, 1] - x1[0, 0], x2[1, 0] - x2[0, 0]
    drawn = axes.imshow(np.ma.masked_invalid(np.maximum(apart, LEAST)), origin="lower", cmap=DIFFERENCE_MAP,
                        norm=LogNorm(LEAST, 1), interpolation="nearest",
                        extent=(x1.min() - h1 / 2, x1.max() + h1 / 2, x2.min() - h2 / 2, x2.max() + h2 / 2))
    for solids, line in zip(bodies, ("-", "--")):
        for curve in (outlines.outline(one.grids) for one in solids):
            if curve is not None:
                axes.plot(*curve.T, line, color="black", linewidth=0.8)
    axes.set_xlim(x1.min(), x1.max())
    axes.set_ylim(x2.min(), x2.max())
    axes.set_aspect("auto" if fields.is_thin(np.ptp(x1), np.ptp(x2)) else "equal")
    axes.set_title(f"difference of the densities, mean {np.nanmean(apart):.1e}", loc="left")
    bar = figure.colorbar(drawn, ax=axes, shrink=0.7, aspect=24, pad=0.01)
    bar.outline.set_visible(False)
    bar.set_label("part of the largest density")


def _row(figure, axes, moment, size):
    """One time: the runs, then, of two, their difference. `moment`: (gas, solids) of each run."""
    for panel, (gas, solids) in zip(axes, moment):
        drawn = schlieren.draw(panel, gas, solids, size)
    if drawn is not None:
        bar = figure.colorbar(drawn, ax=axes[len(moment) - 1], shrink=0.7, aspect=24, pad=0.01)
        bar.outline.set_visible(False)
        bar.ax.set_title(units.label("$|\\bar v|$", "length/time"), fontsize=9)
    if len(axes) > len(moment):
        gases, bodies = zip(*moment)
        _difference(figure, axes[-1], gases, bodies)


def pictures(series, told):
    """(name, figure) of runs whose gas has shocks. `series`: those of each run; `told`: what to call the runs."""
    runs = [_parts(one) for one in series]
    if not 2 <= len(runs) <= MOST_RUNS or any(gas is None for gas, _ in runs):
        return
    times = several.few(several.common_times([{output.t: output for output in gas.outputs} for gas, _ in runs]))
    moments = [[(_at(gas, t), [_at(solid, t) for solid in solids]) for gas, solids in runs] for t in times]
    moments = [moment for moment in moments if all(None not in solids for _, solids in moment)]
    if not any(schlieren.has_shocks(gas) for moment in moments for gas, _ in moment):
        return
    finest = max(range(len(runs)), key=lambda k: runs[k][0].outputs[0].background().x1.size)
    size = schlieren.scales([moment[finest][0] for moment in moments], [moment[finest][1] for moment in moments])
    columns = len(runs) + (1 if len(runs) == 2 else 0)
    height = schlieren.height_of_panel(PANEL, schlieren.box(*moments[0][0]))
    figure, axes = pyplot.subplots(len(moments), columns, figsize=(PANEL * columns + 1, (height + 0.3) * len(moments)),
                                   squeeze=False)
    for row, moment in zip(axes, moments):
        _row(figure, row, moment, size)
    style.name_axes(axes)
    for panel, label in zip(axes[0], told):
        panel.set_title(f"{textwrap.fill(label, MOST_LETTERS)}\n{panel.get_title(loc='left')}", loc="left")
    yield "schlieren_compared", figure
