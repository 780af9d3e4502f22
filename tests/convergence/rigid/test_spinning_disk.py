#!/usr/bin/python3
"""A round body that turns from the start in a gas at rest: an ideal gas does not feel it, and stays at rest."""

import csv
import math
import os
import subprocess
import tempfile
import unittest
from pathlib import Path

ROOT = Path(os.environ.get("FSI_ROOT") or Path(__file__).resolve().parents[3])
CASE = """
time: {end: 0.1}
grid: {factor: 2}
fluid:
  grid: {x: [-2, 2], y: [-2, 2]}
  boundary: {left: outflow, right: outflow, bottom: outflow, top: outflow}
  scheme: {limiter: none}
  initial: {rho: 1, v: [0, 0], p: 1}
solids:
  disk: {law: rigid, rho: 1, shape: {kind: circle, radius: 1}, initial: {v: [-y, x]}}
"""


class SpinningDisk(unittest.TestCase):
    def largest(self, factor):
        """{quantity: its largest value at the interface}"""
        with tempfile.TemporaryDirectory(prefix="fsi-spinning-") as scratch:
            case = Path(scratch) / "spin.yaml"
            case.write_text(CASE, encoding="utf-8")
            command = [ROOT / "launch" / "fsi", "run", case, f"--set=grid.factor={factor}", "--no-progress", "--out", f"{scratch}/run"]
            answer = subprocess.run(command, stdin=subprocess.DEVNULL, capture_output=True, text=True, check=False)
            self.assertEqual(answer.returncode, 0, answer.stderr)
            with Path(f"{scratch}/run/interface.csv").open(encoding="utf-8") as lines:
                title, *rows = csv.reader(lines)
        columns = {name.split(" ")[0].removeprefix("disk."): k for k, name in enumerate(title)}
        return {name: max(float(row[columns[name]]) for row in rows) for name in ("gap", "velocity_jump")}

    def test_the_first_step_follows_the_circle_as_the_others_do(self):
        coarse, fine = self.largest(2), self.largest(4)
        for name, order in (("gap", 3), ("velocity_jump", 2)):  # a gap of second order makes waves of first
            self.assertGreater(math.log2(coarse[name] / fine[name]), order - 0.4, name)


if __name__ == "__main__":
    unittest.main()
