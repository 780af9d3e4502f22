#!/usr/bin/python3
"""The laws of the solid tell apart at large strain and meet at small strain: the same piston with each of them."""

import json
import os
import subprocess
import tempfile
import unittest
from pathlib import Path

import h5py
import numpy

ROOT = Path(os.environ.get("FSI_ROOT") or Path(__file__).resolve().parents[3])

OWN = {"mooney_rivlin": ["c01=0.13"], "gent": ["J_m=3"]}  # lambda = mu = 0.56


class LawsOfThePiston(unittest.TestCase):
    def run_piston(self, law, strain):
        """(displacement at the end, largest error of it against the fine one-dimensional run)"""
        own = [f"--set=solids.solid.{key}" for key in OWN.get(law, ())]
        with tempfile.TemporaryDirectory(prefix="fsi-laws-") as scratch:
            command = [ROOT / "launch" / "fsi", "run", "piston_svk", "--solid", f"solid={law}", "--no-progress",
                       f"--set=parameters.strain={strain}", "--set=expect={}", *own, "--out", f"{scratch}/run"]
            answer = subprocess.run(command, stdin=subprocess.DEVNULL, capture_output=True, text=True, check=False)
            self.assertEqual(answer.returncode, 0, answer.stderr)
            summary = json.loads(Path(f"{scratch}/run/summary.json").read_text(encoding="utf-8"))
            with h5py.File(f"{scratch}/run/solid_solid.h5") as file:
                last = file[sorted(file)[-1]]["solid"]
                return last["u1"][:], summary["errors"]["u_bar"]

    def test_laws_differ_at_large_strain_by_more_than_ten_times_the_grid_error(self):
        u, error = self.run_piston("saint_venant_kirchhoff", 0.2)
        for law in ("neo_hookean", "linear_elastic", "mooney_rivlin", "gent"):
            other, other_error = self.run_piston(law, 0.2)
            self.assertGreater(numpy.abs(u - other).max(), 10 * max(error, other_error), law)

    def test_a_gent_solid_ends_with_its_name_where_it_locks(self):
        # A strain of about 1 has I1 - 3 = 3, beyond the J_m of 2.1.
        with tempfile.TemporaryDirectory(prefix="fsi-laws-") as scratch:
            command = [ROOT / "launch" / "fsi", "run", "piston_neo_hookean", "--solid", "solid=gent", "--no-progress",
                       "--set=solids.solid.J_m=2.1", "--set=parameters.strain=2", "--set=expect={}", "--out", f"{scratch}/run"]
            answer = subprocess.run(command, stdin=subprocess.DEVNULL, capture_output=True, text=True, check=False)
            self.assertEqual(answer.returncode, 3, answer.stderr)
            self.assertIn("no stress, as where I1 - 3 reaches J_m and the law `gent` locks", answer.stderr)

    def test_laws_meet_quadratically_as_the_strain_goes_to_zero(self):
        # The laws share their linear part: the difference of u falls with the square of the strain.
        differences = []
        for strain in (0.08, 0.02):
            u, _ = self.run_piston("saint_venant_kirchhoff", strain)
            other, _ = self.run_piston("neo_hookean", strain)
            differences.append(numpy.abs(u - other).max())
        self.assertGreater(numpy.log(differences[0] / differences[1]) / numpy.log(4), 1.8)


if __name__ == "__main__":
    unittest.main()
