#!/usr/bin/python3
"""Where results may lie, and what a run that is refused before a program has begun leaves of its folder: nothing."""

import contextlib
import errno
import fcntl
import os
import sys
import unittest
from pathlib import Path
from unittest import mock

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from launcher import InScratch  # noqa: E402
from fsi_launch.failure import Failure, OUTPUT_FAILED, UserMistake  # noqa: E402
from fsi_launch.results import folder, replaced, restart  # noqa: E402


class Making(InScratch):
    def setUp(self):
        super().setUp()
        registry = mock.patch.dict(os.environ, XDG_RUNTIME_DIR=str(self.folder))
        registry.start()
        self.addCleanup(registry.stop)
        self.until = contextlib.ExitStack()     # the runs that have a folder here are over
        self.addCleanup(self.until.close)

    def refused(self, out, code=2):
        with self.assertRaises(Failure) as caught:
            folder.make(str(out), "piston", False, self.until)
        self.assertEqual(caught.exception.code, code)
        return str(caught.exception)


class Made(Making):
    def test_a_link_to_nowhere_is_named_with_where_it_leads(self):
        link = self.folder / "link"
        link.symlink_to("nowhere")
        self.assertEqual(self.refused(link), f"--out {link} is a link to nowhere, which is not there; make that folder, or name another")
        self.assertFalse((self.folder / "nowhere").exists())

    def test_a_file_is_named_also_on_the_way(self):
        file = self.folder / "file"
        file.touch()
        self.assertIn(f"--out {file} is a file; name a folder", self.refused(file))
        self.assertIn(f"--out {file}/a/b: {file} is a file; name a folder", self.refused(file / "a" / "b"))

    def test_who_may_not_write_has_made_a_mistake_and_a_full_disk_is_none(self):
        for number, code in ((errno.EACCES, 2), (errno.EROFS, 2), (errno.ENOSPC, OUTPUT_FAILED), (errno.EIO, OUTPUT_FAILED)):
            error = OSError(number, os.strerror(number), str(self.folder / "run"))
            with mock.patch.object(Path, "mkdir", side_effect=error):
                self.assertIn(os.strerror(number), self.refused(self.folder / "run", code))

    def test_of_two_runs_that_begin_at_the_same_moment_one_is_refused(self):
        with mock.patch.object(folder, "_expect_free"):     # both have looked before either has begun
            folder.make(str(self.folder / "run"), "piston", False, self.until)
            self.assertEqual(self.refused(self.folder / "run"), f"--out {self.folder / 'run'}: another command is at work there; name another folder, or wait for its end")
            self.until.close()
            self.assertIn("another run is beginning there", self.refused(self.folder / "run"))

    def test_a_file_system_without_locks_takes_runs_as_any_other(self):
        for number in (errno.ENOLCK, errno.EBADF, errno.ENOTSUP):
            with mock.patch.object(fcntl, "flock", side_effect=OSError(number, os.strerror(number))):
                directory, _ = folder.make(str(self.folder / str(number)), "piston", False, self.until)
                self.assertTrue((directory / "log").is_dir())

    def begun(self, leave=lambda directory: None, error=UserMistake("no"), out="a/b/run"):
        """What is left of the folder of a run that ends by `error`, after `leave(directory)`."""
        directory, made = folder.make(str(self.folder / out), "piston", False, self.until)
        with self.assertRaises(type(error)), folder.kept_if_begun(directory, made):
            (directory / "case.yaml").write_text("name: piston\n", encoding="utf-8")
            leave(directory)
            raise error
        return sorted(str(path.relative_to(self.folder)) for path in self.folder.rglob("*") if path.is_file() or not any(path.iterdir()))

    def test_a_refused_run_leaves_no_folder(self):
        for error in (UserMistake("no"), Failure(1, "no"), OSError(errno.ENOSPC, "full")):
            self.assertEqual(self.begun(error=error), [])

    def test_what_was_there_before_stays(self):
        (self.folder / "run").mkdir()
        self.assertEqual(self.begun(out="run"), ["run"])

    def test_what_others_have_put_there_stays(self):
        self.assertIn("a/b/run/notes.txt", self.begun(lambda directory: (directory / "notes.txt").touch()))

    def test_words_of_a_program_stay(self):
        self.assertIn("a/b/run/log/fluid.out", self.begun(lambda directory: (directory / "log" / "fluid.out").write_text("error: no")))

    def test_a_request_to_end_leaves_all(self):
        self.assertEqual(self.begun(error=KeyboardInterrupt()), ["a/b/run/case.yaml", "a/b/run/log"])


class Replaced(Making):
    """What --overwrite replaces is there until the programs of the new run start, at whatever moment the launcher ends."""

    def setUp(self):
        super().setUp()
        self.run = self.folder / "run"
        for path, content in (("case.yaml", "old"), ("log/fluid.log", "old"), ("fields/fluid_000000.h5", "old"), ("summary.json", "old")):
            (self.run / path).parent.mkdir(parents=True, exist_ok=True)
            (self.run / path).write_text(content)
        self.before = self.found()

    def found(self):
        return {str(path.relative_to(self.run)): path.read_text() if path.is_file() else None for path in self.run.rglob("*")}

    def begin(self):
        folder.make(str(self.run), "piston", True, self.until)
        (self.run / "case.yaml").write_text("new")
        (self.run / "log" / "fluid.out").touch()

    def test_a_run_that_is_refused_puts_it_back(self):
        for error in (UserMistake("no"), OSError(errno.ENOSPC, "full"), KeyboardInterrupt()):
            with self.assertRaises(type(error)), self.until:
                self.begin()
                self.assertFalse((self.run / "summary.json").exists())
                raise error
            self.assertEqual(self.found(), self.before)

    def test_a_folder_that_cannot_be_cleared_puts_it_back(self):
        rename, moved = Path.rename, []

        def fail(path, target):
            moved.append(path)
            if len(moved) == 3:
                raise OSError(errno.EBUSY, "a disk of its own", str(path))
            return rename(path, target)
        with self.assertRaises(Failure), mock.patch.object(Path, "rename", fail), self.until:
            self.begin()
        self.assertEqual(self.found(), self.before)

    def killed(self, moment):
        """As a launcher leaves it that is killed at this moment."""
        aside = self.run / replaced.ASIDE
        if moment == "before":
            return
        if moment == "half aside":
            aside.mkdir()
            (self.run / "case.yaml").rename(aside / "case.yaml")
        else:
            self.begin()
            (self.run / "case.yaml.part").touch()
        if moment == "half back":
            (self.run / "case.yaml").unlink()
            (aside / "case.yaml").rename(self.run / "case.yaml")

    def test_after_a_launcher_that_was_killed_it_is_found_and_no_stranger(self):
        for moment in ("before", "half aside", "aside", "half back"):
            with self.subTest(moment):
                self.killed(moment)
                self.until.close()
                with self.assertRaisesRegex(UserMistake, "--overwrite"), self.until:
                    folder.make(str(self.run), "piston", False, self.until)
                (self.run / "case.yaml.part").unlink(missing_ok=True)
                self.assertEqual(self.found(), self.before)
                with self.assertRaises(KeyboardInterrupt), self.until:
                    self.begin()
                    raise KeyboardInterrupt
                self.assertEqual(self.found(), self.before)

    def test_a_restart_finds_it_too(self):
        self.killed("aside")
        self.until.close()
        (self.run / "case.yaml").unlink()
        with self.assertRaisesRegex(UserMistake, "has no checkpoint"):
            restart.expect_run(self.run)
        (self.run / "case.yaml.part").unlink()
        self.assertEqual(self.found(), self.before)

    def test_it_is_gone_once_the_programs_start(self):
        with self.assertRaises(KeyboardInterrupt), self.until:
            self.begin()
            replaced.drop(self.run)
            raise KeyboardInterrupt
        self.assertEqual(self.found(), {"case.yaml": "new", "log": None, "log/fluid.out": ""})


if __name__ == "__main__":
    unittest.main()
