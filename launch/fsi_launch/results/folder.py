"""The folder of a run's results: where it is, that nobody else is at work in it, and that a run which is refused leaves none."""

import contextlib
import errno
from pathlib import Path

from fsi_launch.failure import Failure, OUTPUT_FAILED, UserMistake
from fsi_launch.results import alone, former, new_folder, replaced, restart

OF_A_RUN = ("case.yaml", "summary.json", "log", "parts", "fields", "checkpoints", "last_state", "plots", "interface.csv", "probes.csv",
            "forces_*.csv", "energies_*.csv", "budget_*.csv", "run.xmf", "fluid.h5", "fluid_*.h5", "solid_*.h5", "reference.h5", former.ASIDE, replaced.ASIDE)
OF_PICTURES = ("*.png", "*.csv", "movie.mp4", "movie.gif")    # in plots/
UNFINISHED = (".part", ".tmp")               # of a program that was killed while it wrote
OF_THE_START = ("case.yaml", "case.yaml.part", "log")    # what is there before the first program begins
# What a person has to put right; anything else is a fault of the disk.
REMEDY = "name another folder, or wait for its end"
PLACES = (errno.EACCES, errno.EPERM, errno.EROFS, errno.ENOTDIR, errno.ELOOP, errno.ENAMETOOLONG, errno.ENOENT)


def _is_one_of(name, patterns):
    for ending in UNFINISHED:
        name = name.removesuffix(ending)
    return any(Path(name).match(pattern) for pattern in patterns)


def _expect_own(directory):
    """Nothing but what a run and its pictures leave (docs/output.md) is in it. Throws UserMistake."""
    strangers = [path.name for path in sorted(directory.iterdir()) if not _is_one_of(path.name, OF_A_RUN)]
    if (plots := directory / "plots").is_dir():
        strangers += [f"plots/{path.name}" for path in sorted(plots.iterdir()) if path.is_dir() or not _is_one_of(path.name, OF_PICTURES)]
    if strangers:
        raise UserMistake(f"--out {directory} also holds {', '.join(strangers[:3])}, which no run wrote; name a new folder, "
                          "or move it away")


def _expect_place(directory):
    """A folder may be made there, or is there."""
    if directory.is_dir():
        return
    if directory.is_symlink() and not directory.exists():
        raise UserMistake(f"--out {directory} is a link to {directory.readlink()}, which is not there; make that folder, or name another")
    for path in (directory, *directory.parents):
        if path.exists():
            if not path.is_dir():
                raise UserMistake(f"--out {directory}{'' if path == directory else f': {path}'} is a file; name a folder")
            return


def _expect_free(directory, overwrite):
    """No results are in it, or they are those of a run that is over and may be replaced: then they are laid aside."""
    if not directory.is_dir() or not any(directory.iterdir()):
        return
    restart.expect_over(directory, f"--out {directory}", REMEDY)
    replaced.put_back(directory)    # by a run whose launcher was killed before its programs began
    if not (directory / "case.yaml").is_file() or not (directory / "log").is_dir():
        raise UserMistake(f"--out {directory} is not empty and holds no run; name a new folder")
    if not overwrite:
        raise UserMistake(f"--out {directory} holds the results of a run; name a new folder or add --overwrite")
    _expect_own(directory)
    replaced.lay_aside(directory)


def _make(directory):
    """The folder; returns those that were not there before, the innermost first."""
    made = [path for path in (directory, *directory.parents) if not path.exists()]
    directory.mkdir(parents=True, exist_ok=True)
    return made


def _make_log(directory):
    """Of two runs that begin at the same moment, where the file system knows no locks, one makes log/."""
    try:
        (directory / "log").mkdir()
    except FileExistsError:
        raise UserMistake(f"--out {directory}: another run is beginning there; name another folder") from None


def make(out, name, overwrite, until):
    """(the folder of a new run's results with log/ in it, the folders that were made for it). `out`: where the user wants it, or None.
    `until`: the contextlib.ExitStack until whose end no other command may work there; if it ends by an error, results that the run would
    have replaced are there again, unless replaced.drop was called. Throws UserMistake where none can be."""
    directory = Path(out or "runs")
    try:
        _expect_place(directory)
        made = _make(directory)
        if not out:
            directory = new_folder.claimed(name)
            made = [directory, *made]
        until.enter_context(alone.at_work(directory, f"--out {directory}", REMEDY))
        until.enter_context(replaced.kept(directory))
        _expect_free(directory, overwrite)
        _make_log(directory)
        return directory, made
    except OSError as error:
        if error.errno in PLACES:
            where = f": {error.filename}" if error.filename and str(error.filename) != str(directory) else ""
            raise UserMistake(f"--out {directory}{where}: {error.strerror}; name a folder that you may write into") from None
        raise Failure(OUTPUT_FAILED, f"cannot make {directory}: {error.strerror}") from None


def _holds_a_start(directory):
    """Is there nothing in it but what is there before the first program begins?"""
    def begun(path):
        return path.name not in OF_THE_START or path.name == "log" and any(file.stat().st_size for file in path.iterdir())
    return not any(begun(path) for path in directory.iterdir())


@contextlib.contextmanager
def kept_if_begun(directory, made):
    """Context in which an error takes away what a run has left of which no program has begun. `made`: the folders that were made for
    it, which go too; None of a run that goes on."""
    try:
        yield
    except Exception:
        with contextlib.suppress(OSError):
            if made is not None and _holds_a_start(directory):
                for path in directory.iterdir():
                    replaced.remove(path)
                for path in made:
                    path.rmdir()
        raise
