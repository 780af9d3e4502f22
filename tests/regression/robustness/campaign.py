#!/usr/bin/python3
"""Does what `check` calls valid run? Usage: tests/regression/robustness/campaign.py [--seed N] [--from K] [--count N] [--steps N] [--only WORD]

Makes random outlines (outlines.py): splines, polygons with sharp corners, bodies 2 to 50 times as long as thick, pairs 20 h to 2 h
apart, bodies near a wall and on it; rigid ones and elastic ones. Checks each and runs it while a shock of Mach 1.5, two spacings
away at first, meets it: so many steps, and on until it has gone six spacings. Prints a line for each (time step, largest
pressure on a body in parts of that behind the shock, amplification of implicit interpolation where there is any) and tables.

Exit 1 where a case that `check` calls valid does not come to its end, where the shock did not meet its body, where a refusal has no
place in the file, or (of twenty cases at least) where `check` calls fewer than 95 % of the roomy cases valid: those with thickness and gaps of four
spacings and corners of 30 degrees. The same seed makes the same cases. `robustness.outlines` of the suite runs a dozen. Programs: build/release/bin, or $FSI_BIN.
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
SEEN = 6 * outlines.H / outlines.MACH  # time in which the shock goes six spacings
WRONG = ("FAILED", "NO PLACE", "NOT HIT")


def checked(path):
    """Exit code and what the programs need to know, or the message."""
    answer = subprocess.run([BIN / "fsi_case", "check", str(path), "--json"], capture_output=True, text=True, check=False)
    return answer.returncode, json.loads(answer.stdout) if answer.returncode == 0 else answer.stderr.strip()


def ended(path, end, out):
    """Exit code, last words and summary of a run to `end`."""
    command = [ROOT / "launch" / "fsi", "run", str(path), "--set", f"time.end={end}", "--no-progress", "--overwrite", "--out", str(out)]
    answer = subprocess.run(command, capture_output=True, text=True, check=False, timeout=WATCHDOG,
                            env=os.environ | {"FSI_BIN": str(BIN)})
    summary = out / "summary.json"
    found = json.loads(summary.read_text(encoding="utf-8")) if summary.is_file() else {}
    words = [line for line in answer.stderr.strip().splitlines() if line.strip()] or [""]
    return answer.returncode, found.get("failure", {}).get("what") or words[-1], found


def became(case, path, options):
    """What became of a case (`ran`, `refused`, `dear` or one of WRONG), and words about it."""
    path.write_text(case.text, encoding="utf-8")
    code, found = checked(path)
    if code != 0:
        has_place = code == 2 and re.match(r".*\.yaml:\d+:\d+: ", found)
        return "refused" if has_place else "NO PLACE", found.split(": ", 2)[-1]
    cost = found["cost"]
    end = max(options.steps * cost["dt"], SEEN)
    work = end / cost["dt"] * cost["seconds"] / cost["steps"]
    if work > options.most_work:
        return "dear", f"{end / cost['dt']:.0f} steps, {work:.0f} s"
    code, words, summary = ended(path, end, path.with_suffix(""))
    if code:
        return "FAILED", words
    pressure = 1.4 * summary["interface"]["traction_scale"] / outlines.BEHIND_SHOCK  # p_0 is 1 / gamma
    overlap = summary.get("overlap", {})
    amplification = max((grids["amplification"] for grids in overlap.values()), default=1)
    said = f"dt {cost['dt']:.2g}, pressure {pressure:.2f}" + (f", amplification {amplification:.3g}" if amplification > 1 else "")
    return "ran" if pressure > 0.75 else "NOT HIT", said


def table_of(results):
    """One row per kind: cases, how many of them `check` calls valid, ran, and what else became of them."""
    rows = ["| outlines | cases | `check` says valid | ran | too dear to run | failed | roomy ones | of these valid |", "|" + "---|" * 8]
    kinds = list(dict.fromkeys(case.kind for case, _ in results))
    for kind in [*kinds, "all"]:
        own = [(case, result) for case, result in results if kind in (case.kind, "all")]
        count = Counter(result for _, result in own)
        roomy = [result for case, result in own if case.is_roomy()]
        valid = sum(result not in ("refused", "NO PLACE") for _, result in own)
        valid_roomy = sum(result not in ("refused", "NO PLACE") for result in roomy)
        rows.append(f"| {kind.replace('_', ' ')} | {len(own)} | {valid} | {count['ran']} | {count['dear']} | "
                    f"{sum(count[word] for word in WRONG)} | {len(roomy)} | {valid_roomy} |")
    return "\n".join(rows)


def is_sound(results):
    """No failures, and 95 % of the roomy cases are valid, where there are enough to say so."""
    roomy = [result for case, result in results if case.is_roomy()]
    valid = sum(result not in ("refused", "NO PLACE") for result in roomy)
    enough = len(roomy) < 20 or valid >= 0.95 * len(roomy)
    return enough and not any(result in WRONG for _, result in results)


def main():
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("--seed", type=int, default=1)
    options.add_argument("--from", type=int, default=0, dest="first")
    options.add_argument("--count", type=int, default=300)
    options.add_argument("--steps", type=int, default=50)
    options.add_argument("--only", default="", help="kinds with this word in their name")
    options.add_argument("--most-work", type=float, default=30, help="estimated seconds; dearer ones are only checked")
    options.add_argument("--keep", type=Path, help="folder in which cases and runs stay")
    chosen = options.parse_args()
    results = []
    for number in range(chosen.first, chosen.first + chosen.count):
        case = outlines.case(chosen.seed, number)
        if chosen.only not in case.kind:
            continue
        with tempfile.TemporaryDirectory() as scratch:
            folder = chosen.keep or Path(scratch)
            folder.mkdir(parents=True, exist_ok=True)
            result, words = became(case, folder / f"{case.name}.yaml", chosen)
        results.append((case, result))
        print(f"{case.name:16} {'roomy ' if case.is_roomy() else '':6}{result:9} {words[:400]}", flush=True)
    print(f"\n{table_of(results)}")
    return 0 if is_sound(results) else 1


if __name__ == "__main__":
    sys.exit(main())
