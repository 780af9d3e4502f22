"""What several runs have in common, drawn side by side."""

from fsi_launch.failure import UserMistake
from fsi_launch.plot.one_run import beams
from fsi_launch.plot.reading import data
from fsi_launch.plot.several_runs import lines, outlines, several, side_by_side
from fsi_launch.telling import AS_NAMED


def _case_of(directory):
    path = directory / "case.yaml"
    return path.read_text(**AS_NAMED) if path.is_file() else ""


def _beams(runs, out):
    runs = [run for run in runs if run.beams]
    if not runs:
        return
    yield "centrelines_compared", beams.picture(runs)
    if rows := beams.table(runs):
        several.write_table(beams.HEADING, rows, out / "centrelines.csv")
        for label, coarse, fine, t, distance in rows:
            print(f"{label}: centrelines of j = {coarse:g} and {fine:g} at t = {t:g} are up to {distance:.2e} apart")


def pictures(directories, out, times=()):
    """(name, figure) for each kind of thing at least one of the runs holds, at `times` alone where some are given."""
    series, cases = [data.at_times(data.all_series(one), times) for one in directories], [_case_of(one) for one in directories]
    told = several.labels(cases, several.names(directories))
    same = len({several.entries(case).get("name") for case in cases}) == 1
    runs = [beams.run_of(one, case) for one, case in zip(series, cases)]
    slender = {beam.name for run in runs for beam in run.beams}
    along_a_line = list(lines.pictures(series, told))      # where the solids' outlines say nothing more
    parts = [*_beams(runs, out), *(() if along_a_line else outlines.pictures(series, told, out, slender)), *along_a_line,
             *(side_by_side.pictures(series, told) if same else ())]
    if not parts:
        raise UserMistake("the runs hold nothing that can be compared: several runs are for beams, outlines of solids, fields "
                          "along a line and, of one case, gas with shocks, at output times that all of them have")
    yield from parts
