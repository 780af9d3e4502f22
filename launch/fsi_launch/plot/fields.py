"""Pictures of the fields at the output times, solids in deformed position, and of the grids."""

import numpy as np
from matplotlib import pyplot
from matplotlib.collections import LineCollection

from fsi_launch.plot import style

MOST_TIMES = 12        # pictures of fields; of a longer series, times evenly spread
MOST_LINES = 60        # grid lines drawn along each direction
GAS_QUANTITIES = (("pressure $p$", lambda grid: grid.fields["p"]), ("density $\\rho$", lambda grid: grid.fields["rho"]),
                  ("speed $|v|$", lambda grid: grid.speed()))
SOLID_QUANTITIES = (
    ("speed $|\\bar v|$", lambda grid: grid.speed()),
    ("displacement $|\\bar u|$", lambda grid: np.hypot(grid.fields["u1"], grid.fields["u2"])),
    ("stress $|\\bar P|$", lambda grid: np.sqrt(sum(grid.fields[f"P{c}"] ** 2 for c in ("11", "12", "21", "22")))))


def _times_shown(count):
    if count <= MOST_TIMES:
        return list(range(count))
    return sorted({round(k) for k in np.linspace(0, count - 1, MOST_TIMES)})


def _limits(series):
    """Box around everything at all times: (x low, x high, y low, y high)."""
    grids = [grid for one in series for output in (one.outputs[0], one.outputs[-1]) for grid in output.grids]
    return (min(g.x1.min() for g in grids), max(g.x1.max() for g in grids),
            min(g.x2.min() for g in grids), max(g.x2.max() for g in grids))


def _panels(count, box):
    """Axes of equal scale, stacked so that the pictures are as large as they can be."""
    width, height = box[1] - box[0], box[3] - box[2]
    wide = width > 1.3 * height
    rows, columns = (count, 1) if wide else (1, count)
    panel_width = 7.0 if wide else 4.2
    panel_height = min(max(panel_width * height / width, 1.2), 6.0) + 0.4
    figure, axes = pyplot.subplots(rows, columns, figsize=((panel_width + 0.9) * columns, panel_height * rows + 0.3),
                                   squeeze=False)
    for one in axes.flat:
        one.set_aspect("equal")
        one.set_xlim(box[0], box[1])
        one.set_ylim(box[2], box[3])
    return figure, list(axes.flat)


def _outline(grid):
    """The rim of a grid as one closed line."""
    parts = [np.s_[0, :], np.s_[:, -1], np.s_[-1, ::-1], np.s_[::-1, 0]]
    return np.concatenate([grid.x1[p] for p in parts]), np.concatenate([grid.x2[p] for p in parts])


def _colour(axes, grids, quantity, colours):
    """Draws one quantity of one program; returns what the colour bar needs."""
    values = [quantity(grid) for grid in grids]
    low, high = min(v.min() for v in values), max(v.max() for v in values)
    if high - low <= 1e-12 * max(abs(low), abs(high)):  # a constant to round-off: show no noise
        low, high = low - 0.5 * (abs(low) or 1), high + 0.5 * (abs(high) or 1)
    for grid, value in zip(grids, values):
        mesh = axes.pcolormesh(grid.x1, grid.x2, value, shading="gouraud", cmap=colours, vmin=low, vmax=high,
                               rasterized=True)
    return mesh


def _fill_solid(axes, grids):
    for grid in grids:
        axes.fill(*_outline(grid), facecolor=style.SOLID_FILL, edgecolor=style.SOLID_EDGE, linewidth=0.8)


def _bar(figure, axes, mesh, label):
    bar = figure.colorbar(mesh, ax=axes, shrink=0.9, pad=0.015, aspect=18)
    bar.outline.set_visible(False)
    bar.ax.set_title(label, fontsize=8)


def _draw_gas(figure, axes, gas, solids, label, quantity):
    mesh = _colour(axes, gas.grids, quantity, style.GAS_MAP)
    _bar(figure, axes, mesh, "gas")
    show_speed = label.startswith("speed")
    if show_speed and solids:
        for solid in solids:
            mesh = _colour(axes, solid.grids, quantity, style.SOLID_MAP)
        _bar(figure, axes, mesh, "solid")
        return
    for solid in solids:
        _fill_solid(axes, solid.grids)


def _field_picture(series, index, box):
    """All quantities of all programs at output `index`."""
    gas = next((one.outputs[index] for one in series if one.is_gas()), None)
    solids = [one.outputs[index] for one in series if not one.is_gas()]
    quantities = GAS_QUANTITIES if gas else SOLID_QUANTITIES
    figure, panels = _panels(len(quantities), box)
    for axes, (label, quantity) in zip(panels, quantities):
        if gas:
            _draw_gas(figure, axes, gas, solids, label, quantity)
        else:
            _bar(figure, axes, [_colour(axes, solid.grids, quantity, style.SOLID_MAP) for solid in solids][-1], "")
        axes.set_title(label, loc="left")
    figure.suptitle(f"t = {series[0].outputs[index].t:.4g}", x=0.01, ha="left", fontsize=10)
    return figure


def _grid_lines(grid):
    """Every n-th line of both directions, so that at most MOST_LINES are drawn; the last one always."""
    lines = []
    for x1, x2 in ((grid.x1, grid.x2), (grid.x1.T, grid.x2.T)):
        step = max(1, -(-len(x1) // MOST_LINES))
        chosen = sorted({*range(0, len(x1), step), len(x1) - 1})
        lines += [np.column_stack([x1[k], x2[k]]) for k in chosen]
    return lines


def _grid_picture(series, index, box):
    figure, (axes,) = _panels(1, box)
    for one in series:
        colour = style.GAS_EDGE if one.is_gas() else style.SOLID_EDGE
        for grid in one.outputs[index].grids:
            axes.add_collection(LineCollection(_grid_lines(grid), colors=colour, linewidths=0.35))
    axes.set_title(f"grids at t = {series[0].outputs[index].t:.4g}: gas blue, solid brown", loc="left")
    return figure


def pictures(series):
    """(name, figure) of the fields at the output times, and of the grids at the last one."""
    if not series:
        return
    box = _limits(series)
    count = min(len(one.outputs) for one in series)  # a killed run may lack the last output of one program
    for index in _times_shown(count):
        yield f"fields_{index:04}", _field_picture(series, index, box)
    yield "grid", _grid_picture(series, count - 1, box)
