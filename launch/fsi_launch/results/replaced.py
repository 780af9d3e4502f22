"""The results that --overwrite replaces: laid aside in DIR/.replaced until the programs of the new run start, and put back where it is refused.

While DIR/.replaced is there no program has begun: after a launcher that was killed it is put back by the next one. It is removed under
another name.
"""

import contextlib
import shutil

ASIDE = ".replaced"
UNFINISHED = ".replaced.tmp"


def remove(path):
    if path.is_dir() and not path.is_symlink():
        shutil.rmtree(path)
    else:
        path.unlink()


def is_aside(directory):
    return (directory / ASIDE).is_dir()


def lay_aside(directory):
    """All that is in the folder is out of the way."""
    found = list(directory.iterdir())
    (directory / ASIDE).mkdir()
    for path in found:
        path.rename(directory / ASIDE / path.name)


def put_back(directory):
    """The folder is what it was, if something is laid aside: what a new run has begun goes, where the former one has the same."""
    if not is_aside(directory):
        return
    for path in list((directory / ASIDE).iterdir()):
        if (directory / path.name).exists():
            remove(directory / path.name)
        path.rename(directory / path.name)
    (directory / ASIDE).rmdir()


def drop(directory):
    """What is laid aside is gone."""
    shutil.rmtree(directory / UNFINISHED, ignore_errors=True)
    with contextlib.suppress(FileNotFoundError):
        (directory / ASIDE).rename(directory / UNFINISHED)
    shutil.rmtree(directory / UNFINISHED, ignore_errors=True)


@contextlib.contextmanager
def kept(directory):
    """Context in which an error puts back what is laid aside."""
    try:
        yield
    except BaseException:
        put_back(directory)
        raise
