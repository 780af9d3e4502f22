"""Convergence studies of elastic pistons by ./launch/fsi converge."""

import json
import os
import subprocess
import tempfile
import unittest
from pathlib import Path

ROOT = Path(os.environ.get("FSI_ROOT") or Path(__file__).resolve().parents[3])

# Errors at h = 1/160: twice those of an independent one-dimensional program with the same order. The gas's hold for every density
# ratio; u_bar, v_bar and P_bar (its sigma times rho_bar c_p^2) are given where that program's figures are known.
GAS = {"rho": 4.0e-6, "v1": 8.0e-6}
SOLID = {"0.1": {"u_bar": 1.1e-5, "v_bar": 3.8e-6, "P_bar": 8.1e-7}, "1": {"u_bar": 3.8e-6, "v_bar": 1.0e-6, "P_bar": 1.9e-6},
         "1000": {"u_bar": 3.6e-6, "v_bar": 1.2e-6, "P_bar": 1.25e-3}}
# Only the finest pair of grids is judged: on coarser ones errors of opposite sign can cancel and hide the order.
LEVELS = "8,16"
MIN_RATE = 1.9
# The problem is plane: on a quarter of the duct all errors are the same to eight digits, for a quarter of the work.
QUARTER = ("fluid.grid.y=[0, 0.25]", "solids.solid.grid.y=[0, 0.25]")
ALL = ("rho", "v1", "T", "u_bar", "v_bar", "P_bar")


class Study(unittest.TestCase):
    def converge(self, *settings, levels=LEVELS, case="elastic_piston"):
        """The table of a study; it must not fail."""
        with tempfile.TemporaryDirectory(prefix="fsi-converge-") as scratch:
            command = [ROOT / "launch" / "fsi", "converge", case, "--levels", levels, "--out", f"{scratch}/s"]
            command += [f"--set={setting}" for setting in settings]
            answer = subprocess.run(command, stdin=subprocess.DEVNULL, capture_output=True, text=True, check=False)
            self.assertEqual(answer.returncode, 0, answer.stderr)
            return json.loads(Path(f"{scratch}/s/converge.json").read_text(encoding="utf-8"))

    def assert_second_order(self, table, bounds, names=ALL):
        for name in names:
            self.assertGreaterEqual(table["rates"][name][-1], MIN_RATE, (name, table["errors"][name]))
        for name, bound in bounds.items():
            self.assertLess(table["errors"][name][-1], bound, name)
