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
    def budgets(self, *settings):
        """{program: {quantity: number}}, what summary.json has of them."""
        with tempfile.TemporaryDirectory(prefix="fsi-budget-") as scratch:
            command = [ROOT / "launch" / "fsi", "run", "shock_ellipse", "--solid", "ellipse=rigid",
                       *(f"--set={setting}" for setting in settings), "--no-progress", "--out", f"{scratch}/run"]
            answer = subprocess.run(command, stdin=subprocess.DEVNULL, capture_output=True, text=True, check=False)
            self.assertEqual(answer.returncode, 0, answer.stderr)
            return json.loads(Path(f"{scratch}/run/summary.json").read_text(encoding="utf-8"))["conservation"]

    def defects(self, factor):
        """{quantity: defect} at t = 2. What the body sends upstream comes to the inflow side at about t = 1.3 and is thrown back."""
        found = self.budgets(f"grid.factor={factor}", "time.end=2", "output.times=[2]", "fluid.grid.x=[-3, 5]")["fluid"]
        return {name: found[f"{name}_defect"] for name in QUANTITIES}

    def test_defects_fall_with_the_mesh_although_the_inflow_side_reflects(self):
        coarse, fine = self.defects(2), self.defects(4)
        for name, bound in (("mass", 0.012), ("energy", 0.04)):
            self.assertLess(abs(fine[name]), bound, name)
            self.assertGreater(math.log2(abs(coarse[name] / fine[name])), 1, name)  # shocks: between first and second order
        for name in ("momentum1", "momentum2"):
            self.assertLess(abs(fine[name]), 0.01, name)

    def test_of_a_body_that_is_held_the_budget_is_not_known(self):
        """Who holds it takes what the gas gives."""
        short = ("grid.factor=1", "time.end=0.1", "output.times=[0.1]")
        self.assertIn("momentum1_defect", self.budgets(*short)["ellipse"])
        held = self.budgets(*short, "solids.ellipse.motion=fixed")["ellipse"]
        self.assertEqual([name for name in held if name.endswith("_defect")], [])
        self.assertIn("impulse1", held)


if __name__ == "__main__":
    unittest.main()
