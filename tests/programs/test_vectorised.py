#!/usr/bin/python3
"""The loops over points that take nearly all the time of a run are vector code, in every program as it was built: one
reference to a temporary in such a loop, and the compiler silently makes it several times slower.

A loop that was vectorised is there once as vector code, without a scalar operation in it, and once or several times as
scalar code for the points that are left over, one by one in a loop or unrolled. The vector code must do at least as much per
pass as the scalar code does per point; then nothing of the loop was left out of it, whatever the width of the vectors.
"""

import os
import re
import subprocess
import unittest
from pathlib import Path

SOLID = (*(f"solid::GodunovSweep<.*::{loop}\\(" for loop in ("predict", "solve_faces1", "solve_faces2", "update")),
         "solid::add_relaxation<", "solid::add_tangential_stress_dissipation<", "solid::add_displacement_dissipation\\(",
         "solid::add_bulk_diffusion\\(")
GAS = (*(f"fluid::{loop}<" for loop in ("predict_row", "flux_row", "update_row", "viscosity_row")), "::cartesian_rates<",
       "::mapped_rates<", "fluid::conserved_row\\(", "fluid::add_viscous_flux_row\\(",
       *(f"fluid::{loop}\\(" for loop in ("metric_row", "corner_row", "face_row_1", "face_row_2", "volume_row")))
INSTRUCTION = re.compile(r"^\s*([0-9a-f]+):\t(.*)$")
ARITHMETIC = re.compile(r"^v?(?:add|sub|mul|div|sqrt|fn?m(?:add|sub)\d+)([ps])d\s")
JUMP = re.compile(r"^j\w+\s+([0-9a-f]+)\s")
WIDEST = 8  # numbers in a vector of any x86-64 processor: up to seven points are left over


def functions(program):
    """(name, [(address, instruction)]) of a program."""
    listing = subprocess.run(["objdump", "-d", "--no-show-raw-insn", "-C", program], capture_output=True, text=True,
                             check=True).stdout
    for block in re.split(r"\n\n(?=[0-9a-f]+ <)", listing):
        name, _, body = block.strip().partition("\n")
        lines = [INSTRUCTION.match(line) for line in body.splitlines()]
        yield name, [(int(line.group(1), 16), line.group(2)) for line in lines if line]


def arithmetic(code):
    """(packed, scalar) floating-point operations among instructions."""
    kinds = [match.group(1) for _, text in code if (match := ARITHMETIC.match(text))]
    return kinds.count("p"), kinds.count("s")


def innermost_loops(code):
    """Instructions of each loop that has no other loop in it."""
    place = {address: k for k, (address, _) in enumerate(code)}
    found = set()
    for k, (address, text) in enumerate(code):
        target = int(match.group(1), 16) if (match := JUMP.match(text)) else None
        if target in place and target <= address:
            found.add((place[target], k))
    return [code[first:last + 1] for first, last in found
            if not any(other != (first, last) and first <= other[0] and other[1] <= last for other in found)]


def shortcoming(code):
    """Why a function is no vectorised loop, or ""."""
    loops = [arithmetic(loop) for loop in innermost_loops(code)]
    vector = sum(packed for packed, scalar in loops if scalar == 0)
    if vector == 0:
        return "no loop of vector code alone"
    # What is done per point: a scalar loop around one point, packed parts of which are the rest of other points.
    per_point = min((scalar for packed, scalar in loops if scalar > packed), default=0)
    if vector < 0.9 * per_point:  # the two may be put together a little differently
        return f"{vector} operations in vector code, {per_point} in scalar code"
    scalar = arithmetic(code)[1]
    if scalar > (WIDEST - 1) * 1.1 * vector:
        return f"{vector} operations in vector code, {scalar} in all scalar code"
    return ""


class Kernels(unittest.TestCase):
    def check(self, program, kernels):
        code = dict(functions(Path(os.environ["FSI_BIN"]) / program))
        for kernel in kernels:
            of_kernel = {name: code[name] for name in code if re.search(kernel, name)}
            self.assertTrue(of_kernel, f"{program} has no {kernel}")
            for name, instructions in of_kernel.items():
                self.assertEqual(shortcoming(instructions), "", name)

    def test_gas(self):
        self.check("fluid_solver", GAS)

    def test_solids_of_every_law(self):
        for program in sorted(path.name for path in Path(os.environ["FSI_BIN"]).glob("solid_solver_*")):
            if program != "solid_solver_rigid":
                self.check(program, SOLID)


class Measure(unittest.TestCase):
    """What the measure says of listings made for it."""

    @staticmethod
    def loop(start, *texts):
        code = [(start + k, text) for k, text in enumerate(texts)]
        return [*code, (start + len(texts), f"jne    {start:x} <f>")]

    def test_vector_loop_with_its_rest(self):
        vector, rest = ["vmulpd x", "vaddpd x"], ["vmulsd x", "vaddsd x"]
        self.assertEqual(shortcoming(self.loop(1, *vector)), "")
        self.assertEqual(shortcoming([*self.loop(1, *vector), *self.loop(20, *rest)]), "")
        self.assertEqual(shortcoming([*self.loop(1, *vector), *enumerate(7 * rest, start=20)]), "")

    def test_scalar_loop(self):
        self.assertNotEqual(shortcoming(self.loop(1, "vmulsd x", "vaddsd x")), "")

    def test_loop_with_one_scalar_operation(self):
        self.assertNotEqual(shortcoming(self.loop(1, "vmulpd x", "vaddpd x", "vdivsd x")), "")

    def test_loop_of_which_a_part_was_vectorised(self):
        part, rest = self.loop(1, "vmulpd x", "vaddpd x"), self.loop(20, *["vmulsd x"] * 10)
        self.assertNotEqual(shortcoming([*part, *rest]), "")


if __name__ == "__main__":
    unittest.main()
