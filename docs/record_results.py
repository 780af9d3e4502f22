#!/usr/bin/python3
"""Makes docs/results.md: runs every study below by ./launch/fsi and writes down what came out, with the command.

    docs/record_results.py [WORD ...]     all studies, or those whose title contains one of the words

Studies that are not run keep the text they have in docs/results.md. Nothing in that file is typed by hand.
"""

import json
import re
import shlex
import shutil
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
RUNS = ROOT / "runs" / "results"
RESULTS = ROOT / "docs" / "results.md"


def fsi(*words):
    """(command as typed, exit code, last line of stderr)"""
    command = ["./launch/fsi", *words]
    answer = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False)
    lines = [line for line in answer.stderr.splitlines() if line.strip()]
    return shlex.join(command), answer.returncode, lines[-1] if lines else ""


def fresh(name):
    directory = RUNS / name
    shutil.rmtree(directory, ignore_errors=True)
    return directory


def flags(settings, solids=()):
    return [word for entry in settings for word in ("--set", entry)] + [
        word for entry in solids for word in ("--solid", entry)]


def value_at(summary, path):
    for key in path.split("."):
        summary = summary.get(key) if isinstance(summary, dict) else None
    return summary


def shown(value):
    if isinstance(value, float):
        return f"{value:.3g}"
    return "-" if value is None else str(value)


def converge(name, case, levels, settings=(), solids=()):
    """Error table of one case over grid factors."""
    directory = fresh(name)
    words = ["converge", case, "--levels", levels, *flags(settings, solids)]
    command, code, message = fsi(*words, "--out", str(directory))
    typed = command.split(" --out ")[0]
    table = directory / "converge.md"
    body = table.read_text(encoding="utf-8") if table.is_file() else f"exit code {code}: {message}\n"
    return f"`{typed}`\n\n{body}"


def rates(name, case, levels, variants, columns):
    """One row per variant (label, settings, solids): errors on the finest grid with their rates over all levels."""
    lines = ["| " + " | ".join(["", *(word for column in columns for word in (column, "rate"))]) + " |",
             "|" + "---|" * (2 * len(columns) + 1)]
    typed = ""
    for index, (label, settings, solids) in enumerate(variants):
        directory = fresh(f"{name}-{index}")
        command, code, message = fsi("converge", case, "--levels", levels, *flags(settings, solids), "--out", str(directory))
        typed = command.split(" --out ")[0]
        path = directory / "converge.json"
        if code or not path.is_file():
            lines.append(f"| {label} | exit code {code}: {message} |" + " |" * (2 * len(columns) - 1))
            continue
        found = json.loads(path.read_text(encoding="utf-8"))
        cells = [f"{found['errors'][column][-1]:.2e} | {found['fitted'][column]:.2f}" for column in columns]
        lines.append("| " + " | ".join([label, *cells]) + " |")
    return f"last row: `{typed}`\n\n" + "\n".join(lines) + "\n"


def sweep(name, case, variants, columns, settings=()):
    """One row per variant (label, settings, solids); columns are (heading, path in summary.json)."""
    lines = ["| " + " | ".join(["", *(heading for heading, _ in columns), "exit"]) + " |",
             "|" + "---|" * (len(columns) + 2)]
    typed = ""
    for index, (label, extra, solids) in enumerate(variants):
        directory = fresh(f"{name}-{index}")
        command, code, _ = fsi("run", case, *flags([*settings, *extra], solids), "--no-progress", "--out", str(directory))
        typed = command.split(" --no-progress")[0]
        path = directory / "summary.json"
        summary = json.loads(path.read_text(encoding="utf-8")) if path.is_file() else {}
        lines.append("| " + " | ".join([label, *(shown(value_at(summary, path)) for _, path in columns), str(code)]) + " |")
    return f"last row: `{typed}`\n\n" + "\n".join(lines) + "\n"


def bench(name):
    directory = fresh(name)
    directory.mkdir(parents=True)
    command, code, message = fsi("bench", "--out", str(directory / "bench.json"))
    if code:
        return f"`{command}`: exit code {code}: {message}\n"
    entries = json.loads((directory / "bench.json").read_text(encoding="utf-8"))
    rows = entries.get("benchmarks", entries) if isinstance(entries, dict) else entries
    keys = ["name", "items_per_second", "median_us", "real_time", "time_unit"]
    lines = ["| " + " | ".join(keys) + " |", "|" + "---|" * len(keys)]
    lines += ["| " + " | ".join(shown(row.get(key)) for key in keys) + " |" for row in rows]
    return "`./launch/fsi bench`\n\n" + "\n".join(lines) + "\n"


RATIOS = ["0.001", "0.01", "0.1", "1", "10", "1000"]
PISTON = [("steps", "steps"), ("v_bar", "errors.v_bar"), ("P_bar", "errors.P_bar"), ("u_bar", "errors.u_bar"),
          ("rho", "errors.rho"), ("v1", "errors.v1"), ("T", "errors.T"), ("gap", "interface.max_gap")]
END = [("status", "status"), ("t", "t"), ("steps", "steps"), ("reason", "reason")]
LAWS = ["linear_elastic", "saint_venant_kirchhoff", "neo_hookean"]


def ratios(projection, extra=()):
    return [(f"R = {r}", [f"parameters.density_ratio={r}", f"interface.projection={projection}", *extra], []) for r in RATIOS]


def piston_studies():
    for ratio in ("0.1", "1", "1000"):
        yield (f"Elastic piston, density ratio {ratio}",
               lambda r=ratio: converge(f"piston-{r}", "elastic_piston", "2,4,8,16", [f"parameters.density_ratio={r}"]))
    yield ("Elastic piston, full projection",
           lambda: converge("piston-full", "elastic_piston", "2,4,8,16",
                            ["parameters.density_ratio=0.1", "interface.projection=full"]))
    yield ("Elastic piston turned by 30 degrees",
           lambda: converge("piston-turned", "elastic_piston", "2,4,8,16", ["parameters.density_ratio=0.1", "parameters.angle=30"]))
    for projection in ("simplified", "full"):
        yield (f"Elastic piston, all density ratios, {projection} projection, h = 1/80",
               lambda p=projection: sweep(f"ratios-{p}", "elastic_piston", ratios(p), PISTON, ["grid.factor=8"]))
    yield ("Elastic piston, the traditional scheme, h = 1/80",
           lambda: sweep("traditional", "elastic_piston", ratios("traditional"), END, ["grid.factor=8"]))
    yield ("Elastic piston with c_p = 8: multirate, all density ratios, h = 1/80",
           lambda: sweep("multirate", "elastic_piston", ratios("simplified", ["parameters.c_p=8", "time.multirate=true"]),
                         PISTON, ["grid.factor=8"]))
    yield ("Elastic piston with c_p = 8: single rate, all density ratios, h = 1/80",
           lambda: sweep("single-rate", "elastic_piston", ratios("simplified", ["parameters.c_p=8"]), PISTON,
                         ["grid.factor=8"]))
    yield ("Elastic piston with c_p = 8: convergence of multirate",
           lambda: converge("multirate-rate", "elastic_piston", "2,4,8,16",
                            ["parameters.density_ratio=0.1", "parameters.c_p=8", "time.multirate=true"]))


def sides():
    """Every kind of left side with every law, and sides that are mirrors of the grid."""
    key = "solids.solid.boundary"
    for law in LAWS:
        for kind in ("displacement", "traction", "slip_wall", "symmetry", "dirichlet"):
            yield f"{law}, left {kind}", [f"{key}.left={kind}"], [f"solid={law}"]
    for kind in ("traction", "dirichlet"):
        yield f"neo_hookean, bottom {kind}", [f"{key}.bottom={kind}"], []
    yield ("neo_hookean, rectangle between mirrors", ["parameters.waist=0", f"{key}.left=symmetry", f"{key}.right=symmetry",
                                                      f"{key}.top=displacement"], [])


def other_studies():
    for case in ("piston_svk", "piston_neo_hookean"):
        yield (f"{case} against the fine one-dimensional run", lambda c=case: converge(c, c, "2,4,8,16"))
    yield "Gas: isentropic vortex on a moving wavy grid", lambda: converge("vortex", "isentropic_vortex", "2,4,8,16")
    yield "Gas: Sod's tube", lambda: converge("sod", "sod_tube", "4,8,16")
    yield ("Uniform flow on a shaken grid; gas and solid moving together",
           lambda: sweep("uniform", "free_stream", [("free stream", [], [])],
                         [(name, f"errors.{name}") for name in ("rho", "v1", "v2", "T")])
           + "\n" + sweep("together", "moving_together",
                          [(f"{p}, multirate {m}", [f"interface.projection={p}", f"time.multirate={m}"], [])
                           for p in ("simplified", "full") for m in ("false", "true")],
                          [(name, f"errors.{name}") for name in ("rho", "v1", "v2", "T")]
                          + [("gap", "interface.max_gap"), ("velocity jump", "interface.max_velocity_jump")]))
    for law in LAWS:
        yield (f"Solid: manufactured solution, {law}",
               lambda l=law: converge(f"manufactured-{l}", "solid_manufactured", "2,4,8,16", solids=[f"solid={l}"]))
    yield ("Solid: manufactured solution, every law and kind of side, h = 1/80",
           lambda: rates("manufactured-sides", "solid_manufactured", "2,4,8", sides(), ["u_bar", "v_bar", "P_bar"]))
    yield ("Solid: spinning block",
           lambda: sweep("block", "spinning_block",
                         [(f"h = 1/{10 * j}, {turns} turn{'s' if turns > 1 else ''}",
                           [f"grid.factor={j}", f"parameters.turns={turns}"], [])
                          for turns, j in ((1, 2), (1, 4), (1, 8), (5, 4), (40, 2))],
                         [("t", "t"), ("energy drift", "conservation.block.energy"),
                          ("energy", "conservation.block.energy_initial"),
                          ("angular momentum drift", "conservation.block.angular_momentum"),
                          ("angular momentum", "conservation.block.angular_momentum_initial")]))
    yield "Benchmarks", lambda: bench("bench")


def kept_sections():
    """{title: text} of the present docs/results.md."""
    if not RESULTS.is_file():
        return {}
    parts = re.split(r"^## (.*)\n", RESULTS.read_text(encoding="utf-8"), flags=re.M)
    return dict(zip(parts[1::2], parts[2::2]))


def main(words):
    sections = kept_sections()
    studies = [*piston_studies(), *other_studies()]
    head = ("# Results\n\nWhat the commands gave on two cores; `docs/record_results.py` repeats them all and writes this page. "
            "Errors are largest absolute differences over all points and components.\n\n")
    for title, study in studies:
        if not words or any(word in title for word in words):
            print(title, flush=True)
            sections[title] = "\n" + study().strip() + "\n\n"
            text = head + "".join(f"## {name}\n{sections[name]}" for name, _ in studies if name in sections)
            RESULTS.write_text(text.rstrip() + "\n", encoding="utf-8")


if __name__ == "__main__":
    main(sys.argv[1:])
