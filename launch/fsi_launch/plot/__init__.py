"""`fsi plot`: pictures of the results of a run."""

import itertools
import re
from pathlib import Path

from fsi_launch.failure import DONE, UserMistake
from fsi_launch.telling import AS_NAMED


def _folder(name):
    directory = Path(name)
    if not directory.is_dir():
        raise UserMistake(f"no folder '{directory}'")
    if not any((directory / name).is_file() for name in ("case.yaml", "converge.json", "study.json")):
        for above in directory.resolve().parents[:2]:  # of fields/, of checkpoints/00000400/
            if (above / "case.yaml").is_file():
                raise UserMistake(f"'{directory}' is a part of a run: give the run's own folder, '{above}'")
    return directory


def _one(directory, options):
    """(name, figure or a function that makes it) of everything the results of one run hold."""
    from fsi_launch.plot.one_run import beams, curves, disk, fields, grids, schlieren, streamlines
    from fsi_launch.plot.reading import data, scales
    from fsi_launch.plot.several_runs import convergence, study
    if varied := data.study(directory):
        return study.pictures(varied)
    table = data.convergence(directory)
    directory = directory if table else data.finest_level(directory)  # of a study that did not come to its end
    series, tables = data.all_series(directory), data.all_tables(directory)
    last = data.last_state(directory)
    if not (series or last or tables or table):
        raise UserMistake(f"'{directory}' holds no results: no fluid.h5, solid_*.h5, tables or converge.json")
    size = scales.of_run(series or last)
    look = fields.Look(size, options.contours)
    series = data.at_times(series, options.at)
    return itertools.chain(     # what takes longest first: the others are drawn beside it
        streamlines.pictures(series, size), convergence.pictures(table), fields.pictures(series, look), fields.last_picture(last, look),
        grids.pictures(series), disk.pictures(series, data.disk_reference(directory)), schlieren.pictures(series, size),
        beams.pictures(series), curves.pictures(series, tables, size, data.piston_reference(directory)))


def _several(directories, out, options):
    """(name, figure) of what several runs have to compare."""
    from fsi_launch.plot.several_runs import compare
    return compare.pictures(directories, out, options.at)


def _in_common_to_all_grids(directory, entries):
    """Without the spacing where the picture is of several."""
    from fsi_launch.plot.reading import data
    return {key: value for key, value in entries.items() if key != "grid.factor"} if data.convergence(directory) else entries


def _take_words(directories):
    """Labels and captions as the cases of these runs want them; of a convergence study its finest level counts."""
    from fsi_launch.plot.look import caption, units
    from fsi_launch.plot.reading import data
    from fsi_launch.plot.several_runs import several
    def texts_of(paths):
        return [path.read_text(**AS_NAMED) for path in paths if path.is_file()]

    texts = texts_of(data.finest_level(directory) / "case.yaml" for directory in directories)
    varied = [directory / row["folder"] / "case.yaml" for directory in directories for row in (data.study(directory) or {"rows": []})["rows"]]
    units.use_those_of([several.entries(text) for text in texts or texts_of(varied)])
    names = {several.entries(text).get("name", "") for text in texts}
    in_common = names.pop() if len(texts) == len(directories) and len(names) == 1 else ""
    alone = len(directories) == len(texts) == 1
    caption.use(caption.of_case(texts[0], _in_common_to_all_grids(directories[0], several.entries(texts[0]))) if alone else in_common)


def style_or_mistake():
    """The module of the look of pictures, where what it needs is installed."""
    try:
        import h5py  # noqa: F401  of the fields
        from fsi_launch.plot.look import style
    except ModuleNotFoundError as error:
        raise UserMistake(f"pictures need {error.name}: apt-get install python3-h5py python3-matplotlib") from None
    return style


def draw_movie(directory, out=None):
    """Makes the animated file of a run and prints its path."""
    style_or_mistake().use()
    from fsi_launch.plot.one_run import movie
    from fsi_launch.plot.reading import data
    _take_words([Path(directory)])
    series = data.all_series(Path(directory))
    if not series:
        raise UserMistake(f"'{directory}' holds no fields: no fluid.h5, solid_*.h5")
    print(movie.make(series, Path(out) if out else Path(directory) / "plots"), flush=True)


def _remove_others(out, paths):
    """Pictures of single times that a former call left and this one, which draws all, does not: their colours are those of other limits."""
    for path in out.glob(f"*_*{paths[0].suffix}"):
        if re.fullmatch(r"(fields|radius|axis)_(\d{4,}|last)", path.stem) and path not in paths:
            path.unlink()


def main(options):
    """Draws everything the results hold and prints the paths of the pictures."""
    style = style_or_mistake()
    directories = [_folder(name) for name in options.directories]
    out = Path(options.out) if options.out else directories[0] / "plots"
    style.use()
    _take_words(directories)
    pictures = _one(directories[0], options) if len(directories) == 1 else _several(directories, out, options)
    from fsi_launch.plot.look import drawing
    pictures = [(out / f"{name}.{options.format}", figure) for name, figure in pictures]
    if pictures:
        out.mkdir(parents=True, exist_ok=True)
    if len(directories) == 1 and pictures and not options.out and not options.at:
        _remove_others(out, [path for path, _ in pictures])
    drawing.draw(pictures, lambda path: print(path, flush=True))
    if options.movie:
        draw_movie(directories[0], out)
    return DONE
