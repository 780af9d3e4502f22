#!/usr/bin/python3
"""However programs end, all of them end, and the launcher knows which one was the cause. The programs are scripts."""

import os
import re
import signal
import sys
import threading
import unittest
from pathlib import Path
from unittest import mock

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from launcher import InScratch, ROOT, ended  # noqa: E402
from fsi_launch.living import interrupts, processes, supervise  # noqa: E402
from fsi_launch.results.verdict import root_cause  # noqa: E402

FOR_EVER = 1e6      # [s]
# Programs; those that only end by a signal say when they are ready for it.
REST = "here(sys.argv[1]); rest()"
DEAF = "signal.signal(signal.SIGTERM, signal.SIG_IGN); here(sys.argv[1]); rest()"


def exits(code, after=()):
    """Ends when the programs named in `after` are there."""
    return f"wait(*{tuple(after)!r}); here(sys.argv[1]); sys.exit({code})"


def dies(number, after=()):
    return f"wait(*{tuple(after)!r}); here(sys.argv[1]); os.kill(os.getpid(), {int(number)})"


class Requests(unittest.TestCase):
    def test_one_in_the_callbacks_of_a_class_is_no_other_error(self):
        def strikes(error):
            class Member:
                def __set_name__(self, owner, name):
                    raise error

            with interrupts.unwrapped():
                type("Owner", (), {"member": Member()})

        for error in (KeyboardInterrupt, interrupts.Terminated):
            self.assertRaises(error, strikes, error)
        with self.assertRaises((RuntimeError, ValueError)):
            strikes(ValueError)


class Supervision(InScratch):
    def supervise(self, listen=None, **scripts):
        """Runs scripts under a supervisor; returns {name: Ending} and the Outcome."""
        heard = []
        programs = [supervise.Program(name, [sys.executable, "-S", "-c", self.script(script), name], listen=name == listen)
                    for name, script in scripts.items()]
        outcome = supervise.Supervisor(self.folder, heard.append).run(programs)
        self.heard = heard
        return {ending.name: ending for ending in outcome.endings}, outcome

    def within(self, **limits):
        """Other times than those of the supervisor."""
        for name, seconds in limits.items():
            patch = mock.patch.object(supervise, name, seconds)
            patch.start()
            self.addCleanup(patch.stop)

    def test_all_well(self):
        endings, outcome = self.supervise(a=exits(0), b=exits(0))
        self.assertEqual([ending.code for ending in endings.values()], [0, 0])
        self.assertIsNone(root_cause(outcome.endings))

    def test_killed_program_is_the_cause_not_those_that_lost_it(self):
        _, outcome = self.supervise(a=exits(4, after="b"), b=dies(signal.SIGKILL), c=exits(4, after="b"))
        cause = root_cause(outcome.endings)
        self.assertEqual((cause.name, cause.code, cause.lost()), ("b", -signal.SIGKILL, True))

    def test_broken_numbers_are_the_cause_even_if_a_peer_ends_earlier(self):
        self.within(GRACE=FOR_EVER)
        _, outcome = self.supervise(a=exits(4), b=exits(3, after="a"))
        self.assertEqual(root_cause(outcome.endings).name, "b")

    def test_who_repeats_the_reason_of_another_is_not_the_cause(self):
        self.within(GRACE=FOR_EVER)
        _, outcome = self.supervise(a=exits(3), b=exits(3, after="a"))
        self.assertEqual(root_cause(outcome.endings, {"a": "b", "b": "b"}).name, "b")

    def test_program_without_a_report_that_ends_as_it_was_told_is_not_the_cause(self):
        endings = [supervise.Ending("a", 3, 0.0), supervise.Ending("b", 3, 0.1)]
        self.assertEqual(root_cause(endings, {"b": "b"}).name, "b")
        self.assertEqual(root_cause(endings, {}).name, "a")

    def test_program_that_does_not_notice_is_asked_to_end_and_then_killed(self):
        self.within(GRACE=0.1, KILL_AFTER=0.5)
        endings, _ = self.supervise(a=exits(3, after="bc"), b=REST, c=DEAF)
        self.assertTrue(endings["b"].ours and endings["c"].ours)
        self.assertEqual(endings["b"].code, -signal.SIGTERM)
        self.assertEqual(endings["c"].code, -signal.SIGKILL)

    def test_stopped_program_is_ended_at_once_when_another_has_failed(self):
        self.within(GRACE=FOR_EVER)
        stopped = "here(sys.argv[1]); os.kill(os.getpid(), signal.SIGSTOP)"
        endings, outcome = self.supervise(a=exits(4, after="b"), b=stopped)
        self.assertEqual(endings["b"].code, -signal.SIGKILL)
        self.assertTrue(endings["b"].ours)
        self.assertEqual(root_cause(outcome.endings, {"a": "a"}).name, "a")  # its verdict says why

    def test_stopped_program_is_asked_to_end_when_others_have_ended_well(self):
        self.within(STOPPED=0.1, LAST_GRACE=FOR_EVER, KILL_AFTER=FOR_EVER)
        ends = "signal.signal(signal.SIGTERM, lambda *_: sys.exit({code})); here(sys.argv[1]); os.kill(os.getpid(), signal.SIGSTOP); rest()"
        for code in (0, 143):
            endings, outcome = self.supervise(a=exits(0, after="b"), b=ends.format(code=code), c="wait('a', 'b'); linger(); here('c')")
            self.assertEqual({name: ending.code for name, ending in endings.items()}, {"a": 0, "b": code, "c": 0})
            self.assertEqual([name for name, ending in endings.items() if ending.stopped], ["b"])
            cause = root_cause(outcome.endings)
            self.assertEqual(cause and cause.name, "b" if code else None)

    def test_programs_that_tell_others_of_a_death_are_not_killed_at_it(self):
        link = (ROOT / "common" / "bus" / "sessions" / "link.cpp").read_text(encoding="utf-8")
        telling = float(re.search(r"abort_patience_s = ([\d.]+);", link).group(1))
        self.assertGreaterEqual(supervise.KILL_AFTER, 2 * telling)
        self.assertGreaterEqual(supervise.GRACE, 2 * telling)

    def test_lines_reach_the_listener_and_the_rest_the_log(self):
        self.supervise(listen="a", a="print('joined\\ny'); print('words', file=sys.stderr); here('a')", b="wait('a'); print('z')")
        self.assertEqual(self.heard, ["joined", "y"])
        self.assertEqual((self.folder / "a.out").read_text(), "words\n")
        self.assertEqual((self.folder / "b.out").read_text(), "z\n")

    def test_program_that_ends_before_the_run_has_begun_ends_all_and_is_the_cause(self):
        self.within(LAST_GRACE=FOR_EVER, GRACE=FOR_EVER)
        for code in (0, 1):
            endings, outcome = self.supervise(listen="a", a=REST, b=exits(code, after="a"))
            self.assertEqual(endings["a"].code, -signal.SIGTERM)
            self.assertEqual(endings["b"].early, code == 0)
            self.assertEqual(root_cause(outcome.endings).name, "b")

    def test_program_that_ends_well_after_the_run_has_begun_is_left_alone(self):
        joined = "print('joined', flush=True); here('joined'); wait('b'); here('a')"
        endings, outcome = self.supervise(listen="a", a=joined, b=exits(0, after=("joined",)))
        self.assertFalse(endings["b"].early)
        self.assertIsNone(root_cause(outcome.endings))

    def test_the_listener_knows_the_processes_of_those_before_it(self):
        programs = [supervise.Program("a", [sys.executable, "-S", "-c", self.script("print(os.getpid())")]),
                    supervise.Program("b", [sys.executable, "-S", "-c", "import sys; print(*sys.argv[1:])"], listen=True,
                                      tell_pids=True)]
        heard = []
        supervise.Supervisor(self.folder, heard.append).run(programs)
        self.assertEqual(heard, [f"--pids a={(self.folder / 'a.out').read_text().strip()}"])

    def when(self, names, *numbers):
        """Sends signals to this process, one after the other, each when the next of the names is there."""
        def send():
            for name, number in zip(names, numbers):
                processes.until((self.folder / f"{name}.here").exists, FOR_EVER)
                os.kill(os.getpid(), number)
        thread = threading.Thread(target=send)
        thread.start()
        self.addCleanup(thread.join)

    def test_interrupt_ends_all_and_is_remembered(self):
        self.within(STOP_GRACE=FOR_EVER)
        self.when(["b"], signal.SIGINT)
        endings, outcome = self.supervise(listen="a", a="print('progress step=1', flush=True); " + REST, b="wait('a'); " + REST)
        self.assertEqual(outcome.signal, signal.SIGINT)
        self.assertEqual({ending.code for ending in endings.values()}, {-signal.SIGTERM})

    def test_signal_that_comes_when_all_have_ended_is_not_forgotten(self):
        end_everything = supervise.Supervisor._end_everything

        def signalled(supervisor):
            end_everything(supervisor)
            os.kill(os.getpid(), signal.SIGTERM)

        with mock.patch.object(supervise.Supervisor, "_end_everything", signalled):
            self.assertEqual(self.supervise(one=exits(0))[1].signal, signal.SIGTERM)

    def test_second_interrupt_kills_at_once(self):
        self.within(STOP_GRACE=FOR_EVER, ASKED_AGAIN=0)
        self.when(["a", "asked"], signal.SIGINT, signal.SIGINT)
        asked = "signal.signal(signal.SIGTERM, lambda *_: here('asked')); here('a'); rest()"
        endings, _ = self.supervise(a=asked)
        self.assertEqual(endings["a"].code, -signal.SIGKILL)

    def test_requests_that_come_together_are_one(self):
        self.within(STOP_GRACE=FOR_EVER, ASKED_AGAIN=FOR_EVER)
        self.when(["a", "asked"], signal.SIGTERM, signal.SIGTERM)
        slow = "signal.signal(signal.SIGTERM, lambda *_: here('asked')); here('a'); wait('asked'); linger(); sys.exit(143)"
        endings, _ = self.supervise(a=slow)
        self.assertEqual((endings["a"].code, len(endings)), (143, 1))

    def test_a_program_may_take_as_long_to_end_as_its_steps_are_long(self):
        self.within(STOP_GRACE=0.0, STOP_STEPS=FOR_EVER)
        self.when(["b"], signal.SIGTERM)
        slow = ("signal.signal(signal.SIGTERM, lambda *_: here('asked')); print('progress step=1', flush=True); here('b'); "
                "wait('asked'); linger(); sys.exit(143)")
        endings, _ = self.supervise(listen="a", a=slow)
        self.assertEqual(endings["a"].code, 143)

    def test_what_a_program_has_started_does_not_outlive_it(self):
        self.supervise(a="""
if os.fork() == 0:
    (folder / "pid").write_text(str(os.getpid()))
    here("child")
    rest()
wait("child")
""")
        try:
            child = os.pidfd_open(int((self.folder / "pid").read_text()))
        except ProcessLookupError:
            return
        ended(child)

    def test_killed_launcher_takes_its_programs_along(self):
        report, inherited = os.pipe()
        launcher = os.fork()
        if launcher == 0:
            script = self.script(f"os.write({inherited}, b'%d' % os.getpid()); rest()")
            os.set_inheritable(inherited, True)
            real = supervise.subprocess.Popen
            supervise.subprocess.Popen = lambda *a, **k: real(*a, **k | {"pass_fds": (inherited,)})
            supervise.Supervisor(self.folder).run([supervise.Program("a", [sys.executable, "-S", "-c", script])])
            os._exit(0)
        os.close(inherited)
        child = int(os.read(report, 20))
        os.kill(launcher, signal.SIGKILL)
        os.waitpid(launcher, 0)
        self.assertEqual(os.read(report, 20), b"", f"{child} holds the pipe open")  # closed when the program is gone


if __name__ == "__main__":
    unittest.main()
