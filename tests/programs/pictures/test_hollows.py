#!/usr/bin/python3
"""Bodies without a grid, whose cells leave them where they are hollow."""

import sys
import unittest
from pathlib import Path

import numpy as np
from matplotlib import pyplot

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
import running  # noqa: E402,F401
from fsi_launch.plot.look import shading  # noqa: E402
from fsi_launch.plot.reading import data  # noqa: E402


class Hollows(unittest.TestCase):
    """A rigid body has its outline and its centre alone, which may lie outside it."""

    def colours_at(self, draw, *places):
        """What is seen there of a thick half ring, open to the left, about a centre in its hollow."""
        along = np.linspace(-0.5, 0.5, 41) * np.pi
        x = np.concatenate([np.cos(along), 0.6 * np.cos(along[::-1]), [0]])
        y = np.concatenate([np.sin(along), 0.6 * np.sin(along[::-1]), [-1]])
        grid = data._read_grid("body", {"x1": np.stack([x, 0 * x + 0.4]), "x2": np.stack([y, 0 * y]), "v1": np.ones((2, len(x))), "v2": np.zeros((2, len(x)))})
        figure = pyplot.figure(figsize=(2, 2), dpi=50)
        self.addCleanup(pyplot.close, figure)
        axes = figure.add_axes([0, 0, 1, 1])
        axes.set(xlim=(-1.2, 1.2), ylim=(-1.2, 1.2))
        axes.axis("off")
        draw(axes, grid)
        figure.canvas.draw()
        seen = np.asarray(figure.canvas.buffer_rgba())[::-1, :, :3]
        return [tuple(seen[round((1.2 + y) / 2.4 * 99), round((1.2 + x) / 2.4 * 99)]) for x, y in places]

    def test_are_left_free(self):
        white = (255, 255, 255)
        for draw in (lambda axes, grid: shading.plain(axes, grid, "black"),
                     lambda axes, grid: shading.shade(axes, grid, np.ones(grid.x1.shape), "gray", (1, 2)),
                     lambda axes, grid: shading.shade(axes, grid.filled(), grid.filled()["v1"], "gray", (1, 2))):
            hollow, beside, *body = self.colours_at(draw, (0.5, 0), (0.3, 0.3), (0.8, 0), (0.55, 0.55), (0.55, -0.55), (0.1, 0.8))
            self.assertEqual([hollow, beside], [white, white])
            self.assertNotIn(white, body)


if __name__ == "__main__":
    unittest.main()
