#!/usr/bin/python3
"""Fields along a line, of one run and of several."""

import sys
import unittest
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from test_pictures import read, ring  # noqa: E402
from fsi_launch.plot.one_run import curves  # noqa: E402
from fsi_launch.plot.reading import data, scales  # noqa: E402
from fsi_launch.plot.several_runs import lines  # noqa: E402


class Lines(unittest.TestCase):
    def test_only_runs_that_depend_on_one_coordinate_throughout_have_lines(self):
        x1, x2 = np.meshgrid(np.linspace(0, 1, 11), np.linspace(0, 1, 3))
        alone = read({"x1": x1, "x2": x2, "rho": x1, "p": x1, "v1": x1, "v2": 0 * x1})
        rest = {key: 0 * x1 for key in ("u1", "u2", "v1", "v2", "P11")}
        body = data.Series("body", [data.Output(1.0, [read({"x1": x1, "x2": x2, "x1_bar": x1, "x2_bar": x2, **rest})])])
        rigid = data.Series("rigid", [data.Output(1.0, [read({"x1": x1[:2], "x2": x2[:2]})])])
        self.assertEqual([one.has_an_inside() for one in (body, rigid)], [True, False])
        for grids, found in (([alone], ["lines"]), ([alone, ring()], [])):
            series = [data.Series("fluid", [data.Output(1.0, grids)]), body]
            self.assertEqual([name for name, _ in curves.pictures(series, [], scales.Scales(1, 1, 1), {})], found)

    def test_runs_of_the_same_programs_are_compared_along_their_line(self):
        x1, x2 = np.meshgrid(np.linspace(0, 1, 11), np.linspace(0, 1, 3))

        def run(p, name="fluid"):
            grid = read({"x1": x1, "x2": x2, "rho": 1 + x1, "p": p * (1 + x1), "v1": x1, "v2": 0 * x1})
            return [data.Series(name, [data.Output(t, [grid]) for t in (0.0, 0.5, 0.7 + p)], True)]

        [(name, figure)] = lines.pictures([run(1), run(2)], ["one", "two"])
        self.assertEqual((name, figure._suptitle.get_text()), ("lines_compared", "t = 0.5"))
        pressure = figure.axes[2].lines
        self.assertEqual([(line.get_label(), line.get_ydata()[-1]) for line in pressure], [("one", 2), ("two", 4)])
        self.assertEqual(list(lines.pictures([run(1), run(2, "other")], ["one", "two"])), [])
        self.assertEqual(list(lines.pictures([run(1), [data.Series("fluid", [data.Output(0.5, [ring()])], True)]], ["one", "two"])), [])

    def test_a_reference_is_drawn_at_its_own_time_and_place_in_space(self):
        x1, x2 = np.meshgrid(np.linspace(0, 1, 11), np.linspace(0, 1, 3))
        fields = {"x1": 2 * x1, "x2": x2, "x1_bar": x1, "x2_bar": x2, "u1": x1, "u2": 0 * x1, "v1": 3 * x1, "v2": 0 * x1,
                  "P11": 4 * x1}
        block = data.Series("block", [data.Output(t, [read(fields)]) for t in (0.0, 1.0)])
        fine = np.linspace(0, 1, 101)
        table = {"solid": {"x_bar": fine, "u": fine, "v": 3 * fine, "P11": 4 * fine}}
        figure = curves._lines_picture([block], scales.Scales(1, 1, 1), {1.0 + 1e-13: table})
        for axes in figure.axes:
            drawn = [line for line in axes.lines if len(line.get_xdata()) > 1]
            reference = [line.get_xydata() for line in drawn if len(line.get_xdata()) == len(fine)]
            self.assertEqual((len(drawn), len(reference)), (3, 1))
            computed = drawn[-2 if drawn[-1].get_xdata().size == len(fine) else -1].get_xydata()
            self.assertLess(np.abs(np.interp(computed[:, 0], *reference[0].T) - computed[:, 1]).max(), 1e-12)


if __name__ == "__main__":
    unittest.main()
