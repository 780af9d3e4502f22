#!/usr/bin/python3
"""Ripples along an interface do not grow from round-off: the motion of a piston depends on x alone, and stays so."""

import json
import os
import subprocess
import tempfile
import unittest
from pathlib import Path

ROOT = Path(os.environ.get("FSI_ROOT") or Path(__file__).resolve().parents[3])
ROUND_OFF = 1e-13  # of velocities of 5e-3


class Ripples(unittest.TestCase):
    def test_neo_hookean(self):
        """Nearly three times as long as shipped, with a strain that folds no gas, on a grid fine enough to see waves grow."""
        settings = ("parameters.strain=0.005", "grid.factor=16", "time.end=4", "output.times=[4]", "expect={}")
        with tempfile.TemporaryDirectory(prefix="fsi-ripples-") as scratch:
            answer = subprocess.run([ROOT / "launch" / "fsi", "run", "piston_neo_hookean", "--no-progress", "--out",
                                     f"{scratch}/run", *(f"--set={setting}" for setting in settings)],
                                    stdin=subprocess.DEVNULL, capture_output=True, text=True, check=False)
            self.assertEqual(answer.returncode, 0, answer.stderr)
            summary = json.loads(Path(f"{scratch}/run/summary.json").read_text(encoding="utf-8"))
        self.assertLess(summary["errors"]["v2"], ROUND_OFF)
        self.assertFalse(summary["noise"]["noisy"])


if __name__ == "__main__":
    unittest.main()
