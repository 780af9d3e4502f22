"""`fsi plot`: pictures of the results of a run."""

import itertools
from pathlib import Path

from fsi_launch.failure import DONE, UserMistake


def main(options):
    """Draws everything the results hold and prints the paths of the pictures."""
    try:
        from fsi_launch.plot import convergence, curves, data, disk, fields, grids, scales, style
    except ModuleNotFoundError as error:
        raise UserMistake(f"plot needs Debian's {error.name}: apt-get install python3-h5py python3-matplotlib") from None
    directory = Path(options.directory)
    if not directory.is_dir():
        raise UserMistake(f"no folder '{directory}'")
    out = Path(options.out) if options.out else directory / "plots"
    series, tables, table = data.all_series(directory), data.all_tables(directory), data.convergence(directory)
    if not series and not tables and not table:
        raise UserMistake(f"'{directory}' holds no results: no fluid.h5, solid_*.h5, tables or converge.json")
    out.mkdir(parents=True, exist_ok=True)
    style.use()
    size = scales.of_run(series)
    parts = (convergence.pictures(table), fields.pictures(series, fields.Look(size, options.contours)),
             grids.pictures(series), disk.pictures(series, data.disk_reference(directory)),
             curves.pictures(series, tables, size))
    for name, figure in itertools.chain(*parts):
        path = out / f"{name}.png"
        style.save(figure, path)
        print(path, flush=True)
    return DONE
