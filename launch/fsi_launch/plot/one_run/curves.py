"""Curves: fields along a line where they depend on one coordinate only, and the tables over time."""

import re
from functools import partial

import numpy as np
from matplotlib import pyplot

from fsi_launch.plot.look import style, units
from fsi_launch.plot.several_runs import several

GAS_LINES = (("rho", "density $\\rho$"), ("v", "velocity $v$"), ("p", "pressure $p$"))
SOLID_LINES = (("u", "displacement $\\bar u$"), ("v", "velocity $\\bar v$"), ("P11", "stress $\\bar P_{11}$"))
SAME = 1e-3        # variation across the line, part of the variation along it, that counts as none
UNSEEN = 1e-7      # the same, part of the largest value of all components
LEAST = 1e-9       # the same, where all is round-off
MOST_TIMES = 6
REFERENCE = {"color": "black", "linewidth": 2.6, "alpha": 0.3, "zorder": 1}
SAME_VALUE = 1e-11  # differences, part of the values, that are round-off
PROPOSED = ".proposed_dt"   # of the name of a column
OF_STRESS = ("traction_jump", "shear")      # which a solid without a stress of its own, as a rigid body, has none of
FAR = 30            # times the step taken: proposals beyond take a logarithmic scale
FEW = 16            # times, which are marked: between them nothing is known
WORDS = {"dt": "time step", "force1": "force along $x$", "force2": "force along $y$", "centre1": "$x$ of the centre", "centre2": "$y$ of the centre",
         "velocity1": "velocity of the centre along $x$", "velocity2": "velocity of the centre along $y$", "angle": "angle turned",
         "velocity_jump": "velocity jump", "traction_jump": "traction jump", "shear": "tangential traction", "p_max": "largest pressure",
         "momentum1_defect": "momentum along $x$, defect", "momentum2_defect": "momentum along $y$, defect", "mass_defect": "mass, defect",
         "energy_defect": "energy, defect", "kinetic": "kinetic energy", "strain": "strain energy", "work": "work of the gas",
         "rho": "density $\\rho$", "p": "pressure $p$", "T": "temperature $T$", "theta": "rotation $\\theta$", "N": "axial force $N$",
         "Q": "shear force $Q$", "M": "moment $M$"}


# --- lines


def _depends_on_one_coordinate(grid):
    """True if every field is the same on all lines j = const., as in a piston or a tube."""
    if min(grid.x1.shape) < 2:
        return False
    fields = {key: values for key, values in grid.fields.items() if not key.startswith("x")}
    largest = {}    # of all components of a vector or a tensor
    for key, values in fields.items():
        largest[key.rstrip("12")] = max(largest.get(key.rstrip("12"), 0), np.abs(values).max())
    return all(np.ptp(values, axis=0).max() <= SAME * np.ptp(values, axis=1).max() + UNSEEN * largest[key.rstrip("12")] + LEAST
               for key, values in fields.items())


def _direction(grid):
    """Unit vector along the middle line j = const. of a grid."""
    j = len(grid.x1) // 2
    e = np.array([grid.x1[j, -1] - grid.x1[j, 0], grid.x2[j, -1] - grid.x2[j, 0]])
    return e / np.linalg.norm(e)


def along(grid, key, floor):
    """(coordinate, values) on the middle line, round-off as zero; "v" and "u" stand for the components along it."""
    j, e = len(grid.x1) // 2, _direction(grid)
    s = grid.x1[j] * e[0] + grid.x2[j] * e[1]
    values = grid.fields[f"{key}1"][j] * e[0] + grid.fields[f"{key}2"][j] * e[1] if key in ("v", "u") else grid.fields[key][j]
    return s, np.where(np.abs(values) > floor, values, 0)


def lines_of(one):
    """((field, its label), ..) of a program's lines."""
    return GAS_LINES if one.is_gas() else SOLID_LINES


def line_panels(first):
    """(figure, axes[field][program]) with the titles of the lines that the programs of `first` have."""
    figure, panels = pyplot.subplots(3, len(first), figsize=(4.4 * len(first), 6.3), squeeze=False, sharex="col")
    for column, one in enumerate(first):
        for row, (key, label) in enumerate(lines_of(one)):
            text = units.label(label, unit_of(key))
            panels[row][column].set_title(text if row else f"{one.name}: {text}", loc="left")
        panels[-1][column].set_xlabel(units.label("position along the line", "length"))
    return figure, panels


def along_one_coordinate(series):
    """The gas and the solids with an inside, if their fields depend on one coordinate only; else none."""
    inside = [one for one in series if one.has_an_inside()]
    grids = [one.outputs[-1].grids for one in inside]
    return inside if all(len(some) == 1 and _depends_on_one_coordinate(some[0]) for some in grids) else []


def _reference_line(axes, one, key, table):
    """The reference under the computed curve last drawn, as far as that goes; positions of the solid are those in space."""
    computed = axes.lines[-1].get_xdata()
    part = table["gas" if one.is_gas() else "solid"]
    s = part["x"] if one.is_gas() else part["x_bar"] + part["u"]
    shown = (s >= computed.min()) & (s <= computed.max())
    axes.plot(s[shown], part[key][shown], **REFERENCE)


def legend_beside(panels):
    """The names of the first panel's lines, where no panel has any."""
    panels[0][-1].legend(*panels[0][0].get_legend_handles_labels(), loc="upper left", bbox_to_anchor=(1.0, 1.0))


def _lines_picture(series, scales, reference):
    figure, panels = line_panels(series)
    for column, one in enumerate(series):
        shown = sorted({round(k) for k in np.linspace(0, len(one.outputs) - 1, min(MOST_TIMES, len(one.outputs)))})
        colours = pyplot.get_cmap(style.GAS_MAP)(np.linspace(0, 0.85, len(shown)))
        for row, (key, _) in enumerate(lines_of(one)):
            axes = panels[row][column]
            for index, colour in zip(shown, colours):
                output = one.outputs[index]
                axes.plot(*along(output.grids[0], key, scales.floor(unit_of(key))), color=colour, label=units.moment(output.t, 3))
                if table := several.at(reference, output.t):
                    _reference_line(axes, one, key, table)
            steady(axes, np.concatenate([line.get_ydata() for line in axes.lines]))
    if reference:
        panels[0][0].plot([], [], label="reference", **REFERENCE)
    legend_beside(panels)
    return figure


# --- tables


def _bare(heading):
    """The name of a column without its unit."""
    return heading.split("[")[0].strip()


def _time_column(table):
    return next((name for name in table.columns if _bare(name) == "t"), None)


def _groups(table):
    """{label: mask} by the columns that hold words (an interface's or a probe's name)."""
    words = [name for name, values in table.columns.items() if values.dtype.kind == "U" and name != "limited_by"]
    if not words:
        return {"": np.ones(len(next(iter(table.columns.values()))), dtype=bool)}
    keys = table.columns[words[0]]
    return {key: keys == key for key in sorted(set(keys))}


def unit_of(heading):
    """The unit of a column; of a probe's column, which has none, that of its field."""
    if "[" in heading:
        return heading.split("[")[1].rstrip("]")
    field = heading.rsplit(".", 1)[-1]
    return {"v": "length/time", "u": "length", "p": "force/area", "P": "force/area", "r": "mass/volume"}.get(field[:1], "unknown")


def _words(name):
    """The name of a column, which stands after its interface's or its probe's: "tip.u1" is "tip: $u_1$"."""
    owner, _, field = name.rpartition(".")
    component = re.fullmatch(r"([uvP])(\d+)", field)
    said = f"${component[1]}_{{{component[2]}}}$" if component else WORDS.get(field, field.replace("_", " "))
    return f"{owner.replace('_', ' ')}: {said}" if owner else said


def _title(heading):
    """A heading for people, with its unit in symbols where the case says which."""
    name, bracket, unit = heading.partition(" [")
    return units.heading(_words(name) + bracket + unit) if bracket else units.label(_words(name), unit_of(heading))


def steady(axes, values):
    """Room around values that differ by round-off only, which is not worth a scale."""
    values = values[np.isfinite(values)]
    largest = np.max(np.abs(values), initial=0)
    if largest == 0:
        axes.set_ylim(-1, 1)
    elif np.max(values) - np.min(values) <= SAME_VALUE * largest:
        axes.set_ylim(np.min(values) - 0.5 * largest, np.max(values) + 0.5 * largest)


def _curve(axes, name, t, values, label, floor):
    """A curve; jumps and gaps over many powers of ten get a logarithmic scale, without what is below `floor`."""
    positive = values[values > floor]
    if _bare(name).endswith(("jump", "gap")) and len(positive) and positive.max() > 300 * np.percentile(positive, 5):
        axes.set_yscale("log")
        values = np.where(values > floor, values, np.nan)
    axes.plot(t, values, label=label, marker="o" if len(t) <= FEW else "", markersize=3)


def _zero(axes, t, largest):
    """A flat line for a column that is nothing but round-off, and how large that is."""
    axes.plot(t, np.zeros_like(t))
    axes.set_ylim(-1, 1)
    axes.set_yticks([0])
    text = "zero" if largest == 0 else f"zero (at most {largest:.0e})"
    axes.text(0.02, 0.6, text, transform=axes.transAxes, fontsize=8, color="#666666")


def _proposals(axes, table, t):
    """What the programs proposed, beside the steps that were taken."""
    proposed = {_bare(name).removesuffix(PROPOSED): np.where(np.isfinite(values), values, np.nan)
                for name, values in table.columns.items() if _bare(name).endswith(PROPOSED)}
    proposed = {name: values for name, values in proposed.items() if not np.isnan(values).all()}
    if not proposed:
        return
    axes.lines[-1].set(label="taken", color="black", linestyle="--", zorder=3)
    for name, values in proposed.items():
        axes.plot(t, values, label=name.replace("_", " "))
    drawn = np.concatenate([line.get_ydata() for line in axes.lines])
    if np.nanmax(drawn) > FAR * np.nanmin(drawn):
        axes.set_yscale("log")
    axes.autoscale(axis="y")
    axes.legend(loc="upper left", bbox_to_anchor=(1, 1), handlelength=1.4, borderaxespad=0)     # beside the curves, which may lie anywhere


def _drawn_alone(name, values, time):
    if values.dtype.kind != "f" or name == time or _bare(name) == "step" or _bare(name).endswith(PROPOSED):
        return False
    return _bare(name).rsplit(".", 1)[-1] not in OF_STRESS or values.any()


def _table_picture(table, scales):
    time = _time_column(table)
    names = [name for name, values in table.columns.items() if _drawn_alone(name, values, time)]
    if time is None or not names:
        return None
    columns = min(3, len(names))
    rows = -(-len(names) // columns)
    figure, panels = pyplot.subplots(rows, columns, figsize=(4.0 * columns, 2.3 * rows), squeeze=False, sharex=True)
    for axes, name in zip(panels.flat, names):
        if _bare(name) == "dt":  # the start has none
            table.columns[name][table.columns[name] == 0] = np.nan
        floor, largest = scales.floor(unit_of(name)), np.nanmax(np.abs(table.columns[name]), initial=0)
        axes.set_title(_title(name), loc="left")
        if largest <= floor:
            _zero(axes, table.columns[time], largest)
            continue
        steady(axes, table.columns[name])
        for label, mask in _groups(table).items():
            _curve(axes, name, table.columns[time][mask], table.columns[name][mask], label, floor)
        if _bare(name) == "dt":
            _proposals(axes, table, table.columns[time])
        if len(_groups(table)) > 1:
            axes.legend()
    for axes in panels.flat[len(names):]:
        axes.set_visible(False)
    for axes in panels.flat[max(0, len(names) - columns):len(names)]:  # the lowest of each column
        axes.set_xlabel(units.label("t", "time"))
        axes.tick_params(labelbottom=True)
    return figure


def pictures(series, tables, scales, reference):
    """(name, figure or a function that makes it) of the curves a run has; `reference`: its one-dimensional solution {t: tables}, or nothing."""
    if plain := along_one_coordinate(series):
        yield "lines", partial(_lines_picture, plain, scales, reference)
    for table in tables:
        if figure := _table_picture(table, scales):
            yield table.name, figure
