#!/usr/bin/python3
"""What was built, from which commit: cmake/write_build_info.cmake writes it, the launcher tells it."""

import json
import os
import subprocess
import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from launcher import InScratch, ROOT  # noqa: E402
from fsi_launch import version  # noqa: E402

SCRIPT = ROOT / "cmake" / "write_build_info.cmake"
VALUES = {"VERSION": "1.2.3", "COMPILER": "g++ 12.2.0", "BUILD_TYPE": "Release", "MARCH": "native",
          "INSTRUCTION_SET": "znver4"}


class Build(InScratch):
    def git(self, *words):
        own = {"GIT_CONFIG_GLOBAL": os.devnull, "GIT_CONFIG_SYSTEM": os.devnull, "GIT_AUTHOR_NAME": "A", "GIT_COMMITTER_NAME": "A",
               "GIT_AUTHOR_EMAIL": "a@b", "GIT_COMMITTER_EMAIL": "a@b"}
        answer = subprocess.run(["git", "-C", self.root, *words], env=os.environ | own, capture_output=True, text=True,
                                check=True)
        return answer.stdout.strip()

    def setUp(self):
        super().setUp()
        self.root, self.bin = self.folder / "source tree", self.folder / "bin"
        self.root.mkdir()
        self.bin.mkdir()
        (self.root / "a.cpp").write_text("one\n")
        (self.root / "docs").mkdir()
        (self.root / "docs" / "results.md").write_text("one\n")

    def commit(self):
        self.git("init", "-q")
        self.git("add", "a.cpp", "docs")
        self.git("commit", "-q", "-m", "first")
        return self.git("rev-parse", "HEAD")

    def built(self, root=None):
        values = VALUES | {"ROOT": str(root or self.root), "FILE": str(self.bin / "build.json")}
        definitions = [word for key, value in values.items() for word in ("-D", f"{key}={value}")]
        # The search for a repository ends at the scratch folder, wherever that is.
        subprocess.run(["cmake", *definitions, "-P", SCRIPT], check=True,
                       env=os.environ | {"GIT_CEILING_DIRECTORIES": str(self.folder)})
        return version.built(self.bin)

    def test_commit_compiler_and_instruction_set_of_a_clean_clone(self):
        commit = self.commit()
        self.assertEqual(self.built(), {"version": "1.2.3", "commit": commit, "modified": False, "compiler": "g++ 12.2.0",
                                        "build_type": "Release", "march": "native", "instruction_set": "znver4"})
        self.assertEqual(version.describe(self.bin), f"AMP-FSI 1.2.3, commit {commit[:12]}\n"
                         "built by g++ 12.2.0 for native (znver4), Release")

    def test_a_change_that_is_not_committed_is_told(self):
        commit = self.commit()
        (self.root / "a.cpp").write_text("two\n")
        self.assertTrue(self.built()["modified"])
        self.assertIn(f"commit {commit[:12]}, modified\n", version.describe(self.bin))

    def test_a_page_changes_nothing_that_is_built(self):
        self.commit()
        (self.root / "docs" / "results.md").write_text("two\n")
        self.assertIs(self.built()["modified"], False)

    def test_a_file_that_git_does_not_know_changes_nothing(self):
        self.commit()
        (self.root / "mycase.yaml").write_text("title: mine\n")
        self.assertIs(self.built()["modified"], False)

    def test_without_a_repository_the_commit_is_unknown(self):
        build = self.built()
        self.assertEqual((build["commit"], build["modified"], build["compiler"]), (None, None, "g++ 12.2.0"))
        self.assertIn("unknown commit", version.describe(self.bin))

    def test_the_repository_around_an_unpacked_archive_is_somebody_elses(self):
        self.commit()
        inner = self.root / "amp-fsi"
        inner.mkdir()
        self.assertIsNone(self.built(inner)["commit"])

    def test_what_stays_the_same_is_not_written_again(self):
        self.commit()
        self.built()
        before = (self.bin / "build.json").stat().st_mtime_ns
        self.built()
        self.assertEqual((self.bin / "build.json").stat().st_mtime_ns, before)
        self.assertEqual(sorted(path.name for path in self.bin.iterdir()), ["build.json"])

    def test_programs_without_a_record_are_of_unknown_origin(self):
        self.assertEqual(set(version.built(self.bin).values()), {None})
        self.assertIn("nothing is built", version.describe(self.bin))
        (self.bin / "build.json").write_text("[1, 2")
        self.assertEqual(set(version.built(self.bin).values()), {None})

    def test_a_build_for_a_named_instruction_set_says_its_name_once(self):
        (self.bin / "build.json").write_text(json.dumps({"march": "x86-64-v3", "instruction_set": "x86-64-v3"}))
        self.assertIn(" for x86-64-v3, ", version.describe(self.bin))


if __name__ == "__main__":
    unittest.main()
