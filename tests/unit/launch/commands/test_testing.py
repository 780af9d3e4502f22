#!/usr/bin/python3
"""`fsi test` ends with all that it has started, however it is ended."""

import os
import signal
import subprocess
import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from launcher import InScratch, ended  # noqa: E402
from fsi_launch import paths  # noqa: E402

PYTHON = "/usr/bin/python3"
# Stands for CTest with a test.
RUNNER = """
import subprocess, sys
test = subprocess.Popen(["/bin/sleep", "1000000"])
print(test.pid, file=open(sys.argv[1], "w"))
test.wait()
"""


class Ends(InScratch):
    def end_by(self, number):
        """(what ended that which stands for `fsi test`, pidfd of its test, pidfd of its runner) once it has got a signal."""
        begun = self.folder / "begun"
        os.mkfifo(begun)
        launcher = f"""
import os, sys
sys.path.insert(0, {str(paths.ROOT / "launch")!r})
from fsi_launch.living import interrupts
from fsi_launch.trials import testing
interrupts.listen()
try:
    testing.with_all_it_starts([{PYTHON!r}, "-c", {RUNNER!r}, {str(begun)!r}])
except (KeyboardInterrupt, interrupts.Terminated) as request:
    sys.exit(type(request).__name__)
"""
        said = self.folder / "said"
        with open(said, "w", encoding="utf-8") as file, subprocess.Popen([PYTHON, "-c", launcher], stderr=file,
                                                                         env=os.environ | {"FSI_BIN": str(paths.BIN)}) as process:
            test = int(begun.read_text(encoding="ascii"))
            self.addCleanup(lambda: os.path.exists(f"/proc/{test}") and os.kill(test, signal.SIGKILL))
            runner = int(Path(f"/proc/{test}/stat").read_text(encoding="ascii").split()[3])
            ends = [os.pidfd_open(pid) for pid in (test, runner)]
            process.send_signal(number)
        return said.read_text(encoding="utf-8").strip(), *ends

    def test_a_request_ends_its_tests_too(self):
        for number, name in ((signal.SIGTERM, "Terminated"), (signal.SIGINT, "KeyboardInterrupt")):
            with self.subTest(name):
                said, test, runner = self.end_by(number)
                self.assertEqual(said, name)
                ended(runner)
                ended(test)
                (self.folder / "begun").unlink()

    def test_where_it_is_killed_no_further_test_begins(self):
        _, test, runner = self.end_by(signal.SIGKILL)
        ended(runner)
        os.close(test)


if __name__ == "__main__":
    unittest.main()
