#!/usr/bin/python3
"""What a point of the gas costs in memory: fields, coordinates, output and all, but not the program itself."""

import json
import os
import subprocess
import unittest

from running import BIN, EndToEnd

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


if __name__ == "__main__":
    unittest.main()
