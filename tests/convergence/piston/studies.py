"""Convergence studies of the elastic piston by ./launch/fsi converge."""

import json
import os
import subprocess
import tempfile
import unittest
from pathlib import Path

ROOT = Path(os.environ.get("FSI_ROOT") or Path(__file__).resolve().parents[3])

# Largest errors at h = 1/80: twice what a one-dimensional program with the same scheme reaches at h = 1/160, times 4.
# They hold for every density ratio; u_bar, v_bar and P_bar are given where that program's figures are known.
GAS = {"rho": 1.6e-5, "v1": 3.2e-5}
SOLID = {"0.1": {"u_bar": 4.4e-5, "v_bar": 1.5e-5, "P_bar": 3.2e-6}, "1": {"u_bar": 1.5e-5, "v_bar": 4.0e-6, "P_bar": 7.6e-6},
         "1000": {"u_bar": 1.4e-5, "v_bar": 4.6e-6, "P_bar": 5.0e-3}}
LEVELS = "2,4,8"
# The least-squares rates over these coarse grids scatter by about a tenth around two.
MIN_RATE = 1.85


class Study(unittest.TestCase):
    def converge(self, *settings, levels=LEVELS):
        """The table of a study; it must not fail."""
        with tempfile.TemporaryDirectory(prefix="fsi-converge-") as scratch:
            command = [ROOT / "launch" / "fsi", "converge", "elastic_piston", "--levels", levels, "--out", f"{scratch}/s"]
            command += [f"--set={setting}" for setting in settings]
            answer = subprocess.run(command, stdin=subprocess.DEVNULL, capture_output=True, text=True, check=False)
            self.assertEqual(answer.returncode, 0, answer.stderr)
            return json.loads(Path(f"{scratch}/s/converge.json").read_text(encoding="utf-8"))

    def assert_second_order(self, table, bounds, names=("rho", "v1", "T", "u_bar", "v_bar", "P_bar"),
                            min_rate=MIN_RATE):
        for name in names:
            self.assertGreaterEqual(table["fitted"][name], min_rate, (name, table["errors"][name]))
        for name, bound in bounds.items():
            self.assertLess(table["errors"][name][-1], bound, name)
