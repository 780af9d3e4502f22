"""The text of a new case: commented, with nothing in it that the programs choose well by themselves."""

import shlex
from dataclasses import replace

from fsi_launch.new.outline import corners, is_block, is_round, largest_radius, shortest_edge
from fsi_launch.new.problem import OUTPUTS
from fsi_launch.new.questions import LAWS

HEAD = """# {title}. Written by fsi new; every number may be changed, here or by --set KEY=VALUE (docs/case_file.md).
# ./launch/fsi check {file} --plot    is it right, what does it cost, how do its grids look?
# ./launch/fsi run {file}             run it; --set grid.factor={fine:g} with half the spacing
title: {title}
units: SI                 # labels of pictures: all numbers here are in m, s, kg

parameters:
  gamma: {gamma:<16} # ratio of specific heats of the gas
  rho_0: {rho:<16} # its density [kg/m^3]
  p_0: {p:<18} # its pressure [Pa]
  a_0: sqrt(gamma * p_0 / rho_0)    # its speed of sound [m/s]: {sound:.4g}
"""

SHOCK = """  mach: {mach:<17} # of the shock
  x_shock: {shock:<15.6g}# where the shock is at t = 0 [m]; it runs to the right
  p_1: p_0 * (1 + 2 * gamma / (gamma + 1) * (mach^2 - 1))                         # behind it, by Rankine and Hugoniot
  rho_1: rho_0 * (gamma + 1) * mach^2 / ((gamma - 1) * mach^2 + 2)
  v_1: 2 * a_0 / (gamma + 1) * (mach - 1 / mach)
"""

STREAM = """  mach: {mach:<17} # of the stream
  v_1: mach * a_0         # its velocity [m/s], to the right; the body is put into it at t = 0, at rest
"""

SOLID_NUMBERS = """  rho_bar: {rho_bar:<14} # density of the body [kg/m^3]: {material.name}{note}
  E: {E:<20} # Young's modulus [Pa]
  nu: {nu:<19} # Poisson's ratio
"""

BEHIND = """
definitions:
  behind: min(1, max(0, 0.5 + (x_shock - x) / h))    # part of the cell around a point that the shock has passed
"""

RESOLUTION = """
grid: {{factor: {factor:g}}}{space}# h = 1 / (10 factor) = {h:g} m: {cells} cells along the body

time: {{end: {end}, multirate: true}}    # [s]; multirate: a stiff solid takes substeps

fluid:
  gamma: gamma
  p_e: p_0                # pressure at which the body is free of stress
  grid: {{name: background, x: [{x_low:.6g}, {x_high:.6g}], y: [{y_low}, {y_high:.6g}]}}    # points h apart, closer where the body's outline asks for it
"""

SHOCK_SIDES = """  boundary:
    left: {{kind: far_field, state: {{rho: rho_1, v: [v_1, 0], p: p_1}}}}    # the gas behind the shock; waves from inside leave
    right: {{kind: far_field, state: {{rho: rho_0, v: [0, 0], p: p_0}}}}
    bottom: {bottom}
    top: outflow
  initial:
    rho: rho_0 + (rho_1 - rho_0) * behind
    v: [v_1 * behind, 0]
    p: p_0 + (p_1 - p_0) * behind
"""

STREAM_SIDES = """  boundary:               # the stream outside, through which waves leave
    left: {{kind: far_field, state: {{rho: rho_0, v: [v_1, 0], p: p_0}}}}
    right: {{kind: far_field, state: {{rho: rho_0, v: [v_1, 0], p: p_0}}}}
    bottom: {bottom}
    top: {{kind: far_field, state: {{rho: rho_0, v: [v_1, 0], p: p_0}}}}
  initial: {{rho: rho_0, v: [v_1, 0], p: p_0}}
"""

BODY = """
solids:
  body:                   # its grids, and those of the gas around it, are chosen; check says how
    law: {law}{space}# {laws}
    rho: rho_bar
    E: E
    nu: nu
{motion}    shape:{shape}{stands}

output:
  every: {every:.3g}{every_space}# fields [s]
  # probes: [{{name: above, in: fluid, x: {x_probe:.4g}, y: {y_probe:.4g}}}]    values at a point, every step

expect:
  status: completed
"""


def exact(value):
    """The shortest text that reads back as this number: what a person gives is not rounded."""
    return next(text for text in (f"{value:g}", repr(float(value))) if float(text) == value)


def _place(problem, value):
    """A coordinate of the outline: as its file has it, or of a scaled one."""
    return exact(value) if problem.outline.path else f"{value:.9g}"


ROUNDED, OF_AN_EDGE = 2.0, 0.25     # radius of corners, in h and in parts of the shortest edge
FITS, OF_ACUTE = 0.9, 0.5   # parts of the largest radius for which arcs have room: where that one is larger, this one
TOO_SMALL = 0.5     # radius that is not worth its grids, in h


def may_be_sharp(problem):
    """Straight edges of a rigid body with a point of the grid at each corner: if its grids are valid nothing is rounded away. At edges
    shorter than h arcs take by far smaller cells than sharp corners do: there a block of an elastic law, which is one grid, keeps its own."""
    if not problem.straight or not problem.sharp:
        return False
    return problem.law == "rigid" or is_block(problem.outline) and OF_AN_EDGE * shortest_edge(problem.outline) < TOO_SMALL * problem.spacing()


def radius_of_corners(problem):
    """Of the rounded corners; 0: sharp, which takes a point of the grid at each of them."""
    rigid, h, largest, shortest = problem.law == "rigid", problem.spacing(), largest_radius(problem.outline), shortest_edge(problem.outline)
    if may_be_sharp(problem) or problem.on_wall and not rigid and is_block(problem.outline):
        return 0
    usual = min(ROUNDED * h, OF_AN_EDGE * shortest)
    radius = usual if usual <= FITS * largest else OF_ACUTE * largest
    return 0 if rigid and radius < TOO_SMALL * h and shortest >= h else radius


def _laws(problem):
    """What is said beside the law: the others. An elastic body takes rounded corners, but for a block on a wall."""
    others = [law for law in LAWS if law != problem.law and not (problem.on_wall and law == "rigid")]
    said = f"or {', '.join(others)}: --solid body=LAW"
    if not problem.straight or problem.law != "rigid" or radius_of_corners(problem):
        return said
    rounded = radius_of_corners(replace(problem, law=others[0]))
    return said if not rounded else f"{said} --set solids.body.shape.radius={rounded:.3g}"


def keeps_corners(problem):
    """Has a body with a smooth outline corners all the same?"""
    angle, hollow = corners(problem.outline)
    return problem.law == "rigid" and angle is not None and not hollow


def _spline(problem, path):
    """The entry of a curve through points. Around a rigid body grids go on behind sharp corners: such a body gets them. A hollow corner
    folds them, and an elastic body can have none but those of a block: these stay smooth."""
    angle, _ = corners(problem.outline)
    edges = "" if is_round(problem.outline) else " (edges between them: fsi new --straight)"
    if angle is None:
        return f" {{kind: spline, file: {path}}}    # a smooth curve through the points"
    if keeps_corners(problem):
        return (f"\n      kind: spline\n      file: {path}    # a smooth curve through the points{edges}"
                f"\n      corner_angle: {angle}    # with corners where it turns by more [degree]; leave it out for an elastic body")
    return f" {{kind: spline, file: {path}}}    # a smooth curve through the points{edges}"


def _shape(problem, path):
    """The entry of the outline; `path`: of its file from where the case is."""
    outline = problem.outline
    if not outline.points:
        return f" {{kind: circle, radius: {exact(outline.radius)}}}"
    if not problem.straight:
        return _spline(problem, path)
    corners = ", ".join(f"[{_place(problem, x)}, {_place(problem, y)}]" for x, y in outline.points)
    radius = radius_of_corners(problem)
    meaning = "of the rounded corners [m]" if radius else "sharp corners"
    walls = "\n      walls: [bottom, bottom]    # on which its first and its last corner stand" if problem.on_wall else ""
    return f"\n      kind: polygon\n      corners: [{corners}]\n      radius: {radius:.3g}       # {meaning}{walls}"


def write(problem, file, path):
    """The text. `file`: what to call the case on the command line; `path`: of the outline's file."""
    h = problem.spacing()
    x_low, x_high, y_low, y_high = problem.domain()
    shock = problem.flow == "shock"
    material, end = problem.material, problem.duration()
    kind = f"{problem.flow} of Mach {exact(problem.mach)}"
    factor = f"{0.1 / h:g}"
    every = f"{end / OUTPUTS:.3g}"
    numbers = {
        "title": f"A body of {material.name} in a {kind}", "file": shlex.quote(file), "fine": 0.2 / h, "gamma": exact(problem.gamma), "rho": exact(problem.rho),
        "p": exact(problem.p), "sound": problem.sound(), "mach": exact(problem.mach), "shock": problem.shock(), "material": material,
        "note": f" ({material.note})" if material.note else "", "factor": 0.1 / h, "h": h, "space": " " * max(1, 9 - len(factor)),
        "cells": round(problem.outline.size() / h), "end": exact(end), "x_low": x_low, "x_high": x_high,
        "y_low": _place(problem, y_low) if problem.on_wall else f"{y_low:.6g}", "y_high": y_high, "rho_bar": exact(material.rho), "E": exact(material.E), "nu": exact(material.nu)}
    sides = SHOCK_SIDES if shock else STREAM_SIDES
    bottom = ("outflow       # or slip_wall: a duct" if shock
              else "{kind: far_field, state: {rho: rho_0, v: [v_1, 0], p: p_0}}    # or slip_wall: a wind tunnel")
    clamped = problem.on_wall and problem.law != "rigid"
    body = BODY.format(
        stands="\n    boundary: {left: free, right: free, bottom: clamped, top: free}    # its foot is held; the gas acts on the free sides" if clamped else "",
        law=problem.law, laws=_laws(problem), space=" " * max(1, 15 - len(problem.law)), shape=_shape(problem, path), every=end / OUTPUTS,
        every_space=" " * max(1, 15 - len(every)), motion="    motion: fixed         # free: the gas moves it\n" if problem.fixed else "",
        x_probe=0.5 * sum(problem.outline.box()[:2]), y_probe=0.5 * (problem.outline.box()[3] + y_high))
    return (HEAD.format(**numbers) + (SHOCK if shock else STREAM).format(**numbers) + SOLID_NUMBERS.format(**numbers) + BEHIND * shock
            + RESOLUTION.format(**numbers) + sides.format(bottom="slip_wall" if problem.on_wall else bottom) + body)
