#!/usr/bin/python3
"""Accidents other than a lost program: broken numbers, a full or vanished folder, requests at the wrong time; and a short
form of the campaign of `fsi faults`."""

import json
import math
import os
import resource
import subprocess
import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from running import BIN, EndToEnd, FSI, LONG, WATCHDOG, let_pass, until  # noqa: E402

BREAKS = ("elastic_piston", "--set", "parameters.density_ratio=1e-3", "--set", "interface.projection=traditional",
          "--set", "output.times=[0]")


class BrokenNumbers(EndToEnd):
    def test_state_just_before_is_written_and_still_sound(self):
        import h5py
        run = self.launch(*BREAKS)
        self.assertEqual(run.wait(), 3, run.stderr)
        self.assertRegex(run.stderr, r"step \d+, t = .*grid|step \d+, t = .*point")
        self.assertNotRegex(run.stderr, "; try ")   # of a limiter: it is the projection
        self.assertRegex(run.stderr, "interface.projection=simplified")
        failure = run.summary()["failure"]
        self.assertEqual(failure["step"], run.summary()["steps"] + 1)
        self.assertGreater(failure["t"], run.summary()["t"])
        self.assertEqual(len(failure["point"]), 1 if failure["interface"] else 2)
        self.assertNotRegex(failure["what"], r"step \d|t = |grid|point")
        for word in (f"step {failure['step']}", f"({', '.join(map(str, failure['point']))})", failure["what"]):
            self.assertIn(word, run.summary()["reason"])
        for name, field in (("fluid", "p"), ("solid_solid", "u1")):
            with h5py.File(run.directory / "last_state" / f"{name}.h5") as file:
                ahead = run.summary()["dt"]["max"] if name != "fluid" else 0  # a solid shows what it has predicted
                self.assertGreater(file.attrs["t"], 0)
                self.assertLessEqual(file.attrs["t"], run.summary()["t"] + ahead + 1e-12)
                values = next(iter(file.values()))[field][:]
                self.assertTrue(all(math.isfinite(value) for value in values.flat))
                if field == "p":
                    self.assertGreater(values.min(), 0)


class LostFolder(EndToEnd):
    """A file in the place of a folder stops root as well as anybody."""

    OUTPUTS = ("elastic_piston", "--set", "grid.factor=2", "--set", "expect={}", "--set", "time.dt=1e-6", "--set", "time.end=1.5",
               "--set", "output.times=[1.5]", "--set", "output.every=0.001")

    def lose(self, folder, *more):
        run = self.launch(*self.OUTPUTS, *more)
        self.assertTrue(until(lambda: len(list(run.directory.glob("fields/*"))) >= 4))
        victim = run.directory / folder
        if victim.exists():
            victim.rename(run.directory / "gone")
        victim.write_text("a file\n")
        return run

    def test_output_that_cannot_be_written_ends_the_run_with_code_5(self):
        run = self.lose("fields")
        self.assertEqual(run.wait(), 5, run.stderr)
        self.assertIn("fields", run.stderr)
        self.assertEqual(run.summary()["status"], "failed")
        self.assert_nothing_left(run)

    def test_run_goes_on_without_if_told_to_and_counts_what_is_lost(self):
        run = self.lose("checkpoints", "--set", "output.on_failure=go_on", "--set", "output.checkpoint_every=50")
        self.assertTrue(until(lambda: "the run goes on without" in run.log("fluid")))
        run.ctl("stop")
        self.assertEqual(run.wait(), 0, run.stderr)
        self.assertEqual(run.summary()["status"], "stopped")
        self.assertGreater(run.summary()["counters"]["lost_outputs"], 0)


class FullDisk(EndToEnd):
    """As the shell's limit of a file's size makes one for all that is run below it."""

    def test_the_program_that_hit_it_is_named_and_exits_5(self):
        run = self.launch(*LostFolder.OUTPUTS, script="import resource\nresource.setrlimit(resource.RLIMIT_FSIZE, (60000, 60000))")
        self.assertEqual(run.wait(), 5, run.stderr)
        origin = run.summary()["failure"]["origin"]
        self.assertIn(origin, ("fluid", "solid", "coupler"))
        self.assertRegex(run.summary()["reason"], rf"^{origin}: .*(File too large|free space)")

    def test_a_report_that_finds_no_room_reaches_the_launcher_in_memory(self):
        """Nothing fits any more, neither the programs' reports nor the words they leave in their logs."""
        run = self.launch(*LONG, "--set", "output.checkpoint_every=1000", "--pause-at", "100")
        programs = run.until_paused()
        for name in ("parts", "checkpoints"):
            (run.directory / name).write_text("a file\n")
        self.assertEqual(len(programs), 3)
        run.ctl("resume")
        self.assertEqual(run.wait(), 5, run.stderr)
        self.assertIn(run.summary()["failure"]["origin"], ("fluid", "solid", "coupler"))
        self.assertIn("/checkpoints", run.summary()["reason"])


class FullDiskAtTheEnd(EndToEnd):
    """The launcher finds no room for its own files; the summary, which has room, says so, and what the programs have ended with counts."""

    NO_ROOM = "from fsi_launch.results import probes\ndef no(*_): raise OSError(28, 'No space left on device', 'probes.csv')\nprobes.merge = no\n"

    def test_a_run_that_was_well_fails_and_says_where(self):
        run = self.launch("sod_tube", "--set", "grid.factor=2", "--set", "expect={}", script=self.NO_ROOM)
        self.assertEqual(run.wait(), 5, run.stderr)
        self.assertEqual(run.summary()["status"], "failed")
        self.assertRegex(run.summary()["reason"], "^cannot write probes.csv: No space left on device; ")
        self.assertTrue((run.directory / "run.xmf").is_file())

    def test_a_run_whose_numbers_broke_ends_so(self):
        run = self.launch(*BREAKS, script=self.NO_ROOM)
        self.assertEqual(run.wait(), 3, run.stderr)
        self.assertRegex(run.summary()["reason"], r"step \d+")


class FullDiskOfOneProgram(EndToEnd):
    """Limits of the size of files that single programs get while their run is paused. The lines of tables go to the disk sixteen at
    a time; those that are left at the end are fewer."""

    TABLES_ONLY = ("--set", "expect={}", "--set", "output.checkpoint_at_end=false", "--set", "output.checkpoint_seconds=1e6")
    PISTON = ("elastic_piston", *TABLES_ONLY, "--set", "grid.factor=1", "--set", "time.dt=1e-3", "--set", "output.times=[0.8]", "--set",
              "output.probes=[{name: a, in: fluid, x: 0.5, y: 0.5}, {name: b, in: solid, x: -0.5, y: 0.5}]")
    TUBE = ("sod_tube", *TABLES_ONLY, "--set", "grid.factor=5", "--set", "time.dt=2e-4", "--set",
            "output.probes=[{name: a, in: fluid, x: 0.5, y: 0.05}]")
    BLOCK = ("moving_together_block", *TABLES_ONLY, "--solid", "block=rigid", "--set", "output.every=0.05")
    TABLES = {"coupler": ["interface.csv"], "fluid": ["parts/probes_fluid.csv"],
              "solid": ["forces_solid.csv", "parts/probes_solid.csv"]}
    EXECUTABLES = {"coupler": "coupler", "fluid": "fluid_solver", "solid": "solid_solver_linear_elastic"}

    def limited(self, case, limits, *more, out):
        """A run of `case` in which no file of a program grows beyond {program: bytes}."""
        run = self.launch(*case, "--pause-at", "20", *more, out=out)
        run.speaker = "fluid" if case is self.TUBE else "coupler"
        programs = run.until_paused()
        for name, size in limits.items():
            resource.prlimit(programs[self.EXECUTABLES[name]], resource.RLIMIT_FSIZE, (size, size))
        run.ctl("resume")
        return run

    def rows(self, run, table):
        return (run.directory / table).read_bytes().count(b"\n") - 1

    def check_last_lines(self, case, name):
        whole = self.complete(*case, out=f"whole-{name}")
        table = max(self.TABLES[name], key=lambda table: (whole.directory / table).stat().st_size)
        self.assertNotEqual(self.rows(whole, table) % 16, 0, "no lines are left at the end")
        run = self.limited(case, {name: (whole.directory / table).stat().st_size - 10}, out=f"run-{name}")
        self.assertEqual(run.wait(), 5, run.stderr)
        self.assertEqual(run.summary()["status"], "failed")
        self.assertEqual(run.summary()["failure"]["origin"], name)
        self.assertIn(table, run.summary()["reason"])
        missing = self.rows(whole, table) % 16
        self.assertEqual(self.rows(run, table), self.rows(whole, table) - missing)
        run = self.limited(case, {name: (whole.directory / table).stat().st_size - 10}, "--set", "output.on_failure=go_on",
                           out=f"go-on-{name}")
        self.assertEqual(run.wait(), 0, run.stderr)
        self.assertEqual(run.part(name)["counters"]["lost_outputs"], missing)
        self.assertRegex(run.log(name), f"{table}.*results lost: {missing}")

    def test_last_lines_that_find_no_room_end_a_run_or_are_counted(self):
        for name in self.TABLES:
            with self.subTest(name):
                self.check_last_lines(self.PISTON, name)

    def test_so_it_is_where_a_gas_is_alone(self):
        self.check_last_lines(self.TUBE, "fluid")

    def test_run_that_goes_on_has_lost_what_it_counts(self):
        run = self.limited(self.PISTON, {name: 40000 for name in self.TABLES}, "--set", "output.on_failure=go_on", out="run")
        self.assertEqual(run.wait(), 0, run.stderr)
        for name, tables in self.TABLES.items():
            rows = [self.rows(run, table) for table in tables]
            self.assertLess(max(rows), run.summary()["steps"])
            self.assertEqual(run.part(name)["counters"]["lost_outputs"], sum(run.summary()["steps"] + 1 - n for n in rows), name)

    def test_gas_whose_fields_are_lost_has_all_lines_of_its_budget(self):
        run = self.limited(self.BLOCK, {"fluid": 100000}, "--set", "output.on_failure=go_on", out="run")
        self.assertEqual(run.wait(), 0, run.stderr)
        outputs = 21
        written = len(list(run.directory.glob("fields/fluid_*.h5")))
        self.assertIn(written, range(1, outputs))
        self.assertEqual(self.rows(run, "budget_fluid.csv"), outputs)
        self.assertEqual(run.part("fluid")["counters"]["lost_outputs"], outputs - written)


class Requests(EndToEnd):
    def entry(self, run):
        """(path, content) of its entry in the registry."""
        path = next((run.runtime / "amp-fsi").glob("*.json"))
        return path, json.loads(path.read_text(encoding="utf-8"))

    def send_with_key(self, run, key, word):
        """What somebody can do who knows the name of the run and has a registry of his own: nobody hears him."""
        path, content = self.entry(run)
        others = self.folder / "others" / "amp-fsi"
        others.mkdir(parents=True, exist_ok=True)
        (others / path.name).write_text(json.dumps(content | {"key": key}), encoding="utf-8")
        environment = os.environ | {"FSI_BIN": str(BIN), "XDG_RUNTIME_DIR": str(others.parent)}
        answer = subprocess.run([str(FSI), "ctl", content["run"], word], env=environment, timeout=WATCHDOG, capture_output=True,
                                text=True, check=False)
        self.assertEqual(answer.returncode, 4, answer.stderr)

    def test_requests_without_the_key_of_the_run_change_nothing(self):
        """Of a run that is paused meanwhile: one that went on, and the one beside it, would only be longer."""
        run = self.launch(*LONG, "--pause-at", "100")
        run.until_paused()
        before = run.written()
        self.send_with_key(run, "", "stop")
        self.send_with_key(run, "sign:" + "0" * 64, "resume")
        self.assertLess(run.written() - before, 32 * len(run.table()[-1]))  # lines are written sixteen at a time
        run.ctl("resume")
        run.until_further()
        self.assertEqual(run.checkpoints(), [])
        self.assert_as_undisturbed(run)

    def test_key_is_nowhere_but_in_the_entry_that_only_the_user_reads(self):
        run = self.launch(*LONG)
        programs = run.until_stepping()
        path, content = self.entry(run)
        self.assertEqual(path.stat().st_mode & 0o777, 0o600)
        self.assertEqual(path.parent.stat().st_mode & 0o777, 0o700)
        key = content["key"].encode()
        self.assertGreaterEqual(len(key), 32)
        for pid in programs.values():
            self.assertNotIn(key, (Path("/proc") / str(pid) / "cmdline").read_bytes())
        run.ctl("stop")
        self.assertEqual(run.wait(), 0, run.stderr)
        for file in run.directory.rglob("*"):
            self.assertTrue(file.is_dir() or key not in file.read_bytes(), file)

    def test_paused_run_takes_no_step_but_checkpoints_and_ends_at_a_stop(self):
        run = self.launch(*LONG, "--pause-at", "100")
        run.until_paused()
        before = run.written()
        run.ctl("checkpoint")
        self.assertTrue(until(lambda: run.checkpoints()))
        self.assertEqual(run.checkpoints(), [101])  # a checkpoint takes one step
        let_pass(1)
        self.assertLess(run.written() - before, 32 * len(run.table()[-1]))  # lines are written sixteen at a time
        run.ctl("resume")
        run.until_further()
        run.ctl("stop")
        self.assertEqual(run.wait(), 0, run.stderr)
        self.assertEqual(run.summary()["status"], "stopped")
        self.assertEqual(run.checkpoints()[-1], run.summary()["steps"])

    def test_run_that_nobody_named_is_not_stopped_by_a_script(self):
        run = self.launch(*LONG)
        run.until_stepping()
        environment = os.environ | {"FSI_BIN": str(BIN), "XDG_RUNTIME_DIR": str(run.runtime)}
        answer = subprocess.run([str(FSI), "ctl", "stop"], env=environment, stdin=subprocess.DEVNULL, capture_output=True, text=True,
                                timeout=WATCHDOG, check=False)
        self.assertEqual(answer.returncode, 2)
        self.assertRegex(answer.stderr, "name the run that shall stop: elastic_piston-")
        run.until_further()
        run.ctl("stop")
        self.assertEqual(run.wait(), 0, run.stderr)


class Campaign(EndToEnd):
    def test_every_kind_of_fault_once(self):
        out = self.folder / "trials.json"
        environment = os.environ | {"FSI_BIN": str(BIN)}
        answer = subprocess.run([str(FSI), "faults", "--count", "9", "--jobs", "3", "--out", str(out)], env=environment,
                                capture_output=True, text=True, check=False)
        self.assertEqual(answer.returncode, 0, answer.stdout + answer.stderr)
        self.assertEqual(len(json.loads(out.read_text())), 9)


if __name__ == "__main__":
    unittest.main()
