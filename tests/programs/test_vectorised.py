#!/usr/bin/python3
"""The loops over points that take nearly all the time of a run are vector code, in every program as it was built: one
reference to a temporary in such a loop, and the compiler silently makes it several times slower."""

import os
import re
import subprocess
import unittest
from pathlib import Path

BIN = Path(os.environ["FSI_BIN"])
SOLID = (*(f"solid::GodunovSweep<.*::{loop}\\(" for loop in ("predict", "solve_faces1", "solve_faces2", "update")),
         "solid::add_relaxation<", "solid::add_tangential_stress_dissipation<")
GAS = (*(f"fluid::{loop}<" for loop in ("predict_row", "flux_row", "update_row", "viscosity_row")), "::cartesian_rates<",
       "::mapped_rates<",
       "fluid::conserved_row\\(", "fluid::add_viscous_flux_row\\(")
ARITHMETIC = re.compile(r"\tv?(?:add|sub|mul|div|sqrt|fn?m(?:add|sub)\d+)([ps])d\s")


def arithmetic(program):
    """{function: [packed, scalar]} floating-point instructions of a program."""
    listing = subprocess.run(["objdump", "-d", "--no-show-raw-insn", "-C", BIN / program], capture_output=True, text=True,
                             check=True).stdout
    counts, function = {}, None
    for line in listing.splitlines():
        if line.endswith(">:"):
            function = counts.setdefault(line, [0, 0])
        elif function is not None and (found := ARITHMETIC.search(line)):
            function[0 if found.group(1) == "p" else 1] += 1
    return counts


class Kernels(unittest.TestCase):
    def check(self, program, kernels):
        counts = arithmetic(program)
        for kernel in kernels:
            of_kernel = {name: count for name, count in counts.items() if re.search(kernel, name)}
            self.assertTrue(of_kernel, f"{program} has no {kernel}")
            for name, (packed, scalar) in of_kernel.items():
                # the points left over go through scalar copies of the loop
                self.assertGreater(packed, 0.2 * (packed + scalar), name)

    def test_gas(self):
        self.check("fluid_solver", GAS)

    def test_solids_of_every_law(self):
        for program in sorted(path.name for path in BIN.glob("solid_solver_*")):
            if program != "solid_solver_rigid":
                self.check(program, SOLID)


if __name__ == "__main__":
    unittest.main()
