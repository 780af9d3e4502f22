"""What a case without a reference solution converges to: differences from each grid to the next finer one, for the bodies.

Position, velocity and turn of each solid come from forces_<solid>.csv, boundary curves from its fields; both at the output
times. The order is the logarithm of the ratio of successive differences.
"""

import csv
import json
import math
from dataclasses import dataclass
from pathlib import Path

from fsi_launch.telling import AS_NAMED

QUANTITIES = (("centre", ("centre1", "centre2")), ("velocity", ("velocity1", "velocity2")), ("angle", ("angle",)))
ROUND_OFF = 1e-13   # of the size of such values: smaller differences have no order
RADIAN = 1.0        # size of angles, however little the bodies turn
FINER = 8           # times the points, for the curve a boundary is compared with


@dataclass
class Row:
    """One quantity of one solid at one time: a difference for each pair of levels, an order for each pair of those."""

    solid: str
    quantity: str
    t: float
    differences: list
    orders: list
    round_off: float = 0.0      # differences below it are that


def orders(levels, differences, size):
    """Observed orders; None where a difference is round-off of values of this size, or the levels are not in one ratio."""
    result = []
    for k in range(len(differences) - 1):
        ratio, next_ratio = levels[k + 1] / levels[k], levels[k + 2] / levels[k + 1]
        a, b = differences[k], differences[k + 1]
        told = min(a, b) > ROUND_OFF * size and math.isclose(ratio, next_ratio)
        result.append(math.log(a / b) / math.log(ratio) if told else None)
    return result


def _table(path):
    """{t: {column: value}} of a table of a solid."""
    with open(path, **AS_NAMED, newline="") as file:
        rows = [{key.split(" ")[0]: float(value) for key, value in row.items()} for row in csv.DictReader(file)]
    return {row["t"]: row for row in rows}


def _tables(directory):
    return {path.stem.removeprefix("forces_"): _table(path) for path in sorted(Path(directory).glob("forces_*.csv"))}


def _refined(curve):
    """A closed curve with more points, by trigonometric interpolation in the index."""
    import numpy as np
    points = curve[:-1, 0] + 1j * curve[:-1, 1]
    n = len(points)
    spectrum = np.fft.fft(points)
    padded = np.zeros(FINER * n, dtype=complex)
    half = n // 2
    padded[:half] = spectrum[:half]
    padded[-(n - half):] = spectrum[half:]
    fine = np.fft.ifft(padded) * FINER
    return np.column_stack([np.append(fine.real, fine.real[0]), np.append(fine.imag, fine.imag[0])])


def lacks():
    """The module that boundary curves take and that is not installed, or None."""
    try:
        from fsi_launch.plot.several_runs import outlines  # noqa: F401
    except ModuleNotFoundError as error:
        return error.name
    return None


def _outlines(directory):
    """{solid: {t: closed outline}}; nothing where h5py or matplotlib is missing."""
    if lacks():
        return {}
    from fsi_launch.plot.reading import data
    from fsi_launch.plot.several_runs import outlines
    return {body.name: body.outlines for body in outlines.of(data.all_series(Path(directory)), outlines.ring)}


def _speed_of_gas(directory):
    """The largest at the bodies, with that of sound; 0 where there is none."""
    try:
        summary = json.loads((Path(directory) / "summary.json").read_text(encoding="utf-8"))
        return float(summary["interface"]["velocity_scale"])
    except (OSError, ValueError, LookupError, TypeError):
        return 0.0


def _sizes(tables, curves, directories):
    """{quantity: size of its values}, of all solids together: one whose values are round-off of these is at rest. Places are compared
    with the largest coordinate of centres and boundaries, velocities with the largest one of the bodies or of the gas at them."""
    def largest(columns):
        return max((abs(line[column]) for table in tables for solid in table.values() for line in solid.values() for column in columns
                    if column in line), default=0.0)
    found = {name: largest(columns) for name, columns in QUANTITIES}
    reach = max((float(abs(line).max()) for run in curves for body in run.values() for line in body.values()), default=0.0)
    found["centre"] = found["boundary"] = max(found["centre"], reach)
    found["velocity"] = max(found["velocity"], *map(_speed_of_gas, directories))
    return found | {"angle": max(found["angle"], RADIAN)}


def _at(lines, t):
    """The one of {time: line} at t, or None."""
    return next((line for time, line in lines.items() if math.isclose(time, t, rel_tol=1e-9)), None)


def _distance(coarse, fine):
    from fsi_launch.plot.several_runs import outlines
    return float(outlines.distance(coarse, _refined(fine)))


def _apart(name, a, b):
    """Distance of two values, tuples of numbers; of two angles that over which they are nearest."""
    return abs(math.remainder(a[0] - b[0], 2 * math.pi)) if name == "angle" else math.dist(a, b)


def compare(levels, directories, times):
    """Rows of all solids, quantities and output times. A solid of one's own may lack columns, and has no rows of these then."""
    tables = [_tables(directory) for directory in directories]
    curves = [_outlines(directory) for directory in directories]
    sizes, rows = _sizes(tables, curves, directories), []

    def add(solid, name, t, found):
        rows.append(Row(solid, name, t, found, orders(levels, found, sizes[name]), ROUND_OFF * sizes[name]))
    for solid in tables[0]:
        runs = [table.get(solid, {}) for table in tables]
        for t in (t for t in times if t > 0 and all(t in run for run in runs)):
            for name, columns in QUANTITIES:
                if not all(column in run[t] for run in runs for column in columns):
                    continue
                values = [[run[t][column] for column in columns] for run in runs]
                add(solid, name, t, [_apart(name, coarse, fine) for coarse, fine in zip(values, values[1:])])
            lines = [_at(one.get(solid, {}), t) for one in curves]
            if all(line is not None for line in lines):
                add(solid, "boundary", t, [_distance(coarse, fine) for coarse, fine in zip(lines, lines[1:])])
    return rows


def _cells(levels, rows):
    heading = ["solid", "quantity", "t"]
    for k, (a, b) in enumerate(zip(levels, levels[1:])):
        heading += [f"1/{10 * a} to 1/{10 * b}"] + (["order"] if k else [])
    lines = [heading]
    for row in rows:
        line = [row.solid, row.quantity, f"{row.t:g}"]
        for k, difference in enumerate(row.differences):
            line.append(f"{difference:.2e}")
            if k:
                line.append("-" if row.orders[k - 1] is None else f"{row.orders[k - 1]:.2f}")
        lines.append(line)
    return lines


def as_text(levels, rows):
    lines = _cells(levels, rows)
    widths = [max(len(line[k]) for line in lines) for k in range(len(lines[0]))]
    return "\n".join("  ".join(cell.rjust(width) for cell, width in zip(line, widths)) for line in lines) + "\n"


def as_markdown(levels, rows):
    lines = ["| " + " | ".join(line) + " |" for line in _cells(levels, rows)]
    return "\n".join([lines[0], "|" + "---|" * len(_cells(levels, rows)[0]), *lines[1:]]) + "\n"


def as_json(levels, rows):
    return json.dumps({"levels": levels, "differences": [vars(row) for row in rows]}, indent=2) + "\n"
