"""What a person reads, as far as somebody does: neither a terminal that was closed nor a disk that is full decides what becomes of a run."""

import contextlib
import io
import os
import subprocess
import sys

# How programs and files say the names of a user's files: UTF-8, whatever the locale, and the bytes of a name that is none.
AS_NAMED = {"encoding": "utf-8", "errors": "surrogateescape"}


def names_as_they_are():
    """From now on a name that is no text of the locale goes out as the bytes it has."""
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, io.TextIOWrapper):
            stream.reconfigure(**AS_NAMED)


def readable(name):
    """A name for a picture, which has letters only: what is none becomes one that says so."""
    return os.fsencode(name).decode("utf-8", "replace")


def tell(text, out=None):
    """One line or a few on standard error, or on `out`, after what was printed before, also where both go to one file. Where they cannot
    be written nothing is any more."""
    out = out or sys.stderr
    with contextlib.suppress(OSError, ValueError, AttributeError):
        sys.stdout.flush()  # who ends the command meets the same error
    try:
        print(text, file=out, flush=True)
    except OSError:
        silence(out)


def silence(out):
    """What is still to be written there goes nowhere, also what Python has kept to write when it ends."""
    with contextlib.suppress(OSError):
        nowhere = os.open(os.devnull, os.O_WRONLY)
        os.dup2(nowhere, out.fileno())
        os.close(nowhere)


def is_watched():
    """Does a person wait before a terminal? What is told only for the sake of waiting depends on how fast the machine is."""
    return bool(sys.stderr and sys.stderr.isatty())


def answer_of(command, meanwhile, first=3.0):
    """What a program that works quietly answers: subprocess.CompletedProcess. To a person `meanwhile` is told where it takes longer than
    `first` seconds, and whenever that time has doubled."""
    with subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE, **AS_NAMED) as program:
        try:
            told, pause = 0, first
            while True:
                try:
                    out, err = program.communicate(timeout=pause)
                    return subprocess.CompletedProcess(command, program.returncode, out, err)
                except subprocess.TimeoutExpired:
                    told += pause
                    pause = told
                    if is_watched():
                        tell(f"{meanwhile} ({told:.0f} s so far)")
        except BaseException:
            program.kill()
            raise
