"""Studies of supersonic streams for docs/record_results.py: one of Mach 2.5 along a wall that bends by an angle, against the oblique shock or the
expansion of Prandtl and Meyer; bow shocks of cylinders with and without shock viscosity."""

import csv
import math

GAMMA = 1.4
MACH = 2.5
WHERE = 0.7     # x of the points that are looked at; the corner is at 0
LINES = (0, 1, 2, 4)

CASE = """\
parameters: {mach: 2.5, turn: -15, reach: 0, n: 40}    # reach: over which the corner is rounded
definitions: {along: -0.5 + 1.5*r}
grid: {factor: 1}
time: {end: 2}
fluid:
  gamma: 1.4
  p_e: 0
  scheme: {shock_viscosity: 0}
  grid: {kind: mapped, map: [along, "0.5*(along + sqrt(along^2 + reach^2))*tan(turn*pi/180)*(1 - s) + s"], points: [3*n/2 + 1, n + 1]}
  boundary:
    left: {kind: inflow, state: {rho: 1.4, v: [mach, 0], p: 1}}
    right: outflow
    bottom: slip_wall
    top: outflow
  initial: {rho: 1.4, v: [mach, 0], p: 1}
"""

CYLINDER = """\
parameters: {mach: 4, v: mach * sqrt(1.4)}
grid: {factor: 20}
time: {end: 1 / mach}
fluid:
  gamma: 1.4
  p_e: 1
  scheme: {shock_viscosity: 0}
  grid: {name: background, x: [-0.2, 0.3], y: [-0.2, 0.2]}
  boundary:
    left: {kind: far_field, state: {rho: 1, v: [v, 0], p: 1}}
    right: outflow
    bottom: outflow
    top: outflow
  initial: {rho: 1, v: [v, 0], p: 1}
solids:
  body: {law: rigid, rho: 1000, motion: fixed, shape: {kind: circle, radius: 0.05}}
"""


def _written(tools, name, text):
    """The path of a case as commands in the root of the project take it."""
    case = tools.RUNS / name
    case.parent.mkdir(parents=True, exist_ok=True)
    case.write_text(text, encoding="utf-8")
    return str(case.relative_to(tools.ROOT))


def _table(heading, rows):
    return "\n".join(["| " + " | ".join(heading) + " |", "|" + "---|" * len(heading), *("| " + " | ".join(row) + " |" for row in rows)])


def _bisected(f, low, high):
    """The root of a rising function."""
    for _ in range(100):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if f(middle) < 0 else (low, middle)
    return 0.5 * (low + high)


def _turned_by_expansion(angle):
    """(Mach number, pressure over that before)."""
    def prandtl_meyer(M):
        k = math.sqrt((GAMMA + 1) / (GAMMA - 1))
        return k * math.atan(math.sqrt(M * M - 1) / k) - math.atan(math.sqrt(M * M - 1))
    M = _bisected(lambda M: prandtl_meyer(M) - prandtl_meyer(MACH) - angle, 1, 50)
    total = [1 + 0.5 * (GAMMA - 1) * m * m for m in (MACH, M)]
    return M, (total[0] / total[1]) ** (GAMMA / (GAMMA - 1))


def _turned_by_shock(angle):
    def turn(beta):
        s = (MACH * math.sin(beta)) ** 2
        return math.atan(2 / math.tan(beta) * (s - 1) / (MACH * MACH * (GAMMA + math.cos(2 * beta)) + 2))
    beta = _bisected(lambda beta: turn(beta) - angle, math.asin(1 / MACH), math.radians(60))
    s = (MACH * math.sin(beta)) ** 2
    behind = math.sqrt((1 + 0.5 * (GAMMA - 1) * s) / (GAMMA * s - 0.5 * (GAMMA - 1)))
    return behind / math.sin(beta - angle), 1 + 2 * GAMMA / (GAMMA + 1) * (s - 1)


def _corners(tools):
    import amp_fsi
    name, rows, typed = _written(tools, "sharp_corner.yaml", CASE), [], ""
    for turn, reach in ((-15, 0), (-5, 0), (5, 0), (15, 0), (-15, 0.1)):
        angle = math.atan(math.tan(math.radians(abs(turn))) * 0.5 * (1 + WHERE / math.hypot(WHERE, reach)))
        M_exact, p_exact = _turned_by_expansion(angle) if turn < 0 else _turned_by_shock(angle)
        for n in (40, 80, 160):
            directory, _, typed = tools.run_once(f"sharp-corner-{turn}-{reach}-{n}", name, [f"parameters.turn={turn}", f"parameters.reach={reach}", f"parameters.n={n}"])
            gas = next(iter(amp_fsi.open(directory).fields("fluid", t=2).values()))
            column = abs(gas.x1[0] - WHERE).argmin()
            rho, p, v1, v2 = (gas[key][:, column] for key in ("rho", "p", "v1", "v2"))
            mach = ((v1**2 + v2**2) * rho / (GAMMA * p)) ** 0.5
            rows.append([str(turn), str(reach), str(n), *(f"{mach[line] / M_exact:.4f}" for line in LINES), f"{p[0] / p_exact:.4f}"])
    heading = ["wall turns by [degrees]", "rounded over", "cells across", *(f"Mach number on line {line}, of the exact one" for line in LINES), "pressure on the wall, of the exact one"]
    note = (f"Steady flow along a wall that bends at x = 0, at x = {WHERE}; line 0 is the wall. What the corner does to the gas that passes within some cells of it stays on these "
            "lines, whatever their distance: the pressure converges, density, temperature and Mach number on the wall do not, but for a corner that is rounded.\n\n")
    return f"last run: `{typed}` with this file:\n\n```yaml\n{CASE}```\n\n{note}{_table(heading, rows)}\n"


def _drag(directory, mach):
    """(mean, least, largest) drag coefficient of the cylinder in the second half of the run."""
    with open(directory / "forces_body.csv", encoding="utf-8", newline="") as file:
        rows = [{title.split(" ")[0]: float(value) for title, value in row.items()} for row in csv.DictReader(file)]
    late = [(row["force1"] / (0.5 * GAMMA * mach**2 * 0.1), row["t"] - before["t"]) for before, row in zip(rows, rows[1:], strict=False) if row["t"] > 0.5 * rows[-1]["t"]]
    drags = [drag for drag, _ in late]
    return sum(drag * dt for drag, dt in late) / sum(dt for _, dt in late), min(drags), max(drags)


def _cylinders(tools):
    name, rows, typed = _written(tools, "cylinder_in_stream.yaml", CYLINDER), [], ""
    for mach in (1.5, 2, 3, 4, 6, 8, 12):
        for factor in (10, 20, 40):
            for viscosity in ("0", "0.5"):
                directory, _, typed = tools.run_once(f"cylinder-in-stream-{mach}-{factor}-{viscosity}", name, [
                    f"parameters.mach={mach}", f"grid.factor={factor}", f"fluid.scheme.shock_viscosity={viscosity}"])
                summary = tools.summary_of(directory)
                mean, least, most = _drag(directory, mach)
                rows.append([str(mach), str(factor), viscosity, f"{mean:.3f}", f"{least:.3f} to {most:.3f}", f"{summary['disagreement']['value']:.2f}",
                             f"{summary['noise']['value']:.3f}"])
    heading = ["Mach", "cells across", "shock_viscosity", "drag coefficient, mean", "least to largest", "[disagreement](output.md#disagreement)", "[noise](output.md#noise)"]
    note = ("A cylinder of diameter 0.1 put at rest into a stream at t = 0; drag coefficients of the second half of the run. Before the cylinder the bow shock lies along lines of both grids, "
            "[where it beats without viscosity](theory_fluid.md#shocks-along-grid-lines).\n\n")
    return f"last run: `{typed}` with this file:\n\n```yaml\n{CYLINDER}```\n\n{note}{_table(heading, rows)}\n"


def studies(tools):
    yield "Sharp corners in a supersonic stream", lambda: _corners(tools)
    yield "Cylinders in fast streams", lambda: _cylinders(tools)
