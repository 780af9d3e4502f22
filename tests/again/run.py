#!/usr/bin/python3
"""Does the suite pass every time? Usage: tests/again/run.py [--times N] [--beside N] [--hogs N] [--show]

Runs `./launch/fsi test` N times in a row (default: 10), then --beside times (default: 3) beside --hogs processes (default: 4) that
do nothing but keep a core each busy, and prints a line for each. By hand, for it takes hours. Every suite that came to its end is
written down in docs/suites.json, those with failures too, with its commit and the processor; so days on several machines add up.
--show runs none and prints the last ones there, N and --beside of them: docs/record_results.py "The suite again and again" "The suite
beside busy processes" puts these tables into docs/results.md. What a suite with failures printed stays in build/again/BEGAN.log.
Exit 1 where a test failed, or fewer than so many were run.
"""

import argparse
import contextlib
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
KEPT = ROOT / "docs" / "suites.json"
NO_SOURCES = (":!docs", ":!*.md")   # of what is tested


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


def commit():
    """The commit of what is tested, with + where the sources are not quite those."""
    def git(*words):
        return subprocess.run(["git", *words], cwd=ROOT, capture_output=True, text=True, check=True).stdout.strip()
    return git("rev-parse", "--short=12", "HEAD") + ("+" if git("status", "--porcelain", "--", ".", *NO_SOURCES) else "")


def processor():
    found = re.search(r"^model name\s*:\s*(.+)$", Path("/proc/cpuinfo").read_text(encoding="utf-8"), re.MULTILINE)
    return f"{os.cpu_count()} of {found.group(1).strip() if found else 'unknown'}"


def written_down(path):
    """The suites that were run before, in their order."""
    return json.loads(path.read_text(encoding="utf-8")) if path.is_file() else []


def write_down(path, one):
    suites = [*written_down(path), one]
    new = path.with_suffix(".part")
    new.write_text("[\n" + ",\n".join(json.dumps(each) for each in suites) + "\n]\n", encoding="utf-8")
    new.replace(path)


def last(suites, busy, count):
    """The newest `count` of the suites that were run beside so many busy processes."""
    found = [one for one in suites if one["hogs"] == busy]
    return found[max(0, len(found) - count):]


def row(number, one):
    beside = f"{one['hogs']} busy processes" if one["hogs"] else "-"
    return (f"| {number} | {beside} | {one['began']} | {one['commit']} | {one['processor']} | {one['seconds']:.0f} | {one['passed']} | "
            f"{', '.join(one['failed']) or '-'} |")


def run(busy):
    """One suite and how it went."""
    began, of = time.strftime("%Y-%m-%d %H:%M"), commit()
    with hogs(busy):
        seconds, passed, failed = suite(LOGS / f"{began.replace(' ', '_')}.log")
    return {"hogs": busy, "began": began, "commit": of, "processor": processor(), "seconds": round(seconds), "passed": passed, "failed": failed}


def flawless(one):
    return one["passed"].startswith("100%") and not one["failed"]


def suites(chosen):
    """Those that are asked for, one after the other: run now, or as they were written down."""
    for busy, count in ((0, chosen.times), (chosen.hogs, chosen.beside)):
        if chosen.show:
            yield from last(written_down(KEPT), busy, count)
            continue
        for _ in range(count):
            one = run(busy)
            write_down(KEPT, one)
            yield one


def main():
    arguments = argparse.ArgumentParser(usage=__doc__)
    arguments.add_argument("--times", type=int, default=10)
    arguments.add_argument("--beside", type=int, default=3)
    arguments.add_argument("--hogs", type=int, default=4)
    arguments.add_argument("--show", action="store_true")
    chosen = arguments.parse_args()
    print("| | beside it | began | commit | processors | seconds | tests | failed |\n|---|---|---|---|---|---|---|---|", flush=True)
    told = []
    for one in suites(chosen):
        told.append(one)
        print(row(len(told), one), flush=True)
    wanted, flawed = chosen.times + chosen.beside, sum(not flawless(one) for one in told)
    print(f"\n{len(told)} of {wanted} suites, {flawed} with failures")
    return 0 if len(told) == wanted and not flawed else 1


if __name__ == "__main__":
    sys.exit(main())
