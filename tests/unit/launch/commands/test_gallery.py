#!/usr/bin/python3
"""The gallery: its verdicts, what it reads of a run, and that the known numbers obey the laws they come from."""

import json
import math
import sys
import unittest
from pathlib import Path
from unittest import mock

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from launcher import InScratch  # noqa: E402
from fsi_launch import paths  # noqa: E402
from fsi_launch.failure import UserMistake  # noqa: E402
from fsi_launch.gallery import Row, measures, problems  # noqa: E402


class Verdicts(unittest.TestCase):
    def test_within_a_distance_of_the_known_number(self):
        self.assertTrue(Row("a", -1.05, -1.0, 0.1).passes())
        self.assertFalse(Row("a", -1.15, -1.0, 0.1).passes())
        self.assertFalse(Row("a", 1.0, -1.0, 0.1).passes())

    def test_at_most(self):
        self.assertTrue(Row("a", 0.5, None, 1.0).passes())
        self.assertFalse(Row("a", 1.5, None, 1.0).passes())

    def test_what_a_run_lacks_or_cannot_count_fails(self):
        for value in (None, math.nan):
            self.assertFalse(Row("a", value, 1.0, 1.0).passes())
            self.assertFalse(Row("a", value, None, 1.0).passes())


class Measures(InScratch):
    def setUp(self):
        super().setUp()
        (self.folder / "probes.csv").write_text("t [time],tip.u1\n0,0\n1,4\n2,3\n")
        (self.folder / "summary.json").write_text(json.dumps({"errors": {"rho": 0.5}}))

    def test_numbers(self):
        def of(at):
            return measures.number(self.folder, {"table": "probes", "column": "tip.u1", "at": at})
        self.assertEqual([of(at) for at in (0.5, "largest", "time of the largest", "end")], [2, 4, 1, 3])
        self.assertEqual(measures.number(self.folder, {"summary": "errors.rho"}), 0.5)
        self.assertIsNone(measures.number(self.folder, {"summary": "errors.p"}))

    def test_curves_and_their_distance(self):
        curve = measures.curve(self.folder, {"table": "probes", "x": "t", "y": "tip.u1", "scale": 2})
        np.testing.assert_array_equal(curve[1], [0, 2, 1.5])
        known = (np.array([0.0, 2.0]), np.array([0.0, 4.0]))
        self.assertEqual(measures.distance((np.array([0.0, 1.0]), np.array([0.0, 2.0])), known), 0)
        self.assertAlmostEqual(measures.distance((np.array([0.0, 1.0]), np.array([0.4, 2.4])), known), 0.1)
        self.assertEqual(measures.distance((np.array([1.0, 5.0]), np.array([2.0, 99.0])), known), 0)   # beyond what is known


class OtherCodes(InScratch):
    def test_their_curves_are_drawn_where_they_have_the_columns(self):
        from fsi_launch.gallery import picture
        (self.folder / "mine" / "others").mkdir(parents=True)
        (self.folder / "mine" / "others" / "theirs.csv").write_text("# by hand\nt,v\n0,1\n1,2\n")
        problem = problems.Problem("mine", "a problem", "nowhere", "case")
        with mock.patch.object(problems, "FOLDER", self.folder):
            others = {code: measures.reference(path) for code, path in problem.others().items()}
        curve = (np.array([0.0, 1.0]), np.array([1.0, 2.0]))
        curves = [({"what": name, "x": "t", "data": ["t", name], "computed": {"table": "probes"}}, curve, curve) for name in ("v", "u")]
        figure = picture.draw(problem, curves, others)
        self.assertEqual([[line.get_label() for line in axes.get_lines()] for axes in figure.axes[:2]],
                         [["known", "computed", "theirs"], ["known", "computed"]])


class Problems(unittest.TestCase):
    def test_all_are_whole(self):
        self.assertGreaterEqual(len(problems.names()), 8)
        readme = (problems.FOLDER / "README.md").read_text(encoding="utf-8")
        for name in problems.names():
            with self.subTest(name):
                one = problems.problem(name)
                self.assertTrue((paths.ROOT / "configs" / f"{one.case}.yaml").is_file() or one.case.endswith(".yaml"))
                self.assertTrue(one.title and one.source and one.curves)
                self.assertIn(f"| `{name}` |", readme)
                table = measures.reference(one.data())
                for entry in one.curves:
                    self.assertTrue(set(entry["data"]) <= set(table), entry)
                    self.assertTrue((np.diff(table[entry["data"][0]]) > 0).all())
                for entry in one.numbers:
                    self.assertNotEqual("known" in entry, "at_most" in entry)

    def test_unknown_name(self):
        with self.assertRaises(UserMistake) as caught:
            problems.problem("sods")
        self.assertIn("sod", str(caught.exception))


class KnownNumbers(unittest.TestCase):
    """Relations that were not used to find them."""

    def table(self, name):
        return measures.reference(problems.problem(name).data())

    def test_shock_of_sods_tube_conserves_mass_and_momentum(self):
        table = self.table("sod")
        before, behind = ({key: table[key][k] for key in table} for k in (-1, np.searchsorted(table["x"], 0.8)))
        speed = behind["rho"] * behind["v"] / (behind["rho"] - before["rho"])
        self.assertAlmostEqual(behind["p"] - before["p"], before["rho"] * speed * behind["v"], places=6)
        jump = table["x"][np.nonzero(table["rho"] > before["rho"] * 1.01)[0][-1]]
        self.assertAlmostEqual(jump, 0.5 + 0.2 * speed, delta=0.001)

    def test_shock_that_a_wall_throws_back_leaves_gas_at_rest_behind_it(self):
        known = {entry["what"]: entry["known"] for entry in problems.problem("cylinder_in_shock").numbers if "known" in entry}
        p_2, (p_1, rho_1, v_1) = known["largest pressure on the wall at the front"], (4.5 / 1.4, 8 / 3, 1.25)
        rho_2 = rho_1 * (6 * p_2 + p_1) / (p_2 + 6 * p_1)       # Hugoniot curve of air
        speed = rho_1 * v_1 / (rho_2 - rho_1)                   # of the shock that goes back, by the mass it passes
        self.assertAlmostEqual(p_2 - p_1, rho_1 * v_1 * (v_1 + speed), places=3)
        self.assertEqual(sorted(known.values(), reverse=True), list(known.values()))    # the steeper the wall the more

    def test_light_ellipses_begin_at_rest_and_move_as_their_velocity_says(self):
        for name in ("shocked_ellipse", "shocked_rigid_ellipse"):
            table = self.table(name)
            self.assertEqual([table[key][0] for key in ("centre1", "centre2", "velocity1", "angle", "force1")], [-1, 0, 0, 0, 0])
            moved = np.cumsum(0.5 * (table["velocity1"][1:] + table["velocity1"][:-1]) * np.diff(table["t"]))
            np.testing.assert_allclose(table["centre1"][1:] + 1, moved, atol=2e-3)

    def test_vortex_rests_where_it_is_slow(self):
        table = self.table("vortex")
        self.assertAlmostEqual(table["p"][-1], 1 / 1.4, places=9)
        self.assertAlmostEqual(table["p"][0], ((1 - 0.2 * 0.3 ** 2 * math.e) ** 3.5) / 1.4, places=5)    # entropy is constant

    def test_solid_moves_at_the_speed_its_displacement_grows_with(self):
        table = self.table("shock_on_solid")
        moving = table["t"] > 0.06
        np.testing.assert_allclose(np.gradient(table["u"], table["t"])[moving], table["v"][moving], rtol=1e-5)
        stress = {entry["what"]: entry["known"] for entry in problems.problem("shock_on_solid").numbers}["stress there"]
        self.assertAlmostEqual(stress / table["v"][-1], math.sqrt(10 * 120), places=5)    # impedance of the solid

    def test_momentum_of_the_plate_is_that_of_the_pulse_less_what_it_sends_away(self):
        table = self.table("plate")
        impulse = -2 * 0.6 * 3 / 8      # sin^4 is 3/8 in the mean
        sent = np.sum(0.5 * (table["v"][1:] + table["v"][:-1]) * np.diff(table["t"]))
        self.assertAlmostEqual(table["v"][-1], impulse - sent, places=4)

    def test_elastica_is_a_straight_beam_under_small_loads_and_keeps_its_length(self):
        table = self.table("elastica")
        load = 5 * (0.05 - math.sin(0.1 * math.pi) / (2 * math.pi))
        self.assertAlmostEqual(table["u1"][1] / load, 1 / 8, places=3)
        self.assertTrue((np.hypot(table["u1"], 1 + table["u2"]) <= 1 + 1e-9).all())

    def test_piston_moves_as_its_path_says(self):
        table = self.table("elastic_piston")
        np.testing.assert_allclose(np.gradient(table["x"], table["t"])[1:-1], table["v"][1:-1], atol=1e-5)
        small = table["v"] > -1e-3
        np.testing.assert_allclose(table["stress"][small], -table["v"][small], rtol=1e-3, atol=1e-12)     # acoustics: p_e - p = -z v


if __name__ == "__main__":
    unittest.main()
