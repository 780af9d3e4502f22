#!/usr/bin/python3
"""`fsi new` before it asks the programs: outlines, materials, sizes, questions."""

import math
import sys
import unittest
from pathlib import Path
from types import SimpleNamespace

import yaml

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from launcher import InScratch  # noqa: E402
from fsi_launch import new  # noqa: E402
from fsi_launch.failure import UserMistake  # noqa: E402
from fsi_launch.new import materials, outline, questions, text  # noqa: E402
from fsi_launch.new.problem import Problem  # noqa: E402

OPTIONS = ("name", "outline", "straight", "on_wall", "size", "flow", "mach", "density", "pressure", "gamma", "material", "law", "fixed", "end",
           "cells")


def options(**given):
    return SimpleNamespace(**{name: None for name in OPTIONS} | {"name": "case", "straight": False, "fixed": False, "on_wall": False} | given)


def problem(**given):
    return new.problem_of(options(**given))


class Outlines(InScratch):
    def read(self, content):
        path = self.folder / "outline.csv"
        path.write_text(content)
        return outline.read(path, straight=True)

    def test_separators_comments_and_headings(self):
        expected = ((0.0, 0.0), (1.0, 0.0), (0.5, 2.0))
        for content in ("0,0\n1,0\n.5,2\n", "# outline\nx; y\n0; 0\n1; 0  # foot\n\n0.5; 2\n", "0 0\n1\t0\n0.5 2\n", "0,0\n1,0\n0.5,2\n0,0\n"):
            with self.subTest(content):
                self.assertEqual(self.read(content).points, expected)

    def test_a_byte_order_mark_is_no_part_of_the_first_point(self):
        self.assertEqual(self.read("\ufeff0,0\n1,0\n.5,2\n").points[0], (0.0, 0.0))

    def test_a_heading_with_a_unit_is_what_the_numbers_are_in(self):
        points = "0,0\n120,0\n120,12\n"
        for heading, unit, metres in (("x_mm,y_mm", "mm", 1e-3), ("x [mm]; y [mm]", "mm", 1e-3), ("X (cm), Y (cm)", "cm", 1e-2), ("x/m, y/m", "m", 1), ('"x_in","y_in"', "in", 0.0254),
                                      ("x1 [ft] x2 [ft]", "ft", 0.3048), ("x,y", "", 1), ("X Y", "", 1), ("x_max,y_min", "", 1), ("inner x, y", "", 1)):
            with self.subTest(heading):
                found = self.read(f"# of a drawing\n{heading}\n{points}")
                self.assertEqual((found.unit, found.title), (unit, ""))
                self.assertAlmostEqual(outline.in_metres(found).size(), 120 * metres)
                self.assertAlmostEqual(problem(outline=str(self.folder / "outline.csv"), straight=True).outline.size(), 120 * metres)
                self.assertAlmostEqual(problem(outline=str(self.folder / "outline.csv"), straight=True, size=0.1).outline.size(), 0.1)
        with self.assertRaisesRegex(UserMistake, "outline.csv:1: 'x_mm,y_cm' names several units, cm, mm; write both"):
            self.read("x_mm,y_cm\n" + points)

    def test_the_size_that_is_taken_is_said_with_where_it_comes_from(self):
        words = "the outline is 0.12 x 0.012 m (--size makes its longer side another length)"
        found = outline.in_metres(self.read("x_mm,y_mm\n0,0\n120,0\n120,12\n"))
        self.assertEqual(outline.taken(found, "a.csv"), f"the numbers in a.csv are in mm, as its heading says: {words}")
        self.assertEqual(outline.taken(self.read("0,0\n.12,0\n.12,.012\n"), "a.csv"), words)

    def test_the_title_of_an_airfoil_is_skipped_and_told(self):
        for title in ("NACA 0012", "E387", "S1223 (10% thick)", "20-32C AIRFOIL", "MH 45, 9.85", "Clark Y"):
            found = self.read(f"\n{title}\n0,0\n1,0\n.5,2\n")
            self.assertEqual((len(found.points), found.title), (3, f"line 2, '{title}', is taken as a title"))
        for content in ("0,0\nNACA 0012\n1,0\n", "x,y\nNACA 0012\n0,0\n", "0,x\n1,0\n"):     # no first line, or no text
            with self.assertRaisesRegex(UserMistake, "is no point"):
                self.read(content)

    def test_mistakes_say_where(self):
        for content, said in (("0,0\n1,nan\n", "outline.csv:2: '1,nan' is no point"), ("0,0\n1,x\n", "outline.csv:2: '1,x' is no point"), ("O.5,0\n1,1\n", "outline.csv:1: 'O.5,0' is no point"),
                              ("nan,0\n1,1\n", "outline.csv:1: 'nan,0' is no point"), ('"x","y"\n1,1\n', "3 points"), ("0,0\n1,0,3\n", "outline.csv:2"), ("0,0\n1,1\n", "3 points")):
            with self.subTest(content), self.assertRaises(UserMistake) as caught:
                self.read(content)
            self.assertIn(said, str(caught.exception))
        with self.assertRaises(UserMistake):
            outline.read(self.folder / "nowhere.csv")

    def test_a_smooth_curve_needs_a_point_more_than_a_triangle(self):
        self.read("0,0\n1,0\n.5,2\n")
        with self.assertRaises(UserMistake) as caught:
            outline.read(self.folder / "outline.csv")
        self.assertIn("--straight", str(caught.exception))

    def test_scaled_outline_has_the_size_and_the_shape(self):
        before = self.read("0,0\n4,0\n4,2\n0,2\n")
        after = outline.scaled(before, 0.1)
        self.assertAlmostEqual(after.size(), 0.1)
        x_low, x_high, y_low, y_high = after.box()
        self.assertAlmostEqual((x_high - x_low) / (y_high - y_low), 2)


class Materials(unittest.TestCase):
    def test_bars_of_steel_and_aluminium_carry_sound_equally_fast_and_rubber_slower_than_air(self):
        speed = {name: math.sqrt(one.E / one.rho) for name, one in materials.TABLE.items()}
        self.assertLess(abs(speed["steel"] - speed["aluminium"]), 0.02 * speed["steel"])
        self.assertLess(speed["rubber"], 340)

    def test_all_are_elastic(self):
        for one in materials.TABLE.values():
            self.assertTrue(one.rho > 0 and one.E > 0 and 0 < one.nu < 0.5, one)

    def test_of_ones_own(self):
        own = materials.material_of("1000,1e6,0.4")
        self.assertEqual((own.rho, own.E, own.nu), (1000, 1e6, 0.4))

    def test_mistakes(self):
        for word in ("unobtainium", "1,2", "1000,1e6,0.5", "-1,1e6,0.3"):
            with self.subTest(word), self.assertRaises(UserMistake):
                materials.material_of(word)


class Sizes(unittest.TestCase):
    def test_gas_reaches_a_length_and_a_half_beyond_the_body_in_whole_spacings(self):
        for size in (3e-4, 0.07, 1.0, 12.3):
            one = problem(size=size)
            h, (x_low, x_high, y_low, y_high) = one.spacing(), one.domain()
            self.assertTrue(0.4 * size / 20 < h <= size / 20 * 1.0001, (size, h))
            for reach in (-x_low, x_high, -y_low, y_high):
                self.assertGreaterEqual(reach * 1.0001, 2 * size)
                self.assertAlmostEqual(reach / h, round(reach / h), places=6)
            self.assertTrue(x_low < one.shock() < -0.5 * size)

    def test_shock_has_passed_the_body_at_the_end(self):
        one = problem(size=0.2, mach=2.0)
        self.assertGreater(one.shock() + 2.0 * one.sound() * one.duration(), 0.1)

    def test_air_at_sea_level_carries_sound_at_340_metres_per_second(self):
        self.assertAlmostEqual(problem().sound(), 340.3, delta=0.1)

    def test_mistakes(self):
        for given in ({"mach": 1.0}, {"mach": -1.0, "flow": "stream"}, {"density": 0.0}, {"gamma": 1.0}, {"cells": 2}, {"size": 0.0},
                      {"fixed": True}, {"straight": True}, {"on_wall": True}, {"end": float("nan")}):
            with self.subTest(given), self.assertRaises(UserMistake):
                problem(**given)


    def test_numbers_that_are_not_finite_are_refused_by_the_name_of_their_option(self):
        for option in ("size", "mach", "density", "pressure", "gamma", "end"):
            for value in (float("nan"), float("inf"), -float("inf")):
                with self.subTest(option, value=value), self.assertRaisesRegex(UserMistake, f"--{option} .*no finite number; write"):
                    problem(**{option: value})
        for material in ("inf,1e6,0.3", "1000,inf,0.3"):
            with self.assertRaisesRegex(UserMistake, "must be finite"):
                problem(material=material)

    def test_a_size_for_which_no_resolution_can_be_written_is_refused_with_one_that_can(self):
        for size in (1e-30, 1e300):
            with self.assertRaisesRegex(UserMistake, "write a --size of 4e-06 to 2e"):
                problem(size=size)
        self.assertGreaterEqual(problem(size=4e-6).spacing(), 1.99e-7)


class Text(unittest.TestCase):
    def test_all_of_it_is_what_was_asked_for(self):
        case = yaml.safe_load(text.write(problem(material="steel", law="rigid", fixed=True, mach=1.7, end=2e-3), "case.yaml", None))
        body, parameters = case["solids"]["body"], case["parameters"]
        self.assertEqual((body["law"], body["motion"], case["units"]), ("rigid", "fixed", "SI"))
        self.assertEqual((parameters["mach"], float(parameters["E"]), case["time"]["end"]), (1.7, 205e9, 0.002))

    def test_numbers_of_ones_own_are_written_as_they_are_given(self):
        given = {"mach": 1.2345678901, "density": 1.2250000000000001e-7, "pressure": 101325.7, "gamma": 1.4000000000000001, "end": 1.2345678e-3,
                 "size": 0.123456789, "material": "1234.5678,2.34567891e9,0.3333333333333333"}
        case = yaml.safe_load(text.write(problem(**given), "case.yaml", None))
        numbers = {key: float(value) for key, value in case["parameters"].items() if key in ("mach", "rho_0", "p_0", "gamma", "rho_bar", "E", "nu")}
        self.assertEqual(numbers, {"mach": 1.2345678901, "rho_0": 1.2250000000000001e-7, "p_0": 101325.7, "gamma": 1.4000000000000001,
                                   "rho_bar": 1234.5678, "E": 2.34567891e9, "nu": 0.3333333333333333})
        self.assertEqual((float(case["time"]["end"]), case["solids"]["body"]["shape"]["radius"]), (1.2345678e-3, 0.5 * 0.123456789))
        self.assertEqual([text.exact(value) for value in (101325.0, 205e9, 0.1, 1e-3, 1 / 3)], ["101325", "2.05e+11", "0.1", "0.001", repr(1 / 3)])

    def test_places_of_ones_own_are_too_and_a_body_stands_where_its_wall_is(self):
        points = ((0.0, 0.1234567891234), (0.1, 0.1234567891234), (0.1, 0.3), (0.0, 0.3))
        one = Problem("case", outline.Outline(Path("o.csv"), points), materials.TABLE["steel"], straight=True, on_wall=True)
        case = yaml.safe_load(text.write(one, "case.yaml", "o.csv"))
        self.assertEqual([tuple(corner) for corner in case["solids"]["body"]["shape"]["corners"]], list(points))
        self.assertEqual(case["fluid"]["grid"]["y"][0], 0.1234567891234)

    def test_straight_edges_are_a_polygon_through_the_same_points(self):
        points = ((0.0, 0.0), (0.1, 0.0), (0.1, 0.05))
        one = Problem("case", outline.Outline(Path("o.csv"), points), materials.TABLE["steel"], straight=True)
        shape = yaml.safe_load(text.write(one, "case.yaml", "o.csv"))["solids"]["body"]["shape"]
        self.assertEqual((shape["kind"], [tuple(corner) for corner in shape["corners"]]), ("polygon", list(points)))


class Corners(unittest.TestCase):
    """What is written of outlines with acute corners."""

    SQUARE, WEDGE = ((0, 0), (1, 0), (1, 1), (0, 1)), ((0, 0), (1, 0.03), (0, 0.06))
    DART = ((0, 0), (1, 0.4), (0.35, 0), (1, -0.4))

    def shape(self, points, **given):
        one = Problem("case", outline.Outline(Path("o.csv"), points), materials.TABLE["steel"], **given)
        return one, yaml.safe_load(text.write(one, "case.yaml", "o.csv"))["solids"]["body"]["shape"]

    def test_the_largest_arcs_that_fit_touch_each_other(self):
        self.assertAlmostEqual(outline.largest_radius(outline.Outline(points=self.SQUARE)), 0.5)
        self.assertAlmostEqual(outline.largest_radius(outline.Outline(points=((0, 0), (1, 0), (0.5, math.sqrt(0.75))))), 0.5 / math.sqrt(3))   # that of the circle within
        self.assertEqual(outline.largest_radius(outline.Outline(points=self.SQUARE)), outline.largest_radius(outline.Outline(points=self.SQUARE[::-1])))

    def test_arcs_written_fit_at_acute_corners_too(self):
        for points in (self.SQUARE, self.WEDGE, self.DART):
            for law in ("neo_hookean", "rigid"):
                with self.subTest(points, law=law):
                    one, shape = self.shape(points, straight=True, law=law, sharp=False)
                    self.assertLess(shape["radius"], outline.largest_radius(one.outline))

    def test_what_rounding_takes_of_an_acute_corner_is_known(self):
        wedge = outline.Outline(points=[(0, 0), (1, -0.5), (1, 0.5)])
        lost, corner = outline.rounded_away(wedge, 0.1)
        self.assertEqual(corner, (0, 0))
        self.assertAlmostEqual(lost, 0.1 * (math.hypot(1, 0.5) / 0.5 - 1))
        self.assertNotEqual(outline.rounded_away(wedge, 0.1, foot=True)[1], (0, 0))

    def test_corners_of_a_rigid_body_stay_sharp_and_where_that_is_not_valid_those_do_for_which_no_arc_of_some_size_fits(self):
        for points in (self.WEDGE, self.SQUARE):
            self.assertEqual(self.shape(points, straight=True, law="rigid")[1]["radius"], 0)
            self.assertGreater(self.shape(points, straight=True)[1]["radius"], 0)
        self.assertEqual(self.shape(self.WEDGE, straight=True, law="rigid", sharp=False)[1]["radius"], 0)
        self.assertGreater(self.shape(self.SQUARE, straight=True, law="rigid", sharp=False)[1]["radius"], 0)

    def test_corners_closer_than_points_of_the_grid_are_rounded_where_sharp_ones_are_not_valid(self):
        circle = tuple((math.cos(k * math.pi / 60), math.sin(k * math.pi / 60)) for k in range(120))
        self.assertGreater(self.shape(circle, straight=True, law="rigid", sharp=False)[1]["radius"], 0)

    def test_a_smooth_outline_of_a_rigid_body_has_corners_where_it_turns_sharply(self):
        fin = ((1, 0), (0.8, 0.06), (0.4, 0.1), (0.1, 0.08), (0, 0.03), (0, -0.03), (0.1, -0.08), (0.4, -0.1), (0.8, -0.06))
        for points in (fin, fin[::-1]):
            self.assertEqual(self.shape(points, law="rigid")[1]["corner_angle"], outline.SHARP)
            self.assertNotIn("corner_angle", self.shape(points)[1])
        self.assertNotIn("corner_angle", self.shape(self.SQUARE, law="rigid")[1])
        self.assertNotIn("corner_angle", self.shape(self.DART, law="rigid")[1])     # one of its corners is hollow

    def foil(self, tail, near_nose):
        """A symmetric foil 1 long and 0.1 thick by 20 points on each side, its tail `tail` thick; `near_nose` moves these there."""
        parts = [near_nose(k / 20) for k in range(21)]
        above = [(x, 0.26 * math.sqrt(x) * (1 - x) + 0.5 * tail * x) for x in parts]
        return (*above[::-1], *((x, -y) for x, y in above[1:] if y > 0))

    def test_a_blunt_tail_has_two_corners_and_the_nose_none(self):
        for tail, number in ((0.01, 2), (0.0, 1)):
            points = self.foil(tail, lambda part: part * part)
            for given in (points, points[::-1], points[7:] + points[:7]):
                angle = self.shape(given, law="rigid")[1]["corner_angle"]
                found = outline.turns(outline.Outline(points=given))
                self.assertEqual([given[k][0] for k, turn in enumerate(found) if turn > math.radians(angle)], [1.0] * number)
                self.assertNotIn("corner_angle", self.shape(given)[1])
        # By so few points at its nose that it turns more there than at the corners of its tail: no angle tells them apart.
        self.assertNotIn("corner_angle", self.shape(self.foil(0.01, lambda part: part), law="rigid")[1])

    def test_a_rectangle_by_many_points_has_its_four_corners(self):
        along = [k / 10 for k in range(10)]
        points = (*((x, 0) for x in along), *((1, y) for y in along), *((1 - x, 1) for x in along), *((0, 1 - y) for y in along))
        self.assertEqual(self.shape(points, law="rigid")[1]["corner_angle"], 45)

    def test_points_that_turn_sharply_are_told_how_to_become_corners(self):
        for points, told in ((self.DART, True), (self.SQUARE, False)):
            one, _ = self.shape(points)
            self.assertEqual("--straight" in text.write(one, "case.yaml", "o.csv"), told)


class OnAWall(InScratch):
    def shape_of(self, content, **given):
        (self.folder / "o.csv").write_text(content)
        case = yaml.safe_load(text.write(problem(outline=str(self.folder / "o.csv"), straight=True, **given), "case.yaml", None))
        return case, case["solids"]["body"]

    def test_an_elastic_bar_has_sharp_corners_and_a_house_round_ones(self):
        bar, house = "0,0\n.1,0\n.1,.2\n0,.2\n", "0,0\n.1,0\n.1,.2\n.05,.3\n0,.2\n"
        self.assertEqual(self.shape_of(bar, on_wall=True)[1]["shape"]["radius"], 0)
        for content, given in ((house, {"on_wall": True}), (bar, {})):
            self.assertGreater(self.shape_of(content, **given)[1]["shape"]["radius"], 0)

    def test_four_corners_are_a_block_where_none_is_hollow(self):
        square, arrow = ((0, 0), (1, 0), (1, 1), (0, 1)), ((0, 0), (1, 0), (0.2, 0.2), (0, 1))
        for points, block in ((square, True), (square[::-1], True), (arrow, False), (square[:3], False)):
            self.assertEqual(outline.is_block(outline.Outline(Path("o.csv"), points)), block)

    def test_the_lowest_edge_is_the_foot(self):
        for content in ("0,-1\n1,-1\n1,2\n0,2\n", "1,2\n1,-1\n0,-1\n0,2\n", "0,2\n0,-1\n1,-1\n1,2\n"):
            case, body = self.shape_of(content, on_wall=True)
            corners = body["shape"]["corners"]
            self.assertEqual((corners[0][1], corners[-1][1]), (-1, -1))
            self.assertEqual({tuple(corner) for corner in corners}, {(0, -1), (1, -1), (1, 2), (0, 2)})
            self.assertEqual(body["shape"]["walls"], ["bottom", "bottom"])
            self.assertEqual(body["boundary"]["bottom"], "clamped")
            self.assertEqual((case["fluid"]["grid"]["y"][0], case["fluid"]["boundary"]["bottom"]), (-1, "slip_wall"))

    def test_without_a_level_foot_it_is_refused(self):
        with self.assertRaises(UserMistake) as caught:
            self.shape_of("0,0\n1,0.1\n1,2\n0,2\n", on_wall=True)
        self.assertIn("level edge", str(caught.exception))


class Questions(InScratch):
    def ask(self, given, *answers):
        """The options after these answers, and what was said."""
        said, left = [], list(answers)

        def ask(words):
            said.append(words)
            if not left:
                raise EOFError
            return left.pop(0)

        questions.ask_for_missing(given, ask, said.append)
        self.assertEqual(left, [])
        return given, said

    def test_empty_answers_take_the_defaults(self):
        given, _ = self.ask(options(), *[""] * len(questions.QUESTIONS))
        one = new.problem_of(given)
        self.assertEqual((one.flow, one.mach, one.material.name, one.law), ("shock", 1.3, "aluminium", "neo_hookean"))

    def test_what_was_given_is_not_asked_for(self):
        given, said = self.ask(options(flow="stream", mach=2.0, size=1.0, law="rigid", end=1.0), "", "steel")
        self.assertEqual((given.mach, given.material), (2.0, "steel"))
        self.assertFalse([words for words in said if "Mach" in words])

    def test_wrong_answers_are_asked_for_again(self):
        given, said = self.ask(options(outline="x", size=1.0, flow="shock", law="rigid", end=1.0), "fast", "-2", "1.5", "cheese", "steel")
        self.assertEqual((given.mach, given.material), (1.5, "steel"))
        self.assertIn("  'fast' is no number", said)

    def test_no_more_answers(self):
        with self.assertRaises(UserMistake):
            self.ask(options())


if __name__ == "__main__":
    unittest.main()
