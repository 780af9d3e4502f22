"""The studies of record_results.py about accidents: damaged case files, changed sources, sanitizers."""

import os
import shlex
import subprocess

DAMAGES = 10000
PRESETS = {"tsan": "thread", "sanitize": "address and undefined behaviour"}
NEEDED = ["coupler", "fluid_solver", "solid_solver_linear_elastic", "monitor", "fsi_case_program", "fsi_start", "fsi_xdmf", "reference_disk"]


def built(root, preset, *targets):
    """Error output of a build that failed, or ""."""
    for command in (["cmake", "--preset", preset], ["cmake", "--build", f"build/{preset}", "--target", *targets]):
        answer = subprocess.run(command, cwd=root, capture_output=True, text=True, check=False)
        if answer.returncode:
            return f"`{shlex.join(command)}`: exit code {answer.returncode}: {answer.stderr.strip()[-300:]}\n"
    return ""


def mutated(root):
    """Case files with characters, words and lines lost, doubled or swapped, read by the checker."""
    if trouble := built(root, "release", "test_case"):
        return trouble
    command = ["build/release/bin/test_case", "--gtest_filter=DamagedCase.*"]
    answer = subprocess.run(command, cwd=root, capture_output=True, text=True, check=False,
                            env=os.environ | {"FSI_DAMAGES": str(DAMAGES)})
    said = [line.replace(f"{root}/", "") for line in answer.stdout.splitlines() if "damaged files" in line or "Failure" in line]
    return (f"`FSI_DAMAGES={DAMAGES} {shlex.join(command)}`, exit code {answer.returncode}\n\n"
            + ("\n".join(said) or answer.stderr.strip()[-300:] or "no word: it crashed") + "\n")


def sanitized(root, preset):
    """Coupled runs of programs built with sanitizers."""
    if trouble := built(root, preset, *NEEDED):
        return trouble
    command = ["tests/programs/binaries/sanitized_runs.py", preset]
    answer = subprocess.run(command, cwd=root, capture_output=True, text=True, check=False)
    return f"`{shlex.join(command)}`, exit code {answer.returncode}\n\n{answer.stdout.strip()}\n"


def changed_sources(root):
    """One sign, index or term of the sources changed at a time: which unit test notices."""
    command = ["tests/mutations/run.py"]
    answer = subprocess.run(command, cwd=root, stdout=subprocess.PIPE, text=True, check=False)
    return f"`{shlex.join(command)}`, exit code {answer.returncode}\n\n{answer.stdout.strip()}\n"


def studies(tools):
    yield "Mutated case files", lambda: mutated(tools.ROOT)
    yield "Changed sources", lambda: changed_sources(tools.ROOT)
    for preset, kind in PRESETS.items():
        yield f"Sanitizers over coupled runs: {kind}", lambda p=preset: sanitized(tools.ROOT, p)
