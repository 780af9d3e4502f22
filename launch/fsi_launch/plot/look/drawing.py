"""Draws many pictures at once, one process on each processor, and says how far it is."""

import gc
import multiprocessing
import os
import sys
import traceback

from fsi_launch.living import interrupts
from fsi_launch.plot.look import style

MOST_PROCESSES = 8      # each holds a picture in memory

_tasks = []     # of the processes: inherited, for figures and what makes them need not be sendable


def _draw(k):
    """Draws one picture; returns None, or what went wrong in a form that can be sent."""
    path, figure = _tasks[k]
    try:
        style.save(figure() if callable(figure) else figure, path)
    except OSError as error:
        return error.errno, error.strerror, str(error.filename or path)
    except Exception:       # noqa: BLE001  told in full to who waits
        return traceback.format_exc()
    return None


class _Counter:
    """`drawing 7 of 18` on a terminal, between the lines of the output."""

    def __init__(self, count, out=None):
        self._count, self._done, self._out = count, 0, out or sys.stderr
        self._shown = self._out.isatty() and count > 1

    def show(self):
        if self._shown and self._done < self._count:
            self._out.write(f"\r\033[Kdrawing {self._done + 1} of {self._count}")
            self._out.flush()

    def clear(self):
        self._done += 1
        if self._shown:
            self._out.write("\r\033[K")
            self._out.flush()


def _drawn(count, jobs):
    """What `_draw` says of each picture, in their order."""
    if jobs < 2:
        yield from map(_draw, range(count))
        return
    gc.freeze()     # what is here now stays: the processes need not look for garbage in it
    with multiprocessing.get_context("fork").Pool(jobs, interrupts.ignore_terminal) as pool:
        yield from pool.imap(_draw, range(count))
    gc.unfreeze()


def draw(pictures, say, jobs=None):
    """Draws all of `pictures`, [(path, figure or a function that makes it)], and says the path of each. What goes wrong with one of them
    is raised when the others are there; a file that cannot be written ends it. `jobs`: processes, one for each processor unless told."""
    global _tasks   # noqa: PLW0603
    _tasks = list(pictures)
    jobs = min(jobs or len(os.sched_getaffinity(0)), MOST_PROCESSES, len(_tasks))
    counter = _Counter(len(_tasks))
    counter.show()
    broken = []
    try:
        for (path, _), wrong in zip(_tasks, _drawn(len(_tasks), jobs)):
            counter.clear()
            if isinstance(wrong, str):
                broken.append(f"{path}:\n{wrong}")
            elif wrong is not None:
                raise OSError(*wrong)
            else:
                say(path)
            counter.show()
    finally:
        _tasks = []
    if broken:
        raise RuntimeError("could not be drawn: " + "\n".join(broken))
