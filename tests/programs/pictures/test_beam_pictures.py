#!/usr/bin/python3
"""Centrelines of beams and streamlines: what is drawn of given fields."""

import contextlib
import sys
import unittest
from pathlib import Path

import numpy as np
from matplotlib import pyplot

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
import running  # noqa: E402,F401  the path of the launcher's modules
from fsi_launch.plot.one_run import beams, streamlines  # noqa: E402
from fsi_launch.plot.reading import data, scales  # noqa: E402

HALF, DEPTH = 0.05, 0.02


def bend(x, y):
    return 0.3 * y ** 2, -0.1 * y ** 2 + 0.05 * x


def solid(grids):
    """A program's output at t = 0 (at rest) and t = 1 (bent); grids: (name, x, y) of reference points."""
    outputs = []
    for t in (0.0, 1.0):
        read = []
        for name, x, y in grids:
            u1, u2 = (t * u for u in bend(x, y))
            read.append(data._read_grid(name, {"x1": x + u1, "x2": y + u2, "x1_bar": x, "x2_bar": y, "u1": u1, "u2": u2}))
        outputs.append(data.Output(t, read))
    return data.Series("beam", outputs)


def beam(points, turned=False):
    """A beam with a straight core and a grid along its outline, both ends on the wall y = 0."""
    s = np.linspace(0, 2 + 2 * HALF, points)  # up, across the end, down
    x, y = np.clip(s - 1 - HALF, -HALF, HALF), np.minimum(np.minimum(s, s[-1] - s), 1)
    depth = np.linspace(0, DEPTH, 5)[:, None]
    fitted = [x * (1 - depth / HALF), y * (1 - depth)]
    core = np.meshgrid(np.linspace(-HALF, HALF, 9), np.linspace(0, 1, 81))
    if turned:
        return solid([("core", core[1].T, -core[0].T), ("outline", fitted[1], -fitted[0])])
    return solid([("core", *core), ("outline", *fitted)])


class Centrelines(unittest.TestCase):
    def test_is_where_the_displacement_takes_the_middle_of_the_beam(self):
        found = beams.of([beam(201)])[0]
        self.assertEqual(sorted(found.lines), [0.0, 1.0])
        y = found.stations
        self.assertGreater(y[-1], 0.98)
        self.assertLess(np.abs(found.lines[0.0] - np.column_stack([0 * y, y])).max(), 1e-12)
        bent = np.column_stack([0 * y, y]) + np.column_stack(bend(0 * y, y))
        self.assertLess(np.abs(found.lines[1.0] - bent).max(), 0.3 * 0.0125 ** 2)  # linear between points

    def test_of_a_beam_by_law_is_that_of_its_line_beside_the_middle(self):
        s = np.linspace(0, 2 + 2 * HALF, 201)  # at the end many points share a place there: no cells to look in
        x, y = np.clip(s - 1 - HALF, -HALF, HALF), np.minimum(np.minimum(s, s[-1] - s), 1)
        series = solid([("beam", np.array([x, 0.01 * x]), np.array([y, y]))])
        for output in series.outputs:
            output.grids[0].fields["theta"] = np.zeros((2, 201))
        found = beams.of([series])[0]
        heights = found.stations
        self.assertGreater(heights[-1], 0.98)
        bent = np.column_stack([0 * heights, heights]) + np.column_stack(bend(0 * heights, heights))
        self.assertLess(np.abs(found.lines[1.0] - bent).max(), 0.3 * 0.0125 ** 2)  # linear between points

    def test_does_not_depend_on_where_the_points_of_the_outline_lie(self):
        found = beams.distances(beams.of([beam(201)])[0], beams.of([beam(198)])[0])
        self.assertLess(max(found.values()), 1e-4)

    def test_of_a_beam_that_lies_on_its_side_starts_at_its_wall(self):
        line = beams.of([beam(201, turned=True)])[0].lines[0.0]
        self.assertLess(np.abs(line[0]).max(), 1e-12)
        self.assertLess(np.abs(line[:, 1]).max(), 1e-12)
        self.assertGreater(line[-1, 0], 0.98)

    def test_a_ring_is_no_beam(self):
        angle, r = np.meshgrid(np.arange(80) * 2 * np.pi / 80, np.linspace(0.5, 1, 6))
        self.assertEqual(beams.of([solid([("ring", r * np.cos(angle), r * np.sin(angle))])]), [])

    def test_a_rigid_panel_is_no_beam(self):
        x, y = np.array([-HALF, -HALF, HALF, HALF]), np.array([0.0, 1.0, 1.0, 0.0])
        self.assertEqual(beams.of([solid([("body", np.array([x, 0 * x]), np.array([y, 0.5 + 0 * y]))])]), [])

    def test_beams_that_hardly_bend_have_a_scale_of_their_own_across(self):
        figure = beams.picture([beams.Run({}, 0.0, beams.of([beam(101)]))])
        self.assertEqual(figure.axes[0].get_aspect(), 1)
        for one in (line := figure.axes[0].get_lines()):
            one.set_xdata(1e-3 * one.get_xdata())
        figure.axes[0].set_aspect("auto")
        beams._scale(figure.axes)
        self.assertEqual((len(line), figure.axes[0].get_aspect()), (2, "auto"))

    def test_runs_with_the_same_parameters_are_compared_the_finer_first(self):
        case = "parameters:\n  rho_bar: 10\n  mach: {m}\ngrid:\n  factor: {j}\ntime:\n  end: 7\n"
        runs = [beams.run_of([beam(n)], case.format(j=j, m=m)) for n, j, m in ((101, 8, 1.1), (201, 16, 1.1), (201, 16, 1.3))]
        table = beams.table(runs)
        self.assertEqual({(coarse, fine) for _, coarse, fine, _, _ in table}, {(8.0, 16.0)})
        self.assertEqual({label for label, *_ in table}, {"mach = 1.1"})
        self.assertEqual(len(beams.picture(runs).axes), 2)

    def test_all_runs_of_a_panel_are_drawn_and_told_apart(self):
        case = "parameters:\n  rho_bar: 10\ngrid:\n  factor: {j}\nsolids:\n  beam:\n    law: {law}\n"
        runs = [beams.run_of([beam(101)], case.format(j=j, law=law)) for j, law in ((8, "gent"), (8, "beam"), (16, "gent"), (32, "gent"), (64, "gent"))]
        [axes] = beams.picture(runs).axes
        self.assertEqual(len(axes.get_lines()), 2 * 5)
        self.assertEqual(len({(line.get_linestyle(), str(line._dash_pattern)) for line in axes.get_lines()}), 5)
        for told in ("gent, j = 64 full", "gent, j = 8 ", "beam, j = 8 "):
            self.assertIn(told, axes.get_xlabel())

    def test_runs_that_differ_in_anything_else_have_panels_of_their_own(self):
        case = "parameters:\n  rho_bar: 10\ngrid:\n  factor: 8\ntime:\n  cfl: {cfl}\ninterface:\n  projection: {p}\noutput:\n  every: {cfl}\n"
        runs = [beams.run_of([beam(101)], case.format(cfl=cfl, p=p)) for cfl, p in ((0.5, "full"), (0.9, "full"), (0.9, "simplified"))]
        self.assertEqual([axes.get_title(loc="left") for axes in beams.picture(runs).axes[:3]],
                         ["cfl = 0.5, full", "cfl = 0.9, full", "cfl = 0.9, simplified"])

    def test_panels_are_named_by_what_was_set_and_not_by_what_follows(self):
        case = "grid:\n  factor: 8\nparameters:\n  mach: {m}\n  v_1: {v}    # formula: 2 * mach\n"
        runs = [beams.run_of([beam(101)], case.format(m=m, v=2 * m)) for m in (1.1, 1.3)]
        self.assertEqual([beams._label(run, runs) for run in runs], ["mach = 1.1", "mach = 1.3"])

    def test_a_beam_that_stays_straight_has_no_scale_of_round_off(self):
        one = beams.of([beam(101)])[0]
        for line in one.lines.values():
            line[:, 0] = 1e-20 * np.arange(len(line))
        axes = beams.picture([beams.Run({}, 0.0, [one])]).axes[0]
        self.assertGreater(np.ptp(axes.get_xlim()), 0.05)

    def test_a_beam_by_law_is_drawn_into_the_panel_of_its_continuum(self):
        case = "parameters:\n  rho_bar: 10\ngrid:\n  factor: 8\nsolids:\n  beam:\n    law: {law}\n"
        runs = [beams.run_of([beam(n)], case.format(law=law)) for n, law in ((101, "neo_hookean"), (201, "beam"))]
        panels = beams.picture(runs).axes
        self.assertEqual(len(panels), 1)
        self.assertIn("neo hookean full, beam dashed", panels[0].get_xlabel())
        self.assertEqual({label for label, *_ in beams.table(runs)}, {"beam: beam against neo hookean"})


class Streamlines(unittest.TestCase):
    def moving(self, speed):
        """An output of something that moves at up to `speed`."""
        x1, x2 = np.meshgrid(np.linspace(0, 1, 5), np.linspace(0, 1, 5))
        fields = {"x1": x1, "x2": x2, "x1_bar": x1, "x2_bar": x2, "v1": speed * x1, "v2": 0 * x1, "rho": 1 + x1, "p": 1 + x1}
        ring = {"x1": x1, "x2": x2 + 0.1 * x1, "v1": speed * x1, "v2": 0 * x1, "rho": 1 + x1, "p": 1 + x1}
        return data.Output(1.0, [data._read_grid("core", fields), data._read_grid("ring", ring)])

    def picture(self, gas, solid):
        """The panels of a run whose gas and solid move so at two times, [(axes, titles of its colour bars)], or None."""
        series = [data.Series(name, [self.moving(speed) for speed in speeds]) for name, speeds in (("fluid", gas), ("block", solid))]
        found = dict(streamlines.pictures(series, scales.Scales(1.0, 1.0, 1.0)))
        if not found:
            return None
        figure = found["streamlines"]()
        self.addCleanup(pyplot.close, figure)
        return figure.axes

    def test_colours_hold_over_all_times_and_for_gas_and_solid_unless_that_is_slow(self):
        for solid, wanted in (((0.1, 0.4), [("", (0, 2))]), ((0.01, 0.04), [("solid", (0, 0.04)), ("gas", (0, 2))])):
            _, _, *bars = self.picture((1.0, 2.0), solid)       # of all panels together
            self.assertEqual([(axes.get_title(loc="left").split("\n")[-1], axes.get_ylim()) for axes in bars], wanted)     # below a factor
            panels = [axes for axes in bars[0].figure.axes if axes not in bars]
            colours = {drawn.get_clim() for axes in panels for drawn in (*axes.images, *axes.collections) if drawn.get_array() is not None}
            self.assertEqual(colours, {limits for _, limits in wanted})

    def test_a_solid_whose_speed_is_round_off_is_plain(self):
        titles = [axes.get_title(loc="left") for axes in self.picture((1.0, 1.0), (0.0, 2e-16))]
        self.assertIn("gas", titles)
        self.assertNotIn("solid", titles)

    def test_quick_tracing_finds_the_same_lines(self):
        x = np.linspace(0, 1, 41)
        x1, x2 = np.meshgrid(x, x)
        v = [np.ma.array(values, mask=np.hypot(x1 - 0.5, x2 - 0.4) < 0.15) for values in (1 + 0 * x1, np.sin(7 * x1) + x2)]
        found = []
        for how in (contextlib.nullcontext, streamlines.quick_tracing):
            figure, axes = pyplot.subplots()
            with how():
                found.append(axes.streamplot(x, x, *v, color=x1).lines.get_segments())
            pyplot.close(figure)
        self.assertGreater(len(found[0]), 100)
        np.testing.assert_array_equal(*found)

    def test_there_is_none_of_a_gas_that_rests(self):
        self.assertIsNone(self.picture((0.0, 1e-15), (0.0, 0.0)))

    def test_velocity_on_the_lattice_is_that_of_the_grid_and_holes_have_none(self):
        x1, x2 = np.meshgrid(np.linspace(0, 2, 21), np.linspace(0, 1, 11))
        kind = np.where((np.abs(x1 - 1) < 0.25) & (x2 < 0.45), data.UNUSED, data.DISCRETISED)
        gas = data.Output(1.0, [data._read_grid("channel", {"x1": x1, "x2": x2, "kind": kind, "v1": 1 + x1 * x2, "v2": -x2})])
        points = np.meshgrid(np.linspace(0.05, 1.95, 30), np.linspace(0.05, 0.95, 15))
        v1, v2 = streamlines._velocity(gas, points)
        hole = np.isnan(v1)
        self.assertTrue(hole[np.hypot(points[0] - 1, points[1] - 0.2) < 0.15].all())
        self.assertLess(np.abs(v1 - 1 - points[0] * points[1])[~hole].max(), 1e-12)
        self.assertLess(np.abs(v2 + points[1])[~hole].max(), 1e-12)


if __name__ == "__main__":
    unittest.main()
