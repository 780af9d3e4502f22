"""What the programs were built from and how: build.json, which each build leaves beside them (cmake/BuildInfo.cmake)."""

import json
import os
import subprocess

from fsi_launch import paths
from fsi_launch.telling import AS_NAMED

STEP, RECORD = "step ", "Writing down what is built"    # of a build: before its steps, and the one that each has (cmake/BuildInfo.cmake)
UNKNOWN = {"version": None, "commit": None, "modified": None, "compiler": None, "build_type": None, "march": None,
           "instruction_set": None}


def built(folder=None):
    """The entries of UNKNOWN; what is not known is None."""
    try:
        text = ((folder or paths.BIN) / "build.json").read_text(encoding="utf-8")
        found = json.loads(text)
        return {key: found.get(key) for key in UNKNOWN}
    except (OSError, ValueError, AttributeError):
        return dict(UNKNOWN)


def _commit(build):
    if build["commit"] is None:
        return "of unknown commit (no git repository)"
    return f"commit {build['commit'][:12]}{', modified' if build['modified'] else ''}"


def outdated():
    """Names of the programs that are there and that the next command which takes them would build anew: what ninja would do, which takes
    some hundredths of a second, of a build that does not look whether it has to be configured. None with FSI_BIN, nor without a build."""
    try:
        known = [name for name in paths.targets() if not name.startswith(("test_", "bench_")) and not name.endswith("_test")]
        names = sorted(name for name in known if (paths.BIN / name).exists())
        answers = {name: subprocess.run(["ninja", "-C", paths.BUILD, "-n", "-f", "/dev/stdin", f"bin/{name}"], input="include build.ninja\n",
                                        capture_output=True, env=os.environ | {"NINJA_STATUS": STEP}, **AS_NAMED, check=False) for name in names}
    except OSError:
        return []
    return [name for name, answer in answers.items() if _would_build(answer)]


def _would_build(answer):
    """By what ninja says; a source that is gone is no rule's any more."""
    steps = [line for line in answer.stdout.splitlines() if line.startswith(STEP) and not line.endswith(RECORD)]
    return bool(steps) or "missing and no known rule" in answer.stdout + answer.stderr


def _few(names):
    return ", ".join(names[:3]) + (f" and {len(names) - 3} more" if len(names) > 3 else "")


def describe(folder=None):
    """For people, in two lines, and one more where programs of this build are older than their sources."""
    build = built(folder)
    if build == UNKNOWN:
        return f"AMP-FSI: nothing is built yet in {folder or paths.BIN}"
    march, resolved = build["march"], build["instruction_set"]
    instructions = march if resolved in (march, None) else f"{march} ({resolved})"
    old = [] if folder else outdated()
    return (f"AMP-FSI {build['version']}, {_commit(build)}\n"
            f"built by {build['compiler']} for {instructions}, {build['build_type']}"
            + (f"\nolder than the sources: {_few(old)}; the next command that takes them builds them" if old else ""))
