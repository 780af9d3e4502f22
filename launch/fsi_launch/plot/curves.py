"""Curves: fields along a line where they depend on one coordinate only, and the tables over time."""

import numpy as np
from matplotlib import pyplot

from fsi_launch.plot import style

GAS_LINES = (("rho", "density $\\rho$"), ("v", "velocity $v$"), ("p", "pressure $p$"))
SOLID_LINES = (("u", "displacement $\\bar u$"), ("v", "velocity $\\bar v$"), ("P11", "stress $\\bar P_{11}$"))
SAME = 1e-3        # variation across the line, part of the variation along it, that counts as none
MOST_TIMES = 6


# --- lines


def _depends_on_one_coordinate(grid):
    """True if every field is the same on all lines j = const., as in a piston or a tube."""
    if min(grid.x1.shape) < 2:
        return False
    for values in grid.fields.values():
        along = np.ptp(values, axis=1).max()
        if np.ptp(values, axis=0).max() > SAME * along + 1e-9 * (1 + np.abs(values).max()):
            return False
    return True


def _direction(grid):
    """Unit vector along the middle line j = const. of a grid."""
    j = len(grid.x1) // 2
    e = np.array([grid.x1[j, -1] - grid.x1[j, 0], grid.x2[j, -1] - grid.x2[j, 0]])
    return e / np.linalg.norm(e)


def _along(grid, key, e):
    """(coordinate, values) on the middle line; "v" and "u" stand for the components along it."""
    j = len(grid.x1) // 2
    s = grid.x1[j] * e[0] + grid.x2[j] * e[1]
    if key in ("v", "u"):
        return s, grid.fields[f"{key}1"][j] * e[0] + grid.fields[f"{key}2"][j] * e[1]
    return s, grid.fields[key][j]


def _lines_picture(series):
    kinds = [GAS_LINES if one.is_gas() else SOLID_LINES for one in series]
    figure, panels = pyplot.subplots(3, len(series), figsize=(4.4 * len(series), 6.3), squeeze=False, sharex="col")
    for column, (one, lines) in enumerate(zip(series, kinds)):
        shown = sorted({round(k) for k in np.linspace(0, len(one.outputs) - 1, min(MOST_TIMES, len(one.outputs)))})
        colours = pyplot.get_cmap(style.GAS_MAP)(np.linspace(0, 0.85, len(shown)))
        for row, (key, label) in enumerate(lines):
            axes = panels[row][column]
            for index, colour in zip(shown, colours):
                output = one.outputs[index]
                axes.plot(*_along(output.grids[0], key, _direction(output.grids[0])), color=colour,
                          label=f"t = {output.t:.3g}")
            axes.set_title(label, loc="left")
        panels[0][column].set_title(f"{one.name}: {lines[0][1]}", loc="left")
        panels[-1][column].set_xlabel("position along the line")
    panels[0][0].legend()
    return figure


# --- tables


def _bare(heading):
    """The name of a column without its unit."""
    return heading.split("[")[0].strip()


def _time_column(table):
    return next((name for name in table.columns if _bare(name) == "t"), None)


def _groups(table):
    """{label: mask} by the columns that hold words (an interface's or a probe's name)."""
    words = [name for name, values in table.columns.items() if values.dtype.kind == "U"]
    if not words:
        return {"": np.ones(len(next(iter(table.columns.values()))), dtype=bool)}
    keys = table.columns[words[0]]
    return {key: keys == key for key in sorted(set(keys))}


def _curve(axes, t, values, label):
    """A curve; magnitudes over many powers of ten get a logarithmic scale."""
    positive = values[values > 0]
    if len(positive) > 1 and (values >= 0).all() and positive.max() > 300 * positive.min():
        axes.set_yscale("log")
        values = np.where(values > 0, values, np.nan)
    axes.plot(t, values, label=label)


def _table_picture(table):
    time = _time_column(table)
    names = [name for name, values in table.columns.items()
             if values.dtype.kind == "f" and name != time and _bare(name) != "step"]
    if time is None or not names:
        return None
    columns = min(3, len(names))
    rows = -(-len(names) // columns)
    figure, panels = pyplot.subplots(rows, columns, figsize=(4.0 * columns, 2.3 * rows), squeeze=False, sharex=True)
    for axes, name in zip(panels.flat, names):
        for label, mask in _groups(table).items():
            _curve(axes, table.columns[time][mask], table.columns[name][mask], label)
        axes.set_title(name.replace("_", " "), loc="left")
        if len(_groups(table)) > 1:
            axes.legend()
    for axes in panels.flat[len(names):]:
        axes.set_visible(False)
    for axes in panels.flat[max(0, len(names) - columns):len(names)]:  # the lowest of each column
        axes.set_xlabel("t")
        axes.tick_params(labelbottom=True)
    return figure


def pictures(series, tables):
    """(name, figure) of the curves a run has."""
    plain = [one for one in series if len(one.outputs[-1].grids) == 1]
    if plain and all(_depends_on_one_coordinate(one.outputs[-1].grids[0]) for one in plain):
        yield "lines", _lines_picture(plain)
    for table in tables:
        if figure := _table_picture(table):
            yield table.name, figure
