#!/usr/bin/python3
"""A resolved case says by which formulas its parameters came about, so that runs are told apart by what was written or set."""

import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
import launcher  # noqa: E402, F401
from fsi_launch import case  # noqa: E402
from fsi_launch.plot.several_runs import several  # noqa: E402

WRITTEN = """# a case
parameters:     # all of them
  mach: 2                 # of the stream

# its velocity
  v_1: mach * a_0         # [m/s]
  a_0: "sqrt(1.4)"
grid: {factor: 4}
"""
NUMBERS = "name: c\nparameters:\n  mach: {}\n  v_1: {}\n  a_0: 1.18\ngrid:\n  factor: 4\n"


def resolved(mach, v_1, *overrides, written=WRITTEN):
    return case.with_formulas(NUMBERS.format(mach, v_1), written, overrides)


class Formulas(unittest.TestCase):
    def test_stand_behind_the_numbers_they_gave_and_can_be_taken_away(self):
        text = resolved(2, 2.37)
        self.assertEqual(case.formulas(text), {"v_1": "mach * a_0", "a_0": "sqrt(1.4)"})
        self.assertEqual(case.without_formulas(text), NUMBERS.format(2, 2.37))
        self.assertEqual(several.entries(text), several.entries(NUMBERS.format(2, 2.37)))

    def test_what_is_set_counts(self):
        self.assertEqual(case.formulas(resolved(2, 5, "parameters.v_1=5")), {"a_0": "sqrt(1.4)"})
        self.assertEqual(case.formulas(resolved(3, 3.6, "parameters.mach=2 + 1")), {"mach": "2 + 1", "v_1": "mach * a_0", "a_0": "sqrt(1.4)"})

    def test_those_of_a_resolved_case_stay_until_a_parameter_is_set_which_its_numbers_do_not_follow(self):
        text = resolved(2, 2.37)
        self.assertEqual(resolved(2, 2.37, "time.end=1", written=text), text)
        self.assertEqual(case.formulas(resolved(3, 2.37, "parameters.mach=3", written=text)), {})

    def test_of_a_case_without_parameters_or_in_one_line_nothing_is_said(self):
        for written in ("", "grid: {factor: 4}\n", "parameters: {mach: 2, v_1: 2 * mach}\n"):
            self.assertEqual(resolved(2, 4, written=written), NUMBERS.format(2, 4))

    def test_runs_are_called_by_what_was_set_and_not_by_what_follows(self):
        cases = [resolved(mach, 1.18 * mach, f"parameters.mach={mach}") for mach in (2, 3)]
        self.assertEqual(several.labels(cases, ["a", "b"]), ["mach = 2", "mach = 3"])
        other = resolved(3, 5.0, "parameters.mach=3", "parameters.v_1=5.0")
        self.assertEqual(several.labels([cases[0], other], ["a", "b"]), ["mach = 2, v_1 = 2.36", "mach = 3, v_1 = 5"])

    def test_numbers_of_labels_are_rounded(self):
        cases = [NUMBERS.format(mach, 1) for mach in (1.23456789, 680.5879810869421)]
        self.assertEqual(several.labels(cases, ["a", "b"]), ["mach = 1.23457", "mach = 680.588"])


if __name__ == "__main__":
    unittest.main()
