"""`fsi test`: everything CTest knows of, after the bootstrap has built it."""

import contextlib
import os
import signal
import subprocess

from fsi_launch import paths
from fsi_launch.failure import DONE, EXPECTATION_MISSED
from fsi_launch.living import interrupts
from fsi_launch.living.supervise import leashed

LABELS = ("unit", "programs", "convergence", "regression")


def jobs():
    """Programs wait for one another much of the time, and so do their tests: two for each processor."""
    return 2 * (os.cpu_count() or 1)


def with_all_it_starts(command, environment=None):
    """Exit code of a command that ends with this process. A request to end goes to it and to all that it has started: CTest by itself
    would leave its tests to their own."""
    with interrupts.held(), subprocess.Popen(leashed(command), stdin=subprocess.DEVNULL, env=environment, start_new_session=True) as process:
        try:
            with interrupts.heard():
                return process.wait()
        except (KeyboardInterrupt, interrupts.Terminated):
            with contextlib.suppress(ProcessLookupError):
                os.killpg(process.pid, signal.SIGTERM)
            raise


def main(options):
    """Runs CTest; its closing lines are the last that is printed."""
    labels = LABELS[:1] if options.quick else LABELS
    command = ["ctest", "--test-dir", str(paths.BUILD), "--output-on-failure", "--no-tests=error",
               "-j", str(jobs()), "-L", "^(" + "|".join(labels) + ")$"]
    if options.pattern:
        command += ["-R", options.pattern]
    environment = {key: value for key, value in os.environ.items() if key != "FSI_BIN"}
    code = with_all_it_starts(command, environment)
    return DONE if code == 0 else EXPECTATION_MISSED
