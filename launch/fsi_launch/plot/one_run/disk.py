"""The rotating disk beside its one-dimensional reference: all points over their radius with the difference, and the horizontal
velocity and stress along y = 0 (the paper's figure 11)."""

from dataclasses import dataclass
from functools import partial

import numpy as np
from matplotlib import pyplot
from matplotlib.lines import Line2D
from matplotlib.ticker import MaxNLocator
from matplotlib.tri import LinearTriInterpolator

from fsi_launch.plot.look import style, units
from fsi_launch.plot.reading import data, mesh

AXIS_POINTS = 1601  # along y = 0

# Components along and across the current radius: (key, title)
PANELS = (("v_r", "radial velocity $v_r$"), ("v_theta", "tangential velocity $v_\\theta$"),
          ("normal", "$\\bar\\sigma_{rr}$ of the solid, $p_e - p$ of the gas"),
          ("shear", "shear stress $\\bar\\sigma_{r\\theta}$"))


@dataclass
class Points:
    """Points of one program: their label in the reference table (radius in space of the gas, at rest of the solid),
    radius in space, and the values of each panel."""

    label: np.ndarray
    r: np.ndarray
    values: dict


def _polar(x1, x2, a1, a2):
    """Components of a vector along and across the ray to (x1, x2); at the origin along the axes."""
    r = np.hypot(x1, x2)
    c, s = np.where(r > 0, x1, 1) / np.where(r > 0, r, 1), x2 / np.where(r > 0, r, 1)
    return c * a1 + s * a2, c * a2 - s * a1


def _stress_on_circle(F, P, x1, x2):
    """(normal, shear) traction on the circle through (x1, x2): Cauchy stress F P / det F, P the nominal stress."""
    J = F[0, 0] * F[1, 1] - F[0, 1] * F[1, 0]
    sigma = np.einsum("ik...,kj...->ij...", F, P) / J
    r = np.hypot(x1, x2)
    n1, n2 = np.where(r > 0, x1, 1) / np.where(r > 0, r, 1), x2 / np.where(r > 0, r, 1)
    return _polar(x1, x2, sigma[0, 0] * n1 + sigma[0, 1] * n2, sigma[1, 0] * n1 + sigma[1, 1] * n2)


def _nominal(fields):
    return np.array([[fields["P11"], fields["P12"]], [fields["P21"], fields["P22"]]])


# --- what the programs computed


def _gas_points(grid, p_e):
    f = grid.fields
    v_r, v_theta = _polar(grid.x1, grid.x2, f["v1"], f["v2"])
    r = np.hypot(grid.x1, grid.x2)
    return Points(r, r, {"v_r": v_r, "v_theta": v_theta, "normal": p_e - f["p"]})


def _differences(grid, values):
    """Central differences along both grid directions: [d/di, d/dj]."""
    along_j, along_i = np.gradient(values, edge_order=2)
    if grid.closed:
        along_i[:, 0] = along_i[:, -1] = 0.5 * (values[:, 1] - values[:, -2])
    return np.array([along_i, along_j])


def _deformation_gradient(grid):
    """F = dx / dx_bar by central differences; NaN beside unused points."""
    f = grid.fields
    dx = np.array([_differences(grid, f[f"x{k}_bar"] + f[f"u{k}"]) for k in (1, 2)])
    d_bar = np.array([_differences(grid, f[f"x{k}_bar"]) for k in (1, 2)])
    inverse = np.linalg.inv(d_bar.transpose(2, 3, 0, 1)).transpose(2, 3, 0, 1)
    return np.einsum("ik...,kj...->ij...", dx, inverse)


def _solid_points(grid):
    f = grid.fields
    v_r, v_theta = _polar(grid.x1, grid.x2, f["v1"], f["v2"])
    normal, shear = _stress_on_circle(_deformation_gradient(grid), _nominal(f), grid.x1, grid.x2)
    return Points(np.hypot(f["x1_bar"], f["x2_bar"]), np.hypot(grid.x1, grid.x2),
                  {"v_r": v_r, "v_theta": v_theta, "normal": normal, "shear": shear})


def _joined(parts):
    """Points of several component grids, without those that have no values."""
    label, r = (np.concatenate([getattr(part, name).ravel() for part in parts]) for name in ("label", "r"))
    values = {key: np.concatenate([part.values[key].ravel() for part in parts]) for key in parts[0].values}
    known = np.isfinite(list(values.values())).all(axis=0)
    return Points(label[known], r[known], {key: column[known] for key, column in values.items()})


# --- what the reference says


def _gas_reference(table, p_e):
    zero = np.zeros_like(table["r"])
    return Points(table["r"], table["r"], {"v_r": table["v"], "v_theta": zero, "normal": p_e - table["p"]})


def _solid_reference(table):
    """The table's axes lie along the ray of the reference disk; a ring's point of that ray is now at q."""
    r, q = table["r_bar"], np.array([table["r_bar"] + table["u1"], table["u2"]])
    slope = np.gradient(q, r, axis=1, edge_order=2)
    ratio = np.where(r > 0, q / np.where(r > 0, r, 1), slope)
    F = np.array([[slope[0], -ratio[1]], [slope[1], ratio[0]]])
    v_r, v_theta = _polar(*q, table["v1"], table["v2"])
    normal, shear = _stress_on_circle(F, _nominal(table), *q)
    return Points(r, np.hypot(*q), {"v_r": v_r, "v_theta": v_theta, "normal": normal, "shear": shear})


# --- pictures


def _draw(values, difference, key, computed, reference, colour):
    """One program in one panel and the panel of differences under it."""
    if key not in computed.values:
        return
    values.plot(computed.r, computed.values[key], ".", color=colour, markersize=2.5, rasterized=True)
    values.plot(reference.r, reference.values[key], color="black", linewidth=0.8)
    exact = np.interp(computed.label, reference.label, reference.values[key])
    difference.plot(computed.r, computed.values[key] - exact, ".", color=colour, markersize=1.5, rasterized=True)


def _picture(gas, solid, t):
    """`gas` and `solid`: (computed, reference) each."""
    figure, axes = pyplot.subplots(4, 2, figsize=(9.6, 8.6), sharex=True, height_ratios=(2, 1.2, 2, 1.2))
    for k, (key, title) in enumerate(PANELS):
        values, difference = axes[2 * (k // 2)][k % 2], axes[2 * (k // 2) + 1][k % 2]
        _draw(values, difference, key, *solid, style.SOLID_LINE)
        _draw(values, difference, key, *gas, style.GAS_LINE)
        values.set_title(title, loc="left")
        difference.set_title("computed - reference", loc="left", fontsize=8)
        difference.yaxis.set_major_locator(MaxNLocator(4))
        difference.axhline(0, color="black", linewidth=0.5)
    axes[0][0].set_xlim(0, gas[1].r[-1])
    for one in axes[-1]:
        one.set_xlabel("distance from the centre")
    handles = [Line2D([], [], color=style.SOLID_LINE, marker=".", linestyle="", label="solid"),
               Line2D([], [], color=style.GAS_LINE, marker=".", linestyle="", label="gas"),
               Line2D([], [], color="black", linewidth=0.8, label="one-dimensional reference")]
    axes[0][0].legend(handles=handles)
    figure.suptitle(f"all grid points, {units.moment(t)}", x=0.01, ha="left", fontsize=10)
    return figure


# --- along y = 0


def _on_axis(grids, x, values_of):
    """{key: values at (x, 0)} of a program; grids that come last win, NaN outside. `values_of`: {key: field} of a grid."""
    found = {}
    for grid in grids:
        cells = mesh.triangles(grid)
        for key, field in values_of(grid).items() if cells else ():
            part = LinearTriInterpolator(cells, np.where(np.isfinite(field), field, 0).ravel())(x, np.zeros_like(x)).filled(np.nan)
            before = found.get(key, np.full_like(x, np.nan))
            found[key] = np.where(np.isnan(part), before, part)
    return found


def _sigma_11(grid):
    """Cauchy stress F P / det F of a solid, component 11; NaN beside unused points."""
    F, P = _deformation_gradient(grid), _nominal(grid.fields)
    return (F[0, 0] * P[0, 0] + F[0, 1] * P[1, 0]) / (F[0, 0] * F[1, 1] - F[0, 1] * F[1, 0])


def _even(points, key):
    """The reference on both sides of the centre: a radial velocity changes its sign there as a horizontal one. That of a gas around a
    disk is broken between."""
    sign, gap = -1 if key == "v_r" else 1, [np.nan] if points.r[0] > 0 else []
    return np.concatenate([-points.r[::-1], gap, points.r]), np.concatenate([sign * points.values[key][::-1], gap, points.values[key]])


def _axis_picture(gas, solid, reference, t, p_e):
    """`gas`, `solid`: grids; `reference`: Points of gas and solid."""
    reach = max(np.abs(grid.x1).max() for grid in gas)
    x = np.linspace(-reach, reach, AXIS_POINTS)
    parts = ((_on_axis(solid, x, lambda grid: {"v_r": grid.fields["v1"], "normal": _sigma_11(grid)}), reference[1], style.SOLID_LINE),
             (_on_axis(gas, x, lambda grid: {"v_r": grid.fields["v1"], "normal": p_e - grid.fields["p"]}), reference[0],
              style.GAS_LINE))
    titles = {"v_r": "horizontal velocity: $\\bar v_1$ of the solid, $v_1$ of the gas",
              "normal": "$\\bar\\sigma_{11}$ of the solid, $p_e - p$ of the gas"}
    figure, axes = pyplot.subplots(1, 2, figsize=(10.4, 3.9))
    for panel, (key, title) in zip(axes, titles.items()):
        for values, exact, colour in parts:
            panel.plot(x, values[key], color=colour, linewidth=1.4)
            panel.plot(*_even(exact, key), color="black", linewidth=0.8, linestyle=(0, (4, 4)))
        panel.set_title(title, loc="left")
        panel.set_xlabel("$x_1$")
        panel.set_xlim(-reach, reach)
    axes[0].legend(handles=[Line2D([], [], color=style.SOLID_LINE, label="solid"), Line2D([], [], color=style.GAS_LINE, label="gas"),
                            Line2D([], [], color="black", linewidth=0.8, linestyle=(0, (4, 4)), label="reference")])
    figure.suptitle(f"along $x_2$ = 0, {units.moment(t)}", x=0.01, ha="left", fontsize=10)
    return figure


def pictures(series, reference):
    """(name, function that draws it) of each output time that the reference holds, but the start, where all is known."""
    gas = data.gas_of(series)
    solid = next((one for one in series if not one.is_gas()), None)
    if not (reference and gas and solid):
        return
    p_e = reference[min(reference)]["gas"]["p"][-1]  # of the gas at rest
    for of_gas, of_solid in zip(gas.outputs, solid.outputs):
        table = next((table for t, table in reference.items() if data.same_time(t, of_gas.t)), None)
        if table is None or of_gas.t == 0:
            continue
        exact = _gas_reference(table["gas"], p_e), _solid_reference(table["solid"])
        points = [_joined([_gas_points(grid, p_e) for grid in of_gas.grids]), _joined([_solid_points(grid) for grid in of_solid.grids])]
        yield f"radius_{of_gas.number:04}", partial(_picture, (points[0], exact[0]), (points[1], exact[1]), of_gas.t)
        yield f"axis_{of_gas.number:04}", partial(_axis_picture, of_gas.grids, of_solid.grids, exact, of_gas.t, p_e)
