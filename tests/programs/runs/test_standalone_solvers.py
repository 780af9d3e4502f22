#!/usr/bin/python3
"""A case with a gas only, or one solid only, runs by the same command without a coupler."""

import os
import signal
import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from running import EndToEnd, let_pass, until  # noqa: E402


class StandaloneSolvers(EndToEnd):
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

    def test_one_that_does_not_end_its_step_is_lost_by_name(self):
        """A step on so fine a grid computes for much longer than a tenth of a millisecond."""
        for case, name, program in (("free_stream", "fluid", "fluid_solver"),
                                    ("solid_manufactured", "solid", "solid_solver_neo_hookean")):
            run = self.launch(case, "--set", "grid.factor=16", "--set", "time.step_timeout=1e-4", "--set", "expect={}", out=name)
            self.assertEqual(run.wait(), 4, run.stderr)
            self.assertRegex(run.stderr, rf"lost {name} \({program}\): no step for .* s, .*time\.step_timeout")
            self.assertEqual(run.summary()["status"], "failed")
            self.assertIn(f"lost {name}", run.summary()["reason"])
            self.assert_nothing_left(run)

    def test_one_that_is_stopped_for_longer_than_a_step_may_compute_goes_on(self):
        run = self.launch("sod_tube", "--set", "time.dt=1e-7", "--set", "time.step_timeout=0.5", "--set", "expect={}",
                          "--set", "output.checkpoint_every=20")
        self.assertTrue(until(run.checkpoints))
        pid = run.programs()["fluid_solver"]
        os.kill(pid, signal.SIGSTOP)
        let_pass(2)
        before = run.checkpoints()[-1]
        os.kill(pid, signal.SIGCONT)
        self.assertTrue(until(lambda: run.checkpoints()[-1:] > [before]))
        run.ctl("stop")
        self.assertEqual(run.wait(), 0, run.stderr)

    def test_state_before_a_break_has_its_time_also_after_a_restart(self):
        import h5py
        run = self.launch("sod_tube", "--set", "grid.factor=2", "--set", "expect={}", "--set", "output.checkpoint_every=1",
                          "--set", "fluid.boundary.left={kind: dirichlet, state: {rho: 1, v: [0, 0], p: 't < 0.1 ? 1 : 1e200'}}")
        self.assertEqual(run.wait(), 3, run.stderr)

        def labels():
            with h5py.File(run.directory / "last_state" / "fluid.h5") as file:
                return int(file.attrs["step"]), float(file.attrs["t"])
        before = labels()
        self.assertGreater(before[1], 0.1)
        again = self.launch("--restart", str(run.directory), out=None)
        self.assertEqual(again.wait(), 3, again.stderr)
        self.assertIn(f"goes on from the checkpoint of step {before[0]}", again.stderr)
        self.assertEqual(labels(), before)
        log = (run.directory / "log" / "fluid.log").read_text(encoding="utf-8")
        self.assertEqual(log.count(f" error step {before[0] + 1}, "), 2, log)
        self.assertLess(log.index(" error "), log.index("goes on from the checkpoint"))


if __name__ == "__main__":
    unittest.main()
