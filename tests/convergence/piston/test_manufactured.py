#!/usr/bin/python3
"""The manufactured piston beside the paper's figure 8, with the Courant number of the case and with the paper's."""

import unittest

from studies import Study

# Published errors by h = 1/20, 1/40, 1/80: rho, v1, v2, T, u_bar, v_bar, P_bar.
NAMES = ("rho", "v1", "v2", "T", "u_bar", "v_bar", "P_bar")
PAPER = ((1.8e-5, 6.9e-4, 9.4e-5, 1.1e-4, 1.2e-4, 6.9e-4, 9.7e-5), (4.8e-6, 1.7e-4, 2.3e-5, 3.4e-5, 3.3e-5, 1.7e-4, 2.4e-5),
         (1.2e-6, 4.3e-5, 5.1e-6, 8.9e-6, 8.7e-6, 4.3e-5, 5.9e-6))
# The density's is that of the velocity times rho / a, and a is smaller than in the paper (docs/figures.md, figure 8).
DENSITY_ON_THE_COARSEST = 1.15
MIN_RATE = 1.8  # least squares; v2, five times below the paper's, falls the slowest: 1.84 at 0.9


class Figure8(Study):
    def check(self, part, *settings):
        """Errors below this part of the paper's, the density's on the coarsest grid apart, and second order."""
        table = self.converge(*settings, levels="2,4,8", case="manufactured_piston")
        for level, paper in enumerate(PAPER):
            for name, error in zip(NAMES, paper):
                bound = DENSITY_ON_THE_COARSEST if (level, name) == (0, "rho") else part
                self.assertLess(table["errors"][name][level], bound * error, (name, level))
        for name in NAMES:
            self.assertGreaterEqual(table["fitted"][name], MIN_RATE, (name, table["errors"][name]))

    def test_errors_of_the_case(self):
        self.check(0.6)

    def test_errors_at_the_papers_courant_number(self):
        self.check(0.9, "time.cfl=0.9", "expect={}")


if __name__ == "__main__":
    unittest.main()
