#!/usr/bin/python3
"""A run on two machines: the same files to the bit as on one, also after a restart and with ranks on the other machine; it is steered as
any other; and when a program, the connection or the network between them is lost, all end, and what was lost is named."""

import os
import signal
import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from comparing import Comparing  # noqa: E402
from running import LONG, until  # noqa: E402
from test_ranks import MISSING  # noqa: E402
from two_machines import Machines, NAME  # noqa: E402

SHORT = ("elastic_piston", "--set", "grid.factor=2", "--set", "time.end=0.3", "--set", "output.times=[0.1, 0.3]", "--set",
         "output.checkpoint_every=10", "--set", "expect={}")


class OnTwoMachines(Comparing):
    @classmethod
    def setUpClass(cls):
        cls.machines = Machines()
        cls.addClassCleanup(cls.machines.remove)
        if cls.machines.reason:
            raise unittest.SkipTest(cls.machines.reason)
        cls.before = cls.machines.words_here()

    def launch(self, *arguments, out="run", script=None, there=("fluid",)):
        """`there`: participants on the other machine."""
        hosts = ",".join(f"{name}={self.machines.there}" for name in there)
        return super().launch(*arguments, *(("--hosts", hosts, "--remote-shell", self.machines.shell()) if there else ()), out=out,
                              script=script)

    def finished(self, *arguments, **options):
        run = self.launch(*arguments, **options)
        self.assertEqual(run.wait(), 0, run.stderr)
        self.assert_nothing_left(run)
        return run


class Bits(OnTwoMachines):
    def test_each_program_there(self):
        whole = self.finished(*SHORT, there=(), out="here")
        for number, there in enumerate((("fluid",), ("solid",), ("fluid", "solid"))):
            run = self.finished(*SHORT, there=there, out=f"there{number}")
            self.assert_same(whole, run)

    def test_restart_on_other_machines(self):
        whole = self.finished(*SHORT, there=(), out="here")
        first = self.launch(*SHORT, "--pause-at", "5", out="first")
        first.until_paused()
        first.ctl("stop")
        self.assertEqual(first.wait(), 0, first.stderr)
        self.assertEqual(first.summary()["status"], "stopped")
        again = self.launch("--restart", str(first.directory), out=None, there=("solid",))
        again.directory = first.directory
        self.assertEqual(again.wait(), 0, again.stderr)
        self.assert_same(whole, again)

    @unittest.skipIf(MISSING, f"no Open MPI: {', '.join(MISSING)} is missing")
    def test_ranks_there(self):
        whole = self.finished(*SHORT, there=(), out="here")
        self.assert_same(whole, self.finished(*SHORT, "--ranks", "fluid=2", out="there"))


class Secrets(OnTwoMachines):
    def test_key_is_on_no_command_line(self):
        run = self.launch(*LONG)
        run.until_stepping()
        entry = next(run.runtime.rglob("*.json")).read_text(encoding="utf-8")
        key = entry.split('"key": "')[1].split('"')[0]
        self.assertTrue(key.startswith("encrypt:"), "what goes over a network is encrypted")
        self.assertNotIn(key, " ".join(words for _, words in command_lines()))
        run.process.send_signal(signal.SIGTERM)
        self.assertEqual(run.wait(), 143, run.stderr)


class Faults(OnTwoMachines):
    def running(self, *arguments, there=("fluid",)):
        run = self.launch(*LONG, *arguments, there=there)
        programs = run.until_stepping()
        self.assertIn("fluid_solver", programs)
        return run, programs

    def assert_lost(self, run, *words):
        self.assertEqual(run.wait(), 4, run.stderr)
        for word in words:
            self.assertIn(word, run.summary()["reason"])
        self.assert_nothing_left(run)

    def test_killed_program_there(self):
        run, programs = self.running()
        os.kill(programs["fluid_solver"], signal.SIGKILL)
        self.assert_lost(run, "lost fluid (fluid_solver): ended by SIGKILL")

    def test_killed_program_here(self):
        run, programs = self.running()
        os.kill(programs["solid_solver_linear_elastic"], signal.SIGKILL)
        self.assert_lost(run, "lost solid (solid_solver_linear_elastic): ended by SIGKILL")

    def test_stopped_program_there(self):
        run, programs = self.running()
        os.kill(programs["fluid_solver"], signal.SIGSTOP)
        self.assert_lost(run, "fluid (pid ", f" on {NAME}) has been silent for 4 s (time.peer_timeout)")

    def test_killed_connection(self):
        run, _ = self.running()
        shell = next(pid for pid, words in command_lines() if "two_machines.py" in words and "far.py run" in words and "sh -c" not in words)
        os.kill(shell, signal.SIGKILL)
        self.assert_lost(run, "lost fluid (fluid_solver): the connection to", "ended before it did")

    def test_end_on_request_leaves_a_checkpoint(self):
        run, _ = self.running()
        run.process.send_signal(signal.SIGTERM)
        self.assertEqual(run.wait(), 143, run.stderr)
        self.assertEqual(len(run.checkpoints()), 1)
        self.assert_nothing_left(run)

    def test_killed_launcher_leaves_a_checkpoint(self):
        run, _ = self.running()
        run.process.kill()
        run.wait()
        self.assertTrue(until(lambda: not run.programs()), run.programs())
        self.assertEqual(len(run.checkpoints()), 1)


class Cut(OnTwoMachines):
    """The last test of these machines: their cable is cut."""

    def test_cut_network(self):
        run = self.launch(*LONG)
        run.until_stepping()
        self.machines.cut()
        self.assertEqual(run.wait(), 4, run.stderr)
        reason = run.summary()["reason"]
        self.assertRegex(reason, rf"fluid \(pid \d+ on {NAME}\) has been silent for 4 s \(time.peer_timeout\); is it stopped, or {NAME} "
                                 "switched off, or the network to it cut\\?")
        self.assert_nothing_left(run)   # nor on the machine that nobody reaches any more
        self.assertRegex(run.part("fluid")["reason"], r"coupler \(pid \d+ on .+\) has been silent for 4 s")


class Refusals(OnTwoMachines):
    def refused(self, *arguments, hosts=None, shell=None):
        run = super().launch(*arguments, *(("--hosts", hosts) if hosts else ()), "--remote-shell", shell or self.machines.shell(), there=())
        self.assertEqual(run.wait(), 2, run.stderr)
        self.assertFalse(run.directory.exists())
        return run.stderr

    def test_what_cannot_be(self):
        there = self.machines.there
        for arguments, hosts, words in (
                (SHORT, f"gas={there}", "no participant 'gas'; it has fluid, solid"),
                (SHORT, f"coupler={there}", "the coupler runs where the command is given"),
                (("sod_tube",), f"fluid={there}", "single program; start the run on that machine"),
                (SHORT, "fluid", "'' is no machine; write NAME=HOST"),
                (SHORT, "fluid=no.such.host.invalid", "no address of no.such.host.invalid is known here"),
                (SHORT, "fluid=localhost", "localhost is this machine itself (127.0.0.1)"),
                (SHORT, f"fluid={self.machines.here}", f"{self.machines.here} is this machine itself"),
                ((*SHORT, "--no-security"), f"fluid={there}", "is encrypted; leave --no-security away"),
                ((*SHORT, "--ranks", "auto"), f"fluid={there}", "counts the cores of this machine")):
            with self.subTest(hosts=hosts, arguments=arguments[1:]):
                self.assertIn(words, self.refused(*arguments, hosts=hosts))

    def test_machine_that_lets_nobody_in(self):
        said = self.refused(*SHORT, hosts=f"fluid={self.machines.there}", shell="false")
        self.assertIn(f"nothing can be started on {self.machines.there}: exit code 1; it must be possible to log in", said)

    def test_machine_with_other_files(self):
        other = self.folder / "shell"
        other.write_text(f"#!/bin/sh\nhost=$1; shift\nexec {self.machines.shell()} $host \"unshare --mount sh -c 'mount -t tmpfs none "
                         f"{self.folder}; $*'\"\n", encoding="utf-8")
        other.chmod(0o755)
        self.assertIn("must lie on a file system that all machines see", self.refused(*SHORT, hosts=f"fluid={self.machines.there}",
                                                                                   shell=str(other)))


def command_lines():
    """(pid, words) of all processes."""
    for path in Path("/proc").glob("[0-9]*/cmdline"):
        try:
            yield int(path.parent.name), path.read_bytes().replace(b"\0", b" ").decode("utf-8", "replace")
        except OSError:
            continue


if __name__ == "__main__":
    unittest.main()
