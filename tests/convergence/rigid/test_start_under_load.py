#!/usr/bin/python3
"""A piston that a gas already pushes at t = 0, halfway through an oscillation: the first step is as good as the others.

Gas of length 1 between a wall and the piston. Displacement of both: xi = size sin(w (x + 1)) / sin(w) cos(w t), for a = 1, and
with the piston's mass per area M = rho / (w tan(w)) its load is M xi''.
"""

import csv
import math
import os
import subprocess
import tempfile
import unittest
from pathlib import Path

ROOT = Path(os.environ.get("FSI_ROOT") or Path(__file__).resolve().parents[3])
SIZE = 1e-6
CASE = """
time: {end: 0.2}
grid: {factor: 2}
definitions: {strain: "%g * w * cos(w * (x + 1)) / sin(w)"}
fluid:
  gamma: 1.4
  p_e: 1
  grid: {x: [-1, 0], y: [0, 4 * h], spacing: h}
  boundary: {left: slip_wall, right: {kind: interface, solid: piston}, bottom: symmetry, top: symmetry}
  scheme: {limiter: none}
  initial: {rho: 1.4 * (1 - strain), v: [0, 0], p: 1 - 1.4 * strain}
solids:
  piston:
    law: rigid
    rho: 1.4 / (w * tan(w)) / 0.5
    grid: {x: [0, 0.5], y: [0, 4 * h], points: [5, 5]}
    boundary: {left: interface, right: free, bottom: slip_wall, top: slip_wall}
""" % SIZE


class StartUnderLoad(unittest.TestCase):
    def error(self, w, factor):
        """Largest error of the load on the piston, over its load at t = 0."""
        with tempfile.TemporaryDirectory(prefix="fsi-start-") as scratch:
            case = Path(scratch) / "start.yaml"
            case.write_text(f"parameters: {{w: {w}}}" + CASE, encoding="utf-8")
            command = [ROOT / "launch" / "fsi", "run", case, f"--set=grid.factor={factor}", "--no-progress", "--out", f"{scratch}/run"]
            answer = subprocess.run(command, stdin=subprocess.DEVNULL, capture_output=True, text=True, check=False)
            self.assertEqual(answer.returncode, 0, answer.stderr)
            with Path(f"{scratch}/run/forces_piston.csv").open(encoding="utf-8", newline="") as lines:
                rows = [{name.split(" ")[0]: float(value) for name, value in row.items()} for row in csv.DictReader(lines)]
        area, largest = 4 * 0.1 / factor, 1.4 * w / math.tan(w) * SIZE
        return max(abs(row["force1"] / area + largest * math.cos(w * row["t"])) for row in rows) / largest

    def test_the_first_step_is_of_the_order_of_the_others(self):
        for w in (1, 1.5):  # a piston of 0.9 and one of 0.07
            coarse, fine = self.error(w, 4), self.error(w, 8)
            self.assertGreater(math.log2(coarse / fine), 1.8, f"w = {w}: {coarse:.2e}, {fine:.2e}")
            self.assertLess(fine, 1e-3, w)


if __name__ == "__main__":
    unittest.main()
