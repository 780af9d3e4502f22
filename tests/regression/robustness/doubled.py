#!/usr/bin/python3
"""Does a case still start when its resolution is doubled twice, and nothing else is touched?

    tests/regression/robustness/doubled.py [--steps N] CASE ...

Checks each case (a name in configs/ or a path) with its own `grid.factor`, twice and four times that, runs what `check` calls fine for
the time that so many steps of 2.5 times the estimate take (or to its end), and prints a table. Exit 1 where one is refused or does not come to its end. Programs: build/release/bin, or $FSI_BIN.
"""

import argparse
import json
import os
import subprocess
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))
sys.dont_write_bytecode = True
from campaign import BIN, ROOT, WATCHDOG  # noqa: E402


LONGER = 2.5  # first steps may be larger than the estimate, which is that of the fastest waves to come


def path_of(case):
    return Path(case) if Path(case).is_file() else ROOT / "configs" / f"{case}.yaml"


def checked(path, settings):
    """What the programs need to know, and the message where `check` refuses."""
    answer = subprocess.run([BIN / "fsi_case", "check", str(path), "--json", *settings], capture_output=True, text=True, check=False)
    return (json.loads(answer.stdout), "") if answer.returncode == 0 else (None, answer.stderr.strip().split(": ", 2)[-1])


def became(path, times, steps, out):
    """Cells of the table's row: factor, points of the gas, dt, estimated seconds of the whole run, what became of the first steps."""
    found, refusal = checked(path, [])
    factor = found["grid_factor"] * times if found else times
    settings = ["--set", f"grid.factor={factor:g}"]
    if found and times > 1:
        found, refusal = checked(path, settings)
    if not found:
        return f"{factor:g}", "", "", "", "refused: " + refusal
    cost = found["cost"]
    command = [ROOT / "launch" / "fsi", "run", str(path), *settings, "--set", f"time.end={min(LONGER * steps * cost['dt'], found['time']['end'])}", "--set", "expect={}",
               "--no-progress", "--overwrite", "--out", str(out)]
    answer = subprocess.run(command, capture_output=True, text=True, check=False, timeout=WATCHDOG, env=os.environ | {"FSI_BIN": str(BIN)})
    summary = json.loads((out / "summary.json").read_text(encoding="utf-8")) if (out / "summary.json").is_file() else {}
    words = [line for line in answer.stderr.strip().splitlines() if line.strip()] or ["no summary"]
    said = f"{summary['steps']} steps" if answer.returncode == 0 else summary.get("failure", {}).get("what", words[-1])
    return f"{factor:g}", f"{found['fluid_points']}", f"{cost['dt']:.2g}", f"{cost['seconds']:.2g}", said


def main():
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("--steps", type=int, default=50)
    options.add_argument("cases", nargs="+")
    chosen = options.parse_args()
    print("| case | grid.factor | points of the gas | dt | estimate of the whole run, s | first steps |\n" + "|---" * 6 + "|", flush=True)
    sound = True
    for case in chosen.cases:
        path = path_of(case)
        for times in (1, 2, 4):
            with tempfile.TemporaryDirectory() as scratch:
                cells = became(path, times, chosen.steps, Path(scratch) / "run")
            sound = sound and cells[-1].endswith("steps")
            print(f"| {path.stem} | " + " | ".join(cells) + " |", flush=True)
    return 0 if sound else 1


if __name__ == "__main__":
    sys.exit(main())
