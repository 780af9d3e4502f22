#!/usr/bin/python3
"""No test depends on how long anything takes. Usage: check_waits.py [ROOT]

Tests read no clock and do not sleep: they wait for conditions (`until`), with a watchdog, or let a time pass in which nothing must
happen (`let_pass`). Both are at home in the files below, and so is whoever lets programs outside wait for each other.
"""

import os
import re
import sys
from pathlib import Path

HOMES = {"tests/waiting.hpp", "tests/programs/running.py", "tests/programs/monitor/browser.py", "tests/unit/launch/launcher.py"}
# Checks of the sources, and tools that say how long they took and judge nothing by it.
NO_TESTS = ("tests/structure/", "tests/mutations/", "tests/instruction_sets/", "tests/again/")
CLOCKS = {
    ".py": re.compile(r"\btime\.(sleep|monotonic|perf_counter|process_time|time)\(|\btimeout=\d|\buntil\(.*,\s*[\d.]+\)"),
    ".cpp": re.compile(r"\b(sleep_for|sleep_until|usleep|nanosleep|sleep)\(|\b(steady|system|high_resolution)_clock\b|"
                       r"\bClock::now\("),
}
CLOCKS[".hpp"] = CLOCKS[".cpp"]


def offences(root):
    """Places in the tests that read a clock or sleep."""
    for path in sorted((root / "tests").rglob("*")):
        name = path.relative_to(root).as_posix()
        if path.suffix not in CLOCKS or name in HOMES or name.startswith(NO_TESTS):
            continue
        for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), start=1):
            if found := CLOCKS[path.suffix].search(line):
                yield (f"{name}:{number}: '{found.group()}' in a test: wait for a condition (until), or let_pass where nothing "
                       "must happen")


def main(arguments):
    root = Path(arguments[0] if arguments else os.environ.get("FSI_ROOT", Path(__file__).resolve().parents[2]))
    found = list(offences(root))
    print("\n".join(found) if found else "waits: nothing to complain about")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
