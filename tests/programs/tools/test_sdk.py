#!/usr/bin/python3
"""A solid of one's own as a project of its own: against an installed AMP-FSI alone, and as good as the one built with it."""

import shutil
import subprocess
import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from running import BIN, EndToEnd, ROOT  # noqa: E402

BUILD = BIN.parent


class InstalledSdk(EndToEnd):
    def do(self, *command):
        answer = subprocess.run([str(word) for word in command], stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                                stderr=subprocess.STDOUT, text=True, check=False)
        self.assertEqual(answer.returncode, 0, answer.stdout[-4000:])

    def test_the_spring_piston_is_built_by_find_package_and_runs_bit_for_bit_as_the_one_of_this_build(self):
        installed, project, build = self.folder / "installed", self.folder / "project", self.folder / "build"
        self.do("cmake", "--install", BUILD, "--prefix", installed, "--component", "sdk")
        project.mkdir()
        for name in ("CMakeLists.txt", "main.cpp"):
            shutil.copy(ROOT / "examples" / "spring_piston" / name, project)
        self.do("cmake", "-G", "Ninja", "-S", project, "-B", build, "-D", f"CMAKE_PREFIX_PATH={installed}")
        compiled = (build / "build.ninja").read_text(encoding="utf-8")
        self.assertIn(f"{installed}/include/amp_fsi", compiled)
        self.assertNotIn(f"{ROOT}/", compiled)
        self.do("cmake", "--build", build)
        settings = ("--set", "grid.factor=2", "--set", "expect={}")
        own = self.complete("spring_piston", *settings, "--set", f"solids.piston.program={build}/spring_piston", out="own")
        tables = [run.directory / "forces_piston.csv" for run in (self.complete("spring_piston", *settings), own)]
        self.assertEqual(tables[0].read_bytes(), tables[1].read_bytes())


if __name__ == "__main__":
    unittest.main()
