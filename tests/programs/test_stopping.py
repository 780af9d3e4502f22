#!/usr/bin/python3
"""A run that is asked to end does so at once and in order, and leaves nothing behind, whatever way it is asked."""

import os
import signal
import time
import unittest

from running import EndToEnd, until
from test_lost_programs import LONG


class Beginning(EndToEnd):
    """While the shell script and the interpreter begin, nobody is ready for signals yet."""

    def ask(self, number, code):
        for moment in range(16):
            run = self.launch(*LONG, out=f"run{moment}")
            time.sleep(0.008 * moment)
            run.process.send_signal(number)
            ended = run.wait()
            self.assertIn(ended, (code, -number), f"after {8 * moment} ms: {run.stderr}")
            self.assert_nothing_left(run)

    def test_interrupt(self):
        self.ask(signal.SIGINT, 130)

    def test_terminate(self):
        self.ask(signal.SIGTERM, 143)


class Stopping(EndToEnd):
    def ask(self, number, code):
        run = self.launch(*LONG)
        run.until_stepping()
        start = time.monotonic()
        run.process.send_signal(number)
        self.assertEqual(run.wait(), code, run.stderr)
        self.assertLess(time.monotonic() - start, 5)
        self.assertEqual(run.summary()["status"], "failed")
        self.assertGreater(run.summary()["steps"], 0)
        self.assert_nothing_left(run)

    def test_interrupt(self):
        self.ask(signal.SIGINT, 130)

    def test_terminate(self):
        self.ask(signal.SIGTERM, 143)

    def test_killed_launcher_leaves_no_program(self):
        run = self.launch(*LONG)
        programs = run.until_stepping()
        self.assertEqual(len(programs), 3)
        run.process.kill()
        self.assertEqual(run.wait(), -signal.SIGKILL)
        self.assertTrue(until(lambda: not run.programs(), 5), run.programs())

    def test_stopped_and_continued_launcher_does_not_disturb_the_run(self):
        run = self.launch("elastic_piston", "--set", "grid.factor=2", "--set", "time.dt=1e-4", "--set", "expect={}")
        run.until_stepping()
        os.kill(run.process.pid, signal.SIGSTOP)
        time.sleep(1)
        os.kill(run.process.pid, signal.SIGCONT)
        self.assertEqual(run.wait(), 0, run.stderr)


if __name__ == "__main__":
    unittest.main()
