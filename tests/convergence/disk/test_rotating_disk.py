#!/usr/bin/python3
"""The rotating disk on overlapping grids: errors below the paper's, second order, for heavy and light disks."""

import csv
import json
import os
import subprocess
import tempfile
import unittest
from pathlib import Path

ROOT = Path(os.environ.get("FSI_ROOT") or Path(__file__).resolve().parents[3])

# The paper's errors at h = 1/80, t = 0.5 (tables of section 5.2), by delta.
NAMES = ("rho", "v1", "v2", "T", "u_bar", "v_bar", "P_bar")
PAPER = {"10": (9.6e-7, 6.6e-6, 6.7e-6, 1.9e-6, 5.6e-6, 4.8e-5, 3.9e-5),
         "1": (8.3e-6, 5.8e-6, 5.8e-6, 1.7e-6, 5.6e-6, 4.8e-5, 3.9e-5),
         "0.1": (6.3e-5, 4.4e-6, 4.4e-6, 1.3e-6, 6.2e-6, 6.4e-5, 4.2e-5)}


def fsi(*words):
    return subprocess.run([ROOT / "launch" / "fsi", *words], stdin=subprocess.DEVNULL, capture_output=True, text=True,
                          check=False)


class RotatingDisk(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory(prefix="fsi-disk-")
        self.addCleanup(scratch.cleanup)
        self.folder = Path(scratch.name)

    def converge(self, *settings, levels="4,8"):
        answer = fsi("converge", "rotating_disk", "--levels", levels, "--out", str(self.folder / "study"),
                     *(f"--set={setting}" for setting in settings))
        self.assertEqual(answer.returncode, 0, answer.stderr)
        return json.loads((self.folder / "study" / "converge.json").read_text(encoding="utf-8"))

    def run_once(self, out, *settings):
        answer = fsi("run", "rotating_disk", "--no-progress", "--out", str(self.folder / out),
                     *(f"--set={setting}" for setting in settings))
        return answer, json.loads((self.folder / out / "summary.json").read_text(encoding="utf-8"))

    def check(self, delta):
        table = self.converge(f"parameters.delta={delta}")
        for name, paper in zip(NAMES, PAPER[delta]):
            self.assertLess(table["errors"][name][-1], 0.83 * paper, name)
            self.assertGreaterEqual(table["rates"][name][-1], 1.9, (name, table["errors"][name]))

    def test_heavy_disk(self):
        self.check("10")

    def test_medium_disk(self):
        self.check("1")

    def test_light_disk(self):
        self.check("0.1")

    def check_ratio(self, points):
        table = self.converge(f"fluid.body_fitted.0.points={points}", levels="2,4")
        for name in NAMES:
            self.assertGreaterEqual(table["fitted"][name], 1.9, (name, table["errors"][name]))

    def test_a_quarter_of_the_points_on_the_gas_side_keeps_the_order(self):
        self.check_ratio("round(pi / (2 * h)) + 1")

    def test_four_times_the_points_on_the_gas_side_keep_the_order(self):
        self.check_ratio("round(8 * pi / h) + 1")

    def powers(self, factor, *settings):
        """[(of the solid, of the coupler)] at each step: what the gas does on the disk."""
        answer, _ = self.run_once(f"{factor}", f"grid.factor={factor}", "expect={}", *settings)
        self.assertEqual(answer.returncode, 0, answer.stderr)
        columns = []
        for name, title in (("forces_disk", "power [power/depth]"), ("interface", "disk.power [power/depth]")):
            with (self.folder / f"{factor}" / f"{name}.csv").open(encoding="utf-8") as lines:
                columns.append([float(row[title]) for row in csv.DictReader(lines)])
        return list(zip(*columns, strict=True))

    def test_power_of_the_two_sides_of_a_circle_is_the_same_but_for_the_gap(self):
        for factor in (1, 2):
            pairs = self.powers(factor)
            scale = max(abs(coupler) for _, coupler in pairs)
            for solid, coupler in pairs:
                self.assertAlmostEqual(solid / scale, coupler / scale, delta=1e-6)

    def test_power_of_the_two_sides_of_a_rigid_disk_is_the_same_but_for_the_gap(self):
        rigid = ("solids.disk.law=rigid", "solids.disk.initial={v: [0.1, 0]}", "reference={kind: none}")
        pairs = self.powers(1, *rigid)
        scale = max(abs(coupler) for _, coupler in pairs)
        for solid, coupler in pairs:
            self.assertAlmostEqual(solid / scale, coupler / scale, delta=1e-4)  # of the gap, 1.3e-4 at most

    def test_a_mapped_ring_in_the_solid_gives_what_a_marched_one_gives(self):
        polar = "[(1 - 8 * h * s) * cos(2 * pi * r), (1 - 8 * h * s) * sin(2 * pi * r)]"
        _, marched = self.run_once("marched", "grid.factor=4")
        answer, mapped = self.run_once("mapped", "grid.factor=4", f"solids.disk.body_fitted.map={polar}",
                                       "solids.disk.body_fitted.lines=9")
        self.assertEqual(answer.returncode, 0, answer.stderr)
        for name in NAMES:
            self.assertAlmostEqual(mapped["errors"][name] / marched["errors"][name], 1, delta=0.05, msg=name)

    def test_full_and_simplified_projection_agree_to_one_percent(self):
        _, simplified = self.run_once("simplified", "parameters.delta=0.1")
        _, full = self.run_once("full", "parameters.delta=0.1", "interface.projection=full")
        for name in NAMES:
            self.assertAlmostEqual(full["errors"][name] / simplified["errors"][name], 1, delta=0.01, msg=name)

    def test_traditional_scheme_breaks_for_a_light_disk_and_says_where(self):
        answer, summary = self.run_once("traditional", "parameters.delta=0.1", "interface.projection=traditional",
                                        "grid.factor=4")
        self.assertEqual(answer.returncode, 3, answer.stderr)
        self.assertEqual(summary["status"], "failed")
        self.assertIn("point", summary["reason"])

    def test_traditional_scheme_breaks_for_a_medium_disk_on_lines_finer_than_points_where_amp_goes_on(self):
        settings = ("grid.factor=4", "time.end=1", "output.times=[1]", "expect={}", "solids.disk.body_fitted.lines=16",
                    "solids.disk.body_fitted.spacing=0.5 * h", "solids.disk.shape.points=round(pi / h) + 1")
        answer, _ = self.run_once("medium-traditional", *settings, "interface.projection=traditional")
        self.assertEqual(answer.returncode, 3, answer.stderr)
        answer, _ = self.run_once("medium-amp", *settings)
        self.assertEqual(answer.returncode, 0, answer.stderr)


if __name__ == "__main__":
    unittest.main()
