#!/usr/bin/python3
"""What a point of the gas costs in memory: fields, coordinates, output and all, but not the program itself."""

import json
import os
import subprocess
import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from running import BIN, EndToEnd  # noqa: E402

BYTES_PER_POINT = 400


class Memory(EndToEnd):
    def peak(self, factor):
        """(points, peak resident bytes) of the gas solver alone on a moving grid."""
        directory = self.folder / str(factor)
        directory.mkdir()
        case = directory / "case.yaml"
        subprocess.run([BIN / "fsi_case", "resolve", "isentropic_vortex", "--set", f"grid.factor={factor}",
                        "--set", "time.end=0.002", "--out", case], check=True, stdin=subprocess.DEVNULL)
        solver = subprocess.Popen([BIN / "fluid_solver", "--case", case, "--run-dir", directory, "--run", f"memory-{os.getpid()}-{factor}"],
                                  stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL)
        _, status, usage = os.wait4(solver.pid, 0)
        solver.returncode = os.waitstatus_to_exitcode(status)
        self.assertEqual(solver.returncode, 0)
        part = json.loads((directory / "parts" / "fluid.json").read_text(encoding="utf-8"))
        return part["points"], usage.ru_maxrss * 1024

    def test_a_gas_point_takes_less_than_400_bytes(self):
        (few, small), (many, large) = self.peak(8), self.peak(32)
        self.assertGreater(many, 10 * few)
        self.assertLess((large - small) / (many - few), BYTES_PER_POINT)


    def estimate(self, case, *settings):
        """{program: bytes} as `fsi check` has them."""
        answer = subprocess.run([BIN / "fsi_case", "check", case, "--json", *settings], check=True, stdin=subprocess.DEVNULL,
                                capture_output=True, text=True)
        return json.loads(answer.stdout)["memory"]

    def test_check_knows_what_each_program_will_need(self):
        """One case for each kind of grid: at rest, mapped, with bodies; gas and solids."""
        for case, factor in (("elastic_piston", 40), ("solid_manufactured", 32), ("isentropic_vortex", 32),
                             ("rotating_disk", 16), ("shock_ellipse", 12)):
            settings = [f"--set=grid.factor={factor}", "--set=time.end=0.002", "--set=output.times=[0.001,0.002]"]
            run = self.launch(case, *settings, out=case)
            self.assertEqual(run.wait(), 0, run.stderr)
            estimate = self.estimate(case, *settings)
            for name, part in run.summary()["participants"].items():
                peak = part["peak_memory_mib"] * 2**20
                self.assertLess(abs(estimate[name] / peak - 1), 0.3, f"{case}, {name}: {estimate[name]:.3g} against {peak:.3g}")

    def test_a_case_the_machine_has_no_memory_for_is_refused_before_a_folder_is_made(self):
        run = self.launch("sod_tube", "--set=fluid.grid.points=[100000, 100000]")
        self.assertEqual(run.wait(), 2)
        self.assertRegex(run.stderr, r"fluid\.grid: .* points need about .* of memory \(fluid .*; .* are free, which is enough for about")
        self.assertFalse(run.directory.exists())


if __name__ == "__main__":
    unittest.main()
