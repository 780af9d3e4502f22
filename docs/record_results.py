#!/usr/bin/python3
"""Makes docs/results.md: runs every study below by ./launch/fsi and writes down what came out, with the command.

    docs/record_results.py [WORD ...]             all studies, or those whose title contains one of the words; prints which numbers are new
    docs/record_results.py --busy [WORD ...]      the same on a machine that does other work: tables of times stay those of the quiet one
    docs/record_results.py --check [WORD ...]     runs them and writes nothing, but says which recorded numbers do not repeat
    docs/record_results.py --list [WORD ...]      their titles

Studies that are not run keep the text they have in docs/results.md. Nothing in that file is typed by hand.
"""

import hashlib
import json
import math
import os
import re
import shlex
import shutil
import signal
import socket
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import beam_studies
import flutter_studies
import record_builds
import record_check
import record_ellipse
import record_faults
import record_impacts
import record_levels
import record_outlines
import record_paper
import record_ranks
import stream_studies
import thin_studies
import wall_studies

ROOT = Path(__file__).resolve().parent.parent
RUNS = ROOT / "runs" / "results"
RESULTS = ROOT / "docs" / "results.md"


def fsi(*words):
    """(command as typed, exit code, last line of stderr)"""
    command = ["./launch/fsi", *words]
    answer = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False)
    lines = [line for line in answer.stderr.splitlines() if line.strip()]
    return shlex.join(command), answer.returncode, lines[-1] if lines else ""


def fresh(name):
    directory = RUNS / name
    shutil.rmtree(directory, ignore_errors=True)
    return directory


def flags(settings, solids=()):
    return [word for entry in settings for word in ("--set", entry)] + [
        word for entry in solids for word in ("--solid", entry)]


RAN = {}  # command as typed: (folder, exit code) of the runs made so far


def run_once(name, case, settings=(), solids=()):
    """(folder, exit code, command as typed) of `fsi run`; a run that several studies need is made once."""
    words = ["run", case, *flags(settings, solids)]
    typed = shlex.join(["./launch/fsi", *words])
    if typed not in RAN:
        directory = fresh(name)
        _, code, _ = fsi(*words, "--no-progress", "--out", str(directory))
        RAN[typed] = directory, code
    return *RAN[typed], typed


def summary_of(directory):
    path = directory / "summary.json"
    return json.loads(path.read_text(encoding="utf-8")) if path.is_file() else {}


# Kinds of work a program's time goes into (docs/output.md).
WORK = ("advance", "time_step", "boundary", "grids", "messages", "output", "waiting")


def costs(runs):
    """Wall time of runs (label, folder), and of each program: time, memory, and the share of each kind of work."""
    heading = ["", "wall [s]", "steps", "program", "computes [s]", "updates/s", "memory [MiB]", *(f"{one} [%]" for one in WORK)]
    lines = ["| " + " | ".join(heading) + " |", "|" + "---|" * len(heading)]
    for label, directory in runs:
        summary = summary_of(directory)
        run = [label, *(shown(value_at(summary, path)) for path in ("wall_s", "steps"))]
        for program, found in summary.get("participants", {}).items():
            spent = found.get("time_s", {})
            total = sum(spent.values()) or math.nan
            cells = [program, *(shown(found.get(key)) for key in ("compute_s", "point_updates_per_s")),
                     f"{found.get('peak_memory_mib', math.nan):.0f}", *(f"{100 * spent.get(one, 0) / total:.1f}" for one in WORK)]
            lines.append("| " + " | ".join(run + cells) + " |")
            run = [""] * len(run)
    return "\n".join(lines) + "\n"


def value_at(summary, path):
    for key in path.split("."):
        summary = summary.get(key) if isinstance(summary, dict) else None
    return summary


def shown(value):
    if isinstance(value, float):
        return f"{value:.3g}"
    return "-" if value is None else str(value)


def converge(name, case, levels, settings=(), solids=()):
    """Error table of one case over grid factors."""
    directory = fresh(name)
    words = ["converge", case, "--levels", levels, *flags(settings, solids)]
    command, code, message = fsi(*words, "--out", str(directory))
    typed = command.split(" --out ")[0]
    table = directory / "converge.md"
    body = table.read_text(encoding="utf-8") if table.is_file() else f"exit code {code}: {message}\n"
    return f"`{typed}`\n\n{body}"


def rates(name, case, levels, variants, columns):
    """One row per variant (label, settings, solids): errors on the finest grid with their rates over all levels."""
    lines = ["| " + " | ".join(["", *(word for column in columns for word in (column, "rate"))]) + " |",
             "|" + "---|" * (2 * len(columns) + 1)]
    typed = ""
    for index, (label, settings, solids) in enumerate(variants):
        directory = fresh(f"{name}-{index}")
        command, code, message = fsi("converge", case, "--levels", levels, *flags(settings, solids), "--out", str(directory))
        typed = command.split(" --out ")[0]
        path = directory / "converge.json"
        if code or not path.is_file():
            lines.append(f"| {label} | exit code {code}: {message} |" + " |" * (2 * len(columns) - 1))
            continue
        found = json.loads(path.read_text(encoding="utf-8"))
        cells = [f"{found['errors'][column][-1]:.2e} | {found['fitted'][column]:.2f}" for column in columns]
        lines.append("| " + " | ".join([label, *cells]) + " |")
    return f"last row: `{typed}`\n\n" + "\n".join(lines) + "\n"


def sweep(name, case, variants, columns, settings=()):
    """One row per variant (label, settings, solids); columns are (heading, path in summary.json)."""
    lines = ["| " + " | ".join(["", *(heading for heading, _ in columns), "exit"]) + " |",
             "|" + "---|" * (len(columns) + 2)]
    typed = ""
    for index, (label, extra, solids) in enumerate(variants):
        directory, code, typed = run_once(f"{name}-{index}", case, [*settings, *extra], solids)
        summary = summary_of(directory)
        lines.append("| " + " | ".join([label, *(shown(value_at(summary, path)) for _, path in columns), str(code)]) + " |")
    return f"last row: `{typed}`\n\n" + "\n".join(lines) + "\n"


WATCHERS = [("nobody", None), ("monitor --plain", ["--plain"]), ("monitor --record", ["--plain", "--record"]),
            ("monitor --plain, frozen", ["--plain"]), ("monitor --plain, killed", ["--plain"]),
            ("monitor --web, a browser that never reads", ["--web", "0"])]


def watch(label, words, directory):
    """Starts watching the run in `directory` in the way `label` says; returns what must be ended afterwards."""
    path = str(directory / "recording.h5")
    words = [word for name in words for word in ([name, path] if name == "--record" else [name])]
    while not (directory / "interface.csv").is_file():
        time.sleep(0.01)
    monitor = subprocess.Popen(["./launch/fsi", "monitor", str(directory), *words], cwd=ROOT, text=True,
                               stdout=subprocess.PIPE if "--web" in words else subprocess.DEVNULL)
    if "--web" in words:
        host, port = re.search(r"//([^:]+):(\d+)", monitor.stdout.readline()).groups()
        browser = socket.create_connection((host, int(port)))
        browser.sendall(f"GET /api/events HTTP/1.1\r\nHost: {host}\r\n\r\n".encode())
        return [browser.close, monitor.kill, monitor.wait, monitor.stdout.close]
    if "frozen" in label or "killed" in label:
        time.sleep(1)
        monitor.send_signal(signal.SIGSTOP if "frozen" in label else signal.SIGKILL)
    return [monitor.wait] if "record" in label else [monitor.kill, monitor.wait]


def content(directory):
    """Digest of all numbers a run left: tables and fields."""
    digest = hashlib.sha256()
    for path in sorted([*directory.glob("*.csv"), *directory.glob("fields/*.h5")]):
        if path.suffix == ".csv":
            digest.update(path.read_bytes())
            continue
        import h5py
        with h5py.File(path) as file:
            file.visititems(lambda name, item: digest.update(name.encode() + item[()].tobytes()) if hasattr(item, "shape") else None)
    return digest.hexdigest()


def watched(name, repetitions=5):
    """What watching costs: processor time of all programs of the run and wall time, medians; and whether the results differ."""
    typed = ["run", "elastic_piston", "--set", "grid.factor=16", "--set", "time.dt=5e-4", "--set", "expect={}"]
    seconds, walls, contents = {}, {}, {}
    for repetition in range(repetitions):
        for label, words in WATCHERS:
            directory = fresh(name)
            before = os.times()
            run = subprocess.Popen(["./launch/fsi", *typed, "--no-progress", "--out", str(directory)], cwd=ROOT,
                                   stdout=subprocess.DEVNULL)
            ends = watch(label, words, directory) if words else []
            run.wait()  # only now its processor time counts
            after = os.times()
            for end in ends:
                end()
            seconds.setdefault(label, []).append(after.children_user + after.children_system - before.children_user - before.children_system)
            walls.setdefault(label, []).append(json.loads((directory / "summary.json").read_text(encoding="utf-8"))["wall_s"])
            contents.setdefault(label, set()).add(content(directory))
    lines = ["| who watches | processor time of the run [s] | least .. most | wall time [s] | results |", "|---|---|---|---|---|"]
    for label, _ in WATCHERS:
        same = contents[label] == contents["nobody"] and len(contents[label]) == 1
        lines.append(f"| {label} | {statistics.median(seconds[label]):.2f} | {min(seconds[label]):.2f} .. {max(seconds[label]):.2f} | "
                     f"{statistics.median(walls[label]):.2f} | {'the same bits' if same else 'DIFFERENT'} |")
    return f"`./launch/fsi {shlex.join(typed)}`, {repetitions} times each, medians\n\n" + "\n".join(lines) + "\n"


def looked_at(pairs):
    """What the live pictures cost a run, in pairs of runs that go on at the same time."""
    command = ["docs/record_watching.py", "--pairs", str(pairs)]
    said = subprocess.run([sys.executable, *command], cwd=ROOT, check=True, capture_output=True, text=True).stdout
    return (f"`{shlex.join(command)}`: pictures of the gas's pressure, the solid's speed and the outlines, and the stream of states, asked for without a "
            f"break as the page does. Processor time of all programs of a run.\n\n{said}")


def shares(samples, *options):
    """Lines of what perf has found to take 2 % of the time or more."""
    report = subprocess.run(["perf", "report", "-q", "--stdio", "--sort", "symbol", *options, "-i", str(samples)], cwd=ROOT,
                            capture_output=True, text=True, check=True).stdout
    return [re.sub(r"[ -]+$", "", line.strip()) for line in report.splitlines() if line.strip() and float(line.split("%")[0]) >= 2]


def profile(name):
    """Where the loops of the gas and the solid spend their time, from samples of the processor's clock."""
    directory = fresh(name)
    directory.mkdir(parents=True)
    text = ""
    for program, benchmark in (("bench_gas", "advance_fluid/n:512/moving:0/limiter:1/riemann:0$"),
                               ("bench_gas", "advance_fluid/n:512/moving:1/limiter:1/riemann:0$"),
                               ("bench_solid", "^cartesian_svk_centred$"), ("bench_solid", "^curvilinear_svk_dissipation$")):
        samples = directory / "perf.data"
        words = [f"./build/release/bin/{program}", f"--benchmark_filter={benchmark}", "--benchmark_min_time=3"]
        subprocess.run(["perf", "record", "-q", "-F", "499", "-o", str(samples), *words], cwd=ROOT, capture_output=True, check=True)
        text += f"`perf record -F 499 {shlex.join(words)}`\n\n```\n" + "\n".join(shares(samples)) + "\n```\n\n"
    return text


def bus_profile(name):
    """Where an exchange of 1000 points spends its processor time: by library, of all three processes."""
    directory = fresh(name)
    directory.mkdir(parents=True)
    text = ""
    for kind in ("off", "sign"):
        samples = directory / f"{kind}.data"
        words = ["./build/release/bin/bench_bus", f"--benchmark_filter=points:1000/protection:{kind}/"]
        subprocess.run(["perf", "record", "-q", "-F", "1999", "-o", str(samples), *words], cwd=ROOT, capture_output=True, check=True)
        text += f"`perf record -F 1999 {shlex.join(words)}`\n\n```\n" + "\n".join(shares(samples, "--sort", "dso")) + "\n```\n\n"
    return text + ("Who takes less than 2 % is not listed. The kernel sends, copies and wakes who waits; libc copies; "
                   "libcrypto signs and checks.\n")


def bench(name):
    """All benchmarks: the table the command itself prints."""
    directory = fresh(name)
    directory.mkdir(parents=True)
    command = ["./launch/fsi", "bench", "--out", str(directory / "bench.json")]
    answer = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False)
    if answer.returncode:
        return f"`./launch/fsi bench`: exit code {answer.returncode}: {answer.stderr.strip()}\n"
    return f"`./launch/fsi bench`\n\n```\n{answer.stdout.rstrip()}\n```\n"


def protection(name):
    """What an exchange costs with signed and with encrypted messages: the same trials one after the other, several times."""
    directory = fresh(name)
    directory.mkdir(parents=True)
    words = ["chrt", "--fifo", "1", "./build/release/bin/bench_bus", "--benchmark_repetitions=5"]
    subprocess.run([*words, f"--benchmark_out={directory / 'bus.json'}"], cwd=ROOT, stdin=subprocess.DEVNULL,
                   capture_output=True, check=True)
    found = json.loads((directory / "bus.json").read_text(encoding="utf-8"))["benchmarks"]
    text = "| points | protection | p50 [us] | p99 [us] | joining [ms] |\n|---|---|---|---|---|\n"
    for one in found:
        if one.get("aggregate_name") == "median":
            points, kind = re.search(r"points:(\d+)/protection:(\w+)", one["name"]).groups()
            text += f"| {points} | {kind} | {one['p50_us']:.0f} | {one['p99_us']:.0f} | {one['joining_ms']:.0f} |\n"
    return (f"`{shlex.join(words)}` (as root: the processors are the benchmark's own while it runs), medians of 5 runs each; one exchange "
            f"is a state from the gas and one from the solid to the coupler, and its two answers, of three processes\n\n{text}")


COLUMNS = record_paper.COLUMNS


def faults(count):
    """The campaign of signals at random moments; its table as it prints it."""
    command = ["./launch/fsi", "faults", "--count", str(count), "--seed", "1", "--jobs", "4"]
    answer = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False)
    flaws = [line for line in answer.stderr.splitlines() if line.startswith("trial ")]
    return f"`{shlex.join(command)}`, exit code {answer.returncode}\n\n```\n" + "\n".join([answer.stdout.rstrip(), *flaws]) + "\n```\n"


RATIOS = ["0.001", "0.01", "0.1", "1", "10", "1000"]
PISTON = [("steps", "steps"), ("v_bar", "errors.v_bar"), ("P_bar", "errors.P_bar"), ("u_bar", "errors.u_bar"),
          ("rho", "errors.rho"), ("v1", "errors.v1"), ("T", "errors.T"), ("gap", "interface.max_gap")]
LAWS = ["linear_elastic", "saint_venant_kirchhoff", "neo_hookean"]


def chosen_sides():
    """Three sides of given displacement, four, and one that is loaded in their place, with every law; fields that are there at once."""
    key = "solids.solid.boundary"
    for law in LAWS:
        for label, settings in (("three held", []), ("four held", [f"{key}.right=displacement"]), ("top traction", [f"{key}.top=traction"])):
            yield f"{law}, {label}", settings, [f"solid={law}"]
    exact = [f"{key}.{side}={{kind: dirichlet, state: reference}}" for side in ("left", "bottom", "top")]
    for label, settings in (("three held", []), ("all exact", exact)):
        yield f"neo_hookean, not from rest, {label}", [*settings, "definitions.beat=amplitude * cos(3 * t)"], []


def ratios(projection, extra=()):
    return [(f"R = {r}", [f"parameters.density_ratio={r}", f"interface.projection={projection}", *extra], []) for r in RATIOS]


POLAR_RING = "solids.disk.body_fitted.map=[(1 - 8 * h * s) * cos(2 * pi * r), (1 - 8 * h * s) * sin(2 * pi * r)]"
# Grids and materials for the traditional scheme: (label, z_f / z_p, spacing across the interface, settings).
STRIP = ["fluid.grid={x: [0, 1.5], y: [0, 1], points: [round(1.5 / h) + 1, 5]}",
         "solids.solid.grid={x: [-1, 0], y: [0, 1], points: [round(1 / h) + 1, 5]}"]
FINE_ACROSS = ["solids.disk.body_fitted.spacing=0.5 * h", "solids.disk.body_fitted.lines=16",
               "solids.disk.shape.points=round(pi / h) + 1"]
PISTON_LIMITS = [(f"R = {r}, {grid}", 1 / 1.3 / r, 1 / 80, ["grid.factor=8", f"parameters.density_ratio={r}", *settings])
                 for grid, settings in (("square cells", []), ("long cells", STRIP))
                 for r in (0.01, 0.1, 0.5, 0.7, 1, 1.5, 2, 3, 10, 1000)]
DISK_LIMITS = [(f"delta = {d}, {grid}", 1.4 / d / 3 ** 0.5, part / 80,
                ["grid.factor=8", f"parameters.delta={d}", "time.end=1", "output.times=[1]", *settings])
               for grid, part, settings in (("square cells", 1, []), ("cells four times as long as high", 0.5, FINE_ACROSS))
               for d in (10, 1, 0.7, 0.5, 0.1)]


def traditional(name, case, c_p, variants):
    """What becomes of runs with the traditional scheme, and with the projection in their place. The number that decides is
    the step's impulse on the solid beside the interface: c_p dt / spacing times z_f / z_p."""
    heading = ["", "z_f / z_p", "c_p dt / spacing", "product", "traditional", "exit", "difference of v_bar", "AMP", "reason"]
    lines = ["| " + " | ".join(heading) + " |", "|" + "---|" * len(heading)]
    for index, (label, ratio, spacing, settings) in enumerate(variants):
        runs = [run_once(f"{name}-{index}-{how}", case, [*settings, "expect={}", f"interface.projection={how}"])
                for how in ("traditional", "simplified")]
        found, amp = (summary_of(directory) for directory, _, _ in runs)
        courant = c_p * amp["dt"]["max"] / spacing
        errors = [summary.get("errors", {}).get("v_bar") for summary in (found, amp)]
        apart = None if None in errors else errors[0] - errors[1]
        cells = [label, f"{ratio:.2f}", f"{courant:.2f}", f"{courant * ratio:.2g}", f"{found['status']} at t = {found['t']:.3g}",
                 str(runs[0][1]), shown(apart), amp["status"], found["reason"]]
        lines.append("| " + " | ".join(cells) + " |")
    return f"last row: `{runs[0][2]}`\n\n" + "\n".join(lines) + "\n"


def piston_studies():
    for ratio in ("0.1", "1", "1000"):
        yield (f"Elastic piston, density ratio {ratio}",
               lambda r=ratio: converge(f"piston-{r}", "elastic_piston", "2,4,8,16", [f"parameters.density_ratio={r}"]))
    yield ("Elastic piston, full projection",
           lambda: converge("piston-full", "elastic_piston", "2,4,8,16",
                            ["parameters.density_ratio=0.1", "interface.projection=full"]))
    yield ("Elastic piston rotated by 30 degrees",
           lambda: converge("piston-turned", "elastic_piston", "2,4,8,16", ["parameters.density_ratio=0.1", "parameters.angle=30"]))
    for projection in ("simplified", "full"):
        yield (f"Elastic piston, all density ratios, {projection} projection, h = 1/80",
               lambda p=projection: sweep(f"ratios-{p}", "elastic_piston", ratios(p), PISTON, ["grid.factor=8"]))
    yield ("Elastic piston, the traditional scheme",
           lambda: traditional("traditional", "elastic_piston", 1.3, PISTON_LIMITS))
    yield ("Elastic piston with c_p = 8: multirate, all density ratios, h = 1/80",
           lambda: sweep("multirate", "elastic_piston", ratios("simplified", ["parameters.c_p=8", "time.multirate=true"]),
                         PISTON, ["grid.factor=8"]))
    yield ("Elastic piston with c_p = 8: single rate, all density ratios, h = 1/80",
           lambda: sweep("single-rate", "elastic_piston", ratios("simplified", ["parameters.c_p=8"]), PISTON,
                         ["grid.factor=8"]))
    yield ("Elastic piston with c_p = 8: convergence of multirate",
           lambda: converge("multirate-rate", "elastic_piston", "2,4,8,16",
                            ["parameters.density_ratio=0.1", "parameters.c_p=8", "time.multirate=true"]))


def sides():
    """Every kind of left side with every law, and sides that are mirrors of the grid."""
    key = "solids.solid.boundary"
    for law in LAWS:
        for kind in ("displacement", "traction", "slip_wall", "symmetry", "dirichlet"):
            yield f"{law}, left {kind}", [f"{key}.left={kind}"], [f"solid={law}"]
    for kind in ("traction", "dirichlet"):
        yield f"neo_hookean, bottom {kind}", [f"{key}.bottom={kind}"], []
    yield ("neo_hookean, rectangle between mirrors", ["parameters.waist=0", f"{key}.left=symmetry", f"{key}.right=symmetry",
                                                      f"{key}.top=displacement"], [])


BEFORE_THE_BOUNDS = "a2ebc303b6fe"   # the last commit before waves at sides and loaded sides had bounds of their own
# Ten times as long as shipped, small strains where the gas would fold: noise that feeds on itself would show.
TEN_TIMES = [("free_stream", ["time.end=10"]), ("rotating_disk", ["time.end=5", "output.times=[5]", "grid.factor=4"]),
             *((f"piston_{law}", ["time.end=15", "output.times=[15]", "parameters.strain=0.005", f"grid.factor={factor}"])
               for law in ("svk", "neo_hookean") for factor in (8, 16)),
             ("clamped_beam", ["time.end=20"]), ("clamped_beam", ["time.end=60"]), ("spinning_block", ["parameters.turns=10"])]


def ten_times_as_long():
    columns = [("t", "t"), ("steps", "steps"), ("ripple", "noise.value"), ("largest at t", "noise.t"), ("v2", "errors.v2"), ("v_bar", "errors.v_bar"),
               ("P_bar", "errors.P_bar")]
    tables = [sweep(f"ten-times-{case}-{index}", case, [(case, settings, [])], columns, ["expect={}"])
              for index, (case, settings) in enumerate(TEN_TIMES)]
    return "\n".join(tables) + ("\nThe ripple of `clamped_beam` is a wave around its rounded tip, whose corners have five points each: in v2, whose range is a tenth of v1's. "
                                "It is as large in a run three times as long.\n")


def noise_of_solids(steps, commit=None):
    """Growth of noise in a strained body over all combinations of the three betas, with the programs of an older commit if one is given."""
    with tempfile.TemporaryDirectory(prefix="fsi-noise-") as scratch:
        root = ROOT
        if commit:
            root = Path(scratch)
            subprocess.run(["git", "clone", "-q", str(ROOT), scratch], check=True)
            subprocess.run(["git", "checkout", "-q", commit], cwd=root, check=True)
        subprocess.run(["./launch/fsi", "--build", "noise_of_solids"], cwd=root, check=True)
        said = subprocess.run(["build/release/bin/noise_of_solids", str(steps)], cwd=root, check=True, capture_output=True, text=True)
    text = f"`build/release/bin/noise_of_solids {steps}` after `./launch/fsi --build noise_of_solids`"
    return text + (f", in a clone at commit {commit}" if commit else "") + "\n\n" + said.stdout


def steps_of_solids():
    """Growth per step of a block, from the eigenvalues of its linearised step."""
    subprocess.run(["./launch/fsi", "--build", "steps_of_solids"], cwd=ROOT, check=True)
    said = subprocess.run(["build/release/bin/steps_of_solids"], cwd=ROOT, check=True, capture_output=True, text=True)
    return f"`build/release/bin/steps_of_solids` after `./launch/fsi --build steps_of_solids`\n\n{said.stdout}"


def amplification():
    """Of waves in a strained solid, from the symbol of the scheme."""
    script = "tests/convergence/solid/noise/amplification.py"
    said = subprocess.run(["/usr/bin/python3", "-B", str(ROOT / script)], cwd=ROOT, check=True, capture_output=True, text=True)
    return f"`{script}`\n\n{said.stdout}"


def other_studies():
    yield "Amplification of waves in a strained solid", amplification
    yield "Growth per step of a block, by its sides", steps_of_solids
    yield "Noise in a strained solid, 64 combinations of the three betas", lambda: noise_of_solids(10000)
    yield "Noise in a strained solid, before the step bounded what grew", lambda: noise_of_solids(1000, BEFORE_THE_BOUNDS)
    yield "Ten times as long as shipped", ten_times_as_long
    for case in ("piston_svk", "piston_neo_hookean"):
        yield (f"{case} against the fine one-dimensional run", lambda c=case: converge(c, c, "2,4,8,16"))
    yield "Gas: isentropic vortex on a moving wavy grid", lambda: converge("vortex", "isentropic_vortex", "2,4,8,16")
    yield "Gas: Sod's tube", lambda: converge("sod", "sod_tube", "4,8,16")
    yield ("Uniform flow on a shaken grid; gas and solid moving together",
           lambda: sweep("uniform", "free_stream", [("free stream", [], [])],
                         [(name, f"errors.{name}") for name in ("rho", "v1", "v2", "T")])
           + "\n" + sweep("together", "moving_together",
                          [(f"{p}, multirate {m}", [f"interface.projection={p}", f"time.multirate={m}"], [])
                           for p in ("simplified", "full") for m in ("false", "true")],
                          [(name, f"errors.{name}") for name in ("rho", "v1", "v2", "T")]
                          + [("gap", "interface.max_gap"), ("velocity jump", "interface.max_velocity_jump")]))
    for law in LAWS:
        yield (f"Solid: manufactured solution, {law}",
               lambda l=law: converge(f"manufactured-{l}", "solid_manufactured", "2,4,8,16", solids=[f"solid={l}"]))
    yield ("Solid: manufactured solution, every law and kind of side, h = 1/80",
           lambda: rates("manufactured-sides", "solid_manufactured", "2,4,8", sides(), ["u_bar", "v_bar", "P_bar"]))
    yield ("Solid: u, v and P that do not belong together, every law and some sides, h = 1/80",
           lambda: rates("chosen-fields", "solid_chosen_fields", "2,4,8", chosen_sides(), ["u_bar", "v_bar", "P_bar"]))
    yield ("Solid: spinning block",
           lambda: sweep("block", "spinning_block",
                         [(f"h = 1/{10 * j}, {turns} turn{'s' if turns > 1 else ''}",
                           [f"grid.factor={j}", f"parameters.turns={turns}"], [])
                          for turns, j in ((1, 2), (1, 4), (1, 8), (5, 4), (40, 2))]
                         + [(f"h = 1/20, 1 turn, relaxation {beta}", ["grid.factor=2", f"solids.block.scheme.relaxation={beta}"], [])
                            for beta in ("{scaled: 0.2}", "{scaled: 1}", "{rate: 1}")],
                         [("t", "t"), ("energy drift", "conservation.block.energy"),
                          ("energy", "conservation.block.energy_initial"),
                          ("angular momentum drift", "conservation.block.angular_momentum"),
                          ("angular momentum", "conservation.block.angular_momentum_initial")]))


def disk_studies():
    yield ("Rotating disk, the traditional scheme",
           lambda: traditional("disk-traditional", "rotating_disk", 3 ** 0.5, DISK_LIMITS))
    for law in ("neo_hookean", "linear_elastic"):
        yield f"Rotating disk, {law}", lambda l=law: converge(f"disk-{l}", "rotating_disk", "2,4,8,16", solids=[f"disk={l}"])
    yield ("Rotating disk, lambda = 2, mu = 0.5",
           lambda: converge("disk-stiff", "rotating_disk", "2,4,8,16", ["solids.disk.lambda=2", "solids.disk.mu=0.5"]))
    yield ("Rotating disk, a ring of the solid by a formula instead of marching",
           lambda: converge("disk-mapped", "rotating_disk", "2,4,8", [POLAR_RING, "solids.disk.body_fitted.lines=9"]))
    yield ("Rotating disk, relaxation on the paper's rings",
           lambda: sweep("disk-relaxation", "rotating_disk",
                         [(f"{rings}, relaxation {beta}, h = 1/{10 * j}",
                           [f"grid.factor={j}", *settings, f"solids.disk.scheme.relaxation={beta}"], [])
                          for rings, settings in (("7 h deep", []), ("0.25 deep", record_paper.RINGS))
                          for beta in ("{scaled: 0.2}", "{rate: 0.5}") for j in (8, 16)],
                         [(name, f"errors.{name}") for name in COLUMNS], ["parameters.delta=10", "expect={}"]))
    yield ("Rotating disk, without each stabilisation, h = 1/160",
           lambda: sweep("disk-without", "rotating_disk",
                         [("all", [], [])] + [(f"without {key}", [f"solids.disk.scheme.{key}.scaled=0"], [])
                                              for key in ("tangential_stress", "displacement", "relaxation")],
                         [(name, f"errors.{name}") for name in COLUMNS], ["grid.factor=16"]))
    yield ("Rotating disk, multirate with a stiff light solid (lambda = mu = 16), h = 1/80",
           lambda: sweep("disk-multirate", "rotating_disk",
                         [(f"multirate {m}", [f"time.multirate={m}"], []) for m in ("false", "true")],
                         [("steps", "steps"), *[(name, f"errors.{name}") for name in COLUMNS]],
                         ["grid.factor=8", "parameters.stiffness=16", "parameters.delta=0.1"]))
    yield ("Rotating disk, time of each program",
           lambda: costs([("h = 1/160", run_once("disk-time", "rotating_disk", ["grid.factor=16"])[0])]))
    yield ("Rotating disk inside a wall, t = 10",
           lambda: converge("disk-wall", "rotating_disk_walled", "2,4,8,16")
           + "\n" + sweep("disk-budget", "rotating_disk_walled", [(f"h = 1/{10 * j}", [f"grid.factor={j}"], []) for j in (2, 4, 8)],
                          [("gas mass drift", "conservation.fluid.mass"),
                           ("disk energy change", "conservation.disk.energy"), ("initial", "conservation.disk.energy_initial"),
                           ("angular momentum drift", "conservation.disk.angular_momentum"),
                           ("initial", "conservation.disk.angular_momentum_initial")]))
    yield ("Gas and disk moving together on overlapping grids",
           lambda: sweep("together-disk", "moving_together_disk",
                         [(f"{p}, multirate {m}", [f"interface.projection={p}", f"time.multirate={m}"], [])
                          for p in ("simplified", "full") for m in ("false", "true")],
                         [(name, f"errors.{name}") for name in ("rho", "v1", "v2", "T", "u_bar", "v_bar")]
                         + [("gap", "interface.max_gap"), ("velocity jump", "interface.max_velocity_jump")]))


def kept_sections():
    """{title: text} of the present docs/results.md."""
    if not RESULTS.is_file():
        return {}
    parts = re.split(r"^## (.*)\n", RESULTS.read_text(encoding="utf-8"), flags=re.M)
    return dict(zip(parts[1::2], parts[2::2]))


HEAD = """# Results

What the commands gave on two cores; `docs/record_results.py` repeats them all and writes this page. The same by figures of the paper:
[figures.md](figures.md).

How to read it:

- Errors are largest absolute differences over all points and components, from the exact solution or a fine one-dimensional run. A `rate` is the observed
  order between two grids; `fit` the least-squares one over all of them. Round-off has no rate.
- Where a table has several runs, the command of the last row is given; rows differ in what their first cell says.
- `exit` is the exit code of the run: 0; 1 a check of the case (`expect`) failed (cases hold their own errors to bounds for their own parameters, which a
  variant may well exceed); 3 the solution diverged.
- `AMP` and `traditional` are the interface projection of this project and the scheme it replaces, in which the solid gives its velocity and the gas its
  stress. `product` is (c_p dt / spacing) (z_f / z_p), what decides about the latter ([theory](theory_coupler.md)).
- Without a reference, grids are compared with each other: a negative order means that the difference grew. The elastic ellipse sheds vortices that
  differ from grid to grid from about t = 2 on, so its later differences have no order.
- Defects of mass, momentum and energy: [what they hold](output.md#budgets).
- A section ends with the commit of the programs that gave it. Those without one hold times and counts alone, and are older than 23 November 2026.
- Times in seconds come from machines with two cores. Those in tables of errors were taken beside other work and tell no more than the order of magnitude; those of
  "time of each program" and of the benchmarks come from a quiet machine and vary by some per cent.

"""


def anchor(title):
    """GitHub's name of a heading."""
    return "".join(letter for letter in title.lower() if letter.isalnum() or letter in " -_").replace(" ", "-")


def write(sections, titles):
    """docs/results.md: how to read it, the summary, what is in it, and the sections."""
    contents = "".join(f"- [{title}](#{anchor(title)})\n" for title in titles)
    text = HEAD + record_paper.summary(sections, anchor) + "## Contents\n\n" + contents + "\n"
    text += "".join(f"## {title}\n{sections[title]}" for title in titles)
    RESULTS.write_text(text.rstrip() + "\n", encoding="utf-8")


def all_studies():
    """[(title, function)] in the order of the page."""
    tools = sys.modules[__name__]

    def of(*modules):
        return [study for module in modules for study in module.studies(tools)]

    return [*piston_studies(), *record_paper.manufactured(tools),
            ("Gas: manufactured solution on a moving grid", lambda: converge("chosen-gas", "gas_manufactured", "2,4,8,16")),
            *other_studies(), *record_paper.disks(tools), *disk_studies(),
            *of(record_ellipse, record_levels, record_ranks, beam_studies, wall_studies, stream_studies, flutter_studies, thin_studies,
                record_impacts, record_outlines),
            ("What watching costs", lambda: watched("watched")), ("What live pictures cost", lambda: looked_at(15)),
            ("Signals to every program at random moments", lambda: faults(1000)), *of(record_faults, record_builds),
            ("What protecting the bus costs", lambda: protection("protection")),
            ("Benchmarks, where the time of an exchange goes", lambda: bus_profile("bus-profile")),
            ("Benchmarks", lambda: bench("bench")), ("Benchmarks, where the time goes", lambda: profile("profile"))]


def chosen_studies(words):
    """Those whose title has one of the words, all without any.
    @throws SystemExit for words that no title has"""
    chosen = [(title, study) for title, study in all_studies() if not words or any(word in title for word in words)]
    idle = [word for word in words if not any(word in title for title, _ in chosen)]
    if idle:
        raise SystemExit(f"no study has {', '.join(map(repr, idle))} in its title; docs/record_results.py --list shows all")
    return chosen


def check(words):
    """Repeats studies and prints what differs from what is recorded; the exit code."""
    recorded, wrong, count = kept_sections(), 0, 0
    for title, study in chosen_studies(words):
        if title in recorded:
            found = record_check.differences(title, recorded[title], "\n" + study().strip() + "\n\n")
            count, wrong = count + 1, wrong + bool(found)
            print("\n".join(found) if found else f"{title}: repeats", flush=True)
    print(f"{count - wrong} of {count} sections repeat")
    return 1 if wrong or not count else 0


def recorded_with():
    """The line that says which programs gave a section."""
    said = subprocess.run(["./launch/fsi", "--version"], cwd=ROOT, capture_output=True, text=True, check=True).stdout
    version = said.splitlines()[0].partition(",")[2]    # of the build; nothing where there is none, as in a clone that only other clones are made of
    head = subprocess.run(["git", "rev-parse", "--short=12", "HEAD"], cwd=ROOT, capture_output=True, text=True, check=True).stdout.strip()
    return f"Recorded with{version or f' commit {head}'}.\n\n"


TIMES = re.compile(r"(?:^\|[^\n]*(?:updates/s|ms/step|processor time)[^\n]*\n(?:^\|[^\n]*\n)+)", re.MULTILINE)   # a table of times
RECORDED = re.compile(r"^Recorded with (commit \w+)(?:, tables of times with (commit \w+))?\.$", re.MULTILINE)


def with_times_of(former, section):
    """The section with the tables of times of the former one, if that has as many and tells its commit, which is told then."""
    tables, commits = TIMES.findall(former), RECORDED.search(former)
    if not tables or not commits or len(tables) != len(TIMES.findall(section)):
        return section
    kept = iter(tables)
    return RECORDED.sub(lambda found: f"Recorded with {found[1]}, tables of times with {commits[2] or commits[1]}.",
                        TIMES.sub(lambda _: next(kept), section))


def record(words, busy):
    """Runs the studies whose title has one of the words, all without any, and writes each as soon as it is there; the exit code."""
    sections, order = kept_sections(), [title for title, _ in all_studies()]
    for title, study in chosen_studies(words):
        if busy and record_check.is_of_the_machine(title):
            print(f"{title}: left as it is, for a quiet machine", flush=True)
            continue
        print(title, flush=True)
        former, sections[title] = sections.get(title), "\n" + study().strip() + "\n\n" + recorded_with()
        if former and busy:
            sections[title] = with_times_of(former, sections[title])
        if former:
            print("\n".join(record_check.differences(title, former, sections[title]) or [f"{title}: repeats"]), flush=True)
        write(sections, [name for name in order if name in sections])
    return 0


def main(words):
    if {"-h", "--help"} & set(words):
        print(__doc__)
        return 0
    if words[:1] == ["--list"]:
        print("\n".join(title for title, _ in chosen_studies(words[1:])))
        return 0
    if words[:1] == ["--check"]:
        return check(words[1:])
    busy = words[:1] == ["--busy"]
    return record(words[busy:], busy)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
