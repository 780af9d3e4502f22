"""`fsi new`: a commented case out of options and, on a terminal, a few questions."""

import math
import os
import re
import shlex
import sys
from dataclasses import replace
from pathlib import Path

from fsi_launch import case as cases
from fsi_launch import paths
from fsi_launch.failure import DONE, UserMistake
from fsi_launch.new import materials, outline, text
from fsi_launch.new.problem import Problem
from fsi_launch.new.questions import ask_for_missing
from fsi_launch.results import whole_file
from fsi_launch.results.summary import percent

SIZE = 0.1      # of a circle [m]
EXAMPLES = {"size": "0.08", "mach": "1.3", "density": "1.225", "pressure": "101325", "gamma": "1.4", "end": "1e-3"}  # of options that are numbers


def _paths(options):
    """(path of the case, path of the outline a new one is written to)"""
    path = Path(options.name)
    if path.name in ("", "..") or options.name.endswith("/"):
        raise UserMistake(f"new: '{options.name}' is no name of a case but of a folder; write one like {path / 'mycase'}")
    path = path if path.suffix == ".yaml" else path.with_name(path.name + ".yaml")
    if not re.fullmatch(r"[A-Za-z0-9_.-]+", path.stem):
        raise UserMistake(f"new: '{path.stem}' is no name of a case: letters, digits, _ . -")
    if not path.absolute().parent.is_dir():
        raise UserMistake(f"new: there is no folder '{path.parent}'; make it, or name another")
    return path, path.with_name(f"{path.stem}_outline.csv")


def _outline(options):
    if options.outline is None:
        if options.straight:
            raise UserMistake("--straight is about the points of an outline; add --outline FILE")
        return outline.Outline(radius=0.5 * (options.size or SIZE))
    found = outline.read(options.outline, options.straight)
    found = outline.scaled(found, options.size) if options.size else outline.in_metres(found)
    if found.title or found.headings > 1 or found.changed:
        found = replace(found, path=None)       # the programs read plain points alone: they get these
    return outline.from_its_foot(found) if options.on_wall and options.straight else found


def problem_of(options):
    """The Problem the options describe. Throws UserMistake."""
    for option, example in EXAMPLES.items():
        if (value := getattr(options, option)) is not None and not math.isfinite(value):
            raise UserMistake(f"--{option} {value:g}: is no finite number; write one like {example}")
    if options.size is not None and options.size <= 0:
        raise UserMistake(f"--size {options.size:g}: must be above 0; write one like {EXAMPLES['size']}")
    chosen = {key: getattr(options, key) for key in ("flow", "mach", "law", "end", "cells", "gamma") if getattr(options, key) is not None}
    if options.density is not None:
        chosen["rho"] = options.density
    if options.pressure is not None:
        chosen["p"] = options.pressure
    if chosen.get("flow") == "stream":
        chosen.setdefault("mach", 0.5)
    problem = Problem(name=Path(options.name).stem, outline=_outline(options), straight=options.straight, fixed=options.fixed, on_wall=options.on_wall,
                      material=materials.material_of(options.material or "aluminium"), **chosen)
    problem.check()
    return problem


def _write(path, content):
    whole_file.write(path, content)
    print(f"wrote {path}")


def _tell_of_outline(options, found):
    if found.title:
        print(f"{options.outline}: {found.title}")
    if found.points and not options.size:
        print(outline.taken(found, options.outline))


def _settled(problem, path):
    """The Problem with rounded corners where sharp ones of a rigid body turn out to be not valid; takes `path` for the trial."""
    if not text.may_be_sharp(problem):
        return problem
    whole_file.write(path, text.write(problem, str(path), None))
    try:
        cases.check(str(path), [], [])
        return problem
    except UserMistake as mistake:
        reason = re.sub(r"^:\d+:\d+: ", "", str(mistake).removeprefix(str(path))).replace("\n", " ")     # its place is written over
        print(f"corners are rounded: with sharp ones (`radius: 0`) the case is not valid: {reason}")
        return replace(problem, sharp=False)


WIDE = 50               # [degree] so far few points of a smooth curve turn
WORTH_TELLING = 0.03    # part of a body's extent


def _rounded(problem, path):
    """What the rounding of straight corners takes of the body, or ""."""
    if not problem.straight or not problem.outline.points:
        return ""
    radius = text.radius_of_corners(problem)
    lost, corner = outline.rounded_away(problem.outline, radius, problem.on_wall)
    extent = max(max(along) - min(along) for along in zip(*problem.outline.points))
    if lost <= WORTH_TELLING * extent:
        return ""
    return (f"corners are rounded with a radius of {radius:.3g} m: {lost:.2g} m of the body, {percent(lost / extent)} of its extent, are missing at "
            f"({corner[0]:.4g}, {corner[1]:.4g}); with a smaller `radius` in {path} less is, and an elastic body takes finer grids")


def _of_edges(problem, file):
    """What is said where straight edges in the place of a smooth curve, or the reverse, may be meant, or ""."""
    if not problem.outline.points:
        return ""
    angle, most = outline.corners(problem.outline)[0], outline.largest_turn(problem.outline)
    if problem.straight:
        return "" if problem.on_wall or angle is not None or most > WIDE else (
            f"the points of {file} turn by {most:.0f} degrees at most: if these are no corners, leave out --straight; "
            "a smooth curve takes larger cells and fewer steps")
    if outline.is_round(problem.outline):       # edges between all of its points would take small cells at each
        return "" if angle is None or problem.law == "rigid" else (
            f"the points of {file} turn by more than {angle} degrees at a corner: an elastic body bends sharply there, which takes fine grids; "
            "--law rigid keeps it")
    if angle is not None and not text.keeps_corners(problem):
        return f"the points of {file} turn by more than {angle} degrees: if these are corners, add --straight for edges between the points"
    if angle is None and most > WIDE:
        return (f"a smooth curve goes through the points of {file}, which turn by up to {most:.0f} degrees: if they are corners, add "
                "--straight for edges between them")
    return ""


def main(options):
    """Writes NAME.yaml, and its outline where that had to be scaled; checks what it wrote."""
    path, points = _paths(options)
    if not options.defaults and sys.stdin.isatty() and sys.stdout.isatty():
        ask_for_missing(options)
    problem = problem_of(options)
    _tell_of_outline(options, problem.outline)
    own_points = problem.outline.points and problem.outline.path is None and not problem.straight
    for taken in (path, *([points] if own_points else [])):
        if taken.exists() and not options.overwrite:
            raise UserMistake(f"{taken} is there already; write another name, or add --overwrite")
    if own_points:
        lines = "".join(f"{x:.9g}, {y:.9g}\n" for x, y in problem.outline.points)
        _write(points, f"# points x, y [m] of the outline in {Path(options.outline).name}, its longer side {problem.outline.size():g} m\n{lines}")
    problem = _settled(problem, path)
    file = points.name if own_points else problem.outline.path and os.path.relpath(problem.outline.path, path.parent)
    _write(path, text.write(problem, str(path), file))
    if words := _of_edges(problem, options.outline):
        print(words)
    if words := _rounded(problem, path):
        print(words)
    try:
        print(cases.check(str(path), [], []))
    except UserMistake as mistake:
        raise UserMistake(f"{mistake}\n{path} stays: change it there, or write it anew with other options and --overwrite") from None
    typed = shlex.quote(str(path))
    print(f"next: {paths.COMMAND} check {typed} --plot, {paths.COMMAND} run {typed}")
    return DONE
