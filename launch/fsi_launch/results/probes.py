"""probes.csv: what every program wrote about its own probes, side by side in one table over time."""

import csv
from pathlib import Path

from fsi_launch.results import whole_file


def _read(path):
    """(headings without the time, {time: values}) of one program's table; the times are kept as text."""
    with open(path, encoding="utf-8", newline="") as file:
        heading, *rows = [row for row in csv.reader(file) if row]
    return heading[1:], {row[0]: row[1:] for row in rows if len(row) == len(heading)}


def joined(directory, programs=None):
    """The rows of DIR/parts/probes_<participant>.csv side by side, the heading first, as far as they have come; [] where there are none. A
    line that one program did not reach, because it was killed, has empty entries there. `programs`: their order; None: by name."""
    folder = Path(directory) / "parts"
    parts = sorted(folder.glob("probes_*.csv")) if programs is None else [folder / f"probes_{name}.csv" for name in programs]
    tables = [_read(path) for path in parts if path.is_file() and path.stat().st_size > 0]
    if not tables:
        return []
    times = dict.fromkeys(time for _, rows in tables for time in rows)
    return [["t [time]", *(name for heading, _ in tables for name in heading)],
            *([time, *(value for heading, rows in tables for value in rows.get(time, [""] * len(heading)))]
              for time in sorted(times, key=float))]


def in_parts(directory):
    """Whether the parts are what there is: while a run goes on, and where its launcher was killed. A probes.csv is then that of the run
    which a restart goes on with."""
    directory = Path(directory)
    ended = (directory / "summary.json").is_file() and (directory / "probes.csv").is_file()
    return not ended and any(directory.glob("parts/probes_*.csv"))


def merge(directory, programs):
    """Joins DIR/parts/probes_<participant>.csv into DIR/probes.csv; they stay, for a restart."""
    rows = joined(directory, programs)
    if not rows:
        return
    with whole_file.writing(Path(directory) / "probes.csv", newline="") as file:   # nothing of it stays where there is no room: the summary may find some
        csv.writer(file, lineterminator="\n").writerows(rows)
