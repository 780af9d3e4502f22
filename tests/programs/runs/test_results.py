#!/usr/bin/python3
"""What a run leaves in its folder: tables, fields, the ParaView index, pictures."""

import json
import math
import os
import subprocess
import sys
import unittest
import xml.etree.ElementTree
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from running import BIN, EndToEnd, FSI  # noqa: E402


def plot(test, directory, *options):
    """Names of the pictures that `fsi plot` draws of a folder; each must show something."""
    answer = subprocess.run([FSI, "plot", directory, *options], env=os.environ | {"FSI_BIN": str(BIN)},
                            capture_output=True, text=True, check=False)
    test.assertEqual(answer.returncode, 0, answer.stderr)
    test.assertNotIn("Warning", answer.stderr)
    pictures = list((directory / "plots").glob("*.png"))
    for path in pictures:
        test.assertGreater(path.stat().st_size, 10_000, path)
    return {path.stem for path in pictures}


class Results(EndToEnd):
    def setUp(self):
        super().setUp()
        self.run_ = self.complete("elastic_piston", "--set", "grid.factor=2", "--set", "output.times=[0.4, 0.8]")

    def test_folder_holds_what_the_documentation_promises(self):
        for name in ("summary.json", "case.yaml", "fluid.h5", "solid_solid.h5", "run.xmf", "interface.csv"):
            self.assertGreater((self.run_.directory / name).stat().st_size, 0, name)
        self.assertEqual([path.name for path in self.run_.directory.rglob("*") if path.suffix in (".tmp", ".part")], [])

    def test_summary_has_every_promised_number(self):
        summary = self.run_.summary()
        for key in ("status", "reason", "case", "t", "t_end", "steps", "dt", "wall_s", "participants", "errors", "interface",
                    "counters"):
            self.assertIn(key, summary)
        for part in summary["participants"].values():
            for key in ("points", "substeps", "compute_s", "wait_s", "point_updates_per_s"):
                self.assertTrue(math.isfinite(part[key]), key)
        for key in ("rho", "v1", "v2", "T", "u_bar", "v_bar", "P_bar"):
            self.assertTrue(math.isfinite(summary["errors"][key]), key)
        for key in ("max_velocity_jump", "max_traction_jump", "max_gap"):
            self.assertTrue(math.isfinite(summary["interface"][key]), key)
        self.assertAlmostEqual(summary["t"], 0.8)
        self.assertEqual(summary["t_end"], 0.8)

    def test_interface_table_has_a_line_per_step(self):
        lines = (self.run_.directory / "interface.csv").read_text().splitlines()
        self.assertIn(len(lines) - 1, (self.run_.summary()["steps"], self.run_.summary()["steps"] + 1))

    def test_output_times_are_hit_exactly(self):
        import h5py
        for name in ("fluid.h5", "solid_solid.h5"):
            with h5py.File(self.run_.directory / name) as file:
                times = [float(file[output].attrs["t"]) for output in sorted(file)]
            self.assertEqual(times[-2:], [0.4, 0.8])

    def test_paraview_index_is_well_formed_and_points_to_data_that_exist(self):
        import h5py
        tree = xml.etree.ElementTree.parse(self.run_.directory / "run.xmf")
        items = [item.text.strip() for item in tree.iter("DataItem") if item.get("Format") == "HDF"]
        self.assertGreater(len(items), 10)
        for item in items:
            name, path = item.split(":", 1)
            with h5py.File(self.run_.directory / name) as file:
                self.assertIn(path, file)

    def test_resolved_case_runs_again_to_the_same_errors(self):
        again = self.complete(str(self.run_.directory / "case.yaml"), out="again")
        self.assertEqual(again.summary()["errors"], self.run_.summary()["errors"])

    def test_pictures(self):
        self.assertLessEqual({"grid", "lines", "interface"}, plot(self, self.run_.directory))

    def test_convergence_table(self):
        answer = subprocess.run([FSI, "converge", "elastic_piston", "--levels", "1,2", "--rates", "rho,u_bar",
                                 "--out", self.folder / "table"], env=os.environ | {"FSI_BIN": str(BIN)},
                                capture_output=True, text=True, check=False)
        self.assertEqual(answer.returncode, 0, answer.stderr)
        table = json.loads((self.folder / "table" / "converge.json").read_text())
        self.assertEqual(list(table["errors"]), ["rho", "u_bar"])
        self.assertTrue(all(rate > 1 for rate in table["fitted"].values()))  # coarse grids: only that it falls
        self.assertEqual(plot(self, self.folder / "table"), {"convergence"})


class CompositeGrids(EndToEnd):
    def test_pictures_of_overlapping_grids_and_of_the_disk_over_its_radius(self):
        run = self.complete("rotating_disk", "--set", "grid.factor=2", "--set", "time.end=0.1",
                            "--set", "output.times=[0.1]", "--set", "reference.points=400")
        self.assertEqual(plot(self, run.directory, "--contours"),
                         {"fields_0000", "grid", "grid_disk", "radius_0000", "axis_0000", "streamlines", "interface", "forces_disk"})


class RigidBodies(EndToEnd):
    """They are drawn whole."""

    def area(self, case, *settings):
        import numpy as np
        from fsi_launch.plot.reading import data, mesh
        run = self.complete(case, "--set", "expect={}", *settings)
        [body] = [one for one in data.all_series(run.directory) if not one.is_gas()]
        [grid] = body.outputs[-1].grids
        corners = np.column_stack([grid.x1.ravel(), grid.x2.ravel()])[mesh.triangles(grid).triangles]
        a, b = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
        return 0.5 * np.abs(a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]).sum()

    def test_that_a_wall_cuts_off(self):
        self.assertAlmostEqual(self.area("panel_on_step", "--set", "time.end=0.01", "--set", "output.every=0.01"), 4 * 50, delta=1e-9)

    def test_that_are_a_grid(self):
        self.assertAlmostEqual(self.area("rigid_piston", "--set", "parameters.angle=20"), 1 * 0.5, delta=1e-9)


class ExactSolutions(EndToEnd):
    """Beside a run whose solution is known in formulas, reference.h5 has it along the line that pictures draw."""

    def distances(self, run, known):
        """{(program, field): largest distance of the computed curve from the exact one} at the end."""
        import numpy as np
        from fsi_launch.plot.one_run import curves
        from fsi_launch.plot.reading import data
        tables, found = data.piston_reference(run.directory), {}
        self.assertTrue(tables)
        for one in data.all_series(run.directory):
            table = tables[one.outputs[-1].t]["gas" if one.is_gas() else "solid"]
            x = table["x"] if one.is_gas() else table["x_bar"] + table["u"]
            grid = one.outputs[-1].grids[0]
            for key in known[one.is_gas()]:
                s, values = curves.along(grid, key, 0)
                found[one.name, key] = np.abs(values - np.interp(s, x, table[key])).max()
        return found

    def test_turned_piston(self):
        run = self.complete("elastic_piston", "--set", "grid.factor=2", "--set", "parameters.angle=0.4", "--set", "expect={}")
        found = self.distances(run, {True: ("rho", "v", "p"), False: ("u", "v", "P11")})
        self.assertEqual(len(found), 6)
        self.assertLess(max(found.values()), 5e-3, found)    # of curves that vary by tenths
        self.assertIn("lines", plot(self, run.directory))

    def test_two_gases(self):
        run = self.complete("piston_between_gases", "--set", "grid.factor=2", "--set", "expect={}")
        found = self.distances(run, {True: ("p",), False: ("u",)})
        self.assertEqual(sorted(name for name, _ in found), ["left", "piston", "right"])
        self.assertLess(max(found.values()), 3e-7, found)    # of a pulse of 1e-6

    def test_tube_has_no_solid_and_the_well_known_pressure(self):
        import h5py
        run = self.complete("sod_tube", "--set", "grid.factor=2", "--set", "expect={}")
        with h5py.File(run.directory / "reference.h5") as file:
            last = file[sorted(file)[-1]]
            self.assertEqual(list(last), ["gas"])
            middle = last["gas/x"][:].searchsorted(0.75)     # between contact and shock
            self.assertAlmostEqual(last["gas/p"][middle], 0.30313, places=5)

    def test_another_law_has_another_solution(self):
        run = self.complete("elastic_piston", "--solid", "solid=neo_hookean", "--set", "grid.factor=2", "--set", "expect={}")
        self.assertFalse((run.directory / "reference.h5").exists())


if __name__ == "__main__":
    unittest.main()
