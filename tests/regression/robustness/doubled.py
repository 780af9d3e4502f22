#!/usr/bin/python3
"""Does a case still run when its resolution is doubled twice, and nothing else is touched?

    tests/regression/robustness/doubled.py [--steps N] CASE ...       its first steps
    tests/regression/robustness/doubled.py --whole CASE ...           all of it
    .. [--set KEY=VALUE]..                                             as for fsi run
    .. [--times 1,2,4]                                                 of grid.factor

Checks each case (a name in configs/ or in this folder, as own/star, or a path) with its own `grid.factor`, twice and four times that, runs what `check` calls valid for
the time that so many steps of 2.5 times the estimate take (or to its end), and prints a table. Exit 1 where one is refused or does not come to its end.
With --whole the table has what the run counted and the least and largest pressure of its outputs, and a run may also end by itself where
bodies meet each other or a wall, which is not computed. Programs: build/release/bin, or $FSI_BIN.
"""

import argparse
import json
import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))
sys.dont_write_bytecode = True
from campaign import BIN, ROOT, WATCHDOG  # noqa: E402

sys.path.insert(0, str(ROOT / "launch"))
import amp_fsi  # noqa: E402
import numpy  # noqa: E402


COUNTED = ("floors", "positive_fluxes", "positive_values", "vacuum_points")
LONGER = 2.5  # first steps may be larger than the estimate, which is that of the fastest waves to come


def path_of(case):
    """A path, a name in this folder (own/star) or in configs/."""
    beside = Path(__file__).parent / f"{case}.yaml"
    return next((path for path in (Path(case), beside) if path.is_file()), ROOT / "configs" / f"{case}.yaml")


def checked(path, settings):
    """What the programs need to know, and the message where `check` refuses."""
    answer = subprocess.run([BIN / "fsi_case", "check", str(path), "--json", *settings], capture_output=True, text=True, check=False)
    return (json.loads(answer.stdout), "") if answer.returncode == 0 else (None, answer.stderr.strip().split(": ", 2)[-1])


def ran(path, settings, out, timeout):
    """(exit code, summary, last line) of a run."""
    command = [ROOT / "launch" / "fsi", "run", str(path), *settings, "--set", "expect={}", "--no-progress", "--overwrite", "--out", str(out)]
    answer = subprocess.run(command, capture_output=True, text=True, check=False, timeout=timeout, env=os.environ | {"FSI_BIN": str(BIN)})
    summary = json.loads((out / "summary.json").read_text(encoding="utf-8")) if (out / "summary.json").is_file() else {}
    words = [line for line in answer.stderr.strip().splitlines() if line.strip()] or ["no summary"]
    return answer.returncode, summary, words[-1]


def became(path, times, given, steps, out):
    """Cells of the table's row: factor, points of the gas, dt, estimated seconds of the whole run, what became of the first steps."""
    found, refusal = checked(path, given)
    factor = found["grid_factor"] * times if found else times
    settings = [*given, "--set", f"grid.factor={factor:g}"]
    if found and times > 1:
        found, refusal = checked(path, settings)
    if not found:
        return f"{factor:g}", "", "", "", "refused: " + refusal
    cost = found["cost"]
    end = min(LONGER * steps * cost["dt"], found["time"]["end"])
    code, summary, last = ran(path, [*settings, "--set", f"time.end={end}"], out, WATCHDOG)
    said = f"{summary['steps']} steps" if code == 0 else summary.get("failure", {}).get("what", last)
    return f"{factor:g}", f"{found['fluid_points']}", f"{cost['dt']:.2g}", f"{cost['seconds']:.2g}", said


def pressures(out):
    """The least and the largest pressure of the gas at all output times."""
    run = amp_fsi.open(out)
    all_p = [grid["p"] for t in run.times() for grid in run.fields("fluid", t).values()]
    return f"{min(numpy.nanmin(p) for p in all_p):.4g} .. {max(numpy.nanmax(p) for p in all_p):.4g}"


def meeting(summary):
    """Where the run ended because bodies came to each other or to a wall, in words; "" where it did not."""
    what = summary.get("failure", {}).get("what", "")
    told = re.search(r"(body `.*|curve has come down to the wall it stands on)", what)
    return f"t = {summary['t']:.3f}: {told[0].split(',')[0].split(';')[0]}" if told else ""


def became_whole(path, times, given, out):
    """Cells of the row: factor, points of the gas, estimated seconds, seconds, steps, what was counted, pressures, how it ended; is it sound?"""
    found, refusal = checked(path, given)
    factor = found["grid_factor"] * times if found else times
    settings = [*given, "--set", f"grid.factor={factor:g}"]
    if found and times > 1:
        found, refusal = checked(path, settings)
    if not found:
        return [f"{factor:g}", *[""] * 6, "refused: " + refusal], False
    code, summary, last = ran(path, settings, out, None)
    counters = summary.get("counters", {})
    counted = ", ".join(f"{counters[key]:g} {key.replace('_', ' ')}" for key in COUNTED if counters.get(key)) or "0"
    ended = f"t = {summary['t']:g}, its end" if code == 0 else meeting(summary) or summary.get("failure", {}).get("what", last)
    cells = [f"{factor:g}", f"{found['fluid_points']}", f"{found['cost']['seconds']:.2g}", f"{summary.get('wall_s', 0):.3g}", f"{summary.get('steps')}",
             counted, pressures(out), ended]
    return cells, code == 0 or bool(meeting(summary))


def whole(cases, finer, given):
    """Prints the table of whole runs; are all sound?"""
    heads = ["case", "grid.factor", "points of the gas", "estimate, s", "wall, s", "steps", "counted", "p of the gas", "ended at"]
    print("| " + " | ".join(heads) + " |\n" + "|---" * len(heads) + "|", flush=True)
    sound = True
    for path in map(path_of, cases):
        for times in finer:
            with tempfile.TemporaryDirectory() as scratch:
                cells, fine = became_whole(path, times, given, Path(scratch) / "run")
            sound = sound and fine
            print(f"| {path.stem} | " + " | ".join(cells) + " |", flush=True)
    return sound


def main():
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("--steps", type=int, default=50)
    options.add_argument("--whole", action="store_true")
    options.add_argument("--set", action="append", default=[], metavar="KEY=VALUE")
    options.add_argument("--times", default="1,2,4")
    options.add_argument("cases", nargs="+")
    chosen = options.parse_args()
    finer, given = [int(times) for times in chosen.times.split(",")], [word for value in chosen.set for word in ("--set", value)]
    if chosen.whole:
        return 0 if whole(chosen.cases, finer, given) else 1
    print("| case | grid.factor | points of the gas | dt | estimate of the whole run, s | first steps |\n" + "|---" * 6 + "|", flush=True)
    sound = True
    for case in chosen.cases:
        path = path_of(case)
        for times in finer:
            with tempfile.TemporaryDirectory() as scratch:
                cells = became(path, times, given, chosen.steps, Path(scratch) / "run")
            sound = sound and cells[-1].endswith("steps")
            print(f"| {path.stem} | " + " | ".join(cells) + " |", flush=True)
    return 0 if sound else 1


if __name__ == "__main__":
    sys.exit(main())
