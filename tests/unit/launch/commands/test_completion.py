#!/usr/bin/python3
"""Completion for bash offers verbs, options and cases."""

import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
import launcher  # noqa: E402,F401  the path of the launcher's modules
from fsi_launch.command import completion, verbs  # noqa: E402


class Completion(unittest.TestCase):
    def offered(self, *words):
        ask = f'COMP_WORDS=({" ".join(words)} "$1"); COMP_CWORD={len(words)}; _fsi; printf "%s\\n" "${{COMPREPLY[@]}}"'
        with tempfile.TemporaryDirectory() as empty:  # names of files are offered too
            answer = subprocess.run(["bash", "-c", completion.script(verbs.parser()) + ask, "bash", self.begun], cwd=empty,
                                    capture_output=True, text=True, check=True)
        return set(answer.stdout.split())

    def all_after(self, verb):
        self.begun = "--"
        return self.offered("fsi", verb)

    def test_verbs(self):
        self.begun = "m"
        self.assertEqual(self.offered("fsi"), {"monitor"})
        self.begun = ""
        self.assertLessEqual({"run", "check", "study", "plot", "completion"}, self.offered("fsi"))

    def test_options_and_cases(self):
        self.begun = "--re"
        self.assertEqual(self.offered("fsi", "run"), {"--restart", "--remote-shell"})
        self.begun = "so"
        self.assertEqual(self.offered("fsi", "gallery"), {"sod"})
        self.assertLessEqual({"--outline", "--material"}, self.all_after("new"))
        self.begun = "elastic_p"
        self.assertEqual(self.offered("fsi", "run"), {"elastic_piston"})

    def test_options_that_are_meant(self):
        parser = verbs.parser()
        for verb, words, option in (("run", ["--output", "DIR"], "--out"), ("run", ["--overwite"], "--overwrite"),
                                    ("plot", ["x.yaml", "--att=0.5"], "--at"), ("run", ["--zzz"], None), ("run", ["x"], None)):
            self.assertEqual(completion.meant(parser, verb, words), option, words)


if __name__ == "__main__":
    unittest.main()
