#!/usr/bin/python3
"""What a run was computed with: commit, compiler and instruction set, in `fsi --version` and in every summary.json."""

import json
import os
import subprocess
import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from running import BIN, EndToEnd, FSI, ROOT  # noqa: E402


def head():
    """The commit of the sources; None where they are no repository."""
    answer = subprocess.run(["git", "-c", f"safe.directory={ROOT}", "-C", ROOT, "rev-parse", "--show-prefix", "HEAD"],
                            capture_output=True, text=True, check=False)
    return answer.stdout.strip() if answer.returncode == 0 and answer.stdout.startswith("\n") else None


class Version(EndToEnd):
    def setUp(self):
        super().setUp()
        self.built = json.loads((BIN / "build.json").read_text(encoding="utf-8"))

    def test_summary_says_what_was_built(self):
        run = self.complete("elastic_piston", "--set", "grid.factor=2", "--set", "time.end=0.1", "--set", "expect={}")
        self.assertEqual(run.summary()["build"], self.built)

    def test_version_says_it_in_words(self):
        answer = subprocess.run([FSI, "--version"], env=os.environ | {"FSI_BIN": str(BIN)}, capture_output=True, text=True,
                                check=True)
        for key in ("version", "compiler", "march", "instruction_set"):
            self.assertIn(self.built[key], answer.stdout, key)
        if head() is not None:
            self.assertIn(self.built["commit"][:12], answer.stdout)

    def test_native_is_told_by_its_name(self):
        self.assertNotEqual(self.built["instruction_set"], "native")

    def test_a_repository_has_a_commit(self):
        self.assertEqual(self.built["commit"] is None, head() is None)
        self.assertEqual(self.built["modified"] is None, head() is None)


if __name__ == "__main__":
    unittest.main()
