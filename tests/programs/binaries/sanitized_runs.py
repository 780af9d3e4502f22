#!/usr/bin/python3
"""Coupled runs of programs that were built with sanitizers; prints a table and every finding.

    cmake --preset tsan && cmake --build build/tsan --target programs
    tests/programs/binaries/sanitized_runs.py tsan          (or sanitize: addresses and undefined behaviour)

Exit 1 where a sanitizer found something or a run ended otherwise than it should.
"""

import collections
import http.client
import os
import re
import signal
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[3]
sys.path.insert(0, str(ROOT / "tests" / "programs"))
PRESETS = {"tsan": "thread", "sanitize": "address, undefined behaviour"}
FINDING = re.compile(r"WARNING: ThreadSanitizer|ERROR: (?:Address|Leak)Sanitizer|runtime error:|FATAL: ThreadSanitizer")
ENDS = 600.0    # [s] for a run to end by itself
COMMON = ("--no-progress", "--set", "expect={}", "--set", "time.peer_timeout=60")
PISTON = ("elastic_piston", *COMMON, "--set", "grid.factor=2")
LONG = (*PISTON, "--set", "time.dt=1e-7")

Row = collections.namedtuple("Row", "title code expected findings")


def options(folder):
    """Environment that lets the sanitizers write their reports to `folder`."""
    report = f"log_path={folder / 'report'}"
    return {"TSAN_OPTIONS": f"{report} suppressions={ROOT / 'cmake' / 'tsan.supp'} second_deadlock_stack=1",
            "ASAN_OPTIONS": report, "UBSAN_OPTIONS": f"{report} print_stacktrace=1"}


def findings(folder):
    """Reports of the sanitizers, whole."""
    return [text for path in sorted(folder.glob("report*")) if FINDING.search(text := path.read_text(errors="replace"))]


def until_stepping(run, size=2000):
    from running import until
    if not until(lambda: run.written() > size):
        raise RuntimeError(f"{run.directory} does not get going")


def outside(run, *words):
    from running import BIN, FSI
    return subprocess.Popen([FSI, *words], stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True,
                            env=os.environ | {"FSI_BIN": str(BIN), "XDG_RUNTIME_DIR": str(run.runtime)})


# --- what is done with a run; each returns its exit code


def plain(launch, *case):
    return launch(*case).wait()


def stop(run):
    outside(run, "ctl", str(run.directory), "stop").communicate()
    return run.wait()


def stopped_and_restarted(launch, *case):
    run = launch(*case)
    until_stepping(run)
    if (code := stop(run)) != 0:
        return code
    again = launch("--restart", str(run.directory), "--no-progress", out=None)
    again.directory = run.directory
    until_stepping(again, (run.directory / "interface.csv").stat().st_size + 2000)
    return stop(again)


def steered(launch, *case):
    run = launch(*case)
    until_stepping(run)
    for word in ("pause", "checkpoint", "resume", "stop"):
        outside(run, "ctl", str(run.directory), word).communicate()
    return run.wait()


def watched(launch, *case):
    """By everybody at once; a browser reads, and asks for a checkpoint."""
    run = launch(*case)
    until_stepping(run)
    monitors = [outside(run, "monitor", str(run.directory), *words) for words in (("--plain",), ("--json",))]
    recorder = outside(run, "monitor", str(run.directory), "--plain", "--record", str(run.directory / "recording.h5"))
    web = outside(run, "monitor", str(run.directory), "--web", "0")
    host, port, token = re.search(r"//([^:]+):(\d+)/#token=(\w+)", web.stdout.readline()).groups()
    page = http.client.HTTPConnection(host, int(port), timeout=ENDS)
    for method, path in (("GET", "/api/state.json"), ("GET", "/metrics"), ("POST", "/api/control?command=checkpoint")):
        page.request(method, path, headers={"X-AMP-FSI-Token": token})
        page.getresponse().read()
    for _ in range(3):
        recorder.stdout.readline()
    code = stop(run)
    web.send_signal(signal.SIGINT)
    for process in (*monitors, recorder, web):
        process.communicate(timeout=ENDS)
    return code


def robbed(launch, *case):
    run = launch(*case)
    until_stepping(run)
    os.kill(run.programs()["fluid_solver"], signal.SIGKILL)
    return run.wait()


RUNS = [  # title, expected exit code, what is done, case
    ("elastic piston", 0, plain, PISTON),
    ("elastic piston, multirate", 0, plain, (*PISTON, "--set", "parameters.c_p=8", "--set", "time.multirate=true")),
    ("rotating disk, overlapping grids", 0, plain,
     ("rotating_disk", *COMMON, "--solid", "disk=linear_elastic", "--set", "grid.factor=1", "--set", "time.end=0.1", "--set",
      "output.times=[0.1]", "--set", "reference.points=400")),
    ("two cylinders", 0, plain, ("two_cylinders", *COMMON, "--set", "grid.factor=2", "--set", "time.end=0.1", "--set",
                                 "output.times=[0.1]")),
    ("stopped and restarted", 0, stopped_and_restarted, LONG),
    ("paused, resumed and stopped from outside", 0, steered, LONG),
    ("watched by four monitors", 0, watched, LONG),
    ("its gas solver killed", 4, robbed, LONG),
]


def sanitized(title, expected, act, case, folder):
    """One Row; the run's folder vanishes with `folder`."""
    import running
    from running import Launched
    running.WATCHDOG = ENDS
    count = 0

    def launch(*words, out="run"):
        nonlocal count
        count += 1
        run = Launched(folder, *words, out=out and f"{out}{count}")
        run.wait = lambda: (run.process.communicate(timeout=ENDS), run.process.returncode)[1]
        return run

    os.environ.update(options(folder))
    code = act(launch, *case)
    return Row(title, code, expected, findings(folder))


def main(words):
    if len(words) != 1 or words[0] not in PRESETS:
        print(__doc__, file=sys.stderr)
        return 2
    os.environ["FSI_BIN"] = str(ROOT / "build" / words[0] / "bin")
    print(f"sanitizers: {PRESETS[words[0]]}\n\n| run | exit code | findings |\n|---|---|---|")
    bad = False
    for title, expected, act, case in RUNS:
        with tempfile.TemporaryDirectory(prefix="fsi-sanitized-") as folder:
            row = sanitized(title, expected, act, case, Path(folder))
        print(f"| {row.title} | {row.code} | {len(row.findings)} |", flush=True)
        for text in row.findings:
            print(text, file=sys.stderr)
        bad = bad or row.code != row.expected or bool(row.findings)
    return int(bad)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
