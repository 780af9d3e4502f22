#!/usr/bin/python3
"""Rigid bodies in the gas: a piston against an exact solution, a light ellipse against itself."""

import csv
import json
import math
import os
import subprocess
import tempfile
import unittest
from pathlib import Path

ROOT = Path(os.environ.get("FSI_ROOT") or Path(__file__).resolve().parents[3])
GAMMA = 1.4
PULL = 0.3


def force(t):
    return -PULL * math.sin(math.pi * t / 2) ** 2


def gas(u):
    """Pressure over that at rest where a simple wave begins at a wall of velocity u; sound speed 1, p = 1 / gamma."""
    return ((1 + (GAMMA - 1) / 2 * u) ** (2 * GAMMA / (GAMMA - 1)) - 1) / GAMMA


def motion(mass, times, spring=0, damper=0):
    """[(velocity, way)] of a piston of this mass per area on a spring and a damper per area, by the classical Runge-Kutta method
    with small steps."""
    def rate(t, u, x):
        return (force(t) - gas(u) - damper * u - spring * x) / mass

    result, t, u, x = [], 0.0, 0.0, 0.0
    for end in times:
        steps = math.ceil((end - t) / (2e-3 * min(1.0, mass)))
        h = (end - t) / max(steps, 1)
        for _ in range(steps):
            a = rate(t, u, x)
            b = rate(t + h / 2, u + h / 2 * a, x + h / 2 * u)
            c = rate(t + h / 2, u + h / 2 * b, x + h / 2 * u + h * h / 4 * a)
            d = rate(t + h, u + h * c, x + h * u + h * h / 2 * b)
            x += h * u + h * h / 6 * (a + b + c)
            u += h / 6 * (a + 2 * b + 2 * c + d)
            t += h
        t = end
        result.append((u, x))
    return result


class Rigid(unittest.TestCase):
    def run_case(self, *arguments):
        """(summary, rows of the table of forces)"""
        with tempfile.TemporaryDirectory(prefix="fsi-rigid-") as scratch:
            command = [ROOT / "launch" / "fsi", "run", *arguments, "--no-progress", "--out", f"{scratch}/run"]
            answer = subprocess.run(command, stdin=subprocess.DEVNULL, capture_output=True, text=True, check=False)
            self.assertEqual(answer.returncode, 0, answer.stderr)
            table = next(Path(f"{scratch}/run").glob("forces_*.csv"))
            with table.open(encoding="utf-8") as lines:
                rows = [[float(value) for value in row] for row in list(csv.reader(lines))[1:]]
            return json.loads(Path(f"{scratch}/run/summary.json").read_text(encoding="utf-8")), rows

    def piston_errors(self, ratio, factor, *arguments, spring=0, damper=0):
        _, rows = self.run_case("rigid_piston", f"--set=parameters.density_ratio={ratio}",
                                f"--set=grid.factor={factor}", *arguments)
        exact = motion(ratio, [row[0] for row in rows], spring, damper)
        return (max(abs(row[7] - u) for row, (u, _) in zip(rows, exact)),
                max(abs(row[5] - rows[0][5] - x) for row, (_, x) in zip(rows, exact)))

    def test_piston_follows_the_exact_motion_to_second_order_for_heavy_and_light_bodies(self):
        for ratio, bound in ((100, 5e-7), (1, 2.5e-5), (1e-2, 1e-4)):
            coarse, fine = self.piston_errors(ratio, 2), self.piston_errors(ratio, 4)
            for a, b in zip(coarse, fine):
                self.assertLess(b, bound, f"density ratio {ratio}")
                self.assertGreater(math.log2(a / b), 1.8, f"density ratio {ratio}")

    def test_piston_on_a_spring_and_a_damper_follows_the_exact_motion_to_second_order(self):
        height = 0.5   # of the interface: the springs of a case are per depth, those of `motion` per area
        for ratio, spring, damper in ((1, 8, 0), (1, 8, 0.5), (1e-2, 8, 0), (1, 0, 0.5)):
            held = (f"--set=solids.solid.spring={{x: {height * spring}}}", f"--set=solids.solid.damper={{x: {height * damper}}}")
            coarse, fine = (self.piston_errors(ratio, factor, *held, spring=spring, damper=damper) for factor in (2, 4))
            for a, b in zip(coarse, fine):
                self.assertLess(b, 1e-4, (ratio, spring, damper))
                self.assertGreater(math.log2(a / b), 1.8, (ratio, spring, damper))

    def test_turned_piston_moves_along_its_walls(self):
        _, rows = self.run_case("rigid_piston", "--set=grid.factor=2")
        _, turned = self.run_case("rigid_piston", "--set=grid.factor=2", "--set=parameters.angle=60")
        self.assertAlmostEqual(turned[-1][7], rows[-1][7] * 0.5, 12)
        self.assertAlmostEqual(turned[-1][8], rows[-1][7] * math.sqrt(0.75), 12)

    def test_ellipse_by_the_name_of_the_law_alone_keeps_the_balance_of_momentum(self):
        for multirate in ("true", "false"):
            summary, rows = self.run_case("shock_ellipse", "--solid", "ellipse=rigid", "--set=grid.factor=2",
                                          f"--set=time.multirate={multirate}", "--set=time.end=2",
                                          "--set=output.times=[2]")
            budget = summary["conservation"]["ellipse"]
            for gained, given in (("momentum1", "impulse1"), ("momentum2", "impulse2"),
                                  ("angular_momentum", "angular_impulse"), ("energy", "work")):
                self.assertAlmostEqual(budget[gained] / budget[given], 1, delta=3e-3, msg=gained)
            self.assertGreater(rows[-1][7], 0.1)  # driven away
            self.assertGreater(abs(rows[-1][9]), 0.1)  # and turned

    def test_mirror_image_has_the_mirrored_motion(self):
        rows = []
        for angle in (45, -45):
            rows.append(self.run_case("shock_ellipse", "--solid", "ellipse=rigid", "--set=grid.factor=2",
                                      f"--set=parameters.angle={angle}")[1][-1])
        for column, sign in ((5, 1), (6, -1), (7, 1), (8, -1), (9, -1)):
            self.assertAlmostEqual(rows[0][column], sign * rows[1][column], 11)


if __name__ == "__main__":
    unittest.main()
