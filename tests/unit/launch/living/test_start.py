#!/usr/bin/python3
"""fsi_start becomes the program that it is told, on the cores it is told, hears what asks it to end, and lives no longer than its
launcher."""

import os
import signal
import subprocess
import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from launcher import InScratch, ended  # noqa: E402
from fsi_launch import paths  # noqa: E402
from fsi_launch.living import supervise  # noqa: E402

PYTHON = "/usr/bin/python3"


def said(command):
    return subprocess.run(command, capture_output=True, text=True, check=False)


class Starting(InScratch):
    def test_the_program_gets_its_words(self):
        self.assertEqual(said(supervise.leashed([PYTHON, "-c", "import sys; print(sys.argv[1:])", "--a", "b c"])).stdout, "['--a', 'b c']\n")

    def test_it_runs_on_its_cores(self):
        able = sorted(os.sched_getaffinity(0))
        for cores, expected in (({able[-1]}, able[-1:]), (set(able), able), (None, able)):
            command = supervise.leashed([PYTHON, "-c", "import os; print(sorted(os.sched_getaffinity(0)))"], cores)
            self.assertEqual(said(command).stdout, f"{expected}\n")

    def test_it_does_not_begin_without_its_launcher(self):
        command = [paths.program("fsi_start"), str(os.getppid()), "-", "/usr/bin/touch", str(self.folder / "begun")]
        self.assertEqual(said(command).returncode, 1)
        self.assertFalse((self.folder / "begun").exists())

    def test_it_hears_signals_that_the_launcher_holds_back(self):
        held = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT, signal.SIGTERM, signal.SIGHUP})
        try:
            for number in ("INT", "TERM", "HUP"):
                self.assertEqual(said(supervise.leashed(["/bin/sh", "-c", f"kill -{number} $$"])).returncode, -signal.Signals["SIG" + number])
        finally:
            signal.pthread_sigmask(signal.SIG_SETMASK, held)

    def test_it_dies_with_its_launcher(self):
        begun = self.folder / "begun"
        os.mkfifo(begun)
        launcher = f"""
import signal, subprocess, sys
sys.path.insert(0, {str(paths.ROOT / "launch")!r})
from fsi_launch.living import supervise
subprocess.Popen(supervise.leashed(["/bin/sh", "-c", "echo $$ >{begun}; exec sleep 1000000"]), start_new_session=True)
signal.pause()
"""
        with subprocess.Popen([PYTHON, "-c", launcher], env=os.environ | {"FSI_BIN": str(paths.BIN)}) as process:
            pid = int(begun.read_text(encoding="ascii"))
            pidfd = os.pidfd_open(pid)
            process.kill()
        ended(pidfd)

    def test_what_cannot_be_executed_is_named(self):
        ended = said(supervise.leashed([str(self.folder / "nothing")]))
        self.assertEqual((ended.returncode, ended.stderr), (127, f"fsi_start: {self.folder}/nothing: No such file or directory\n"))


if __name__ == "__main__":
    unittest.main()
