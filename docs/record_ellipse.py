"""The studies of record_results.py about the shock and the ellipse: laws, grids, symmetries, stabilisation, budgets."""

import csv
import math

CASE = "shock_ellipse"
LAWS = ("neo_hookean", "linear_elastic", "rigid")
SCHEME = "solids.ellipse.scheme"
STABILISATION = {"tangential_stress": 0.5, "displacement": 0.5, "relaxation": 0.2}  # as in configs/shock_ellipse.yaml
POSE = ("centre1", "centre2", "velocity1", "velocity2", "angle")
COUNTS = ("steps", "participants.ellipse.substeps", "interface.max_gap", "counters.first_order_fallbacks",
          "counters.first_order_fallbacks_outside_shocks", "counters.floors", "conservation.fluid.mass_defect", "status")
ROUND_OFF_GROWN = 1e-9  # larger differences come from a decision that fell otherwise

# The set-up of configs/shock_ellipse.yaml rotated by 90 degrees about the origin: (x, y) -> (-y, x).
TURNED = ["fluid.grid.x=[-4, 4]", "fluid.grid.y=[-4, 5]", "fluid.boundary.left=outflow", "fluid.boundary.right=outflow",
          "fluid.boundary.bottom={kind: inflow, state: {rho: rho_1, v: [0, v_1], p: p_1}}", "fluid.boundary.top=outflow",
          "definitions.behind=min(1, max(0, 0.5 + (x_shock - y) / h))", "fluid.initial.v=[0, v_1 * behind]",
          "solids.ellipse.shape.centre=[0, -1]", "parameters.angle=45", "solids.ellipse.grid.x=[-1.75, 1.75]",
          "solids.ellipse.grid.y=[-2.75, 0.75]"]


def table_of(directory, solid="ellipse"):
    """[{column: value}] of a solid's table."""
    path = directory / f"forces_{solid}.csv"
    if not path.is_file():
        return []
    with open(path, encoding="utf-8", newline="") as file:
        return [{key.split(" ")[0]: float(value) for key, value in row.items()} for row in csv.DictReader(file)]


def bodies(tools, name, variants, settings):
    """Where the body is at the end of each variant, how far from the first one's, and what the run counted."""
    heading = ["", *POSE, "centre from first", "angle from first", *(path.rsplit(".", 1)[-1] for path in COUNTS)]
    lines = ["| " + " | ".join(heading) + " |", "|" + "---|" * len(heading)]
    first, typed = None, ""
    for index, (label, extra, solids) in enumerate(variants):
        directory, _, typed = tools.run_once(f"{name}-{index}", CASE, [*settings, *extra], solids)
        end = (table_of(directory) or [dict.fromkeys(POSE, math.nan)])[-1]
        first = first or end
        apart = math.hypot(end["centre1"] - first["centre1"], end["centre2"] - first["centre2"])
        summary = tools.summary_of(directory)
        cells = [*(f"{end[column]:.4f}" for column in POSE), f"{apart:.1e}", f"{abs(end['angle'] - first['angle']):.1e}",
                 *(tools.shown(tools.value_at(summary, path)) for path in COUNTS)]
        lines.append("| " + " | ".join([label, *cells]) + " |")
    return f"last row: `{typed}`\n\n" + "\n".join(lines) + "\n"


def budget(tools, directories):
    """What the totals of gas and solid are off by at the end of runs on finer and finer grids."""
    lines = []
    for directory in directories:
        found = tools.summary_of(directory).get("conservation", {})
        defects = {f"{part} {key.removesuffix('_defect')}": value for part, values in sorted(found.items())
                   for key, value in values.items() if key.endswith("_defect")}
        if not lines:
            lines = ["| | " + " | ".join(defects) + " |", "|" + "---|" * (len(defects) + 1)]
        lines.append(f"| {directory.name} | " + " | ".join(f"{value:.1e}" for value in defects.values()) + " |")
    return "Change of the totals less what came in over the boundary and the interface:\n\n" + "\n".join(lines) + "\n"


def rigid_budget(tools, left):
    """The same with a rigid ellipse to t = 2, with the inflow side at x = `left`: at -3 what the body sends back comes there."""
    settings = ["time.end=2", "output.times=[2]", f"fluid.grid.x=[{left}, 5]"]
    runs = [tools.run_once(f"rigid-budget{left}-{j}", CASE, [f"grid.factor={j}", *settings], ["ellipse=rigid"]) for j in (2, 4, 8)]
    return f"last row: `{runs[-1][2]}`\n\n" + budget(tools, [directory for directory, _, _ in runs])


def symmetry(tools, factor):
    """The same problem mirrored at y = 0 and rotated by 90 degrees, against itself."""
    back = {"mirrored": (["parameters.angle=45"],
                         lambda r: (r["centre1"], -r["centre2"], r["velocity1"], -r["velocity2"], -r["angle"])),
            "turned": (TURNED, lambda r: (r["centre2"], -r["centre1"], r["velocity2"], -r["velocity1"], r["angle"]))}

    def rows_of(name, settings, pose):
        directory, _, _ = tools.run_once(f"ellipse-{name}", CASE, [f"grid.factor={factor}", *settings])
        return [pose(row) for row in table_of(directory)]

    plain = rows_of("plain", [], lambda row: tuple(row[column] for column in POSE))
    lines = [f"| | after 100 steps | first step above {ROUND_OFF_GROWN:g} | at the end | steps |", "|---|---|---|---|---|"]
    for name, (settings, undo) in back.items():
        rows = rows_of(name, settings, undo)
        apart = [max(abs(a - b) for a, b in zip(one, other)) for one, other in zip(plain, rows)]
        first = next((step for step, value in enumerate(apart) if value > ROUND_OFF_GROWN), None)
        end = max(abs(a - b) for a, b in zip(plain[-1], rows[-1]))
        lines.append(f"| {name} | {apart[min(100, len(apart) - 1)]:.1e} | {'none' if first is None else first} | {end:.1e} | "
                     f"{len(plain) - 1}, {len(rows) - 1} |")
    return "Largest difference of centre, velocity and angle, turned back:\n\n" + "\n".join(lines) + "\n"


def parts(tools):
    """What the runs of the studies from grid to grid cost."""
    runs = [(f"{law}, h = 1/{10 * j}", tools.RUNS / f"ellipse-{law}" / f"level_{j}") for law in LAWS for j in (8, 16)]
    return "The runs from grid to grid, see there.\n\n" + tools.costs(runs)


def variants():
    """{title: runs as (label, settings, solids)} of the studies at one resolution."""
    half = {key: f"{SCHEME}.{key}.scaled={0.5 * value:g}" for key, value in STABILISATION.items()}
    return {
        "stiffer and stiffer": [*((f"lambda = mu = {k}", [f"parameters.stiffness={k}"], []) for k in (4, 40, 400)),
                                ("rigid", [], ["ellipse=rigid"])],
        "light bodies": [(f"{law}, rho_bar = {rho}", [f"parameters.rho_bar={rho}"], [f"ellipse={law}"])
                         for law in ("neo_hookean", "rigid") for rho in ("0.1", "0.01", "0.001")],
        "projections": [(name, [f"interface.projection={name}"], []) for name in ("simplified", "full")],
        "multirate": [(f"multirate {word}", [f"time.multirate={word}"], []) for word in ("true", "false")],
        "stabilisation": [("as it is", [], []), *((f"half of {key}", [text], []) for key, text in half.items()),
                          ("half of all", list(half.values()), [])],
        "left boundary": [(f"{kind}, x = {x}", [f"fluid.grid.x=[{x}, 5]", f"fluid.boundary.left.kind={kind}"], [])
                          for x in (-6, -4) for kind in ("imposed", "far_field")],
        "points of the gas": [(f"{part} times those of the solid",
                               [f"fluid.body_fitted.0.points=round({part} * 2 * pi * 0.875 / h) + 1"], [])
                              for part in ("1", "0.25", "0.5", "2", "4")]}


def studies(tools):
    """(title, function) of all. `tools`: the module record_results."""
    for left in (-4, -3):
        yield f"Shock and rigid ellipse, budgets, left side at {left}", lambda x=left: rigid_budget(tools, x)
    ratios = [(f"gas : solid = {name}", [f"fluid.body_fitted.0.points=round({factor} * 2 * pi / h) + 1"], [])
              for name, factor in (("1 : 1", 1), ("1 : 2", 0.5), ("1 : 4", 0.25), ("2 : 1", 2), ("4 : 1", 4))]
    yield ("Rotating disk, different numbers of points on the two sides, h = 1/80",
           lambda: tools.rates("disk-points", "rotating_disk", "2,4,8", ratios, tools.COLUMNS))
    for law in LAWS:
        yield (f"Shock and ellipse, {law}: from grid to grid",
               lambda l=law: tools.converge(f"ellipse-{l}", CASE, "4,8,16", solids=[f"ellipse={l}"])
               + "\n" + budget(tools, [tools.RUNS / f"ellipse-{l}" / f"level_{j}" for j in (4, 8, 16)]))
    for what, runs in variants().items():
        yield (f"Shock and ellipse, {what}, h = 1/80",
               lambda w=what, r=runs: bodies(tools, "ellipse-" + w.replace(" ", "-"), r, ["grid.factor=8"]))
    yield "Shock and ellipse, mirrored and turned, h = 1/40", lambda: symmetry(tools, 4)
    yield "Shock and ellipse, time of each program", lambda: parts(tools)
