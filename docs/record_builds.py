"""The studies of record_results.py about builds and the suite: instruction sets, bare distributions, how often all passes."""

import json
import os
import re
import resource
import shlex
import shutil
import subprocess
import tempfile
import time
from pathlib import Path

FOLDERS = {"native": "release", "x86-64-v4": "march-v4", "x86-64-v3": "march-v3", "x86-64-v2": "march-v2"}  # by FSI_MARCH
ROUNDS = 7
BENCHES = [  # program, benchmark, what it is
    ("bench_gas", "advance_fluid/n:512/moving:0/limiter:1/riemann:0", "gas, Cartesian grid, Roe with limiter"),
    ("bench_gas", "advance_fluid/n:512/moving:1/limiter:1/riemann:0", "the same, curvilinear grid that moves"),
    ("bench_solid", "cartesian_svk_centred", "Saint Venant-Kirchhoff, Cartesian grid"),
    ("bench_solid", "curvilinear_svk_dissipation", "the same, curvilinear grid, with dissipation"),
    ("bench_solid", "cartesian_neo_hookean", "neo-Hookean, Cartesian grid"),
    ("bench_grid", "overlap_update/512", "overlap of two grids"),
]


def do(tools, *command):
    """Output of a command that must go well."""
    answer = subprocess.run(command, cwd=tools.ROOT, capture_output=True, text=True, check=False)
    if answer.returncode:
        raise SystemExit(f"{shlex.join(command)}: exit code {answer.returncode}: {answer.stdout[-500:]}{answer.stderr[-500:]}")
    return answer.stdout


def milliseconds(tools, folder, program, benchmark):
    """Processor time of one pass."""
    said = do(tools, f"build/{folder}/bin/{program}", f"--benchmark_filter=^{benchmark}$", "--benchmark_min_time=0.2",
              "--benchmark_format=json")
    entry = json.loads(said)["benchmarks"][0]
    return entry["cpu_time"] * {"ns": 1e-6, "us": 1e-3, "ms": 1, "s": 1e3}[entry["time_unit"]]


def instruction_sets(tools):
    """The same kernels compiled for several instruction sets, run in turns; the best of each counts."""
    programs = sorted({program for program, _, _ in BENCHES})
    for march, folder in FOLDERS.items():
        do(tools, "cmake", "--preset", "release", "-B", f"build/{folder}", "-D", f"FSI_MARCH={march}", "-D", "FSI_BENCH=ON")
        do(tools, "cmake", "--build", f"build/{folder}", "--target", *programs, "fsi_build_info")
    best = {}
    for _ in range(ROUNDS):
        for program, benchmark, what in BENCHES:
            for march, folder in FOLDERS.items():
                spent = milliseconds(tools, folder, program, benchmark)
                best[what, march] = min(best.get((what, march), spent), spent)
    built = json.loads((tools.ROOT / "build" / "release" / "bin" / "build.json").read_text(encoding="utf-8"))
    lines = ["| [ms] | " + " | ".join(FOLDERS) + " | v3 / native | v2 / native |", "|" + "---|" * (len(FOLDERS) + 3)]
    for _, _, what in BENCHES:
        times = [best[what, march] for march in FOLDERS]
        ratios = [best[what, f"x86-64-{level}"] / best[what, "native"] for level in ("v3", "v2")]
        lines.append("| " + " | ".join([what, *(f"{time:.2f}" for time in times), *(f"{ratio:.2f}" for ratio in ratios)]) + " |")
    return (f"Processor time of one pass over the points, the best of {ROUNDS} runs in turns; {built['compiler']}, native: "
            f"{built['instruction_set']}.\n\n`build/FOLDER/bin/PROGRAM --benchmark_filter=NAME` of builds by "
            "`cmake --preset release -B build/FOLDER -D FSI_MARCH=ISA`\n\n" + "\n".join(lines) + "\n")


def distributions(tools, *options):
    """The README's two commands on bare systems."""
    command = ["tests/distributions/run.sh", *options]
    if os.geteuid() != 0:
        return f"`{shlex.join(command)}`: needs root\n"
    answer = subprocess.run(command, cwd=tools.ROOT, capture_output=True, text=True, check=False)
    said = re.sub(r"(?m), see .*$", "", answer.stdout.strip())
    return f"`{shlex.join(command)}`, exit code {answer.returncode}\n\n```\n{said}\n```\n"


def levels(tools):
    """Everything built and tested for each level of x86-64."""
    command = ["tests/instruction_sets/check.py", "--full"]
    answer = subprocess.run(command, cwd=tools.ROOT, capture_output=True, text=True, check=False)
    return f"`{shlex.join(command)}`, exit code {answer.returncode}\n\n```\n{(answer.stdout + answer.stderr).strip()[-3000:]}\n```\n"


def again(tools, *options):
    """The last suites that were run, as they were written down."""
    command = ["tests/again/run.py", "--show", *options]
    answer = subprocess.run(command, cwd=tools.ROOT, stdout=subprocess.PIPE, text=True, check=False)
    return f"`{shlex.join(command)}`: the last that were run, by `tests/again/run.py` of each commit, on whatever machine\n\n{answer.stdout.strip()}\n"


def spent(command, folder):
    """(processor time, clock) of a command that must go well [s]."""
    def processor():
        used = resource.getrusage(resource.RUSAGE_CHILDREN)
        return used.ru_utime + used.ru_stime
    before, start = processor(), time.monotonic()
    answer = subprocess.run(command, shell=True, cwd=folder, stdin=subprocess.DEVNULL, capture_output=True, text=True, check=False)
    if answer.returncode:
        raise SystemExit(f"{command}: exit code {answer.returncode}: {answer.stderr[-500:]}")
    return processor() - before, time.monotonic() - start


def first_case(tools):
    """The README's first command and those of docs/first_case.md, typed one after the other in a fresh clone."""
    blocks = [block.strip() for block in (tools.ROOT / "docs" / "first_case.md").read_text(encoding="utf-8").split("```")[1::2]]
    typed = [line for block in blocks for line in block.splitlines() if line.startswith("./launch/fsi")]
    first_picture = next(line for line in typed if line.startswith("./launch/fsi plot"))
    lines = ["| command | processor time [s] | clock [s] |", "|---|---|---|"]
    total = [0.0, 0.0]
    with tempfile.TemporaryDirectory(prefix="fsi-first-case-") as scratch:
        clone = Path(scratch) / "amp-fsi"
        do(tools, "git", "clone", "-q", str(tools.ROOT), str(clone))
        (clone / "bean.csv").write_text(next(block for block in blocks if block.startswith("#")), encoding="utf-8")
        for command in ["./launch/fsi run elastic_piston", *typed]:
            times = spent(command, clone)
            total = [sum(pair) for pair in zip(total, times)]
            lines.append(f"| `{command}` | {times[0]:.1f} | {times[1]:.1f} |")
            if command == first_picture:
                lines.append(f"| **until here** | **{total[0]:.0f}** | **{total[1]:.0f}** |")
    cache = "with" if shutil.which("ccache") else "without"
    return (f"Typed in a fresh clone, {cache} a compiler's cache, on {os.cpu_count()} processors, the packages installed "
            f"(load before it: {os.getloadavg()[0]:.1f}).\n\n" + "\n".join(lines) + "\n")


def studies(tools):
    yield "From clone to pictures of one's own", lambda: first_case(tools)
    yield "Kernels by instruction set: what a portable build costs", lambda: instruction_sets(tools)
    yield "The two commands on bare Debians", lambda: distributions(tools)
    yield "All tests on each level of x86-64", lambda: levels(tools)
    yield "The suite again and again", lambda: again(tools, "--beside", "0")
    yield "The suite beside busy processes", lambda: again(tools, "--times", "0")
