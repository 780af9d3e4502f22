#!/usr/bin/python3
"""Times a gas alone on 1024 x 1024 points with one rank and with several, in turn, and prints a table for docs/scaling.md.

record_ranks.py [--ranks N,N,..] [--repeat K] [--steps S] [--case CASE [--who NAME] [--set KEY=VALUE ..]]

NAME: who has the ranks and is timed (default: fluid). STUDIES has the commands of docs/results.md. An ellipse in a gas:
record_ranks.py --case shock_ellipse --who ellipse --set grid.factor=16 --set time.end=0.03 --set output={} --set expect={}
"""

import argparse
import json
import os
import re
import resource
import shlex
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
SQUARE = ["fluid.grid={x: [0, 1], y: [0, 1], spacing: 1/1023}", "time.dt=3e-4", "output.times=[]", "reference={kind: none}", "expect={}"]

# What docs/results.md has: a gas alone on one grid and on three levels, and a solid alone.
STUDIES = (("gas, 1024 x 1024 points", ["--steps", "240"]),
           ("gas on three levels, the finest of 2048 x 2048 points around a shock, a contact and a rarefaction",
            ["--set", "fluid.grid={x: [0, 1], y: [0, 1], spacing: 1/2047, levels: 3}", "--set", "output.times=[]", "--set", "reference={kind: none}",
             "--set", "expect={}", "--set", "time.end=0.03"]),
           ("solid, 501 x 501 points", ["--case", "spinning_block", "--who", "block", "--set", "grid.factor=50", "--set", "time.end=0.1", "--set", "output={}",
                                        "--set", "expect={}"]))


def studies(_tools):
    """(title, function) for docs/record_results.py."""
    def tables():
        for what, words in STUDIES:
            said = subprocess.run([sys.executable, __file__, *words], check=True, capture_output=True, text=True).stdout
            yield f"{what[0].upper() + what[1:]}: `docs/record_ranks.py {shlex.join(words)}`\n\n{said}"
    yield "Two ranks against one", lambda: "\n".join(tables())


def measured(folder, ranks, options):
    """What a run with so many ranks took: {name: number}."""
    command = [ROOT / "launch" / "fsi", "run", options.case, "--out", folder, "--no-progress", "--ranks", f"{options.who}={ranks}"]
    settings = options.set or [*SQUARE, f"time.end={3e-4 * options.steps}"]
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    begun = time.monotonic()
    subprocess.run([*command, *(f"--set={one}" for one in settings)], check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    part = json.loads((Path(folder) / "parts" / f"{options.who}.json").read_text(encoding="utf-8"))
    log = (Path(folder) / "log" / f"{options.who}.log").read_text(encoding="utf-8")
    sent = re.search(r"sent (\S+) messages with (\S+) numbers; (\S+) numbers came", log)
    return {"step": 1e3 * (part["compute_s"] - part["time_s"]["output"]) / part["steps"],
            "cpu": after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime, "wall": time.monotonic() - begun,
            "steps": part["steps"], "messages": float(sent.group(1)) / part["steps"] if sent else 0,
            "numbers": float(sent.group(2)) / part["steps"] if sent else 0, "memory": part["peak_memory_mib"]}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--ranks", default="1,2")
    parser.add_argument("--repeat", type=int, default=7)
    parser.add_argument("--steps", type=int, default=40)
    parser.add_argument("--case", default="sod_tube")
    parser.add_argument("--who", metavar="NAME", default="fluid")
    parser.add_argument("--set", action="append", default=[])
    options = parser.parse_args()
    counts = [int(word) for word in options.ranks.split(",")]
    results = {count: [] for count in counts}
    with tempfile.TemporaryDirectory() as scratch:
        for turn in range(options.repeat):
            for count in counts:
                results[count].append(measured(f"{scratch}/{turn}-{count}", count, options))
    ahead = " at real-time priority" if os.sched_getscheduler(0) in (os.SCHED_RR, os.SCHED_FIFO) else ""
    print(f"{options.case}{ahead}, load {os.getloadavg()[0]:.1f}; medians of {options.repeat}, in turn; what else the machine does only adds to the least\n")
    print("| ranks | a step [ms] | the least | times as fast | of the least | processor time [s] | messages of rank 0 a step | numbers in them "
          "| memory of rank 0 [MiB] |")
    print("|---|---|---|---|---|---|---|---|---|")

    def middle(name, of):
        return statistics.median(one[name] for one in results[of])

    def least(of):
        return min(one["step"] for one in results[of])

    first = counts[0]
    for count in counts:
        print(f"| {count} | {middle('step', count):.1f} | {least(count):.1f} | {middle('step', first) / middle('step', count):.2f} | "
              f"{least(first) / least(count):.2f} | {middle('cpu', count):.1f} | {middle('messages', count):.1f} | "
              f"{middle('numbers', count):.0f} | {middle('memory', count):.0f} |")


if __name__ == "__main__":
    main()
