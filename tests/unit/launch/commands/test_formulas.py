#!/usr/bin/python3
"""A resolved case says by which formulas its parameters came about, so that runs are told apart by what was written or set."""

import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
import launcher  # noqa: E402, F401
from fsi_launch import case  # noqa: E402
from fsi_launch.plot.several_runs import several  # noqa: E402

FORMULAS = {"v_1": "mach * a_0", "a_0": "sqrt(gamma)"}
NUMBERS = "name: c\nparameters:\n  mach: {}\n  v_1: {}\n  a_0: 1.18\ngrid:\n  v_1: 4\n"
WRITTEN = """
parameters: {gamma: 1.4, p: 1, double: 2 * p}
fluid:
  gamma: gamma
  grid: {x: [0, 1], y: [0, 1], points: [11, 11]}
  boundary: {left: slip_wall, right: slip_wall, bottom: slip_wall, top: slip_wall}
  initial: {rho: double, v: [0, 0], p: p}
time: {end: 0.1}
"""


def resolved(mach, v_1):
    return case.with_formulas(NUMBERS.format(mach, v_1), FORMULAS)


class Formulas(unittest.TestCase):
    def test_stand_behind_the_numbers_they_gave_and_can_be_taken_away(self):
        text = resolved(2, 2.37)
        self.assertIn("\n  v_1: 2.37    # formula: mach * a_0\n", text)
        self.assertIn("\n  v_1: 4\n", text)     # no parameter
        self.assertEqual(case.formulas(text), FORMULAS)
        self.assertEqual(case.without_formulas(text), NUMBERS.format(2, 2.37))
        self.assertEqual(several.entries(text), several.entries(NUMBERS.format(2, 2.37)))

    def test_those_of_a_resolved_case_stay_until_a_parameter_is_set_which_its_numbers_do_not_follow(self):
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "case.yaml"
            path.write_text(WRITTEN, encoding="utf-8")
            first = case.resolve(str(path), ["parameters.p=3"], []).text
            self.assertEqual(case.formulas(first), {"double": "2 * p"})
            path.write_text(first, encoding="utf-8")
            self.assertEqual(case.resolve(str(path), [], []).text, first)
            self.assertEqual(case.formulas(case.resolve(str(path), ["time.end=0.2"], []).text), {"double": "2 * p"})
            self.assertEqual(case.formulas(case.resolve(str(path), ["parameters.p=4"], []).text), {})

    def test_runs_are_called_by_what_was_set_and_not_by_what_follows(self):
        cases = [resolved(mach, 1.18 * mach) for mach in (2, 3)]
        self.assertEqual(several.labels(cases, ["a", "b"]), ["mach = 2", "mach = 3"])
        other = case.with_formulas(NUMBERS.format(3, 5.0), {"a_0": "sqrt(gamma)"})
        self.assertEqual(several.labels([cases[0], other], ["a", "b"]), ["mach = 2, v_1 = 2.36", "mach = 3, v_1 = 5"])

    def test_numbers_of_labels_are_rounded(self):
        cases = [NUMBERS.format(mach, 1) for mach in (1.23456789, 680.5879810869421)]
        self.assertEqual(several.labels(cases, ["a", "b"]), ["mach = 1.23457", "mach = 680.588"])


if __name__ == "__main__":
    unittest.main()
