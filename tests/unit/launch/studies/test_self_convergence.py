#!/usr/bin/python3
"""Without a reference solution grids are compared with each other: made-up paths show their order."""

import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
import launcher  # noqa: E402,F401  the path of the launcher's modules
from fsi_launch.studies import self_convergence  # noqa: E402

COLUMNS = ("t [time]", "centre1 [length]", "centre2 [length]", "velocity1 [length/time]", "velocity2 [length/time]", "angle [rad]")


def write_run(folder, h):
    """A body whose centre is off by 3 h^2 and whose angle by h, at three times."""
    folder.mkdir()
    lines = [",".join(COLUMNS)]
    for t in (0, 0.5, 1):
        lines.append(",".join(str(value) for value in (t, t + 3 * h**2 * t, -t, 1.0, -1.0, 0.2 + h * t)))
    (folder / "forces_body.csv").write_text("\n".join(lines) + "\n", encoding="utf-8")


class SelfConvergence(unittest.TestCase):
    def compare(self, levels):
        with tempfile.TemporaryDirectory(prefix="fsi-self-") as scratch:
            folders = [Path(scratch) / str(j) for j in levels]
            for folder, j in zip(folders, levels):
                write_run(folder, 1 / (10 * j))
            rows = self_convergence.compare(levels, folders, [0.5, 1])
        return {(row.quantity, row.t): row for row in rows}

    def test_orders_are_those_of_the_paths(self):
        rows = self.compare([4, 8, 16])
        self.assertAlmostEqual(rows["centre", 1].differences[0], 3 * (1 / 40**2 - 1 / 80**2), places=14)
        self.assertAlmostEqual(rows["centre", 0.5].orders[0], 2, places=6)
        self.assertAlmostEqual(rows["angle", 1].orders[0], 1, places=6)

    def test_equal_values_have_no_order(self):
        self.assertEqual(self.compare([4, 8, 16])["velocity", 1].orders, [None])

    def test_levels_that_are_not_in_one_ratio_have_no_order(self):
        self.assertEqual(self.compare([2, 4, 16])["centre", 1].orders, [None])

    def test_a_curve_through_few_points_is_refined_without_error_where_it_is_smooth(self):
        import numpy as np
        angle = np.linspace(0, 2 * np.pi, 31)
        fine = self_convergence._refined(np.column_stack([1.25 * np.cos(angle), 0.5 * np.sin(angle)]))
        self.assertLess(np.abs((fine[:, 0] / 1.25) ** 2 + (fine[:, 1] / 0.5) ** 2 - 1).max(), 1e-13)


if __name__ == "__main__":
    unittest.main()
