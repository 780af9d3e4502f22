#!/usr/bin/python3
"""A run is watched and controlled from outside by ./launch/fsi monitor and ctl."""

import contextlib
import fcntl
import json
import os
import pty
import select
import signal
import struct
import subprocess
import sys
import termios
import types
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from running import BIN, EndToEnd, FSI, LONG, WATCHDOG, until  # noqa: E402


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

    def read(self):
        """Takes in what is there; false where it has ended."""
        try:
            if select.select([self.terminal], [], [], 0.1)[0]:
                self.text += os.read(self.terminal, 65536).decode(errors="replace")
        except OSError:
            return False
        return True

    def until(self, words):
        """Waits for these words; what came before them is forgotten."""
        until(lambda: words in self.text or not self.read() or words in self.text)
        found, self.text = words in self.text, self.text.partition(words)[2]
        return found

    def press(self, key):
        os.write(self.terminal, key.encode())

    def end(self):
        """Exit code; kills what is still there."""
        ended = []

        def has_ended():
            self.read()  # an unread terminal would hold it up
            pid, status = os.waitpid(self.pid, os.WNOHANG)
            ended.extend([os.waitstatus_to_exitcode(status)] if pid else [])
            return bool(pid)

        if not until(has_ended):
            os.kill(self.pid, signal.SIGKILL)
            os.waitpid(self.pid, 0)
        os.close(self.terminal)
        return ended[0] if ended else None


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
        stdout, stderr = process.communicate(timeout=WATCHDOG)
        self.assertEqual(process.returncode, 0, stderr)
        return stdout

    def state(self, run):
        """What a script sees of it."""
        return json.loads(self.outside(run, "monitor", str(run.directory), "--once", "--json", "--wait", str(WATCHDOG)))

    def gas(self, run):
        return self.state(run)["participants"]["fluid"]

    def test_one_line_of_json_for_scripts(self):
        run = self.launch(*LONG)
        run.until_stepping()
        state = self.state(run)
        self.assertIn("elastic_piston", json.dumps(state))
        self.assertEqual(set(state["participants"]), {"fluid", "solid", "coupler"})
        self.assertTrue(until(lambda: self.state(run)["steps_per_s"]))  # takes two pieces of news
        self.assertTrue(until(lambda: (self.gas(run)["bus"]["messages_per_s"] or 0) > 0))
        gas = self.gas(run)
        self.assertGreaterEqual(gas["bus"]["messages"], 2 * gas["step"])

    def test_pause_resume_and_stop(self):
        run = self.launch(*LONG)
        run.until_stepping()
        run.ctl("pause")
        self.assertTrue(until(lambda: self.state(run)["status"] == "paused"))
        before = run.written()
        step = self.state(run)["step"]
        self.assertEqual(self.state(run)["step"], step)
        self.assertEqual(run.written(), before)
        run.ctl("resume")
        run.until_further()
        run.ctl("stop")
        self.assertEqual(run.wait(), 0, run.stderr)
        self.assertEqual(run.summary()["status"], "stopped")
        self.assertGreater(run.summary()["steps"], step)
        self.assert_nothing_left(run)

    def test_frozen_killed_and_slow_monitors_neither_hold_up_the_run_nor_change_one_bit_of_it(self):
        run = self.launch(*LONG)
        run.until_stepping()
        frozen = self.outside(run, "monitor", str(run.directory), "--plain", wait=False)
        killed = self.outside(run, "monitor", str(run.directory), "--json", wait=False)
        self.outside(run, "monitor", str(run.directory), "--json", wait=False)  # nobody reads what it prints
        for monitor in (frozen, killed):
            self.assertTrue(monitor.stdout.readline())
        os.kill(frozen.pid, signal.SIGSTOP)
        killed.kill()
        run.until_further(100_000)
        self.assert_as_undisturbed(run)

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

    def test_request_to_the_only_run_is_sent_after_a_yes(self):
        run = self.launch(*LONG)
        run.until_stepping()
        for answer in ("n", "y"):
            screen = Screen(run, "ctl", "stop", columns=200)
            self.assertTrue(screen.until("? [y/N]"))
            screen.press(f"{answer}\n")
            self.assertTrue(screen.until("nothing was asked" if answer == "n" else "has heard: stop"))
            self.assertEqual(screen.end(), 0)
            if answer == "n":
                run.until_further()
        self.assertEqual(run.wait(), 0, run.stderr)
        self.assertEqual(run.summary()["status"], "stopped")

    def test_stopped_and_killed_programs_are_shown_as_such(self):
        run = self.launch(*LONG, "--set", "time.peer_timeout=1800")
        gas = run.until_stepping()["fluid_solver"]
        screen = Screen(run, "monitor", str(run.directory))
        for _ in ("fluid", "solid", "coupler"):  # one that stops before it was heard of would never be
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

    def test_end_that_nobody_was_left_to_tell_is_told_by_the_summary(self):
        run = self.launch(*LONG, "--set", "time.peer_timeout=1800")
        programs = run.until_stepping()
        watcher = self.outside(run, "monitor", str(run.directory), "--plain", wait=False)
        self.assertTrue(until(lambda: "status=running step=" in watcher.stdout.readline()))
        for signum in (signal.SIGSTOP, signal.SIGKILL):  # none of them sees another one go
            for pid in programs.values():
                with contextlib.suppress(ProcessLookupError):  # the launcher may be quicker with the others
                    os.kill(pid, signum)
        self.assertEqual(run.wait(), 4)
        last = watcher.communicate(timeout=WATCHDOG)[0].splitlines()[-1]
        self.assertIn("status=aborted", last)
        self.assertRegex(last, 'reason=".*lost .* ended by SIGKILL')

    def test_recording_shows_the_run_again(self):
        run = self.launch(*LONG)
        run.until_stepping()
        recording = self.folder / "run.h5"
        recorder = self.outside(run, "monitor", str(run.directory), "--plain", "--record", str(recording), wait=False)
        self.assertTrue(until(lambda: "status=running step=" in recorder.stdout.readline()))
        run.ctl("pause")
        self.assertTrue(until(lambda: "status=paused" in recorder.stdout.readline()))
        run.ctl("stop")
        self.assertEqual(run.wait(), 0, run.stderr)
        recorder.communicate(timeout=WATCHDOG)
        state = json.loads(self.outside(run, "monitor", "--replay", str(recording), "--once", "--json"))
        # The stop takes one step more; what is told of it may get lost, as all that monitors are told.
        self.assertIn(run.summary()["steps"] - state["step"], (0, 1))
        self.assertEqual(set(state["participants"]), {"fluid", "solid", "coupler"})
        # Slowly, for a line is printed a second, or when the status changes, and a busy machine may miss one that lasts for a moment.
        replay = self.outside(run, "monitor", "--replay", str(recording), "--plain", "--speed", "0.1", wait=False)
        self.assertTrue(until(lambda: "status=running" in replay.stdout.readline()))
        replay.terminate()
        replay.communicate(timeout=WATCHDOG)

    def test_run_with_the_monitor_in_front_goes_on_without_it_after_q(self):
        folder = self.folder / "run"
        (self.folder / "runtime").mkdir()
        screen = Screen(types.SimpleNamespace(runtime=self.folder / "runtime"), "run", *LONG, "--out", str(folder), "--monitor",
                        columns=120)
        for words in ("AMP-FSI", "limited by"):
            self.assertTrue(screen.until(words), words)
        screen.press("q")
        self.assertTrue(screen.until("the monitor has ended; the run goes on"))
        self.assertTrue(screen.until("  step "))
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
