#!/usr/bin/python3
"""An interface between periodic sides goes on beyond its ends: nothing there may know where the period begins."""

import os
import subprocess
import tempfile
import unittest
from pathlib import Path

import h5py
import numpy as np

from studies import ROOT, Study

PERIODIC = [f"{body}.boundary.{side}=periodic" for body in ("fluid", "solids.solid") for side in ("bottom", "top")]

# A gas at rest but for a ripple of its pressure along the interface; the solid gives way, more here than there.
RIPPLE = """
parameters: {shift: 0}
definitions:
  bump: exp(-20 * (x - 0.3)^2) * (1 + 0.5 * cos(2 * pi * (y - shift)) + 0.2 * sin(4 * pi * (y - shift)))
grid: {factor: 2}
time: {end: 0.5}
fluid:
  p_e: 1
  grid: {x: [0, 1], y: [0, 1], spacing: h}
  boundary: {left: {kind: interface, solid: solid}, right: outflow, bottom: periodic, top: periodic}
  initial: {rho: 1 + 0.2 * bump, v: [0, 0], p: 1 + 0.28 * bump}
solids:
  solid:
    law: neo_hookean
    rho: 0.5
    lambda: 2
    mu: 1
    grid: {x: [-0.5, 0], y: [0, 1], spacing: SPACING}
    boundary: {left: clamped, right: interface, bottom: periodic, top: periodic}
    scheme: {tangential_stress: {scaled: 0.5}, displacement: {scaled: 0.5}, relaxation: {scaled: 0.2}}
"""
SHIFT = 0.3  # in y: six cells of the gas, and a whole number of cells of the solid


class Periodic(Study):
    def test_one_dimensional_motion_is_that_between_mirrors(self):
        mirrors, periodic = self.converge(levels="2,4"), self.converge(*PERIODIC, levels="2,4")
        for name, errors in mirrors["errors"].items():
            for a, b in zip(errors, periodic["errors"][name]):
                self.assertAlmostEqual(b, a, delta=1e-6 * a + 1e-13, msg=name)  # the same numbers but for round-off

    def final_fields(self, folder, spacing, *settings):
        """{(program, quantity): values at the end, indexed [j, i]}"""
        case, run = Path(folder) / "ripple.yaml", Path(folder) / f"run{len(os.listdir(folder))}"
        case.write_text(RIPPLE.replace("SPACING", spacing), encoding="utf-8")
        command = [ROOT / "launch" / "fsi", "run", case, "--out", run, *(f"--set={setting}" for setting in settings)]
        answer = subprocess.run(command, stdin=subprocess.DEVNULL, capture_output=True, text=True, check=False)
        self.assertEqual(answer.returncode, 0, answer.stderr)
        fields = {}
        for program, names in (("fluid", ("rho", "v1", "v2", "p", "x1")), ("solid_solid", ("u1", "u2", "v1", "v2", "P11", "P12"))):
            with h5py.File(run / f"{program}.h5") as file:
                last = file[sorted(name for name in file if isinstance(file[name], h5py.Group))[-1]]
                grid = next(last[name] for name in last if isinstance(last[name], h5py.Group))
                fields |= {(program, name): grid[name][()] for name in names}
        return fields

    def assert_shifted(self, spacing):
        with tempfile.TemporaryDirectory(prefix="fsi-periodic-") as folder:
            here = self.final_fields(folder, spacing)
            there = self.final_fields(folder, spacing, f"parameters.shift={SHIFT}")
        x1 = here["fluid", "x1"]
        self.assertGreater(np.ptp(x1[:, 0]), 1e-3, "the interface must not stay straight")
        for (program, name), values in here.items():
            period = values.shape[0] - 1
            cells = round(SHIFT * period)
            np.testing.assert_allclose(values[0], values[-1], atol=1e-11, err_msg=f"{program} {name}: the two ends")
            np.testing.assert_allclose(there[program, name][:-1], np.roll(values[:-1], cells, axis=0), atol=1e-10,
                                       err_msg=f"{program} {name}")  # round-off, over 40 steps

    def test_a_ripple_that_begins_elsewhere_does_the_same_there(self):
        self.assert_shifted("h")

    def test_it_does_where_the_two_sides_have_different_points(self):
        self.assert_shifted("h / 2")
        self.assert_shifted("2 * h")


if __name__ == "__main__":
    unittest.main()
