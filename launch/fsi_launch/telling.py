"""What a person reads, as far as somebody does: neither a terminal that was closed nor a disk that is full decides what becomes of a run."""

import contextlib
import os
import sys


def tell(text, out=None):
    """One line or a few on standard error, or on `out`. Where they cannot be written nothing is any more."""
    out = out or sys.stderr
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
