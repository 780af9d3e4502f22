#!/usr/bin/python3
"""Pictures of several runs: outlines of bodies that stand on walls, labels of any length, and no folder without a picture."""

import contextlib
import io
import sys
import tempfile
import unittest
from pathlib import Path

import numpy as np
from matplotlib import pyplot

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
import running  # noqa: E402, F401
from fsi_launch.failure import UserMistake  # noqa: E402
from fsi_launch.plot.reading import data  # noqa: E402
from fsi_launch.plot.look import style  # noqa: E402
from fsi_launch.plot.several_runs import compare, outlines  # noqa: E402


def setUpModule():
    style.use()


def grid(x1, x2, **fields):
    return data._read_grid("grid", {"x1": x1, "x2": x2, "x1_bar": x1, "x2_bar": x2} | fields)


def block(lean=0.0):
    """A bar of width 1 and height 2 on y = 0."""
    x1, x2 = np.meshgrid(np.linspace(0, 1, 5), np.linspace(0, 2, 9))
    return data._read_grid("body", {"x1": x1 + lean * x2, "x2": x2, "x1_bar": x1, "x2_bar": x2})


def arch(turned=False):
    """Grids of half a disk of radius 1 on y = 0: a lattice, and a strip whose outer line follows the half circle."""
    angle, r = np.meshgrid(np.linspace(0, np.pi, 41), np.linspace(0.7, 1, 4))
    kind = np.full(r.shape, data.DISCRETISED)
    kind[0] = data.INTERPOLATED
    x1, x2 = np.meshgrid(np.linspace(-1, 1, 21), np.linspace(0, 1, 11))
    strip = [r * np.cos(angle), r * np.sin(angle), kind]
    strip = [values[::-1] if turned else values for values in strip]
    return [grid(x1, x2), grid(strip[0], strip[1], kind=strip[2])]


def series(make, times=(0.0, 0.5, 1.0)):
    return [data.Series("body", [data.Output(t, make(t)) for t in times])]


class Outlines(unittest.TestCase):
    def test_a_block_on_a_wall_has_all_of_its_rim(self):
        curve = outlines.outline([block()])
        self.assertAlmostEqual(np.hypot(*np.diff(curve, axis=0).T).sum(), 6)
        self.assertTrue((curve[0] == curve[-1]).all())

    def test_one_side_of_a_body_is_compared_with_the_whole_rim_of_another(self):
        rim, side = outlines.outline([block()]), np.array([[1.1, 0], [1.1, 2]])
        for one, other in ((rim, side), (side, rim)):
            self.assertAlmostEqual(outlines.apart(one, other), 0.1)
        self.assertAlmostEqual(outlines.apart(side, side + [0.2, 0]), 0.2)
        self.assertAlmostEqual(outlines.apart(rim, 2 * rim), np.hypot(1, 2))

    def test_a_body_of_several_grids_has_the_side_that_does_not_lie_within_it(self):
        for turned in (False, True):
            curve = outlines.outline(arch(turned))
            np.testing.assert_allclose(np.hypot(*curve.T), 1)
            self.assertGreater(np.hypot(*(curve[0] - curve[-1])), 1.9)

    def test_a_body_without_a_grid_along_it_has_none_and_that_is_said(self):
        lattice = arch()[0]
        self.assertIsNone(outlines.outline([lattice, lattice]))
        with contextlib.redirect_stderr(io.StringIO()) as said, tempfile.TemporaryDirectory() as place:
            self.assertEqual(list(outlines.pictures([series(lambda t: [lattice, lattice])] * 2, ["a", "b"], Path(place))), [])
        self.assertIn("body is left out", said.getvalue())

    def test_convergence_takes_closed_ones_alone(self):
        self.assertEqual(outlines.of(series(lambda t: [block()]), outlines.ring), [])

    def test_blocks_of_two_runs_are_compared(self):
        runs = [series(lambda t, lean=lean: [block(lean * t)]) for lean in (0.1, 0.2)]
        with tempfile.TemporaryDirectory() as place, contextlib.redirect_stdout(io.StringIO()) as said:
            [(name, figure)] = outlines.pictures(runs, ["a", "b"], Path(place) / "new")
            self.addCleanup(pyplot.close, figure)
            self.assertEqual(name, "outlines_body")
            self.assertTrue((Path(place) / "new" / "outlines.csv").is_file())
        self.assertIn("outlines of a and b at t = 1 are up to 2.00e-01 apart", said.getvalue())

    def test_a_long_label_leaves_the_outline_as_large_as_a_short_one_and_lies_within_the_picture(self):
        sizes = []
        with tempfile.TemporaryDirectory() as place, contextlib.redirect_stdout(io.StringIO()):
            for words in ("mach = {}", ", ".join(f"parameter_{k} = {k}.0000" for k in range(12)) + ", mach = {}"):
                runs = [series(lambda t: [grid(4 * one.x1, one.x2) for one in [block()]])] * 2
                [(_, figure)] = outlines.pictures(runs, [words.format(2), words.format(3)], Path(place))
                style.save(figure, Path(place) / "picture.png")
                axes = figure.axes[0]
                inside = axes.get_window_extent()
                sizes.append(min(inside.width / np.ptp(axes.get_xlim()), inside.height / np.ptp(axes.get_ylim())))
                legend = axes.get_legend().get_window_extent()
                self.assertLess(legend.x1, figure.bbox.width + style.BEYOND * figure.dpi)
                self.assertFalse(legend.overlaps(inside))
        self.assertAlmostEqual(sizes[1] / sizes[0], 1, delta=0.15)

    def test_names_of_times_stay_above_the_numbers_of_the_axis(self):
        with tempfile.TemporaryDirectory() as place, contextlib.redirect_stdout(io.StringIO()):
            [(_, figure)] = outlines.pictures([series(lambda t: [grid(2 * one.x1, one.x2) for one in [block()]])] * 2, ["a", "b"], Path(place))
            style.save(figure, Path(place) / "picture.png")
        axes = figure.axes[0]
        lowest = min(text.get_window_extent().y0 for text in axes.texts)
        self.assertGreaterEqual(lowest, axes.get_window_extent().y0 - 2)


class Folders(unittest.TestCase):
    def test_runs_that_have_nothing_in_common_leave_none(self):
        with tempfile.TemporaryDirectory() as place:
            for name in ("a", "b"):
                (Path(place) / name).mkdir()
            out = Path(place) / "compared"
            with self.assertRaisesRegex(UserMistake, "nothing that can be compared"):
                list(compare.pictures([Path(place) / "a", Path(place) / "b"], out))
            self.assertFalse(out.exists())


if __name__ == "__main__":
    unittest.main()
