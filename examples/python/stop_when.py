#!/usr/bin/python3
"""A run that is watched and ended by a condition: a disk is set in rotation, and the run is stopped once it has turned by an angle.

    PYTHONPATH=launch examples/python/stop_when.py [FOLDER]

It then goes on a little from the checkpoint it left, and prints the angle over time.
"""

import sys
from pathlib import Path

import amp_fsi

ANGLE = 0.005   # [rad]
LONGER = 0.1    # [time]


def angle_so_far(folder):
    """The last angle in the table of the disk; 0 before there is one."""
    try:
        return amp_fsi.open(folder).forces("disk")["angle"][-1]
    except (FileNotFoundError, KeyError, IndexError):
        return 0.0


def main(folder):
    running = amp_fsi.start("rotating_disk", out=folder, overwrite=True,
                            set={"grid.factor": 2, "time.end": 50, "output.every": 0.05, "reference": "{kind: none}", "expect": {}})
    running.until(lambda: abs(angle_so_far(folder)) > ANGLE)
    running.stop()
    stopped = running.wait()
    t = stopped.summary["t"]
    print(f"{stopped.summary['status']} at t = {t:.4g}")
    whole = amp_fsi.run(restart=folder, set={"time.end": t + LONGER})
    table = whole.forces("disk")
    for t in whole.times("disk"):
        k = abs(table["t"] - t).argmin()
        print(f"t = {table['t'][k]:.3f}  angle = {table['angle'][k]: .5f}")


if __name__ == "__main__":
    main(Path(sys.argv[1] if len(sys.argv) > 1 else "runs/stop_when"))
