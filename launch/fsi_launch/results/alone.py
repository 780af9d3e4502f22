"""One command at a time works in the folder of a run."""

import contextlib
import fcntl
import os

from fsi_launch.failure import UserMistake
from fsi_launch.results import restart


@contextlib.contextmanager
def at_work(directory, option, remedy):
    """Context of the only command that works in a folder, `option` of what the user typed. It ends with this process, however that ends:
    programs do not inherit what is held, and those that outlive it are seen by restart.expect_over. Where the file system knows no locks,
    nothing is held. Throws UserMistake."""
    with contextlib.ExitStack() as held:
        try:
            folder = os.open(directory, os.O_RDONLY | os.O_DIRECTORY | os.O_CLOEXEC)
            held.callback(os.close, folder)
            fcntl.flock(folder, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            restart.expect_over(directory, option, remedy)      # says which run it is, where that is known
            raise UserMistake(f"{option}: another command is at work there; {remedy}") from None
        except OSError:
            pass
        yield
