#!/usr/bin/python3
"""Any program of a run may be killed at any moment: the others end within 5 seconds, and it is named."""

import os
import signal
import time
import unittest

from running import EndToEnd, until

# Small steps make a run of tens of seconds: it is in its middle when a program is killed, and has one output behind it.
LONG = ("elastic_piston", "--set", "grid.factor=2", "--set", "time.dt=2e-6", "--set", "output.times=[1e-5, 0.8]")


class LostPrograms(EndToEnd):
    def lose(self, program, participant, number=signal.SIGKILL):
        run = self.launch(*LONG)
        os.kill(run.until_stepping()[program], number)
        start = time.monotonic()
        self.assertTrue(until(lambda: not run.programs(), 10))
        self.assertLess(time.monotonic() - start, 5)
        self.assertEqual(run.wait(), 4, run.stderr)
        self.assertIn(f"lost {participant}", run.stderr)
        self.assertEqual(run.summary()["status"], "failed")
        self.assertIn(participant, run.summary()["reason"])
        self.assert_output_opens(run)
        self.assert_nothing_left(run)

    def assert_output_opens(self, run):
        import h5py
        for name in ("fluid.h5", "solid_solid.h5"):
            with h5py.File(run.directory / name) as file:
                self.assertGreaterEqual(len(file), 1)
                for output in file.values():
                    self.assertIn("t", output.attrs)
        lines = (run.directory / "interface.csv").read_text().splitlines()
        self.assertTrue(all(line.count(",") == lines[0].count(",") for line in lines))

    def test_fluid(self):
        self.lose("fluid_solver", "fluid")

    def test_solid(self):
        self.lose("solid_solver_linear_elastic", "solid")

    def test_coupler(self):
        self.lose("coupler", "coupler")


if __name__ == "__main__":
    unittest.main()
