#!/usr/bin/python3
"""`fsi gallery` with the real programs: quick problems pass, another run fails."""

import csv
import json
import os
import subprocess
import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from running import BIN, FSI, WATCHDOG, EndToEnd  # noqa: E402


class Gallery(EndToEnd):
    def gallery(self, *words, code=0):
        answer = subprocess.run([str(FSI), "gallery", *words], env=os.environ | {"FSI_BIN": str(BIN)}, cwd=self.folder, text=True,
                                stdin=subprocess.DEVNULL, capture_output=True, timeout=WATCHDOG, check=False)
        self.assertEqual(answer.returncode, code, answer.stdout + answer.stderr)
        return answer.stdout

    def passes(self, name):
        self.assertIn("\npasses; ", self.gallery(name, "--out", name, "--no-progress"))
        with open(self.folder / name / "comparison.csv", encoding="utf-8", newline="") as file:
            verdicts = [row["verdict"] for row in csv.DictReader(file)]
        self.assertTrue(verdicts and set(verdicts) == {"pass"})
        self.assertTrue(json.loads((self.folder / name / "comparison.json").read_text())["passes"])
        self.assertEqual((self.folder / name / "comparison.png").read_bytes()[:4], b"\x89PNG")
        self.assertTrue((self.folder / name / "comparison.md").is_file())

    def test_list(self):
        self.assertIn("sod  ", self.gallery())

    def test_gas_and_solid(self):
        self.passes("shock_on_solid")

    def test_case_of_its_own(self):
        self.passes("elastica")

    def test_another_run_fails(self):
        self.complete("sod_tube", "--set", "time.end=0.15", "--no-progress", out="early/run")
        said = self.gallery("sod", "--out", "early", "--compare", code=1)
        self.assertIn("FAIL", said)
        self.assertFalse(json.loads((self.folder / "early" / "comparison.json").read_text())["passes"])

    def test_mistakes(self):
        self.gallery("sods", code=2)
        self.gallery("sod", "--compare", "--out", "nowhere", code=2)


if __name__ == "__main__":
    unittest.main()
