"""Cells of component grids as pictures need them: only those between used points, as triangles."""

import numpy as np
from matplotlib.path import Path
from matplotlib.tri import Triangulation

from fsi_launch.plot.reading.data import INTERPOLATED


def cells(used):
    """Which cells have used points at all four corners; one fewer than the points each way."""
    return used[:-1, :-1] & used[:-1, 1:] & used[1:, :-1] & used[1:, 1:]


def corners(shape):
    """Numbers of the four corners of every cell, in order around it: (n2 - 1, n1 - 1, 4)."""
    number = np.arange(shape[0] * shape[1]).reshape(shape)
    return np.stack([number[:-1, :-1], number[:-1, 1:], number[1:, 1:], number[1:, :-1]], axis=-1)


def _welded(grid):
    """Corners of every cell; the last column of a grid that closes on itself is the first one."""
    quads = corners(grid.x1.shape)
    if grid.closed:
        quads[:, -1, 1], quads[:, -1, 2] = quads[:, 0, 0], quads[:, 0, 3]
    return quads


def triangles(grid, shown=None, values=None):
    """The cells `shown` (all between used points unless told) as two triangles each; None if there are none. With `values`, one for
    each point, a cell is cut where they differ less: a front that crosses cells has no teeth then, whichever way it leans."""
    quads = _welded(grid)[cells(grid.used()) if shown is None else shown]
    if not len(quads):
        return None
    if values is not None:
        corner = np.asarray(values).ravel()[quads]
        other = np.abs(corner[:, 0] - corner[:, 2]) > np.abs(corner[:, 1] - corner[:, 3])
        quads[other] = np.roll(quads[other], 1, axis=1)
    return Triangulation(grid.x1.ravel(), grid.x2.ravel(), np.concatenate([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]]))


def _closes_upwards(grid):
    """True where the last line is the first one again: a mapped grid that is periodic along j."""
    gap = np.hypot(grid.x1[-1] - grid.x1[0], grid.x2[-1] - grid.x2[0])
    return bool((gap <= 1e-9 * np.hypot(np.ptp(grid.x1), np.ptp(grid.x2))).all())


def _loops(grid):
    """The rim as closed lines: two for a ring."""
    if grid.closed:
        parts = [[np.s_[0, :]], [np.s_[-1, :]]]
    elif _closes_upwards(grid):
        parts = [[np.s_[:, 0]], [np.s_[:, -1]]]
    else:
        parts = [[np.s_[0, :], np.s_[:, -1], np.s_[-1, ::-1], np.s_[::-1, 0]]]
    return [np.column_stack([np.concatenate([x[p] for p in part]) for x in (grid.x1, grid.x2)]) for part in parts]


def rim_of_fan(grid):
    """Its outline there and the line inside it back: in a hollow its cells leave the body."""
    return np.column_stack([np.concatenate([x[0], x[-1, ::-1]]) for x in (grid.x1, grid.x2)])


def runs(used):
    """Index ranges of the used points of a line."""
    parts = np.split(np.arange(len(used)), np.flatnonzero(np.diff(used)) + 1)
    return [part for part in parts if used[part[0]]]


def outer_lines(grid):
    """Parts of the rim of a grid where its region ends: not those that lie within another grid."""
    if grid.used().all() and (grid.kind != INTERPOLATED).all():
        return _loops(grid)
    lines = []
    for side in (np.s_[0, :], np.s_[-1, :], *(() if grid.closed else (np.s_[:, 0], np.s_[:, -1]))):
        for run in runs(grid.used()[side]):
            if (grid.kind[side][run] == INTERPOLATED).mean() < 0.5:
                lines.append(np.column_stack([grid.x1[side][run], grid.x2[side][run]]))
    return lines


def level_outline(grid):
    """Segments (count, 2, 2) where the cells of a level end within the rectangle: at a finer or a coarser level."""
    shown = cells(grid.used())
    x, y = grid.x1[0], grid.x2[:, 0]
    j, i = np.nonzero(shown[:, 1:] != shown[:, :-1])
    upright = np.stack([np.column_stack([x[i + 1], y[j]]), np.column_stack([x[i + 1], y[j + 1]])], axis=1)
    j, i = np.nonzero(shown[1:] != shown[:-1])
    level = np.stack([np.column_stack([x[i], y[j + 1]]), np.column_stack([x[i + 1], y[j + 1]])], axis=1)
    return np.concatenate([upright, level])


def uncovered(grid, others):
    """Cells between used points that do not lie wholly within one of the grids laid over this one."""
    shown = cells(grid.used())
    points = np.column_stack([grid.x1.ravel(), grid.x2.ravel()])
    for other in others:
        if not other.used().all():
            continue  # its unused points leave a hole that this grid must show through
        inside = np.zeros(len(points), dtype=bool)
        for loop in _loops(other):
            inside ^= Path(loop).contains_points(points)
        shown = shown & ~cells(inside.reshape(grid.x1.shape))
    return shown
