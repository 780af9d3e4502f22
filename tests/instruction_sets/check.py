#!/usr/bin/python3
"""check.py [LEVEL ..]: the kernels compile without a warning for each level of x86-64 (default: v2 v3 v4), and on the levels
this processor can run, one case per law meets what it expects. For the widest of these the native build stands, which has all
its instructions and runs every case.

    --every     runs the cases on the widest level too
    --full      builds everything for these levels and runs all tests, for those the processor can run

Each level has a build folder build/march-LEVEL of its own; nothing is mixed, since the alignment of small matrices in memory
depends on the level. What no level changes (the case checker, fine reference solutions) is taken from build/release. Exit 1
with the first thing that failed. .ci/run does it without --full; a full build is made by hand now and then.
"""

import argparse
import os
import re
import subprocess
import sys
import tempfile
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
LEVELS = ("v2", "v3", "v4")
CASES = {"linear_elastic": "elastic_piston", "saint_venant_kirchhoff": "piston_svk", "neo_hookean": "piston_neo_hookean",
         "rigid": "rigid_piston"}
COMPUTING = ("fluid_solver", "coupler", *(f"solid_solver_{law}" for law in CASES))
LOADER = "/lib64/ld-linux-x86-64.so.2"  # of the C library, which knows what the processor can do


def laws():
    """All laws, from the one place that names them."""
    text = (ROOT / "solid_solver" / "CMakeLists.txt").read_text(encoding="utf-8")
    return re.findall(r"^fsi_(?:solid_solver\(|program\(solid_solver_)(\w+) ", text, flags=re.M)


def runs_here(level):
    answer = subprocess.run([LOADER, "--help"], capture_output=True, text=True, check=False)
    return re.search(rf"x86-64-{level} \(supported", answer.stdout) is not None


def do(*command, **environment):
    """Runs a command; its output is shown only where it fails."""
    answer = subprocess.run([str(word) for word in command], cwd=ROOT, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                            stderr=subprocess.STDOUT, text=True, check=False, env=os.environ | environment)
    if answer.returncode != 0:
        sys.exit(f"{answer.stdout[-6000:]}\n{' '.join(map(str, command))}: exit code {answer.returncode}")
    return answer.stdout


def configured(level, *settings):
    build = ROOT / "build" / f"march-{level}"
    do("cmake", "--preset", "release", "-B", build, "-D", f"FSI_MARCH=x86-64-{level}", "-D", "FSI_WERROR=ON", *settings)
    return build


def run_cases(build):
    """One case per law with the programs of this level."""
    with tempfile.TemporaryDirectory(prefix="fsi-march-") as scratch:
        programs = Path(scratch) / "bin"
        programs.mkdir()
        for program in (ROOT / "build" / "release" / "bin").iterdir():
            own = build / "bin" / program.name
            (programs / program.name).symlink_to(own if program.name in (*COMPUTING, "build.json") else program)
        for law in laws():
            do("launch/fsi", "run", CASES[law], "--out", Path(scratch) / law, FSI_BIN=str(programs))
            print(f"  {CASES[law]} ({law}) meets what it expects", flush=True)


def check(level, options):
    """One level of x86-64; prints what was seen."""
    start = time.monotonic()
    wider = [other for other in LEVELS if other > level and runs_here(other)]
    runs = runs_here(level)
    on_native = not wider and not (options.every or options.full)
    tested = "ON" if options.full else "OFF"
    build = configured(level, "-D", f"FSI_BENCH={tested}", "-D", f"BUILD_TESTING={tested}")
    targets = ["all"] if options.full else ["kernels"] if on_native or not runs else [*COMPUTING, "fsi_build_info"]
    do("cmake", "--build", build, "--target", *targets)
    print(f"x86-64-{level}: {', '.join(targets)} built without a warning", flush=True)
    if not runs:
        print("  this processor cannot run it", flush=True)
    elif options.full:
        print(do("ctest", "--test-dir", build, "-j", os.cpu_count() or 1, "--output-on-failure").split("\n\n")[-1], flush=True)
    elif on_native:
        print("  the native build runs all its instructions", flush=True)
    else:
        run_cases(build)
    print(f"  {time.monotonic() - start:.0f} s", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("levels", metavar="LEVEL", nargs="*", help="of v2 v3 v4")
    parser.add_argument("--every", action="store_true", help="cases on the widest level too")
    parser.add_argument("--full", action="store_true", help="everything, and all tests")
    options = parser.parse_args()
    if unknown := set(options.levels) - set(LEVELS):
        parser.error(f"no level {', '.join(sorted(unknown))}; there are {', '.join(LEVELS)}")
    if missing := set(laws()) - set(CASES):
        sys.exit(f"no case for the law {', '.join(sorted(missing))}: name one in CASES of {__file__}")
    if not options.full:
        if not (ROOT / "build" / "release" / "build.ninja").exists():
            do("cmake", "--preset", "release")
        do("cmake", "--build", ROOT / "build" / "release", "--target", "programs")
    for level in options.levels or LEVELS:
        check(level, options)


if __name__ == "__main__":
    main()
