#!/usr/bin/python3
"""The example of a solid of one's own, a piston on a spring: against the ordinary differential equation it obeys."""

import csv
import json
import math
import os
import subprocess
import tempfile
import unittest
from pathlib import Path

ROOT = Path(os.environ.get("FSI_ROOT") or Path(__file__).resolve().parents[3])
BIN = Path(os.environ.get("FSI_BIN") or ROOT / "build" / "release" / "bin")
GAMMA, PUSH, STIFFNESS, DAMPING = 1.4, 0.1, 4.0, 0.2  # as in the case
CENTRE = (-0.5, 0.125)                                # of the block behind the face, at rest


def gas(u):
    """Pressure over that at rest where a simple wave begins at a wall of velocity u; sound speed 1, p = 1 / gamma."""
    return ((1 + (GAMMA - 1) / 2 * u) ** (2 * GAMMA / (GAMMA - 1)) - 1) / GAMMA


def motion(mass, times):
    """[(velocity, way)] of the piston, per area of its face, by the classical Runge-Kutta method with small steps."""
    def rate(t, x, u):
        force = PUSH * math.sin(math.pi * t / 2) ** 2
        return u, (force - STIFFNESS * x - DAMPING * u - gas(u)) / mass

    result, t, x, u = [], 0.0, 0.0, 0.0
    for end in times:
        steps = math.ceil((end - t) / (2e-3 * min(1.0, mass)))
        h = (end - t) / max(steps, 1)
        for _ in range(steps):
            a = rate(t, x, u)
            b = rate(t + h / 2, x + h / 2 * a[0], u + h / 2 * a[1])
            c = rate(t + h / 2, x + h / 2 * b[0], u + h / 2 * b[1])
            d = rate(t + h, x + h * c[0], u + h * c[1])
            x += h / 6 * (a[0] + 2 * b[0] + 2 * c[0] + d[0])
            u += h / 6 * (a[1] + 2 * b[1] + 2 * c[1] + d[1])
            t += h
        t = end
        result.append((u, x))
    return result


class SpringPiston(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory(prefix="fsi-spring-")
        self.addCleanup(scratch.cleanup)
        self.scratch = Path(scratch.name)
        self.runs = 0

    def fsi(self, *settings):
        """(answer, folder of the run)"""
        self.runs += 1
        folder = self.scratch / f"run{self.runs}"
        command = [ROOT / "launch" / "fsi", "run", "spring_piston", "--no-progress", "--out", folder,
                   *(f"--set={setting}" for setting in settings)]
        answer = subprocess.run(command, stdin=subprocess.DEVNULL, capture_output=True, text=True, check=False)
        return answer, folder

    def rows(self, *settings):
        answer, folder = self.fsi(*settings)
        self.assertEqual(answer.returncode, 0, answer.stderr)
        with (folder / "forces_piston.csv").open(encoding="utf-8") as lines:
            return [{key.split(" ")[0]: float(value) for key, value in row.items()} for row in csv.DictReader(lines)]

    def errors(self, factor, mass=1.0):
        """Largest errors of velocity and way."""
        rows = self.rows(f"grid.factor={factor}", f"parameters.density_ratio={mass}")
        exact = motion(mass, [row["t"] for row in rows])
        return (max(abs(row["velocity1"] - u) for row, (u, _) in zip(rows, exact)),
                max(abs(row["centre1"] - CENTRE[0] - x) for row, (_, x) in zip(rows, exact)))

    def test_it_obeys_its_differential_equation_to_second_order(self):
        coarse, fine = self.errors(2), self.errors(4)
        for a, b in zip(coarse, fine):
            self.assertLess(b, 2e-5)  # of a velocity of 0.05
            self.assertGreater(math.log2(a / b), 1.9)

    def test_its_table_tells_where_the_centre_of_its_mass_is(self):
        first = self.rows("grid.factor=2")[0]
        self.assertEqual((first["centre1"], first["centre2"]), CENTRE)

    def test_a_body_force_is_that_of_the_reference_centre(self):
        there = self.rows("grid.factor=2", "solids.piston.body_force=[-16 * x * y * force, 0]")  # 1 * force, at the centre
        self.assertEqual(there, self.rows("grid.factor=2"))

    def test_a_piston_a_hundred_times_lighter_than_the_gas_is_stable(self):
        self.assertLess(max(self.errors(2, mass=0.01)), 2e-4)

    def test_a_program_is_found_by_its_path_too_and_gives_the_same_bits(self):
        self.assertEqual(self.rows("grid.factor=2"), self.rows("grid.factor=2", f"solids.piston.program={BIN}/spring_piston"))

    def test_what_the_program_misses_ends_the_run_with_its_words(self):
        answer, folder = self.fsi("solids.piston.data={damping: 0}")
        self.assertEqual(answer.returncode, 2, answer.stderr)
        self.assertIn("stiffness: NUMBER", json.loads((folder / "summary.json").read_text(encoding="utf-8"))["reason"])

    def test_a_program_that_is_not_there_is_the_users_mistake(self):
        answer, _ = self.fsi("solids.piston.program=./nowhere/piston")
        self.assertEqual(answer.returncode, 2, answer.stderr)
        self.assertIn("nowhere/piston", answer.stderr)


if __name__ == "__main__":
    unittest.main()
