#!/usr/bin/python3
"""Does the suite pass every time? Usage: tests/again/run.py [--times N] [--beside N] [--hogs N] [--go-on]

Runs `./launch/fsi test` N times in a row (default: 10), then --beside times (default: 3) beside --hogs processes (default: 4) that
do nothing but keep a core each busy. Prints a line for each. By hand, for it takes hours; docs/record_results.py "The suite again
and again" "The suite beside busy processes" puts the tables into docs/results.md. What a suite with failures printed stays in
build/again/NUMBER.log. --go-on counts the suites that it has run before, whole, of the same sources: all of them, those with failures
too, as build/again/suites.json tells. Exit 1 where a test failed.
"""

import argparse
import contextlib
import hashlib
import json
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
KEPT = LOGS / "suites.json"
WORDS = ("docs", "*.md")    # no source of what is tested


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


def sources():
    """What tells the tested sources from others."""
    def git(*words):
        return subprocess.run(["git", *words, "--", ".", *(f":!{one}" for one in WORDS)], cwd=ROOT, capture_output=True, text=True, check=True).stdout
    return hashlib.sha256((git("ls-files", "-s") + git("diff", "HEAD")).encode()).hexdigest()


def kept(of):
    """The suites that were run of these sources."""
    with contextlib.suppress(OSError, ValueError):
        found = json.loads(KEPT.read_text(encoding="utf-8"))
        return found["suites"] if found["sources"] == of else []
    return []


def keep(of, suites):
    LOGS.mkdir(parents=True, exist_ok=True)
    new = KEPT.with_suffix(".part")
    new.write_text(json.dumps({"sources": of, "suites": suites}, indent=1), encoding="utf-8")
    new.replace(KEPT)


def row(number, one):
    beside = f"{one['hogs']} busy processes" if one["hogs"] else "-"
    return f"| {number} | {beside} | {one['began']} | {one['seconds']:.0f} | {one['passed']} | {', '.join(one['failed']) or '-'} |"


def run(busy, log):
    """One suite and how it went."""
    began = time.strftime("%Y-%m-%d %H:%M")
    with hogs(busy):
        seconds, passed, failed = suite(log)
    return {"hogs": busy, "began": began, "seconds": seconds, "passed": passed, "failed": failed}


def main():
    arguments = argparse.ArgumentParser(usage=__doc__)
    arguments.add_argument("--times", type=int, default=10)
    arguments.add_argument("--beside", type=int, default=3)
    arguments.add_argument("--hogs", type=int, default=4)
    arguments.add_argument("--go-on", action="store_true")
    chosen = arguments.parse_args()
    of = sources()
    former = kept(of) if chosen.go_on else []
    told = []
    print(f"{os.cpu_count()} processors\n\n| | beside it | began | seconds | tests | failed |\n|---|---|---|---|---|---|", flush=True)
    for busy in [0] * chosen.times + [chosen.hogs] * chosen.beside:
        one = next((old for old in former if old["hogs"] == busy), None)
        if one:
            former.remove(one)
        else:
            one = run(busy, LOGS / f"{len(told) + 1}.log")
            keep(of, [*kept(of), one])
        told.append(one)
        line = row(len(told), one)
        print(line, flush=True)
        if not sys.stdout.isatty():  # who reads the table later wants to know how far it is
            print(line, file=sys.stderr, flush=True)
    return 0 if all(one["passed"].startswith("100%") and not one["failed"] for one in told) else 1


if __name__ == "__main__":
    sys.exit(main())
