"""Files that are written whole or not at all."""

import contextlib
import os
from pathlib import Path

from fsi_launch.telling import AS_NAMED


@contextlib.contextmanager
def writing(path, newline=None):
    """Context with an open text file that takes the place of `path` at its end. Where it cannot be written nothing of it stays, `path` is as
    it was, and the OSError has its name. What is no plain file, like /dev/stdout, is written as it is."""
    path = Path(path)
    try:
        if path.exists() and not path.is_file():
            with open(path, "w", newline=newline, **AS_NAMED) as file:
                yield file
            return
        target = path.resolve()
        temporary = target.with_name(target.name + ".part")
        try:
            with open(temporary, "w", newline=newline, **AS_NAMED) as file:
                yield file
                file.flush()
                os.fsync(file.fileno())
            os.replace(temporary, target)
        except BaseException:
            with contextlib.suppress(OSError):
                temporary.unlink(missing_ok=True)
            raise
    except OSError as error:
        raise OSError(error.errno, error.strerror, str(path)) from None


def write(path, text):
    with writing(path) as file:
        file.write(text)
