#!/usr/bin/python3
"""The user's mistakes: exit 2, one line that says where and what to write, nothing started, nothing made."""

import json
import os
import re
import shlex
import subprocess
import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from running import BIN, EndToEnd, FSI, LONG, ROOT  # noqa: E402

PISTON = (ROOT / "configs" / "elastic_piston.yaml").read_text(encoding="utf-8")


class BadInput(EndToEnd):
    def refused(self, *arguments):
        """The one line that a refused run prints."""
        run = self.launch(*arguments)
        self.assertEqual(run.wait(), 2, run.stdout + run.stderr)
        lines = run.stderr.strip().splitlines()
        self.assertEqual(len(lines), 1, run.stderr)
        self.assertEqual(run.stdout, "")
        self.assertFalse(run.directory.exists(), "a folder was made")
        self.assertEqual(run.programs(), {})
        return lines[0]

    def changed(self, old, new):
        """The line for a case file in which `old` is replaced; it names the place in the file."""
        self.assertIn(old, PISTON)
        path = self.folder / "case.yaml"
        path.write_text(PISTON.replace(old, new, 1), encoding="utf-8")
        line = self.refused(str(path))
        self.assertRegex(line, r"case\.yaml:\d+:\d+: ")
        return line

    def test_output_that_nobody_reads_any_more_ends_the_command_silently(self):
        for words in (["gallery"], ["--version"], ["--help"], ["schema"], []):
            reading, writing = os.pipe()
            os.close(reading)
            answer = subprocess.run([FSI, *words], stdout=writing, stderr=subprocess.PIPE, text=True, check=False)
            os.close(writing)
            code = 128 - answer.returncode if answer.returncode < 0 else answer.returncode   # as a shell tells it
            self.assertEqual((words, code, answer.stderr), (words, 141, ""))

    def test_what_to_type_next_is_told_as_the_command_was_typed(self):
        link = self.folder / "my fsi"
        link.symlink_to(FSI)
        for typed in (str(link), str(FSI), os.path.relpath(FSI, self.folder)):
            answer = subprocess.run([typed, "check", "--nonsense"], cwd=self.folder, env=os.environ | {"FSI_BIN": str(BIN)},
                                    capture_output=True, text=True, check=False)
            self.assertTrue(answer.stderr.endswith(f"; {shlex.quote(typed)} check --help says what it takes\n"), answer.stderr)

    def test_nothing_depends_on_who_listens(self):
        for closed in ("0<&-", ">&-", "2>&-", "0<&- >&- 2>&-"):
            folder = self.folder / f"closed{len(list(self.folder.iterdir()))}"
            answer = subprocess.run(["bash", "-c", f"exec '{FSI}' run sod_tube --set grid.factor=2 --set expect={{}} --out '{folder}' {closed}"],
                                    cwd=self.folder, env=os.environ | {"FSI_BIN": str(BIN)}, capture_output=True, text=True, check=False)
            self.assertEqual((closed, answer.returncode), (closed, 0), answer.stderr)
            self.assertEqual(json.loads((folder / "summary.json").read_text(encoding="utf-8"))["status"], "completed")

    def test_modules_of_the_current_folder_are_not_those_of_python(self):
        for name in ("random", "json", "contextlib", "encodings", "fsi_launch"):
            (self.folder / f"{name}.py").write_text("raise SystemExit('mine')\n", encoding="utf-8")
        strange = {"PYTHONHOME": str(self.folder), "PYTHONPLATLIBDIR": "nowhere", "PYTHONINSPECT": "1", "PYTHONWARNINGS": "error",
                   "PYTHONSTARTUP": str(self.folder / "random.py")}
        for environment in ({}, strange):
            answer = subprocess.run([FSI, "check", "elastic_piston"], cwd=self.folder, env=os.environ | {"FSI_BIN": str(BIN)} | environment,
                                    stdin=subprocess.DEVNULL, capture_output=True, text=True, check=False)
            self.assertEqual((answer.returncode, answer.stderr), (0, ""))

    def test_a_current_folder_that_is_gone(self):
        gone = self.folder / "gone"
        gone.mkdir()
        answer = subprocess.run(["bash", "-c", f"cd '{gone}'; rmdir '{gone}'; exec '{FSI}' check elastic_piston"], env=os.environ | {"FSI_BIN": str(BIN)},
                                capture_output=True, text=True, check=False)
        self.assertEqual((answer.returncode, answer.stdout), (2, ""), answer.stderr)
        self.assertRegex(answer.stderr.splitlines()[-1], "^fsi: the current folder.* is gone or cannot be entered; go to another one$")

    def test_program_of_somebody_else_that_is_not_there(self):
        for program, remedy in (("./nothere", "does not exist"), ("nothere", "write ./nothere for one in this folder")):
            self.assertIn(remedy, self.refused("spring_piston", "--set", f"solids.piston.program={program}"))
            answer = subprocess.run([FSI, "check", "spring_piston", "--set", f"solids.piston.program={program}"], cwd=self.folder,
                                    env=os.environ | {"FSI_BIN": str(BIN)}, capture_output=True, text=True, check=False)
            self.assertEqual((answer.returncode, answer.stdout), (2, ""), answer.stderr)
            self.assertIn(remedy, answer.stderr)

    def test_ways_to_watch_that_do_not_go_together(self):
        for words in (["--replay", "a.h5", "--record", "b.h5"], ["a_run", "--replay", "a.h5"], ["--send", "pause", "--web", "0"],
                      ["--host", "0.0.0.0"], ["--speed", "2"], ["--once", "--web", "0"]):
            answer = subprocess.run([FSI, "monitor", *words], cwd=self.folder, env=os.environ | {"FSI_BIN": str(BIN)}, capture_output=True,
                                    text=True, check=False)
            self.assertEqual((words, answer.returncode), (words, 2), answer.stderr)
            self.assertRegex(answer.stderr, next(word for word in words if word.startswith("--")))

    def test_unknown_key_and_what_was_meant(self):
        self.assertRegex(self.changed("cfl: 0.9", "clf: 0.9"), r"clf.*cfl")

    def test_negative_density(self):
        self.assertRegex(self.changed("rho: density_ratio\n", "rho: -density_ratio\n"), r"rho")

    def test_a_state_that_is_none_between_the_points_of_the_check_is_named_by_the_program(self):
        run = self.launch("sod_tube", "--set", "grid.factor=40", "--set", "fluid.initial={rho: \"x > 0.297 && x < 0.298 ? -1 : 1\", "
                          "v: [0, 0], p: 1}", "--set", "expect={}")
        self.assertEqual(run.wait(), 2, run.stdout + run.stderr)
        self.assertRegex(run.stderr, r"case\.yaml: fluid\.initial: grid \"fluid\": initial state at \(0\.297.*\): rho = -1")

    def test_a_state_of_a_side_that_is_none_between_the_times_of_the_check_is_named_by_the_program(self):
        run = self.launch("sod_tube", "--set", "grid.factor=2", "--set", "fluid.boundary.left={kind: far_field, state: "
                          "{rho: 1, v: [0, 0], p: \"1 - 2 * (abs(sin(80 * pi * t)) > 0.1)\"}}", "--set", "expect={}")
        self.assertEqual(run.wait(), 2, run.stdout + run.stderr)
        self.assertRegex(run.stderr, r"fluid\.boundary\.left: rho = 1, v = \(0, 0\), p = -1 are no state of a gas")
        self.assertEqual(run.summary()["failure"]["position"][0], 0)

    def test_a_state_of_a_curve_that_is_none_between_the_times_of_the_check_is_named_as_the_case_names_it(self):
        run = self.launch("sod_tube", "--set", "grid.factor=2", "--set", "fluid.grid={x: [-1, 1], y: [-1, 1]}", "--set",
                          "fluid.body_fitted=[{name: disk, shape: {kind: circle, radius: 0.4}, boundary: {kind: far_field, state: "
                          "{rho: 1, v: [0, 0], p: \"1 - 2 * (abs(sin(80 * pi * t)) > 0.1)\"}}}]",
                          "--set", "fluid.boundary={left: slip_wall, right: slip_wall, bottom: slip_wall, top: slip_wall}",
                          "--set", "fluid.initial={rho: 1, v: [0, 0], p: 1}", "--set", "reference={kind: none}", "--set", "output={times: [0.2]}",
                          "--set", "expect={}")
        self.assertEqual(run.wait(), 2, run.stdout + run.stderr)
        self.assertRegex(run.stderr, r"fluid\.body_fitted\[0\]\.boundary: rho = 1, v = \(0, 0\), p = -1 are no state of a gas")

    def test_wrong_expression(self):
        self.changed("lambda: density_ratio * c_p^2 / 3", "lambda: density_ratio * (c_p^2 / 3")

    def test_unknown_name_in_an_expression(self):
        self.assertRegex(self.changed("lambda: density_ratio", "lambda: densityratio"), r"densityratio")

    def test_law_that_does_not_exist(self):
        self.assertRegex(self.changed("law: linear_elastic", "law: liner_elastic"), r"linear_elastic")

    def test_two_solids_with_one_name(self):
        self.assertRegex(self.changed("solids:\n", "solids:\n  solid: {law: linear_elastic}\n"), r"solid")

    def test_interface_points_that_do_not_meet(self):
        grid = "grid: {x: [-1, 0], y: [0, 1], spacing: h, rotation: angle}"
        self.changed(grid, grid.replace("y: [0, 1]", "y: [0, 0.9]"))

    def test_missing_file(self):
        self.assertIn("nowhere/to/be/found.yaml", self.refused("nowhere/to/be/found.yaml"))

    def test_misspelt_case(self):
        self.assertIn("elastic_piston", self.refused("elastic_pistn"))

    def test_wrong_options(self):
        self.assertIn("time.ennd", self.refused("elastic_piston", "--set", "time.ennd=1"))
        self.assertIn("neo_hokean", self.refused("elastic_piston", "--solid", "solid=neo_hokean"))
        self.assertIn("beam", self.refused("elastic_piston", "--solid", "beam=neo_hookean"))
        self.assertIn("--sett", self.refused("elastic_piston", "--sett", "time.end=1"))

    def test_check_says_the_same_and_starts_nothing(self):
        path = self.folder / "case.yaml"
        path.write_text(PISTON.replace("cfl: 0.9", "clf: 0.9"), encoding="utf-8")
        for case, code in (("elastic_piston", 0), (str(path), 2)):
            answer = subprocess.run([FSI, "check", case], env={"FSI_BIN": str(BIN), "PATH": "/usr/bin:/bin"},
                                    capture_output=True, text=True, check=False)
            self.assertEqual(answer.returncode, code, answer.stderr)

    def test_results_are_not_overwritten_unasked(self):
        run = self.complete("elastic_piston", "--set", "grid.factor=1", "--set", "expect={}")
        again = self.launch("elastic_piston", "--set", "grid.factor=1", "--set", "expect={}")
        self.assertEqual(again.wait(), 2)
        self.assertIn("--overwrite", again.stderr)
        self.assertEqual(run.summary()["status"], "completed")
        self.complete("elastic_piston", "--set", "grid.factor=1", "--set", "expect={}", "--overwrite")

    def test_overwriting_takes_nothing_else_and_no_living_run(self):
        short = ("elastic_piston", "--set", "grid.factor=1", "--set", "expect={}")
        run = self.complete(*short)
        (run.directory / "plots").mkdir()
        for name in ("notes.txt", "measured.csv", "forces.part", "plots/mine.svg"):
            notes = run.directory / name
            notes.write_text("mine", encoding="utf-8")
            refused = self.launch(*short, "--overwrite")
            self.assertEqual(refused.wait(), 2)
            self.assertIn(f"also holds {name}, which no run wrote", refused.stderr)
            self.assertEqual(notes.read_text(encoding="utf-8"), "mine")
            notes.unlink()
        self.assertEqual(run.summary()["status"], "completed")
        living = self.launch(*LONG, out="long")
        living.until_stepping()
        refused = self.launch(*short, "--overwrite", out="long")
        self.assertEqual(refused.wait(), 2)
        self.assertIn("still going on", refused.stderr)
        unasked = self.launch(*short, out="long")
        self.assertEqual(unasked.wait(), 2)
        self.assertRegex(unasked.stderr, r"still going on \(launcher \d+\); name another folder")
        self.assertNotIn("--overwrite", unasked.stderr)
        self.assertEqual(len(living.programs()), 3)

    def test_results_stay_where_the_run_that_would_replace_them_is_refused_or_killed_before_its_programs_start(self):
        short = ("elastic_piston", "--set", "grid.factor=1", "--set", "expect={}")
        run = self.complete(*short)

        def found():
            return {path: path.read_bytes() for path in run.directory.rglob("*") if path.is_file()}
        before = found()
        refused = self.launch(*short, "--overwrite", script="from fsi_launch import run\nfrom fsi_launch.failure import UserMistake\n"
                              "def no(*_): raise UserMistake('no')\nrun._programs = no\n")
        self.assertEqual(refused.wait(), 2, refused.stderr)
        self.assertEqual(found(), before)
        killed = self.launch(*short, "--overwrite", script="import os\nfrom fsi_launch import run\n"
                             "run._programs = lambda *_: os.kill(os.getpid(), 9)\n")
        killed.wait()
        unasked = self.launch(*short)
        self.assertEqual(unasked.wait(), 2, unasked.stderr)
        self.assertEqual({path: content for path, content in found().items() if path.suffix != ".tmp"}, before)
        again = self.complete(*short, "--overwrite")
        self.assertEqual([path.name for path in again.directory.iterdir() if path.name.startswith(".")], [])

    def test_results_without_a_name_or_at_a_link_to_nowhere(self):
        run = self.launch("elastic_piston", "--out", "", out=None)
        self.assertEqual(run.wait(), 2, run.stderr)
        self.assertIn("--out: '' is no name", run.stderr)
        (self.folder / "run").symlink_to("nowhere")
        self.assertIn("is a link to nowhere", self.refused("elastic_piston"))
        self.assertFalse((self.folder / "runs").exists())

    def test_what_fails_before_a_program_begins_leaves_no_folder(self):
        (self.folder / "runtime").mkdir()
        (self.folder / "runtime" / "amp-fsi").touch()     # where the run would be entered
        run = self.launch("elastic_piston", out="new/run")
        self.assertEqual(run.wait(), 5, run.stderr)
        self.assertIn("amp-fsi: File exists", run.stderr)
        self.assertFalse((self.folder / "new").exists())

    def test_a_restart_goes_on_not_back(self):
        run = self.complete("elastic_piston", "--set", "grid.factor=2", "--set", "expect={}", "--set", "output.checkpoint_every=10")
        back = self.launch("--restart", str(run.directory), "--set", "time.end=0.1", out=None)
        self.assertEqual(back.wait(), 2)
        self.assertIn("time.end", back.stderr)
        past = self.launch("--restart", str(run.directory), "--set", "time.end=1.5", "--pause-at", "3", out=None)
        self.assertEqual(past.wait(), 2)
        self.assertRegex(past.stderr, r"--pause-at 3: the run goes on from step \d+")
        again = self.launch("--restart", str(run.directory), "--set", "expect={}", out=None)
        self.assertEqual(again.wait(), 0, again.stderr)
        self.assertIn("the run is complete", again.stdout + again.stderr)

    def test_all_levels_are_checked_before_the_first_runs(self):
        answer = subprocess.run([FSI, "converge", "elastic_piston", "--levels", "1,20000", "--out", self.folder / "levels"], cwd=self.folder,
                                env=os.environ | {"FSI_BIN": str(BIN)}, capture_output=True, text=True, check=False)
        self.assertEqual(answer.returncode, 2, answer.stderr)
        self.assertIn("level 20000: ", answer.stderr)
        self.assertFalse((self.folder / "levels").exists())

    def test_no_such_verb(self):
        answer = subprocess.run([FSI, "rn"], capture_output=True, text=True, check=False)
        self.assertEqual(answer.returncode, 2)
        self.assertRegex(answer.stderr, r"^fsi: no verb 'rn'; there are run, submit, test, .*completion$")

    def test_every_verb_of_the_usage_says_its_own(self):
        usage = (ROOT / "launch" / "usage.txt").read_text(encoding="utf-8").split("CASE is a file")[0]
        verbs = set(re.findall(r"^  ([a-z]+) ", usage, flags=re.M))
        self.assertGreater(len(verbs), 14)
        for verb in sorted(verbs):
            answer = subprocess.run([FSI, verb, "--help"], env=os.environ | {"FSI_BIN": str(BIN)}, capture_output=True, text=True, check=False)
            self.assertEqual(answer.returncode, 0, f"{verb}: {answer.stderr}")
            self.assertIn(f"fsi {verb}", answer.stdout)

    def test_more_steps_than_any_run_can_take(self):
        endless = ("shock_ellipse", "--set", "solids.ellipse.lambda=1e30", "--set", "time.multirate=false")
        answer = subprocess.run([FSI, "check", *endless], env=os.environ | {"FSI_BIN": str(BIN)}, capture_output=True, text=True, check=False)
        self.assertEqual(answer.returncode, 2, answer.stdout)
        self.assertIn("more than any run can take", answer.stderr)

    def test_two_grids_have_differences_and_no_order(self):
        answer = subprocess.run([FSI, "converge", "rigid_piston", "--levels", "1,2", "--set", "time.end=0.3", "--set", "output.times=[0.1]"],
                                cwd=self.folder, env=os.environ | {"FSI_BIN": str(BIN)}, capture_output=True, text=True, check=False)
        self.assertEqual(answer.returncode, 0, answer.stderr)
        self.assertIn(" 0.3 ", answer.stdout)  # the end, though it is no time of output

    def test_a_rate_between_grids_takes_three(self):
        answer = subprocess.run([FSI, "converge", "rigid_piston", "--levels", "1,2", "--min-rate", "5"], cwd=self.folder,
                                env=os.environ | {"FSI_BIN": str(BIN)}, capture_output=True, text=True, check=False)
        self.assertEqual(answer.returncode, 2, answer.stderr)
        answer = subprocess.run([FSI, "converge", "rigid_piston", "--levels", "1,2,4", "--min-rate", "5"], cwd=self.folder,
                                env=os.environ | {"FSI_BIN": str(BIN)}, capture_output=True, text=True, check=False)
        self.assertEqual(answer.returncode, 1, answer.stderr)
        self.assertIn("must be at least 5", answer.stderr)


if __name__ == "__main__":
    unittest.main()
