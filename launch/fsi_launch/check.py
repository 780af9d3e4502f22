"""`fsi check`: is a case right, what will it cost, and what do its grids look like?"""

import tempfile
from pathlib import Path

from fsi_launch import case as cases
from fsi_launch import paths
from fsi_launch.failure import DONE, Failure, INTERNAL_ERROR, UserMistake
from fsi_launch.living import ranks
from fsi_launch.telling import answer_of

FORMATS = (".png", ".pdf", ".svg")


def _picture_path(name, case):
    """Where the picture goes: what the user says, else in this folder by the name of the case."""
    path = Path(name or f"{case.name}_grids.png")
    if path.suffix not in FORMATS:
        raise UserMistake(f"--plot {path}: pictures are {', '.join(FORMATS)}; end the name with one of them")
    if not path.absolute().parent.is_dir():
        raise UserMistake(f"--plot {path}: there is no folder '{path.parent}'; make it, or name another")
    return path


def _write_grids(options, folder):
    command = [paths.program("fsi_grids"), options.case, folder, *(f"--set={one}" for one in options.overrides),
               *(f"--solid={one}" for one in options.laws)]
    answer = answer_of(command, f"fsi: making the grids of {options.case}")
    if answer.returncode != 0:
        raise Failure(INTERNAL_ERROR, answer.stderr.strip() or f"fsi_grids failed ({answer.returncode})")


def draw(options):
    """Draws the grids of a case that is right; returns the path of the picture."""
    case = cases.resolve(options.case, options.overrides, options.laws)
    path = _picture_path(options.plot, case)
    paths.build(["fsi_grids"])
    from fsi_launch import plot
    style = plot.style_or_mistake()
    style.use()
    from fsi_launch.plot.look import units
    from fsi_launch.plot.one_run import grids
    from fsi_launch.plot.reading import data
    from fsi_launch.plot.several_runs import several
    entries = several.entries(case.text)
    units.use_those_of([entries])
    with tempfile.TemporaryDirectory(prefix="fsi-grids-") as folder:
        _write_grids(options, folder)
        style.save(grids.case_picture(data.all_series(Path(folder)), entries, f"grids of {case.name} at t = 0"), path)
    return path


def shared_out(options):
    """What `--ranks` would do to a case that is right, one line. Throws UserMistake where it cannot."""
    case = cases.resolve(options.case, options.overrides, options.laws)
    numbers = ranks.wanted(options.ranks, case)
    if not numbers:
        return "one process for each program"
    return "; ".join(f"{name}: {number} ranks" + (f", about {case.cost[name]['points'] / number:.0f} points each" if name in case.cost else "")
                     for name, number in numbers.items())


def main(options):
    """Prints what `fsi_case check` says, shares out ranks and draws where that is asked for."""
    valid = cases.check(options.case, options.overrides, options.laws)
    if "(external)" in valid:
        paths.expect(cases.resolve(options.case, options.overrides, options.laws).programs)
    print(valid, flush=True)
    if options.ranks is not None:
        print(f"  ranks: {shared_out(options)}")
    if options.plot is not None:
        print(f"  grids drawn in {draw(options)}")
    return DONE
