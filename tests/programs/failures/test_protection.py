#!/usr/bin/python3
"""Who can take part in a run, by the launcher's options: its own programs, its user's monitors, and nobody else."""

import os
import subprocess
import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from running import BIN, EndToEnd, Launched  # noqa: E402

SMALL = ("spring_piston", "--set", "grid.factor=2")
KEYS = {"--no-security": "", "--encrypt": "encrypt:", None: "sign:"}


class Protection(EndToEnd):
    def bits(self, run):
        return (run.directory / "interface.csv").read_bytes()

    def test_numbers_are_the_same_bit_for_bit_however_a_run_is_protected(self):
        runs = [self.complete(*SMALL, *([option] if option else []), out=f"run{number}")
                for number, option in enumerate(KEYS)]
        self.assertEqual(len({self.bits(run) for run in runs}), 1)

    def test_unprotected_runs_that_begin_at_the_same_moment_are_two_runs(self):
        moment = "import time\ntime.time_ns = lambda: 5\ntime.strftime = lambda *_: '000000'"
        runs = []
        for name, cfl in (("one", "0.5"), ("other", "0.6")):
            (self.folder / name).mkdir()
            runs.append(Launched(self.folder / name, *SMALL, "--no-security", "--set", f"time.cfl={cfl}", script=moment))
            self.addCleanup(self._end, runs[-1])
        self.assertEqual([run.wait() for run in runs], [0, 0], [run.stderr for run in runs])

    def test_programs_of_a_run_get_the_key_that_the_option_asks_for(self):
        for number, (option, kind) in enumerate(KEYS.items()):
            run = self.launch(*SMALL, "--set", "time.dt=1e-7", *([option] if option else []), out=f"run{number}")
            for pid in run.until_stepping().values():
                with open(f"/proc/{pid}/environ", "rb") as environment:
                    variables = dict(entry.split(b"=", 1) for entry in environment.read().split(b"\0") if b"=" in entry)
                self.assertEqual(variables[b"AMP_FSI_KEY"].decode().partition(":")[0], kind.rstrip(":"))
            self.monitor(run, str(run.directory), "--send", "stop")
            self.assertEqual(run.wait(), 0, run.stderr)
            self.assertEqual(run.summary()["status"], "stopped")

    def monitor(self, run, *words):
        answer = subprocess.run([str(BIN / "monitor"), *words], stdin=subprocess.DEVNULL, capture_output=True, text=True,
                                env=os.environ | {"XDG_RUNTIME_DIR": str(run.runtime)}, check=False)
        self.assertEqual(answer.returncode, 0, answer.stderr)

    def test_credentials_of_a_program_in_another_language_are_its_users_alone(self):
        command = [str(BIN / "fsi_credentials"), "run-1", "solid", str(self.folder)]
        refused = subprocess.run(command, capture_output=True, text=True, check=False,
                                 env={name: value for name, value in os.environ.items() if name != "AMP_FSI_KEY"})
        self.assertEqual(refused.returncode, 2)
        self.assertIn("AMP_FSI_KEY is not set", refused.stderr)
        subprocess.run(command, check=True, env=os.environ | {"AMP_FSI_KEY": "sign:0123456789"})
        files = sorted(self.folder.iterdir())
        self.assertEqual([file.name for file in files], ["authority.pem", "certificate.pem", "governance.p7s",
                                                         "permissions.p7s", "private_key.pem"])
        self.assertEqual({file.stat().st_mode & 0o777 for file in files}, {0o600})
        self.assertIn("BEGIN PRIVATE KEY", (self.folder / "private_key.pem").read_text(encoding="utf-8"))


if __name__ == "__main__":
    unittest.main()
