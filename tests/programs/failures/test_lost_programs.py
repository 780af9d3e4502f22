#!/usr/bin/python3
"""Any program of a run may be killed or stopped at any moment: the others notice, end by themselves, and it is named."""

import os
import signal
import subprocess
import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from running import BIN, EndToEnd, FSI, LONG, PATIENT, processes, until  # noqa: E402

PARTICIPANTS = {"fluid_solver": "fluid", "solid_solver_linear_elastic": "solid", "coupler": "coupler"}

# A solid alone, computed by somebody else's program.
ALONE = """
time: {end: 0.2}
grid: {factor: 1}
solids:
  b: {law: external, program: /bin/true, rho: 2, lambda: 3, mu: 2, grid: {x: [0, 2], y: [0, 1], spacing: h},
      boundary: {left: free, right: free, bottom: free, top: free}}
"""


class LostPrograms(EndToEnd):
    def lose(self, program, number=signal.SIGKILL):
        """The run whose program got a signal. Its launcher ends nobody who has not ended by himself."""
        run = self.launch(*LONG, script=PATIENT)
        os.kill(run.until_stepping()[program], number)
        self.assertEqual(run.wait(), 4, run.stderr)
        participant = PARTICIPANTS[program]
        self.assertIn(participant, run.summary()["reason"])
        self.assertEqual(run.summary()["status"], "failed")
        for name in PARTICIPANTS.values():
            if name != participant:
                self.assertEqual(run.part(name)["exit_code"], 4)
        self.assert_output_opens(run)
        self.assert_nothing_left(run)
        return run

    def test_program_that_ends_well_and_has_computed_nothing_is_lost(self):
        case = self.folder / "alone.yaml"
        case.write_text(ALONE, encoding="utf-8")
        run = self.launch(case)
        self.assertEqual(run.wait(), 4, run.stderr)
        self.assertIn("lost b: it ended without a word, and left no report", run.stderr)
        self.assertEqual((run.summary()["status"], run.summary()["failure"]["origin"]), ("failed", "b"))

    def kill(self, program):
        run = self.lose(program)
        self.assertIn(f"lost {PARTICIPANTS[program]}", run.stderr)
        failure = run.summary()["failure"]
        self.assertEqual((failure["origin"], failure["signal"]), (PARTICIPANTS[program], "SIGKILL"))

    def assert_output_opens(self, run):
        import h5py
        for name in ("fluid.h5", "solid_solid.h5"):
            with h5py.File(run.directory / name) as file:
                self.assertGreaterEqual(len(file), 1)
                for output in file.values():
                    self.assertIn("t", output.attrs)
        lines = run.table()
        self.assertTrue(all(line.count(",") == lines[0].count(",") for line in lines))

    def test_fluid(self):
        self.kill("fluid_solver")

    def test_solid(self):
        self.kill("solid_solver_linear_elastic")

    def test_coupler(self):
        self.kill("coupler")

    def stop(self, program):
        """The launcher tells what those say who missed it, not that it had to kill it."""
        run = self.lose(program, signal.SIGSTOP)
        self.assertRegex(run.summary()["reason"], r"silent for 4 s \(time\.peer_timeout\); is it stopped\?")
        self.assertNotIn("did not end by itself", run.stderr)

    def test_stopped_fluid(self):
        self.stop("fluid_solver")

    def test_stopped_solid(self):
        self.stop("solid_solver_linear_elastic")

    def test_stopped_coupler(self):
        self.stop("coupler")


class LostStudy(EndToEnd):
    def test_the_runs_of_a_study_that_is_killed_end_too(self):
        runs = [self.folder / "study" / f"density_ratio={value}" for value in (1, 2)]

        def living():
            return [[program.pid for program in processes.programs_of(run)] for run in runs]

        self.addCleanup(lambda: [processes.signal_to(pid, signal.SIGKILL) for pids in living() for pid in pids])
        command = [FSI, "study", *LONG, "--vary", "parameters.density_ratio=1,2", "--jobs", "2", "--out", runs[0].parent]
        with subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, cwd=self.folder,
                              env=os.environ | {"FSI_BIN": str(BIN), "XDG_RUNTIME_DIR": str(self.folder)}) as study:
            self.assertTrue(until(lambda: [len(pids) for pids in living()] == [len(PARTICIPANTS)] * 2))
            study.kill()
        self.assertTrue(until(lambda: living() == [[], []]))


class Joining(EndToEnd):
    """A program of somebody else's that does not join the run. Nobody but what is tested has a limit of time."""

    ENDLESS = "from fsi_launch.living import supervise\nsupervise.GRACE = supervise.LAST_GRACE = 1e6\n"

    def run_with(self, program, *options, code=4):
        """The summary of a run whose solid is this script."""
        solid = self.folder / "solid.sh"
        solid.write_text(f"#!/bin/sh\n{program}\n", encoding="utf-8")
        solid.chmod(0o755)
        run = self.launch("spring_piston", "--set", f"solids.piston.program={solid}", *options, script=self.ENDLESS)
        self.assertEqual(run.wait(), code, run.stderr)
        self.assert_nothing_left(run)
        return run.summary()

    def test_one_that_ends_at_once_ends_the_run_at_once_with_its_words(self):
        patient = ("--set", "time.join_timeout=86400", "--overwrite")
        summary = self.run_with("echo no licence; exit 0", *patient)
        self.assertRegex(summary["reason"], r"lost piston .*ended before the run began, with exit code 0; its last words: no licence")
        summary = self.run_with("echo no licence; exit 1", *patient, code=1)
        self.assertEqual(summary["reason"], "piston: no licence")

    def test_one_that_does_nothing_is_missing_after_the_limit_of_the_case(self):
        summary = self.run_with("exec sleep 1000000", "--set", "time.join_timeout=2")
        self.assertRegex(summary["reason"], r"after \S+ s \(time\.join_timeout\) solid 'piston' did not join; fluid did")
        self.assertEqual(summary["failure"]["origin"], "coupler")


if __name__ == "__main__":
    unittest.main()
