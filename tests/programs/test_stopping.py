#!/usr/bin/python3
"""A run that is asked to end does so at once and in order, and leaves nothing behind, whatever way it is asked."""

import os
import shutil
import signal
import subprocess
import time
import unittest

from running import BIN, EndToEnd, ROOT, WATCHDOG, processes, until
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


class AtTheWorstMoment(EndToEnd):
    """The launcher sends itself the signal in the middle of something."""

    def ask(self, number, trap):
        """Exit code of a launcher with `trap` in it, a few lines of Python that have `strike()` called."""
        environment = os.environ | {"FSI_BIN": str(BIN), "XDG_RUNTIME_DIR": str(self.folder), "PYTHONPATH": str(ROOT / "launch")}
        script = "\n".join(("import os, sys", "from fsi_launch import cli, registry, run",
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
