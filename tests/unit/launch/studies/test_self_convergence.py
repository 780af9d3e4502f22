#!/usr/bin/python3
"""Without a reference solution grids are compared with each other: made-up paths show their order."""

import math
import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
import launcher  # noqa: E402,F401  the path of the launcher's modules
from fsi_launch.studies import self_convergence  # noqa: E402

COLUMNS = ("t [time]", "centre1 [length]", "centre2 [length]", "velocity1 [length/time]", "velocity2 [length/time]", "angle [rad]")


def write_run(folder, h, angle=None, columns=len(COLUMNS)):
    """A body whose centre is off by 3 h^2 and whose angle by h, or that has turned by `angle`, at three times."""
    folder.mkdir()
    lines = [",".join(COLUMNS[:columns])]
    for t in (0, 0.5, 1):
        lines.append(",".join(str(value) for value in (t, t + 3 * h**2 * t, -t, 1.0, -1.0, 0.2 + h * t if angle is None else angle)[:columns]))
    (folder / "forces_body.csv").write_text("\n".join(lines) + "\n", encoding="utf-8")


class SelfConvergence(unittest.TestCase):
    def compare(self, levels, angles=(), **given):
        with tempfile.TemporaryDirectory(prefix="fsi-self-") as scratch:
            folders = [Path(scratch) / str(j) for j in levels]
            for k, (folder, j) in enumerate(zip(folders, levels)):
                write_run(folder, 1 / (10 * j), angles[k] if angles else None, **given)
            rows = self_convergence.compare(levels, folders, [0.5, 1])
        return {(row.quantity, row.t): row for row in rows}

    def test_orders_are_those_of_the_paths(self):
        rows = self.compare([4, 8, 16])
        self.assertAlmostEqual(rows["centre", 1].differences[0], 3 * (1 / 40**2 - 1 / 80**2), places=14)
        self.assertAlmostEqual(rows["centre", 0.5].orders[0], 2, places=6)
        self.assertAlmostEqual(rows["angle", 1].orders[0], 1, places=6)

    def test_angles_on_both_sides_of_half_a_turn_are_near(self):
        found = self.compare([4, 8, 16], angles=(3.13, -3.1411, 3.1412))["angle", 1].differences
        for value, expected in zip(found, (2 * math.pi - 6.2711, 2 * math.pi - 6.2823)):
            self.assertAlmostEqual(value, expected, places=12)

    def test_columns_that_a_solid_of_ones_own_does_not_write_have_no_rows(self):
        self.assertEqual({quantity for quantity, _ in self.compare([4, 8, 16], columns=5)}, {"centre", "velocity"})

    def test_equal_values_have_no_order(self):
        self.assertEqual(self.compare([4, 8, 16])["velocity", 1].orders, [None])

    def test_round_off_has_no_order_and_small_values_have_one(self):
        self.assertEqual(self_convergence.orders([4, 8, 16], [4e-15, 1e-15], 1), [None])
        self.assertAlmostEqual(self_convergence.orders([4, 8, 16], [4e-15, 1e-15], 1e-6)[0], 2)

    def rows_of(self, values, gas=None):
        """{quantity: Row} at the end of a body with these (centre1, velocity1, angle) on three grids; `gas`: its largest speed."""
        with tempfile.TemporaryDirectory(prefix="fsi-self-") as scratch:
            folders = [Path(scratch) / str(j) for j in (4, 8, 16)]
            for folder, (centre, velocity, angle) in zip(folders, values):
                folder.mkdir()
                lines = [",".join(COLUMNS), *(",".join(map(str, (t, centre, 0, velocity, 0, angle))) for t in (0, 1))]
                (folder / "forces_body.csv").write_text("\n".join(lines) + "\n", encoding="utf-8")
                if gas:
                    (folder / "summary.json").write_text(f'{{"interface": {{"velocity_scale": {gas}}}}}', encoding="utf-8")
            return {row.quantity: row for row in self_convergence.compare([4, 8, 16], folders, [1])}

    def test_a_quantity_that_is_round_off_of_others_like_it_has_no_order(self):
        rows = self.rows_of([(1.16, 2e-13, 4e-20), (1.04, 4e-14, 1e-20), (1.01, 1e-14, 2e-21)], gas=340.0)
        self.assertAlmostEqual(rows["centre"].orders[0], 2)
        self.assertEqual((rows["velocity"].orders, rows["angle"].orders), ([None], [None]))
        self.assertEqual(rows["velocity"].round_off, 340e-13)
        self.assertAlmostEqual(self.rows_of([(1, 1.6e-9, 1.6e-7), (1, 4e-10, 4e-8), (1, 1e-10, 1e-8)], gas=340.0)["velocity"].orders[0], 2)

    def test_places_are_compared_with_the_reach_of_the_bodies(self):
        import numpy as np
        tables = [{"body": {1.0: {"centre1": 1e-19, "centre2": 0.0, "angle": 3.0}}}]
        sizes = self_convergence._sizes(tables, [{"body": {1.0: np.array([[0.5, 0.0], [0.0, -2.0]])}}], ["nowhere"])
        self.assertEqual(sizes, {"centre": 2.0, "boundary": 2.0, "velocity": 0.0, "angle": 3.0})

    def test_levels_that_are_not_in_one_ratio_have_no_order(self):
        self.assertEqual(self.compare([2, 4, 16])["centre", 1].orders, [None])

    def test_a_curve_through_few_points_is_refined_without_error_where_it_is_smooth(self):
        import numpy as np
        angle = np.linspace(0, 2 * np.pi, 31)
        fine = self_convergence._refined(np.column_stack([1.25 * np.cos(angle), 0.5 * np.sin(angle)]))
        self.assertLess(np.abs((fine[:, 0] / 1.25) ** 2 + (fine[:, 1] / 0.5) ** 2 - 1).max(), 1e-13)


if __name__ == "__main__":
    unittest.main()
