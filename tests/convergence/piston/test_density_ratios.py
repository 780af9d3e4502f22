#!/usr/bin/python3
"""The added-mass projections are stable and second order from very light to very heavy solids."""

import unittest

from studies import GAS, MIN_RATE, SOLID, Study


class DensityRatios(Study):
    def test_every_ratio_with_both_projections(self):
        for projection in ("full", "simplified"):
            for ratio in ("0.001", "0.01", "0.1", "1", "10", "1000"):
                with self.subTest(projection=projection, density_ratio=ratio):
                    table = self.converge(f"interface.projection={projection}", f"parameters.density_ratio={ratio}")
                    # Light solids come to second order from below: 1.6, then 1.8 between these grids.
                    rate = 1.6 if float(ratio) < 0.1 else MIN_RATE
                    self.assert_second_order(table, GAS | SOLID.get(ratio, {}), min_rate=rate)


if __name__ == "__main__":
    unittest.main()
