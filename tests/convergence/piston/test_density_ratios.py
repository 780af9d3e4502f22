#!/usr/bin/python3
"""The added-mass projections are stable and second order from very light to very heavy solids."""

import unittest

from studies import GAS, QUARTER, SOLID, Study


class DensityRatios(Study):
    def test_every_ratio_with_the_simplified_projection(self):
        for ratio in ("0.001", "0.01", "0.1", "1", "10", "1000"):
            with self.subTest(density_ratio=ratio):
                self.assert_second_order(self.converge(*QUARTER, f"parameters.density_ratio={ratio}"), GAS | SOLID.get(ratio, {}))

    def test_the_full_projection_gives_the_same_errors(self):
        for ratio in ("0.001", "0.1", "1000"):
            with self.subTest(density_ratio=ratio):
                setting = f"parameters.density_ratio={ratio}"
                simplified = self.converge(setting, levels="4")
                full = self.converge(setting, "interface.projection=full", levels="4")
                for name in ("rho", "v1", "u_bar", "v_bar", "P_bar"):
                    # One-dimensional motion of a linear solid: the two projections are one, up to round-off.
                    self.assertAlmostEqual(full["errors"][name][0] / simplified["errors"][name][0], 1, delta=1e-6, msg=name)


if __name__ == "__main__":
    unittest.main()
