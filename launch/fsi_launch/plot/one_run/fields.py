"""Pictures of the fields at the output times, solids in deformed position (the paper's figure 10)."""

import itertools
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import partial

import numpy as np
from matplotlib import pyplot
from matplotlib.collections import LineCollection
from matplotlib.patches import Rectangle

from fsi_launch.plot.look import shading, style, units
from fsi_launch.plot.reading import data, mesh
from fsi_launch.plot.reading.scales import Scales
from fsi_launch.telling import tell

MOST_TIMES = 12        # pictures of fields; of a longer series, times evenly spread
CONTOURS = 16          # lines, where they are asked for; an even number keeps off the zero of signed fields
SLOW = 0.05            # gas and solids of which one moves at less than this part of the other's speed have scales of their own: one would hide its waves
RIM = 0.005            # around all points, part of the longer side of their box,
THIN_RIM = 0.05        # and at most this part of the side itself
THIN = 0.1             # height over width of a domain below which the two directions have scales of their own
ROUND_OFF = 1e-12      # variation, part of the values, that is no variation


@dataclass
class Look:
    """How fields are drawn."""

    scales: Scales
    contours: bool = False


@dataclass(frozen=True)
class Quantity:
    """What is drawn of a grid, and its unit."""

    unit: str
    values: Callable


V1 = Quantity("length/time", lambda grid: grid.fields["v1"])
SPEED = Quantity("length/time", lambda grid: grid.speed())
PRESSURE = Quantity("force/area", lambda grid: grid.fields["p"])
DENSITY = Quantity("mass/volume", lambda grid: grid.fields["rho"])
DISPLACEMENT = Quantity("length", lambda grid: np.hypot(grid.fields["u1"], grid.fields["u2"]))
STRESS = Quantity("force/area", lambda grid: np.sqrt(sum(grid.fields[f"P{c}"] ** 2 for c in ("11", "12", "21", "22"))))

# (title, of the gas, of the solids); where the solids have none they are plain
GAS_PANELS = (("horizontal velocity $v_1$", V1, None), ("speed $|v|$", SPEED, None),
              ("pressure $p$", PRESSURE, None), ("density $\\rho$", DENSITY, None))
BOTH_PANELS = (("horizontal velocity $v_1$, $\\bar v_1$", V1, V1), ("speed $|v|$, $|\\bar v|$", SPEED, SPEED),
               ("pressure $p$, stress $|\\bar P|$", PRESSURE, STRESS), ("density $\\rho$", DENSITY, None))
SOLID_PANELS = (("speed $|\\bar v|$", None, SPEED), ("displacement $|\\bar u|$", None, DISPLACEMENT),
                ("stress $|\\bar P|$", None, STRESS))


def times_shown(count):
    if count <= MOST_TIMES:
        return list(range(count))
    return sorted({round(k) for k in np.linspace(0, count - 1, MOST_TIMES)})


def box_around(grids):
    """(x low, x high, y low, y high) around the used points, with room for the line of a rim."""
    x1 = np.concatenate([grid.x1[grid.used()] for grid in grids])
    x2 = np.concatenate([grid.x2[grid.used()] for grid in grids])
    sides = np.ptp(x1), np.ptp(x2)
    rim1, rim2 = (min(RIM * max(sides), THIN_RIM * side) for side in sides)
    return x1.min() - rim1, x1.max() + rim1, x2.min() - rim2, x2.max() + rim2


def _arrangement(count, shape):
    """(rows, columns) for panels whose width is `shape` times their height."""
    if shape > 2.2:
        return count, 1
    if count == 4:
        return 2, 2
    return (count, 1) if shape > 1.3 else (1, count)


def is_thin(width, height):
    """Have the two directions scales of their own?"""
    return height < THIN * width


def panels(count, box, beside):
    """(figure, axes) of equal scale unless they would be too thin, arranged so that the pictures are large, with room `beside` each
    [inch]."""
    width, height = box[1] - box[0], box[3] - box[2]
    thin = is_thin(width, height)
    height = max(height, THIN * width)
    rows, columns = _arrangement(count, width / height)
    panel_width = 6.4 if columns == 1 else 4.0
    panel_height = min(panel_width * height / width, 6.0)
    panel_width = min(panel_width, panel_height * width / height)
    above = 0.75 if columns == 1 and beside else 0.55    # what stands over a bar is higher than a title
    size = ((panel_width + 0.5 + beside) * columns, (panel_height + above) * rows + 0.3)
    figure, axes = pyplot.subplots(rows, columns, figsize=(max(size[0], 3.2), size[1]), squeeze=False)
    for one in axes.flat:
        one.set_aspect("auto" if thin else "equal")
        one.set_xlim(box[0], box[1])
        one.set_ylim(box[2], box[3])
    style.name_axes(axes)
    return figure, list(axes.flat)


def _colour_range(values, floor):
    """(low, high, the constant if it is one but for round-off, which is not shown)."""
    low, high = values.min(), values.max()
    largest = max(abs(low), abs(high))
    if largest <= floor:
        return 0.0, 1.0, 0.0
    if high - low <= max(ROUND_OFF * largest, floor):
        return low - 0.5 * largest, high + 0.5 * largest, 0.5 * (low + high)
    if low < 0 < high and min(-low, high) > 0.1 * largest:
        return -largest, largest, None
    return low, high, None


def _contours(axes, grids, k, values, levels):
    """Lines on what the grids laid over grid k leave of it: none is drawn twice."""
    triangles = mesh.triangles(grids[k], mesh.uncovered(grids[k], grids[k + 1:]), values)
    if not triangles:
        return
    shown = values[triangles.triangles]
    levels = levels[(levels > shown.min()) & (levels < shown.max())]
    if len(levels):
        axes.tricontour(triangles, values, levels=levels, colors="black", linewidths=0.4, linestyles="solid")


def _range(outputs, quantities, floor):
    """`_colour_range` of a quantity over these outputs; `quantities`: (of the gas, of the solids), `outputs`: those of both."""
    found = []
    for quantity, some in zip(quantities, outputs):
        for grid in (grid for output in some for grid in output.grids) if quantity else ():
            values = quantity.values(grid)[grid.used()]
            if (values := values[np.isfinite(values)]).size:
                found += [values.min(), values.max()]
    return _colour_range(np.array(found or [0.0]), floor)


@dataclass
class Panel:
    """One panel of the pictures of all times, each with the same colours. Where gas and solids show the same, what is continuous across
    their interface, they have one scale: both ranges are the same object. `plain`: numbers of the solids that have nothing to show here."""

    title: str
    of_gas: Quantity | None
    of_solid: Quantity | None
    gas_range: tuple | None = None
    solid_range: tuple | None = None
    plain: frozenset = frozenset()

    def one_scale(self):
        return self.gas_range is self.solid_range


def _colour(axes, outputs, quantity, colours, limits, look):
    """Draws one quantity of the gas, or of all solids, on all component grids; returns what the colour bar needs."""
    low, high, constant = limits
    colours = style.SIGNED_MAP if constant is None and low == -high else colours
    levels, drawn = np.linspace(low, high, CONTOURS + 2)[1:-1], None
    for output in outputs:
        for k, grid in enumerate(output.filled):
            values = np.where(grid.used(), quantity.values(grid), 0)
            if constant is not None:
                values[:] = constant
            drawn = shading.shade(axes, grid, values, colours, (low, high)) or drawn
            if look.contours and constant is None:
                _contours(axes, output.filled, k, values.ravel(), levels)
    return drawn


def fill(axes, grids):
    """The region of a solid in one plain colour."""
    for grid in grids:
        shading.plain(axes, grid, style.SOLID_FILL)


def outline(axes, grids):
    lines = [line for grid in grids for line in mesh.outer_lines(grid)]
    axes.add_collection(LineCollection(lines, colors=style.SOLID_EDGE, linewidths=0.7))


def _ground(axes):
    """What is neither gas nor solid, within the box around all points: walls, as the background's rectangle has them."""
    (left, right), (bottom, top) = axes.get_xlim(), axes.get_ylim()
    sides = right - left, top - bottom
    rim1, rim2 = (min(RIM / (1 + 2 * RIM) * max(sides), THIN_RIM / (1 + 2 * THIN_RIM) * side) for side in sides)
    axes.add_patch(Rectangle((left + rim1, bottom + rim2), sides[0] - 2 * rim1, sides[1] - 2 * rim2, color=style.WALL_FILL, linewidth=0,
                             zorder=0))


def _draw(figure, axes, gas, solids, panel, look):
    """One panel."""
    if solids and panel.of_solid:  # the bar drawn first is the one further out
        colours = style.GAS_MAP if panel.one_scale() else style.SOLID_MAP
        drawn = _colour(axes, [solid for k, solid in enumerate(solids) if k not in panel.plain], panel.of_solid, colours, panel.solid_range, look)
        if not panel.one_scale():
            beside = style.above_bar("gas", *panel.gas_range) if gas else ()
            style.bar(figure, axes, drawn, "solid" if gas else "", panel.solid_range[2], beside)
    if gas:
        _ground(axes)
        drawn = _colour(axes, [gas], panel.of_gas, style.GAS_MAP, panel.gas_range, look)
        style.bar(figure, axes, drawn, "gas" if solids and not panel.one_scale() else "", panel.gas_range[2])
    for k, solid in enumerate(solids):
        if not panel.of_solid or k in panel.plain:
            fill(axes, solid.grids)
        outline(axes, solid.grids)
    axes.set_title(units.label(panel.title, (panel.of_gas or panel.of_solid).unit), loc="left")


def _kinds_of_panels(gas, solids, floor):
    """The panels that say something of these outputs: along x1 the speed is the size of v1."""
    if not gas:
        return SOLID_PANELS
    everything = BOTH_PANELS if solids else GAS_PANELS
    along = all(np.allclose(np.abs(grid.fields["v1"]), grid.speed(), rtol=1e-6, atol=floor, equal_nan=True)
                for output in (*gas, *solids) for grid in output.grids)
    return everything[1:] if along else everything


def _size(limits):
    low, high, constant = limits
    return abs(constant) if constant is not None else max(abs(low), abs(high))


def comparable(*speeds):
    """Whether one scale shows both: none is slow beside the other, or one is at rest."""
    slower, faster = sorted(speeds)
    return slower == 0 or slower >= SLOW * faster


def _panels_of(gas, solids, look):
    """The panels for all these outputs of the gas and of each solid."""
    found = []
    of_gas_alone = {quantity: title for title, quantity, _ in GAS_PANELS}
    for title, of_gas, of_solid in _kinds_of_panels(gas, list(itertools.chain(*solids)), look.scales.floor(SPEED.unit)):
        floor = look.scales.floor((of_gas or of_solid).unit)
        gas_range = _range((gas, []), (of_gas, None), floor) if of_gas else None
        plain = frozenset(k for k, one in enumerate(solids)    # a rigid body has no stress, a held one no speed
                          if of_gas and of_solid and _range(([], one), (None, of_solid), floor)[2] == 0)
        coloured = [output for k, one in enumerate(solids) if k not in plain for output in one]
        if of_gas and of_solid and not coloured:
            title, of_solid = of_gas_alone[of_gas], None
        solid_range = _range(([], coloured), (None, of_solid), floor) if of_solid else None
        if of_gas is of_solid and comparable(_size(gas_range), _size(solid_range)):
            gas_range = solid_range = _range((gas, coloured), (of_gas, of_solid), floor)
        found.append(Panel(title, of_gas, of_solid, gas_range, solid_range, plain))
    return found


@dataclass
class _Plan:
    """What the pictures of all times have in common."""

    gas: object         # Series, or None
    solids: list
    box: tuple
    panels: list
    look: Look


def _plan(series, look):
    gas, solids = data.gas_of(series), [one for one in series if not one.is_gas()]
    box = box_around([grid for one in series for output in one.outputs for grid in output.grids])
    return _Plan(gas, solids, box, _panels_of(gas.outputs if gas else [], [one.outputs for one in solids], look), look)


def _field_picture(plan, index):
    """All quantities of all programs at output `index`."""
    gas, solids = plan.gas.outputs[index] if plan.gas else None, [one.outputs[index] for one in plan.solids]
    bars = max(bool(gas) + bool(solids and panel.of_solid) - panel.one_scale() for panel in plan.panels)
    figure, axes = panels(len(plan.panels), plan.box, 0.8 * bars)
    for one, panel in zip(axes, plan.panels):
        _draw(figure, one, gas, solids, panel, plan.look)
    figure.same_places = id(plan)
    figure.suptitle(units.moment((gas or solids[0]).t), x=0.01, ha="left", fontsize=10)
    return figure


def pictures(series, look):
    """(name, function that draws it) of the fields at the output times, all with the same colours."""
    if not series:
        return
    count = min(len(one.outputs) for one in series)  # a killed run may lack the last output of one program
    plan = _plan([replace(one, outputs=one.outputs[:count]) for one in series], look)
    shown = times_shown(count)
    if len(shown) < count:
        tell(f"fields: {len(shown)} of {count} output times are drawn; --at TIME draws others")
    for index in shown:
        yield f"fields_{series[0].outputs[index].number:04}", partial(_field_picture, plan, index)


def last_picture(series, look):
    """(name, figure) of the state just before the solution diverged."""
    if not series:
        return
    figure = _field_picture(_plan(series, look), 0)
    moments = [units.moment(one.outputs[0].t) for one in series]
    times = moments[0] if len(set(moments)) == 1 else ", ".join(f"{one.name} at {t}" for one, t in zip(series, moments))
    figure.suptitle(f"the last state before the solution diverged: {times}", x=0.01, ha="left", fontsize=10)
    yield "fields_last", figure
