#!/usr/bin/python3
"""Rates of convergence recover the order of made-up errors."""

import sys
import unittest
from pathlib import Path
from types import SimpleNamespace
from unittest import mock

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
import launcher  # noqa: E402,F401  the path of the launcher's modules
from fsi_launch import run  # noqa: E402
from fsi_launch.command import cli, verbs  # noqa: E402
from fsi_launch.failure import UserMistake  # noqa: E402
from fsi_launch.studies import converge  # noqa: E402


class Rates(unittest.TestCase):
    LEVELS = [2, 4, 8, 16]

    def test_power_law_is_recovered(self):
        errors = [3e-2 * j**-1.9 for j in self.LEVELS]
        self.assertAlmostEqual(converge.fitted_rate(self.LEVELS, errors), 1.9)
        for rate in converge.pairwise_rates(self.LEVELS, errors):
            self.assertAlmostEqual(rate, 1.9)

    def test_unequal_levels(self):
        levels = [3, 4, 10]
        self.assertAlmostEqual(converge.pairwise_rates(levels, [j**-2.0 for j in levels])[1], 2.0)

    def test_missing_and_zero_errors_give_no_rate(self):
        self.assertEqual(converge.pairwise_rates([2, 4, 8], [1e-3, None, 0.0]), [None, None])
        self.assertIsNone(converge.fitted_rate([2, 4], [1e-3, None]))

    def test_error_at_round_off_needs_no_rate(self):
        runs = [{"errors": {"rho": j**-1.0, "v2": 1e-16}, "steps": 1, "wall_s": 1.0} for j in (2, 4)]
        self.assertEqual(list(converge.too_low(converge.fitted(converge.table([2, 4], runs, ["rho", "v2"])), 1.9)), ["rho"])

    def test_table_as_text_and_markdown(self):
        runs = [{"errors": {"rho": j**-2.0}, "steps": 10 * j, "wall_s": 1.0} for j in (2, 4)]
        result = converge.table([2, 4], runs, ["rho"])
        self.assertIn("1/40  6.25e-02  2.00", converge.as_text(result))
        self.assertTrue(converge.as_markdown(result).startswith("| h | rho | rate | steps | wall [s] |\n|---|"))


class Levels(unittest.TestCase):
    def refused(self, levels, reference, min_rate=None):
        with self.assertRaises(UserMistake) as caught:
            converge._expect_enough(SimpleNamespace(levels=levels, min_rate=min_rate), self.case(reference))
        return str(caught.exception)

    def case(self, reference, **programs):
        return SimpleNamespace(name="mine", reference=reference, programs=programs or {"fluid": "fluid_solver", "a": "solid_solver_rigid"})

    def test_gas_alone_has_nothing_to_compare_but_with_a_reference(self):
        gas = self.case("none", fluid="fluid_solver")
        with self.assertRaisesRegex(UserMistake, "mine has no reference solution .* nothing to compare"):
            converge._expect_enough(SimpleNamespace(levels=[2, 4, 8], min_rate=None), gas)
        converge._expect_enough(SimpleNamespace(levels=[2, 4, 8], min_rate=None), self.case("riemann", fluid="fluid_solver"))

    def test_one_grid_is_too_few_and_it_is_said_how_many_it_takes(self):
        self.assertRegex(self.refused([4], "none"), "--levels 4: .*two grids.* to compare.* three for orders")
        self.assertRegex(self.refused([4], "piston_1d", min_rate=1.9), "--levels 4: .*two grids .*rate")
        self.assertIn("--min-rate", self.refused([2, 4], "none", min_rate=1.0))

    def test_two_are_enough_for_a_rate_with_a_reference_and_to_compare_without_and_one_for_errors(self):
        for levels, reference, rate in (([2, 4], "none", None), ([2, 4], "piston_1d", 1.9), ([4], "piston_1d", None)):
            converge._expect_enough(SimpleNamespace(levels=levels, min_rate=rate), self.case(reference))

    def test_grids_that_do_not_follow_the_level_are_refused_or_told(self):
        told = []
        with mock.patch.object(converge, "tell", told.append):
            converge._expect_finer([2, 4], {"fluid": 100, "solid": 50}, {"fluid": 400, "solid": 200})
            self.assertEqual(told, [])
            converge._expect_finer([2, 4], {"fluid": 100, "solid": 50}, {"fluid": 400, "solid": 50})
            self.assertRegex(told[0], "level 4: solid with as many points as on level 2: ")
            with self.assertRaisesRegex(UserMistake, "level 4: fluid, solid .* one and the same; .*`spacing: h`"):
                converge._expect_finer([2, 4], {"fluid": 100, "solid": 50}, {"fluid": 100, "solid": 50})


class WithoutPictures(unittest.TestCase):
    """What takes modules that are not there says so before the runs."""

    def without(self, name):
        return mock.patch.dict(sys.modules, {name: None} | {key: None for key in sys.modules if key.startswith("fsi_launch.plot.")})

    def test_rows_of_boundaries_are_told_to_be_left_out(self):
        told = []
        options = SimpleNamespace(case="c", overrides=[], laws=[], levels=[2, 4, 8], min_rate=None, out=str(Path(__file__)))
        for reference, count in (("none", 1), ("piston_1d", 0)):
            told.clear()
            with mock.patch.object(converge.self_convergence, "lacks", lambda: "matplotlib"), mock.patch.object(converge, "tell", told.append), \
                    mock.patch.object(converge.cases, "resolve", lambda *_: SimpleNamespace(name="c", reference=reference, programs={"a": "solid_solver_rigid"})), \
                    self.assertRaises(UserMistake):
                converge.main(options)      # that folder is a file
            self.assertEqual(len(told), count)
        self.assertIsNone(converge.self_convergence.lacks())
        with self.without("h5py"):
            self.assertTrue(converge.self_convergence.lacks())

    def test_a_movie_is_refused_before_the_run(self):
        with mock.patch.dict(sys.modules, {"h5py": None}), mock.patch.object(run, "run") as started, \
                self.assertRaisesRegex(UserMistake, "pictures need h5py: apt-get install"):
            cli._run(verbs.parser("run").parse_args(["run", "sod_tube", "--movie"]))
        started.assert_not_called()


if __name__ == "__main__":
    unittest.main()
