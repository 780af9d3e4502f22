"""Checkpoints of a run: which one a restart goes on from."""

import json
import math
import zlib
from dataclasses import dataclass
from pathlib import Path

from fsi_launch.living import processes, registry
from fsi_launch.results import former, replaced
from fsi_launch.failure import Failure, OUTPUT_FAILED, UserMistake

CHUNK = 1 << 20
LAST_STEP = (1 << 64) - 1     # that a program can count
REMEDY = "wait for its end, or stop it"


@dataclass
class Set:
    """The checkpoints that all programs wrote of one step."""

    path: Path
    step: int
    t: float


def _crc32(path):
    checksum = 0
    with open(path, "rb") as file:
        while data := file.read(CHUNK):
            checksum = zlib.crc32(data, checksum)
    return checksum


def _number(owner, key, kind):
    """A number of the manifest that is finite and not negative. Throws ValueError that names it."""
    value = owner.get(key)
    if isinstance(value, bool) or not isinstance(value, kind) or not math.isfinite(value) or value < 0:
        raise ValueError(f"is damaged: in its manifest.json, {key} is {value!r}")
    return value


def _manifest(path):
    """(Set, digest of its case, {file: entry}) from a manifest. Throws ValueError that says what is wrong with it."""
    try:
        manifest = json.loads(path.read_text(encoding="utf-8"))
    except OSError:
        raise ValueError("is not complete") from None
    except (ValueError, RecursionError) as error:
        raise ValueError(f"is damaged: its manifest.json cannot be read: {error}") from None
    if not isinstance(manifest, dict) or not isinstance(manifest.get("files"), dict) or not manifest["files"]:
        raise ValueError("is damaged: its manifest.json names no files")
    step = _number(manifest, "step", int)
    if step != int(path.parent.name):
        raise ValueError(f"is damaged: in its manifest.json, step is {step}")
    files = {}
    for name, entry in manifest["files"].items():
        file = entry.get("file") if isinstance(entry, dict) else None
        if not isinstance(file, str) or file != Path(file).name:
            raise ValueError(f"is damaged: its manifest.json names no file of {name}")
        files[path.parent / file] = {key: _number(entry, key, int) for key in ("bytes", "crc32")}
    return Set(path.parent, step, float(_number(manifest, "t", (int, float)))), manifest.get("case"), files


def _opened(path, digest):
    """The Set in a folder, of the case with this digest. Throws ValueError that says what is wrong with it."""
    found, case, files = _manifest(path / "manifest.json")
    if digest is not None and case != digest:
        raise ValueError("is of another case")
    for file, entry in files.items():
        try:
            if file.stat().st_size != entry["bytes"] or _crc32(file) != entry["crc32"]:
                raise ValueError(f"is damaged: {file.name} is not what was written")
        except OSError as error:
            raise ValueError(f"is damaged: {file.name}: {error.strerror}") from None
    return found


def _is_set(path):
    """Is it a folder that the programs made? Others there are somebody's own (the same in common/io/checkpoint.cpp)."""
    named = path.name.isascii() and path.name.isdecimal() and int(path.name) <= LAST_STEP
    return named and path.is_dir() and not path.is_symlink()


def _folders(directory):
    """Folders of sets, the latest first."""
    return sorted(filter(_is_set, (directory / "checkpoints").glob("*")), key=lambda path: int(path.name), reverse=True)


def latest(directory, say=lambda text: None, digest=None):
    """The latest Set that is whole and of the case with this digest, or None; `say` hears about those that are not."""
    for path in _folders(directory):
        try:
            return _opened(path, digest)
        except ValueError as flaw:
            say(f"the checkpoint of step {int(path.name)} {flaw}")
    return None


def expect_over(directory, option, remedy=REMEDY):
    """Nobody may touch the folder of a run that lives. `option`: what the user typed."""
    if run := registry.running_in(directory):
        raise UserMistake(f"{option}: the run is still going on (launcher {run}); {remedy}")
    if left := processes.programs_of(directory):
        raise UserMistake(f"{option}: {left[0].name} of the former run is still alive (pid {left[0].pid}); {remedy}")


def expect_run(directory):
    """In `directory` is a run that is over and has left checkpoints."""
    if not (directory / "case.yaml").is_file() and not former.is_aside(directory) and not replaced.is_aside(directory):
        raise UserMistake(f"--restart {directory} holds no run; name the folder of a run")
    expect_over(directory, f"--restart {directory}")
    replaced.put_back(directory)    # by a run whose launcher was killed before its programs began
    former.put_back(directory)      # of a restart whose launcher was killed before the first step
    if not _folders(directory):
        raise UserMistake(f"--restart {directory} has no checkpoint; begin anew, with --set output.checkpoint_every=N")


def choose(directory, say, digest):
    """The Set that a restart of the run in `directory`, of the case with this digest, goes on from."""
    if (found := latest(directory, say, digest)) is None:
        raise Failure(OUTPUT_FAILED, f"none of the checkpoints of {directory} can be used; begin anew")
    return found


def expect_ahead(found, end, pause_at):
    """The end of the run and the step of a pause, where there is one, are not before the Set. Throws UserMistake."""
    if pause_at is not None and pause_at < found.step:
        raise UserMistake(f"--pause-at {pause_at}: the run goes on from step {found.step}; write that or a later one")
    if end < found.t:
        raise UserMistake(f"time.end = {end:g} lies before the checkpoint's t = {found.t:.6g}; a restart can only go on")
