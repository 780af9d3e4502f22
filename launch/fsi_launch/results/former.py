"""The record of a run that a restart goes on with: laid aside in DIR/.former until a step has been taken, and put back where none was.

DIR/.former is whole whenever it is there, whatever moment a launcher is killed at: it is made and removed under another name.
"""

import contextlib
import os
import shutil

RECORD = ("summary.json", "parts/*.json", "last_state/*", "case.yaml")
TABLES = ("*.csv", "parts/*.csv")   # programs cut them where they are
ASIDE = ".former"
UNFINISHED = ".former.tmp"


def _files(folder, patterns=RECORD):
    return [path for pattern in patterns for path in folder.glob(pattern) if path.is_file()]


def _copy(source, target):
    """All files of the record, but for tables under a second name, where the file system has such."""
    for path in _files(source, RECORD + TABLES):
        other = target / path.relative_to(source)
        other.parent.mkdir(parents=True, exist_ok=True)
        other.unlink(missing_ok=True)
        _double(path, other)


def _double(path, other):
    if path.suffix != ".csv":
        with contextlib.suppress(OSError):
            os.link(path, other)
            return
    shutil.copy2(path, other)


def _remove(directory, but=()):
    for path in _files(directory):
        if path.name not in but:
            path.unlink()


def is_aside(directory):
    return (directory / ASIDE).is_dir()


def lay_aside(directory):
    """The record is out of the way of a new one; only the case stays, to be replaced and not to be written into."""
    shutil.rmtree(directory / UNFINISHED, ignore_errors=True)
    (directory / UNFINISHED).mkdir()
    _copy(directory, directory / UNFINISHED)
    (directory / UNFINISHED).rename(directory / ASIDE)
    _remove(directory, but=["case.yaml"])


def put_back(directory):
    """The record is what it was, if one is laid aside."""
    if is_aside(directory):
        _remove(directory)
        _copy(directory / ASIDE, directory)
        drop(directory)


def drop(directory):
    """What is laid aside counts no more."""
    with contextlib.suppress(OSError):
        if is_aside(directory):
            shutil.rmtree(directory / UNFINISHED, ignore_errors=True)
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
