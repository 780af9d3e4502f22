#!/usr/bin/python3
"""Does what `check` calls fine run? Usage: tests/regression/robustness/campaign.py [--seed N] [--from K] [--count N] [--steps N] [--only WORD]

Makes random outlines (outlines.py): splines, polygons with sharp corners, thin bodies, pairs 20 h to 2 h apart, bodies near a
wall and on it; checks each, and runs it with a Mach 1.5 shock for so many steps. Prints a line for each and a table at the end.
The same seed makes the same cases. Exit 1 where a case that `check` calls fine does not come to its end; a case that it refuses
must be refused with a place in the file. Programs: build/release/bin, or $FSI_BIN. By hand; `robustness.outlines` of the suite runs a dozen.
"""

import argparse
import json
import os
import re
import subprocess
import sys
import tempfile
from collections import Counter
from pathlib import Path

ROOT = Path(os.environ.get("FSI_ROOT") or Path(__file__).resolve().parents[3])
BIN = Path(os.environ.get("FSI_BIN") or ROOT / "build" / "release" / "bin")
sys.path.insert(0, str(Path(__file__).parent))
sys.dont_write_bytecode = True
import outlines  # noqa: E402

WATCHDOG = 3600  # [s]


def checked(path):
    """Exit code and what the programs need to know, or the message."""
    answer = subprocess.run([BIN / "fsi_case", "check", str(path), "--json"], capture_output=True, text=True, check=False)
    return answer.returncode, json.loads(answer.stdout) if answer.returncode == 0 else answer.stderr.strip()


def ended(path, end, out):
    """Exit code and last words of a run to `end`."""
    command = [ROOT / "launch" / "fsi", "run", str(path), "--set", f"time.end={end}", "--no-progress", "--out", str(out)]
    answer = subprocess.run(command, capture_output=True, text=True, check=False, timeout=WATCHDOG,
                            env=os.environ | {"FSI_BIN": str(BIN)})
    return answer.returncode, (answer.stderr.strip().splitlines() or [""])[-1]


def one(seed, number, steps, most_work, folder):
    """What became of a case (`ran`, `refused`, `dear`, `FAILED`, `NO PLACE`), and a word about it."""
    name, text = outlines.case(seed, number)
    path = folder / f"{name}.yaml"
    path.write_text(text)
    code, found = checked(path)
    if code != 0:
        has_place = code == 2 and re.match(r".*\.yaml:\d+:\d+: ", found)
        return name, "refused" if has_place else "NO PLACE", found.split(": ", 2)[-1]
    cost = found["cost"]
    work = steps * cost["seconds"] / cost["steps"]
    if work > most_work:
        return name, "dear", f"{cost['steps']:.0f} steps, {cost['seconds']:.0f} s in all"
    code, words = ended(path, steps * cost["dt"], folder / name)
    return name, "ran" if code == 0 else "FAILED", words if code else f"dt {cost['dt']:.2g}"


def main():
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("--seed", type=int, default=1)
    options.add_argument("--from", type=int, default=0, dest="first")
    options.add_argument("--count", type=int, default=60)
    options.add_argument("--steps", type=int, default=50)
    options.add_argument("--only", default="", help="kinds with this word in their name")
    options.add_argument("--most-work", type=float, default=120, help="estimated seconds; dearer ones are only checked")
    chosen = options.parse_args()
    results = Counter()
    for number in range(chosen.first, chosen.first + chosen.count):
        if chosen.only not in outlines.KINDS[number % len(outlines.KINDS)].__name__:
            continue
        with tempfile.TemporaryDirectory() as folder:
            name, result, words = one(chosen.seed, number, chosen.steps, chosen.most_work, Path(folder))
        results[name.rsplit("_", 1)[0], result] += 1
        print(f"{name:16} {result:9} {words[:300]}", flush=True)
    print()
    for (kind, result), count in sorted(results.items()):
        print(f"{kind:12} {result:9} {count}")
    return 1 if any(result.isupper() for _, result in results) else 0


if __name__ == "__main__":
    sys.exit(main())
