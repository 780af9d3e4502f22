#!/usr/bin/python3
"""Runs are started, steered, varied and read from Python; the scripts in examples/python do what they say."""

import json
import os
import subprocess
import sys
import unittest
from pathlib import Path

import numpy

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from running import BIN, EndToEnd, FSI, ROOT, WATCHDOG  # noqa: E402
import amp_fsi  # noqa: E402

COARSE = {"grid.factor": 2, "expect": {}}


class FromPython(EndToEnd):
    def setUp(self):
        super().setUp()
        runtime = self.folder / "runtime"
        runtime.mkdir(exist_ok=True)
        before = dict(os.environ)
        self.addCleanup(os.environ.update, before)
        os.environ |= {"FSI_BIN": str(BIN), "XDG_RUNTIME_DIR": str(runtime), "PYTHONPATH": str(ROOT / "launch")}

    def test_run_is_read(self):
        run = amp_fsi.run("elastic_piston", set=COARSE | {"output.times": [0.1, 0.2], "time.end": 0.2}, out=self.folder / "run")
        self.assertEqual(run.summary["status"], "completed")
        self.assertEqual(run.programs, ("fluid", "solid"))
        self.assertEqual(run.times("solid"), [0.1, 0.2])
        (first,), (last,) = run.fields("fluid", t=0.1).values(), run.fields("fluid").values()
        self.assertFalse(numpy.array_equal(first["p"], last["p"]))
        numpy.testing.assert_allclose(last["T"] * last["rho"], last["p"])
        self.assertEqual(run.interface["t"][-1], 0.2)
        self.assertEqual(run.units("forces_solid")["angle"], "rad")
        with self.assertRaisesRegex(ValueError, "it has 0.1, 0.2"):
            run.fields("fluid", t=0.15)
        with self.assertRaisesRegex(KeyError, "there are fluid, solid"):
            run.fields("disk")

    def test_mistake_and_failure_have_their_codes_and_reasons(self):
        with self.assertRaisesRegex(amp_fsi.RunFailed, "did you mean `factor`") as caught:
            amp_fsi.run("elastic_piston", set={"grid.fctor": 2}, out=self.folder / "mistake")
        self.assertEqual((caught.exception.code, caught.exception.run), (2, None))
        with self.assertRaises(amp_fsi.RunFailed) as caught:
            amp_fsi.run("elastic_piston", set=COARSE | {"parameters.density_ratio": 1e-3, "interface.projection": "traditional"},
                        out=self.folder / "broken")
        self.assertEqual(caught.exception.code, 3)
        self.assertEqual(caught.exception.run.summary["status"], "failed")

    def test_a_restart_that_is_refused_is_not_taken_for_the_run_before_it(self):
        """By exit code 1, which is also that of a run that has completed and missed what its case expects."""
        ended = amp_fsi.run("elastic_piston", set=COARSE | {"time.end": 0.1, "output.times": [0.1]}, out=self.folder / "run")
        lacking = self.folder / "bin"
        lacking.mkdir()
        for program in BIN.iterdir():
            if program.name != "fsi_start":
                (lacking / program.name).symlink_to(program.resolve())
        os.environ["FSI_BIN"] = str(lacking)
        with self.assertRaisesRegex(amp_fsi.RunFailed, "the program fsi_start is not in") as caught:
            amp_fsi.start(restart=self.folder / "run", set={"time.end": 0.2}).wait()
        self.assertEqual(caught.exception.code, 1)
        self.assertEqual(caught.exception.run.summary, ended.summary)   # the record is that of the run before it

    def test_what_a_case_expects_and_a_run_has_missed_raises_nothing(self):
        missed = amp_fsi.run("elastic_piston", set=COARSE | {"time.end": 0.1, "output.times": [0.1], "expect": {"steps": {"max": 1}}},
                             out=self.folder / "run")
        self.assertEqual([entry["met"] for entry in missed.summary["expectations"]], [False])

    def probed(self):
        """Whether each program has written two lines about its probe; probes.csv is not there yet."""
        try:
            table = amp_fsi.open(self.folder / "run").probes
        except KeyError:
            return False
        self.in_parts = set(table)
        return {"a.p", "b.u1"} <= self.in_parts

    def test_run_is_steered(self):
        running = amp_fsi.start("elastic_piston", out=self.folder / "run", set=COARSE | {
            "time.dt": 1e-7, "output.probes": [{"name": "a", "in": "fluid", "x": 0.5, "y": 0.05}, {"name": "b", "in": "solid", "x": 0, "y": 0}]})
        running.until(lambda: (self.folder / "run" / "interface.csv").is_file())
        running.until(self.probed)
        self.assertFalse((self.folder / "run" / "probes.csv").exists())
        running.pause()
        running.until(lambda: running.state()["status"] == "paused")
        self.assertTrue(running.going())
        running.resume()
        watched = amp_fsi.open(self.folder / "run")
        self.assertEqual(watched.summary, {})
        steps = len(watched.interface["t"])
        running.stop()
        for _ in range(2):
            self.assertEqual(running.wait().summary["status"], "stopped")
        self.assertEqual(watched.summary["status"], "stopped")
        self.assertGreaterEqual(len(watched.interface["t"]), steps)
        self.assertEqual(watched.interface["t"][-1], watched.summary["t"])
        self.assertEqual(watched.probes["t"][-1], watched.summary["t"])
        self.assertEqual(set(watched.probes), self.in_parts)

    def test_a_start_that_is_refused_is_not_taken_for_the_run_that_goes_on_there(self):
        first = amp_fsi.start("elastic_piston", set={"grid.factor": 2, "time.dt": 1e-7, "expect": {}}, out=self.folder / "taken")
        self.addCleanup(first.process.kill)
        with self.assertRaises(amp_fsi.RunFailed):
            amp_fsi.start("sod_tube", out=self.folder / "taken")
        self.assertTrue(first.going())
        first.stop()
        self.assertEqual(first.wait().summary["status"], "stopped")

    def test_study_goes_on_where_it_was(self):
        vary = {"parameters.density_ratio": [0.01, 1]}
        first = amp_fsi.study("elastic_piston", vary, set=COARSE, jobs=2, out=self.folder / "study")
        self.assertEqual([row["status"] for row in first["rows"]], ["completed"] * 2)
        kept = self.folder / "study" / "density_ratio=1" / "summary.json"
        before = kept.stat().st_mtime_ns
        (self.folder / "study" / "density_ratio=0.01" / "summary.json").unlink()
        again = amp_fsi.study("elastic_piston", vary, set=COARSE, jobs=2, out=self.folder / "study")
        self.assertEqual(kept.stat().st_mtime_ns, before)
        self.assertEqual([row["quantities"] for row in again["rows"]], [row["quantities"] for row in first["rows"]])
        self.assertTrue((self.folder / "study" / "study.png").is_file())
        changed = amp_fsi.study("elastic_piston", vary, set=COARSE | {"time.end": 0.4}, out=self.folder / "study")
        self.assertEqual({row["t"] for row in changed["rows"]}, {0.4})

    def test_values_may_be_those_of_numpy_and_what_is_shown_one_name(self):
        result = amp_fsi.study("elastic_piston", {"parameters.density_ratio": numpy.array([0.01, 1])}, show="interface.max_gap", out=self.folder / "study",
                               set={"grid.factor": numpy.int64(2), "expect": {}, "time.end": numpy.float32(0.125),
                                    "output.times": numpy.array([0.0625, 0.125])})
        self.assertEqual(result["quantities"], ["interface.max_gap"])
        self.assertEqual([row["t"] for row in result["rows"]], [0.125] * 2)
        with self.assertRaisesRegex(TypeError, "is no value of a case"):
            amp_fsi.run("elastic_piston", set={"time.end": object()})

    def test_study_checks_all_cases_first(self):
        answer = subprocess.run([FSI, "study", "elastic_piston", "--vary", "time.end=0.1,0", "--out", self.folder / "study"],
                                capture_output=True, text=True, check=False, timeout=WATCHDOG)
        self.assertEqual(answer.returncode, 2, answer.stderr)
        self.assertIn("time.end", answer.stderr)
        self.assertFalse((self.folder / "study").exists())

    def test_study_tells_what_failed_and_keeps_the_rest(self):
        answer = subprocess.run([FSI, "study", "elastic_piston", "--set", "grid.factor=2", "--set", "parameters.density_ratio=1e-3", "--vary",
                                 "interface.projection=traditional,simplified", "--show", "interface.max_gap", "--out", self.folder / "study"],
                                capture_output=True, text=True, check=False, timeout=WATCHDOG)
        self.assertEqual(answer.returncode, 3, answer.stderr)
        result = json.loads((self.folder / "study" / "study.json").read_text(encoding="utf-8"))
        self.assertEqual([row["status"] for row in result["rows"]], ["failed", "completed"])
        self.assertGreater(result["rows"][1]["quantities"]["interface.max_gap"], 0)

    def test_study_refuses_a_quantity_that_no_run_has(self):
        for wanted, said in (("interface.gap", "it has step, t, .*solid.gap"), ("forces_body.force1:max", "there are .*interface")):
            answer = subprocess.run([FSI, "study", "elastic_piston", "--set", "grid.factor=2", "--vary", "parameters.density_ratio=0.1,1",
                                     "--show", wanted, "--out", self.folder / "study"],
                                    capture_output=True, text=True, check=False, timeout=WATCHDOG)
            self.assertEqual(answer.returncode, 2, answer.stderr)
            self.assertRegex(answer.stderr.splitlines()[-1], f"--show {wanted}: .*{said}")
            self.assertFalse((self.folder / "study" / "density_ratio=1").exists())     # the first run told it

    def example(self, name):
        answer = subprocess.run(["/usr/bin/python3", ROOT / "examples" / "python" / f"{name}.py", self.folder / name],
                                capture_output=True, text=True, check=False, timeout=WATCHDOG)
        self.assertEqual(answer.returncode, 0, answer.stderr)
        return answer.stdout

    def test_example_light_piston(self):
        lines = self.example("light_piston").splitlines()
        self.assertEqual([line.split()[-1] for line in lines[2:5]], ["broke"] * 3)
        self.assertTrue((self.folder / "light_piston" / "velocity.png").is_file())

    def test_example_stop_when(self):
        self.assertTrue(self.example("stop_when").startswith("stopped at t = "))


if __name__ == "__main__":
    unittest.main()
