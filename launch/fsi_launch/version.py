"""What the programs were built from and how: build.json, which each build leaves beside them (cmake/BuildInfo.cmake)."""

import json

from fsi_launch import paths

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


def describe(folder=None):
    """For people, in two lines."""
    build = built(folder)
    if build == UNKNOWN:
        return f"AMP-FSI: nothing is built yet in {folder or paths.BIN}"
    march, resolved = build["march"], build["instruction_set"]
    instructions = march if resolved in (march, None) else f"{march} ({resolved})"
    return (f"AMP-FSI {build['version']}, {_commit(build)}\n"
            f"built by {build['compiler']} for {instructions}, {build['build_type']}")
