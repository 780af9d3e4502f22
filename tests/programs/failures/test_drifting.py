#!/usr/bin/python3
"""A body that drifts out of the gas ends the run by name: which grid, where, when, and how far from what."""

import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from running import EndToEnd  # noqa: E402

RADIUS = 1.0
HALF_SIDE = 2.0     # of the gas, whose middle the disk begins in
LINES = 8           # of the ring of the gas around the disk
SPACING = 0.1


class DriftingBodies(EndToEnd):
    """The disk of moving_together_disk, faster and for longer than its gas is wide."""

    def drift(self, *settings):
        """A run that a drifting body ends, and what its summary says of that."""
        run = self.launch("moving_together_disk", *settings, "--set", "time.end=10", "--set", "expect={}")
        self.assertEqual(run.wait(), 3, run.stderr)
        self.assert_nothing_left(run)
        summary = run.summary()
        failure = summary["failure"]
        self.assertEqual((summary["status"], failure["origin"]), ("failed", "fluid"))
        # The step that failed is the one after the last that went well.
        self.assertEqual(failure["step"], summary["steps"] + 1)
        self.assertGreater(failure["t"], summary["t"])
        return run, failure

    def out(self, axis, velocity):
        """The disk drifts with so much velocity in one direction: it ends when its ring comes to the rim, at a point on that side."""
        run, failure = self.drift("--set", f"parameters.V_{axis}={velocity}", "--set", f"parameters.V_{3 - axis}=0")
        travelled = abs(velocity) * failure["t"]
        self.assertLess(travelled, HALF_SIDE - RADIUS)
        self.assertGreater(travelled + RADIUS + LINES * SPACING, HALF_SIDE)
        self.assertIn(failure["grid"], ("ring", "background"))
        place = failure["position"]
        self.assertGreater(place[axis - 1] * (1 if velocity > 0 else -1), RADIUS)
        self.assertRegex(failure["what"], r'without a donor .* the rim of "background" ')
        self.assertRegex(run.stderr, rf'fluid: step \d+, t = \S+, grid "{failure["grid"]}", point \(\d+, \d+\) at \(')

    def test_out_to_the_right(self):
        self.out(1, 3)

    def test_out_at_the_bottom(self):
        self.out(2, -3)


if __name__ == "__main__":
    unittest.main()
