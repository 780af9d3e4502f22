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
    def answer(self, *words):
        return subprocess.run([str(FSI), "gallery", *words], env=os.environ | {"FSI_BIN": str(BIN)}, cwd=self.folder, text=True,
                              stdin=subprocess.DEVNULL, capture_output=True, timeout=WATCHDOG, check=False)

    def gallery(self, *words, code=0):
        answer = self.answer(*words)
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

    def test_a_run_whose_numbers_are_others_fails(self):
        run = self.complete("sod_tube", "--set", "expect={}", out="sod/run")
        self.assertIn("\npasses; ", self.gallery("sod", "--out", "sod", "--compare"))
        summary = run.summary()
        summary["errors"]["rho_mean"] = 0.006
        (run.directory / "summary.json").write_text(json.dumps(summary))
        said = self.gallery("sod", "--out", "sod", "--compare", code=1)
        self.assertIn("FAIL", said)
        self.assertFalse(json.loads((self.folder / "sod" / "comparison.json").read_text())["passes"])

    def test_a_run_with_another_law_that_was_made_by_hand_counts(self):
        self.complete("shock_on_solid", "--set", "parameters.rho_bar=10", "--solid", "solid=linear_elastic", out="hand/run")
        self.assertIn("\npasses; ", self.gallery("shock_on_solid", "--out", "hand", "--compare"))

    def test_runs_of_other_cases_and_such_as_are_not_whole_are_refused(self):
        run = self.complete("sod_tube", "--set", "time.end=0.15", out="early/run")
        self.refused("sod", "early", "differs in time.end; add --overwrite")
        self.refused("vortex", "early", "none of vortex: its case differs in name, ")
        summary = run.summary()
        (run.directory / "summary.json").write_text(json.dumps(summary | {"status": "stopped"}))
        self.refused("sod", "early", "its status is 'stopped'; add --overwrite")
        self.assertEqual([path.name for path in (self.folder / "early").iterdir()], ["run"])

    def refused(self, problem, out, words):
        answer = self.answer(problem, "--out", out, "--compare")
        self.assertEqual(answer.returncode, 2, answer.stdout + answer.stderr)
        self.assertIn(words, answer.stderr)

    def test_mistakes(self):
        self.gallery("sods", code=2)
        self.gallery("sod", "--compare", "--out", "nowhere", code=2)


if __name__ == "__main__":
    unittest.main()
