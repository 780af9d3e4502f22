"""Studies of thin and stiff bodies for docs/record_results.py: the shocked panel from grid to grid, the beams of the paper as beams by
law beside the continuum, and solids that can hardly change their volume."""

import csv
import subprocess
import sys
import tempfile
from pathlib import Path
from xml.etree import ElementTree

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "launch"))

# --- the shocked panel, on a floor and on its step: factor of the grid, h [mm]
PANELS = (("0.1", "1"), ("0.2", "0.5"), ("0.4", "0.25"))
ON_STEP = PANELS[:2]
TIMES = (0.25, 0.5, 1, 1.5)
PUBLISHED = (0.303, 1.811, 4.947, 5.335)   # tip [mm] at these times; E. Giordano et al., Shock Waves 14 (2005), fine computation
HIGHEST = (5.845, 1.291)                   # largest [mm], when [ms]
MEASURED = (6.2, 0.4)                      # largest in the experiment, its uncertainty [mm]
FIGURES = Path(__file__).resolve().parent / "figures"

BEAMS = (("100", "100"), ("50", "50"), ("10", "10"), ("1", "10"))


def _table(heading, rows):
    return "\n".join(["| " + " | ".join(heading) + " |", "|" + "---|" * len(heading),
                      *("| " + " | ".join(row) + " |" for row in rows)]) + "\n"


def _tip(directory):
    """(t [ms], deflection of the tip [mm])"""
    with open(directory / "probes.csv", encoding="utf-8", newline="") as file:
        heading, *rows = csv.reader(file)
    column = next(k for k, title in enumerate(heading) if title.startswith("tip.u1"))
    return np.array([[float(row[0]), float(row[column])] for row in rows]).T


def _draw(curves, name):
    from fsi_launch.plot.look import style
    from matplotlib import pyplot
    style.use()
    figure, axes = pyplot.subplots(figsize=(6.4, 3.6))
    for (h, (t, u)), line in zip(reversed(curves), ("-", "--", (0, (1, 1)))):
        axes.plot(t, u, linestyle=line, linewidth=1.1, label=f"h = {h} mm")
    axes.plot([*TIMES, HIGHEST[1]], [*PUBLISHED, HIGHEST[0]], "o", color="black", markerfacecolor="none", label="fine computation, published")
    axes.axhspan(MEASURED[0] - MEASURED[1], MEASURED[0] + MEASURED[1], color="0.88", label="largest, measured", zorder=0)
    axes.set(xlabel="t [ms]", ylabel="deflection of the tip [mm]", xlim=(0, 1.55), ylim=(0, None))
    axes.legend()
    style.save(figure, FIGURES / f"{name}.png")


def _panels(tools, case, grids):
    rows, curves, typed = [], [], ""
    for factor, h in grids:
        directory, _, typed = tools.run_once(f"{case.replace('_', '-')}-{factor}", case, [f"grid.factor={factor}"])
        found = tools.summary_of(directory)
        t, u = _tip(directory)
        curves.append((h, (t, u)))
        rows.append([f"h = {h} mm", *(f"{np.interp(time, t, u):.3f}" for time in TIMES), f"{u.max():.3f} at {t[u.argmax()]:.3f}",
                     str(found.get("steps")), str(tools.value_at(found, "counters.floors")),
                     str(tools.value_at(found, "counters.first_order_fallbacks")), f"{found['wall_s']:.0f}"])
    rows.append(["published computation", *(f"{one:.3f}" for one in PUBLISHED), f"{HIGHEST[0]:.3f} at {HIGHEST[1]:.3f}", "", "", "", ""])
    rows.append(["measured", *[""] * len(TIMES), f"{MEASURED[0]} +- {MEASURED[1]}", "", "", "", ""])
    _draw(curves, case)
    heading = ["tip [mm] at t [ms]", *(f"{time:g}" for time in TIMES), "largest", "steps", "floors", "first order", "wall [s]"]
    return f"last run: `{typed}`\n\n{_table(heading, rows)}\n![deflection of the tip](figures/{case}.png)\n"


# --- the beam alone
MECHANICS = ["build/release/bin/test_beam_mechanics", "--gtest_filter=BeamModel.*:BeamMotion.*"]


def _mechanics():
    """What the tests of the beam's mechanics note of themselves: relative errors, and orders where two resolutions are compared."""
    with tempfile.TemporaryDirectory() as scratch:
        file = Path(scratch) / "found.xml"
        subprocess.run([*MECHANICS, f"--gtest_output=xml:{file}"], cwd=Path(__file__).resolve().parent.parent, check=True,
                       stdout=subprocess.DEVNULL)
        notes = [(one.get("name"), *one.get("value").split()) for one in ElementTree.parse(file).iter("property")]
    return f"`{MECHANICS[0]} '{MECHANICS[1]}'`\n\n{_table(['', 'relative error', 'order'], notes)}"


def _lines(directory):
    from fsi_launch.plot.one_run import beams
    from fsi_launch.plot.reading import data
    return beams.run_of(data.all_series(directory), (directory / "case.yaml").read_text(encoding="utf-8")).beams[0]


def _beside(tools):
    """The paper's beams as continuum and by law: how far apart they come, where they end, and the substeps of the solid."""
    from fsi_launch.plot.one_run import beams
    rows, typed, folders = [], "", []
    for beam in BEAMS:
        settings = [f"parameters.rho_bar={beam[0]}", f"parameters.stiffness={beam[1]}"]
        pair = []
        for law, solids in (("continuum", []), ("law", ["beam=beam"])):
            directory, _, typed = tools.run_once(f"beam-{law}-8-{beam[0]}-{beam[1]}", "beam", settings, solids)
            pair.append((directory, tools.summary_of(directory)))
        folders.append([directory for directory, _ in pair])
        lines = [_lines(directory) for directory, _ in pair]
        apart = beams.distances(*lines)
        last = max(apart)
        ends = [f"({one.lines[last][-1][0]:.3f}, {one.lines[last][-1][1]:.3f})" for one in lines]
        substeps = [f"{found['participants']['beam']['substeps'] / found['steps']:.1f}" for _, found in pair]
        rows.append([f"({beam[0]}, {beam[1]})", *(f"{apart[t]:.1e}" if t in apart else "-" for t in (1, 2, 3, 4, 5, 6, 7, 10, 14)),
                     *ends, *substeps])
    heading = ["(rho_bar, stiffness)", *(f"t = {t}" for t in (1, 2, 3, 4, 5, 6, 7, 10, 14)), "end of the continuum", "end of the beam by law",
               "substeps of the continuum in a step", "of the law"]
    return (f"last run: `{typed}`; the continuum without `--solid beam=beam`\n\nLargest distance of the two centrelines, where the end is at last, "
            f"and how often the solid steps:\n\n{_table(heading, rows)}")


# --- nearly incompressible: areas keep their size to first order, whatever lambda
SOLENOIDAL = ("reference.u=[beat * sin(k * x) * cos(k * (y - 0.4) / 2), -2 * beat * cos(k * x) * sin(k * (y - 0.4) / 2)]")
STIFF = ["parameters.amplitude=0.02", "solids.solid.lambda=100", SOLENOIDAL, "expect={status: completed}"]


def _sides(kind):
    return [f"solids.solid.boundary.{side}={kind}" for side in ("left", "right", "bottom", "top")]


def _incompressible(tools):
    variants = [("neo_hookean, given displacement", [*STIFF, *_sides("displacement")], []),
                ("mooney_rivlin, given displacement", [*STIFF, "solids.solid.c01=0.3", *_sides("displacement")], ["solid=mooney_rivlin"]),
                ("gent, given displacement", [*STIFF, "solids.solid.J_m=8", *_sides("displacement")], ["solid=gent"]),
                ("neo_hookean, loads on a rectangle, no relaxation",
                 [*STIFF, *_sides("traction"), "parameters.waist=0", "solids.solid.scheme.relaxation.scaled=0"], []),
                ("neo_hookean, loads on a rectangle", [*STIFF, *_sides("traction"), "parameters.waist=0"], [])]
    return tools.rates("nearly-incompressible", "solid_manufactured", "1,2,4", variants, ("u_bar", "v_bar", "P_bar"))


def studies(tools):
    """(title, function) of each study; `tools`: the functions of record_results."""
    yield "Beam by law, alone", _mechanics
    yield "Shocked panel, from grid to grid", lambda: _panels(tools, "shocked_panel", PANELS)
    yield "Shocked panel on its step", lambda: _panels(tools, "shocked_panel_on_step", ON_STEP)
    yield "Beams by law beside the continuum, h = 1/80", lambda: _beside(tools)
    yield "Solid: nearly incompressible, lambda / mu = 100", lambda: _incompressible(tools)
