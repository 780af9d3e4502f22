#!/usr/bin/python3
"""A case that is turned by a right angle gives the turned result, to round-off: no side of any grid comes first."""

import csv
import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from running import EndToEnd  # noqa: E402

# A flap stands on a wall, in a stream along the wall that has just begun.
COMMON = """
grid: {factor: 2}
time: {end: 0.6, multirate: true}
output: {every: 0.6}
"""
GAS = """
fluid:
  gamma: 1.4
  p_e: 1
  grid: {x: %(x)s, y: %(y)s}
  boundary: {%(wall)s: slip_wall, %(far)s: outflow, %(from)s: {kind: inflow, state: {rho: 1.2, v: %(v)s, p: 1.2}}, %(to)s: outflow}
  initial: {rho: 1, v: [0, 0], p: 1}
solids:
  flap:
    law: neo_hookean
    rho: 3
    lambda: 40
    mu: 20
    shape: {kind: polygon, radius: 0, corners: %(corners)s, walls: [%(wall)s, %(wall)s]}
    boundary: {%(wall)s: clamped, %(far)s: free, %(from)s: free, %(to)s: free}
"""
UPRIGHT = {"x": "[-1, 1]", "y": "[0, 2]", "wall": "bottom", "far": "top", "from": "right", "to": "left", "v": "[-0.3, 0]",
           "corners": "[[-0.1, 0], [-0.1, 0.6], [0.1, 0.6], [0.1, 0]]"}
TURNED = {"x": "[0, 2]", "y": "[-1, 1]", "wall": "left", "far": "right", "from": "bottom", "to": "top", "v": "[0, 0.3]",
          "corners": "[[0, 0.1], [0.6, 0.1], [0.6, -0.1], [0, -0.1]]"}


class Turned(EndToEnd):
    def last_line(self, name, words):
        case = self.folder / f"{name}.yaml"
        case.write_text(COMMON + GAS % words, encoding="utf-8")
        run = self.complete(str(case), out=name)
        with open(run.directory / "forces_flap.csv", newline="", encoding="utf-8") as file:
            return {key.split(" ")[0]: float(value) for key, value in list(csv.DictReader(file))[-1].items()}

    def test_a_flap_in_a_stream(self):
        upright, turned = self.last_line("upright", UPRIGHT), self.last_line("turned", TURNED)
        self.assertGreater(abs(upright["force1"]), 0.02)
        self.assertGreater(abs(upright["velocity1"]), 1e-3)
        for name in ("force", "centre", "velocity"):
            for of_upright, of_turned in ((upright[f"{name}1"], -turned[f"{name}2"]), (upright[f"{name}2"], turned[f"{name}1"])):
                self.assertAlmostEqual(of_upright, of_turned, delta=1e-9, msg=name)
        self.assertAlmostEqual(upright["moment"], turned["moment"], delta=1e-9)


if __name__ == "__main__":
    unittest.main()
