#!/usr/bin/python3
"""summary.json is merged from what the programs leave, and the case's expectations are held against it."""

import dataclasses
import errno
import json
import os
import sys
import unittest
from pathlib import Path
from unittest import mock

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from launcher import InScratch, piston  # noqa: E402
from fsi_launch import run  # noqa: E402
from fsi_launch.failure import Failure, NUMBERS_BROKE, OUTPUT_FAILED  # noqa: E402
from amp_fsi.results import Run  # noqa: E402
from fsi_launch.plot.reading import data  # noqa: E402
from fsi_launch.results import probes, summary  # noqa: E402
from fsi_launch.case import Case  # noqa: E402


class Advice(unittest.TestCase):
    def test_another_projection_is_advised_and_not_promised_after_the_traditional_one_broke(self):
        self.assertRegex(run.advice_after(NUMBERS_BROKE, "traditional"), "projection=simplified may not$")
        for code, projection in ((NUMBERS_BROKE, "simplified"), (0, "traditional")):
            self.assertEqual(run.advice_after(code, projection), "")


class Finishing(unittest.TestCase):
    """What the launcher adds when the programs have ended."""

    def finished(self, **ends):
        """(the first failure, what was tried) where some of it ends so."""
        tried = []

        def act(name):
            def add(*_):
                tried.append(name)
                if name in ends:
                    raise ends[name]
            return add
        with mock.patch.object(run.probes, "merge", act("probes")), mock.patch.object(run, "_write_xdmf", act("xdmf")), \
                mock.patch.object(run, "_write_exact", act("exact")):
            return run._finish(piston(), Path("DIR")), tried

    def test_one_that_fails_keeps_none_of_the_others_from_being_written_and_the_first_is_told(self):
        full = OSError(errno.ENOSPC, "No space left on device", "DIR/probes.csv")
        failure, tried = self.finished(probes=full, exact=Failure(OUTPUT_FAILED, "reference_exact failed"))
        self.assertEqual((failure.code, tried), (OUTPUT_FAILED, ["probes", "xdmf", "exact"]))
        self.assertRegex(str(failure), "^cannot write DIR/probes.csv: No space left on device; ")
        self.assertEqual(str(self.finished(xdmf=Failure(OUTPUT_FAILED, "no xdmf"))[0]), "no xdmf")
        self.assertEqual(self.finished(), (None, ["probes", "xdmf", "exact"]))


class Summary(InScratch):
    def part(self, name, **content):
        (self.folder / "parts").mkdir(exist_ok=True)
        (self.folder / "parts" / f"{name}.json").write_text(json.dumps({"participant": name} | content))

    def merged(self, status="completed"):
        return summary.merge(summary.read_parts(self.folder, piston().programs), piston(), status, "", 1.0)

    def test_coupler_tells_time_and_steps(self):
        self.part("fluid", steps=9, t=0.7)
        self.part("coupler", steps=10, t=0.8, dt_min=0.05, dt_max=0.1, interface={"max_gap": 1e-6},
                  dt_limited_by={"fluid": 8, "time.growth": 2})
        merged = self.merged()
        self.assertEqual((merged["t"], merged["steps"], merged["dt"]), (0.8, 10, {"min": 0.05, "max": 0.1, "limited_by": {"fluid": 8, "time.growth": 2}}))
        self.assertIn("step limited by: fluid 80 %, time.growth 20 %", summary.describe(merged, self.folder))
        self.assertEqual(merged["interface"], {"max_gap": 1e-6})

    def test_programs_that_left_nothing_came_as_far_as_they_last_said_or_as_their_table_goes(self):
        def merged(told, begun_from=None):
            found = summary.merge({}, piston(), "failed", "", 1.0, summary.last_known(self.folder, told, begun_from))
            return found["t"], found["steps"]
        self.assertEqual(merged(None), (0, 0))
        said, checkpoint = {"t": 0.25, "steps": 5}, {"t": 0.1, "steps": 2}
        self.assertEqual(merged(said), (0.25, 5))
        (self.folder / "interface.csv").write_text("step,t [time],a.gap [length]\n0,0,0\n8,0.4,1e-9\n")
        self.assertEqual(merged(said), (0.4, 8))
        self.assertEqual(merged({"t": 0.5, "steps": 10}), (0.5, 10))
        self.assertEqual(merged(None, checkpoint), (0.1, 2))    # the table is of the former run
        self.assertEqual(merged(said, checkpoint), (0.4, 8))

    def test_end_that_the_case_wanted_stands_beside_the_time_reached(self):
        self.part("coupler", steps=3, t=0.1)
        case = dataclasses.replace(piston(), end=0.8)
        merged = summary.merge(summary.read_parts(self.folder, case.programs), case, "failed", "", 1.0)
        self.assertEqual((merged["t"], merged["t_end"]), (0.1, 0.8))

    def test_program_without_a_report_that_ended_well_is_not_lost(self):
        for status, done, expected in (("completed", ["solid"], "completed"), ("completed", [], "lost"), ("failed", ["solid"], "lost")):
            merged = summary.merge({}, piston(), status, "", 1.0, done=done)
            self.assertEqual(merged["participants"]["solid"]["status"], expected)

    def test_who_limited_next_to_no_step_is_not_worth_a_word(self):
        self.assertEqual(summary.limiters({"time.growth": 2, "fluid": 996, "beam": 0, "output.times": 9}), "fluid 99 %, output.times 1 %")
        self.assertEqual(summary.limiters({}), "")

    def test_errors_of_all_programs_in_the_papers_order(self):
        self.part("solid", errors={"P_bar": 3e-5, "u_bar": 1e-4})
        self.part("fluid", errors={"T": 1e-6, "rho": 2e-5})
        self.assertEqual(list(self.merged()["errors"]), ["rho", "T", "u_bar", "P_bar"])

    def test_counters_add_up(self):
        self.part("solid", counters={"floors": 2})
        self.part("fluid", counters={"floors": 3, "first_order_fallbacks": 1})
        self.assertEqual(self.merged()["counters"], {"first_order_fallbacks": 1, "floors": 5})

    def test_worst_noise_of_all_programs_is_told_with_its_place_where_it_is_much(self):
        ripple = {"field": "v1", "grid": "outline", "point": [3, 40], "place": [0.25, 1.5], "t": 6.5}
        self.part("fluid", noise={"value": 0.004, "noisy": False} | ripple)
        self.assertNotIn("warning", summary.describe(self.merged(), self.folder))
        self.part("solid", noise={"value": 0.041, "noisy": True} | ripple)
        merged = self.merged()
        self.assertEqual(merged["noise"], {"value": 0.041, "participant": "solid", "noisy": True} | ripple)
        self.assertIn('warning: noise of the grid\'s scale: v1 of solid ripples by 4.1 % of its range, grid "outline", point (3, 40)'
                      ' at (0.25, 1.5), t = 6.5', summary.describe(merged, self.folder))

    def test_grids_that_disagree_are_told_with_their_place_where_they_do_much(self):
        place = {"field": "v1", "grid": "ring", "point": [20, 3], "place": [0.25, 1.5], "t": 6.5}
        self.part("fluid", disagreement={"value": 0.19, "large": False} | place)
        self.assertNotIn("warning", summary.describe(self.merged(), self.folder))
        self.part("fluid", disagreement={"value": 0.52, "large": True} | place)
        merged = self.merged()
        self.assertEqual(merged["disagreement"], {"value": 0.52, "participant": "fluid", "large": True} | place)
        self.assertIn('warning: grids disagree where they overlap: v1 of fluid differs by 52 % of its range between grid "ring", point (20, 3)'
                      " at (0.25, 1.5), and the background, t = 6.5", summary.describe(merged, self.folder))

    def test_overlap_is_told_where_it_was_poor_and_only_there(self):
        sound = {"amplification": 2.9, "implicit": 40, "narrowed": 0, "lines_left_out": 0,
                 "grid": "ring", "point": [3, 6], "place": [0.25, 1.5], "t": 0.5}
        self.part("fluid", overlap=sound)
        self.part("body", overlap=sound | {"amplification": 1.0})
        merged = self.merged()
        self.assertEqual(merged["overlap"], {"fluid": sound})  # `body` is none of the piston's programs
        self.assertNotIn("overlap", summary.describe(merged, self.folder))
        self.part("fluid", overlap=sound | {"amplification": 41.5, "narrowed": 7, "lines_left_out": 3})
        self.assertIn('overlap of fluid\'s grids: interpolation amplified errors 41.5 times (sound: 3.125), grid "ring", point (3, 6) at '
                      "(0.25, 1.5), t = 0.5; 7 points with fewer donors; 3 grid lines left out", summary.describe(self.merged(), self.folder))
        self.part("fluid", overlap=sound | {"amplification": None})
        self.assertIn("amplified errors", summary.describe(self.merged(), self.folder))

    def test_a_gas_that_misses_mass_is_told_with_how_much(self):
        def said(**totals):
            return "\n".join(summary.mass_lines({"conservation": {"air": totals, "bar": {"mass": 0.0}}}))
        self.assertIn("the mass of air is off by 52 % of what it was at the start", said(mass_defect=-0.26, mass_initial=0.5))
        self.assertIn("the mass of air is off by 6 %", said(mass_defect=0.03, mass_initial=0.5))
        for totals in ({"mass_defect": 0.02, "mass_initial": 0.5}, {"mass_defect": None, "mass_initial": None}, {"mass_defect": 1.0}, {}):
            self.assertEqual(said(**totals), "")
        self.part("fluid", conservation={"mass_defect": -1.0, "mass_initial": 2.0})
        self.assertIn("warning: the mass of fluid is off by 50 %", summary.describe(self.merged(), self.folder))

    def test_a_body_that_turns_is_told_what_its_linear_law_makes_of_it(self):
        def said(angles, program="solid_solver_linear_elastic"):
            (self.folder / "forces_flap.csv").write_text("t [time],angle [rad]\n" + angles)
            return "\n".join(summary.turned_lines({"participants": {"flap": {"program": program}, "air": {}}}, self.folder))
        self.assertIn("flap has turned by 5.7 degrees, which its law, linear_elastic, takes for a strain; saint_venant_kirchhoff", said("0,0\n1,-0.1\n2,0.01\n"))
        self.assertIn("by 5.7 degrees", said("0,0.1\n1,3.2"))    # of 3.2e-5, when the run ended
        self.assertIn("by 114.6 degrees", said("0,2\n"))
        for silent in (said("0,0.04\n"), said(""), said("0,\0\n"), said("0,0.1\n", program="solid_solver_neo_hookean")):
            self.assertEqual(silent, "")
        (self.folder / "forces_flap.csv").unlink()
        self.assertEqual(summary.turned_lines({"participants": {"flap": {"program": "solid_solver_linear_elastic"}}}, self.folder), [])

    def test_solids_that_miss_momentum_are_told_with_how_much(self):
        def said(**totals):
            return "\n".join(summary.momentum_lines({"conservation": {"bar": totals, "fluid": {"momentum1_defect": 3, "momentum2_defect": 4}}}))
        self.assertIn("the momentum of bar is off by 50 % of what the gas gave it", said(momentum1_defect=-3, momentum2_defect=4, momentum_scale=10))
        self.assertEqual(said(momentum1_defect=0.3, momentum2_defect=0.4, momentum_scale=10.1), "")
        self.assertEqual(said(momentum1_defect=1, momentum2_defect=1, momentum_scale=0), "")
        self.assertEqual(said(momentum1_defect=None, momentum2_defect=None, momentum_scale=None), "")
        self.assertEqual(summary.momentum_lines({}), [])

    def test_momentum_that_is_round_off_of_the_pressure_is_not_missed(self):
        """Of a cylinder of steel, 0.1 m thick, in air at rest, where forces, and what they are compared with, are nothing but round-off."""
        at_rest = {"momentum1_defect": 1.2573806728197344e-16, "momentum2_defect": 9.323307014525841e-17, "momentum_scale": 1.0924635452382367e-15}
        run = {"t": 0.0012, "interface": {"traction_scale": 101325, "velocity_scale": 340.3}}
        self.assertEqual(summary.momentum_lines(run | {"conservation": {"body": at_rest}}), [])
        self.assertEqual(len(summary.momentum_lines(run | {"t": 0.0, "conservation": {"body": at_rest}})), 1)     # what it would say
        for size in (1e-6, 1e3):                    # far above it
            moved = {key: value / at_rest["momentum_scale"] * size for key, value in at_rest.items()}
            self.assertEqual(len(summary.momentum_lines(run | {"conservation": {"body": moved}})), 1)

    def test_jumps_are_said_to_be_before_the_projection_and_have_a_scale(self):
        self.part("coupler", interface={"max_velocity_jump": 67.3, "max_traction_jump": 7.3e6, "max_gap": 1e-6,
                                        "velocity_scale": 673.0, "traction_scale": 1e7})
        words = summary.describe(self.merged(), self.folder)
        self.assertIn("before the projection: velocity 6.73e+01 (10 % of the gas's speed, 673), traction 7.30e+06 (73 % of", words)

    def test_percentages_are_as_people_write_them(self):
        for part, said in ((1.0, "100 %"), (0.996, "100 %"), (73.0, "7300 %"), (12345, "1200000 %"), (0.1, "10 %"), (0.095, "9.5 %"), (0.0996, "10 %"),
                           (0.02, "2 %"), (5.2e-6, "0.00052 %"), (1e-8, "0.000001 %"), (1.8e-16, "less than 1e-6 %"), (0.0, "0 %")):
            self.assertEqual(summary.percent(part), said)
        self.part("coupler", interface={"max_velocity_jump": 2.0, "max_traction_jump": 1.8e-16, "velocity_scale": 2.0, "traction_scale": 1.0})
        self.assertRegex(summary.describe(self.merged(), self.folder), r"\(100 % of the gas's speed.*\(less than 1e-6 % of the gas's pressure")

    def test_program_that_left_nothing_is_lost(self):
        self.part("coupler", steps=3, t=0.1)
        merged = self.merged("failed")
        self.assertEqual(merged["participants"]["solid"]["status"], "lost")
        self.assertIn("piston failed", summary.describe(merged, self.folder))

    def test_run_without_any_part_still_has_a_summary(self):
        merged = self.merged("failed")
        summary.write(self.folder, merged)
        self.assertEqual(json.loads((self.folder / "summary.json").read_text())["status"], "failed")


class Probes(InScratch):
    def write(self, name, text):
        (self.folder / "parts").mkdir(exist_ok=True)
        (self.folder / "parts" / f"probes_{name}.csv").write_text(text)

    def test_tables_of_all_programs_become_one(self):
        self.write("fluid", "t [time],a.p\n0,1\n0.5,2\n")
        self.write("solid", "t [time],b.u1,b.u2\n0,3,4\n0.5,5,6\n")
        probes.merge(self.folder, ["fluid", "solid", "coupler"])
        self.assertEqual((self.folder / "probes.csv").read_text(), "t [time],a.p,b.u1,b.u2\n0,1,3,4\n0.5,2,5,6\n")

    def test_program_that_was_killed_leaves_gaps(self):
        self.write("fluid", "t [time],a.p\n0,1\n0.5,2\n")
        self.write("solid", "t [time],b.u1\n0,3\n")
        probes.merge(self.folder, ["fluid", "solid"])
        self.assertEqual((self.folder / "probes.csv").read_text(), "t [time],a.p,b.u1\n0,1,3\n0.5,2,\n")

    def test_a_table_without_room_is_named_and_leaves_none_of_it(self):
        self.write("fluid", "t [time],a.p\n0,1\n")
        with mock.patch.object(os, "replace", side_effect=OSError(errno.ENOSPC, "No space left")):
            with self.assertRaises(OSError) as caught:
                probes.merge(self.folder, ["fluid"])
        self.assertEqual((caught.exception.errno, caught.exception.filename), (errno.ENOSPC, str(self.folder / "probes.csv")))
        self.assertEqual([path.name for path in self.folder.iterdir()], ["parts"])

    def test_run_without_probes_has_no_table(self):
        probes.merge(self.folder, ["fluid"])
        self.assertEqual(list(self.folder.iterdir()), [])
        self.assertFalse(probes.in_parts(self.folder))

    def test_parts_are_what_there_is_until_the_run_has_ended(self):
        """That of a run before a restart is no table of the one that goes on."""
        (self.folder / "case.yaml").touch()
        run = Run(self.folder)
        with self.assertRaisesRegex(KeyError, "no table 'probes'"):
            run.table("probes")
        self.write("fluid", "t [time],a.p\n0,1\n0.5,2\n1,3\n")
        self.write("solid", "t [time],b.u1\n0,3\n")
        (self.folder / "probes.csv").write_text("t [time],a.p,b.u1\n0,7,7\n0.5,7,7\n")
        for table in (run.table("probes"), data.all_tables(self.folder)[0].columns):
            self.assertEqual((table["a.p"].tolist(), table["b.u1"].tolist()[0]), ([1, 2, 3], 3))
        (self.folder / "summary.json").write_text("{}")
        for table in (run.table("probes"), data.all_tables(self.folder)[0].columns):
            self.assertEqual(table["a.p"].tolist(), [7, 7])
        self.assertEqual(len(data.all_tables(self.folder)), 1)


class ForPeople(unittest.TestCase):
    """What is printed at the end of a run fits the terminal and says what matters most."""

    def setUp(self):
        part = {"points": 12345678, "substeps": 123456, "compute_s": 1234.5, "wait_s": 1234.5, "point_updates_per_s": 1.2e8, "peak_memory_mib": 1234}
        self.summary = {
            "case": "a_case_of_ones_own", "status": "completed", "t": 0.123456, "steps": 123456, "dt": {"min": 1.23e-7, "max": 2.34e-5}, "wall_s": 2469.12,
            "participants": {"fluid": {"program": "fluid_solver"} | part, "body": {"program": "solid_solver_saint_venant_kirchhoff"} | part,
                             "coupler": {"program": "coupler"} | part},
            "errors": {name: 1.23e-5 for name in summary.ERROR_ORDER},
            "interface": {"max_velocity_jump": 1.0, "max_traction_jump": 2.0, "velocity_scale": 10.0, "traction_scale": 10.0, "max_gap": 1e-9},
            "counters": {"floors": 3}, "expectations": [{"met": True}]}

    def lines(self, width):
        return summary.describe(self.summary, "runs/somewhere", width).splitlines()

    def test_no_line_is_longer_than_the_terminal(self):
        for width in range(50, 140, 3):
            self.assertLessEqual(max(map(len, self.lines(width)[:-1])), width)

    def test_sixty_columns_keep_steps_time_memory_and_all_errors(self):
        text = "\n".join(self.lines(60))
        for words in ("123456", "2469.12 s", "1234 MiB", "own steps", *summary.ERROR_ORDER):
            self.assertIn(words, text)

    def test_nothing_is_left_away_where_there_is_no_terminal(self):
        text = "\n".join(self.lines(None))
        for words in ("updates", "waiting", "computing", "points", "memory", "20 % of the gas's pressure"):
            self.assertIn(words, text)

    def test_counters_that_are_not_zero_and_not_routine_are_told(self):
        self.summary["counters"] |= {"first_order_fallbacks": 0.0, "bounded_side_points": 7.0}
        self.assertEqual([line for line in self.lines(None) if "counters" in line], ["  counters: floors 3"])
        self.summary["counters"]["floors"] = 0.0
        self.assertNotIn("counters", "\n".join(self.lines(None)))

    def test_a_body_without_stress_has_no_jump_of_it(self):
        self.summary["interface"]["max_traction_jump"] = 0.0
        self.assertNotIn("traction", "\n".join(self.lines(None)))
        self.assertIn("velocity 1.00e+00", "\n".join(self.lines(None)))


class Expectations(unittest.TestCase):
    def missed(self, entry, **content):
        return summary.missed_expectations(content, [entry])

    def test_bounds(self):
        self.assertEqual(self.missed({"quantity": "errors.rho", "max": 1e-4}, errors={"rho": 9e-5}), [])
        missed = self.missed({"quantity": "errors.rho", "max": 1e-4}, errors={"rho": 2e-4})
        self.assertEqual(missed, ["check failed: errors.rho = 0.0002, must be at most 0.0001"])
        self.assertEqual(len(self.missed({"quantity": "t", "min": 1.0, "max": 2.0}, t=0.5)), 1)

    def test_word(self):
        self.assertEqual(self.missed({"quantity": "status", "equals": "completed"}, status="completed"), [])
        self.assertEqual(len(self.missed({"quantity": "status", "equals": "completed"}, status="failed")), 1)

    def test_equal_numbers_however_they_are_written(self):
        for wanted, missed in (("0", 0), ("0.0", 0), ("1", 1), ("none", 1)):
            self.assertEqual(len(self.missed({"quantity": "counters.floors", "equals": wanted}, counters={"floors": 0.0})), missed)

    def test_missing_or_not_finite_is_missed(self):
        self.assertEqual(len(self.missed({"quantity": "errors.rho", "max": 1})), 1)
        self.assertEqual(len(self.missed({"quantity": "errors.rho", "max": 1}, errors={"rho": None})), 1)
        self.assertEqual(len(self.missed({"quantity": "errors.rho", "max": 1}, errors={"rho": float("nan")})), 1)


if __name__ == "__main__":
    unittest.main()
