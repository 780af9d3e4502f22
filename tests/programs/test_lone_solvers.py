#!/usr/bin/python3
"""A case with a gas only, or one solid only, runs by the same command without a coupler."""

import unittest

from running import EndToEnd


class LoneSolvers(EndToEnd):
    def alone(self, case, participant, *options):
        run = self.complete(case, *options)
        summary = run.summary()
        self.assertEqual(list(summary["participants"]), [participant])
        self.assertGreater(summary["steps"], 0)
        self.assertTrue(summary["errors"])
        self.assert_nothing_left(run)

    def test_gas(self):
        self.alone("free_stream", "fluid")

    def test_shock_tube(self):
        self.alone("sod_tube", "fluid", "--set", "grid.factor=5", "--set", "expect={}")

    def test_solid(self):
        self.alone("solid_manufactured", "solid", "--set", "grid.factor=2", "--set", "expect={}")


if __name__ == "__main__":
    unittest.main()
