#!/usr/bin/python3
"""What `fsi new` writes is right and runs; `fsi check --plot` draws the grids that a run computes on."""

import json
import os
import pty
import re
import subprocess
import sys
import unittest
from pathlib import Path

import h5py
import numpy as np
import yaml

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from running import BIN, FSI, ROOT, WATCHDOG, EndToEnd  # noqa: E402
from fsi_launch.new import outline  # noqa: E402
from fsi_launch.plot.one_run import grids  # noqa: E402
from fsi_launch.plot.reading import data  # noqa: E402

CORNERS = "# corners\n0, 0\n2, -0.6\n2.4, 0.4\n1.2, 0.9\n"


class InFolder(EndToEnd):
    def fsi(self, *words, code=0, **options):
        answer = subprocess.run([str(FSI), *words], env=os.environ | {"FSI_BIN": str(BIN)}, cwd=self.folder, text=True,
                                stdin=subprocess.DEVNULL, capture_output=True, timeout=WATCHDOG, check=False, **options)
        self.assertEqual(answer.returncode, code, answer.stdout + answer.stderr)
        return answer

    def facts(self, case):
        """What `fsi_case` says of a case."""
        answer = subprocess.run([BIN / "fsi_case", "resolve", case, "--json"], cwd=self.folder, capture_output=True, text=True, check=True)
        return json.loads(answer.stdout)


class New(InFolder):
    def begin(self, *words):
        """The first steps of a new case."""
        (self.folder / "corners.csv").write_text(CORNERS)
        self.fsi("new", "own", "--cells", "8", *words)
        end = self.facts("own.yaml")["time"]["end"]
        self.complete("own.yaml", "--set", f"time.end={0.02 * end}", "--no-progress")

    def shape(self, name):
        return yaml.safe_load((self.folder / f"{name}.yaml").read_text(encoding="utf-8"))["solids"]["body"]["shape"]

    def test_circle_of_aluminium_in_a_shock(self):
        self.begin()
        text = (self.folder / "own.yaml").read_text(encoding="utf-8")
        shock, left, factor = (float(re.search(pattern, text)[1]) for pattern in (r"x_shock: (\S+)", r"background, x: \[([^,]+),", r"factor: (\S+)}"))
        for level in (1, 2, 4, 8):  # it is between lines of points, on finer grids too
            cells = (shock - left) * 10 * factor * level
            self.assertGreater(abs(cells - round(cells)), 0.3)

    def test_scaled_outline_of_rubber(self):
        self.begin("--outline", "corners.csv", "--size", "0.1", "--material", "rubber")
        points = np.loadtxt(self.folder / "own_outline.csv", delimiter=",")
        self.assertAlmostEqual(np.ptp(points, axis=0).max(), 0.1)

    def test_spacing_of_the_gas_is_chosen_where_h_is_too_wide_for_the_outline(self):
        (self.folder / "step.csv").write_text("0,0\n1,0\n1,0.4\n0.4,0.4\n0.4,0.8\n0,0.8\n")
        self.fsi("new", "step", "--outline", "step.csv", "--straight", "--size", "0.1", "--material", "rubber", "--defaults")

    def test_acute_corners_are_rounded_by_arcs_that_fit_or_left_sharp(self):
        for name, points in (("dart", "0,0\n1,.4\n.35,0\n1,-.4\n"), ("wedge", "0,0\n1,.05\n0,.1\n"), ("needle", "0,0\n1,.04\n0,.08\n")):
            (self.folder / f"{name}.csv").write_text(points)
            for law in ("neo_hookean", "rigid"):
                self.fsi("new", name, "--outline", f"{name}.csv", "--straight", "--size", "0.1", "--law", law, "--defaults", "--overwrite")

    def test_a_rigid_wedge_stays_sharp_loses_less_and_takes_fewer_steps_than_a_rounded_one(self):
        (self.folder / "wedge.csv").write_text("0,0\n0.12,0.006\n0.12,-0.006\n")
        said = self.fsi("new", "wedge", "--outline", "wedge.csv", "--straight", "--law", "rigid", "--defaults").stdout
        lost, steps = (float(re.search(pattern, said)[1]) for pattern in (r"([\d.]+) % of ", r"about (\d+) steps"))
        self.assertEqual(self.shape("wedge")["radius"], 0)
        self.assertLess(lost, 25)
        rounded = self.fsi("check", "wedge.yaml", "--set", "solids.body.shape.radius=0.003").stdout      # what was written before
        self.assertLess(steps, float(re.search(r"about (\d+) steps", rounded)[1]))
        self.complete("wedge.yaml", "--set", "time.end=2e-5", "--no-progress")

    def test_edges_that_hardly_turn_are_told_that_a_smooth_curve_takes_fewer_steps(self):
        angles = np.arange(60) * np.pi / 30
        np.savetxt(self.folder / "round.csv", np.column_stack((0.5 * np.cos(angles), 0.2 * np.sin(angles))), delimiter=",")
        edges, smooth = (self.fsi("new", "round", "--outline", "round.csv", "--law", "rigid", "--defaults", "--overwrite", *given).stdout
                         for given in (["--straight"], []))
        self.assertIn("if these are no corners, leave out --straight", edges)
        self.assertNotIn("--straight", smooth)
        few, many = (int(re.search(r"about (\d+) steps", said)[1]) for said in (smooth, edges))
        self.assertLess(2 * few, many)

    def test_thin_rigid_plates_stay_sharp_and_take_few_steps(self):
        for name, points in (("plate", "0,0\n1,.2\n.995,.22\n-.005,.02\n"), ("angle", "0,0\n1,0\n1,.03\n.03,.03\n.03,1\n0,1\n")):
            (self.folder / f"{name}.csv").write_text(points)
            self.fsi("new", name, "--outline", f"{name}.csv", "--straight", "--law", "rigid", "--fixed", "--defaults")
            self.assertEqual(self.shape(name)["radius"], 0)
            sharp, rounded = (self.fsi("check", f"{name}.yaml", "--set", f"solids.body.shape.radius={radius}").stdout for radius in (0, 0.005))
            few, many = (float(re.search(r"about (\d+) steps", said)[1]) for said in (sharp, rounded))
            self.assertLess(5 * few, many)
        self.complete("plate.yaml", "--set", "time.end=2e-4", "--no-progress")

    def test_a_rigid_body_whose_sharp_corners_have_no_grids_is_rounded_and_that_is_said(self):
        (self.folder / "dart.csv").write_text("0,0\n1,.4\n.35,0\n1,-.4\n")
        said = self.fsi("new", "dart", "--outline", "dart.csv", "--straight", "--size", "0.1", "--law", "rigid", "--defaults").stdout
        self.assertRegex(said, r"(?m)^corners are rounded: with sharp ones \(`radius: 0`\) the case is not valid: fluid\.body_fitted: .*folded.*$")
        self.assertGreater(self.shape("dart")["radius"], 0)

    def test_a_rigid_fin_with_a_sharp_tail(self):
        points = [(0.5 + 0.5 * np.cos(a), 0.1 * np.sin(a) * (1 - np.cos(a)) / 2) for a in np.arange(24) * np.pi / 12]
        np.savetxt(self.folder / "fin.csv", points, delimiter=",")
        said = self.fsi("new", "fin", "--outline", "fin.csv", "--size", "0.1", "--law", "rigid", "--defaults").stdout
        self.assertIn("is cut off where its sides are so far apart", said)
        self.assertNotIn("--straight", said)    # it has its corner

    def test_what_to_type_next_can_be_pasted_whatever_the_folder_is_called(self):
        (self.folder / "my own").mkdir()
        said = self.fsi("new", "my own/it", "--defaults").stdout
        self.assertIn(" check 'my own/it.yaml' --plot", said)
        self.assertIn(" run 'my own/it.yaml'\n", said)
        self.assertIn(" run 'my own/it.yaml' ", (self.folder / "my own" / "it.yaml").read_text(encoding="utf-8"))

    def test_an_airfoil_is_not_told_to_have_edges_at_all_of_its_points(self):
        points = [(0.5 + 0.5 * np.cos(a), 0.1 * np.sin(a) * (1 - np.cos(a)) / 2) for a in np.arange(24) * np.pi / 12]
        np.savetxt(self.folder / "fin.csv", points, delimiter=",")
        words = ["new", "fin", "--outline", "fin.csv", "--size", "0.1", "--defaults", "--overwrite"]
        said = subprocess.run([str(FSI), *words], env=os.environ | {"FSI_BIN": str(BIN)}, cwd=self.folder, text=True, stdin=subprocess.DEVNULL,
                              capture_output=True, timeout=WATCHDOG, check=False).stdout     # its grids would be too fine
        self.assertIn("--law rigid keeps it", said)
        self.assertNotIn("--straight", said + (self.folder / "fin.yaml").read_text(encoding="utf-8"))

    def test_straight_edges_fixed_in_a_stream(self):
        self.begin("--outline", "corners.csv", "--straight", "--flow", "stream", "--mach", "2", "--law", "rigid", "--fixed")

    def test_what_else_the_text_offers_is_valid(self):
        (self.folder / "bar.csv").write_text("0, 0\n1, 0\n1, 4\n0, 4\n")
        for given in (("--on-wall",), ("--law", "rigid")):
            self.fsi("new", "bar", "--outline", "bar.csv", "--size", "0.1", "--straight", *given, "--defaults", "--overwrite")
            found = re.search(r"law: (\w+) +# or (.*): --solid body=LAW(.*)", (self.folder / "bar.yaml").read_text(encoding="utf-8"))
            law, others, more = found.groups()
            self.assertNotIn(law, others.split(", "))
            for other in others.split(", "):
                self.fsi("check", "bar.yaml", "--solid", f"body={other}", *more.split())

    def test_an_outline_in_millimetres_and_one_with_a_title_are_told_and_written_for_the_programs(self):
        points = "0, 0\n60, -12\n120, 0\n60, 9\n"
        in_mm = "the numbers in mine.csv are in mm, as its heading says: the outline is 0.12 x 0.021 m"
        for first, words in (("x [mm], y [mm]", in_mm), ("# x (mm), y (mm)", in_mm), ("# x, y in mm", in_mm), ("# mine, in mm", "the outline is 120 x 21 m"),
                             ("NACA 0012", "mine.csv: line 1, 'NACA 0012', is taken as a title\nthe outline is 120 x 21 m"), ("", "the outline is 120 x 21 m")):
            (self.folder / "mine.csv").write_text(f"{first}\n{points}")
            said = self.fsi("new", "own", "--outline", "mine.csv", "--material", "rubber", "--defaults", "--overwrite").stdout
            self.assertTrue(said.startswith(words), said)
            written = np.loadtxt(self.folder / self.shape("own")["file"], delimiter=",", skiprows=1)
            self.assertAlmostEqual(np.ptp(written, axis=0).max(), 0.12 if words == in_mm else 120)
        self.assertNotIn("the outline is", self.fsi("new", "own", "--outline", "mine.csv", "--size", "0.1", "--defaults", "--overwrite").stdout)

    def test_units_of_headings(self):
        points = "0, 0\n60, -12\n120, 0\n60, 9\n"
        units = {"x,y (in mm)": "mm", "# x_mm, y_mm": "mm", "# unit: mm": "mm", "x mm,y mm": "mm", "x in mm,y in mm": "mm", "x_um,y_um": "um",
                 "x_inch,y_inch": "in", "x in, y in": "in", "x (millimetres),y (millimetres)": "mm", "x,y\nmm,mm": "mm", "my part in mm": "mm",
                 "x,y": "", "x (m), y (m) of part_mm": "m", "# drawn in 3 mm steps": ""}
        for heading, unit in units.items():
            (self.folder / "mine.csv").write_text(f"{heading}\n{points}")
            self.assertEqual(outline.read(self.folder / "mine.csv").unit, unit, heading)
        for heading, words in (("y_mm,x_mm", "y before x"), ("x_mm,y_cm", "several units, cm, mm")):
            (self.folder / "mine.csv").write_text(f"{heading}\n{points}")
            self.assertIn(words, self.fsi("new", "own", "--outline", "mine.csv", "--defaults", code=2).stderr)
        (self.folder / "mine.csv").write_text(f"x,y\nm,m\n{points}")     # two headings, of which the programs skip one
        self.fsi("new", "own", "--outline", "mine.csv", "--defaults", "--material", "rubber")

    def test_points_within_straight_edges_are_no_corners(self):
        (self.folder / "mid.csv").write_text("x_mm,y_mm\n-10,0\n0,0\n10,0\n10,80\n-10,80\n")
        self.fsi("new", "post", "--outline", "mid.csv", "--straight", "--on-wall", "--material", "rubber", "--defaults")
        self.assertEqual(sorted(self.shape("post")["corners"]), [[-0.01, 0], [-0.01, 0.08], [0.01, 0], [0.01, 0.08]])

    def test_few_points_of_a_smooth_curve_are_told(self):
        (self.folder / "square.csv").write_text("0,0\n1,0\n1,1\n0,1\n")
        said = self.fsi("new", "square", "--outline", "square.csv", "--size", "0.1", "--defaults").stdout
        self.assertIn("a smooth curve goes through the points of square.csv, which turn by up to 90 degrees", said)

    def test_a_length_with_its_unit(self):
        self.assertIn("without its unit", self.fsi("new", "own", "--size", "8cm", "--defaults", code=2).stderr)

    def test_states_before_and_behind_the_shock_conserve_mass_momentum_and_energy(self):
        self.fsi("new", "own", "--mach", "1.8", "--gamma", "1.3", "--density", "2", "--pressure", "5e4")
        numbers = self.facts("own.yaml")["parameters"]
        gamma, speed = numbers["gamma"], numbers["mach"] * numbers["a_0"]
        self.assertAlmostEqual(numbers["a_0"] ** 2, 1.3 * 5e4 / 2)

        def fluxes(rho, v, p):
            w = speed - v
            return np.array([rho * w, p + rho * w ** 2, gamma / (gamma - 1) * p / rho + 0.5 * w ** 2])

        before, behind = fluxes(numbers["rho_0"], 0, numbers["p_0"]), fluxes(*(numbers[name] for name in ("rho_1", "v_1", "p_1")))
        np.testing.assert_allclose(behind, before, rtol=1e-12)

    def test_a_case_that_is_refused_stays_and_it_is_told(self):
        (self.folder / "leaf.csv").write_text("0, 0\n25, -0.3\n50, -0.4\n75, -0.3\n100, 0\n75, 0.3\n50, 0.4\n25, 0.3\n")
        said = self.fsi("new", "leaf", "--outline", "leaf.csv", "--size", "1", "--defaults", code=2).stderr
        self.assertRegex(said, r"^fsi: leaf\.yaml:\d+:\d+: .*\nleaf\.yaml stays: .* --overwrite\n$")
        self.assertTrue((self.folder / "leaf.yaml").exists())

    def test_nothing_is_overwritten_unasked(self):
        self.fsi("new", "own")
        self.assertIn("own.yaml is there already", self.fsi("new", "own", code=2).stderr)
        self.fsi("new", "own", "--overwrite", "--mach", "2")
        self.assertEqual(self.facts("own.yaml")["parameters"]["mach"], 2)

    def test_on_a_terminal_it_asks(self):
        ours, theirs = pty.openpty()
        answers = "\n0.2\nstream\n0.7\nsteel\nrigid\n\n"
        with subprocess.Popen([str(FSI), "new", "own"], env=os.environ | {"FSI_BIN": str(BIN)}, cwd=self.folder, stdin=theirs,
                              stdout=theirs, stderr=theirs, close_fds=True) as process:
            os.close(theirs)
            os.write(ours, answers.encode())
            said = b""
            try:
                while chunk := os.read(ours, 4096):
                    said += chunk
            except OSError:     # what reading from a terminal nobody has open any more says
                pass
        os.close(ours)
        self.assertEqual(process.returncode, 0, said.decode())
        facts = self.facts("own.yaml")
        self.assertEqual((facts["parameters"]["mach"], facts["solids"][0]["law"], facts["parameters"]["rho_bar"]), (0.7, "rigid", 7850))


class FirstCase(InFolder):
    """docs/first_case.md: its outline is saved, its commands are typed; pictures of fields are seen to elsewhere."""

    def test_commands_of_the_page_work_as_they_stand_there(self):
        page = (ROOT / "docs" / "first_case.md").read_text(encoding="utf-8")
        blocks = [block.strip() for block in page.split("```")[1::2]]
        (self.folder / "bean.csv").write_text(next(block for block in blocks if block.startswith("#")))
        typed = [line for block in blocks for line in block.splitlines() if line.startswith("./launch/fsi")]
        for line in typed:
            words = line.split()[1:]
            if words[0] in ("new", "check"):
                self.fsi(*words)
            elif words[0] == "run" and "--set" not in words:
                self.fsi(*words, "--no-progress")
        self.assertEqual((self.folder / "bean_grids.png").read_bytes()[:4], b"\x89PNG")
        times = [float(word) for line in typed for flag, word in zip(line.split(), line.split()[1:]) if flag == "--at"]
        with h5py.File(self.folder / "runs" / "bean" / "fluid.h5") as file:
            written = [group.attrs["t"] for group in file.values()]
        self.assertTrue(times and all(min(abs(t - there) for there in written) < 1e-9 * t for t in times), (times, written))


class Grids(InFolder):
    def test_pictures_in_the_formats_of_papers(self):
        for name, begin in (("b.pdf", b"%PDF"), ("c.svg", b"<?xml")):
            self.fsi("check", "plate", "--plot", name)
            self.assertEqual((self.folder / name).read_bytes()[:len(begin)], begin)

    def sides(self, case, *words):
        """[(kind, line)] of the rim of the gas, as they are drawn."""
        folder = self.folder / "grids"
        subprocess.run([BIN / "fsi_grids", case, folder, *words], check=True, cwd=ROOT)
        entries = {f"fluid.boundary.{side}": "outflow" for side in ("left", "right", "top")} | {"fluid.boundary.bottom": "slip_wall"}
        return grids._gas_sides(data.all_series(folder), entries)

    def test_sides_of_the_gas_are_drawn_as_what_they_are(self):
        sides = self.sides("elastic_ramp")
        along = {kind: np.concatenate([line for other, line in sides if other == kind]) for kind, _ in sides}
        self.assertTrue((along["wall"][:, 1] == 0).all() and along["wall"][:, 0].max() < 0.1)    # the floor before the ramp
        ramp = along["surface of a body"]
        np.testing.assert_allclose(ramp[:, 1], np.tan(np.radians(12)) * ramp[:, 0], atol=1e-12)
        on_rim = np.isin(along["open"], (-1.0, 1.0, 2.0)).any(axis=1)
        self.assertTrue(on_rim.all())

    def test_an_open_side_is_one_line_also_where_the_ends_of_grids_lie_on_it(self):
        sides = [line for kind, line in self.sides("nozzle") if kind == "open"]
        self.assertEqual(sorted((line[0].tolist(), line[-1].tolist()) for line in sides), [([-1, -0.5], [-1, 0.5]), ([2, -0.5], [2, 0.5])])

    def test_a_curve_without_a_body_is_a_wall(self):
        sides = self.sides("rotating_disk_walled", "--set", "grid.factor=2")
        radii = {kind: np.concatenate([np.hypot(*line.T) for other, line in sides if other == kind]) for kind, _ in sides}
        np.testing.assert_allclose(radii["wall"], 2)
        np.testing.assert_allclose(radii["surface of a body"], 1)

    def test_mistakes(self):
        self.assertIn(".svg", self.fsi("check", "plate", "--plot", "a.jpg", code=2).stderr)
        self.assertIn("no folder", self.fsi("check", "plate", "--plot", "nowhere/a.png", code=2).stderr)

    def test_they_are_those_of_a_run(self):
        for case, factor in (("two_cylinders", 2), ("moving_together_corners", 1)):    # the latter's bodies leave each other little room
            with self.subTest(case=case):
                grids = ("--set", f"grid.factor={factor}")
                times = ("--set", "time.end=1e-3", "--set", "output.times=[0]")
                run = self.complete(case, *grids, *times, "--no-progress", out=f"run_{case}")
                drawn = self.folder / case
                subprocess.run([BIN / "fsi_grids", case, drawn, *grids], check=True, cwd=ROOT)
                files = sorted(path.name for path in run.directory.glob("*.h5"))
                self.assertEqual(files, sorted(path.name for path in drawn.glob("*.h5")))
                self.expect_same_grids(run.directory, drawn, files if case == "two_cylinders" else ["fluid.h5"])    # rigid bodies have an outline

    def expect_same_grids(self, computed, drawn, files):
        """In the first output of a run and in a folder of grids."""
        for name in files:
            with h5py.File(computed / name) as one, h5py.File(drawn / name) as other:
                self.assertEqual(list(one["000000"]), list(other["000000"]))
                for grid in one["000000"]:
                    for key in ("x1", "x2", "kind"):
                        np.testing.assert_array_equal(one["000000"][grid][key], other["000000"][grid][key], f"{name} {grid} {key}")



if __name__ == "__main__":
    unittest.main()
