"""Studies of the beam for docs/record_results.py: the beams of the paper's section 7, and the solid alone against theory."""

import csv
import json
import sys
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "launch"))

BEAMS = (("100", "100"), ("50", "50"), ("10", "10"), ("1", "10"))
MODES = (0.1657523, 1.0387547)  # omega of a clamped beam in plane strain, thickness 0.1, lambda = mu = rho_bar


def _parameters(beam):
    return [f"parameters.rho_bar={beam[0]}", f"parameters.stiffness={beam[1]}"]


def _table(heading, rows):
    return "\n".join(["| " + " | ".join(heading) + " |", "|" + "---|" * len(heading),
                      *("| " + " | ".join(row) + " |" for row in rows)]) + "\n"


def _run(tools, name, case, settings):
    """(folder, summary, command as typed) of a run."""
    directory, _, typed = tools.run_once(name, case, [*settings, "time.peer_timeout=60"])
    return directory, tools.summary_of(directory), typed.split(" --set time.peer_timeout")[0]


# --- in the gas


def _beams(tools, factor):
    """The four beams: how far they came, at what price, and how good the cells of the gas grid stayed."""
    rows, runs, typed = [], [], ""
    for beam in BEAMS:
        directory, found, typed = _run(tools, f"beam-{factor}-{beam[0]}-{beam[1]}", "beam",
                                       [f"grid.factor={factor}", *_parameters(beam)])
        part = directory / "parts" / "fluid.json"
        gas = json.loads(part.read_text(encoding="utf-8")) if part.is_file() else {}
        parts, steps = found.get("participants", {}), max(found.get("steps", 0), 1)
        runs.append((f"({beam[0]}, {beam[1]})", directory))
        cost = [f"{1e3 * parts[name]['compute_s'] / steps:.2f}" if name in parts else "-"
                for name in ("fluid", "beam", "coupler")]
        rows.append([f"({beam[0]}, {beam[1]})", found.get("status", "-"), f"{found.get('t', 0):g}", str(found.get("steps")),
                     str(parts.get("beam", {}).get("substeps", "-")), *cost, f"{found.get('wall_s', 0):.0f}",
                     tools.shown(tools.value_at(gas, "health.min_cell_quality")),
                     tools.shown(tools.value_at(found, "interface.max_gap")),
                     str(tools.value_at(found, "counters.first_order_fallbacks")),
                     str(tools.value_at(found, "counters.floors"))])
    heading = ["(rho_bar, stiffness)", "status", "t", "steps", "substeps of the solid", "gas [ms/step]", "solid [ms/step]",
               "coupler [ms/step]", "wall time [s]", "worst cell", "gap", "first order", "floors"]
    return f"last row: `{typed}`\n\n" + _table(heading, rows) + "\n" + tools.costs(runs)


# Grids of the beam that are refined as the gas's; the case's own are as fine at j = 8, and not finer before j = 32.
REFINED = ("solids.beam.grid.spacing=0.32 * h", "solids.beam.body_fitted.spacing=0.24 * h",
           "solids.beam.body_fitted.lines=round(0.018 / (0.24 * h)) + 1")


def _order(coarse, fine):
    return f"{np.log2(coarse / fine):.2f}" if coarse > 0 and fine > 0 else "-"


def _centrelines(tools, beam, name="beam", settings=(), factors=(8, 16, 32)):
    """Largest distance between the centrelines of two grids, and the orders it falls with."""
    from fsi_launch.plot.one_run import beams
    from fsi_launch.plot.reading import data
    runs, kept, typed = [], [], ""
    for factor in factors:
        directory, _, typed = _run(tools, f"{name}-{factor}-{beam[0]}-{beam[1]}", "beam",
                                   [f"grid.factor={factor}", *_parameters(beam), *settings])
        kept.append((f"j = {factor}", directory))
        runs.append(beams.run_of(data.all_series(directory), (directory / "case.yaml").read_text(encoding="utf-8")))
    pairs = [beams.distances(coarse.beams[0], fine.beams[0]) for coarse, fine in zip(runs, runs[1:])]
    ends = runs[-1].beams[0].lines
    rows = [[f"{t:g}", *(f"{pair[t]:.1e}" for pair in pairs), *(_order(a[t], b[t]) for a, b in zip(pairs, pairs[1:])),
             f"({ends[t][-1][0]:.3f}, {ends[t][-1][1]:.3f})"]
            for t in sorted(ends) if t > 0 and all(t in pair for pair in pairs)]
    heading = ["t", *(f"j = {a} against {b}" for a, b in zip(factors, factors[1:])), *["order"] * (len(pairs) - 1),
               f"the end of the beam, j = {factors[-1]}"]
    return f"`{typed}`\n\n" + _table(heading, rows) + ("" if settings else "\n" + tools.costs(kept))


# --- alone


def _probe(directory, name):
    """(t, values) of a column of probes.csv whose heading begins with `name`."""
    with open(directory / "probes.csv", encoding="utf-8", newline="") as file:
        heading, *rows = csv.reader(file)
    column = next(k for k, title in enumerate(heading) if title.startswith(name))
    return np.array([[float(row[0]), float(row[column])] for row in rows]).T


def _frequencies(t, u):
    """The two angular frequencies of u = sum of two swings, by Gauss-Newton from those of beam theory."""
    def misfit(omega):
        columns = np.column_stack([f(w * t) for w in omega for f in (np.sin, np.cos)])
        return columns @ np.linalg.lstsq(columns, u, rcond=None)[0] - u

    omega, small = np.array(MODES), 1e-6
    for _ in range(20):
        here = misfit(omega)
        slope = np.column_stack([(misfit(omega + small * e) - here) / small for e in np.eye(2)])
        omega = omega - np.linalg.lstsq(slope, here, rcond=None)[0]
    return omega


def _timoshenko(directory):
    """The same of a Timoshenko beam with the outline's own thickness: linear elements, reduced integration of shear."""
    from fsi_launch.plot.reading import data
    outline = [grid for one in data.all_series(directory) for grid in one.outputs[0].grids if not grid.is_cartesian()][0]
    x, y = outline.fields["x1_bar"][0], outline.fields["x2_bar"][0]
    half = [(y[side][np.argsort(y[side])], np.abs(x[side])[np.argsort(y[side])]) for side in (x > 0, x < 0)]
    nodes = np.linspace(0, y.max(), 301)
    length, middle = np.diff(nodes), 0.5 * (nodes[1:] + nodes[:-1])
    width = sum(np.interp(middle, *side) for side in half)
    size = 2 * len(nodes)
    K, M = np.zeros((size, size)), np.zeros((size, size))
    for k, (l, b) in enumerate(zip(length, width)):
        at = np.ix_(range(2 * k, 2 * k + 4), range(2 * k, 2 * k + 4))  # deflection and angle of both ends
        shear, bend = np.array([-1 / l, -0.5, 1 / l, -0.5]), np.array([0, -1 / l, 0, 1 / l])
        K[at] += l * (5 / 6 * b * np.outer(shear, shear) + 8 / 3 * b**3 / 12 * np.outer(bend, bend))
        M[at] += l / 6 * np.kron([[2, 1], [1, 2]], np.diag([b, b**3 / 12]))
    squares = np.linalg.eigvals(np.linalg.solve(M[2:, 2:], K[2:, 2:])).real
    return np.sqrt(np.sort(squares)[:2])


def _swings(tools):
    rows, typed, theory = [], "", (0, 0)
    for factor in (8, 16, 32):
        directory, found, typed = _run(tools, f"clamped-beam-{factor}", "clamped_beam",
                                       [f"grid.factor={factor}", "time.end=20"])
        omega = _frequencies(*_probe(directory, "tip.u1"))
        theory = _timoshenko(directory)
        energy = found["conservation"]["beam"]
        rows.append([f"j = {factor}", *(f"{w:.5f}" for w in omega), f"{energy['energy'] / energy['energy_initial']:.1e}"])
    rows.append(["Timoshenko beam of the same outline", *(f"{w:.5f}" for w in theory), ""])
    rows.append(["Euler-Bernoulli beam of length 1", *(f"{w:.5f}" for w in MODES), ""])
    return f"last run: `{typed}`\n\n" + _table(["", "omega_1", "omega_2", "energy drift until t = 20"], rows)


def _limiters(tools):
    """What each limiter of a solid costs where nothing jumps: frequencies of a clamped beam, and what a free block of 10 x 10 cells gains in a turn."""
    rows, typed = [], []
    for limiter in ("none", "mc", "minmod"):
        swung, _, first = _run(tools, f"limiters-beam-{limiter}", "clamped_beam",
                               ["grid.factor=8", "time.end=20", f"solids.beam.scheme.limiter={limiter}"])
        omega = _frequencies(*_probe(swung, "tip.u1"))
        _, found, second = _run(tools, f"limiters-block-{limiter}", "spinning_block",
                                ["grid.factor=1", "parameters.omega=2", "parameters.stiffness=8", "expect={}",
                                 f"solids.block.scheme.limiter={limiter}"])
        gained = found["conservation"]["block"]
        rows.append([f"`{limiter}`", *(f"{w:.5f}" for w in omega),
                     *(f"{100 * gained[key] / gained[f'{key}_initial']:.2f} %" for key in ("angular_momentum", "energy"))])
        typed = [first, second]
    heading = ["limiter", "omega_1 of the beam", "omega_2", "angular momentum that the block gains in a turn", "energy"]
    return "last row: " + " and ".join(f"`{one}`" for one in typed) + "\n\n" + _table(heading, rows)


def _elastica(alpha):
    """Deflection (across, along) of the end of the elastica under the load alpha E' I / L^2, over L, by shooting."""
    def shoot(curvature, steps=2000):
        theta, end, ds = 0.0, np.array([0.0, -1.0]), 1 / steps
        for _ in range(steps):
            half = theta + 0.5 * ds * curvature
            theta += ds * (curvature - 0.5 * ds * alpha * np.cos(theta))
            curvature -= ds * alpha * np.cos(half)
            end += ds * np.array([np.sin(half), np.cos(half)])
        return curvature, end

    low, high = 0.0, alpha
    for _ in range(40):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if shoot(middle)[0] < 0 else (low, middle)
    return shoot(low)[1]


def _middle(t, u, grown=75.8):
    """Middle of the small swing that is left when the load has grown; a large load changes the period it has to fit."""
    rest = u[t >= grown]
    return 0.5 * (rest.max() + rest.min())


def _loads(tools):
    length, bending, rows, typed = 0.9, 8 / 3 * 1e-3 / 12, [], ""  # the load's arm; E' I over mu
    for load in ("0.01", "0.5", "2"):
        directory, _, typed = _run(tools, f"clamped-beam-load-{load}", "clamped_beam",
                                   ["parameters.swing_1=0", "parameters.swing_2=0", f"parameters.load={load}", "time.end=118"])
        u = [_middle(*_probe(directory, f"loaded.u{k}")) for k in (1, 2)]
        alpha = float(load) * length**2
        bent = length * _elastica(alpha)
        sheared = float(load) * bending * length / (5 / 6 * 0.1)
        rows.append([load, f"{u[0]:.5f}", f"{u[1]:.5f}", f"{bent[0]:.5f}", f"{bent[1]:.5f}", f"{sheared:.5f}"])
    heading = ["load over E' I / L^2", "u_1 where it acts", "u_2", "elastica u_1", "elastica u_2", "shear adds to u_1"]
    return f"last row: `{typed}`\n\n" + _table(heading, rows)


VARIANTS = (("twice as thick", ["parameters.thickness=0.2"]), ("half as high", ["parameters.height=0.5"]),
            ("Mach 1.3", ["parameters.mach=1.3"]), ("Mach 1.2, softer", ["parameters.mach=1.2", *_parameters(("10", "10"))]),
            ("Mach 1.3, softer", ["parameters.mach=1.3", *_parameters(("10", "10"))]),
            ("Mach 1.3, softer, with the limiter that the message names",
             ["parameters.mach=1.3", *_parameters(("10", "10")), "solids.beam.scheme.limiter=minmod"]))


def _variants(tools):
    """What a user may change by YAML alone: how far each comes, and why it ends."""
    rows, typed = [], ""
    for index, (label, settings) in enumerate(VARIANTS):
        _, found, typed = _run(tools, f"beam-variant-{index}", "beam", settings)
        rows.append([label, found.get("status", "-"), f"{found.get('t', 0):g}", found.get("reason", "")])
    return f"last row: `{typed}`\n\n" + _table(["", "status", "t", "reason"], rows)


def studies(tools):
    """(title, function) of each study; `tools`: the functions of record_results."""
    yield "Beam: the four of the paper, h = 1/160", lambda: _beams(tools, 16)
    for beam, factors in ((("100", "100"), (8, 16, 32, 64)), (("10", "10"), (8, 16, 32))):
        yield (f"Beam ({beam[0]}, {beam[1]}): largest distance between the centrelines of two grids",
               lambda b=beam, f=factors: _centrelines(tools, b, factors=f))
        yield (f"Beam ({beam[0]}, {beam[1]}): centrelines, grids of the beam as fine as the gas's",
               lambda b=beam: _centrelines(tools, b, "fine-beam", REFINED))
    yield "Beam: variants, h = 1/80", lambda: _variants(tools)
    yield "Clamped beam alone: frequencies of its first two bending modes", lambda: _swings(tools)
    yield "Limiters of a solid where nothing jumps", lambda: _limiters(tools)
    yield "Clamped beam alone: deflection under an end load, h = 1/80", lambda: _loads(tools)
