#!/usr/bin/python3
"""A run that is asked to end does so at once and in order, and leaves nothing behind, whatever way it is asked."""

import os
import shutil
import signal
import subprocess
import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from running import BIN, EndToEnd, LONG, PATIENT, ROOT, WATCHDOG, let_pass, processes, until  # noqa: E402


def ask_twice(launcher):
    """It finds both requests at the same time; two of one kind would become one while it is stopped."""
    for number in (signal.SIGSTOP, signal.SIGTERM, signal.SIGINT, signal.SIGCONT):
        os.kill(launcher, number)


class Beginning(EndToEnd):
    """While the shell script and the interpreter begin, nobody is ready for signals yet."""

    def ask(self, number, code):
        for moment in range(16):
            run = self.launch(*LONG, out=f"run{moment}")
            let_pass(0.008 * moment)
            run.process.send_signal(number)
            ended = run.wait()
            self.assertIn(ended, (code, -number), f"after {8 * moment} ms: {run.stderr}")
            self.assert_nothing_left(run)

    def test_interrupt(self):
        self.ask(signal.SIGINT, 130)

    def test_terminate(self):
        self.ask(signal.SIGTERM, 143)


class AtTheWorstMoment(EndToEnd):
    """The launcher sends itself the signal in the middle of something."""

    def ask(self, number, trap):
        """Exit code of a launcher with `trap` in it, a few lines of Python that have `strike()` called."""
        environment = os.environ | {"FSI_BIN": str(BIN), "XDG_RUNTIME_DIR": str(self.folder), "PYTHONPATH": str(ROOT / "launch")}
        script = "\n".join(("import os, sys", "from fsi_launch import run", "from fsi_launch.command import cli", "from fsi_launch.living import registry",
                            f"strike = lambda: os.kill(os.getpid(), {int(number)})", trap, "sys.exit(cli.main(sys.argv[1:]))"))
        return subprocess.run(["/usr/bin/python3", "-c", script, "run", *LONG, "--out", "run"], cwd=self.folder,
                              env=environment, capture_output=True, check=False, timeout=WATCHDOG)

    def assert_ended(self, ended, code):
        self.assertEqual(ended.returncode, code, ended.stderr)
        self.assertEqual([path.name for path in self.folder.glob("amp-fsi/*.json")], [])
        self.assertEqual(processes.programs_of(self.folder / "run"), [])

    def test_while_the_entry_of_the_run_is_written(self):
        trap = """
write = registry.json.dumps
def dumps(content):
    strike()
    return write(content)
registry.json.dumps = dumps
enter = registry.Entry.__enter__
def entered(entry):
    result = enter(entry)
    strike()
    return result
registry.Entry.__enter__ = entered
"""
        for number, code in ((signal.SIGINT, 130), (signal.SIGTERM, 143)):
            self.assert_ended(self.ask(number, trap), code)
            shutil.rmtree(self.folder / "run")

    def test_where_exceptions_get_lost(self):
        trap = """
class Destroyed:
    def __del__(self):
        strike()
prepare = run._programs
def programs(*arguments):
    Destroyed()
    return prepare(*arguments)
run._programs = programs
"""
        for number, code in ((signal.SIGINT, 130), (signal.SIGTERM, 143)):
            ended = self.ask(number, trap)
            self.assertIn(b"Exception ignored", ended.stderr)
            self.assert_ended(ended, code)
            shutil.rmtree(self.folder / "run")


class Stopping(EndToEnd):
    def ask(self, number, code):
        run = self.launch(*LONG, script=PATIENT)
        run.until_stepping()
        run.process.send_signal(number)
        self.assertEqual(run.wait(), code, run.stderr)
        self.assertEqual(run.summary()["status"], "failed")
        self.assertGreater(run.summary()["steps"], 0)
        for name in ("fluid", "solid", "coupler"):
            self.assertEqual(run.part(name)["exit_code"], 143)
        self.assert_nothing_left(run)

    def test_interrupt(self):
        self.ask(signal.SIGINT, 130)

    def test_terminate(self):
        self.ask(signal.SIGTERM, 143)

    def test_asked_again_programs_are_killed_and_the_summary_says_how_far_they_were(self):
        run = self.launch(*LONG, script=PATIENT + "supervise.ASKED_AGAIN = 0\n")
        run.until_stepping()
        ask_twice(run.process.pid)
        self.assertIn(run.wait(), (130, 143), run.stderr)
        self.assertEqual(run.summary()["participants"]["coupler"]["status"], "lost")
        steps, t = run.table()[-1].split(",")[:2]
        self.assertGreaterEqual(run.summary()["steps"], int(steps))
        self.assertGreaterEqual(run.summary()["t"], float(t))
        self.assertGreater(run.summary()["steps"], 0)
        self.assert_nothing_left(run)

    def test_killed_launcher_leaves_no_program(self):
        run = self.launch(*LONG)
        programs = run.until_stepping()
        self.assertEqual(len(programs), 3)
        run.process.kill()
        self.assertEqual(run.wait(), -signal.SIGKILL)
        self.assertTrue(until(lambda: not run.programs()), run.programs())
        self.assertTrue(run.checkpoints(), "the programs ended without a checkpoint")

    def test_stopped_and_continued_launcher_does_not_disturb_the_run(self):
        run = self.launch(*LONG)
        run.until_stepping()
        os.kill(run.process.pid, signal.SIGSTOP)
        run.until_further(100_000)
        os.kill(run.process.pid, signal.SIGCONT)
        run.ctl("stop")
        self.assertEqual(run.wait(), 0, run.stderr)
        self.assertEqual(run.summary()["status"], "stopped")


class Checkpointing(EndToEnd):
    """SIGTERM leaves a checkpoint of the step after the last one counted, whatever the run is doing."""

    def terminate(self, *options, begin=lambda run: run.until_stepping(), target=None):
        run = self.launch(*LONG, *options, out=target or "run", script=PATIENT)
        begin(run)
        os.kill(run.process.pid if target is None else run.programs()[target], signal.SIGTERM)
        code = run.wait()
        self.assertEqual(run.checkpoints()[-1:], [run.summary()["steps"] + 1], run.stderr)
        return run, code

    def assert_terminated(self, *options, **how):
        self.assertEqual(self.terminate(*options, **how)[1], 143)

    def test_between_checkpoints(self):
        self.assert_terminated()

    def test_asked_twice_at_once(self):
        """As `timeout` does, which signals the launcher and then the group of processes it belongs to."""
        run = self.launch(*LONG, script=PATIENT)
        run.until_stepping()
        ask_twice(run.process.pid)
        self.assertIn(run.wait(), (130, 143), run.stderr)
        self.assertEqual(run.checkpoints()[-1:], [run.summary()["steps"] + 1], run.stderr)

    def test_in_the_first_step(self):
        self.assert_terminated("--pause-at", "0", begin=lambda run: run.until_paused())

    def test_while_it_is_paused(self):
        self.assert_terminated("--pause-at", "7", begin=lambda run: run.until_paused())

    def test_during_a_checkpoint(self):
        self.assert_terminated("--set", "output.checkpoint_every=1")

    def test_during_output(self):
        self.assert_terminated("--set", "time.end=1e-2", "--set", "output.times=[1e-2]", "--set", "output.every=1e-7")

    def test_of_one_program_only(self):
        for program in ("fluid_solver", "solid_solver_linear_elastic", "coupler"):
            run, code = self.terminate(target=program)
            self.assertEqual(code, 4, run.stderr)
            self.assertIn(f"ended on request (SIGTERM{'' if program == 'coupler' else ' to ' + program.split('_')[0]}), after a",
                          run.summary()["reason"])

    def test_of_a_lone_solver(self):
        run = self.launch("sod_tube", "--set", "time.dt=1e-7", "--set", "expect={}", "--pause-at", "5", script=PATIENT)
        run.speaker = "fluid"
        run.until_paused()
        run.process.send_signal(signal.SIGTERM)
        self.assertEqual(run.wait(), 143, run.stderr)
        self.assertEqual(run.checkpoints(), [run.summary()["steps"]])

    def test_before_the_first_step_there_is_nothing_to_keep(self):
        """The solid never joins."""
        solid = self.folder / "solid.sh"
        solid.write_text("#!/bin/sh\nwhile :; do sleep 1; done\n", encoding="utf-8")
        solid.chmod(0o755)
        run = self.launch("spring_piston", "--set", f"solids.piston.program={solid}", script=PATIENT)
        self.assertTrue(until(lambda: len(run.programs()) == 3))
        run.process.send_signal(signal.SIGTERM)
        self.assertEqual(run.wait(), 143, run.stderr)
        self.assertEqual(run.checkpoints(), [])
        self.assertNotIn("--restart", run.stderr)
        self.assert_nothing_left(run)


class Unwatched(EndToEnd):
    """Nobody reads any more what the launcher says: that decides nothing."""

    OFTEN = "from fsi_launch.living import progress\nprogress.LINE_EVERY = 0\n"
    SHORT = ("elastic_piston", "--set", "grid.factor=2", "--set", "expect={}")

    def assert_completed(self, run):
        self.assertEqual(run.wait(), 0, run.stderr)
        self.assertEqual(run.summary()["status"], "completed")
        self.assert_nothing_left(run)

    def test_pipes_whose_reader_is_gone(self):
        run = self.launch(*self.SHORT, "--pause-at", "3", script=self.OFTEN)
        run.until_paused()
        run.process.stderr.close()
        run.process.stdout.close()
        run.ctl("resume")
        self.assert_completed(run)

    def test_full_disks(self):
        for full in ("2>/dev/full", ">/dev/full 2>&1"):
            self.before = ("sh", "-c", f'exec "$@" {full}', "sh")
            self.assert_completed(self.launch(*self.SHORT, "--overwrite", script=self.OFTEN))

    def test_failure_that_cannot_be_told(self):
        self.before = ("sh", "-c", 'exec "$@" 2>/dev/full', "sh")
        self.assertEqual(self.launch("no_such_case").wait(), 2)
        self.assertEqual(self.launch("no_such_case", script="").wait(), 2)

    def test_closed_terminal_ends_the_run_after_a_checkpoint(self):
        terminal, other = os.openpty()
        self.before = ("sh", "-c", f'exec setsid --ctty "$@" <{os.ttyname(other)} 2>&0', "sh")
        run = self.launch(*LONG, script=PATIENT)
        os.close(other)
        run.until_stepping()
        os.close(terminal)
        self.assertEqual(run.wait(), 143, run.stderr)
        self.assertEqual(run.summary()["reason"], "ended on request (SIGHUP)")
        self.assertEqual(run.checkpoints()[-1:], [run.summary()["steps"] + 1])
        self.before = ()
        again = self.launch("--restart", str(run.directory), "--pause-at", str(run.checkpoints()[-1] + 3), out=None)
        again.directory = run.directory
        again.until_paused()
        again.ctl("stop")
        self.assertEqual(again.wait(), 0, again.stderr)


if __name__ == "__main__":
    unittest.main()
