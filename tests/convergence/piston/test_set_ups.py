#!/usr/bin/python3
"""The same piston seen otherwise: turned as a whole, and with the traditional scheme where that is stable."""

import math
import unittest

from studies import Study


class SetUps(Study):
    def test_turned_by_30_degrees_it_has_the_same_errors(self):
        straight, turned = self.converge(levels="2,4"), self.converge("parameters.angle=30", levels="2,4")
        for name in ("rho", "T"):
            for a, b in zip(straight["errors"][name], turned["errors"][name]):
                self.assertAlmostEqual(b / a, 1, delta=1e-6, msg=name)  # the same numbers but for round-off
        for k in range(2):  # v is a vector: its two components together
            v = math.hypot(turned["errors"]["v1"][k], turned["errors"]["v2"][k])
            self.assertAlmostEqual(v / straight["errors"]["v1"][k], 1, delta=1e-6)

    def test_traditional_scheme_works_for_a_heavy_solid(self):
        table = self.converge("interface.projection=traditional", "parameters.density_ratio=1000", levels="4,8")
        self.assert_second_order(table, {}, names=("rho", "v1", "T", "u_bar"))


if __name__ == "__main__":
    unittest.main()
