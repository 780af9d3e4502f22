#!/usr/bin/python3
"""The wire is described well enough for a program in another language: the spring piston in plain C (examples/spring_piston_c), built with
a C compiler and idlc alone, takes the place of the C++ one."""

import csv
import os
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from running import EndToEnd, PATIENT, ROOT, until  # noqa: E402

SMALL = ("--set", "grid.factor=2", "--set", "expect={}")
# Steps so small that the run is in its middle whenever something is done to it.
LONG = ("--set", "grid.factor=2", "--set", "time.dt=1e-7", "--set", "output.times=[1e-6, 2.5]", "--set", "expect={}")
DATA = ("{mass: 0.25 * density_ratio, stiffness: 0.25 * stiffness, damping: 0.25 * damping, push: 0.25 * push, face: 0, bottom: 0, "
        "top: 0.25, thickness: 1}")
ROUND_OFF = 1e-13   # in parts of the largest number of a column


def lacking():
    """Which tool this machine does not have."""
    compiler = (os.environ.get("CC") or "cc").split()[0]
    return next((tool for tool in (compiler, "idlc") if shutil.which(tool) is None), None)


def compiled(folder):
    """Path of the program."""
    prefix = Path(shutil.which("idlc")).resolve().parents[1]
    sources = sorted(str(path) for path in (ROOT / "examples" / "spring_piston_c").glob("*.c"))
    for command in (["idlc", ROOT / "idl" / "amp_fsi.idl"],
                    [*(os.environ.get("CC") or "cc").split(), "-std=c11", "-O2", "-I", ".", "-I", prefix / "include", "-o", "piston", *sources,
                     "amp_fsi.c", "-L", prefix / "lib", f"-Wl,-rpath,{prefix}/lib", "-lddsc", "-lm"]):
        subprocess.run(command, cwd=folder, stdin=subprocess.DEVNULL, check=True)
    return Path(folder) / "piston"


def columns(run):
    """{heading: numbers} of the piston's table."""
    with (run.directory / "forces_piston.csv").open(encoding="utf-8", newline="") as file:
        heading, *rows = csv.reader(file)
    return {title: [float(row[k]) for row in rows] for k, title in enumerate(heading)}


class ThePage(unittest.TestCase):
    def test_says_what_is_in_each_array_that_a_solid_alone_sends(self):
        idl = (ROOT / "idl" / "amp_fsi.idl").read_text(encoding="utf-8")
        page = (ROOT / "docs" / "bring_your_own_solid.md").read_text(encoding="utf-8")
        state = re.search(r"struct PredictedInterface \{(.*?)\n\};", idl, re.DOTALL).group(1)
        names = re.findall(r"(\w+);\s*// solid\b", state)
        self.assertIn("Z", names)
        for name in names:
            self.assertIn(f"`{name}`", page)


@unittest.skipIf(lacking(), f"this machine has no {lacking()}")
class SpringPistonInC(EndToEnd):
    @classmethod
    def setUpClass(cls):
        scratch = tempfile.TemporaryDirectory(prefix="fsi-wire-")
        cls.addClassCleanup(scratch.cleanup)
        cls.program = compiled(scratch.name)

    def in_c(self):
        return ("--set", f"solids.piston.program={self.program}", "--set", f"solids.piston.data={DATA}")

    def said(self, run):
        return (run.directory / "log" / "piston.out").read_text(encoding="utf-8")

    def assert_same_motion(self, one, other):
        one, other = columns(one), columns(other)
        self.assertEqual(list(one), list(other))
        for title, numbers in one.items():
            scale = max(map(abs, numbers))
            self.assertEqual(len(numbers), len(other[title]))
            for a, b in zip(numbers, other[title]):
                self.assertLessEqual(abs(a - b), ROUND_OFF * scale, title)

    def test_moves_as_the_one_in_cpp_does_to_round_off_signed_encrypted_and_without_protection(self):
        cpp = self.complete("spring_piston", *SMALL, out="cpp")
        signed = self.complete("spring_piston", *SMALL, *self.in_c(), out="signed")
        self.assert_same_motion(cpp, signed)
        self.assertEqual(self.said(signed), "")
        table = (signed.directory / "forces_piston.csv").read_bytes()
        for protection in ("--no-security", "--encrypt"):
            other = self.complete("spring_piston", *SMALL, *self.in_c(), protection, out=protection[2:])
            self.assertEqual((other.directory / "forces_piston.csv").read_bytes(), table)

    def test_is_as_good_where_the_piston_is_a_thousand_times_lighter_than_the_gas(self):
        light = ("--set", "parameters.density_ratio=1e-3")
        self.assert_same_motion(self.complete("spring_piston", *SMALL, *light, out="cpp"),
                                self.complete("spring_piston", *SMALL, *light, *self.in_c(), out="c"))

    def test_ends_well_when_the_run_is_asked_to_stop(self):
        run = self.launch("spring_piston", *LONG, *self.in_c())
        run.until_stepping()
        run.ctl("stop")
        self.assertEqual(run.wait(), 0, run.stderr)
        self.assertEqual(run.summary()["status"], "stopped")
        self.assertEqual(self.said(run), "")
        self.assert_nothing_left(run)

    def test_ends_with_the_others_when_the_run_is_terminated(self):
        run = self.launch("spring_piston", *LONG, *self.in_c())
        run.until_stepping()
        run.process.send_signal(signal.SIGTERM)
        self.assertNotEqual(run.wait(), 0)
        # Of the launcher's signals to all programs the gas may have heard its own first, and told the coupler.
        self.assertRegex(self.said(run), r"coupler ended the run: ended on request \(SIGTERM( to fluid)?\)")
        self.assertGreater(len(run.checkpoints()), 0)
        self.assert_nothing_left(run)

    def test_ends_by_itself_and_says_why_when_the_coupler_dies(self):
        run = self.launch("spring_piston", *LONG, *self.in_c(), script=PATIENT)
        programs = run.until_stepping()
        coupler, gas = programs["coupler"], programs["fluid_solver"]
        os.kill(gas, signal.SIGSTOP)  # else it may be the first to notice, and say so; the launcher ends who is stopped
        os.kill(coupler, signal.SIGKILL)
        self.assertTrue(until(lambda: f"piston: the coupler (pid {coupler}) has died" in self.said(run)), self.said(run))
        self.assertEqual(run.wait(), 4)
        self.assert_nothing_left(run)

    def test_hears_why_the_run_is_over_when_another_program_dies(self):
        run = self.launch("spring_piston", *LONG, *self.in_c(), script=PATIENT)
        gas = run.until_stepping()["fluid_solver"]
        os.kill(gas, signal.SIGKILL)
        self.assertEqual(run.wait(), 4)
        self.assertIn(f"piston: coupler ended the run: fluid (pid {gas}) has died", self.said(run))
        self.assert_nothing_left(run)

    def killed_after_a_checkpoint(self, program):
        """A run that ended when this program was killed, and left the set of step 20: so early that less than one of the C library's buffers is in the table."""
        run = self.launch("spring_piston", *SMALL, *self.in_c(), "--set", "output.checkpoint_every=10", "--pause-at", "25")
        programs = run.until_paused()
        self.assertTrue(until(lambda: 20 in run.checkpoints()))
        os.kill(programs[program], signal.SIGKILL)
        self.assertEqual(run.wait(), 4)
        return run

    def test_goes_on_bit_for_bit_from_a_checkpoint(self):
        whole = self.complete("spring_piston", *SMALL, *self.in_c(), out="whole")
        for program in ("coupler", self.program.name):
            run = self.killed_after_a_checkpoint(program)
            again = self.launch("--restart", str(run.directory), out=None)
            self.assertEqual(again.wait(), 0, again.stderr)
            for name in ("forces_piston.csv", "interface.csv"):
                self.assertEqual((run.directory / name).read_bytes(), (whole.directory / name).read_bytes(), (program, name))
            shutil.rmtree(run.directory)

    def test_does_not_go_on_with_a_table_that_lacks_lines_from_before_the_checkpoint(self):
        run = self.killed_after_a_checkpoint(self.program.name)
        table = run.directory / "forces_piston.csv"
        table.write_bytes(table.read_bytes()[:1000])
        again = self.launch("--restart", str(run.directory), out=None)
        self.assertEqual(again.wait(), 5, again.stderr)
        self.assertRegex(self.said(run), r"forces_piston\.csv has 1000 bytes, .* had \d+; put the whole table back")
        self.assertEqual(table.stat().st_size, 1000)


if __name__ == "__main__":
    unittest.main()
