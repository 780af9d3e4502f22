"""The studies of record_results.py about accidents: damaged case files, sanitizers."""

import os
import shlex
import subprocess

DAMAGES = 10000
PRESETS = ("tsan", "sanitize")


def built(root, preset, target):
    """Error output of a build that failed, or ""."""
    for command in (["cmake", "--preset", preset], ["cmake", "--build", f"build/{preset}", "--target", target]):
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
    said = [line for line in answer.stdout.splitlines() if "damaged files" in line or "Failure" in line]
    return (f"`FSI_DAMAGES={DAMAGES} {shlex.join(command)}`, exit code {answer.returncode}\n\n"
            + ("\n".join(said) or answer.stderr.strip()[-300:] or "no word: it crashed") + "\n")


def sanitized(root):
    """Coupled runs of programs built with sanitizers."""
    text = ""
    for preset in PRESETS:
        command = ["tests/programs/sanitized_runs.py", preset]
        text += f"`cmake --build build/{preset} --target programs; {shlex.join(command)}`"
        if trouble := built(root, preset, "programs"):
            return f"{text}\n\n{trouble}"
        answer = subprocess.run(command, cwd=root, capture_output=True, text=True, check=False)
        text += f", exit code {answer.returncode}\n\n{answer.stdout.strip()}\n\n"
    return text


def studies(tools):
    yield "Mutated case files", lambda: mutated(tools.ROOT)
    yield "Sanitizers over coupled runs", lambda: sanitized(tools.ROOT)
