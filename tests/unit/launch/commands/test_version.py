#!/usr/bin/python3
"""What was built, from which commit: cmake/write_build_info.cmake writes it, the launcher tells it."""

import json
import os
import subprocess
import sys
import unittest
from pathlib import Path
from unittest import mock

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


BUILD = """
rule copy
  command = cp $in $out
  description = Building $out
rule record
  command = true
  description = Writing down what is built
rule configure
  command = false
  description = Re-running CMake
  generator = 1
build record: record
build bin/fluid_solver: copy fluid.cpp || record
build bin/coupler: copy coupler.cpp || record
build bin/test_coupler: copy test.cpp || record
build bin/monitor: copy monitor.cpp || record
build build.ninja: configure CMakeLists.txt
"""


class OlderThanTheSources(InScratch):
    """A build that made one program anew has written down the commit of all."""

    def setUp(self):
        super().setUp()
        (self.folder / "build.ninja").write_text(BUILD)
        for name in ("fluid", "coupler", "test", "monitor"):
            (self.folder / f"{name}.cpp").write_text("one\n")
        subprocess.run(["ninja", "-C", self.folder, "-f", "/dev/stdin", "bin/fluid_solver", "bin/coupler", "bin/test_coupler"],
                       input=b"include build.ninja\n", capture_output=True, check=True)
        (self.folder / "bin" / "build.json").write_text(json.dumps({"version": "1.2.3", "march": "native"}))
        environment = mock.patch.dict(os.environ)
        environment.start()
        self.addCleanup(environment.stop)
        os.environ.pop("FSI_BIN", None)
        for name, value in (("BUILD", self.folder), ("BIN", self.folder / "bin")):
            patch = mock.patch.object(version.paths, name, value)
            patch.start()
            self.addCleanup(patch.stop)

    def change(self, name):
        moment = (self.folder / "bin" / "coupler").stat().st_mtime_ns + 10**10
        os.utime(self.folder / f"{name}.cpp", ns=(moment, moment))

    def test_programs_that_the_next_command_builds_anew_are_named_and_are_what_they_were(self):
        self.assertEqual(len(version.describe().splitlines()), 2)
        self.change("test")     # no command takes it
        self.change("monitor")  # was never built
        self.assertEqual(len(version.describe().splitlines()), 2)
        before = (self.folder / "bin" / "coupler").stat().st_mtime_ns
        self.change("coupler")
        self.assertEqual(version.describe().splitlines()[2:], ["older than the sources: coupler; the next command that takes them builds them"])
        self.change("fluid")
        self.assertIn("sources: coupler, fluid_solver; ", version.describe())
        self.assertEqual((self.folder / "bin" / "coupler").stat().st_mtime_ns, before)

    def test_a_source_that_is_gone_is_a_change(self):
        (self.folder / "fluid.cpp").unlink()
        self.assertEqual(version.outdated(), ["fluid_solver"])

    def test_programs_of_another_folder_are_taken_as_they_are_and_without_a_build_nothing_is_said(self):
        self.change("coupler")
        with mock.patch.dict(os.environ, FSI_BIN=str(self.folder / "bin")):
            self.assertEqual(version.outdated(), [])
        with mock.patch.dict(os.environ, PATH="/nowhere"):
            self.assertEqual(version.outdated(), [])
        (self.folder / "build.ninja").unlink()
        self.assertEqual(version.outdated(), [])


if __name__ == "__main__":
    unittest.main()
