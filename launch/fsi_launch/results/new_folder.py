"""A new folder in runs/, for whoever names none."""

import time
from pathlib import Path

from fsi_launch.failure import Failure, OUTPUT_FAILED


def claimed(name):
    """runs/NAME-DATE-TIME, or the first of .., ..-2, ..-3 that is not there. It is made, so that nobody else who begins in the same second
    takes it."""
    runs, stamp = Path("runs"), f"{name}-{time.strftime('%Y%m%d-%H%M%S')}"
    runs.mkdir(exist_ok=True)
    for count in range(1, 1000):
        directory = runs / (stamp + (f"-{count}" if count > 1 else ""))
        try:
            directory.mkdir()
            return directory
        except FileExistsError:
            continue
    raise Failure(OUTPUT_FAILED, f"no free name for {stamp} in runs/; name a folder with --out")
