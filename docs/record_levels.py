"""The study of record_results.py about a background of several levels: the same run on one level and on three."""

import math
import shlex
import subprocess
import threading
from pathlib import Path

from record_ellipse import CASE, table_of

OFTEN = 0.1     # how often processor time is looked at [s]
TICKS = 100     # of processor time in a second, as /proc counts it
FIRST, LAST = 1, 2      # times at which the body is looked at
# h = 1 / (10 j), levels, end of the run
RUNS = [(j, levels, LAST) for j in (4, 8, 16) for levels in (1, 3)] + [(32, 3, FIRST)]


def _gas_of(directory):
    """Process of the gas of a run that is going on, or None."""
    for place in Path("/proc").glob("[0-9]*"):
        try:
            words = (place / "cmdline").read_bytes().split(b"\0")
        except OSError:
            continue
        if words[0].endswith(b"/fluid_solver") and str(directory).encode() in words:
            return place
    return None


def _watch(directory, over, found):
    """Processor time of the gas, user and system, up to OFTEN before it ends."""
    place = None
    while not over.wait(OFTEN):
        place = place or _gas_of(directory)
        try:
            numbers = (place / "stat").read_text(encoding="utf-8").rpartition(")")[2].split()
            found["cpu"] = (int(numbers[11]) + int(numbers[12])) / TICKS
        except (OSError, TypeError):
            continue


def _run(tools, j, levels, end):
    """(folder, processor time of the gas [s], command as typed)"""
    directory = tools.fresh(f"levels-{j}-{levels}")
    settings = [f"grid.factor={j}", f"fluid.grid.levels={levels}", f"time.end={end}",
                f"output.times=[{', '.join(str(t) for t in (FIRST, LAST) if t <= end)}]"]
    words = ["run", CASE, *tools.flags(settings)]
    found, over = {}, threading.Event()
    watcher = threading.Thread(target=_watch, args=(directory, over, found))
    watcher.start()
    subprocess.run(["./launch/fsi", *words, "--no-progress", "--out", str(directory)], cwd=tools.ROOT, capture_output=True, check=False)
    over.set()
    watcher.join()
    return directory, found.get("cpu", math.nan), shlex.join(["./launch/fsi", *words])


def _at(rows, t):
    """Where the body is at a time, or nothing."""
    near = min(rows, key=lambda row: abs(row["t"] - t), default=None)
    if near is None or abs(near["t"] - t) > 1e-6:
        return [""] * 3
    return [f"{near[column]:.5f}" for column in ("centre1", "centre2", "angle")]


def _size(directory):
    """Of the files with the gas's fields [MB]"""
    return sum(path.stat().st_size for path in directory.glob("fields/fluid_*.h5")) / 1e6


def _table(tools, runs):
    heading = ["h", "levels", "t", "steps", "gas: processor time [s]", "of one level's [%]", "gas: memory [MiB]", "gas: files [MB]",
               *(f"{name}, t = {t}" for t in (FIRST, LAST) for name in ("x", "y", "angle"))]
    lines = ["| " + " | ".join(heading) + " |", "|" + "---|" * len(heading)]
    one, typed = {}, ""
    for j, levels, end in runs:
        directory, cpu, typed = _run(tools, j, levels, end)
        summary, rows = tools.summary_of(directory), table_of(directory)
        if levels == 1:
            one[j] = cpu
        memory = tools.value_at(summary, "participants.fluid.peak_memory_mib")
        cells = [f"1/{10 * j}", levels, end, tools.shown(tools.value_at(summary, "steps")), f"{cpu:.1f}",
                 f"{100 * cpu / one[j]:.0f}" if j in one else "", tools.shown(memory and round(memory)), f"{_size(directory):.0f}",
                 *_at(rows, FIRST), *_at(rows, LAST)]
        lines.append("| " + " | ".join(str(cell) for cell in cells) + " |")
        print(lines[-1], flush=True)
    return f"last row: `{typed}`\n\n" + "\n".join(lines) + "\n"


def _profile(tools):
    """Where the gas spends its time, from samples of the processors' clocks while all programs run."""
    directory = tools.fresh("levels-profile")
    samples = directory.with_suffix(".perf")
    command = ["./launch/fsi", "run", CASE, "--set", "grid.factor=16", "--set", "fluid.grid.levels=3", "--set", "time.end=1", "--set",
               "output.times=[]", "--set", "expect={}"]
    subprocess.run(["perf", "record", "-q", "-a", "-F", "499", "-o", str(samples), *command, "--no-progress", "--out", str(directory)],
                   cwd=tools.ROOT, capture_output=True, check=True)
    found = tools.shares(samples, "--comm", "fluid_solver", "--percentage", "relative")
    return f"`perf record -a -F 499 {shlex.join(command)}`, of the gas\n\n```\n" + "\n".join(found) + "\n```\n"


def _to_the_finest(tools):
    """From grid to grid up to h = 1/320, to the end of the paper's run, and what the finest run takes."""
    name, levels = "levels-to-the-finest", (4, 8, 16, 32)
    text = tools.converge(name, CASE, ",".join(map(str, levels)), ["fluid.grid.levels=3", "output.times=[0.5, 1, 1.5, 2, 3, 4]"])
    return text + "\n" + tools.costs([(f"h = 1/{10 * j}", tools.RUNS / name / f"level_{j}") for j in levels[-2:]])


def studies(tools):
    yield "Shock and ellipse, background of three levels", lambda: _table(tools, RUNS)
    yield "Shock and ellipse, background of three levels, where the time of each program goes", lambda: _profile(tools)
    yield "Shock and ellipse, three levels: from grid to grid up to h = 1/320", lambda: _to_the_finest(tools)
