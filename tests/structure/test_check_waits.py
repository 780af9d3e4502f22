#!/usr/bin/python3
"""The rule about clocks in tests finds them, and nothing else."""

import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))
import check_waits  # noqa: E402


class Waits(unittest.TestCase):
    def found(self, name, line):
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / name
            path.parent.mkdir(parents=True)
            path.write_text(line + "\n", encoding="utf-8")
            return list(check_waits.offences(Path(folder)))

    def test_clocks_and_sleeps_are_found(self):
        for line in ("time.sleep(1)", "start = time.monotonic()", "process.wait(timeout=10)", "self.assertTrue(until(done, 5))"):
            self.assertEqual(len(self.found("tests/programs/runs/test_a.py", line)), 1, line)
        for line in ("usleep(1000);", "std::this_thread::sleep_for(1s);", "const auto start = std::chrono::steady_clock::now();"):
            self.assertEqual(len(self.found("tests/unit/bus/a_test.cpp", line)), 1, line)

    def test_conditions_are_not(self):
        for line in ("until(lambda: run.checkpoints())", "let_pass(0.5)", "run.wait(timeout=WATCHDOG)", '"--set", "time.end=0.2"'):
            self.assertEqual(self.found("tests/programs/runs/test_a.py", line), [], line)

    def test_clocks_have_their_homes(self):
        self.assertEqual(self.found("tests/programs/running.py", "time.sleep(1)"), [])
        self.assertEqual(self.found("launch/fsi_launch/living/processes.py", "time.sleep(1)"), [])


if __name__ == "__main__":
    unittest.main()
