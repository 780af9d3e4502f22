"""`fsi bench`: every bench_* program, one table, one JSON file."""

import json
import os
import subprocess
import tempfile
from pathlib import Path

from fsi_launch import paths
from fsi_launch.failure import DONE, Failure, INTERNAL_ERROR
from fsi_launch.living.supervise import leashed
from fsi_launch.results import whole_file
from fsi_launch.telling import AS_NAMED, tell

STANDARD = {  # what Google Benchmark itself reports; everything else is a counter of the benchmark's own
    "name", "family_index", "per_family_instance_index", "run_name", "run_type", "repetitions", "repetition_index",
    "threads", "iterations", "real_time", "cpu_time", "time_unit", "aggregate_name", "aggregate_unit", "label",
    "error_occurred", "error_message"}


def _run_one(program, options):
    """What one benchmark program reports, as Google Benchmark's JSON."""
    with tempfile.NamedTemporaryFile(suffix=".json") as file:
        command = [str(program), f"--benchmark_out={file.name}", "--benchmark_out_format=json"]
        if options.filter:
            command.append(f"--benchmark_filter={options.filter}")
        if options.quick:
            command.append("--benchmark_min_time=0.05")
        answer = subprocess.run(leashed(command), stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                                **AS_NAMED, check=False)
        text = file.read().decode()
    if answer.returncode != 0:
        raise Failure(INTERNAL_ERROR, f"{program.name} failed ({answer.returncode}): {answer.stdout.strip()[-500:]}")
    return json.loads(text) if text.strip() else {"benchmarks": []}


def _scaled(value):
    for limit, unit in ((1e9, "G"), (1e6, "M"), (1e3, "k")):
        if abs(value) >= limit:
            return f"{value / limit:.3g} {unit}"
    return f"{value:.3g}"


def _row(entry):
    counters = [f"{key.replace('_', ' ').replace(' per second', '/s')} {_scaled(value)}"
                for key, value in entry.items() if key not in STANDARD and isinstance(value, (int, float))]
    return [entry["name"], f"{entry['real_time']:.4g} {entry['time_unit']}", ", ".join(counters)]


def main(options):
    """Runs all and prints the table."""
    programs = sorted(path for path in paths.BIN.glob("bench_*") if os.access(path, os.X_OK))
    if not programs:
        raise Failure(INTERNAL_ERROR, f"no benchmarks in {paths.BIN}")
    results = {}
    for program in programs:
        tell(f"running {program.name}")
        results[program.name] = _run_one(program, options)
        for entry in results[program.name].get("benchmarks", []):
            if entry.get("run_type") != "aggregate":
                name, seconds, counters = _row(entry)
                print(f"{name:52} {seconds:>14}  {counters}", flush=True)
    path = Path(options.out)
    path.parent.mkdir(parents=True, exist_ok=True)
    whole_file.write(path, json.dumps(results, indent=1) + "\n")
    tell(f"all of it is in {path}")
    return DONE
