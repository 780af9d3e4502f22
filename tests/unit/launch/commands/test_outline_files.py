#!/usr/bin/python3
"""Files of outlines as other programs write them: airfoils by two sides, points that are repeated, decimal commas, three columns."""

import math
import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from launcher import InScratch  # noqa: E402
from fsi_launch import new  # noqa: E402
from fsi_launch.failure import UserMistake  # noqa: E402
from fsi_launch.new import outline  # noqa: E402

UPPER = [(part * part, 0.26 * part * (1 - part * part)) for part in (k / 8 for k in range(9))]
LOWER = [(x, -y) for x, y in UPPER]


def lines(points, sign=" "):
    return "".join(f"{x:.9g}{sign}{y:.9g}\n" for x, y in points)


class Files(InScratch):
    def read(self, content, straight=False):
        path = self.folder / "outline.csv"
        path.write_text(content)
        return outline.read(path, straight)

    def refused(self, content):
        with self.assertRaises(UserMistake) as caught:
            self.read(content, straight=True)
        return str(caught.exception)

    def test_an_airfoil_by_two_sides_from_nose_to_tail_is_the_same_as_once_around(self):
        around = self.read("NACA\n" + lines(UPPER[::-1] + LOWER[1:]))
        found = self.read(f"NACA\n  9.  9.\n\n{lines(UPPER)}\n{lines(LOWER)}")
        self.assertEqual(len(found.points), 16)
        for one, other in zip(found.points, around.points):
            self.assertAlmostEqual(math.dist(one, other), 0)
        self.assertEqual(found.title, "line 1, 'NACA', is taken as a title; it has the points of two sides, 9 and 9")
        self.assertTrue(found.changed)

    def test_whole_numbers_are_points_where_they_count_none(self):
        self.assertEqual(len(self.read("3,3\n0,0\n4,0\n5,1\n5,2\n4,4\n").points), 6)           # five follow
        self.assertEqual(len(self.read("3,3\n0,0\n4,0\n5,1\n5,2\n4,4\n3.5,3.5\n").points), 7)     # six, but no two sides from one nose

    def test_points_that_are_repeated_count_once(self):
        square = ((0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0))
        for points, changed in ((((0, 0), (1, 0), (1, 0), (1, 1), (0, 1), (0, 1)), True), ((*square, square[0]), False), (square, False),
                                ((square[0], *square, square[0]), True)):
            found = self.read(lines(points))
            self.assertEqual((found.points, found.changed), (square, changed))

    def test_decimal_commas_are_read_where_another_sign_stands_between_the_numbers(self):
        for sign in (";", "; ", "\t"):
            found = self.read("x;y\n" + lines(UPPER[::-1] + LOWER[1:], "|").replace(".", ",").replace("|", sign))
            self.assertEqual([f"{y:.9g}" for _, y in found.points], [f"{y:.9g}" for _, y in (UPPER[::-1] + LOWER[1:])[:-1]])
            self.assertTrue(found.changed)
        self.assertEqual(self.read("0, 0\n1, 0\n1,\t1\n0 ,1\n").points, ((0, 0), (1, 0), (1, 1), (0, 1)))
        for content in ("0,5 1,0\n", "0,5 1\n", "0,5,1,0\n"):
            self.assertIn("with decimal commas put ; or a tab between x and y", self.refused(content))

    def test_a_third_column_has_to_be_constant(self):
        self.assertEqual(self.read("0 0 5\n1 0 5\n1 1 5\n0 1 5\n").points, ((0, 0), (1, 0), (1, 1), (0, 1)))
        self.assertIn("the third is no constant: it goes from 0 to 2", self.refused("0 0 0\n1 0 0\n1 1 2\n"))
        self.assertIn("outline.csv:2: '1 0' has 2 numbers, the line before it 3", self.refused("0 0 0\n1 0\n1 1 2\n"))

    def test_what_the_programs_would_read_differently_is_written_for_them(self):
        for content, same in (("0 0\n1 0\n1 1\n0 1\n", True), ("0 0 5\n1 0 5\n1 1 5\n0 1 5\n", False), ("0,0;0\n1;0\n1;1\n0;1,0\n", False)):
            self.read(content)
            options = type("Options", (), {"outline": str(self.folder / "outline.csv"), "straight": False, "size": None, "on_wall": False})
            self.assertEqual(new._outline(options).path is not None, same)

    def test_a_curve_is_round_between_its_corners_where_many_points_turn_a_little(self):
        along = [k / 10 for k in range(10)]
        rectangle = (*((x, 0) for x in along), *((1, y) for y in along), *((1 - x, 1) for x in along), *((0, 1 - y) for y in along))
        for points, is_round in (((*UPPER[::-1], *LOWER[1:-1]), True), (rectangle, False), (((0, 0), (1, 0), (1, 2), (0.5, 3), (0, 2)), False)):
            self.assertEqual(outline.is_round(outline.Outline(points=tuple(points))), is_round)


class Names(unittest.TestCase):
    def test_folders_are_no_names_of_cases(self):
        for name in (".", "..", "/", "", "there/"):
            with self.subTest(name), self.assertRaisesRegex(UserMistake, "no name of a case but of a folder"):
                new._paths(type("Options", (), {"name": name}))


if __name__ == "__main__":
    unittest.main()
