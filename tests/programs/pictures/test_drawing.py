#!/usr/bin/python3
"""Pictures drawn by several processes are those of one, failures come out, and labels and curves are those of the case."""

import errno
import json
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import numpy as np
from matplotlib import pyplot
from matplotlib.cm import ScalarMappable
from matplotlib.colors import Normalize
from PIL import Image

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from running import ROOT  # noqa: E402
from fsi_launch import plot  # noqa: E402
from fsi_launch.plot.look import drawing, style, units  # noqa: E402
from fsi_launch.plot.one_run import curves, fields, movie, streamlines  # noqa: E402
from fsi_launch.plot.reading import data, scales  # noqa: E402
from fsi_launch.plot.several_runs import convergence, outlines, study  # noqa: E402


def picture(k):
    figure, axes = pyplot.subplots()
    axes.plot([0, k], [k, 1])
    return figure


def broken():
    raise ValueError("nothing to draw here")


class Drawing(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory(prefix="fsi-drawing-")
        self.addCleanup(scratch.cleanup)
        self.folder = Path(scratch.name)
        style.use()

    def draw(self, name, jobs, count=3):
        (self.folder / name).mkdir()
        said = []
        drawing.draw([(self.folder / name / f"{k}.png", lambda k=k: picture(k)) for k in range(count)], said.append, jobs)
        return [path.read_bytes() for path in said]

    def test_pictures_do_not_depend_on_how_many_are_drawn_at_once_and_are_told_in_their_order(self):
        alone = self.draw("alone", 1)
        self.assertEqual(self.draw("together", 3), alone)
        self.assertEqual(len(set(alone)), 3)

    def test_a_figure_that_is_there_is_drawn_as_well(self):
        drawing.draw([(self.folder / "a.png", picture(1)), (self.folder / "b.png", picture(2))], lambda path: None, 2)
        self.assertTrue((self.folder / "a.png").is_file() and (self.folder / "b.png").is_file())

    def test_a_png_is_what_is_drawn_and_a_margin_also_beyond_the_figure(self):
        sizes = []
        for reach in (0.0, -0.2):
            figure, axes = pyplot.subplots(figsize=(4, 3))
            figure.text(0.5, reach, "below")
            style.save(figure, self.folder / "reach.png")
            with Image.open(self.folder / "reach.png") as drawn:
                sizes.append(drawn.size)
        self.assertGreater(sizes[1][1], sizes[0][1] + 0.15 * 3 * 130)

    def test_narrow_axes_have_few_numbers_and_colour_bars_none_across(self):
        figure, (narrow, wide) = pyplot.subplots(1, 2, figsize=(6, 4), width_ratios=(1, 8))
        for axes in (narrow, wide):
            axes.set_xlim(-0.05, 0.05)
        style.bar(figure, wide, wide.scatter([0, 1], [0, 1], c=[1.0, 2.0]), "p")
        style.save(figure, self.folder / "narrow.png")
        seen = [[x for x in axes.get_xticks() if axes.get_xlim()[0] <= x <= axes.get_xlim()[1]] for axes in figure.axes]
        self.assertEqual(len(seen[0]), 1)
        self.assertGreater(len(seen[1]), 3)
        self.assertEqual(seen[2], [])

    def test_bars_are_as_high_as_their_panels_and_thin_domains_take_no_more_room_than_they_need(self):
        heights = []
        for box in ((0, 2, 0, 1), (0, 5, 0, 1), (0, 100, 0, 1)):
            figure, (axes, *_) = fields.panels(3, box, 0.8)
            style.bar(figure, axes, axes.scatter([0, 1], [0, 1], c=[1.0, 2.0]), "p")
            style.save(figure, self.folder / "bar.png")
            panel, bar = axes.get_position(), figure.axes[-1].get_position()
            self.assertAlmostEqual(bar.height, panel.height)
            self.assertAlmostEqual(bar.y0, panel.y0)
            self.assertGreater(panel.height, 0.5 / 3)
            heights.append(figure.get_figheight())
        self.assertEqual(sorted(heights, reverse=True), heights)
        self.assertEqual(axes.get_aspect(), "auto")     # of equal scale nothing could be seen

    def test_what_is_added_to_a_bar_does_not_lie_over_the_name_of_the_next(self):
        gas = style.above_bar("gas", 0.7142856, 0.7142858)
        self.assertEqual([len(gas), gas[-1]], [3, "gas"])
        short = style.above_bar("gas", 0.0, 1e-7)
        for limits, beside, lines in (((0.0, 5e-4), gas, 2), ((0.7142856, 0.7142858), gas, 6), ((0.0, 1.0), gas, 1), ((0.0, 5e-4), short, 2)):
            figure, axes = pyplot.subplots()
            drawn = axes.scatter([0, 1], [0, 1], c=limits)
            style.bar(figure, axes, drawn, "solid", beside=beside)
            self.assertEqual(len(figure.axes[-1].get_title(loc="left").split("\n")), lines)
            pyplot.close(figure)

    def test_long_numbers_keep_apart(self):
        figure, axes = pyplot.subplots(figsize=(4.8, 2))
        axes.set_xlim(-0.075, 0.138)
        usual = len(axes.get_xticks())
        style.save(figure, self.folder / "long.png")
        self.assertEqual([f"{x:.2f}" for x in axes.get_xticks() if -0.075 <= x <= 0.138], ["-0.05", "0.00", "0.05", "0.10"])
        self.assertGreater(usual, len(axes.get_xticks()))

    def test_failures_come_out_whoever_draws(self):
        for jobs in (1, 2):
            with self.subTest(jobs), self.assertRaises(OSError) as caught:
                drawing.draw([(self.folder / "nowhere" / f"{k}.png", picture(k)) for k in (1, 2)], lambda path: None, jobs)
            self.assertEqual(caught.exception.errno, errno.ENOENT)
            with self.subTest(jobs), self.assertRaisesRegex(RuntimeError, "nothing to draw here"):
                drawing.draw([(self.folder / "a.png", broken), (self.folder / f"{jobs}.png", picture(1))], lambda path: None, jobs)
            self.assertTrue((self.folder / f"{jobs}.png").is_file(), "the others are drawn")


class Frames(unittest.TestCase):
    def test_axes_and_colours_of_a_movie_hold_and_have_labels(self):
        style.use()
        x1, x2 = np.meshgrid(np.linspace(0, 1, 5), np.linspace(0, 1, 5))

        def output(t):
            arrays = {"x1": x1 + t, "x2": x2, "v1": t * x1, "v2": 0 * x1, "rho": 1 + 0 * x1, "p": 1 + 0 * x1}
            return data.Output(t, [data._read_grid("gas", arrays)])

        seen = set()
        for figure in movie._frames([data.Series("fluid", [output(1.0), output(2.0)])]):
            axes, bar = figure.axes
            seen.add((axes.get_xlim(), axes.get_ylim(), bar.get_ylim(), axes.get_xlabel(), axes.get_ylabel(), bar.get_title(loc="left")))
            pyplot.close(figure)
        ((across, _, colours, *words),) = seen
        self.assertTrue(across[0] <= 1 and across[1] >= 3)
        self.assertEqual((colours, words), ((0, 2), ["x", "y", "speed"]))

    def test_bars_of_a_movie_have_units_in_a_case_of_si(self):
        style.use()
        units.use("SI")
        self.addCleanup(units.use, "none")
        x1, x2 = np.meshgrid(np.linspace(0, 1, 41), np.linspace(0, 1, 21))
        still, front = ({"x1": x1, "x2": x2, "v1": x1, "v2": 0 * x1, "rho": 1 + jump * (x1 > 0.5), "p": 1 + 0 * x1} for jump in (0, 0.3))
        body = {"x1": x1 + 1, "x2": x2, "v1": 1 + 0 * x1, "v2": 0 * x1}
        for gas, label in ((still, "speed [m/s]"), (front, "$|\\bar v|$ [m/s]")):
            series = [data.Series(name, [data.Output(1.0, [data._read_grid(name, arrays)])]) for name, arrays in (("fluid", gas), ("body", body))]
            [figure] = movie._frames(series)
            self.assertEqual(figure.axes[-1].get_title(loc="left").split("\n")[-1], label)
            pyplot.close(figure)


class Units(unittest.TestCase):
    def tearDown(self):
        units.use("none")

    def test_bare_names_where_the_case_says_nothing(self):
        units.use_those_of([{"name": "a"}])
        self.assertEqual((units.label("x", "length"), units.moment(0.5)), ("x", "t = 0.5"))
        self.assertEqual(units.heading("power [power/depth]"), "power [power/depth]")

    def test_symbols_of_si(self):
        units.use_those_of([{"units": "SI"}, {"units": "SI"}])
        self.assertEqual((units.label("x", "length"), units.moment(0.5)), ("x [m]", "t = 0.5 s"))
        for heading, shown in (("power [power/depth]", "power [W/m]"), ("v [length/time]", "v [m/s]"), ("jump [force/area]", "jump [Pa]"),
                               ("moment [force*length/depth]", "moment [N]"), ("momentum [force*time/depth]", "momentum [N s/m]")):
            self.assertEqual(units.heading(heading), shown)

    def test_what_is_unknown_stays(self):
        units.use("SI")
        self.assertEqual((units.label("a", "furlong"), units.heading("a [furlong]"), units.heading("step")), ("a", "a [furlong]", "step"))

    def test_runs_of_different_systems_have_bare_names(self):
        units.use_those_of([{"units": "SI"}, {}])
        self.assertEqual(units.symbol("time"), "")

    def test_columns_of_probes_have_the_units_of_their_fields(self):
        units.use("SI")
        self.assertEqual([curves._title(name) for name in ("tip.u1", "a.rho", "a.p", "a.T")],
                         ["tip: $u_{1}$ [m]", "a: density $\\rho$ [kg/m$^3$]", "a: pressure $p$ [Pa]", "a: temperature $T$"])
        self.assertEqual(curves._title("solid.left.velocity_jump [length/time]"), "solid.left: velocity jump [m/s]")

    def test_every_column_a_program_writes_has_a_symbol(self):
        found = subprocess.run(["grep", "-rhoE", r'"[a-z0-9_ ]+ \[[a-z*/]+\]"', "--include=port.?pp", "--include=coupler*.cpp",
                                *(ROOT / folder for folder in ("fluid_solver", "solid_solver", "coupler"))], capture_output=True, text=True, check=True)
        headings = {line.strip('"') for line in found.stdout.splitlines()}
        self.assertGreater(len(headings), 10)
        units.use("SI")
        self.assertEqual([heading for heading in sorted(headings) if units.heading(heading) == heading and "[rad]" not in heading], [])


class Streamlines(unittest.TestCase):
    def test_a_grid_that_reaches_over_itself_is_searched_in_parts(self):
        import numpy as np
        from matplotlib.tri import Triangulation
        from fsi_launch.plot.one_run import streamlines
        angle, radius = np.meshgrid(np.linspace(0, 2.2 * np.pi, 45), np.linspace(1, 1.5, 4))     # its ends lie one over the other
        index = np.arange(angle.size).reshape(angle.shape)
        a, b, c, d = (part.ravel() for part in (index[:-1, :-1], index[:-1, 1:], index[1:, 1:], index[1:, :-1]))
        cells = Triangulation((radius * np.cos(angle)).ravel(), (radius * np.sin(angle)).ravel(),
                              np.concatenate([np.column_stack([a, b, c]), np.column_stack([a, c, d])]))
        parts = streamlines._searched(cells, angle.shape[1])
        self.assertGreater(len(parts), 1)
        self.assertEqual(sum(len(part.triangles) for part, _ in parts), len(cells.triangles))
        self.assertTrue(any(find(1.25, 0.05) >= 0 for _, find in parts))

    def test_all_panels_have_one_bar_and_solids_one_of_their_own_where_their_scale_is(self):
        style.use()
        solids = ScalarMappable(Normalize(0, 1))
        for most, drawn, labels in (((1, 1), solids, [""]), ((1, 0.01), solids, ["solid", "gas"]), ((1, 0), None, ["gas"])):
            figure, panels = streamlines._panels(3, (0, 2, 0, 1))
            streamlines._bars(figure, panels, most, drawn)
            self.assertEqual([bar.get_title(loc="left").rpartition("\n")[2] for bar in figure.axes[4:]], labels)
            with tempfile.TemporaryDirectory(prefix="fsi-drawing-") as scratch:
                style.save(figure, Path(scratch) / "a.png")
            for bar in figure.axes[4:]:
                self.assertAlmostEqual(bar.get_position().y1, panels[0].get_position().y1)
                self.assertAlmostEqual(bar.get_position().y0, panels[2].get_position().y0)


class Convergence(unittest.TestCase):
    TABLE = {"case": "piston", "h": [0.05, 0.025], "errors": {"rho": [4e-4, 1e-4]}, "fitted": {"rho": 2.0}}

    def test_the_number_under_the_triangle_lies_above_the_axis(self):
        style.use()
        [(_, figure)] = convergence.pictures(self.TABLE)
        figure.draw_without_rendering()
        one = next(text for text in figure.axes[0].texts if text.get_text() == "1")
        self.assertGreater(one.get_window_extent().y0, figure.axes[0].get_window_extent().y0 + 4)

    def test_more_errors_than_markers_and_a_level_without_any_are_drawn(self):
        style.use()
        names = [f"e{k}" for k in range(12)]
        table = {"case": "piston", "h": [0.1, 0.05, 0.025], "errors": {name: [4e-4, None, 1e-4] for name in names}, "fitted": dict.fromkeys(names)}
        [(_, figure)] = convergence.pictures(table)
        curves_of = [line for line in figure.axes[0].lines if line.get_label() in names]
        self.assertEqual(len(curves_of), 12)
        alone = table | {"errors": {"rho": [None, None, 1e-4]}, "fitted": {"rho": None}}
        self.assertEqual(len(list(convergence.pictures(alone))), 1)

    def test_no_single_spacing_stands_above_several(self):
        with tempfile.TemporaryDirectory(prefix="fsi-drawing-") as scratch:
            entries = {"name": "piston", "grid.factor": "4"}
            self.assertEqual(plot._in_common_to_all_grids(Path(scratch), entries), entries)
            (Path(scratch) / "converge.json").write_text(json.dumps(self.TABLE), encoding="utf-8")
            self.assertEqual(plot._in_common_to_all_grids(Path(scratch), entries), {"name": "piston"})


class Outlines(unittest.TestCase):
    def test_the_later_an_outline_the_more_of_its_colour_it_has(self):
        found = list(outlines.shades([0.5, 1.0, 2.0]).values())
        self.assertTrue(0 < found[0] < found[1] < found[2] == 1)
        self.assertEqual(outlines.shades([0.5]), {0.5: 1.0})
        self.assertEqual((outlines._shaded("black", 1), outlines._shaded("black", 0)), ((0, 0, 0), (1, 1, 1)))


class Studies(unittest.TestCase):
    def test_runs_that_failed_are_marked_where_they_were_and_round_off_is_no_error(self):
        rows = [{"values": {"parameters.ratio": value}, "status": status, "quantities": {"errors.v": error, "errors.w": 1e-16}}
                for value, status, error in (("0.1", "failed", None), ("1", "completed", 2e-5), ("10", "completed", 1e-5))]
        result = {"case": "piston", "vary": {"parameters.ratio": ["0.1", "1", "10"]}, "quantities": ["errors.v", "errors.w"], "rows": rows}
        [(_, figure)] = study.pictures(result)
        failed, found = figure.axes[0].lines
        self.assertEqual((list(failed.get_xdata()), list(found.get_xdata())), ([0.1], [1, 10]))
        self.assertLessEqual(figure.axes[0].get_xlim()[0], 0.1)
        self.assertEqual(figure.axes[1].get_ylim(), (-1, 1))

    def result(self):
        """A study of two keys that end alike."""
        rows = [{"values": {"fluid.size": a, "solids.body.size": b, "grid.factor": "4"}, "status": "completed", "folder": f"{a}{b}",
                 "quantities": {"errors.v1": 1.0, "forces_body.force1:max": 2.0}} for a in "12" for b in "34"]
        return {"case": "piston", "vary": {"fluid.size": ["1", "2"], "solids.body.size": ["3", "4"], "grid.factor": ["4"]},
                "quantities": ["errors.v1", "forces_body.force1:max"], "units": {"errors.v1": "", "forces_body.force1:max": "force/depth"}, "rows": rows}

    def test_keys_that_end_alike_are_told_apart(self):
        [(_, figure)] = study.pictures(self.result())
        self.assertEqual([line.get_label() for line in figure.axes[0].lines],
                         [f"solids.body.size = {value}, factor = 4" for value in "34"])

    def test_panels_have_the_units_of_their_columns_in_a_case_of_si_also_when_they_are_drawn_again(self):
        self.addCleanup(units.use, "none")
        with tempfile.TemporaryDirectory(prefix="fsi-drawing-") as scratch:
            directory = Path(scratch)
            (directory / "study.json").write_text(json.dumps(self.result()), encoding="utf-8")
            for row in self.result()["rows"]:
                (directory / row["folder"]).mkdir()
                (directory / row["folder"] / "case.yaml").write_text("name: piston\nunits: SI\n", encoding="utf-8")
            plot._take_words([directory])
            [(_, figure)] = plot._one(directory, None)
        self.assertEqual([axes.get_title(loc="left") for axes in figure.axes[:2]], ["errors.v1 [m/s]", "forces_body.force1:max [N/m]"])
        units.use("none")
        [(_, figure)] = study.pictures(self.result())
        self.assertEqual(figure.axes[1].get_title(loc="left"), "forces_body.force1:max")


class Proposals(unittest.TestCase):
    def setUp(self):
        style.use()

    def test_what_was_proposed_is_drawn_beside_the_steps_taken_and_who_limited_them_is_no_curve(self):
        t = np.array([0.0, 0.1, 0.2, 0.3])
        table = data.Table("interface", {"t [time]": t, "dt [time]": np.array([0, 0.1, 0.1, 0.1]), "beam.gap [length]": 1e-3 * t,
                                         "fluid.proposed_dt [time]": np.array([np.nan, 0.1, 0.11, 0.12]), "body.proposed_dt [time]": np.full(4, np.inf),
                                         "limited_by": np.array(["none", "fluid", "fluid", "fluid"])})
        figure = curves._table_picture(table, scales.Scales(1, 1, 1))
        self.assertEqual([len(axes.lines) for axes in figure.axes], [2, 1])
        self.assertEqual([line.get_label() for line in figure.axes[0].lines], ["taken", "fluid"])
        figure.draw_without_rendering()
        panel, legend = figure.axes[0].get_window_extent(), figure.axes[0].get_legend().get_window_extent()
        self.assertGreaterEqual(legend.x0, panel.x1 - 1)        # not over the curves
        self.assertLessEqual(legend.x1, figure.axes[1].get_window_extent().x0)

    def test_a_body_without_stress_has_no_panels_of_tractions(self):
        t = np.array([0.0, 0.1, 0.2])
        none = {"body.traction_jump [force/area]": 0 * t, "body.shear [force/area]": 0 * t}
        for columns, panels in ((none, 1), ({key: 1 + t for key in none}, 3)):
            figure = curves._table_picture(data.Table("interface", {"t [time]": t, "body.gap [length]": 1e-3 * t, **columns}), scales.Scales(1, 1, 1))
            self.assertEqual(len([axes for axes in figure.axes if axes.get_visible()]), panels)


if __name__ == "__main__":
    unittest.main()
