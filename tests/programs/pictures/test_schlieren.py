#!/usr/bin/python3
"""Numerical schlieren of the gas, with the speed of the solids."""

import sys
import unittest
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from test_pictures import read, ring  # noqa: E402
from fsi_launch.plot.one_run import schlieren  # noqa: E402
from fsi_launch.plot.reading import data, scales  # noqa: E402


class Schlieren(unittest.TestCase):
    def gas(self, density, height=1):
        x1, x2 = np.meshgrid(np.linspace(0, 1, 41), np.linspace(0, height, 21))
        return data.Output(1.0, [read({"x1": x1, "x2": x2, "rho": density(x1, x2)})])

    def test_a_front_is_a_shock_and_a_coarse_smooth_field_is_none(self):
        self.assertTrue(schlieren.has_shocks(self.gas(lambda x, y: 1 + 0.3 * (x > 0.5))))
        self.assertTrue(schlieren.has_shocks(self.gas(lambda x, y: 1 + 0.3 * (x > 0.5) + 0.2 * np.sin(6 * x))))
        self.assertFalse(schlieren.has_shocks(self.gas(lambda x, y: 1 + 0.3 * np.sin(6 * x) * np.cos(6 * y))))
        self.assertFalse(schlieren.has_shocks(self.gas(lambda x, y: 1 + 0.001 * (x > 0.5))))

    def test_a_solid_that_rests_is_plain_and_has_no_colour_bar(self):
        still = ring()
        still.fields |= {"v1": 0 * still.x1, "v2": 0 * still.x1}
        series = [data.Series("fluid", [self.gas(lambda x, y: 1 + 0.3 * (x > 0.5))]), data.Series("body", [data.Output(1.0, [still])])]
        [(_, draw)] = schlieren.pictures(series, scales.Scales(1, 1, 1))
        self.assertEqual(len(draw().axes), 1)
        still.fields["v1"] += 1
        self.assertEqual(len(draw().axes), 2)

    def test_the_speed_of_a_rigid_body_that_turns_is_that_between_its_centre_and_its_outline_too(self):
        """Half-way it is less than half of both together: the centre moves, and the body turns about another point."""
        angle = np.linspace(0, 2 * np.pi, 13)
        x1, x2 = (np.stack([np.full(13, middle), middle + reach(angle)]) for middle, reach in ((0.4, np.cos), (0.7, np.sin)))
        body = read({"x1": x1, "x2": x2, "v1": 0.3 - 2 * (x2 - 0.7), "v2": 0.5 + 2 * (x1 - 0.4)})
        [shown] = data.Output(1.0, [body]).filled
        self.assertGreater(len(shown.x1), 10)
        np.testing.assert_allclose(shown.speed(), np.hypot(0.3 - 2 * (shown.x2 - 0.7), 0.5 + 2 * (shown.x1 - 0.4)), atol=1e-14)
        [inside] = data.Output(1.0, [ring()]).filled
        self.assertEqual(inside.x1.shape, ring().x1.shape)

    def test_walls_are_not_as_white_as_gas_that_rests(self):
        gas = self.gas(lambda x, y: 1 + 0.3 * (x > 0.5))
        gas.grids[0].kind[:8, :15] = 0      # behind a step
        [(_, draw)] = schlieren.pictures([data.Series("fluid", [gas])], scales.Scales(1, 1, 1))
        figure = draw()
        figure.canvas.draw()
        shown = np.asarray(figure.canvas.buffer_rgba())[::-1, :, :3]
        box = figure.axes[0].get_window_extent()

        def colour(x, y):
            return tuple(shown[int(box.y0 + y * box.height), int(box.x0 + x * box.width)])

        self.assertEqual(colour(0.15, 0.8), (255, 255, 255))
        self.assertNotEqual(colour(0.15, 0.15), (255, 255, 255))

    def test_a_long_duct_has_scales_of_its_own_and_room_for_numbers(self):
        for height, thin in ((0.11, False), (0.02, True)):
            [(_, draw)] = schlieren.pictures([data.Series("fluid", [self.gas(lambda x, y: 1 + 0.3 * (x > 0.5), height)])], scales.Scales(1, 1, 1))
            [axes] = draw().axes
            self.assertEqual(axes.get_aspect() == "auto", thin)
        self.assertEqual(schlieren.height_of_panel(4, ((0, 1), (0, 0.02))), schlieren.LOWEST)
        self.assertEqual(schlieren.height_of_panel(4, ((0, 2), (0, 1))), 2)

    def test_a_solid_beside_the_gas_is_within_the_picture(self):
        around = data.Output(1.0, [ring()])
        (left, right), (bottom, top) = schlieren.box(self.gas(lambda x, y: 1 + x), [around])
        self.assertEqual([round(one, 3) for one in (left, right, bottom, top)], [-0.8, 1, -0.8, 1])


if __name__ == "__main__":
    unittest.main()
