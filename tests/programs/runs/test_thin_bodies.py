#!/usr/bin/python3
"""Plates and beams thinner than a cell: neither whether a column of the background stands in them nor the wall they stand on makes a difference to their forces."""

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

# A puff comes to a beam of half a cell that stands between two lines of the background, whose end lies on one; h = 0.1.
BEAM = """
parameters: {gamma: 1.4}
definitions: {puff: "0.8 * exp(-((x - (PUFF_X))^2 + (y - (PUFF_Y))^2) / 0.04)"}
grid: {factor: 1}
time: {end: 0.5}
fluid:
  gamma: gamma
  p_e: 1 / gamma
  grid: {x: [-1, 1], y: [-1, 1]}
  boundary: {left: slip_wall, right: slip_wall, bottom: slip_wall, top: slip_wall}
  initial: {rho: 1 + puff, v: [0, 0], p: (1 + puff)^1.4 / 1.4}
solids:
  beam:
    law: beam
    rho: 5
    lambda: 30
    mu: 30
    shape: {kind: polygon, radius: 0, walls: [WALL, WALL], corners: CORNERS}
    beam: {line: LINE, thickness: 0.05, ends: [clamped, free]}
    boundary: {SIDES}
"""
WALLS = ("bottom", "right", "top", "left")   # one follows from the other by a quarter turn


# A reed of 0.2 mm on the floor of a shock tube, of which nothing is given but what it is: its tip goes by half a cell.
REED = """
units: SI
parameters: {rho_0: 1.161, p_0: 1e5, p_4: 1.2e5, d: 0.0002, length: 0.02}
grid: {factor: 50}
time: {end: 0.0008}
fluid:
  p_e: p_0
  grid: {x: [-0.15, 0.15], y: [0, 0.05]}
  boundary: {left: slip_wall, right: outflow, bottom: slip_wall, top: slip_wall}
  initial: {rho: "x < -0.03 ? rho_0 * p_4 / p_0 : rho_0", v: [0, 0], p: "x < -0.03 ? p_4 : p_0"}
solids:
  reed:
    law: beam
    rho: 7850
    E: 205e9
    nu: 0.29
    beam: {line: [[0, 0], [0, length]], thickness: d, ends: [clamped, free]}
    shape: {kind: polygon, corners: [[-d/2, 0], [-d/2, length], [d/2, length], [d/2, 0]], radius: 0, walls: [bottom, bottom]}
output: {probes: [{name: tip, in: reed, x: 0, y: length}]}
"""

class ThinBodies(EndToEnd):
    def forces(self, turns):
        """Of the beam on one of the walls, turned back, at each step: (force1, force2, moment)."""
        def turned(x, y):
            for _ in range(turns):
                x, y = -y, x
            return [x, y]

        puff = turned(-0.4, -0.5)
        text = BEAM.replace("PUFF_X", str(puff[0])).replace("PUFF_Y", str(puff[1]))
        sides = ", ".join(f"{wall}: {'clamped' if wall == WALLS[turns] else 'free'}" for wall in WALLS)
        text = text.replace("WALL", WALLS[turns]).replace("SIDES", sides)
        text = text.replace("CORNERS", str([turned(*corner) for corner in ((0.105, -1), (0.105, -0.4), (0.155, -0.4), (0.155, -1))]))
        text = text.replace("LINE", str([turned(0.13, -1), turned(0.13, -0.4)]))
        case = self.folder / f"beam-{turns}.yaml"
        case.write_text(text, encoding="utf-8")
        run = self.complete(str(case), out=f"beam-run-{turns}")
        with open(run.directory / "forces_beam.csv", newline="", encoding="utf-8") as file:
            rows = [[float(value) for value in row[1:4]] for row in list(csv.reader(file))[1:]]
        for row in rows:
            for _ in range(turns):
                row[:2] = row[1], -row[0]
        return rows

    def test_a_beam_moves_alike_on_every_wall(self):
        on_the_floor = self.forces(0)
        most = max(abs(value) for row in on_the_floor for value in row)
        self.assertGreater(most, 0.01)
        for turns in (1, 2, 3):
            rows = self.forces(turns)
            self.assertEqual(len(rows), len(on_the_floor))
            for row, other in zip(rows, on_the_floor):
                for value, expected in zip(row, other):
                    self.assertAlmostEqual(value, expected, delta=1e-11)
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


class Reed(EndToEnd):
    def test_the_grids_that_are_chosen_hold_while_it_bends(self):
        case = self.folder / "reed.yaml"
        case.write_text(REED, encoding="utf-8")
        run = self.complete(case)
        with (run.directory / "probes.csv").open(encoding="utf-8", newline="") as table:
            ways = [abs(float(value)) for row in csv.DictReader(table) for name, value in row.items() if name.startswith("tip.u1")]
        self.assertGreater(max(ways), 8e-4)


if __name__ == "__main__":
    unittest.main()
