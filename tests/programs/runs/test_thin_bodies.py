#!/usr/bin/python3
"""A plate thinner than a cell across a shock: whether a column of the background stands in it makes no difference to its force."""

import csv
import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from running import EndToEnd  # noqa: E402

# A pressure wave, the more of a shock the longer it runs, comes to a plate on the floor of a duct; h = 0.05. It is smooth at first, so that it does
# not matter between which columns it lies.
PLATE = """
definitions: {front: 0.5 * (1 - tanh((x + 0.5) / 0.1))}
parameters: {gamma: 1.4, thickness: 0.02, shift: 0, p_1: 1.0809523809523809}
grid: {factor: 2}
time: {end: 1.2}
fluid:
  gamma: gamma
  p_e: 1 / gamma
  grid: {x: [-1 + shift, 1 + shift], y: [0, 1]}
  boundary:
    left: {kind: far_field, state: {rho: 1.3416149068322981, v: [0.30555555555555558, 0], p: p_1}}
    right: outflow
    bottom: slip_wall
    top: slip_wall
  initial: {rho: 1 + 0.3416149068322981 * front, v: [0.30555555555555558 * front, 0], p: 1 / gamma + (p_1 - 1 / gamma) * front}
solids:
  plate:
    law: rigid
    motion: fixed
    rho: 1
    shape: {kind: polygon, radius: 0, walls: [bottom, bottom],
            corners: [[0, 0], [0, 0.6], [thickness, 0.6], [thickness, 0]]}
"""


class ThinBodies(EndToEnd):
    def force(self, thickness, shift):
        """Along x, at the end, on a background whose columns are shifted against the plate."""
        case = self.folder / "plate.yaml"
        case.write_text(PLATE, encoding="utf-8")
        settings = ("--set", f"parameters.thickness={thickness}", "--set", f"parameters.shift={shift}")
        run = self.complete(str(case), *settings, out=f"run-{thickness}-{shift}")
        with open(run.directory / "forces_plate.csv", newline="", encoding="utf-8") as file:
            return float(list(csv.DictReader(file))[-1]["force1 [force/depth]"])

    def test_a_plate_between_two_columns_bears_what_one_on_a_column_bears(self):
        on_a_column = self.force(0.02, 0.01)
        self.assertGreater(on_a_column, 0.2)
        self.assertAlmostEqual(self.force(0.02, -0.015) / on_a_column, 1, delta=0.01)

    def test_a_plate_of_one_cell_whose_faces_are_columns_bears_what_a_shifted_one_bears(self):
        self.assertAlmostEqual(self.force(0.05, 0) / self.force(0.05, 0.02), 1, delta=0.01)


if __name__ == "__main__":
    unittest.main()
