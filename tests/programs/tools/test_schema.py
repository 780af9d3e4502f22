#!/usr/bin/python3
"""The JSON Schema for editors: every shipped case is valid by it, and mistakes of the usual kinds are not."""

import copy
import json
import subprocess
import sys
import unittest
from pathlib import Path

import jsonschema
import yaml

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from running import BIN, ROOT  # noqa: E402


class Schema(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.schema = schema = json.loads(subprocess.run([BIN / "fsi_case", "schema"], capture_output=True, text=True, check=True).stdout)
        jsonschema.Draft7Validator.check_schema(schema)
        cls.validator = jsonschema.Draft7Validator(schema)
        cls.piston = cls.read(ROOT / "configs" / "elastic_piston.yaml")

    @staticmethod
    def read(path):
        return yaml.safe_load(path.read_text(encoding="utf-8"))

    def mistakes(self, change):
        case = copy.deepcopy(self.piston)
        change(case)
        return [error.message for error in self.validator.iter_errors(case)]

    def test_shipped_cases_are_valid(self):
        for path in sorted((ROOT / "configs").glob("*.yaml")):
            with self.subTest(path.name):
                error = jsonschema.exceptions.best_match(self.validator.iter_errors(self.read(path)))
                self.assertIsNone(error, error and f"{'.'.join(map(str, error.absolute_path))}: {error.message}")

    def test_mistakes_are_seen(self):
        def unknown_key(case):
            case["grid"]["fctor"] = 2

        def unknown_word(case):
            case["solids"]["solid"]["law"] = "neo_hokean"

        def missing_section(case):
            del case["time"]

        def number_out_of_range(case):
            case["time"]["end"] = -1

        def list_for_number(case):
            case["time"]["end"] = [1, 2]

        for change in (unknown_key, unknown_word, missing_section, number_out_of_range, list_for_number):
            with self.subTest(change.__name__):
                self.assertTrue(self.mistakes(change))

    def test_formulas_stand_for_numbers(self):
        def formula(case):
            case["time"]["end"] = "2 * h"
        self.assertEqual(self.mistakes(formula), [])

    def test_as_many_names_as_the_reader_takes(self):
        keys, solid = (self.schema["definitions"][name] for name in ("The case", "A solid"))
        most = {name: keys["properties"][name]["maxProperties"] for name in ("parameters", "definitions", "fluids", "solids", "expect")}
        self.assertEqual(most, {"parameters": 1000, "definitions": 100, "fluids": 16, "solids": 64, "expect": 1000})
        self.assertEqual(solid["properties"]["data"]["maxProperties"], 1000)

    def test_units_are_powers_of_length_time_and_density_and_defaults_are_values(self):
        keys = self.schema["definitions"]["The gas"]["properties"]
        self.assertEqual(keys["p_e"]["x-unit"], {"name": "pressure", "length": 2, "time": -2, "density": 1})
        self.assertEqual((keys["p_e"]["default"], keys["gamma"]["default"]), (0, 1.4))
        self.assertNotIn("x-unit", keys["gamma"])
        interface = self.schema["definitions"]["The interface"]["properties"]
        self.assertEqual(interface["projection"]["default"], "simplified")


if __name__ == "__main__":
    unittest.main()
