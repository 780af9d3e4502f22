#!/usr/bin/python3
"""Accidents other than a lost program: broken numbers, a full or vanished folder, requests at the wrong time; and a short
form of the campaign of `fsi faults`."""

import json
import math
import os
import subprocess
import time
import unittest
from pathlib import Path

from running import BIN, EndToEnd, FSI, until

SLOW = ("elastic_piston", "--set", "grid.factor=2", "--set", "time.dt=5e-4", "--set", "expect={}")
BREAKS = ("elastic_piston", "--set", "parameters.density_ratio=1e-3", "--set", "interface.projection=traditional",
          "--set", "output.times=[0]")


class BrokenNumbers(EndToEnd):
    def test_state_just_before_is_written_and_still_sound(self):
        import h5py
        run = self.launch(*BREAKS)
        self.assertEqual(run.wait(), 3, run.stderr)
        self.assertRegex(run.stderr, r"step \d+, t = .*grid|step \d+, t = .*point")
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

    def lose(self, folder, *more):
        run = self.launch(*SLOW, "--set", "output.every=0.02", *more)
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
        self.assertEqual(run.wait(), 0, run.stderr)
        self.assertEqual(run.summary()["status"], "completed")
        self.assertGreater(run.summary()["counters"]["lost_outputs"], 0)


class Requests(EndToEnd):
    def ctl(self, run, word):
        environment = os.environ | {"FSI_BIN": str(BIN), "XDG_RUNTIME_DIR": str(run.runtime)}
        subprocess.run([str(FSI), "ctl", str(run.directory), word], check=True, env=environment, timeout=30, capture_output=True)

    def entry(self, run):
        """(path, content) of its entry in the registry."""
        path = next((run.runtime / "amp-fsi").glob("*.json"))
        return path, json.loads(path.read_text(encoding="utf-8"))

    def send_with_key(self, run, key, word):
        """What somebody can do who sees the run on the bus and has a registry of his own."""
        path, content = self.entry(run)
        others = self.folder / "others" / "amp-fsi"
        others.mkdir(parents=True, exist_ok=True)
        (others / path.name).write_text(json.dumps(content | {"key": key}), encoding="utf-8")
        environment = os.environ | {"FSI_BIN": str(BIN), "XDG_RUNTIME_DIR": str(others.parent)}
        subprocess.run([str(FSI), "ctl", content["run"], word], env=environment, timeout=30, capture_output=True, check=True)

    def table(self, run):
        return (run.directory / "interface.csv").read_text(encoding="utf-8").splitlines()

    def test_requests_without_the_key_of_the_run_change_nothing(self):
        case = (*SLOW, "--set", "time.dt=1e-5")
        run = self.launch(*case)
        run.until_stepping()
        self.send_with_key(run, "", "stop")
        self.send_with_key(run, "0" * 64, "pause")
        self.assertTrue(until(lambda: (run.directory / "log" / "coupler.log").read_text().count("ignored the request") == 2))
        before = self.steps(run)
        self.assertTrue(until(lambda: self.steps(run) > before + 5000))
        self.assertEqual(self.checkpoints(run), [])
        self.ctl(run, "stop")
        self.assertEqual(run.wait(), 0, run.stderr)
        alone = self.launch(*case, out="alone")
        self.assertTrue(until(lambda: alone.directory.is_dir() and (alone.directory / "interface.csv").is_file()
                              and self.steps(alone) > self.steps(run)))
        self.ctl(alone, "stop")
        self.assertEqual(alone.wait(), 0, alone.stderr)
        self.assertEqual(self.table(run), self.table(alone)[:len(self.table(run))])

    def test_key_is_nowhere_but_in_the_entry_that_only_the_user_reads(self):
        run = self.launch(*SLOW, "--set", "time.dt=1e-5")
        programs = run.until_stepping()
        path, content = self.entry(run)
        self.assertEqual(path.stat().st_mode & 0o777, 0o600)
        self.assertEqual(path.parent.stat().st_mode & 0o777, 0o700)
        key = content["key"].encode()
        self.assertGreaterEqual(len(key), 32)
        for pid in programs.values():
            self.assertNotIn(key, (Path("/proc") / str(pid) / "cmdline").read_bytes())
        self.ctl(run, "stop")
        self.assertEqual(run.wait(), 0, run.stderr)
        for file in run.directory.rglob("*"):
            self.assertTrue(file.is_dir() or key not in file.read_bytes(), file)

    def checkpoints(self, run):
        return sorted(path.parent.name for path in run.directory.glob("checkpoints/*/manifest.json"))

    def steps(self, run):
        return (run.directory / "interface.csv").stat().st_size

    def test_paused_run_takes_no_step_but_checkpoints_and_ends_at_a_stop(self):
        run = self.launch(*SLOW, "--set", "time.dt=1e-5")
        run.until_stepping()
        self.ctl(run, "pause")
        time.sleep(0.5)
        before = self.steps(run)
        time.sleep(1)
        self.assertEqual(self.steps(run), before)
        self.ctl(run, "checkpoint")
        self.assertTrue(until(lambda: self.checkpoints(run)))
        self.ctl(run, "resume")
        self.assertTrue(until(lambda: self.steps(run) > before + 5000))
        self.ctl(run, "stop")
        self.assertEqual(run.wait(), 0, run.stderr)
        self.assertEqual(run.summary()["status"], "stopped")
        newest = json.loads((run.directory / "checkpoints" / self.checkpoints(run)[-1] / "manifest.json").read_text())
        self.assertEqual(newest["step"], run.summary()["steps"])


class Campaign(EndToEnd):
    def test_every_kind_of_fault_once(self):
        out = self.folder / "trials.json"
        environment = os.environ | {"FSI_BIN": str(BIN)}
        answer = subprocess.run([str(FSI), "faults", "--count", "9", "--jobs", "3", "--out", str(out)], env=environment,
                                capture_output=True, text=True, timeout=200, check=False)
        self.assertEqual(answer.returncode, 0, answer.stdout + answer.stderr)
        self.assertEqual(len(json.loads(out.read_text())), 9)


if __name__ == "__main__":
    unittest.main()
