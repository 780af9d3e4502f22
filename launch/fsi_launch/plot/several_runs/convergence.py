"""Errors over the grid spacing, as `fsi converge` left them, beside the slope of second order."""

import itertools

import numpy as np
from matplotlib import pyplot
from matplotlib.ticker import FuncFormatter, NullFormatter

ROUND_OFF = 1e-13                         # an error that stays below it has no rate
NAMES = {"rho": "$\\rho$", "v1": "$v_1$", "v2": "$v_2$", "T": "$T$", "u_bar": "$\\bar u$", "v_bar": "$\\bar v$",
         "P_bar": "$\\bar P$", "rho_mean": "$\\rho$, mean"}
MARKERS = "os^vD<>ph*"
BELOW = 0.1     # room under the triangle, part of the powers of ten of the axis: for its number


def _triangle(axes, h, lowest):
    """A right triangle of slope 2 below all curves."""
    low, high = h.min() * (h.max() / h.min()) ** 0.35, h.min() * (h.max() / h.min()) ** 0.75
    bottom = 0.5 * lowest(low)
    top = bottom * (high / low) ** 2
    axes.plot([low, high, high, low], [bottom, bottom, top, bottom], color="black", linewidth=0.9)
    axes.text(high * 1.02, np.sqrt(bottom * top), " 2", va="center")
    axes.annotate("1", (np.sqrt(low * high), bottom), xytext=(0, -3), textcoords="offset points", va="top", ha="center")
    axes.set_ylim(bottom=bottom * (axes.get_ylim()[0] / axes.get_ylim()[1]) ** BELOW)


def _spacing(value):
    return f"1/{1 / value:.0f}" if value < 1 else f"{value:g}"


def _differences(table):
    """The figure of the differences from each level to the next finer one, at the last time, or None."""
    h = np.array([0.1 / level for level in table["levels"][:-1]])
    last = max((row["t"] for row in table["differences"]), default=0)
    figure, axes = pyplot.subplots(figsize=(5.8, 4.6))
    columns = []
    for row, marker in zip((row for row in table["differences"] if row["t"] == last), itertools.cycle(MARKERS)):
        column = np.array([np.nan if value is None else value for value in row["differences"]], dtype=float)
        if np.nanmax(column, initial=0) <= ROUND_OFF:
            continue
        order = row["orders"][-1] if row["orders"] else None
        label = f"{row['quantity']} of {row['solid']}" + ("" if order is None else f": order {order:.2f}")
        axes.loglog(h, column, marker=marker, markersize=4.5, label=label)
        columns.append(column)
    if not columns:
        pyplot.close(figure)
        return None
    _finish(axes, h, columns)
    axes.set_title(f"differences to the next finer grid, t = {last:g}", loc="left")
    return figure


def _finish(axes, h, columns):
    """Slope, ticks and legend of errors over the spacing."""
    least = np.min([np.where(np.isfinite(column), column, np.inf) for column in columns], axis=0)
    order = np.array([k for k in np.argsort(h) if np.isfinite(least[k])], dtype=int)     # on a level there may be no error at all
    if len(order) > 1:
        _triangle(axes, h[order], lambda x: np.exp(np.interp(np.log(x), np.log(h[order]), np.log(least[order]))))
    axes.set_xticks(h)
    axes.xaxis.set_major_formatter(FuncFormatter(lambda value, _: _spacing(value)))
    axes.xaxis.set_minor_formatter(NullFormatter())
    axes.minorticks_off()
    axes.grid(axis="y", color="#e4e4e4", linewidth=0.6)
    axes.set_axisbelow(True)
    axes.set_xlabel("grid spacing h")
    axes.legend(loc="upper left", bbox_to_anchor=(1.0, 1.0))


def pictures(table):
    """(name, figure) of the table; curves of errors that are nothing but round-off are left out."""
    if not table:
        return
    if "differences" in table:
        if figure := _differences(table):
            yield "convergence", figure
        return
    h = np.array(table["h"])
    errors = {name: np.array([np.nan if e is None else e for e in column]) for name, column in table["errors"].items()}
    errors = {name: column for name, column in errors.items() if np.nanmax(column, initial=0) > ROUND_OFF}
    if not errors:
        return
    figure, axes = pyplot.subplots(figsize=(5.8, 4.6))
    for (name, column), marker in zip(errors.items(), itertools.cycle(MARKERS)):
        rate = table["fitted"][name]
        label = NAMES.get(name, name) + ("" if rate is None else f": rate {rate:.2f}")
        axes.loglog(h, column, marker=marker, markersize=4.5, label=label)
    _finish(axes, h, list(errors.values()))
    axes.set_title(f"{table['case']}: largest errors", loc="left")
    yield "convergence", figure
