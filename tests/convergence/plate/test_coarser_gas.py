#!/usr/bin/python3
"""A gas above a clamped stiff plate with four times its points, all in the small steps of the plate: the plate feels and does what
it does beside a gas with its own points."""

import csv
import os
import subprocess
import tempfile
import unittest
from pathlib import Path

ROOT = Path(os.environ.get("FSI_ROOT") or Path(__file__).resolve().parents[3])
CASE = """\
grid: {factor: 1}
time: {end: 0.6}
fluid:
  p_e: 1
  grid: {x: [0, 1], y: [0, 1], spacing: h}
  boundary:
    bottom: {kind: interface, solid: plate}
    top: {kind: far_field, state: {rho: 1.4, v: [0, 0], p: 1.01}}
    left: slip_wall
    right: slip_wall
  initial: {rho: 1.4, v: [0, 0], p: 1.01}
solids:
  plate:
    law: linear_elastic
    rho: 5
    E: 1000
    nu: 0.3
    grid: {x: [0, 1], y: [-0.05, 0], points: [41, 7]}
    boundary: {left: clamped, right: clamped, bottom: free, top: interface}
output: {probes: [{name: middle, in: plate, x: 0.5, y: 0}]}
"""


class CoarserGas(unittest.TestCase):
    def rows(self, folder, table):
        with open(folder / f"{table}.csv", encoding="utf-8", newline="") as lines:
            return [{key.split(" ")[0]: float(value) for key, value in row.items()} for row in csv.DictReader(lines)]

    def history(self, factor):
        """(impulse of the gas on the plate, its rows at the end) of a run."""
        with tempfile.TemporaryDirectory(prefix="fsi-plate-") as scratch:
            case, folder = Path(scratch) / "plate.yaml", Path(scratch) / "run"
            case.write_text(CASE, encoding="utf-8")
            answer = subprocess.run([ROOT / "launch" / "fsi", "run", case, "--no-progress", "--out", folder, f"--set=grid.factor={factor}"],
                                    stdin=subprocess.DEVNULL, capture_output=True, text=True, check=False)
            self.assertEqual(answer.returncode, 0, answer.stderr)
            forces, probe = self.rows(folder, "forces_plate"), self.rows(folder, "probes")
        impulse = sum((after["t"] - row["t"]) * row["force2"] for row, after in zip(forces, forces[1:]))
        return impulse, forces[-1], probe[-1]["middle.u2"]

    def test_the_plate_feels_the_same_force(self):
        (impulse, end, deflection), (of_coarse, coarse_end, coarse_deflection) = self.history(4), self.history(1)
        self.assertLess(impulse, -0.004)
        self.assertAlmostEqual(of_coarse / impulse, 1, delta=0.02)
        self.assertAlmostEqual(coarse_end["force2"] / end["force2"], 1, delta=0.05)
        self.assertAlmostEqual(coarse_deflection / deflection, 1, delta=0.02)
        self.assertLess(abs(coarse_end["force1"]), 1e-12 * abs(end["force2"]), "symmetric")


if __name__ == "__main__":
    unittest.main()
