#!/usr/bin/python3
"""Taylor's plate: a beam that stays straight in a pulse of sound, for masses from a thousandth of the gas's to a thousand of it."""

import csv
import math
import os
import subprocess
import tempfile
import unittest
from pathlib import Path

ROOT = Path(os.environ.get("FSI_ROOT") or Path(__file__).resolve().parents[3])
SIZE = 1e-6  # of the pulse, as in the case


def velocities(mass, times):
    """Velocities over the size of the pulse, m v' = -2 p_i - v: exact for the pulse as a sum of cosines. rho = a = 1."""
    # sin^4(pi s) = 3/8 - 1/2 cos(2 pi s) + 1/8 cos(4 pi s), s = (t - 0.1) / 0.6
    waves = [(3 / 8, 0.0), (-1 / 2, 2 * math.pi / 0.6), (1 / 8, 4 * math.pi / 0.6)]

    def forced(t):  # solution of m v' + v = -2 p_i that has the form of the load
        return sum(-2 * a * (math.cos(w * (t - 0.1)) + mass * w * math.sin(w * (t - 0.1))) / (1 + (mass * w) ** 2) for a, w in waves)

    def at(t):
        if t <= 0.1:
            return 0.0
        end = min(t, 0.7)
        v = forced(end) - forced(0.1) * math.exp(-(end - 0.1) / mass)
        return v * math.exp(-(t - end) / mass)

    return [at(t) for t in times]


class Plate(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory(prefix="fsi-plate-")
        self.addCleanup(scratch.cleanup)
        self.scratch = Path(scratch.name)
        self.runs = 0

    def rows(self, *settings):
        self.runs += 1
        folder = self.scratch / f"run{self.runs}"
        command = [ROOT / "launch" / "fsi", "run", "plate", "--no-progress", "--out", folder, *(f"--set={s}" for s in settings)]
        answer = subprocess.run(command, stdin=subprocess.DEVNULL, capture_output=True, text=True, check=False)
        self.assertEqual(answer.returncode, 0, answer.stderr)
        with (folder / "forces_plate.csv").open(encoding="utf-8") as lines:
            return [{key.split(" ")[0]: float(value) for key, value in row.items()} for row in csv.DictReader(lines)]

    def error(self, factor, mass):
        """Largest error of the velocity, over the largest velocity."""
        rows = self.rows(f"grid.factor={factor}", f"parameters.density_ratio={mass}")
        exact = velocities(mass, [row["t"] for row in rows])
        return max(abs(row["velocity1"] / SIZE - v) for row, v in zip(rows, exact)) / max(map(abs, exact))

    def test_it_follows_the_pulse_to_second_order_whatever_its_mass(self):
        for mass in (1e-3, 1e-1, 1, 1e3):
            coarse, fine = self.error(8, mass), self.error(16, mass)
            with self.subTest(mass=mass):
                self.assertLess(fine, 5e-4)
                self.assertGreater(math.log2(coarse / fine), 1.8)

    def test_it_stays_straight(self):
        for row in self.rows("parameters.density_ratio=0.001"):
            self.assertLess(abs(row["angle"]), 1e-12)
            self.assertLess(abs(row["velocity2"]), 1e-9 * SIZE)


if __name__ == "__main__":
    unittest.main()
