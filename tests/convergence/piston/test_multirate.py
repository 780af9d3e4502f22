#!/usr/bin/python3
"""A stiff solid takes many small steps within one of the gas: as stable and accurate, with far fewer gas steps."""

import unittest

from studies import GAS, QUARTER, Study

STIFF = (*QUARTER, "parameters.c_p=8")


class Multirate(Study):
    def test_second_order_for_light_and_heavy_solids(self):
        for ratio in ("0.001", "0.1", "10"):
            with self.subTest(density_ratio=ratio):
                self.assert_second_order(self.converge(*STIFF, "time.multirate=true", f"parameters.density_ratio={ratio}"), GAS)

    def test_stable_for_every_density_ratio(self):
        for ratio in ("0.01", "1", "1000"):
            with self.subTest(density_ratio=ratio):
                table = self.converge(*STIFF, "time.multirate=true", f"parameters.density_ratio={ratio}", levels="4,8")
                self.assert_second_order(table, {}, names=("rho", "v1", "T", "v_bar", "P_bar"))

    def test_saves_six_of_seven_gas_steps(self):
        single, multi = self.converge(*STIFF, levels="4"), self.converge(*STIFF, "time.multirate=true", levels="4")
        self.assertGreater(single["steps"][0] / multi["steps"][0], 7)


if __name__ == "__main__":
    unittest.main()
