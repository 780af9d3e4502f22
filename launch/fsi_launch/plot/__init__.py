"""`fsi plot`: pictures of the results of a run."""

from pathlib import Path

from fsi_launch.failure import DONE, UserMistake


def main(options):
    """Draws everything the results hold and prints the paths of the pictures."""
    try:
        from fsi_launch.plot import curves, data, fields, style
    except ModuleNotFoundError as error:
        raise UserMistake(f"plot needs Debian's {error.name}: apt-get install python3-h5py python3-matplotlib") from None
    directory = Path(options.directory)
    if not directory.is_dir():
        raise UserMistake(f"no folder '{directory}'")
    out = Path(options.out) if options.out else directory / "plots"
    series = data.all_series(directory)
    tables = data.all_tables(directory)
    if not series and not tables:
        raise UserMistake(f"'{directory}' holds no results: no fluid.h5, solid_*.h5 or tables")
    out.mkdir(parents=True, exist_ok=True)
    style.use()
    for name, figure in [*fields.pictures(series), *curves.pictures(series, tables)]:
        path = out / f"{name}.png"
        style.save(figure, path)
        print(path, flush=True)
    return DONE
