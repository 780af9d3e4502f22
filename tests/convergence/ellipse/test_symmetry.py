#!/usr/bin/python3
"""A shock that hits an ellipse: the mirrored and the turned problem have the mirrored and the turned answer."""

import csv
import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(os.environ.get("FSI_ROOT") or Path(__file__).resolve().parents[3])
sys.path.insert(0, str(ROOT / "docs"))
from record_ellipse import TURNED  # noqa: E402

END = 0.35          # the shock has passed half of the body
ROUND_OFF = 1e-11   # of velocities of order one, after 60 steps with limiters


def motion(*settings):
    """[(centre1, centre2, velocity1, velocity2, angle)] of the body at each step."""
    with tempfile.TemporaryDirectory(prefix="fsi-ellipse-") as scratch:
        command = [ROOT / "launch" / "fsi", "run", "shock_ellipse", "--no-progress", "--out", f"{scratch}/run",
                   *(f"--set={setting}" for setting in (f"time.end={END}", f"output.times=[{END}]", *settings))]
        answer = subprocess.run(command, stdin=subprocess.DEVNULL, capture_output=True, text=True, check=False)
        if answer.returncode:
            raise AssertionError(answer.stderr)
        with open(f"{scratch}/run/forces_ellipse.csv", encoding="utf-8", newline="") as lines:
            rows = [{key.split(" ")[0]: float(value) for key, value in row.items()} for row in csv.DictReader(lines)]
    return [(row["centre1"], row["centre2"], row["velocity1"], row["velocity2"], row["angle"]) for row in rows]


class Symmetry(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.plain = motion()

    def check(self, rows):
        self.assertEqual(len(rows), len(self.plain))
        self.assertGreater(self.plain[-1][2], 0.1)  # the body is on its way
        for ours, theirs in zip(rows, self.plain):
            for a, b in zip(ours, theirs):
                self.assertAlmostEqual(a, b, delta=ROUND_OFF)

    def test_mirrored_at_the_x_axis(self):
        self.check([(x, -y, u, -v, -angle) for x, y, u, v, angle in motion("parameters.angle=45")])

    def test_turned_by_ninety_degrees(self):
        self.check([(y, -x, v, -u, angle) for x, y, u, v, angle in motion(*TURNED)])


if __name__ == "__main__":
    unittest.main()
