#!/usr/bin/python3
"""check.py [LEVEL ..]: the kernels compile without a warning for each level of x86-64 (default: v2 v3 v4), and on the levels
this processor can run, one case per law meets what it expects. For the widest of these the native build stands, which has all
its instructions and runs every case.

    --every     runs the cases on the widest level too
    --full      builds everything for these levels and runs all tests, for those the processor can run

Each level has a build folder build/march-LEVEL of its own. Without --full it holds the kernels alone: the programs of a level
are those of build/release, linked once more with its kernels in front of the native ones. Exit 1 with the first thing that
failed. .ci/run does it without --full; a full build is made by hand now and then.
"""

import argparse
import os
import re
import shlex
import subprocess
import sys
import tempfile
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
RELEASE = ROOT / "build" / "release"
LEVELS = ("v2", "v3", "v4")
CASES = {"linear_elastic": "elastic_piston", "saint_venant_kirchhoff": "piston_svk", "neo_hookean": "piston_neo_hookean",
         "mooney_rivlin": "piston_neo_hookean --solid solid=mooney_rivlin --set solids.solid.c01=0.13",
         "gent": "piston_neo_hookean --solid solid=gent --set solids.solid.J_m=8", "rigid": "rigid_piston", "beam": "plate"}
COMPUTING = ("fluid_solver", "coupler", *(f"solid_solver_{law}" for law in CASES))
LOADER = "/lib64/ld-linux-x86-64.so.2"  # of the C library, which knows what the processor can do


def laws():
    """All laws, and what stands where a law stands, from the two places that name them."""
    folder = ROOT / "solid_solver"
    return [*re.findall(r"^fsi_kind\(law (\w+) ", (folder / "kinds.cmake").read_text(encoding="utf-8"), flags=re.M),
            *re.findall(r"^fsi_program\(solid_solver_(\w+) ", (folder / "CMakeLists.txt").read_text(encoding="utf-8"), flags=re.M)]


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


def link(program, build, folder):
    """A native program with the kernels of another level in front of its own, which the linker then passes over (it would name
    any that is there twice)."""
    lines = do("ninja", "-C", RELEASE, "-t", "commands", f"bin/{program}").splitlines()
    words = shlex.split(next(line for line in reversed(lines) if f"-o bin/{program}" in line))
    words = words[words.index("&&") + 1:words.index("&&", words.index("&&") + 1)]
    objects = [kernel for library in words if (found := re.fullmatch(r"(\S*?)lib(\w+)\.a", library))
               for kernel in sorted((build / found[1] / "CMakeFiles" / f"{found[2]}_kernels.dir").rglob("*.o"))]
    if not objects:
        sys.exit(f"{program}: its link command names no library with kernels")
    at = words.index("-o")
    words[at:at + 2] = ["-o", str(folder / program), *map(str, objects)]
    answer = subprocess.run(words, cwd=RELEASE, capture_output=True, text=True, check=False)
    if answer.returncode != 0:
        sys.exit(f"{answer.stderr[-6000:]}\n{program} with the kernels of {build.name}: exit code {answer.returncode}")


def run_cases(build):
    """One case per law with the kernels of this level."""
    with tempfile.TemporaryDirectory(prefix="fsi-march-") as scratch:
        programs = Path(scratch) / "bin"
        programs.mkdir()
        for program in (RELEASE / "bin").iterdir():
            if program.name in COMPUTING:
                link(program.name, build, programs)
            else:
                (programs / program.name).symlink_to(program)
        for law in laws():
            do("launch/fsi", "run", *CASES[law].split(), "--out", Path(scratch) / law, FSI_BIN=str(programs))
            print(f"  {CASES[law]} ({law}) meets what it expects", flush=True)


def check(level, options):
    """One level of x86-64; prints what was seen."""
    start = time.monotonic()
    wider = [other for other in LEVELS if other > level and runs_here(other)]
    runs = runs_here(level)
    on_native = not wider and not (options.every or options.full)
    tested = "ON" if options.full else "OFF"
    build = configured(level, "-D", f"FSI_BENCH={tested}", "-D", f"BUILD_TESTING={tested}")
    targets = ["all"] if options.full else ["kernels"]
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
    if different := set(laws()) ^ set(CASES):
        sys.exit(f"{', '.join(sorted(different))}: a law without a case, or a case without a law, in CASES of {__file__}")
    if not options.full:
        if not (RELEASE / "build.ninja").exists():
            do("cmake", "--preset", "release")
        do("cmake", "--build", RELEASE, "--target", "programs")
    for level in options.levels or LEVELS:
        check(level, options)


if __name__ == "__main__":
    main()
