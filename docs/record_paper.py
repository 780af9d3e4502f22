"""The studies of record_results.py beside the tables of the paper: its numbers, ours with its own settings and with ours, and the
summary docs/results.md begins with."""

import json
import re

COLUMNS = ("rho", "v1", "v2", "T", "u_bar", "v_bar", "P_bar")

# Published errors {h = 1 / (10 j): j: values of COLUMNS}.
MANUFACTURED = {  # figure 8
    2: (1.8e-5, 6.9e-4, 9.4e-5, 1.1e-4, 1.2e-4, 6.9e-4, 9.7e-5), 4: (4.8e-6, 1.7e-4, 2.3e-5, 3.4e-5, 3.3e-5, 1.7e-4, 2.4e-5),
    8: (1.2e-6, 4.3e-5, 5.1e-6, 8.9e-6, 8.7e-6, 4.3e-5, 5.9e-6), 16: (3.1e-7, 1.1e-5, 1.2e-6, 2.3e-6, 2.2e-6, 1.1e-5, 1.5e-6)}
DISK = {  # figures 12, 13 and 14; the simplified and the full projection have the same figures
    "10": {2: (1.5e-5, 1.1e-4, 1.1e-4, 3.1e-5, 1.7e-4, 1.0e-3, 1.5e-3), 4: (4.1e-6, 2.9e-5, 3.0e-5, 8.3e-6, 2.9e-5, 2.3e-4, 2.1e-4),
           8: (9.6e-7, 6.6e-6, 6.7e-6, 1.9e-6, 5.6e-6, 4.8e-5, 3.9e-5), 16: (2.4e-7, 1.6e-6, 1.6e-6, 4.8e-7, 1.2e-6, 1.1e-5, 8.3e-6)},
    "1": {2: (1.1e-4, 7.3e-5, 7.5e-5, 2.1e-5, 1.7e-4, 1.0e-3, 1.5e-3), 4: (3.2e-5, 2.3e-5, 2.3e-5, 6.6e-6, 2.9e-5, 2.3e-4, 2.1e-4),
          8: (8.3e-6, 5.8e-6, 5.8e-6, 1.7e-6, 5.6e-6, 4.8e-5, 3.9e-5), 16: (2.1e-6, 1.5e-6, 1.5e-6, 4.3e-7, 1.2e-6, 1.1e-5, 8.1e-6)},
    "0.1": {2: (1.1e-3, 4.0e-5, 2.7e-5, 5.7e-5, 1.8e-4, 1.2e-3, 1.5e-3), 4: (1.8e-4, 1.3e-5, 1.3e-5, 3.8e-6, 3.2e-5, 2.9e-4, 2.2e-4),
            8: (6.3e-5, 4.4e-6, 4.4e-6, 1.3e-6, 6.2e-6, 6.4e-5, 4.2e-5), 16: (1.8e-5, 1.3e-6, 1.2e-6, 3.6e-7, 1.3e-6, 1.5e-5, 9.2e-6)},
}
TRADITIONAL = {  # third table of figure 12: the traditional scheme, delta = 10
    2: (1.4e-5, 1.0e-4, 1.0e-4, 2.9e-5, 1.7e-4, 1.0e-3, 1.4e-3), 4: (3.9e-6, 2.8e-5, 2.9e-5, 7.9e-6, 2.9e-5, 2.3e-4, 2.1e-4),
    8: (9.4e-7, 6.5e-6, 6.6e-6, 1.9e-6, 5.6e-6, 4.8e-5, 3.9e-5), 16: (2.3e-7, 1.6e-6, 1.6e-6, 4.7e-7, 1.2e-6, 1.1e-5, 8.2e-6)}
BOUNDS = {  # figure 10: {t: {field: (least, largest)}}, delta = 0.1, j = 4
    0.5: {"v1": (-4.9404e-5, 4.9440e-5), "v1_bar": (-4.99646e-2, 4.99655e-2), "p": (9.99934, 10.00073), "|P_bar|": (1.7e-4, 4.2e-2)},
    1.0: {"v1": (-7.1114e-5, 7.1121e-5), "v1_bar": (-3.38356698e-2, 3.383561242e-2), "p": (9.999058, 10.00037),
          "|P_bar|": (5.35e-4, 5.42e-2)}}

# The paper's own settings of the disk: rings of depth 0.25 with 7, 12, 22 and 42 lines in the solid, Courant number, relaxation.
RINGS = ["fluid.body_fitted.0.lines=round(0.25 / h) + 1", "solids.disk.body_fitted.lines=round(0.25 / h) + 2",
         "solids.disk.body_fitted.spacing=0.25 / (round(0.25 / h) + 1)"]
DISK_CFL = {"10": 0.9, "1": 0.9, "0.1": 0.75}
RELAXATION = "solids.disk.scheme.relaxation={rate: 0.5}"
PAPER_DISK = "the paper's rings, Courant number and relaxation"
PAPER_PISTON = "Manufactured piston, the paper's Courant number 0.9 and the relaxation of its disks"
LARGEST = "Largest of these ratios"


def as_in_the_paper(delta):
    """Settings of `rotating_disk`."""
    return [f"time.cfl={DISK_CFL[str(delta)]}", *RINGS, RELAXATION, "expect={}"]


def ratios(found, published):
    """Our errors over the published ones, and the largest ratio with its place. `found`: {column: [error by level]}."""
    lines = ["| h | " + " | ".join(COLUMNS) + " |", "|" + "---|" * (len(COLUMNS) + 1)]
    worst = (0.0, "", "")
    for index, (level, paper) in enumerate(published.items()):
        parts = [found[column][index] / error for column, error in zip(COLUMNS, paper)]
        worst = max(worst, *((part, column, f"1/{10 * level}") for part, column in zip(parts, COLUMNS)))
        lines.append(f"| 1/{10 * level} | " + " | ".join(f"{part:.2f}" for part in parts) + " |")
    return "\n".join(lines) + f"\n\n{LARGEST}: {worst[0]:.2f} ({worst[1]} at h = {worst[2]}).\n"


def beside(tools, name, case, published, settings=(), solids=()):
    """Error table of a case over the grids of a published one, and the ratios of the two."""
    text = tools.converge(name, case, ",".join(map(str, published)), settings, solids)
    path = tools.RUNS / name / "converge.json"
    if not path.is_file():
        return text
    found = json.loads(path.read_text(encoding="utf-8"))["errors"]
    return text + "\nThe same errors over those of the paper's table:\n\n" + ratios(found, published)


def bounds(tools):
    """Least and largest values of figure 10: the paper's, ours, and those of the one-dimensional reference run."""
    import numpy as np
    from fsi_launch.plot.one_run import disk
    from fsi_launch.plot.reading import data
    directory, _, typed = tools.run_once("disk-bounds", "rotating_disk",
                                         ["grid.factor=4", "parameters.delta=0.1", *as_in_the_paper(0.1), "time.end=1", "output.times=[0.5, 1]"])
    series, reference = data.all_series(directory), data.disk_reference(directory)
    gas, solid = (next(one for one in series if one.is_gas() == is_gas) for is_gas in (True, False))

    def values(grids, field):
        return np.concatenate([field(grid)[grid.used()] for grid in grids])

    def size(f):
        return np.sqrt(sum(f[key] ** 2 for key in ("P11", "P12", "P21", "P22")))

    lines = ["| t | field | paper | ours | one-dimensional reference |", "|---|---|---|---|---|"]
    worst = (0.0, "", "")
    for of_gas, of_solid in zip(gas.outputs, solid.outputs):
        table = next(one for t, one in reference.items() if abs(t - of_gas.t) < 1e-9)
        # On a circle v1 takes every value between minus and plus the size of the velocity.
        speed = {"v1": np.abs(table["gas"]["v"]).max(), "v1_bar": np.hypot(table["solid"]["v1"], table["solid"]["v2"]).max()}
        ours = {"v1": values(of_gas.grids, lambda g: g.fields["v1"]), "v1_bar": values(of_solid.grids, lambda g: g.fields["v1"]),
                "p": values(of_gas.grids, lambda g: g.fields["p"]), "|P_bar|": values(of_solid.grids, lambda g: size(g.fields))}
        exact = {"v1": (-speed["v1"], speed["v1"]), "v1_bar": (-speed["v1_bar"], speed["v1_bar"]),
                 "p": (table["gas"]["p"].min(), table["gas"]["p"].max()),
                 "|P_bar|": (size(table["solid"]).min(), size(table["solid"]).max())}
        for field, paper in BOUNDS[round(of_gas.t, 9)].items():
            found = (ours[field].min(), ours[field].max())
            cells = [f"{a:.7g} .. {b:.7g}" for a, b in (paper, found, exact[field])]
            lines.append(f"| {of_gas.t:g} | {field} | " + " | ".join(cells) + " |")
            distances = [max(abs(a - b) for a, b in zip(one, exact[field])) for one in (found, paper)]
            worst = max(worst, (distances[0] / distances[1], field, f"{of_gas.t:g}"))
    return (f"`{typed}`\n\n" + "\n".join(lines) + f"\n\nThe distance of our bounds from the reference's over the distance of the paper's.\n"
            f"{LARGEST}: {worst[0]:.2f} ({worst[1]} at t = {worst[2]}).\n")


def at_interface(tools):
    """Where the density's error of the manufactured piston comes from: on the interface it is that of the velocity, times rho / a."""
    import numpy as np
    import yaml
    from fsi_launch.plot.reading import data
    directory, _, typed = tools.run_once("chosen-cfl-interface", "manufactured_piston", ["grid.factor=2", "time.cfl=0.9", "expect={}"])
    case = yaml.safe_load((tools.ROOT / "configs" / "manufactured_piston.yaml").read_text(encoding="utf-8"))
    last = data.all_series(directory)[0].outputs[-1]
    strip = next(grid for grid in last.grids if grid.name == "strip")
    names = {"pi": np.pi, "cos": np.cos, "sin": np.sin, "t": last.t, "x": strip.x1, "y": strip.x2, **case["parameters"]}
    for name, formula in case["definitions"].items():
        names[name] = eval(formula, {}, names)
    exact = case["reference"]["fluid"]
    rho, v1, p = (strip[name] for name in ("rho", "v1", "p"))
    error_rho, error_v1 = (found - eval(formula, {}, names) for found, formula in ((rho, exact["rho"]), (v1, exact["v"][0])))
    from_velocity = rho / np.sqrt(case["parameters"]["gamma"] * p / rho) * error_v1
    on = np.isclose(strip.x1, case["parameters"]["speed"] * last.t)
    rows = sorted(zip(strip.x2[on], error_rho[on], error_v1[on], from_velocity[on]))[::2]
    return "\n".join([
        "The density is off most on the interface, where its error is that of the velocity times rho / a: a velocity that the solid, ten times as dense as "
        "this gas, decides. With the positive pressure that (47) has here, a is 0.12, and errors of the velocity well below the paper's show more in the density.",
        "", f"`{typed}`", "", "| y on the interface | error of rho | error of v1 | rho / a times it |", "|---|---|---|---|",
        *(f"| {y:.2g} | {a:.2e} | {b:.2e} | {c:.2e} |" for y, a, b, c in rows), ""])


def manufactured(tools):
    for law in tools.LAWS:
        yield (f"Manufactured piston, {law}",
               lambda l=law: beside(tools, f"chosen-{l}", "manufactured_piston", MANUFACTURED, solids=[f"solid={l}"]))
    yield ("Manufactured piston, full projection",
           lambda: beside(tools, "chosen-full", "manufactured_piston", MANUFACTURED, ["interface.projection=full"]))
    yield (PAPER_PISTON, lambda: beside(tools, "chosen-paper", "manufactured_piston", MANUFACTURED,
                                        ["time.cfl=0.9", "solids.solid.scheme.relaxation={rate: 0.5}", "expect={}"]))
    yield ("Manufactured piston, the paper's Courant number 0.9",
           lambda: beside(tools, "chosen-cfl", "manufactured_piston", MANUFACTURED, ["time.cfl=0.9", "expect={}"]) + "\n" + at_interface(tools))


def disks(tools):
    def one(delta, name, projection, settings, published):
        return beside(tools, f"disk-{delta}-{name}", "rotating_disk", published,
                      [f"parameters.delta={delta}", f"interface.projection={projection}", *settings])

    for delta, weight in (("10", "heavy"), ("1", "medium"), ("0.1", "light")):
        for projection in ("simplified", "full"):
            yield (f"Rotating disk, {weight} (delta = {delta}), {projection} projection, {PAPER_DISK}",
                   lambda d=delta, p=projection: one(d, f"paper-{p}", p, as_in_the_paper(d), DISK[d]))
        for projection in ("simplified", "full"):
            yield (f"Rotating disk, {weight} (delta = {delta}), {projection} projection",
                   lambda d=delta, p=projection: one(d, p, p, [], DISK[d]))
    heavy = "Rotating disk, heavy (delta = 10), the traditional scheme"
    yield f"{heavy}, {PAPER_DISK}", lambda: one("10", "paper-traditional", "traditional", as_in_the_paper("10"), TRADITIONAL)
    yield heavy, lambda: one("10", "traditional", "traditional", [], TRADITIONAL)
    yield "Rotating disk, bounds of figure 10", lambda: bounds(tools)


PRESSURE = "the pressure of (47), which would be negative"
SUMMARY = (  # (figure of the paper, what, what differs besides the list below, title of the section); the paper's own settings first
    ("8", "errors", PRESSURE, PAPER_PISTON),
    ("8", "errors", f"{PRESSURE}; relaxation {{scaled: 0.1}}", "Manufactured piston, the paper's Courant number 0.9"),
    ("8", "errors", f"{PRESSURE}; relaxation {{scaled: 0.1}}, Courant number 0.7", "Manufactured piston, saint_venant_kirchhoff"),
    ("10", "bounds of the fields, distance from a fine one-dimensional run", "", "Rotating disk, bounds of figure 10"),
    *((figure, f"errors, delta = {delta}, {projection} projection", difference,
       f"Rotating disk, {weight} (delta = {delta}), {projection} projection{settings}")
      for figure, delta, weight in (("12", "10", "heavy"), ("13", "1", "medium"), ("14", "0.1", "light"))
      for settings, difference in ((f", {PAPER_DISK}", ""), ("", "rings 7 h deep, Courant number 0.9, relaxation {scaled: 0.2}"))
      for projection in ("simplified", "full")),
    *(("12", "errors, delta = 10, traditional scheme", difference, f"Rotating disk, heavy (delta = 10), the traditional scheme{settings}")
      for settings, difference in ((f", {PAPER_DISK}", ""), ("", "rings 7 h deep, relaxation {scaled: 0.2}"))),
    ("18", "from grid to grid; the paper has pictures alone", "", "Shock and ellipse, neo_hookean: from grid to grid"),
    ("19", "simplified against full projection; the paper has pictures alone", "numbers at h = 1/80", "Shock and ellipse, projections, h = 1/80"),
    ("22", "centrelines; the paper has pictures alone", "", "Beam: the four of the paper, h = 1/160"),
    ("23", "centrelines from grid to grid; the paper has pictures alone", "",
     "Beam (100, 100): largest distance between the centrelines of two grids"),
)

DIFFERENCES = """## What differs from the paper

| where | the paper, or the runs it was published with | here | more |
|---|---|---|---|
| Procedure 1 | the last line moves the grids to the corrected interface | the next command of the motion begins at the solid's own points, so that the gap of a step never adds up | [one time step](architecture.md#one-time-step) |
| the gas, (31) | linear diffusion in the disks: 10, 2, 1 per unit of time for delta = 0.1, 1, 10 | none | [theory](theory_fluid.md) |
| the gas's side of (28) | linear | the wave curve of the gas; linear (`interface.riemann`) in the paper's problems | [theory](theory_coupler.md) |
| the solid, bulk diffusion | 1/8 per unit of time on v and P | none | [theory](theory_solid.md) |
| (39)-(41) | mostly rates | parts that do not depend on dt, in the file of each case | [options](theory_solid.md#options-solidsnamescheme) |
| (44), (45) | beta = max(beta^u, beta^P, beta^r) | max(beta^u, beta^P + beta^r), since (39) and (41) both act on P, and a bound of its own for upwinding with relaxation | [stability](theory_solid.md#stability-of-waves-with-relaxation) |
| (47) | a pressure between -alpha and alpha | the temperature alpha (1 + 0.25 c1 s2 ct) | [figure 8](figures.md#figure-8-errors-of-the-manufactured-piston) |
| (43), derivatives along the side | central differences | on closed interfaces and between mirrors of fourth order, on other sides the same | [boundary conditions](theory_solid.md#boundary-conditions) |
| sides with a given velocity or traction | the given half of a characteristic overwritten | the other half set as well | [boundary conditions](theory_solid.md#boundary-conditions) |
| disk | rings 0.25 deep; Courant number 0.75 for delta = 0.1; relaxation of 0.5 per unit of time | the same in the figures and in the sections that say so; as shipped, rings of 7 h, 0.9 and {scaled: 0.2} | [options](theory_solid.md#options-solidsnamescheme) |
| ellipse | 6 lines in the gas's ring | 8 | |
| ellipse, cylinders, beam | one step for gas and solid | `time.multirate`: as many substeps of the solid as it needs | [multirate](theory_coupler.md) |
| beam | 10 lines in its ring, both spacings about h / 1.2; a limiter, and first order for the three lighter ones | 7 lines, min(0.48 h, 0.003) apart, core min(0.64 h, 0.004); no limiter in the solid, second order throughout | [figure 20](figures.md#figure-20-grids-of-a-bent-beam) |

"""


def summary(sections, anchor):
    """The table the page begins with: the largest of our errors over the paper's in each table, read from the sections; and what differs."""
    lines = ["| figure | what | our errors over the paper's, largest of all grids and fields | differs by | section and command |", "|---|---|---|---|---|"]
    for figure, what, difference, title in SUMMARY:
        if title in sections:
            found = re.search(rf"{LARGEST}: (.*)\.\n", sections[title])
            lines.append(f"| {figure} | {what} | {found[1] if found else ''} | {difference} | [{title}](#{anchor(title)}) |")
    table = "## The paper's tables in one\n\n" + "\n".join(lines) + "\n\n" if len(lines) > 2 else ""
    return table + DIFFERENCES
