#!/usr/bin/python3
"""Gas that a piston leaves, whose motion the case gives: a simple wave, of which the exact pressure at the piston is that of its velocity,
p = (1 - (gamma - 1) / 2 v / c)^(2 gamma / (gamma - 1)).
"""

import csv
import math
import os
import subprocess
import tempfile
import unittest
from pathlib import Path

ROOT = Path(os.environ.get("FSI_ROOT") or Path(__file__).resolve().parents[3])
CASE = """
time: {end: 1}
grid: {factor: 2}
fluid:
  gamma: 1.4
  p_e: 1
  grid: {x: [-1.5, 0], y: [0, 4 * h], spacing: h}
  boundary: {left: slip_wall, right: {kind: interface, solid: piston}, bottom: symmetry, top: symmetry}
  scheme: {limiter: none}
  initial: {rho: 1.4, v: [0, 0], p: 1}
solids:
  piston:
    law: rigid
    rho: 1
    motion: {x: 0.1 * t^3}
    grid: {x: [0, 0.5], y: [0, 4 * h], points: [5, 5]}
    boundary: {left: interface, right: free, bottom: slip_wall, top: slip_wall}
"""


class GivenMotion(unittest.TestCase):
    def rows(self, factor):
        """Of forces_piston.csv."""
        with tempfile.TemporaryDirectory(prefix="fsi-given-") as scratch:
            case = Path(scratch) / "given.yaml"
            case.write_text(CASE, encoding="utf-8")
            command = [ROOT / "launch" / "fsi", "run", case, f"--set=grid.factor={factor}", "--no-progress", "--out", f"{scratch}/run"]
            answer = subprocess.run(command, stdin=subprocess.DEVNULL, capture_output=True, text=True, check=False)
            self.assertEqual(answer.returncode, 0, answer.stderr)
            with Path(f"{scratch}/run/forces_piston.csv").open(encoding="utf-8", newline="") as lines:
                return [{name.split(" ")[0]: float(value) for name, value in row.items()} for row in csv.DictReader(lines)]

    def error(self, factor):
        """Largest error of the pressure on the piston."""
        area, largest = 4 * 0.1 / factor, 0.0
        for row in self.rows(factor):
            t, v = row["t"], 0.3 * row["t"] ** 2
            self.assertLess(abs(row["velocity1"] - v), 1e-10)
            self.assertLess(abs(row["centre1"] - 0.25 - 0.1 * t ** 3), 1e-13)
            largest = max(largest, abs(row["force1"] / area - ((1 - 0.2 * v) ** 7 - 1)))
        return largest

    def test_the_load_is_of_second_order(self):
        coarse, fine = self.error(4), self.error(8)
        print(f"largest error of the load with 40 and 80 points a unit: {coarse:.1e}, {fine:.1e}")
        self.assertGreater(math.log2(coarse / fine), 1.9, f"{coarse:.2e}, {fine:.2e}")
        self.assertLess(fine, 2e-5)


if __name__ == "__main__":
    unittest.main()
