#!/usr/bin/python3
"""Studies: what is varied, which runs that makes, what is read from them."""

import io
import json
import math
import os
import sys
import unittest
from pathlib import Path
from types import SimpleNamespace
from unittest import mock

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
import launcher  # noqa: E402
from fsi_launch import version  # noqa: E402
from fsi_launch.command import verbs  # noqa: E402
from fsi_launch.studies import study  # noqa: E402
from fsi_launch.failure import UserMistake  # noqa: E402


class Folders(unittest.TestCase):
    def test_names_are_as_long_as_files_can_have_them(self):
        long, other = ("1" + "+0*x" * 100, "1" + "+0*x" * 99 + "+0*y")
        names = [study._folder_name({"fluid.initial.p": value}, {"fluid.initial.p": "p"}) for value in ("1", long, other, "ä" * 300)]
        self.assertEqual(names[0], "p=1")
        self.assertEqual(len(set(names)), 4)
        self.assertTrue(all(len(os.fsencode(name)) < 255 for name in names))


class Values(unittest.TestCase):
    def test_list_is_split_at_its_commas(self):
        self.assertEqual(study.values_of("parameters.rho_bar=0.1, 1,10"), ("parameters.rho_bar", ["0.1", "1", "10"]))

    def test_commas_within_brackets_belong_to_a_value(self):
        self.assertEqual(study.values_of("centre=[0, 1],[2, 3]"), ("centre", ["[0, 1]", "[2, 3]"]))

    def test_what_is_no_list_is_a_mistake(self):
        for text in ("rho", "rho=", "=1", "rho=1,,2"):
            with self.subTest(text), self.assertRaisesRegex(UserMistake, "KEY=VALUE"):
                study.values_of(text)


class Command(unittest.TestCase):
    def test_what_is_shown_may_be_said_in_several_options(self):
        words = ["study", "beam", "--vary", "a=1", "--show", "steps,t", "--show", "wall_s"]
        self.assertEqual(verbs.parser().parse_args(words).show, ["steps", "t", "wall_s"])


class Trials(unittest.TestCase):
    def test_all_combinations_have_a_folder_each(self):
        found = study.trials({"a.x": ["1", "2"], "b.y": ["u/v", "w"]}, "out")
        self.assertEqual([trial.name() for trial in found], ["x=1,y=u_v", "x=1,y=w", "x=2,y=u_v", "x=2,y=w"])

    def test_keys_that_end_alike_are_told_apart(self):
        (trial,) = study.trials({"a.x": ["1"], "b.x": ["2"]}, "out")
        self.assertEqual(trial.name(), "a.x=1,b.x=2")

    def test_one_value_twice_is_a_mistake(self):
        with self.assertRaises(UserMistake):
            study.trials({"a": ["1", "1"]}, "out")


class Quantities(launcher.InScratch):
    def trial(self, summary, table=None):
        trial = study.Trial({"a": "1"}, self.folder, summary=summary)
        if table:
            Path(self.folder, "forces_disk.csv").write_text(table, encoding="utf-8")
        return trial

    def test_summary_and_tables(self):
        trial = self.trial({"errors": {"rho": 0.25}, "status": "completed"}, "t [time],angle [rad]\n0,1\n1,-2\n2,0.5\n")
        for name, value in (("errors.rho", 0.25), ("forces_disk.angle", 0.5), ("forces_disk.angle:max", 1), ("forces_disk.angle:min", -2),
                            ("errors.none", None), ("status", None), ("forces_disk.none", None)):
            with self.subTest(name):
                self.assertEqual(study.quantity(trial, name), value)

    def test_what_is_no_finite_number_has_an_empty_cell_and_is_left_out_of_the_largest_and_smallest(self):
        trial = self.trial({"errors": {"rho": math.nan}, "status": "completed"},
                           "t [time],dt,limited_by,broke\n0,nan,none,1\n1,-2,fluid,inf\n2,0.5,fluid,\n3,,\n")
        for name, value in (("forces_disk.dt:max", 0.5), ("forces_disk.dt:min", -2), ("forces_disk.dt", None), ("forces_disk.limited_by", None),
                            ("forces_disk.limited_by:max", None), ("forces_disk.broke:max", 1), ("errors.rho", None)):
            with self.subTest(name):
                self.assertEqual(study.quantity(trial, name), value)
        result = study.result_of([trial], "c", {"a": ["1"]}, ["errors.rho", "forces_disk.limited_by"])
        self.assertEqual(study._rows(result)[1][-2:], ["-", "-"])
        json.dumps(result, allow_nan=False)

    def test_columns_have_the_units_of_their_headings(self):
        trial = self.trial({"errors": {"rho": 0.25}, "status": "completed"}, "t [time],force1 [force/depth],limited_by\n0,1,none\n")
        wanted = ["forces_disk.force1:max", "forces_disk.limited_by", "errors.rho", "forces_none.t"]
        self.assertEqual(study.result_of([trial], "c", {"a": ["1"]}, wanted)["units"], dict(zip(wanted, ("force/depth", "", "", ""))))

    def test_table_shows_errors_or_else_bodies(self):
        trial = self.trial({"errors": {"rho": 0.25}, "status": "completed"}, "t [time],angle [rad]\n0,1\n")
        self.assertEqual(study.result_of([trial], "c", {"a": ["1"]}, [])["quantities"], ["errors.rho"])
        trial.summary = {"status": "failed"}
        self.assertEqual(study.result_of([trial], "c", {"a": ["1"]}, [])["rows"][0]["quantities"]["forces_disk.angle"], 1)


class Unused(unittest.TestCase):
    def test_a_parameter_that_no_trial_needs_is_a_mistake(self):
        found = [SimpleNamespace(case=SimpleNamespace(unused=names)) for names in (("a",), ("a", "b"))]
        for vary in ({"parameters.b": ["1", "2"]}, {"grid.a": ["1"]}):
            study._expect_used(vary, found)
        with self.assertRaisesRegex(UserMistake, "--vary parameters.a: .* all runs would be alike"):
            study._expect_used({"parameters.b": ["1"], "parameters.a": ["1", "2"]}, found)


class Again(launcher.InScratch):
    def finished(self, build):
        """Whether a completed run of this build of the programs is not made again."""
        (self.folder / "case.yaml").write_text("name: c\n")
        (self.folder / "summary.json").write_text(json.dumps({"status": "completed"} | ({"build": build} if build else {})))
        return study._finished(study.Trial({"a": "1"}, self.folder, SimpleNamespace(text="name: c\n")))

    def test_only_runs_of_these_programs_are_there_already(self):
        self.assertTrue(self.finished(version.built()))
        self.assertFalse(self.finished(version.built() | {"commit": "0" * 40}))
        self.assertFalse(self.finished(None))

    def test_two_that_begin_in_the_same_second_have_a_folder_each(self):
        before = Path.cwd()
        self.addCleanup(os.chdir, before)
        os.chdir(self.folder)
        with mock.patch.object(study.time, "strftime", lambda _: "now"):
            self.assertEqual([str(study._made(None, "c")) for _ in range(3)], ["runs/study-c-now", "runs/study-c-now-2", "runs/study-c-now-3"])
        self.assertEqual([str(study._made("mine", "c")) for _ in range(2)], ["mine"] * 2)

    def test_a_picture_of_another_table_is_gone(self):
        (self.folder / "study.png").touch()
        study._draw({"case": "c", "vary": {"a": ["x", "y"]}, "quantities": [], "rows": []}, self.folder, [])
        self.assertFalse((self.folder / "study.png").exists())


class FormerResults(launcher.InScratch):
    """A run of a study that leaves nothing of its own, or not all, in a folder that holds another one's results."""

    OPTIONS = SimpleNamespace(case="c", overrides=[], laws=[], jobs=1, show=[])

    def made(self, code, said="", leave=lambda folder: None):
        """The trial after its run, which says this, leaves this and ends so."""
        (self.folder / "summary.json").write_text(json.dumps({"status": "completed", "errors": {"rho": 0.25}}))
        for name in ("forces_a", "forces_b"):
            (self.folder / f"{name}.csv").write_text("t [time],angle [rad]\n0,1\n1,2\n")
        trial = study.Trial({"a": "1"}, self.folder)

        def run(*_, **__):
            leave(self.folder)
            return SimpleNamespace(returncode=code, poll=lambda: code, stderr=io.StringIO(said))
        with mock.patch.object(study, "leashed", lambda command: command), mock.patch.object(study, "tell"), \
                mock.patch.object(study.subprocess, "Popen", run):
            study._make([trial], self.OPTIONS, 0, 1)
        return trial

    def row(self, trial):
        return study.result_of([trial], "c", {"a": ["1"]}, [])["rows"][0]

    def test_are_not_those_of_a_run_that_is_refused_and_its_reason_is_told(self):
        trial = self.made(2, "a warning\nfsi: c.yaml:3: no such key\n")
        self.assertEqual((trial.code, trial.summary), (2, {"status": "failed", "reason": "c.yaml:3: no such key"}))
        self.assertEqual(self.row(trial)["quantities"], {})
        self.assertEqual([study.quantity(trial, name) for name in ("errors.rho", "forces_a.angle")], [None, None])

    def test_a_launcher_that_breaks_has_not_missed_an_expectation(self):
        trial = self.made(1, "Traceback ..\nKeyError: 'a'\n")
        self.assertEqual((trial.code, trial.summary["status"], trial.summary["reason"]), (1, "failed", "KeyError: 'a'"))

    def test_of_a_run_that_got_as_far_as_its_tables_these_are_its_own(self):
        def leave(folder):
            (folder / "new").write_text("t [time],angle [rad]\n0,1\n1,7\n")
            (folder / "new").rename(folder / "forces_a.csv")
        self.assertEqual(self.row(self.made(4, "fsi: lost\n", leave))["quantities"], {"forces_a.centre1": None, "forces_a.centre2": None,
                                                                                     "forces_a.angle": 7})

    def test_a_run_that_misses_what_its_case_expects_counts(self):
        def leave(folder):
            (folder / "new").write_text(json.dumps({"status": "completed", "errors": {"rho": 0.5}}))
            (folder / "new").rename(folder / "summary.json")
        trial = self.made(1, "fsi: check failed\n", leave)
        self.assertEqual((trial.code, study.quantity(trial, "errors.rho")), (0, 0.5))


if __name__ == "__main__":
    unittest.main()
