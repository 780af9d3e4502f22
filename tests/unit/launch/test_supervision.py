#!/usr/bin/python3
"""However programs end, all of them end, and the launcher knows which one was the cause. The programs are scripts."""

import os
import signal
import sys
import threading
import time
import unittest
from unittest import mock

from launcher import InScratch

from fsi_launch import supervise
from fsi_launch.run import root_cause

TALK = "import time\nfor k in range(600): print('progress step=%d' % k, flush=True); time.sleep(0.05)"
SLEEP = "import time; time.sleep(30)"
DEAF = "import signal, time; signal.signal(signal.SIGTERM, signal.SIG_IGN); time.sleep(30)"
LOST_PEER_SOON = "import sys, time; time.sleep(0.6); sys.exit(4)"


def exits(code, after=0.0):
    return f"import sys, time; time.sleep({after}); sys.exit({code})"


def dies(number, after=0.3):
    return f"import os, time; time.sleep({after}); os.kill(os.getpid(), {int(number)})"


class Supervision(InScratch):
    def supervise(self, listen=None, **scripts):
        """Runs scripts under a supervisor; returns {name: Ending}, the Outcome and the seconds it took."""
        heard = []
        programs = [supervise.Program(name, [sys.executable, "-S", "-c", script], listen=name == listen)
                    for name, script in scripts.items()]
        start = time.monotonic()
        outcome = supervise.Supervisor(self.folder, heard.append).run(programs)
        self.heard = heard
        return {ending.name: ending for ending in outcome.endings}, outcome, time.monotonic() - start

    def test_all_well(self):
        endings, outcome, _ = self.supervise(a=exits(0), b=exits(0))
        self.assertEqual([ending.code for ending in endings.values()], [0, 0])
        self.assertIsNone(root_cause(outcome.endings))

    def test_killed_program_is_the_cause_not_those_that_lost_it(self):
        _, outcome, _ = self.supervise(a=LOST_PEER_SOON, b=dies(signal.SIGKILL), c=LOST_PEER_SOON)
        cause = root_cause(outcome.endings)
        self.assertEqual((cause.name, cause.code, cause.lost()), ("b", -signal.SIGKILL, True))

    def test_broken_numbers_are_the_cause_even_if_a_peer_ends_earlier(self):
        _, outcome, _ = self.supervise(a=exits(4, 0.1), b=exits(3, 0.5))
        self.assertEqual(root_cause(outcome.endings).name, "b")

    def test_who_repeats_the_reason_of_another_is_not_the_cause(self):
        _, outcome, _ = self.supervise(a=exits(3, 0.1), b=exits(3, 0.5))
        reasons = {"a": "b: step 412: det F = -0.02", "b": "step 412: det F = -0.02"}
        self.assertEqual(root_cause(outcome.endings, reasons).name, "b")

    def test_program_that_does_not_notice_is_ended_within_five_seconds(self):
        endings, _, seconds = self.supervise(a=exits(3), b=SLEEP, c=DEAF)
        self.assertTrue(endings["b"].ours and endings["c"].ours)
        self.assertEqual(endings["c"].code, -signal.SIGKILL)
        self.assertLess(seconds, supervise.GRACE + supervise.KILL_AFTER + 1)  # 1 s for a busy machine

    def test_stopped_program_is_ended_at_once_when_another_has_failed(self):
        stopped = "import os, signal; os.kill(os.getpid(), signal.SIGSTOP)"
        endings, _, seconds = self.supervise(a=exits(4, 0.3), b=stopped)
        self.assertEqual(endings["b"].code, -signal.SIGKILL)
        self.assertTrue(endings["b"].ours)
        self.assertLess(seconds, supervise.GRACE)

    def test_lines_reach_the_listener_and_the_rest_the_log(self):
        self.supervise(listen="a", a="import sys; print('x\\ny'); print('words', file=sys.stderr)", b="print('z')")
        self.assertEqual(self.heard, ["x", "y"])
        self.assertEqual((self.folder / "a.out").read_text(), "words\n")
        self.assertEqual((self.folder / "b.out").read_text(), "z\n")

    def after(self, seconds, *numbers):
        """Sends signals to this process, one after the other."""
        def send():
            for number in numbers:
                time.sleep(seconds)
                os.kill(os.getpid(), number)
        thread = threading.Thread(target=send)
        thread.start()
        self.addCleanup(thread.join)

    def test_interrupt_ends_all_and_is_remembered(self):
        self.after(0.5, signal.SIGINT)
        endings, outcome, seconds = self.supervise(listen="a", a=TALK, b=SLEEP)
        self.assertEqual(outcome.signal, signal.SIGINT)
        self.assertEqual({ending.code for ending in endings.values()}, {-signal.SIGTERM})
        self.assertLess(seconds, supervise.STOP_GRACE)

    def test_signal_that_comes_when_all_have_ended_is_not_forgotten(self):
        end_everything = supervise.Supervisor._end_everything

        def signalled(supervisor):
            end_everything(supervisor)
            os.kill(os.getpid(), signal.SIGTERM)

        with mock.patch.object(supervise.Supervisor, "_end_everything", signalled):
            self.assertEqual(self.supervise(one=exits(0))[1].signal, signal.SIGTERM)

    def test_second_interrupt_kills_at_once(self):
        self.after(0.7, signal.SIGINT, signal.SIGINT)
        endings, _, seconds = self.supervise(a=DEAF)
        self.assertEqual(endings["a"].code, -signal.SIGKILL)
        self.assertLess(seconds, supervise.STOP_GRACE)

    def test_stopped_program_ends_too(self):
        endings, _, _ = self.supervise(a=exits(1, 0.5), b=f"import os; os.kill(os.getpid(), {int(signal.SIGSTOP)})")
        self.assertTrue(endings["b"].ours)

    def test_killed_launcher_takes_its_programs_along(self):
        report, inherited = os.pipe()
        launcher = os.fork()
        if launcher == 0:
            script = f"import os, time; os.write({inherited}, b'%d' % os.getpid()); time.sleep(30)"
            os.set_inheritable(inherited, True)
            real = supervise.subprocess.Popen
            supervise.subprocess.Popen = lambda *a, **k: real(*a, pass_fds=(inherited,), **k)
            supervise.Supervisor(self.folder).run([supervise.Program("a", [sys.executable, "-S", "-c", script])])
            os._exit(0)
        os.close(inherited)
        child = int(os.read(report, 20))
        os.kill(launcher, signal.SIGKILL)
        os.waitpid(launcher, 0)
        self.assertEqual(os.read(report, 20), b"", f"{child} holds the pipe open")  # closed when the program is gone


if __name__ == "__main__":
    unittest.main()
