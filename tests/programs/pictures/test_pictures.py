#!/usr/bin/python3
"""What pictures of component grids are made of: cells, seams, numbers and scales."""

import contextlib
import io
import sys
import tempfile
import unittest
from pathlib import Path

import numpy as np
from matplotlib import pyplot
from matplotlib.collections import TriMesh
from matplotlib.image import AxesImage

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from running import ROOT  # noqa: E402
from fsi_launch.failure import UserMistake  # noqa: E402
from fsi_launch.plot.look import caption, shading, style  # noqa: E402
from fsi_launch.plot.one_run import disk, fields, grids  # noqa: E402
from fsi_launch.plot.reading import data, mesh, scales  # noqa: E402
from fsi_launch.plot.several_runs import outlines, several, side_by_side  # noqa: E402

HOLE, RIM, OUTER = 0.5, 0.55, 0.8  # radii: unused points, the ring's inside and outside


def read(arrays):
    """A grid as read from a file: groups are mappings from names to arrays."""
    return data._read_grid("grid", arrays)


def background():
    """A square of [-1, 1] with a hole."""
    x1, x2 = np.meshgrid(np.linspace(-1, 1, 81), np.linspace(-1, 1, 81))
    r = np.hypot(x1, x2)
    return read({"x1": x1, "x2": x2, "kind": np.where(r < HOLE, data.UNUSED, np.where(r < RIM + 0.1, 2, 1)),
                 "rho": np.where(r < HOLE, np.nan, 1)})


def ring():
    """A ring about the hole whose last points lie one spacing before its first ones."""
    angle, r = np.meshgrid(np.arange(200) * 2 * np.pi / 200, np.linspace(RIM, OUTER, 9))
    x1, x2 = r * np.cos(angle), r * np.sin(angle)
    return read({"x1": x1, "x2": x2, "x1_bar": x1, "x2_bar": x2, "rho": np.ones_like(r),
                 "u1": 0.3 * x1 + 0.2 * x2, "u2": -0.1 * x1 + 0.1 * x2})


def area(triangles):
    x, y = triangles.x[triangles.triangles], triangles.y[triangles.triangles]
    return 0.5 * np.abs((x[:, 1] - x[:, 0]) * (y[:, 2] - y[:, 0]) - (x[:, 2] - x[:, 0]) * (y[:, 1] - y[:, 0])).sum()


def circle(r, corners=200):
    """Area of the regular polygon in a circle."""
    return 0.5 * corners * r ** 2 * np.sin(2 * np.pi / corners)


class Shading(unittest.TestCase):
    """Colours over a grid."""

    def setUp(self):
        figure, self.axes = pyplot.subplots()
        self.addCleanup(pyplot.close, figure)

    def test_even_grids_are_images_with_the_holes_left_free_and_others_are_triangles(self):
        grid = background()
        drawn = shading.shade(self.axes, grid, grid.x1 + 2 * grid.x2, "viridis", (0, 1))
        self.assertIsInstance(drawn, AxesImage)
        self.assertEqual(int(drawn.get_array().mask.sum()), int((~grid.used()).sum()))
        left, right, bottom, top = drawn.get_extent()
        n2, n1 = grid.x1.shape
        h = (right - left) / n1     # a point lies in the middle of its pixel
        self.assertAlmostEqual(left + h * (10 + 0.5), grid.x1[0, 10])
        self.assertAlmostEqual(bottom + (top - bottom) / n2 * (70 + 0.5), grid.x2[70, 0])
        self.assertEqual(drawn.get_array()[70, 10], grid.x1[70, 10] + 2 * grid.x2[70, 10])
        self.assertEqual(drawn.get_clim(), (0, 1))
        around = ring()
        self.assertIsInstance(shading.shade(self.axes, around, around.x1, "viridis", (0, 1)), TriMesh)

    def test_grids_that_are_nearly_even_or_turned_are_triangles(self):
        even = background()
        for x1, x2 in ((even.x1 + 0.01 * even.x1 ** 3, even.x2), (even.x1 + 0.1 * even.x2, even.x2), (-even.x1, even.x2)):
            grid = read({"x1": x1, "x2": x2, "rho": np.ones_like(x1)})
            self.assertIsInstance(shading.shade(self.axes, grid, grid.x1, "viridis", (0, 1)), TriMesh)

    def moving(self, speed):
        """Series of a gas that moves at up to 1 and of a solid at up to `speed`, at two times."""
        def output(grid, t, v):
            zero = np.zeros_like(grid.x1)
            grid.fields.update(v1=v * t * grid.x1, v2=v * t * grid.x2, p=1 + zero, rho=1 + zero, **{f"P{c}": zero for c in ("11", "12", "21", "22")})
            return data.Output(t, [grid])
        return [data.Series(name, [output(make(), t, v) for t in (0.5, 1.0)]) for name, make, v in (("fluid", background, 0.7), ("body", ring, speed))]

    def test_velocities_have_one_scale_over_time_and_over_the_interface_unless_one_side_is_slow(self):
        size = scales.of_run(self.moving(1.0))
        for speed, shared in ((1.0, True), (0.01, False), (50.0, False)):
            plan = fields._plan(self.moving(speed), fields.Look(size))
            panel = next(one for one in plan.panels if one.title.startswith("speed"))
            self.assertEqual(panel.one_scale(), shared)
            self.assertAlmostEqual(panel.solid_range[1] if not shared else panel.gas_range[1], speed * OUTER if not shared else 0.7 * np.sqrt(2), places=6)

    def test_a_body_without_stress_is_plain_beside_one_that_has_some(self):
        gas, rigid = self.moving(1.0)
        elastic = self.moving(1.0)[1]
        for output in elastic.outputs:
            output.grids[0].fields["P11"] = 2 + output.grids[0].x1
        look = fields.Look(scales.of_run([gas, rigid, elastic]))
        for solids, plain in (([rigid, elastic], {0}), ([elastic, rigid], {1}), ([elastic], set())):
            plan = fields._plan([gas, *solids], look)
            stress, speed = (next(one for one in plan.panels if one.title.startswith(word)) for word in ("pressure", "speed"))
            self.assertEqual((stress.plain, speed.plain), (plain, set()))
            self.assertGreater(stress.solid_range[0], 1)       # without the zeros of the rigid one
            figure = fields._field_picture(plan, 1)
            self.addCleanup(pyplot.close, figure)
            axes = next(one for one in figure.axes if one.get_title(loc="left").startswith("pressure"))
            self.assertEqual(sum(isinstance(one, TriMesh) and one.get_cmap().name == style.SOLID_MAP for one in axes.collections), 1)
        alone = next(one for one in fields._plan([gas, rigid], look).panels if one.title.startswith("pressure"))
        self.assertIsNone(alone.of_solid)


class Captions(unittest.TestCase):
    def test_wide_spacings_are_no_fractions(self):
        self.assertEqual([caption.spacing(factor) for factor in (4, 0.2, 0.1, 0.04)], ["h = 1/40", "h = 1/2", "h = 1", "h = 2.5"])
        self.assertEqual(caption.spacing(20, "m"), "h = 0.005 m")

    def test_case_grid_law_and_own_parameters(self):
        text = (ROOT / "configs" / "shock_ellipse.yaml").read_text(encoding="utf-8")
        resolved = "name: shock_ellipse\n" + text.replace("rho_bar: 0.1", "rho_bar: 0.01").replace("grid: {factor: 4}", "grid:\n  factor: 4")
        self.assertEqual(caption.of_case(resolved, several.entries(resolved)), "shock_ellipse, h = 1/40, neo hookean, rho_bar = 0.01")
        own = resolved.replace("name: shock_ellipse", "name: mine")
        self.assertEqual(caption.of_case(own, several.entries(own)), "mine, h = 1/40, neo hookean")


    def test_a_long_title_takes_as_many_lines_as_fit(self):
        figure, _ = pyplot.subplots(figsize=(4.4, 3.2))
        caption.head(figure, "A shock of Mach 2 and a rigid cylinder: regular reflection, then a Mach stem, and all that follows")
        figure.draw_without_rendering()
        self.assertGreaterEqual(figure._suptitle.get_text().count("\n"), 1)
        self.assertLess(figure._suptitle.get_window_extent().width, figure.bbox.width)


class Cells(unittest.TestCase):
    def test_holes_are_left_free(self):
        grid = background()
        triangles = mesh.triangles(grid)
        self.assertTrue(np.isfinite(grid.fields["rho"].ravel()[triangles.triangles]).all())
        self.assertLess(area(triangles), 4 - circle(HOLE))

    def test_a_grid_without_kinds_is_used_everywhere(self):
        self.assertTrue(ring().used().all())

    def test_a_ring_is_drawn_without_a_gap(self):
        self.assertAlmostEqual(area(mesh.triangles(ring())), circle(OUTER) - circle(RIM), places=12)

    def test_cells_are_cut_where_their_values_differ_less(self):
        """A front that leans one way looks as one that leans the other way."""
        x1, x2 = np.meshgrid([0.0, 1.0], [0.0, 1.0])
        grid = read({"x1": x1, "x2": x2, "rho": np.ones((2, 2))})
        for alone in range(4):    # the corner, counted along rows, that lies behind the front
            values = np.where(np.arange(4) == alone, 1.0, 0.0).reshape(2, 2)
            drawn = mesh.triangles(grid, values=values).triangles
            self.assertEqual([(triangle == alone).any() for triangle in drawn].count(True), 1)
            self.assertAlmostEqual(area(mesh.triangles(grid, values=values)), 1)

    def test_what_a_ring_covers_is_drawn_once_but_for_the_cells_it_cuts(self):
        both = area(mesh.triangles(background(), mesh.uncovered(background(), [ring()]))) + area(mesh.triangles(ring()))
        domain, cut = 4 - circle(RIM), 2 * np.pi * (OUTER + RIM) * 0.025 * np.sqrt(2)
        self.assertGreater(both, domain)
        self.assertLess(both, domain + cut)

    def test_the_ring_is_laid_over_the_background(self):
        self.assertTrue(background().is_cartesian())
        self.assertFalse(ring().is_cartesian())


class Numbers(unittest.TestCase):
    def test_nearly_constant_pressure_is_shown_about_a_round_number(self):
        self.assertEqual(style.short_numbers(9.9985, 10.0006), (10.0, -3))

    def test_plain_numbers_stay_plain(self):
        self.assertEqual(style.short_numbers(0.2, 1.4), (0.0, 0))

    def test_units_are_made_of_length_speed_and_pressure(self):
        size = scales.Scales(length=2.0, speed=5.0, pressure=3.0)
        self.assertEqual(size.of("force/area"), 3.0)
        self.assertEqual(size.of("length/time"), 5.0)
        self.assertEqual(size.of("force*length/depth"), size.of("force"))
        self.assertEqual(size.of("power"), size.of("force") * size.of("length/time"))
        self.assertEqual(size.of("energy/depth"), size.of("force"))
        self.assertEqual(size.floor("apples"), 0.0)

    def test_without_fields_nothing_is_taken_for_round_off(self):
        for unit in ("length/time", "force/area", "force*length/depth", "power/depth"):
            self.assertEqual(scales.of_run([]).floor(unit), 0.0)


class Times(unittest.TestCase):
    def setUp(self):
        self.series = [data.Series(name, [data.Output(t, []) for t in (0.0, 0.5, 1.0 + 1e-13)]) for name in ("fluid", "block")]

    def test_only_the_times_asked_for_are_drawn(self):
        for one in data.at_times(self.series, [1.0, 0.0]):
            self.assertEqual([output.t for output in one.outputs], [0.0, 1.0 + 1e-13])

    def test_all_are_drawn_unless_some_are_asked_for(self):
        self.assertEqual(data.at_times(self.series, []), self.series)

    def test_a_time_without_output_is_refused_and_the_others_named(self):
        with self.assertRaisesRegex(UserMistake, "fluid has no output at t = 0.7: it has 0, 0.5, 1"):
            data.at_times(self.series, [0.5, 0.7])

    def test_times_that_are_left_out_are_told(self):
        x1, x2 = np.meshgrid(np.linspace(0, 1, 11), np.linspace(0, 1, 3))
        grid = read({"x1": x1, "x2": x2, "rho": 1 + x1, "p": 1 + x1, "v1": x1, "v2": 0 * x1})
        for count, told in ((12, ""), (13, "fields: 12 of 13 output times are drawn; --at TIME draws others\n")):
            gas = data.Series("fluid", [data.Output(0.1 * k, [grid]) for k in range(count)], True)
            with contextlib.redirect_stderr(io.StringIO()) as said:
                self.assertEqual(len(list(fields.pictures([gas], fields.Look(scales.Scales(1, 1, 1))))), 12)
            self.assertEqual(said.getvalue(), told)


class DamagedFiles(unittest.TestCase):
    """They are named, whatever is wrong with them."""

    def test_tables_and_references_that_cannot_be_read(self):
        reads = {"converge.json": data.convergence, "study.json": data.study, "reference.h5": data.piston_reference}
        with tempfile.TemporaryDirectory() as place:
            for name, read_it in reads.items():
                for content in (b"", b"[]", b"{\"t\": ", b"\x89HDF\r\n\x1a\nand no more"):
                    (Path(place) / name).write_bytes(content)
                    with self.assertRaisesRegex(UserMistake, f"{name}' is damaged: "):
                        read_it(Path(place))


class Levels(unittest.TestCase):
    def level(self, points, kind):
        x1, x2 = np.meshgrid(np.linspace(0, 1, points), np.linspace(0, 1, points))
        return {"x1": x1, "x2": x2, "kind": kind(x1, x2), "rho": 1 + x1}

    def grids(self):
        """A right half of fine cells, a left half of coarse ones, and a ring: as in a file, by names."""
        angle, r = np.meshgrid(np.linspace(0, 2 * np.pi, 21), np.linspace(0.1, 0.2, 5))
        return data._read_grids({
            "air": self.level(13, lambda x, y: np.where(x < 0.499, data.UNUSED, data.DISCRETISED)),
            "air_1": self.level(5, lambda x, y: np.where(x > 0.501, data.UNUSED, data.DISCRETISED)),
            "ring": {"x1": 0.8 + r * np.cos(angle), "x2": 0.5 + r * np.sin(angle), "rho": r}})

    def test_coarse_ones_are_drawn_before_fine_ones_and_these_before_fitted_grids(self):
        self.assertEqual([(grid.name, grid.level) for grid in self.grids()], [("air_1", 1), ("air", 0), ("ring", 0)])
        self.assertEqual(data.Output(0.0, self.grids()).background().name, "air")

    def test_a_level_that_finer_ones_cover_altogether_is_in_no_picture_and_no_scale(self):
        def series(grids):
            return [data.Series("fluid", [data.Output(0.0, data._read_grids(grids))])]
        speed = {key: np.full((5, 5), 2.0) for key in ("v1", "v2", "p")}
        fine = {"air": self.level(5, lambda x, y: np.full_like(x, data.DISCRETISED)) | speed}
        covered = {"air_1": self.level(5, lambda x, y: np.full_like(x, data.UNUSED)) | speed}
        self.assertEqual([grid.name for grid in series(fine | covered)[0].outputs[0].grids], ["air"])
        self.assertEqual(scales.of_run(series(fine | covered)), scales.of_run(series(fine)))

    def test_lines_are_where_cells_of_another_level_begin(self):
        lines = mesh.level_outline(self.grids()[0])
        self.assertEqual(len(lines), 4)
        self.assertTrue((lines[:, :, 0] == 0.5).all())
        np.testing.assert_allclose(sorted(lines[:, :, 1].ravel()), [0, 0.25, 0.25, 0.5, 0.5, 0.75, 0.75, 1])


class Grids(unittest.TestCase):
    """The picture of component grids."""

    def gas(self, name):
        return data.Series(name, [data.Output(0.0, [background()])], True)

    def test_two_gases_have_colours_of_their_own_and_one_those_it_always_had(self):
        looks = grids._looks([self.gas("left"), self.gas("right")], 0)
        self.assertEqual(len({colour for colour, _ in looks.values()}), 2)
        self.assertEqual(grids._looks([self.gas("fluid")], 0)["fluid", "grid"][0], looks["left", "grid"][0])

    def test_sides_that_go_on_at_the_opposite_one_are_not_called_open(self):
        case = {f"fluid.boundary.{side}": kind for side, kind in (("left", "periodic"), ("right", "periodic"), ("top", "outflow"))}
        kinds = [kind for kind, _ in grids._gas_sides([self.gas("fluid")], case | {"fluid.boundary.bottom.kind": "slip_wall"})]
        self.assertEqual(kinds, ["periodic", "periodic", "wall", "open"])
        _, axes = pyplot.subplots()
        self.addCleanup(pyplot.close, axes.figure)
        handles = grids._draw_sides(axes, [(kind, np.eye(2)) for kind in kinds])
        self.assertEqual([handle.get_label() for handle in handles], ["wall", "open", "periodic"])
        self.assertEqual(len({handle.get_linestyle() + str(handle.get_color()) for handle in handles}), 3)


class SideBySide(unittest.TestCase):
    def lattice(self, points, hole=0.0):
        x1, x2 = np.meshgrid(np.linspace(-1, 1, points), np.linspace(-1, 1, points))
        kind = np.where(np.hypot(x1, x2) < hole, data.UNUSED, data.DISCRETISED)
        return read({"x1": x1, "x2": x2, "kind": kind, "rho": np.where(kind == data.UNUSED, np.nan, 2 + x1 * x2)})

    def test_densities_are_compared_where_both_backgrounds_have_points(self):
        for pair in ((self.lattice(21), self.lattice(41, 0.3)), (self.lattice(41, 0.3), self.lattice(21))):
            x1, x2, (a, b) = side_by_side.on_common_points(*pair)
            self.assertEqual(x1.shape, (21, 21))
            known = np.hypot(x1, x2) >= 0.3
            self.assertTrue((np.isnan(a) == ~known).all() and (a[known] == b[known]).all())

    def test_backgrounds_without_common_points_are_not_compared(self):
        self.assertIsNone(side_by_side.on_common_points(self.lattice(21), self.lattice(31)))

    def test_runs_are_called_by_what_is_different_about_them(self):
        case = "grid: \n  factor: {j}\ninterface:\n  projection: {p}\n"
        cases = [case.format(j=j, p="full") for j in (8, 16)]
        self.assertEqual(several.labels(cases, ["a", "b"]), ["h = 1/80", "h = 1/160"])
        self.assertEqual(several.labels([cases[0]] * 2, ["a", "b"]), ["a", "b"])
        unsaid = cases[0].replace("  projection: full\n", "")
        self.assertEqual(several.labels([unsaid, cases[0]], ["a", "b"]), ["simplified", "full"])

    def test_folders_of_one_name_are_called_by_those_above_them_too(self):
        self.assertEqual(several.names([Path("x/run"), Path("y/run")]), ["x/run", "y/run"])
        self.assertEqual(several.names([Path("x/a"), Path("y/b")]), ["a", "b"])
        self.assertEqual(several.names([Path("x/a/run"), Path("y/a/run")]), ["x/a/run", "y/a/run"])

    def test_a_law_is_said_of_its_own_solid_where_there_are_several(self):
        case = "solids:\n  block:\n    law: saint_venant_kirchhoff\n  egg:\n    law: {}\n"
        cases = [case.format(law) for law in ("neo_hookean", "rigid")]
        self.assertEqual(several.labels(cases, ["a", "b"]), ["egg: neo hookean", "egg: rigid"])
        alone = [one.replace("  block:\n    law: saint_venant_kirchhoff\n", "") for one in cases]
        self.assertEqual(several.labels(alone, ["a", "b"]), ["neo hookean", "rigid"])

    def test_names_of_times_do_not_overlap_and_stay_where_there_is_room(self):
        wide, high = outlines.LABEL
        self.assertEqual(outlines.levels([(0, 0), (wide, 0), (2 * wide, 0)]), [0, 0, 0])
        places = np.array([(0, 0), (wide / 2, 3), (wide / 3, -high / 2)])
        placed = places - np.outer(outlines.levels(places), [0, high])
        for k in range(3):
            for other in range(k):
                apart = np.abs(placed[k] - placed[other])
                self.assertTrue(apart[0] >= wide or apart[1] >= high - 1e-6, placed)

    def test_few_times_are_spread_evenly_and_common_to_all_runs(self):
        runs = [dict.fromkeys(times, "output") for times in ((0, 0.5, 1, 2, 3, 4), (0, 0.5, 1 + 1e-12, 2, 3, 4, 5))]
        self.assertEqual(several.few(several.common_times(runs)), [0.5, 2, 4])


class Disk(unittest.TestCase):
    def test_deformation_gradient_of_a_linear_displacement_is_exact_also_at_the_seam(self):
        F = disk._deformation_gradient(ring())
        wanted = np.array([[1.3, 0.2], [-0.1, 1.1]])
        self.assertLess(np.abs(F - wanted[:, :, None, None]).max(), 1e-11)  # round-off of differences of h = 1/40

    def test_pressure_acts_along_the_radius_only_whatever_the_deformation(self):
        F = np.array([[1.3, 0.2], [-0.1, 1.1]])
        nominal = -7.0 * np.linalg.det(F) * np.linalg.inv(F)
        normal, shear = disk._stress_on_circle(F, nominal, np.array(0.3), np.array(-0.4))
        self.assertAlmostEqual(float(normal), -7.0, places=12)
        self.assertAlmostEqual(float(shear), 0.0, places=12)

    def test_the_stress_along_the_axis_is_the_normal_one_of_the_circle(self):
        """On y = 0 the radius is the x axis: sigma_11 there is the traction's normal part that the other picture shows."""
        grid = ring()
        grid.fields |= {key: values + 0 * grid.x1 for key, values in (("P11", 2.0), ("P12", 0.5), ("P21", 0.25), ("P22", -1.0))}
        grid.fields |= {key: 0 * grid.x1 for key in ("v1", "v2")}
        grid = data.Grid(grid.name, grid.x1 + grid.fields["u1"], grid.x2 + grid.fields["u2"], grid.kind, grid.fields, grid.closed)
        x = np.array([-0.95, 0.95])
        found = disk._on_axis([grid], x, lambda one: {"normal": disk._sigma_11(one)})["normal"]
        F = disk._deformation_gradient(grid)
        normal, _ = disk._stress_on_circle(F, disk._nominal(grid.fields), np.ones_like(grid.x1), np.zeros_like(grid.x1))
        self.assertLess(np.abs(found - normal[4, 0]).max(), 1e-11)

    def test_the_axis_is_free_where_no_grid_is(self):
        found = disk._on_axis([ring()], np.array([0.0, 0.6, -0.6, 2.0]), lambda one: {"x": one.x1})["x"]
        self.assertTrue(np.isnan(found[[0, 3]]).all())
        self.assertLess(np.abs(found[1:3] - [0.6, -0.6]).max(), 1e-12)

    def test_the_reference_goes_on_on_the_other_side_of_the_centre(self):
        r = np.linspace(0, 1, 5)
        points = disk.Points(r, r, {"v_r": r, "normal": r ** 2})
        x, v = disk._even(points, "v_r")
        self.assertTrue(np.allclose(v, x) and np.allclose(disk._even(points, "normal")[1], x ** 2))

    def test_the_reference_of_a_gas_around_a_disk_is_not_drawn_across_it(self):
        r = np.linspace(1, 2, 3)
        x, v = disk._even(disk.Points(r, r, {"v_r": r}), "v_r")
        self.assertEqual(np.isnan(x).tolist(), [False] * 3 + [True] + [False] * 3)
        self.assertEqual(np.isnan(v).tolist(), np.isnan(x).tolist())


if __name__ == "__main__":
    unittest.main()
