"""The studies of record_results.py about outlines: does what `check` calls valid run, on finer grids too?"""

import csv
import math
import shlex
import subprocess

COMMAND = ["tests/regression/robustness/campaign.py"]
DOUBLED = ["tests/regression/robustness/doubled.py", "nozzle", "airfoil", "panel_on_step", "elastic_ramp", "elastic_wedge", "two_cylinders"]
WHOLE = ["tests/regression/robustness/doubled.py", "--whole", "own/star", "own/two", "own/wall", "own/wedge", "own/ramp", "own/step", "airfoil", "nozzle",
         "elastic_ramp"]


def campaign(root):
    """The campaign's table, and a line for each case that did not end well or was refused."""
    answer = subprocess.run(COMMAND, cwd=root, capture_output=True, text=True, check=False)
    lines = answer.stdout.splitlines()
    table = [line for line in lines if line.startswith("|")]
    wrong = [line for line in lines if any(word in line for word in (" FAILED ", " NO PLACE ", " NOT HIT ", " refused "))]
    if not table:
        return f"exit code {answer.returncode}: {answer.stderr.strip()[-300:]}\n"
    return (f"`{shlex.join(COMMAND)}`, exit code {answer.returncode}\n\n" + "\n".join(table) + "\n"
            + ("\nNot run to the end:\n\n```\n" + "\n".join(wrong) + "\n```\n" if wrong else ""))


def doubled(root):
    """The table of cases whose resolution is doubled twice."""
    answer = subprocess.run(DOUBLED, cwd=root, capture_output=True, text=True, check=False)
    if "|" not in answer.stdout:
        return f"exit code {answer.returncode}: {answer.stderr.strip()[-300:]}\n"
    return f"`{shlex.join(DOUBLED)}`, exit code {answer.returncode}\n\n{answer.stdout}"


def whole(root):
    """The table of cases of outlines and physics alone, run to their ends on three grids."""
    answer = subprocess.run(WHOLE, cwd=root, capture_output=True, text=True, check=False)
    if "|" not in answer.stdout:
        return f"exit code {answer.returncode}: {answer.stderr.strip()[-300:]}\n"
    return (f"`{shlex.join(WHOLE)}`, exit code {answer.returncode}\n\n"
            "Cases `own/..` lie beside the script. In `two` a soft disk is pushed against a stiff one: contact is not computed, and the run ends when half a "
            "cell is left between them. In `ramp` the stream pushes a soft panel down to the wall on which it begins; `elastic_ramp` is ten times as stiff. "
            "The least pressure of `wedge` is that behind it at t = 0, a one-dimensional expansion to the fluid at rest there, p_0 (1 - (gamma - 1) / 2 M)^7 = 0.0200; the values that were made "
            "positive there are all of its beginning, before t = 0.05. "
            "Counted are floors of the gas, fluxes and values that were made positive, and points near vacuum; in runs that ended before their time floors and vacuum alone. Seconds beside other work.\n\n"
            + answer.stdout)


def _work(directory, solid):
    """Integral of the power of the gas on a solid, from interface.csv."""
    with open(directory / "interface.csv", encoding="utf-8", newline="") as file:
        heading, *rows = csv.reader(file)
    power = next(k for k, title in enumerate(heading) if title.startswith(f"{solid}.power"))
    steps = [(float(row[1]), float(row[power])) for row in rows]
    return sum(0.5 * (a[1] + b[1]) * (b[0] - a[0]) for a, b in zip(steps, steps[1:]))


def _budgets(tools):
    """What the gas did on the bar and the bar's energy, and the momentum of the free block that no load explains."""
    lines = ["| h | bar: energy | work of the gas over it | gap | block: momentum | defect over it | gap |", "|" + "---|" * 7]
    typed = []
    for factor in (2, 4, 8):
        folders = []
        for case in ("bar_on_wall", "shock_on_block"):
            directory, _, command = tools.run_once(f"{case}-{factor}", case, [f"grid.factor={factor}"])
            folders.append((directory, tools.summary_of(directory)))
            typed.append(command)
        (bar, of_bar), (_, of_block) = folders
        energy, block = tools.value_at(of_bar, "conservation.bar.energy") or math.nan, tools.value_at(of_block, "conservation.block") or {}
        momentum = math.hypot(block.get("momentum1", math.nan), block.get("momentum2", math.nan))
        defect = math.hypot(block.get("momentum1_defect", math.nan), block.get("momentum2_defect", math.nan))
        lines.append(f"| 1/{10 * factor} | {energy:.3e} | {_work(bar, 'bar') / energy:.4f} | {tools.shown(tools.value_at(of_bar, 'interface.max_gap'))} | "
                     f"{momentum:.3e} | {defect / momentum:.1e} | {tools.shown(tools.value_at(of_block, 'interface.max_gap'))} |")
    return f"last row: `{typed[-2]}` and `{typed[-1]}`\n\n" + "\n".join(lines) + "\n"


def corners(tools):
    """Each grid against the next finer one, and budgets."""
    return (tools.converge("bar-on-wall", "bar_on_wall", "2,4,8") + "\n" + tools.converge("shock-on-block", "shock_on_block", "2,4,8")
            + "\n" + _budgets(tools))


def studies(tools):
    yield "Elastic bodies with four sharp corners, met by a shock", lambda: corners(tools)
    yield "Random outlines met by a shock", lambda: campaign(tools.ROOT)
    yield "Outlines alone, the resolution doubled twice", lambda: doubled(tools.ROOT)
    yield "Outlines alone, run to their ends, the resolution doubled twice", lambda: whole(tools.ROOT)
