"""`fsi test`: everything CTest knows of, after the bootstrap has built it."""

import os
import subprocess

from fsi_launch import paths
from fsi_launch.failure import DONE, EXPECTATION_MISSED

LABELS = ("unit", "programs", "convergence", "regression")


def jobs():
    """Programs wait for one another much of the time, and so do their tests: two for each processor."""
    return 2 * (os.cpu_count() or 1)


def main(options):
    """Runs CTest; its closing lines are the last that is printed."""
    labels = LABELS[:1] if options.quick else LABELS
    command = ["ctest", "--test-dir", str(paths.BUILD), "--output-on-failure", "--no-tests=error",
               "-j", str(jobs()), "-L", "^(" + "|".join(labels) + ")$"]
    if options.pattern:
        command += ["-R", options.pattern]
    environment = {key: value for key, value in os.environ.items() if key != "FSI_BIN"}
    code = subprocess.run(command, stdin=subprocess.DEVNULL, env=environment, check=False).returncode
    return DONE if code == 0 else EXPECTATION_MISSED
