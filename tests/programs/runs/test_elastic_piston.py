#!/usr/bin/python3
"""Gas, solid and coupler over the bus: the elastic piston ends well, with any law, and always with the same numbers."""

import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from running import EndToEnd  # noqa: E402


class ElasticPiston(EndToEnd):
    def test_meets_what_its_case_expects(self):
        run = self.complete("elastic_piston")
        summary = run.summary()
        self.assertEqual(summary["status"], "completed")
        self.assertEqual(set(summary["participants"]), {"fluid", "solid", "coupler"})
        self.assertTrue(all(entry["met"] for entry in summary["expectations"]) and summary["expectations"])
        self.assert_nothing_left(run)

    def test_every_program_tells_its_memory_and_on_what_it_spent_its_time(self):
        run = self.complete("elastic_piston", "--set", "grid.factor=2")
        for name, one in run.summary()["participants"].items():
            self.assertGreater(one["peak_memory_mib"], 1, name)
            self.assertGreater(one["time_s"]["advance"], 0, name)
            self.assertAlmostEqual(sum(one["time_s"].values()), one["compute_s"] + one["wait_s"], places=9)
        self.assertGreater(run.summary()["participants"]["fluid"]["time_s"]["grids"], 0)

    def test_another_law_by_one_option(self):
        run = self.complete("elastic_piston", "--solid", "solid=neo_hookean", "--set", "grid.factor=2")
        self.assertEqual(run.summary()["participants"]["solid"]["program"], "solid_solver_neo_hookean")
        self.assertIn("another law", run.stderr)  # than the exact solution is for
        judged = [entry["quantity"] for entry in run.summary()["expectations"]]
        self.assertEqual(judged, ["status", "interface.max_gap"])
        # No more after a restart, whose law is that of the run.
        again = self.launch("--restart", str(run.directory), "--set", "time.end=0.82", out=None)
        self.assertEqual(again.wait(), 0, again.stderr)
        self.assertEqual([entry["quantity"] for entry in run.summary()["expectations"]], judged)

    def test_missed_expectation_is_named_and_exits_1(self):
        run = self.launch("elastic_piston", "--set", "grid.factor=2", "--set", "expect.errors.rho={max: 1e-9}")
        self.assertEqual(run.wait(), 1, run.stderr)
        self.assertRegex(run.stderr, r"errors\.rho = \S+, must be at most 1e-09")

    def test_traditional_scheme_breaks_with_a_light_solid_and_says_what_broke(self):
        run = self.launch("elastic_piston", "--set", "interface.projection=traditional", "--set",
                          "parameters.density_ratio=0.01", "--set", "grid.factor=8")
        self.assertEqual(run.wait(), 3, run.stdout + run.stderr)
        self.assertEqual(run.summary()["status"], "failed")
        self.assertRegex(run.summary()["reason"], r't = \S+, grid "\w+", point \(\d+, \d+\)')
        self.assertIn(run.summary()["reason"], run.stderr)
        self.assert_nothing_left(run)

    def test_two_runs_side_by_side_give_the_same_bits(self):
        import h5py
        import numpy as np
        runs = [self.launch("elastic_piston", "--set", "grid.factor=2", out=name) for name in ("a", "b")]
        self.assertEqual([run.wait() for run in runs], [0, 0], runs[0].stderr + runs[1].stderr)
        tables = [(run.directory / "interface.csv").read_bytes() for run in runs]
        self.assertEqual(*tables)
        compared = []
        for name in ("fluid.h5", "solid_solid.h5"):
            with h5py.File(runs[0].directory / name) as a, h5py.File(runs[1].directory / name) as b:
                for output in a:
                    for grid in a[output]:
                        for field in a[output][grid]:
                            path = f"{output}/{grid}/{field}"
                            compared.append(path)
                            self.assertTrue(np.array_equal(a[path], b[path]), path)
        self.assertGreater(len(compared), 20)


if __name__ == "__main__":
    unittest.main()
