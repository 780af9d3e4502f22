#!/usr/bin/python3
"""Every shipped case in other units of length, time and density, each a power of two: after some steps all fields and tables are those
of the case itself to the bit, in the other units. So no number in the programs has a dimension of its own.

test_units.py --cases [CASE..]   all cases, or these, with how much differs where
"""

import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import yaml

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from other_units import Rewriting, Units, differences, written  # noqa: E402
from running import BIN, EndToEnd, Launched, ROOT  # noqa: E402

UNITS = Units(length=-3, time=5, density=4)
STEPS = 3

# Distances of points that are chosen here are rounded, to decimal digits in the units of the case: they are taken as chosen.
CHOSEN = {"airfoil", "elastic_wedge", "gas_at_rest", "moving_together_block", "moving_together_corners", "panel_on_step", "shocked_panel_on_step",
          "sprung_foil", "flapping_foil"}
# The reference solution of the rotating disk is that of the disk of radius 1; the run itself is not.
ONE_SIZE = {"rotating_disk"}


def told(verb, path, *options):
    return subprocess.run([BIN / "fsi_case", verb, path, *options], capture_output=True, text=True, check=True, cwd=ROOT).stdout


def shortened(path):
    """A shipped case for a few steps, without what it expects."""
    text = told("resolve", path, "--out", "/dev/stdout") if path.stem in CHOSEN else path.read_text(encoding="utf-8")
    case = yaml.safe_load(text)
    case.pop("expect", None)
    if case.get("reference", {}).get("kind") in ONE_SIZE:
        del case["reference"]
    step = re.search(r"steps? of ([0-9.e+-]+)[;,\s]", told("check", path))   # not known where a case begins with its reference
    end = STEPS * (float(step[1]) if step else 0.05 / case["grid"]["factor"])
    case["time"]["end"] = end
    case["output"] = {**case.get("output", {}), "times": [end / 2, end], "checkpoint_at_end": False}
    case["output"].pop("every", None)
    return case


def start_both(path, scratch):
    """A case as it is shipped, and in other units."""
    case = shortened(path)
    for name in ("shipped", "other"):
        (scratch / name).mkdir()
    for file in path.parent.glob("*.csv"):
        (scratch / "shipped" / file.name).write_bytes(file.read_bytes())
    other = Rewriting(UNITS, path.parent, scratch / "other").whole(case)
    return [Launched(scratch / name, str(written(one, scratch / name / path.name)), "--no-security")
            for name, one in (("shipped", case), ("other", other))]


def compared(runs):
    """What differs, a line each."""
    failed = [run.stderr.strip() for run in runs if run.wait() != 0]
    return failed or differences(*(run.directory for run in runs), UNITS)


def cases():
    return [path for path in sorted((ROOT / "configs").glob("*.yaml")) if path.stem != "template"]


class ShippedCases(EndToEnd):
    def all_the_same(self, part):
        for path in cases()[part::4]:
            with self.subTest(path.stem):
                (self.folder / path.stem).mkdir()
                runs = start_both(path, self.folder / path.stem)
                for run in runs:
                    self.addCleanup(self._end, run)
                self.assertEqual(compared(runs), [])

    def test_first_part(self):
        self.all_the_same(0)

    def test_second_part(self):
        self.all_the_same(1)

    def test_third_part(self):
        self.all_the_same(2)

    def test_fourth_part(self):
        self.all_the_same(3)


class Comparison(EndToEnd):
    def test_a_number_left_in_its_units_is_found(self):
        path = ROOT / "configs" / "sod_tube.yaml"
        whole = Rewriting.value
        Rewriting.value = lambda self, key, value, about: value if key == "p" else whole(self, key, value, about)
        self.addCleanup(setattr, Rewriting, "value", whole)
        self.assertNotEqual(compared(start_both(path, self.folder)), [])


def main(names):
    failed = 0
    for path in cases():
        if names and path.stem not in names:
            continue
        with tempfile.TemporaryDirectory(prefix="fsi-test-") as scratch:
            found = compared(start_both(path, Path(scratch)))
            print(f"{path.stem:25} {'DIFFERENT' if found else 'same'}", *found, sep="\n    ", flush=True)
            failed += bool(found)
    return failed


if __name__ == "__main__":
    if "--cases" in sys.argv:
        sys.exit(1 if main(sys.argv[2:]) else 0)
    unittest.main()
