"""probes.csv: what every program wrote about its own probes, side by side in one table over time."""

import csv
import os
from pathlib import Path


def _read(path):
    """(headings without the time, {time: values}) of one program's table; the times are kept as text."""
    with open(path, encoding="utf-8", newline="") as file:
        heading, *rows = [row for row in csv.reader(file) if row]
    return heading[1:], {row[0]: row[1:] for row in rows if len(row) == len(heading)}


def merge(directory, programs):
    """Joins DIR/parts/probes_<participant>.csv into DIR/probes.csv; they stay, for a restart. A line that one
    program did not reach, because it was killed, has empty entries there."""
    folder = Path(directory) / "parts"
    parts = [path for path in (folder / f"probes_{name}.csv" for name in programs) if path.is_file()]
    tables = [_read(path) for path in parts if path.stat().st_size > 0]
    if not tables:
        return
    times = dict.fromkeys(time for _, rows in tables for time in rows)
    temporary = Path(directory) / "probes.csv.part"
    with open(temporary, "w", encoding="utf-8", newline="") as file:
        table = csv.writer(file, lineterminator="\n")
        table.writerow(["t [time]", *(name for heading, _ in tables for name in heading)])
        for time in sorted(times, key=float):
            table.writerow([time, *(value for heading, rows in tables
                                    for value in rows.get(time, [""] * len(heading)))])
    os.replace(temporary, Path(directory) / "probes.csv")
