#!/usr/bin/python3
"""Two gases in one case: a program each, whose loss is named by the gas; results, probes, pictures and grids of both."""

import os
import signal
import subprocess
import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from running import BIN, EndToEnd, FSI, PATIENT, processes  # noqa: E402

PARTICIPANTS = ("left", "right", "piston", "coupler")
STEPS = ("--set", "grid.factor=4", "--set", "time.dt=1e-7", "--set", "output.times=[1e-6, 0.8]",
         "--set", "expect={}")


class TwoGases(EndToEnd):
    def lose(self, name, number, case="piston_between_gases", solid="piston"):
        """The run whose program of this name got a signal; its launcher ends nobody who has not ended by himself."""
        run = self.launch(case, *STEPS, script=PATIENT)
        run.until_stepping()
        os.kill(next(one.pid for one in processes.programs_of(run.directory) if one.name == name), number)
        self.assertEqual(run.wait(), 4, run.stderr)
        self.assertIn(name, run.summary()["reason"])
        for other in ("left", "right", solid, "coupler"):
            if other != name:
                self.assertEqual(run.part(other)["exit_code"], 4)
        self.assert_nothing_left(run)
        return run

    def test_a_killed_gas_ends_the_run_and_is_named(self):
        run = self.lose("right", signal.SIGKILL)
        self.assertEqual(run.summary()["failure"]["origin"], "right")

    def test_a_killed_solid_ends_the_run_and_is_named(self):
        self.assertEqual(self.lose("piston", signal.SIGKILL).summary()["failure"]["origin"], "piston")

    def test_a_killed_beam_ends_the_run_and_is_named(self):
        self.assertEqual(self.lose("plate", signal.SIGKILL, "taylor_plate", "plate").summary()["failure"]["origin"], "plate")

    def test_a_stopped_gas_ends_the_run_and_is_named(self):
        self.assertRegex(self.lose("left", signal.SIGSTOP).summary()["reason"], r"silent for 4 s \(time\.peer_timeout\); is it stopped\?")

    def test_files_tables_and_summary_speak_of_both(self):
        run = self.complete("piston_between_gases", "--set", "grid.factor=4", "--set",
                            "output.probes=[{name: a, in: left, x: -0.5, y: 0.05}, {name: b, in: right, x: 1, y: 0.05}]")
        self.assertEqual(list(run.summary()["participants"]), list(PARTICIPANTS))
        self.assertLessEqual({"left", "right", "piston"}, set(run.summary()["conservation"]))
        for name in ("fluid_left.h5", "fluid_right.h5", "solid_piston.h5"):
            self.assertTrue((run.directory / name).is_file(), name)
            self.assertIn(f"{name.removesuffix('.h5')}/", (run.directory / "run.xmf").read_text(encoding="utf-8"))
        self.assertIn("piston.left.gap [length],", run.table()[0])
        self.assertIn("piston.right.gap [length],", run.table()[0])
        heading = (run.directory / "probes.csv").read_text(encoding="utf-8").splitlines()[0]
        self.assertRegex(heading, r"a\.rho,.*b\.rho,")
        import h5py
        with h5py.File(run.directory / "fluid_right.h5") as right, h5py.File(run.directory / "fluid_left.h5") as left:
            self.assertAlmostEqual(right["000000/right/x1"][0, 0], 0.5, 5)
            self.assertAlmostEqual(left["000000/left/x1"][0, 0], -1.5, 5)

    def test_pictures_show_both(self):
        run = self.complete("taylor_plate", "--set", "grid.factor=4")
        environment = os.environ | {"FSI_BIN": str(BIN)}
        subprocess.run([str(FSI), "plot", str(run.directory)], check=True, env=environment, capture_output=True)
        pictures = {path.stem for path in (run.directory / "plots").glob("*.png")}
        self.assertLessEqual({"fields_0001", "grid", "lines", "interface", "forces_plate"}, pictures)
        self.assertNotIn("streamlines", pictures)   # of a gas on one grid nobody draws any
        from fsi_launch.plot.reading import data
        series = data.all_series(run.directory)
        self.assertEqual([(one.name, one.is_gas()) for one in series], [("left", True), ("right", True), ("plate", False)])
        self.assertEqual(len(data.gas_of(series).outputs[0].grids), 2)

    def test_the_grids_of_both_are_drawn_before_a_run(self):
        environment = os.environ | {"FSI_BIN": str(BIN)}
        subprocess.run([str(FSI), "check", "taylor_plate", "--plot", "look.png"], check=True, env=environment, capture_output=True,
                       cwd=self.folder)
        self.assertTrue((self.folder / "look.png").is_file())


if __name__ == "__main__":
    unittest.main()
