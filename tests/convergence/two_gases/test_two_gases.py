#!/usr/bin/python3
"""Walls between two gases, hit by a small smooth pulse of sound: an elastic piston, Taylor's plate of any mass, a bar, a rigid block;
and a bar whose far end is clamped."""

import csv
import json
import math
import os
import subprocess
import tempfile
import unittest
from pathlib import Path

ROOT = Path(os.environ.get("FSI_ROOT") or Path(__file__).resolve().parents[3])
SIZE = 1e-6  # of the pulse, as in the cases
LEVELS = "8,16"
MIN_RATE = 1.85
RIGID = ("solids.plate={law: rigid, rho: mass / thickness, grid: {x: [0, thickness], y: [0, cells * h], points: [5, 9]}, boundary: "
         "{left: {kind: interface, fluid: left}, right: {kind: interface, fluid: right}, bottom: slip_wall, top: slip_wall}}")

BAR = "reference.c_p=c_p * sqrt(8 / 9)"


class TwoGases(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory(prefix="fsi-two-gases-")
        self.addCleanup(scratch.cleanup)
        self.scratch = Path(scratch.name)
        self.runs = 0

    def fsi(self, *words):
        self.runs += 1
        folder = self.scratch / str(self.runs)
        command = [ROOT / "launch" / "fsi", *words, "--out", folder]
        answer = subprocess.run(command, stdin=subprocess.DEVNULL, capture_output=True, text=True, check=False)
        self.assertEqual(answer.returncode, 0, answer.stderr)
        return folder

    def converge(self, case, *settings, solids=()):
        folder = self.fsi("converge", case, "--levels", LEVELS, *(f"--set={s}" for s in settings), *(f"--solid={s}" for s in solids))
        return json.loads((folder / "converge.json").read_text(encoding="utf-8"))

    def assert_second_order(self, table, bounds):
        """`bounds`: of the errors on the finer grid, in parts of the pulse."""
        for name, bound in bounds.items():
            with self.subTest(error=name):
                self.assertGreater(table["rates"][name][-1], MIN_RATE, table["errors"][name])
                self.assertLess(table["errors"][name][-1], bound * SIZE)

    def test_elastic_piston_is_second_order_for_any_two_gases_and_any_density(self):
        self.assert_second_order(self.converge("piston_between_gases"), {"rho": 1e-3, "v1": 1e-3, "u_bar": 2e-5, "v_bar": 5e-4})
        self.assert_second_order(self.converge("piston_between_gases", "parameters.rho_right=5", "parameters.gamma_right=1.2"),
                                 {"rho": 0.1, "v1": 6e-3})
        for density in ("0.02", "200"):
            table = self.converge("piston_between_gases", f"parameters.density={density}")
            self.assert_second_order(table, {"rho": 2.5e-3, "v1": 2e-3})

    def test_bar_loaded_along_its_axis_is_second_order_for_any_density(self):
        """A beam along the duct: E' = 8/9 (lambda + 2 mu) for lambda = mu, since its sides bear no stress."""
        for density in ("0.02", "2", "200"):
            with self.subTest(density=density):
                table = self.converge("piston_between_gases", f"parameters.density={density}", BAR, solids=["piston=beam"])
                self.assert_second_order(table, {"rho": 2.5e-3, "v1": 2e-3})

    def test_bar_clamped_at_its_far_end_is_second_order_for_any_density(self):
        """The wave comes back from the clamped end with the opposite sign, again and again."""
        for density, bound in (("0.02", 4e-4), ("2", 2e-3), ("200", 4e-4)):
            with self.subTest(density=density):
                table = self.converge("clamped_bar", f"parameters.density={density}", "time.end=2.4", "output.times=[0.8, 2.4]")
                self.assert_second_order(table, {"rho": bound, "v1": bound})

    def test_clamped_continuum_is_second_order_too(self):
        table = self.converge("clamped_bar", "parameters.part=1/3", solids=["bar=linear_elastic"])
        self.assert_second_order(table, {"rho": 5e-4, "v1": 5e-4, "v_bar": 3e-4, "P_bar": 4e-4})

    def test_stiff_piston_takes_substeps_between_its_two_gases(self):
        table = self.converge("piston_between_gases", "time.multirate=true", "parameters.c_p=8", "parameters.density=0.5")
        self.assert_second_order(table, {"rho": 2e-3, "v1": 1.5e-3})

    def test_plate_is_second_order_for_any_mass_and_for_none(self):
        for mass in ("0", "1e-3", "1", "1e3"):
            with self.subTest(mass=mass):
                self.assert_second_order(self.converge("taylor_plate", f"parameters.mass={mass}"), {"rho": 2e-3, "v1": 1.5e-3})

    def test_plate_with_free_ends_is_second_order_for_any_mass(self):
        for mass in ("1e-3", "1e3"):
            with self.subTest(mass=mass):
                table = self.converge("taylor_plate", f"parameters.mass={mass}", "solids.plate.beam.ends=[free, free]")
                self.assert_second_order(table, {"rho": 2e-3, "v1": 1.5e-3})

    def test_rigid_block_moves_as_the_plate_does(self):
        for mass in ("1e-3", "1"):
            self.assert_second_order(self.converge("taylor_plate", RIGID, f"parameters.mass={mass}"), {"rho": 2e-3, "v1": 1.5e-3})

    def test_nothing_grows_behind_the_pulse(self):
        for mass, ends in (("0", "guided"), ("1e-3", "guided"), ("1e-3", "free")):
            folder = self.fsi("run", "taylor_plate", "--no-progress", "--set=time.end=6", "--set=output.times=[6]",
                              f"--set=parameters.mass={mass}", f"--set=solids.plate.beam.ends=[{ends}, {ends}]", "--set=fluids.left.boundary.left=outflow",
                              "--set=fluids.right.boundary.right=outflow")
            with (folder / "forces_plate.csv").open(encoding="utf-8") as lines:
                rows = [{key.split(" ")[0]: float(value) for key, value in row.items()} for row in csv.DictReader(lines)]
            before = max(abs(row["velocity1"]) for row in rows if row["t"] < 1)
            late = max(abs(row["velocity1"]) for row in rows if row["t"] > 5)
            self.assertGreater(before, 0.5 * SIZE)
            self.assertLess(late, 1e-3 * before)

    def test_hinged_plate_keeps_the_corners_of_both_gases_on_their_walls(self):
        """Pressed unevenly, its ends turn; the time step collapsed where they took the corners with them."""
        push = "(x > -0.5 ? 0.02 * y : 0)"
        folder = self.fsi("run", "taylor_plate", "--no-progress", "--set=grid.factor=4", "--set=time.end=6", "--set=output.times=[6]",
                          "--set=reference={kind: none}", "--set=expect={}", "--set=parameters.mass=0.05", "--set=parameters.stiffness=1",
                          "--set=solids.plate.beam.ends=[pinned, pinned]", "--set=fluids.left.boundary.left=outflow",
                          "--set=fluids.right.boundary.right=outflow",
                          f"--set=fluids.left.initial={{rho: '1.4 * (1 + {push})', v: [0, 0], p: '1 + {push}'}}",
                          "--set=fluids.right.initial={rho: 0.4, v: [0, 0], p: 1}")
        self.assertEqual(json.loads((folder / "summary.json").read_text(encoding="utf-8"))["t"], 6)

    def test_small_step_of_pressure_moves_the_plate_as_taylor_says(self):
        """v = 2 p_0 / (z_1 + z_2) (1 - exp(-(z_1 + z_2) t / m)): a step that sets in within a few cells, at the plate at t = 0.1."""
        p_0, mass, z = 1e-6, 0.5, 1.4 + math.sqrt(5 / 3 * 0.4)
        wave = "(x < -0.1 ? 1e-6 : 0)"
        folder = self.fsi("run", "taylor_plate", "--no-progress", "--set=grid.factor=16", "--set=time.end=1", "--set=output.times=[1]",
                          f"--set=parameters.mass={mass}", "--set=reference={kind: none}", "--set=expect={}",
                          f"--set=fluids.left.initial={{rho: '1.4 * (1 + {wave} / 1.4)', v: ['{wave} / 1.4', 0], p: '1 + {wave}'}}",
                          "--set=fluids.right.initial={rho: 0.4, v: [0, 0], p: 1}",
                          "--set=fluids.left.boundary.left=outflow", "--set=fluids.right.boundary.right=outflow",
                          "--set=fluids.left.scheme={limiter: minmod}")
        with (folder / "forces_plate.csv").open(encoding="utf-8") as lines:
            rows = [{key.split(" ")[0]: float(value) for key, value in row.items()} for row in csv.DictReader(lines)]
        last = 2 * p_0 / z
        for row in rows:
            if row["t"] < 0.2:
                continue
            exact = last * (1 - math.exp(-z * (row["t"] - 0.1) / mass))
            self.assertLess(abs(row["velocity1"] - exact), 0.02 * last, row["t"])


if __name__ == "__main__":
    unittest.main()
