#!/usr/bin/python3
"""A stiff solid takes many small steps within one of the gas: as stable and accurate, with far fewer gas steps."""

import unittest

from studies import GAS, Study

STIFF = "parameters.c_p=8"


class Multirate(Study):
    def test_second_order_for_every_density_ratio(self):
        for ratio in ("0.001", "0.01", "0.1", "1", "10", "1000"):
            with self.subTest(density_ratio=ratio):
                table = self.converge(STIFF, "time.multirate=true", f"parameters.density_ratio={ratio}")
                self.assert_second_order(table, GAS, names=("rho", "v1"))
                # The solid's errors, an order of magnitude below the gas's, are not yet asymptotic on these grids:
                # v_bar falls by 2.1 then 1.6, u_bar by 1.4 then 1.75.
                self.assert_second_order(table, {}, names=("v_bar",), min_rate=1.75)
                self.assert_second_order(table, {}, names=("u_bar",), min_rate=1.5)

    def test_saves_seven_of_eight_gas_steps(self):
        single, multi = self.converge(STIFF, levels="4"), self.converge(STIFF, "time.multirate=true", levels="4")
        self.assertGreater(single["steps"][0] / multi["steps"][0], 6.5)


if __name__ == "__main__":
    unittest.main()
