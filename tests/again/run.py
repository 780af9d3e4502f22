#!/usr/bin/python3
"""Does the suite pass every time? Usage: tests/again/run.py [--times N] [--beside N] [--hogs N]

Runs `./launch/fsi test` N times in a row (default: 10), then --beside times (default: 3) beside --hogs processes (default: 4) that
do nothing but keep a core each busy. Prints a line for each. By hand, for it takes hours; docs/record_results.py "The suite again
and again" "The suite beside busy processes" puts the tables into docs/results.md. What a suite with failures printed stays in
build/again/NUMBER.log. Exit 1 where a test failed.
"""

import argparse
import contextlib
import os
import re
import subprocess
import sys
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
FAILED = re.compile(r"^\s*\d+ - (\S+) \(", re.MULTILINE)
BUSY = "while True: pass"
LOGS = ROOT / "build" / "again"


@contextlib.contextmanager
def hogs(number):
    """So many processes that each keep a core busy."""
    busy = [subprocess.Popen([sys.executable, "-c", BUSY]) for _ in range(number)]
    try:
        yield
    finally:
        for one in busy:
            one.kill()
            one.wait()


def suite(log):
    """(seconds, CTest's line about how many passed, names of tests that did not). `log`: a file for what it printed, kept where not all passed."""
    start = time.monotonic()
    done = subprocess.run([ROOT / "launch" / "fsi", "test"], cwd=ROOT, capture_output=True, text=True, check=False)
    passed = re.search(r"\d+% tests passed.*", done.stdout)
    _, _, failed = done.stdout.partition("The following tests FAILED:")
    if done.returncode:
        LOGS.mkdir(parents=True, exist_ok=True)
        log.write_text(done.stdout + done.stderr, encoding="utf-8")
    return time.monotonic() - start, passed.group() if passed else f"exit code {done.returncode}: {done.stderr.strip()[-200:]}", FAILED.findall(failed)


def main():
    arguments = argparse.ArgumentParser(usage=__doc__)
    arguments.add_argument("--times", type=int, default=10)
    arguments.add_argument("--beside", type=int, default=3)
    arguments.add_argument("--hogs", type=int, default=4)
    chosen = arguments.parse_args()
    print(f"{os.cpu_count()} processors\n\n| | beside it | seconds | tests | failed |\n|---|---|---|---|---|", flush=True)
    every = True
    for number in range(chosen.times + chosen.beside):
        busy = 0 if number < chosen.times else chosen.hogs
        with hogs(busy):
            seconds, passed, failed = suite(LOGS / f"{number + 1}.log")
        every = every and passed.startswith("100%") and not failed
        line = f"| {number + 1} | {f'{busy} busy processes' if busy else '-'} | {seconds:.0f} | {passed} | {', '.join(failed) or '-'} |"
        print(line, flush=True)
        if not sys.stdout.isatty():  # who reads the table later wants to know how far it is
            print(line, file=sys.stderr, flush=True)
    return 0 if every else 1


if __name__ == "__main__":
    sys.exit(main())
