#!/usr/bin/python3
"""The gas's mass, momentum and energy around a rigid body, less what crossed its boundary: errors that fall with the mesh."""

import json
import math
import os
import subprocess
import tempfile
import unittest
from pathlib import Path

ROOT = Path(os.environ.get("FSI_ROOT") or Path(__file__).resolve().parents[3])
QUANTITIES = ("mass", "momentum1", "momentum2", "energy")


class GasBudget(unittest.TestCase):
    def defects(self, factor):
        """{quantity: defect} at t = 2. What the body sends upstream comes to the inflow side at about t = 1.3 and is thrown back."""
        with tempfile.TemporaryDirectory(prefix="fsi-budget-") as scratch:
            command = [ROOT / "launch" / "fsi", "run", "shock_ellipse", "--solid", "ellipse=rigid", f"--set=grid.factor={factor}",
                       "--set=time.end=2", "--set=output.times=[2]", "--set=fluid.grid.x=[-3, 5]", "--no-progress",
                       "--out", f"{scratch}/run"]
            answer = subprocess.run(command, stdin=subprocess.DEVNULL, capture_output=True, text=True, check=False)
            self.assertEqual(answer.returncode, 0, answer.stderr)
            found = json.loads(Path(f"{scratch}/run/summary.json").read_text(encoding="utf-8"))["conservation"]["fluid"]
            return {name: found[f"{name}_defect"] for name in QUANTITIES}

    def test_defects_fall_with_the_mesh_although_the_inflow_side_reflects(self):
        coarse, fine = self.defects(2), self.defects(4)
        for name, bound in (("mass", 0.012), ("energy", 0.04)):
            self.assertLess(abs(fine[name]), bound, name)
            self.assertGreater(math.log2(abs(coarse[name] / fine[name])), 1, name)  # shocks: between first and second order
        for name in ("momentum1", "momentum2"):
            self.assertLess(abs(fine[name]), 0.01, name)


if __name__ == "__main__":
    unittest.main()
