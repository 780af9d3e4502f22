"""Studies of walls for docs/record_results.py: between two gases, against exact solutions in the limit of small pulses, and the corners of one
that a gust pushes."""

import csv
import math
import re

CASES = (("speeds of sound 1 and 2.04", []),
         ("a heavy gas on the right", ["parameters.rho_right=5", "parameters.gamma_right=1.2"]))
DENSITIES = ("0.02", "2", "200")
MASSES = ("0", "1e-3", "1e-2", "0.1", "1", "10", "1e3")
LEVELS = "8,16,32"
PULSE = 1e-6    # the size of the pulse in the cases


def _table(heading, rows):
    return "\n".join(["| " + " | ".join(heading) + " |", "|" + "---|" * len(heading),
                      *("| " + " | ".join(row) + " |" for row in rows)]) + "\n"


def _pistons(tools):
    variants = [(f"{label}, density {density} of the piston", [*settings, f"parameters.density={density}"], [])
                for label, settings in CASES for density in DENSITIES]
    return tools.rates("piston-between-gases", "piston_between_gases", LEVELS, variants, ("rho", "v1", "u_bar", "v_bar", "P_bar"))


def _bars(tools):
    variants = [(f"{label}, density {density} of the bar", [*settings, f"parameters.density={density}", "reference.c_p=c_p * sqrt(8 / 9)"],
                 ["piston=beam"]) for label, settings in CASES for density in DENSITIES]
    note = ("The same piston as a beam that lies along the duct, whose sides bear no stress: its waves run at sqrt(E'/rho), with "
            "E' = 8/9 (lambda + 2 mu) for lambda = mu.\n\n")
    return note + tools.rates("bar-between-gases", "piston_between_gases", LEVELS, variants, ("rho", "v1"))


def _clamped_bars(tools):
    variants = [(f"density {density} of the bar", [f"parameters.density={density}"], []) for density in DENSITIES]
    continuum = [(f"density {density} of a continuum, its sides held", ["parameters.part=1/3", f"parameters.density={density}"], ["bar=linear_elastic"])
                 for density in DENSITIES]
    note = ("The bar lies along the duct and its far end does not move: v = f(t - x/c) + g(t + x/c) with f + g = 0 there and "
            "f(t) = 2 P(t) / (z_s + z) - r f(t - 2 l/c), r = (z_s - z) / (z_s + z), at the gas. The speed of its waves is that of the gas times 1.3, so the impedances are as 1.86 "
            "to 1 where the density is 2.\n\n")
    return note + tools.rates("clamped-bar", "clamped_bar", LEVELS, continuum + variants, ("rho", "v1"))


def _plates(tools):
    variants = [(f"m = {mass}", [f"parameters.mass={mass}"], []) for mass in MASSES]
    return tools.rates("taylor-plate", "taylor_plate", LEVELS, variants, ("rho", "v1"))


def _free_plates(tools):
    variants = [(f"m = {mass}", [f"parameters.mass={mass}", "solids.plate.beam.ends=[free, free]"], []) for mass in MASSES if mass != "0"]
    return tools.rates("taylor-plate-free", "taylor_plate", LEVELS, variants, ("rho", "v1"))


def _columns(directory, *names):
    """Columns of the plate's table whose titles begin so."""
    with open(directory / "forces_plate.csv", encoding="utf-8", newline="") as file:
        heading, *rows = csv.reader(file)
    places = [next(k for k, title in enumerate(heading) if title.startswith(name)) for name in names]
    return [[float(row[k]) for row in rows] for k in places]


def _largest(directory, begin, end):
    """Largest speed of the plate between two times."""
    return max((abs(v) for t, v in zip(*_columns(directory, "t ", "velocity1")) if begin <= t < end), default=math.nan)


def _growth(tools):
    """Whether anything grows when the pulse is gone: largest speed of the plate over its largest in the pulse."""
    rows, typed = [], ""
    for mass in MASSES[:-2]:
        settings = ["time.end=12", "output.times=[12]", f"parameters.mass={mass}", "fluids.left.boundary.left=outflow",
                    "fluids.right.boundary.right=outflow", "expect={status: completed}"]
        directory, _, typed = tools.run_once(f"taylor-growth-{mass}", "taylor_plate", settings)
        most = _largest(directory, 0, 1.5)
        rows.append([mass, f"{most / PULSE:.3f}", *(f"{_largest(directory, a, b) / most:.1e}" for a, b in ((3, 6), (6, 9), (9, 12)))])
    note = ("What is left is round-off: the pulse is 1e-6 of the pressure, so that 1e-7 of it is some 1e-13 of the speed of sound. (m = 1 has a "
            "memory of m / (z_1 + z_2) = 0.45, which is its 6.6e-03.)")
    return f"last row: `{typed}`\n\n{note}\n\n" + _table(["m", "largest v over the size of the pulse", "t in 3 .. 6", "6 .. 9", "9 .. 12"], rows)


STEP_AT, STEP_SEEN = 0.1, 0.2   # when the step is at the plate, and when its smeared front has passed


def _steps(tools):
    """A step of pressure p_0 that sets in within a few cells: v = 2 p_0 / z (1 - exp(-z (t - 0.1) / m)), z = z_1 + z_2."""
    z, wave, rows, typed = 1.4 + math.sqrt(5 / 3 * 0.4), f"{PULSE / 2:g} * ((x < -{STEP_AT} - h / 2 ? 1 : 0) + (x < -{STEP_AT} + h / 2 ? 1 : 0))", [], ""
    for mass in ("0", "0.05", "0.5", "5"):
        errors = []
        for factor in (8, 16, 32):
            settings = ["time.end=1", "output.times=[1]", f"grid.factor={factor}", f"parameters.mass={mass}", "reference={kind: none}", "expect={}",
                        f"fluids.left.initial={{rho: '1.4 * (1 + {wave} / 1.4)', v: ['{wave} / 1.4', 0], p: '1 + {wave}'}}",
                        "fluids.right.initial={rho: 0.4, v: [0, 0], p: 1}", "fluids.left.boundary.left=outflow",
                        "fluids.right.boundary.right=outflow", "fluids.left.scheme={limiter: minmod}"]
            directory, _, typed = tools.run_once(f"taylor-step-{mass}-{factor}", "taylor_plate", settings)
            last, m = 2 * PULSE / z, float(mass)
            errors.append(max(abs(v / last - 1 + (math.exp(-z * (t - STEP_AT) / m) if m else 0))
                              for t, v in zip(*_columns(directory, "t ", "velocity1")) if t >= STEP_SEEN))
        rows.append([mass, *(f"{error:.1e}" for error in errors), f"{math.log2(errors[1] / errors[2]):.2f}"])
    note = (f"A step of 1e-6 of the pressure is at the plate at t = {STEP_AT}; largest error of the velocity from t = {STEP_SEEN} to 1, over 2 p_0 / (z_1 + z_2). "
            "The point of the gas in which the step lies has half of it: else the step would come half a cell late. The front of a step is smeared over a width that falls about with h^(2/3), "
            "and what passes through it is wrong by about the square of that.")
    return f"last run: `{typed}`\n\n{note}\n\n" + _table(["m", "h = 1/80", "h = 1/160", "h = 1/320", "rate"], rows)


PANEL = """\
grid: {factor: 4}
time: {end: 3}
fluid:
  gamma: 1.4
  p_e: 1
  grid: {x: [-1.5, 0.3], y: [0, 1]}
  body_fitted:
    - {name: strip, solid: panel, walls: [bottom, top], lines: 8}
  boundary: {left: outflow, right: outflow, bottom: slip_wall, top: slip_wall}
  initial: {rho: "1.4 * (x < -0.6 ? 1.2 : 1)", v: [0, 0], p: "x < -0.6 ? 1.3 : 1"}
solids:
  panel:
    law: neo_hookean
    rho: 0.1
    lambda: 4
    mu: 2
    grid: {x: [0, 0.5], y: [0, 1], spacing: h}
    boundary: {left: interface, right: free, bottom: clamped, top: clamped}
output: {times: [3]}
"""


def _held_corners(tools):
    """Largest speeds at the end of a gust, within six points of each corner and at half of the height."""
    import amp_fsi
    import numpy
    case, rows, typed = tools.RUNS / "panel_in_gust.yaml", [], ""
    case.parent.mkdir(parents=True, exist_ok=True)
    case.write_text(PANEL, encoding="utf-8")
    for damping in ("{scaled: 0.5}", "{scaled: 0.2}", "{scaled: 0.1}", "{rate: 0.5, scaled: 0.05}", "{rate: 0.5}"):
        for factor in (4, 8, 16):
            directory, code, typed = tools.run_once(f"panel-in-gust-{factor}-{re.sub('[^0-9a-z.]+', '-', damping).strip('-')}", str(case.relative_to(tools.ROOT)), [
                f"grid.factor={factor}", f"solids.panel.scheme.displacement={damping}"])
            if code != 0:
                rows.append([damping, f"1/{10 * factor}", *["failed"] * 4, "-"])
                continue
            panel = next(iter(amp_fsi.open(directory).fields("panel", t=3).values())).fields
            speed, half = numpy.hypot(panel["v1"], panel["v2"]), panel["u1"].shape[0] // 2
            rows.append([damping, f"1/{10 * factor}", *(f"{speed[[*range(6), *range(-6, 0)]][:, columns].max():.3f}" for columns in (slice(-6, None), slice(6))),
                         f"{speed[half].max():.3f}", f"{panel['u1'][half, -1]:.4f}", f"{tools.summary_of(directory)['noise']['value']:.3f}"])
    note = ("A panel of rubber, held below and above, that a gust has pushed and that comes to rest: why its points do not have the velocity that they move with beside a corner of a held "
            "and a free side is in [the theory](theory_solid.md#stability-of-waves-with-relaxation).\n\n")
    heading = ["`displacement`", "h", "largest speed beside held and free", "beside held and gas", "at half of the height", "u1 of the free side's middle", "[noise](output.md#noise)"]
    return f"last run: `{typed}` with this file:\n\n```yaml\n{PANEL}```\n\n{note}{_table(heading, rows)}\n"


def studies(tools):
    """(title, function) of each study; `tools`: the functions of record_results."""
    yield "Elastic piston between two gases, small pulse", lambda: _pistons(tools)
    yield "Bar between two gases, small pulse", lambda: _bars(tools)
    yield "Bar clamped at its far end, small pulse", lambda: _clamped_bars(tools)
    yield "Taylor's plate between two gases, any mass", lambda: _plates(tools)
    yield "Taylor's plate between two gases, its ends free", lambda: _free_plates(tools)
    yield "Taylor's plate between two gases, a small step of pressure", lambda: _steps(tools)
    yield "Taylor's plate between two gases: what is left when the pulse is gone", lambda: _growth(tools)
    yield "Corners of a held and a free side: velocity beside them", lambda: _held_corners(tools)
