#!/usr/bin/python3
"""A run is watched and controlled from outside by ./launch/fsi monitor and ctl."""

import json
import os
import signal
import subprocess
import time
import unittest

from running import BIN, EndToEnd, FSI
from test_lost_programs import LONG


class Watching(EndToEnd):
    def outside(self, run, *words, wait=True):
        """Another ./launch/fsi of the same user."""
        process = subprocess.Popen([FSI, *words], stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, text=True,
                                   stderr=subprocess.PIPE,
                                   env=os.environ | {"FSI_BIN": str(BIN), "XDG_RUNTIME_DIR": str(run.runtime)})
        self.addCleanup(process.communicate)
        self.addCleanup(process.kill)
        if not wait:
            return process
        stdout, stderr = process.communicate(timeout=30)
        self.assertEqual(process.returncode, 0, stderr)
        return stdout

    def test_one_line_of_json_for_scripts(self):
        run = self.launch(*LONG)
        run.until_stepping()
        state = json.loads(self.outside(run, "monitor", str(run.directory), "--once", "--json"))
        self.assertIn("elastic_piston", json.dumps(state))

    def test_pause_resume_and_stop(self):
        run = self.launch(*LONG)
        run.until_stepping()
        self.outside(run, "ctl", str(run.directory), "pause")
        time.sleep(0.5)  # the step in progress ends
        before = (run.directory / "interface.csv").stat().st_size
        time.sleep(0.5)
        self.assertEqual((run.directory / "interface.csv").stat().st_size, before)
        self.outside(run, "ctl", str(run.directory), "resume")
        self.outside(run, "ctl", str(run.directory), "stop")
        self.assertEqual(run.wait(), 0, run.stderr)
        self.assertEqual(run.summary()["status"], "stopped")
        self.assertGreater((run.directory / "interface.csv").stat().st_size, before)
        self.assert_nothing_left(run)

    def test_frozen_monitor_does_not_hold_up_the_run(self):
        run = self.launch("elastic_piston", "--set", "grid.factor=2", "--set", "time.dt=1e-4", "--set", "expect={}")
        run.until_stepping()
        watcher = self.outside(run, "monitor", str(run.directory), "--plain", wait=False)
        time.sleep(0.3)
        os.kill(watcher.pid, signal.SIGSTOP)
        self.assertEqual(run.wait(), 0, run.stderr)

    def test_unknown_run_is_a_mistake(self):
        answer = subprocess.run([FSI, "monitor", "no_such_run", "--once"], capture_output=True, text=True, check=False,
                                env=os.environ | {"FSI_BIN": str(BIN), "XDG_RUNTIME_DIR": str(self.folder)})
        self.assertEqual(answer.returncode, 2)


if __name__ == "__main__":
    unittest.main()
