#!/usr/bin/python3
"""Cases and results may have any names that files can have, in whatever locale: of bytes that are no text, and of letters that the locale
does not know."""

import json
import os
import subprocess
import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from running import BIN, EndToEnd, FSI, LONG, ROOT  # noqa: E402
import amp_fsi  # noqa: E402

NO_TEXT = os.fsdecode(b"bad\xff")
LETTERS = os.fsdecode("größe".encode())
# A locale of ASCII alone, whose names and streams Python does not make UTF-8 by itself.
ASCII = {"LC_ALL": "POSIX", "PYTHONUTF8": "0", "PYTHONCOERCECLOCALE": "0", "PYTHONIOENCODING": "ascii"}
SHORT = ("--set", "grid.factor=2", "--set", "time.end=0.1", "--set", "output.times=[0.1]", "--set", "expect={}")


UTF8 = {"LC_ALL": "C.UTF-8"}


class AnyNames(EndToEnd):
    def setUp(self):
        super().setUp()
        (self.folder / "runtime").mkdir()
        for name in (NO_TEXT, LETTERS):
            (self.folder / f"{name}.yaml").write_bytes((ROOT / "configs" / "elastic_piston.yaml").read_bytes())

    def said(self, code, *words, locales=(UTF8, ASCII)):
        """What a command says that ends with this code, in each of these locales."""
        told = set()
        for locale in locales:
            environment = os.environ | {"FSI_BIN": str(BIN), "XDG_RUNTIME_DIR": str(self.folder / "runtime")} | locale
            answer = subprocess.run([FSI, *words], cwd=self.folder, env=environment, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                                    stderr=subprocess.STDOUT, check=False)
            self.assertEqual(answer.returncode, code, answer.stdout)
            told.add(answer.stdout)
        return told

    def test_check_says_them_byte_for_byte_and_draws_them(self):
        for name, locale in ((NO_TEXT, UTF8), (LETTERS, ASCII)):
            (told,) = self.said(0, "check", f"{name}.yaml")
            self.assertTrue(told.startswith(os.fsencode(f"{name}.yaml: valid")), told)
            (told,) = self.said(0, "check", f"{name}.yaml", "--plot", f"{name}.png", locales=[locale])
            self.assertTrue(told.startswith(os.fsencode(f"{name}.yaml: valid")), told)
            self.assertTrue(told.endswith(os.fsencode(f"drawn in {name}.png\n")), told)
            self.assertTrue((self.folder / f"{name}.png").is_file())

    def test_mistakes_say_them_byte_for_byte(self):
        for name in (NO_TEXT, LETTERS):
            for words, begin in ((("check", f"no{name}.yaml"), f"fsi: `no{name}.yaml`: no such case"),
                                 (("run", f"{name}.yaml", "--out", f"{name}.yaml"), f"fsi: --out {name}.yaml is a file"),
                                 (("plot", f"no{name}"), f"fsi: no folder 'no{name}'")):
                (told,) = self.said(2, *words)
                self.assertTrue(told.startswith(os.fsencode(begin)), told)

    def test_runs_restarts_and_pictures(self):
        for name, locale, other in ((NO_TEXT, UTF8, ASCII), (LETTERS, ASCII, UTF8)):
            for told in self.said(0, "run", f"{name}.yaml", *SHORT, "--no-progress", "--out", name, "--overwrite"):
                self.assertTrue(told.endswith(os.fsencode(f"results in {name}\n")), told)
            self.said(0, "run", "--restart", name, "--set", "time.end=0.2", locales=[other])
            self.assertEqual(json.loads((self.folder / name / "summary.json").read_text(encoding="utf-8"))["t"], 0.2)
            (told,) = self.said(0, "plot", name, locales=[locale])
            self.assertIn(os.fsencode(f"{name}/plots/interface.png"), told)
            (self.folder / f"{name}2").symlink_to(name)
            (told,) = self.said(0, "plot", name, f"{name}2", "--out", "both", locales=[other])
            self.assertNotIn(b"Warning", told)

    def test_a_living_run_is_found_by_its_folder(self):
        run = self.launch(f"{NO_TEXT}.yaml", *LONG[1:], out=NO_TEXT)
        run.until_stepping()
        for told in self.said(0, "monitor", NO_TEXT, "--once", "--json"):
            self.assertEqual(json.loads(told)["case"], "bad_")
        self.said(2, "run", f"{NO_TEXT}.yaml", "--out", NO_TEXT)
        run.ctl("stop")
        self.assertEqual(run.wait(), 0)
        self.assertEqual(run.summary()["status"], "stopped")

    def test_studies(self):
        for told in self.said(0, "study", f"{NO_TEXT}.yaml", *SHORT, "--vary", "parameters.density_ratio=0.1,1", "--out", NO_TEXT, locales=[ASCII]):
            self.assertTrue(told.endswith(os.fsencode(f"tables and picture in {NO_TEXT}\n")), told)

    def test_from_python(self):
        before = dict(os.environ)
        self.addCleanup(os.environ.update, before)
        os.environ |= {"FSI_BIN": str(BIN), "XDG_RUNTIME_DIR": str(self.folder / "runtime")}
        with self.assertRaises(amp_fsi.RunFailed) as caught:
            amp_fsi.run(self.folder / f"no{NO_TEXT}.yaml", out=self.folder / NO_TEXT)
        self.assertIn(f"no{NO_TEXT}.yaml", str(caught.exception))


if __name__ == "__main__":
    unittest.main()
