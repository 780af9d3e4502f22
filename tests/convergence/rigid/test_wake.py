#!/usr/bin/python3
"""Flows around bodies that are too coarse to be right are said to be so, and no longer on finer grids: a wake that stands in two grids of the
gas with two solutions; a stream of which a part is lost in the first cells of a body. And a strong shock that stays plane."""

import csv
import json
import os
import subprocess
import tempfile
import unittest
from pathlib import Path

ROOT = Path(os.environ.get("FSI_ROOT") or Path(__file__).resolve().parents[3])

# A wedge of 11 degrees in a stream of Mach 2; its base is 0.04 high. p and rho of the stream are 1.
CASE = """
parameters: {v: 2 * sqrt(1.4)}
grid: {factor: 10}
time: {end: 0.17}
fluid:
  gamma: 1.4
  p_e: 1
  grid: {name: background, x: [-0.3, 0.7], y: [-0.35, 0.35]}
  boundary:
    left: {kind: far_field, state: {rho: 1, v: [v, 0], p: 1}}
    right: outflow
    bottom: outflow
    top: outflow
  initial: {rho: 1, v: [v, 0], p: 1}
solids:
  wedge:
    law: rigid
    rho: 1000
    motion: fixed
    shape: {kind: polygon, corners: [[0, 0], [0.2, -0.02], [0.2, 0.02]], radius: 0}
"""

# A plate, too heavy to be slowed down, in a tube between two gases: it leaves the left one, and drives a shock of Mach 5.4 into the right one.
PLATE = """
parameters: {v: 1500}
time: {end: 1e-3}
fluids:
  left:
    grid: {x: [-0.5, 0], y: [0, 0.02], points: [251, 9]}
    boundary: {left: outflow, right: {kind: interface, solid: plate}, bottom: slip_wall, top: slip_wall}
    initial: {rho: 1.2, v: [0, 0], p: 1e5}
  right:
    grid: {x: [0.01, 4], y: [0, 0.02], points: [501, 9]}
    boundary: {left: {kind: interface, solid: plate}, right: outflow, bottom: slip_wall, top: slip_wall}
    initial: {rho: 1.2, v: [0, 0], p: 1e5}
solids:
  plate:
    law: rigid
    rho: 1e6
    initial: {v: [v, 0]}
    grid: {x: [0, 0.01], y: [0, 0.02], points: [5, 9]}
    boundary: {left: {kind: interface, fluid: left}, right: {kind: interface, fluid: right}, bottom: slip_wall, top: slip_wall}
"""

# A piston whose far end is at rest first and then driven at 3.5 times the speed of sound: nothing in the case says so before it is run.
LATE = """
time: {end: 0.4}
fluid:
  p_e: 1
  grid: {x: [0, 2], y: [0, 0.2], spacing: 0.025}
  boundary: {left: {kind: interface, solid: piston}, right: outflow, bottom: slip_wall, top: slip_wall}
  initial: {rho: 1.4, v: [0, 0], p: 1}
solids:
  piston:
    law: linear_elastic
    rho: 10
    lambda: 100
    mu: 100
    grid: {x: [-0.3, 0], y: [0, 0.2], spacing: 0.025}
    boundary: {left: {kind: displacement, value: ["3.5 * (t < 0.2 ? 0 : t < 0.3 ? 5 * (t - 0.2)^2 : t - 0.25)", 0]}, right: interface, bottom: slip_wall, top: slip_wall}
"""


class Wake(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory(prefix="fsi-wake-")
        self.addCleanup(scratch.cleanup)
        self.folder = Path(scratch.name)
        (self.folder / "wake.yaml").write_text(CASE, encoding="utf-8")
        (self.folder / "plate.yaml").write_text(PLATE, encoding="utf-8")
        (self.folder / "late.yaml").write_text(LATE, encoding="utf-8")

    def run_with(self, factor, *settings):
        """What the run says, and its summary."""
        answer = subprocess.run([ROOT / "launch" / "fsi", "run", self.folder / "wake.yaml", "--no-progress", "--overwrite", f"--set=grid.factor={factor}", *settings, "--out",
                                 self.folder / str(factor)], stdin=subprocess.DEVNULL, capture_output=True, text=True, check=False)
        self.assertEqual(answer.returncode, 0, answer.stderr)
        return answer.stdout, json.loads((self.folder / str(factor) / "summary.json").read_text(encoding="utf-8"))

    def test_disagreement_is_said_with_its_place_and_a_finer_grid_resolves_it(self):
        said, summary = self.run_with(10)
        found = summary["disagreement"]
        self.assertTrue(found["large"])
        x, y = found["place"]
        self.assertTrue(0.2 < x < 0.3 and abs(y) < 0.02, found)  # behind the base
        self.assertIn("grids disagree where they overlap", said)
        self.assertIn("grids disagree where they overlap", (self.folder / "10" / "log" / "fluid.log").read_text(encoding="utf-8"))
        said, summary = self.run_with(20)
        self.assertFalse(summary["disagreement"]["large"], summary["disagreement"])
        self.assertNotIn("grids disagree", said)

    def run_cylinder(self, factor, mach, *settings):
        """The same of a cylinder 0.1 thick, put into a stream, with its drag coefficient from the last tenth of the run."""
        said, summary = self.run_with(factor, f"--set=parameters.v={mach} * sqrt(1.4)", "--set=time.end=0.29", *settings,
                                      "--set=solids.wedge.shape={kind: circle, radius: 0.05}")
        with (self.folder / str(factor) / "forces_wedge.csv").open(encoding="utf-8", newline="") as file:
            rows = [{name.split(" ")[0]: float(value) for name, value in row.items()} for row in csv.DictReader(file)]
        forces = [row["force1"] for row in rows if row["t"] > 0.9 * 0.29]
        return said, summary["conservation"]["fluid"], sum(forces) / len(forces) / (0.5 * 1.4 * mach**2 * 0.1)

    def test_ten_cells_are_enough_for_a_bow_shock(self):
        """The wall once kept the shock in its first cell: drag 1.9 times as great, and half of the gas was lost."""
        _, budget, coarse = self.run_cylinder(10, 4)
        self.assertLess(abs(budget["mass_defect"]), 0.03 * budget["mass_initial"])
        said, budget, fine = self.run_cylinder(20, 4)
        self.assertLess(abs(budget["mass_defect"]), 0.02 * budget["mass_initial"])
        self.assertNotIn("the mass of fluid", said)
        self.assertLess(abs(coarse / fine - 1), 0.05)

    def test_shock_viscosity_quiets_a_bow_shock_along_grid_lines(self):
        """A cylinder of twenty cells in a stream of Mach 12: without it the shock stands at one place in each grid."""
        summary = {}
        for viscosity in ("0", "0.5"):
            self.run_cylinder(20, 12, f"--set=fluid.scheme.shock_viscosity={viscosity}")
            summary[viscosity] = json.loads((self.folder / "20" / "summary.json").read_text(encoding="utf-8"))
        self.assertFalse(summary["0.5"]["disagreement"]["large"], summary["0.5"]["disagreement"])
        self.assertLess(summary["0.5"]["disagreement"]["value"], 0.5 * summary["0"]["disagreement"]["value"])

    def test_the_force_on_a_plate_that_drives_a_strong_shock_stays(self):
        """Without shock viscosity, which is chosen, the shock breaks up from round-off on and the force grows by a tenth."""
        answer = subprocess.run([ROOT / "launch" / "fsi", "run", self.folder / "plate.yaml", "--no-progress", "--out", self.folder / "plate"],
                                stdin=subprocess.DEVNULL, capture_output=True, text=True, check=False)
        self.assertEqual(answer.returncode, 0, answer.stderr)
        p, rho, v, gamma = 1e5, 1.2, 1500, 1.4
        a, m = (gamma * p / rho) ** 0.5, 0.25 * (gamma + 1) * rho * v
        before = p + v * (m + (m * m + gamma * p * rho) ** 0.5)                                     # Rankine and Hugoniot
        behind = p * max(0, 1 - 0.5 * (gamma - 1) * v / a) ** (2 * gamma / (gamma - 1))     # a rarefaction
        with (self.folder / "plate" / "forces_plate.csv").open(encoding="utf-8", newline="") as file:
            rows = [{name.split(" ")[0]: float(value) for name, value in row.items()} for row in csv.DictReader(file)]
        late = [row["force1"] for row in rows if row["t"] > 5e-4]
        self.assertGreater(len(late), 100)
        for force in (min(late), max(late)):
            self.assertAlmostEqual(force / (0.02 * (behind - before)), 1, delta=2e-3)

    def test_a_strong_shock_that_no_case_foretells_is_said_where_its_viscosity_is_left_open(self):
        told = {}
        for given in ("", "0", "0.5"):
            settings = [f"--set=fluid.scheme={{shock_viscosity: {given}}}"] if given else []
            answer = subprocess.run([ROOT / "launch" / "fsi", "run", self.folder / "late.yaml", "--no-progress", *settings, "--out", self.folder / f"late{given}"],
                                    stdin=subprocess.DEVNULL, capture_output=True, text=True, check=False)
            self.assertEqual(answer.returncode, 0, answer.stderr)
            told[given] = (answer.stdout, json.loads((self.folder / f"late{given}" / "summary.json").read_text(encoding="utf-8")).get("strong_shock"))
        said, found = told[""]
        self.assertTrue(found["strong"])
        self.assertGreater(found["value"], 3)
        self.assertGreater(found["t"], 0.2)
        self.assertIn("write fluid.scheme.shock_viscosity: 0.5", said)
        self.assertIn("without shock viscosity: shock of Mach", (self.folder / "late" / "log" / "fluid.log").read_text(encoding="utf-8"))
        for given in ("0", "0.5"):
            self.assertIsNone(told[given][1])
            self.assertNotIn("warning: a shock", told[given][0])

    def test_mass_that_is_lost_is_said(self):
        """A cylinder of five cells in a stream of Mach 8, without the shock viscosity that would be chosen."""
        said, budget, _ = self.run_cylinder(5, 8, "--set=fluid.scheme.shock_viscosity=0")
        self.assertLess(budget["mass_defect"], -0.05 * budget["mass_initial"])
        self.assertIn("the mass of fluid is off by", said)


if __name__ == "__main__":
    unittest.main()
