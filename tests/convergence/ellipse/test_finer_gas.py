#!/usr/bin/python3
"""A shock that hits an ellipse, the gas with four times the points of the solid: a ring whose lines are four times farther apart
than its points."""

import csv
import json
import math
import os
import subprocess
import tempfile
import unittest
from pathlib import Path

ROOT = Path(os.environ.get("FSI_ROOT") or Path(__file__).resolve().parents[3])
END = 0.25


class FinerGas(unittest.TestCase):
    def end(self, *settings):
        """(last row of the body's table, smallest quality of the gas's cells) of a run."""
        with tempfile.TemporaryDirectory(prefix="fsi-ellipse-") as scratch:
            command = [ROOT / "launch" / "fsi", "run", "shock_ellipse", "--no-progress", "--out", f"{scratch}/run",
                       *(f"--set={setting}" for setting in (f"time.end={END}", f"output.times=[{END}]", "time.dt=0.002", *settings))]
            answer = subprocess.run(command, stdin=subprocess.DEVNULL, capture_output=True, text=True, check=False)
            self.assertEqual(answer.returncode, 0, answer.stderr)
            with open(f"{scratch}/run/forces_ellipse.csv", encoding="utf-8", newline="") as lines:
                row = {key.split(" ")[0]: float(value) for key, value in list(csv.DictReader(lines))[-1].items()}
            part = json.loads(Path(f"{scratch}/run/parts/fluid.json").read_text(encoding="utf-8"))
        return row, part["health"]["min_cell_quality"]

    def test_the_ring_stays_sound_and_the_body_goes_the_same_way(self):
        (one, sound), (other, finer) = self.end(), self.end("fluid.body_fitted.0.points=round(4 * 2 * pi * 0.875 / h) + 1")
        self.assertGreater(finer, 0.8 * sound)
        way = math.hypot(one["centre1"] + 1, one["centre2"])
        apart = math.hypot(one["centre1"] - other["centre1"], one["centre2"] - other["centre2"])
        self.assertGreater(way, 0.001)
        self.assertLess(apart, 0.05 * way)  # h = 1/40 and h = 1/80 are 0.03 apart


if __name__ == "__main__":
    unittest.main()
