"""`fsi converge`: the same case on finer and finer grids; errors and rates as text, markdown and JSON.

Without a reference solution the grids are compared with each other (self_convergence.py).
"""

import json
import math
from pathlib import Path

from fsi_launch import case as cases
from fsi_launch.studies import self_convergence
from fsi_launch.failure import DONE, EXPECTATION_MISSED, Failure, UserMistake
from fsi_launch.run import Request, run
from fsi_launch.results import new_folder, whole_file
from fsi_launch.telling import tell


ROUND_OFF = 1e-13  # errors below it have no rate: fields of order one are exact there


def _has_rate(error):
    return error is not None and error > ROUND_OFF


def pairwise_rates(levels, errors):
    """Order of convergence from each level to the next; None where an error is missing or round-off."""
    rates = []
    for (j0, e0), (j1, e1) in zip(zip(levels, errors), zip(levels[1:], errors[1:])):
        rates.append(math.log(e0 / e1) / math.log(j1 / j0) if _has_rate(e0) and _has_rate(e1) else None)
    return rates


def fitted_rate(levels, errors):
    """Slope of the least-squares line through log(error) over log(h); None for fewer than two errors."""
    points = [(-math.log(j), math.log(e)) for j, e in zip(levels, errors) if _has_rate(e)]
    if len(points) < 2:
        return None
    mean_x = sum(x for x, _ in points) / len(points)
    mean_y = sum(y for _, y in points) / len(points)
    return (sum((x - mean_x) * (y - mean_y) for x, y in points)
            / sum((x - mean_x) ** 2 for x, _ in points))


def table(levels, summaries, names):
    """{levels, h, errors, rates, fitted, steps, wall_s} of finished runs."""
    errors = {name: [summary["errors"].get(name) for summary in summaries] for name in names}
    return {
        "levels": levels, "h": [1 / (10 * j) for j in levels], "errors": errors,
        "rates": {name: pairwise_rates(levels, column) for name, column in errors.items()},
        "fitted": {name: fitted_rate(levels, column) for name, column in errors.items()},
        "steps": [summary["steps"] for summary in summaries],
        "wall_s": [summary["wall_s"] for summary in summaries],
    }


def fitted(result):
    """{name: fitted rate} of a table's errors, but for those at round-off, which fall no more."""
    return {name: rate for name, rate in result["fitted"].items()
            if any(error is None or _has_rate(error) for error in result["errors"][name])}


def too_low(rates, bound):
    """Those of {name: rate} that are below `bound` or unknown."""
    return {name: rate for name, rate in rates.items() if rate is None or rate < bound}


def _rows(result):
    """The table as rows of text, the heading first."""
    rows = [["h"] + [word for name in result["errors"] for word in (name, "rate")] + ["steps", "wall [s]"]]
    for k, j in enumerate(result["levels"]):
        row = [f"1/{10 * j}"]
        for name, column in result["errors"].items():
            rate = result["rates"][name][k - 1] if k else None
            row += ["-" if column[k] is None else f"{column[k]:.2e}", "" if rate is None else f"{rate:.2f}"]
        rows.append(row + [str(result["steps"][k]), f"{result['wall_s'][k]:.1f}"])
    fitted = [result["fitted"][name] for name in result["errors"]]
    rows.append(["fit"] + [word for rate in fitted for word in ("", "" if rate is None else f"{rate:.2f}")] + ["", ""])
    return rows


def as_text(result):
    rows = _rows(result)
    widths = [max(len(row[k]) for row in rows) for k in range(len(rows[0]))]
    return "\n".join("  ".join(cell.rjust(width) for cell, width in zip(row, widths)) for row in rows) + "\n"


def as_markdown(result):
    rows = _rows(result)
    lines = ["| " + " | ".join(row) + " |" for row in rows]
    return "\n".join([lines[0], "|" + "---|" * len(rows[0]), *lines[1:]]) + "\n"


def _expect_errors(names, errors):
    if unknown := set(names) - set(errors):
        raise UserMistake(f"--rates: no error {', '.join(sorted(unknown))}; there are: "
                          + (", ".join(errors) or "none, for want of a reference solution"))


def _expect_valid(options):
    """A mistake on the finest grid must not show after the runs on the others."""
    for j in options.levels:
        try:
            cases.resolve(options.case, [*options.overrides, f"grid.factor={j}"], options.laws)
        except UserMistake as mistake:
            raise UserMistake(f"level {j}: {mistake}") from None


def _expect_finer(levels, coarse, fine):
    """Grids of {name: points} on two levels that differ; those that do not are told. Throws UserMistake where none does."""
    same = [name for name, points in fine.items() if points == coarse.get(name)]
    if not same:
        return
    words = (f"level {levels[1]}: {', '.join(same)} with as many points as on level {levels[0]}: numbers that the case gives "
             "for `points` or `spacing` do not follow grid.factor")
    if same == list(fine):
        raise UserMistake(f"{words}, so these grids are one and the same; leave them out, or write `spacing: h` or a part of h")
    tell(words)


def _points(summary):
    return {name: entry["points"] for name, entry in summary["participants"].items() if "points" in entry}


def _run_levels(options, directory):
    """Summaries of the runs, one per level. Throws the Failure of the first run that fails."""
    summaries = []
    for j in options.levels:
        overrides = [*options.overrides, f"grid.factor={j}"]
        tell(f"level {j}: h = 1/{10 * j}")
        # An expectation made for one grid says nothing about the others: only the errors count here.
        result = run(Request(case=options.case, overrides=overrides, laws=options.laws, quiet=True, judge=False,
                             out=str(directory / f"level_{j}")))
        if result.code != DONE:
            raise Failure(result.code, f"level {j} failed; no table")
        _expect_errors(options.rates, result.summary["errors"])
        if summaries:
            _expect_finer(options.levels[len(summaries) - 1:], _points(summaries[-1]), _points(result.summary))
        summaries.append(result.summary)
    return summaries


def _nothing_to_compare(case):
    return UserMistake(f"{case.name} has no reference solution and no solid that moves: there is nothing to compare")


def _compare_levels(options, case, directory):
    """The bodies on each grid against those on the next finer one."""
    times = sorted({*case.times, case.end})  # the end is written whatever the times of output
    rows = self_convergence.compare(options.levels, [directory / f"level_{j}" for j in options.levels], times)
    if not rows:
        raise _nothing_to_compare(case)
    text = self_convergence.as_text(options.levels, rows)
    print(text, end="")
    for suffix, content in (("txt", text), ("md", self_convergence.as_markdown(options.levels, rows)),
                            ("json", self_convergence.as_json(options.levels, rows))):
        whole_file.write(directory / f"converge.{suffix}", content)
    tell(f"tables in {directory}")
    return _judge({f"{row.quantity} of {row.solid} at t = {row.t:g}": row.orders[-1] if row.orders else None for row in rows
                   if any(difference > row.round_off for difference in row.differences)}, options.min_rate)


def _judge(rates, least):
    """The exit code, after a line for every rate below `least`; None: nothing is asked."""
    low = {} if least is None else too_low(rates, least)
    for name, rate in low.items():
        tell(f"fsi: rate of {name} is {'unknown' if rate is None else f'{rate:.2f}'}, must be at least {least:g}")
    return EXPECTATION_MISSED if low else DONE


def _expect_enough(options, case):
    """Something to compare, on levels enough; with a reference solution one grid has errors too. Throws UserMistake."""
    if case.reference == "none" and all(program == "fluid_solver" for program in case.programs.values()):
        raise _nothing_to_compare(case)
    least = 2 if case.reference == "none" or options.min_rate is not None else 1
    if len(options.levels) < least:
        words = ("two grids or more for a rate of convergence" if case.reference != "none" else
                 "two grids or more to compare, without a reference solution, and three for orders")
        raise UserMistake(f"--levels {','.join(map(str, options.levels))}: it takes {words}; write --levels J,J,J")
    if case.reference == "none" and options.min_rate is not None and len(options.levels) < 3:
        raise UserMistake("--min-rate: without a reference solution a rate takes three grids, --levels J,J,J")


def main(options):
    """Prints the table and writes converge.{txt,md,json}."""
    case = cases.resolve(options.case, options.overrides, options.laws)
    _expect_enough(options, case)
    if case.reference == "none" and (module := self_convergence.lacks()):
        tell(f"the rows 'boundary' are left out, they take {module}: apt-get install python3-h5py python3-matplotlib")
    name = case.name
    directory = Path(options.out) if options.out else None
    if directory and directory.exists() and (not directory.is_dir() or any(directory.iterdir())):
        raise UserMistake(f"--out {directory} is not empty; name a new folder")
    _expect_valid(options)
    directory = directory or new_folder.claimed(f"converge-{name}")
    summaries = _run_levels(options, directory)
    names = [key for key in summaries[0]["errors"] if not options.rates or key in options.rates]
    if not names:
        return _compare_levels(options, case, directory)
    result = table(options.levels, summaries, names) | {"case": name, "overrides": options.overrides}
    text = as_text(result)
    print(text, end="")
    for suffix, content in (("txt", text), ("md", as_markdown(result)), ("json", json.dumps(result, indent=2) + "\n")):
        whole_file.write(directory / f"converge.{suffix}", content)
    tell(f"tables in {directory}")
    return _judge(fitted(result), options.min_rate)
