"""Colours over a component grid: an image of one with even lines along the axes, triangles of others."""

import numpy as np
from matplotlib.collections import TriMesh
from matplotlib.colors import ListedColormap
from matplotlib.image import AxesImage
from matplotlib.patches import Polygon, Rectangle

from fsi_launch.plot.reading import mesh

EVEN = 1e-6     # part of the spacing by which lines may lie elsewhere and an image still shows them where they are


def _is_even(x, axis):
    steps = np.diff(x, axis=axis)
    return bool(steps.size and steps.min() > 0 and np.ptp(steps) <= EVEN * steps.max() and np.ptp(x, axis=1 - axis).max() <= EVEN * steps.max())


def _image(axes, grid, values):
    """Smooth between the points, as triangles are; a hundred times as fast where there are many."""
    left, right, bottom, top = grid.x1[0, 0], grid.x1[0, -1], grid.x2[0, 0], grid.x2[-1, 0]
    h1, h2 = (right - left) / (grid.x1.shape[1] - 1), (top - bottom) / (grid.x1.shape[0] - 1)
    drawn = AxesImage(axes, origin="lower", interpolation="bilinear", zorder=1,
                      extent=(left - h1 / 2, right + h1 / 2, bottom - h2 / 2, top + h2 / 2))
    drawn.set_data(np.ma.masked_array(values, ~grid.used()))
    axes.add_image(drawn)
    drawn.set_clip_path(Rectangle((left, bottom), right - left, top - bottom, transform=axes.transData))
    return drawn


def _triangles(axes, grid, values):
    triangles = mesh.triangles(grid, values=values)
    if not triangles:
        return None
    drawn = TriMesh(triangles)
    drawn.set_array(np.where(grid.used(), values, 0).ravel())
    axes.add_collection(drawn, autolim=False)   # the box is known; finding it takes longer than the drawing
    if grid.fan:
        drawn.set_clip_path(Polygon(mesh.rim_of_fan(grid), transform=axes.transData))
    return drawn


def plain(axes, grid, colour):
    """The cells between used points in one colour."""
    drawn = _triangles(axes, grid, np.zeros(grid.x1.shape))
    if drawn is not None:
        drawn.set_cmap(ListedColormap([colour]))


def shade(axes, grid, values, colours, limits):
    """Draws `values`, one for each point, between the `limits` of the map `colours`; returns what a colour bar needs, None where no point
    is used."""
    if not grid.used().any():
        return None
    drawn = (_image if _is_even(grid.x1, 1) and _is_even(grid.x2, 0) else _triangles)(axes, grid, values)
    if drawn is not None:
        drawn.set_cmap(colours)
        drawn.set_clim(*limits)
    return drawn
