#!/usr/bin/python3
"""A run goes on from its checkpoint as if it had never ended: all its files are the same to the bit."""

import datetime
import fcntl
import json
import os
import re
import shutil
import signal
import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from comparing import Comparing, health, results  # noqa: E402
from running import BIN, EndToEnd, LONG, until  # noqa: E402

CASES = {  # with the number of steps between checkpoints
    "elastic_piston": (10, "--set", "grid.factor=2", "--set", "output.every=0.1",
                       "--set", "output.probes=[{name: a, in: fluid, x: 0.5, y: 0.05}, {name: b, in: solid, x: 0, y: 0}]"),
    "rotating_disk": (4, "--set", "grid.factor=1", "--set", "time.end=0.2", "--set", "output.times=[0.1, 0.2]",
                      "--set", "reference.points=400"),
    "shock_ellipse": (25, "--set", "grid.factor=4", "--set", "time.end=0.5", "--set", "output.times=[0, 0.3, 0.5]"),
    "rigid_piston": (10, "--set", "time.end=0.4", "--set", "output.times=[0.2, 0.4]"),
    "flapping_foil": (40, "--set", "grid.factor=1", "--set", "time.end=0.5", "--set", "output={times: [0.3, 0.5]}",
                      "--set", "solids.foil.motion={rotation: 0.2 * sin(3 * t)}", "--set", "solids.foil.degrees_of_freedom=[y]",
                      "--set", "solids.foil.spring={y: 1}"),
    "sprung_foil": (40, "--set", "grid.factor=1", "--set", "time.end=1", "--set", "output={times: [0.6, 1]}"),
    "manufactured_piston": (6, "--set", "grid.factor=1"),
    "sod_tube": (10, "--set", "grid.factor=2"),
    "spring_piston": (20, "--set", "grid.factor=2"),
    "plate": (10, "--set", "time.end=0.5", "--set", "output.times=[0.3, 0.5]", "--set", "parameters.size=0.1",
              "--set", "solids.plate.beam.ends=[clamped, pinned]"),
    "piston_between_gases": (10, "--set", "grid.factor=4", "--set", "time.end=0.5", "--set", "output.times=[0.2, 0.5]",
                             "--set", "output.probes=[{name: a, in: left, x: -0.5, y: 0.05}, {name: b, in: right, x: 1, y: 0}]"),
    "taylor_plate": (10, "--set", "grid.factor=4", "--set", "time.end=0.5", "--set", "output.times=[0.2, 0.5]",
                     "--set", "parameters.size=0.1", "--set", "parameters.mass=1e-3"),
    # worst cells in the middle of the run, rectangles at its end
    "free_stream": (4, "--set", "time.end=0.5", "--set", "time.dt=0.02", "--set", "output.times=[0.5]", "--set",
                    "fluid.grid={kind: mapped, points: [11, 11], map: [r + 0.4 * s * sin(2 * pi * t), s]}"),
}


class Restarting(Comparing):
    def case(self, name, *more):
        every, *options = CASES[name]
        return (name, *options, "--set", f"output.checkpoint_every={every}", "--set", "expect={}", *more)

    def again(self, whole, folder="again"):
        """A copy of a finished run, which goes on from its last checkpoint."""
        shutil.copytree(whole.directory, self.folder / folder)
        run = self.launch("--restart", str(self.folder / folder), out=None)
        run.directory = self.folder / folder
        return run

    def assert_goes_on(self, name, *more):
        whole = self.complete(*self.case(name, *more))
        kept = sorted(path.name for path in (whole.directory / "checkpoints").iterdir())
        self.assertEqual(len(kept), 2)
        run = self.again(whole)
        self.assertEqual(run.wait(), 0, run.stderr)
        self.assertIn(f"goes on from the checkpoint of step {int(kept[-1])}", run.stderr)
        self.assert_same(whole, run)
        return whole


class Restart(Restarting):
    def test_piston(self):
        self.assert_goes_on("elastic_piston", "--solid", "solid=neo_hookean")

    def test_substeps(self):
        self.assert_goes_on("elastic_piston", "--set", "time.multirate=true", "--set", "parameters.density_ratio=1e-3")

    def test_disk(self):
        self.assert_goes_on("rotating_disk")

    def test_ellipse_whose_grid_moves_over_the_background(self):
        self.assert_goes_on("shock_ellipse")

    def test_background_of_levels_that_follow_shock_and_ellipse(self):
        self.assert_goes_on("shock_ellipse", "--set", "fluid.grid.levels=3")

    def test_rigid_ellipse(self):
        self.assert_goes_on("shock_ellipse", "--solid", "ellipse=rigid")

    def test_rigid_piston(self):
        self.assert_goes_on("rigid_piston")

    def test_foil_on_springs(self):
        self.assert_goes_on("sprung_foil")

    def test_foil_whose_rotation_is_given(self):
        self.assert_goes_on("flapping_foil")

    def test_sources_of_a_chosen_solution(self):
        self.assert_goes_on("manufactured_piston")

    def test_gas_alone(self):
        self.assert_goes_on("sod_tube")

    def test_program_of_somebody_elses(self):
        self.assert_goes_on("spring_piston")

    def test_piston_between_two_gases(self):
        self.assert_goes_on("piston_between_gases")

    def test_beam_between_two_gases(self):
        self.assert_goes_on("taylor_plate")

    def test_beam(self):
        self.assert_goes_on("plate")

    def test_worst_cells_of_a_moving_grid_are_those_of_the_whole_run(self):
        whole = self.assert_goes_on("free_stream")
        self.assertLess(health(whole.directory)["fluid"]["min_cell_quality"], 0.95)


class Interrupted(Restarting):
    """The same, where the run did end: by a signal, a request or a kill, after 250 steps and checkpoints of steps 100 and 200."""

    NAME = "elastic_piston"
    STEPS = ("--set", "time.dt=1e-3", "--set", "output.checkpoint_every=100")

    def begin(self, *more):
        run = self.launch(*self.case(self.NAME, *self.STEPS, "--pause-at", "250", *more))
        run.until_paused()
        return run

    def restart(self, run, *more):
        again = self.launch("--restart", str(run.directory), *more, out=None)
        again.directory = run.directory
        return again

    def assert_restarts(self, run):
        self.assertIn(f"--restart {run.directory}", run.stderr)
        again = self.restart(run)
        self.assertEqual(again.wait(), 0, again.stderr)
        whole = self.complete(*self.case(self.NAME, *self.STEPS), out="whole")
        self.assert_same(whole, again)

    def kill_and_restart(self, program):
        run = self.begin()
        self.assertEqual(run.checkpoints(), [100, 200])
        os.kill(run.programs()[program], signal.SIGKILL)
        self.assertEqual(run.wait(), 4, run.stderr)
        self.assert_restarts(run)

    def terminate_and_restart(self):
        run = self.begin("--set", "output.checkpoint_every=100000")
        run.process.send_signal(signal.SIGTERM)
        self.assertEqual(run.wait(), 143, run.stderr)
        self.assertEqual(run.checkpoints(), [run.summary()["steps"] + 1])
        self.assert_restarts(run)


class ProgramOfSomebodyElses(Interrupted):
    NAME = "spring_piston"
    STEPS = ("--set", "grid.factor=2", "--set", "time.dt=2.5e-3", "--set", "output.checkpoint_every=100")

    def test_killed_program(self):
        self.kill_and_restart("spring_piston")

    def test_killed_coupler(self):
        self.kill_and_restart("coupler")

    def test_sigterm_writes_a_checkpoint(self):
        self.terminate_and_restart()

    def test_program_may_lie_elsewhere_by_then(self):
        run = self.begin()
        run.process.send_signal(signal.SIGTERM)
        self.assertEqual(run.wait(), 143, run.stderr)
        moved = self.folder / "moved"
        shutil.copy2(BIN / "spring_piston", moved)
        again = self.restart(run, "--set", f"solids.piston.program={moved}")
        self.assertEqual(again.wait(), 0, again.stderr)


class Levels(Interrupted):
    NAME = "shock_ellipse"
    STEPS = ("--set", "grid.factor=2", "--set", "fluid.grid.levels=2", "--set", "time.dt=1e-3", "--set", "output.checkpoint_every=100")

    def test_killed_program(self):
        self.kill_and_restart("fluid_solver")


class AfterAnEnd(Interrupted):
    def test_killed_program(self):
        self.kill_and_restart("fluid_solver")

    def test_sigterm_writes_a_checkpoint(self):
        self.terminate_and_restart()

    def test_checkpoints_by_the_clock_are_written_once_each(self):
        """Ten of them take ten times their distance; two of successive steps each time would take half of it."""
        run = self.launch(*LONG, "--set", "output.checkpoint_seconds=0.5")
        found = []

        def moments():
            found[:] = re.findall(r"^(\S+ \S+) info checkpoint of step (\d+)", run.log("coupler"), re.MULTILINE)
            return len(found) >= 10
        self.assertTrue(until(moments))
        begun = (run.directory / "case.yaml").stat().st_mtime
        run.process.send_signal(signal.SIGTERM)
        self.assertEqual(run.wait(), 143, run.stderr)
        steps = [int(step) for _, step in found]
        self.assertEqual(steps, sorted(set(steps)))
        tenth = datetime.datetime.fromisoformat(found[9][0]).timestamp()  # both by the clock of the system
        self.assertGreaterEqual(tenth - begun, 10 * 0.5 - 0.01)

    def test_run_that_comes_to_its_end_although_it_was_asked_to_end_is_complete(self):
        """SIGTERM comes when the last step has been taken and its answer is on its way."""
        case = self.case("elastic_piston", "--set", "time.dt=1e-2", "--set", "output.times=[0.8]")
        steps = self.complete(*case, out="whole").summary()["steps"]
        run = self.launch(*case, "--pause-at", str(steps))
        run.until_paused()
        run.process.send_signal(signal.SIGTERM)
        self.assertEqual(run.wait(), 0, run.stderr)
        self.assertEqual((run.summary()["status"], run.summary()["steps"], run.summary()["t"]), ("completed", steps, 0.8))

    def killed(self):
        """A run that was killed; its sets are those of steps 100 and 200."""
        run = self.begin()
        for pid in run.programs().values():  # not the launcher: its death asks them to end after a checkpoint
            os.kill(pid, signal.SIGKILL)
        self.assertEqual(run.wait(), 4, run.stderr)
        self.assertEqual(run.checkpoints(), [100, 200])
        return run

    def damaged(self, damage, words):
        """The newest set is damaged by `damage(folder)`; the words say how, and the one before it is used."""
        run = self.killed()
        damage(run.directory / "checkpoints" / "00000200")
        again = self.restart(run)
        self.assertEqual(again.wait(), 0, again.stderr)
        self.assertIn(f"the checkpoint of step 200 {words}", again.stderr)
        self.assertIn("goes on from the checkpoint of step 100,", again.stderr)
        self.assertNotIn("Traceback", again.stderr)

    def test_damaged_checkpoint_is_not_used(self):
        def damage(folder):
            with open(folder / "fluid.h5", "r+b") as file:
                file.seek(5000)
                file.write(b"damage")
        self.damaged(damage, "is damaged: fluid.h5")

    def test_manifest_with_impossible_numbers_is_not_used(self):
        def damage(folder):
            manifest = folder / "manifest.json"
            manifest.write_text(manifest.read_text().replace('"step": 200', '"step": 1e400'))
        self.damaged(damage, "is damaged: in its manifest.json, step is inf")

    def test_set_of_another_case_is_not_used(self):
        def damage(folder):
            other = self.complete(*self.case("elastic_piston", *self.STEPS, "--set", "parameters.density_ratio=2"), out="other")
            shutil.rmtree(folder)
            shutil.copytree(other.directory / "checkpoints" / f"{other.checkpoints()[0]:08}", folder)
            manifest = json.loads((folder / "manifest.json").read_text())
            (folder / "manifest.json").write_text(json.dumps(manifest | {"step": 200}))
        self.damaged(damage, "is of another case")

    def test_emptied_output_of_the_series_that_goes_on_is_named(self):
        for name, kept in (("emptied", 0), ("cut", 3000)):
            run = self.launch(*self.case("elastic_piston", *self.STEPS, "--set", "output.every=0.1", "--pause-at", "250"), out=name)
            run.until_paused()
            run.process.send_signal(signal.SIGTERM)
            self.assertEqual(run.wait(), 143, run.stderr)
            output = run.directory / "fields" / "fluid_000001.h5"
            output.write_bytes(output.read_bytes()[:kept])
            again = self.restart(run)
            self.assertEqual(again.wait(), 5, again.stderr)
            self.assertRegex(again.stderr, r"fluid: '.*fields/fluid_000001\.h5' is damaged")
            self.assertEqual(again.summary()["status"], "failed")

    def test_another_case_is_refused_with_what_differs(self):
        run = self.begin()
        run.process.send_signal(signal.SIGINT)
        self.assertEqual(run.wait(), 130, run.stderr)
        again = self.restart(run, "--set", "time.cfl=0.5", "--set", "time.end=0.9")
        self.assertEqual(again.wait(), 2)
        self.assertIn("time.cfl: 0.5, was 0.9", again.stderr)
        self.assertNotIn("time.end", again.stderr.split(";")[0])
        longer = self.restart(run, "--set", "time.end=0.9")
        self.assertEqual(longer.wait(), 0, longer.stderr)
        self.assertEqual(longer.summary()["t"], 0.9)


class Refused(Interrupted):
    """A restart that takes no step leaves the record of the run as it was."""

    def record(self, run):
        return {path.relative_to(run.directory).as_posix(): path.read_bytes() for pattern in ("*.json", "*.yaml", "*.csv", "parts/*", ".former*")
                for path in run.directory.glob(pattern) if path.is_file() or path.name.startswith(".")}

    def completed(self):
        """A run that is complete, and its record."""
        run = self.complete(*self.case(self.NAME, "--set", "output.every=0.1"))
        return run, self.record(run)

    def assert_refused(self, run, record):
        """For want of an output."""
        (run.directory / "fields" / "fluid_000001.h5").unlink()
        again = self.restart(run, "--set", "time.end=0.9")
        self.assertEqual(again.wait(), 5, again.stderr)
        self.assertRegex(again.stderr, r"fsi: fluid: '.*fields/fluid_000001\.h5' ")
        self.assertNotIn("fsi run --restart", again.stderr)
        self.assertEqual(self.record(run), record)
        self.assertEqual(run.summary()["status"], "completed")

    def test_by_a_program(self):
        self.assert_refused(*self.completed())

    def test_what_would_end_or_pause_before_the_checkpoint_is_not_said_to_go_on(self):
        run, record = self.completed()
        for words, said in ((("--set", "time.end=0.01"), "lies before the checkpoint"), (("--pause-at", "1"), "write that or a later one")):
            again = self.restart(run, *words)
            self.assertEqual(again.wait(), 2, again.stderr)
            self.assertIn(said, again.stderr)
            self.assertNotIn("goes on from the checkpoint", again.stderr)
        self.assertEqual(self.record(run), record)

    def test_after_the_launcher_of_another_one_was_killed(self):
        run, record = self.completed()
        killed = self.restart(run, "--set", "time.end=0.9", "--pause-at", str(run.checkpoints()[-1]))
        killed.until_paused()
        killed.process.kill()
        killed.wait()
        self.assertTrue(until(lambda: not killed.programs()))
        self.assertFalse((run.directory / "summary.json").exists())
        self.assert_refused(run, record)

    def test_what_has_taken_a_step_counts(self):
        run, record = self.completed()
        step = run.checkpoints()[-1] + 2
        again = self.restart(run, "--set", "time.end=0.9", "--pause-at", str(step))
        again.until_paused()    # the launcher may not have been told of so few steps: it is, at the end
        again.process.send_signal(signal.SIGTERM)
        self.assertEqual(again.wait(), 143, again.stderr)
        self.assertEqual((again.summary()["status"], again.summary()["steps"]), ("failed", step))
        self.assertEqual(self.record(again).keys(), record.keys())


class Alone(Interrupted):
    """One command at a time works in a folder."""

    def lock(self, run):
        """Works in its folder, as another command would, until the test is over or this is closed. Throws BlockingIOError."""
        held = os.open(run.directory, os.O_RDONLY | os.O_DIRECTORY)
        self.addCleanup(os.close, held)
        fcntl.flock(held, fcntl.LOCK_EX | fcntl.LOCK_NB)
        return held

    def test_a_second_command_is_refused_and_touches_nothing(self):
        case = self.case(self.NAME, "--set", "time.end=0.1", "--set", "output.times=[0.1]")
        run = self.complete(*case)
        before = results(run.directory)
        held = self.lock(run)
        for words, out in ((("--restart", str(run.directory), "--set", "time.end=0.2"), None), ((*case, "--overwrite"), "run")):
            second = self.launch(*words, out=out)
            self.assertEqual(second.wait(), 2, second.stderr)
            self.assertRegex(second.stderr, f"fsi: --(restart|out) {run.directory}: another command is at work there; ")
            self.assertEqual(results(run.directory), before)
        fcntl.flock(held, fcntl.LOCK_UN)
        self.assertEqual(self.restart(run, "--set", "time.end=0.2").wait(), 0)

    def test_a_run_holds_its_folder_until_its_launcher_ends_and_its_programs_do_not(self):
        run = self.begin()
        with self.assertRaises(BlockingIOError):
            self.lock(run)
        for pid in run.programs().values():
            opened = {os.path.realpath(path) for path in Path(f"/proc/{pid}/fd").iterdir()}
            self.assertNotIn(str(run.directory.resolve()), opened)
        run.process.kill()
        run.wait()
        self.lock(run)


class Alive(EndToEnd):
    def test_run_whose_program_is_still_alive_is_not_touched(self):
        run = self.launch(*LONG)
        programs = run.until_stepping()
        pid = programs["solid_solver_linear_elastic"]
        os.kill(pid, signal.SIGSTOP)  # it cannot notice what happens to the others
        run.process.kill()
        run.wait()
        self.assertTrue(until(lambda: list(run.programs().values()) == [pid]))
        before = results(run.directory)
        again = self.launch("--restart", os.path.relpath(run.directory, self.folder), out=None)
        self.assertEqual(again.wait(), 2)
        self.assertIn(f"still alive (pid {pid})", again.stderr)
        self.assertEqual(results(run.directory), before)


if __name__ == "__main__":
    unittest.main()
