#!/usr/bin/python3
"""Panel flutter: a tenth below the onset of piston theory the plate's motion decays, a tenth above it grows, as fast as that says."""

import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(os.environ.get("FSI_ROOT") or Path(__file__).resolve().parents[3])
sys.path.insert(0, str(ROOT / "docs"))

import flutter_studies  # noqa: E402


class Flutter(unittest.TestCase):
    def growing(self, lam, *settings):
        """The eigenvalue of the mode that grows most."""
        with tempfile.TemporaryDirectory(prefix="fsi-flutter-") as scratch:
            folder = Path(scratch) / "run"
            command = [ROOT / "launch" / "fsi", "run", "panel_flutter", "--no-progress", "--out", folder,
                       f"--set=parameters.lambda={lam}", *(f"--set={s}" for s in settings)]
            answer = subprocess.run(command, stdin=subprocess.DEVNULL, capture_output=True, text=True, check=False)
            self.assertEqual(answer.returncode, 0, answer.stderr)
            return flutter_studies.measured(folder)

    def test_piston_theory_without_damping_has_the_onset_of_the_books(self):
        self.assertGreater(flutter_studies.theory(344, damping=False).real, 1e-3)
        self.assertLess(flutter_studies.theory(343, damping=False).real, 1e-9)

    def test_onset_lies_within_a_tenth_of_the_theory(self):
        self.assertLess(self.growing(310, "grid.factor=2").real, -1e-3)
        self.assertGreater(self.growing(377, "grid.factor=2").real, 1e-2)

    def test_growth_and_frequency_are_those_of_the_theory(self):
        s, known = self.growing(377), flutter_studies.theory(377)
        self.assertLess(abs(s.real / known.real - 1), 0.04)
        self.assertLess(abs(abs(s.imag / known.imag) - 1), 0.01)


if __name__ == "__main__":
    unittest.main()
