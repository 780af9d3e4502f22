#!/usr/bin/python3
"""Studies: what is varied, which runs that makes, what is read from them."""

import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
import launcher  # noqa: E402
from fsi_launch.studies import study  # noqa: E402
from fsi_launch.failure import UserMistake  # noqa: E402


class Values(unittest.TestCase):
    def test_list_is_split_at_its_commas(self):
        self.assertEqual(study.values_of("parameters.rho_bar=0.1, 1,10"), ("parameters.rho_bar", ["0.1", "1", "10"]))

    def test_commas_within_brackets_belong_to_a_value(self):
        self.assertEqual(study.values_of("centre=[0, 1],[2, 3]"), ("centre", ["[0, 1]", "[2, 3]"]))

    def test_what_is_no_list_is_a_mistake(self):
        for text in ("rho", "rho=", "=1", "rho=1,,2"):
            with self.subTest(text), self.assertRaisesRegex(UserMistake, "KEY=VALUE"):
                study.values_of(text)


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

    def test_table_shows_errors_or_else_bodies(self):
        trial = self.trial({"errors": {"rho": 0.25}, "status": "completed"}, "t [time],angle [rad]\n0,1\n")
        self.assertEqual(study.result_of([trial], "c", {"a": ["1"]}, [])["quantities"], ["errors.rho"])
        trial.summary = {"status": "failed"}
        self.assertEqual(study.result_of([trial], "c", {"a": ["1"]}, [])["rows"][0]["quantities"]["forces_disk.angle"], 1)


if __name__ == "__main__":
    unittest.main()
