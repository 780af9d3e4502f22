#!/usr/bin/python3
"""A run is watched and controlled from outside by ./launch/fsi monitor and ctl."""

import fcntl
import json
import os
import pty
import select
import signal
import struct
import subprocess
import termios
import time
import types
import unittest

from running import BIN, EndToEnd, FSI
from test_lost_programs import LONG


class Screen:
    """A ./launch/fsi on a terminal of its own."""

    def __init__(self, run, *words, columns=80, rows=24):
        self.text = ""
        self.pid, self.terminal = pty.fork()
        if self.pid == 0:
            os.environ |= {"FSI_BIN": str(BIN), "XDG_RUNTIME_DIR": str(run.runtime), "TERM": "xterm", "LC_ALL": "C.UTF-8"}
            os.execv(FSI, [str(FSI), *words])
        self.resize(columns, rows)

    def resize(self, columns, rows):
        fcntl.ioctl(self.terminal, termios.TIOCSWINSZ, struct.pack("HHHH", rows, columns, 0, 0))
        os.kill(self.pid, signal.SIGWINCH)

    def until(self, words, seconds=30):
        """Waits for these words; what came before them is forgotten."""
        end = time.monotonic() + seconds
        while words not in self.text and time.monotonic() < end:
            if not select.select([self.terminal], [], [], 0.1)[0]:
                continue
            try:
                self.text += os.read(self.terminal, 65536).decode(errors="replace")
            except OSError:  # it has ended
                break
        found, self.text = words in self.text, self.text.partition(words)[2]
        return found

    def press(self, key):
        os.write(self.terminal, key.encode())

    def end(self):
        """Exit code; kills what is still there."""
        end = time.monotonic() + 20
        while time.monotonic() < end:
            pid, status = os.waitpid(self.pid, os.WNOHANG)
            if pid:
                os.close(self.terminal)
                return os.waitstatus_to_exitcode(status)
            self.until("no such words", 0.05)  # an unread terminal would hold it up
            time.sleep(0.01)
        os.kill(self.pid, signal.SIGKILL)
        os.waitpid(self.pid, 0)
        os.close(self.terminal)
        return None


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
        self.assertGreater(state["steps_per_s"], 0)
        self.assertGreater(state["participants"]["fluid"]["bus"]["messages_per_s"], state["steps_per_s"])

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

    def test_frozen_killed_and_slow_monitors_neither_hold_up_the_run_nor_change_one_bit_of_it(self):
        case = ["elastic_piston", "--set", "grid.factor=2", "--set", "time.dt=1e-4", "--set", "expect={}"]
        alone = self.complete(*case, out="alone")
        run = self.launch(*case)
        run.until_stepping()
        frozen = self.outside(run, "monitor", str(run.directory), "--plain", wait=False)
        killed = self.outside(run, "monitor", str(run.directory), "--json", wait=False)
        self.outside(run, "monitor", str(run.directory), "--json", wait=False)  # nobody reads what it prints
        time.sleep(0.7)
        os.kill(frozen.pid, signal.SIGSTOP)
        killed.kill()
        self.assertEqual(run.wait(), 0, run.stderr)
        table = "interface.csv"  # how both sides differ, with all digits, at every step
        self.assertEqual((run.directory / table).read_bytes(), (alone.directory / table).read_bytes())

    def test_terminal_shows_the_run_and_stops_it_when_asked_twice(self):
        run = self.launch(*LONG)
        run.until_stepping()
        screen = Screen(run, "monitor", str(run.directory))
        for words in ("AMP-FSI", "limited by", "p50/p99", "v jump", "along solid"):
            self.assertTrue(screen.until(words), words)
        screen.resize(100, 30)
        screen.press("p")
        self.assertTrue(screen.until("paused"))
        screen.press("r")
        self.assertTrue(screen.until("running"))
        screen.press("s")
        self.assertTrue(screen.until("stop the run after this step?"))
        screen.press("n")
        self.assertTrue(screen.until("pause"))
        self.assertIsNone(run.process.poll())
        screen.press("s")
        self.assertTrue(screen.until("stop the run after this step?"))
        screen.press("y")
        self.assertEqual(run.wait(), 0, run.stderr)
        self.assertTrue(screen.until("the run is over"))
        screen.press("q")
        self.assertEqual(screen.end(), 0)
        self.assertEqual(run.summary()["status"], "stopped")
        self.assert_nothing_left(run)

    def test_terminal_lets_choose_among_several_runs(self):
        one, two = self.launch(*LONG), self.launch(*LONG, out="another")
        one.until_stepping()
        two.until_stepping()
        screen = Screen(one, "monitor")
        self.assertTrue(screen.until("several runs are going on"))
        screen.press("\r")
        self.assertTrue(screen.until("TAB interface"))
        screen.press("q")
        self.assertEqual(screen.end(), 0)
        self.assertIsNone(one.process.poll())

    def test_stopped_and_killed_programs_are_shown_as_such(self):
        run = self.launch(*LONG)
        gas = run.until_stepping()["fluid_solver"]
        screen = Screen(run, "monitor", str(run.directory))
        self.assertTrue(screen.until("alive"))
        os.kill(gas, signal.SIGSTOP)
        self.assertTrue(screen.until("stopped"))
        self.assertTrue(screen.until("waiting"))
        os.kill(gas, signal.SIGCONT)
        self.assertTrue(screen.until("alive"))
        os.kill(gas, signal.SIGKILL)
        self.assertTrue(screen.until("ended the run"))
        self.assertEqual(run.wait(), 4)
        screen.press("q")
        self.assertEqual(screen.end(), 0)

    def test_recording_shows_the_run_again(self):
        run = self.launch(*LONG)
        run.until_stepping()
        recording = self.folder / "run.h5"
        recorder = self.outside(run, "monitor", str(run.directory), "--plain", "--record", str(recording), wait=False)
        time.sleep(2)
        self.outside(run, "ctl", str(run.directory), "stop")
        self.assertEqual(run.wait(), 0, run.stderr)
        recorder.communicate(timeout=30)
        state = json.loads(self.outside(run, "monitor", "--replay", str(recording), "--once", "--json"))
        self.assertEqual(state["step"], run.summary()["steps"])
        self.assertEqual(set(state["participants"]), {"fluid", "solid", "coupler"})
        self.assertIn("status=running", self.outside(run, "monitor", "--replay", str(recording), "--plain", "--speed", "4"))

    def test_run_with_the_monitor_in_front_goes_on_without_it_after_q(self):
        folder = self.folder / "run"
        (self.folder / "runtime").mkdir()
        screen = Screen(types.SimpleNamespace(runtime=self.folder / "runtime"), "run", *LONG, "--out", str(folder), "--monitor",
                        columns=120)
        for words in ("AMP-FSI", "limited by"):
            self.assertTrue(screen.until(words), words)
        screen.press("q")
        self.assertTrue(screen.until("the monitor has ended; the run goes on"))
        self.assertTrue(screen.until("steps/s"))
        os.kill(screen.pid, signal.SIGTERM)
        self.assertEqual(screen.end(), 143)
        self.assertEqual(json.loads((folder / "summary.json").read_text(encoding="utf-8"))["status"], "failed")

    def test_run_asked_for_a_monitor_without_a_terminal_says_so_and_goes_on(self):
        run = self.complete("sod_tube", "--set", "grid.factor=2", "--set", "expect={}", "--monitor")
        self.assertIn("--monitor needs a terminal", run.stderr)

    def test_unknown_run_is_a_mistake(self):
        answer = subprocess.run([FSI, "monitor", "no_such_run", "--once"], capture_output=True, text=True, check=False,
                                env=os.environ | {"FSI_BIN": str(BIN), "XDG_RUNTIME_DIR": str(self.folder)})
        self.assertEqual(answer.returncode, 2)


if __name__ == "__main__":
    unittest.main()
