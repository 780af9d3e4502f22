#!/usr/bin/python3
"""Rates of convergence recover the order of made-up errors."""

import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
import launcher  # noqa: E402,F401  the path of the launcher's modules
from fsi_launch.studies import converge  # noqa: E402


class Rates(unittest.TestCase):
    LEVELS = [2, 4, 8, 16]

    def test_power_law_is_recovered(self):
        errors = [3e-2 * j**-1.9 for j in self.LEVELS]
        self.assertAlmostEqual(converge.fitted_rate(self.LEVELS, errors), 1.9)
        for rate in converge.pairwise_rates(self.LEVELS, errors):
            self.assertAlmostEqual(rate, 1.9)

    def test_unequal_levels(self):
        levels = [3, 4, 10]
        self.assertAlmostEqual(converge.pairwise_rates(levels, [j**-2.0 for j in levels])[1], 2.0)

    def test_missing_and_zero_errors_give_no_rate(self):
        self.assertEqual(converge.pairwise_rates([2, 4, 8], [1e-3, None, 0.0]), [None, None])
        self.assertIsNone(converge.fitted_rate([2, 4], [1e-3, None]))

    def test_error_at_round_off_needs_no_rate(self):
        runs = [{"errors": {"rho": j**-1.0, "v2": 1e-16}, "steps": 1, "wall_s": 1.0} for j in (2, 4)]
        self.assertEqual(list(converge.too_low(converge.fitted(converge.table([2, 4], runs, ["rho", "v2"])), 1.9)), ["rho"])

    def test_table_as_text_and_markdown(self):
        runs = [{"errors": {"rho": j**-2.0}, "steps": 10 * j, "wall_s": 1.0} for j in (2, 4)]
        result = converge.table([2, 4], runs, ["rho"])
        self.assertIn("1/40  6.25e-02  2.00", converge.as_text(result))
        self.assertTrue(converge.as_markdown(result).startswith("| h | rho | rate | steps | wall [s] |\n|---|"))


if __name__ == "__main__":
    unittest.main()
