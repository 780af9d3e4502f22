#!/usr/bin/python3
"""Does the suite notice a wrong sign? Usage: tests/mutations/run.py [--only WORD] [--copies N] [--list] [--check]

Takes a copy of the source tree in build/mutations (or N of them, which work side by side), makes one change of table.py at
a time there, builds the program with the tests that should notice, and runs them; where they do not, the rest of that program
too. --only takes the mutations with WORD in their name, --list shows them, --check only sees whether the table fits the
tree. By hand, since it compiles something for every mutation; docs/record_results.py "Changed sources" puts the table into
docs/results.md. Exit 1 where one goes unnoticed.
"""

import argparse
import os
import queue
import re
import shutil
import subprocess
import sys
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))
sys.dont_write_bytecode = True
from table import MUTATIONS  # noqa: E402

ROOT = Path(__file__).resolve().parents[2]
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


class Copy:
    """A copy of the tree with a build of its own."""

    def __init__(self, number):
        self.root = ROOT / "build" / "mutations" / str(number)
        self.build_folder = self.root / "build" / "release"
        self.ready = False

    def refresh(self):
        """The tree as it is; files that are the same keep their times, so that nothing is built twice."""
        wanted = set()
        for folder, names, entries in os.walk(ROOT):
            relative = Path(folder).relative_to(ROOT)
            names[:] = [name for name in names if not (name in LEFT_OUT and relative == Path("."))]
            for entry in entries:
                source, target = ROOT / relative / entry, self.root / relative / entry
                wanted.add(target)
                if not target.is_file() or target.read_bytes() != source.read_bytes():
                    target.parent.mkdir(parents=True, exist_ok=True)
                    shutil.copy2(source, target)
                    os.utime(target)
        for target in self.root.rglob("*"):
            if target.is_file() and target not in wanted and "build" not in target.relative_to(self.root).parts:
                target.unlink()

    def run(self, *command):
        surroundings = dict(os.environ)
        if shutil.which("ccache"):  # what is changed back need not be compiled again
            for key, value in (("CMAKE_CXX_COMPILER_LAUNCHER", "ccache"), ("CCACHE_BASEDIR", str(self.root)),
                               ("CCACHE_NOHASHDIR", "1")):
                surroundings.setdefault(key, value)
        return subprocess.run(command, cwd=self.root, env=surroundings, capture_output=True, text=True, check=False)

    def build(self, target):
        return self.run("ninja", "-C", str(self.build_folder), target).returncode == 0

    def prepare(self):
        """The tree, configured."""
        if self.ready:
            return
        self.root.mkdir(parents=True, exist_ok=True)
        self.refresh()
        configured = self.run("cmake", "--preset", "release")
        if configured.returncode != 0:
            raise RuntimeError(configured.stdout + configured.stderr)
        self.ready = True

    def tests_fail(self, target, tests):
        """Name of the first test of a filter that fails, "" where none does; a crash or a hang counts."""
        command = [str(self.build_folder / "bin" / target), f"--gtest_filter={tests}", "--gtest_fail_fast"]
        try:
            done = subprocess.run(command, cwd=self.root, capture_output=True, text=True, check=False, timeout=600)
        except subprocess.TimeoutExpired:
            return f"{target} (did not end)"
        if done.returncode == 0:
            return "" if "[  PASSED  ] 0 tests" not in done.stdout else f"{target} (has no {tests})"
        failed = re.search(r"^\[  FAILED  \] ([^\s,]+\.[^\s,]+)", done.stdout, re.MULTILINE)
        return failed.group(1) if failed else f"{target} (ended with {done.returncode})"

    def try_one(self, mutation):
        """What noticed a mutation, "" for nothing."""
        _, file, text, replacement, target, tests = mutation
        path = self.root / file
        original = path.read_text(encoding="utf-8")
        try:
            path.write_text(original.replace(text, replacement), encoding="utf-8")
            if not self.build(target):
                return "the compiler"
            return self.tests_fail(target, tests) or self.tests_fail(target, "*")
        finally:
            path.write_text(original, encoding="utf-8")

    def try_all(self, target, mutations):
        """{mutation: what noticed it} of one target."""
        self.prepare()
        if not self.build(target):
            raise RuntimeError(f"{target} does not build")
        for tests in sorted({mutation[5] for mutation in mutations}):
            if failing := self.tests_fail(target, tests):
                raise RuntimeError(f"{failing} fails without any mutation")
        found = {}
        for mutation in mutations:
            start = time.monotonic()
            found[mutation] = self.try_one(mutation)
            told = f"noticed by {found[mutation]}" if found[mutation] else "NOT NOTICED"
            print(f"{mutation[0]}: {told}, {time.monotonic() - start:.0f} s", file=sys.stderr, flush=True)
        return found


def table_of(results):
    lines = ["| mutation | in | first test that fails |", "|---|---|---|"]
    lines += [f"| {name} | `{file}` | {f'`{noticed}`' if noticed else 'none'} |" for (name, file, *_), noticed in results.items()]
    return "\n".join(lines)


def try_mutations(mutations, copies):
    """{mutation: what noticed it}, the tests of one program after the other in each copy."""
    free = queue.SimpleQueue()
    for number in range(copies):
        free.put(Copy(number))

    def work(target):
        copy = free.get()
        try:
            return copy.try_all(target, [mutation for mutation in mutations if mutation[4] == target])
        finally:
            free.put(copy)

    found = {}
    with ThreadPoolExecutor(copies) as pool:
        for part in pool.map(work, dict.fromkeys(mutation[4] for mutation in mutations)):
            found |= part
    return {mutation: found[mutation] for mutation in mutations}


def main():
    arguments = argparse.ArgumentParser(usage=__doc__)
    arguments.add_argument("--only", default="")
    arguments.add_argument("--copies", type=int, default=1)
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
    results = try_mutations(mutations, chosen.copies)
    missed = sum(not noticed for noticed in results.values())
    print(f"{len(results)} mutations, {missed} not noticed\n\n{table_of(results)}")
    return 1 if missed else 0


if __name__ == "__main__":
    sys.exit(main())
