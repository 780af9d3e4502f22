#!/usr/bin/python3
"""Does the suite notice a wrong sign? Usage: tests/mutations/run.py [--only WORD] [--list] [--check]

Takes a copy of the source tree in build/mutations, makes one change of table.py at a time there, builds the program with the
tests that should notice, and runs them; where they do not, the rest of that program too. --only takes the mutations with
WORD in their name, --list shows them, --check only sees whether the table fits the tree. By hand (it compiles something for
every mutation); docs/record_results.py "Changed sources" puts the table into docs/results.md. Exit 1 where one goes unnoticed.
"""

import argparse
import os
import re
import shutil
import subprocess
import sys
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))
sys.dont_write_bytecode = True
from table import MUTATIONS  # noqa: E402

ROOT = Path(__file__).resolve().parents[2]
COPY = ROOT / "build" / "mutations"
BUILD = COPY / "build" / "release"
LEFT_OUT = ("build", "runs", ".git", "docs")


def misfits(root=ROOT):
    """What of the table does not fit the tree."""
    seen = set()
    lists = "".join(path.read_text(encoding="utf-8") for path in root.glob("tests/*/*/CMakeLists.txt"))
    for name, file, text, replacement, target, _ in MUTATIONS:
        path = root / file
        if not path.is_file():
            yield f"{name}: {file} is not there"
            continue
        found = path.read_text(encoding="utf-8").count(text)
        if found != 1:
            yield f"{name}: {text!r} occurs {found} times in {file}, not once"
        if text == replacement or (file, text, replacement) in seen:
            yield f"{name}: changes nothing, or the same as another"
        seen.add((file, text, replacement))
        if f"fsi_test({target} " not in lists:
            yield f"{name}: no tests are called {target}"


def refresh_copy():
    """The tree as it is; files that are the same keep their times, so that nothing is built twice."""
    wanted = set()
    for folder, names, entries in os.walk(ROOT):
        relative = Path(folder).relative_to(ROOT)
        names[:] = [name for name in names if not (name in LEFT_OUT and relative == Path("."))]
        for entry in entries:
            source, target = ROOT / relative / entry, COPY / relative / entry
            wanted.add(target)
            if not target.is_file() or target.read_bytes() != source.read_bytes():
                target.parent.mkdir(parents=True, exist_ok=True)
                shutil.copy2(source, target)
                os.utime(target)
    for target in COPY.rglob("*"):
        if target.is_file() and target not in wanted and "build" not in target.relative_to(COPY).parts:
            target.unlink()


def run(*command):
    surroundings = dict(os.environ)
    if shutil.which("ccache"):  # what is changed back need not be compiled again
        for key, value in (("CMAKE_CXX_COMPILER_LAUNCHER", "ccache"), ("CCACHE_BASEDIR", str(COPY)), ("CCACHE_NOHASHDIR", "1")):
            surroundings.setdefault(key, value)
    return subprocess.run(command, cwd=COPY, env=surroundings, capture_output=True, text=True, check=False)


def build(target):
    return run("ninja", "-C", str(BUILD), target).returncode == 0


def tests_fail(target, tests):
    """Name of the first test of a filter that fails, "" where none does; a crash or a hang counts."""
    command = [str(BUILD / "bin" / target), f"--gtest_filter={tests}", "--gtest_fail_fast"]
    try:
        done = subprocess.run(command, cwd=COPY, capture_output=True, text=True, check=False, timeout=600)
    except subprocess.TimeoutExpired:
        return f"{target} (did not end)"
    if done.returncode == 0:
        return "" if "[  PASSED  ] 0 tests" not in done.stdout else f"{target} (has no {tests})"
    failed = re.search(r"^\[  FAILED  \] ([^\s,]+\.[^\s,]+)", done.stdout, re.MULTILINE)
    return failed.group(1) if failed else f"{target} (ended with {done.returncode})"


def try_one(mutation):
    """What noticed a mutation, and the seconds it took to build and to test."""
    _, file, text, replacement, target, tests = mutation
    path = COPY / file
    original = path.read_text(encoding="utf-8")
    start = time.monotonic()
    try:
        path.write_text(original.replace(text, replacement), encoding="utf-8")
        if not build(target):
            return "the compiler", time.monotonic() - start, 0.0
        built = time.monotonic()
        noticed = tests_fail(target, tests) or tests_fail(target, "*")
        return noticed, built - start, time.monotonic() - built
    finally:
        path.write_text(original, encoding="utf-8")


def table_of(results):
    lines = ["| mutation | in | first test that fails |", "|---|---|---|"]
    lines += [f"| {name} | `{file}` | {f'`{noticed}`' if noticed else 'none'} |" for (name, file, *_), (noticed, *_) in results]
    return "\n".join(lines)


def prepare(targets):
    """A copy that is built and whose tests pass."""
    COPY.mkdir(parents=True, exist_ok=True)
    refresh_copy()
    configured = run("cmake", "--preset", "release")
    if configured.returncode != 0:
        sys.exit(configured.stdout + configured.stderr)
    for target in sorted(targets):
        if not build(target):
            sys.exit(f"{target} does not build")


def main():
    arguments = argparse.ArgumentParser(usage=__doc__)
    arguments.add_argument("--only", default="")
    arguments.add_argument("--list", action="store_true")
    arguments.add_argument("--check", action="store_true")
    chosen = arguments.parse_args()
    if problems := list(misfits()):
        print("\n".join(problems))
        return 1
    mutations = [mutation for mutation in MUTATIONS if chosen.only in mutation[0]]
    if chosen.check or chosen.list:
        print("\n".join(mutation[0] for mutation in mutations) if chosen.list else f"{len(MUTATIONS)} mutations fit the tree")
        return 0
    prepare({mutation[4] for mutation in mutations})
    for target, tests in sorted({mutation[4:6] for mutation in mutations}):
        if failing := tests_fail(target, tests):
            print(f"{failing} fails without any mutation")
            return 1
    results = []
    for mutation in mutations:
        noticed, built, tested = try_one(mutation)
        told = f"noticed by {noticed}" if noticed else "NOT NOTICED"
        print(f"{mutation[0]}: {told}, {built:.0f} + {tested:.1f} s", file=sys.stderr, flush=True)
        results.append((mutation, (noticed, built, tested)))
    missed = sum(not noticed for _, (noticed, _, _) in results)
    print(f"{len(results)} mutations, {missed} not noticed\n\n{table_of(results)}")
    return 1 if missed else 0


if __name__ == "__main__":
    sys.exit(main())
