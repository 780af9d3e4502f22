#!/usr/bin/python3
"""Which pictures `fsi plot` makes of a folder, and which it removes."""

import contextlib
import io
import sys
import tempfile
import types
import unittest
from pathlib import Path

import h5py
import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
import running  # noqa: E402,F401  the path of the launcher's modules
from fsi_launch import plot  # noqa: E402
from fsi_launch.failure import UserMistake  # noqa: E402


class Folders(unittest.TestCase):
    """What is drawn of the folder of a run that has no output times, and of folders that are no run's."""

    def setUp(self):
        scratch = tempfile.TemporaryDirectory(prefix="fsi-test-")
        self.addCleanup(scratch.cleanup)
        self.run_ = Path(scratch.name) / "run"
        for name in ("fields", "last_state"):
            (self.run_ / name).mkdir(parents=True)
        (self.run_ / "case.yaml").write_text("name: piston\n", encoding="utf-8")
        (self.run_ / "interface.csv").write_text("step,t [time],gap [length]\n0,0,0\n1,0.1,1e-3\n2,0.2,3e-3\n", encoding="utf-8")

    def write_group(self, group, t):
        x1, x2 = np.meshgrid(np.linspace(0, 1, 5), np.linspace(0, 1, 4))
        group.attrs["t"] = t
        for key, values in {"x1": x1, "x2": x2, "rho": 1 + x1, "p": 2 + x1, "v1": x1, "v2": x2}.items():
            group[f"gas/{key}"] = values

    def write_state(self, path):
        with h5py.File(path, "w") as file:
            self.write_group(file, 0.2)

    def plot(self, folder, at=()):
        """Names of the pictures."""
        with contextlib.redirect_stdout(io.StringIO()) as printed:
            plot.main(types.SimpleNamespace(directories=[folder], out=None, contours=False, movie=False, at=list(at), format="png"))
        return [Path(line).stem for line in printed.getvalue().split("\n") if line]

    def test_tables_are_drawn_before_the_first_output_time(self):
        self.assertEqual(self.plot(self.run_), ["interface"])

    def test_the_last_state_of_a_run_that_broke_is_drawn(self):
        self.write_state(self.run_ / "last_state" / "fluid.h5")
        self.assertEqual(self.plot(self.run_), ["fields_last", "interface"])

    def test_pictures_have_the_numbers_of_their_outputs_whichever_are_drawn(self):
        with h5py.File(self.run_ / "fluid.h5", "w") as file:
            file.attrs["outputs"] = 3
            for k in range(3):
                self.write_group(file.create_group(f"{k:06}"), 0.1 * k)
        for times, numbers in (((), (0, 1, 2)), ((0.1,), (1,)), ((0.2, 0.0), (0, 2))):
            drawn = [name for name in self.plot(self.run_, times) if name.startswith("fields")]
            self.assertEqual(drawn, [f"fields_{number:04}" for number in numbers])

    def test_pictures_of_times_that_the_run_no_longer_has_are_gone_unless_some_times_are_asked_for(self):
        with h5py.File(self.run_ / "fluid.h5", "w") as file:
            file.attrs["outputs"] = 1
            self.write_group(file.create_group("000000"), 0.0)
        plots = self.run_ / "plots"
        plots.mkdir()
        for name in ("fields_0007.png", "fields_0007.pdf", "fields_mine.png", "movie_0001.png"):
            (plots / name).touch()
        self.plot(self.run_, [0.0])
        self.assertTrue((plots / "fields_0007.png").exists())
        self.plot(self.run_)
        self.assertEqual({path.name for path in plots.iterdir()} - {"interface.png", "grid.png", "lines.png"},
                         {"fields_0000.png", "fields_0007.pdf", "fields_mine.png", "movie_0001.png"})

    def test_a_part_of_a_run_is_refused_and_the_folder_of_the_run_named(self):
        with self.assertRaisesRegex(UserMistake, f"part of a run.*'{self.run_.resolve()}'"):
            self.plot(self.run_ / "fields")

    def test_a_single_output_is_not_taken_for_a_series(self):
        (self.run_ / "case.yaml").unlink()
        self.write_state(self.run_ / "fields" / "solid_block_000000.h5")
        with self.assertRaisesRegex(UserMistake, "not the series"):
            self.plot(self.run_ / "fields")


if __name__ == "__main__":
    unittest.main()
