"""Requests to end the command: SIGINT (Ctrl-C) and SIGTERM. They raise an exception at once, but for places that would leave
something behind (`held`)."""

import contextlib
import signal

SIGNALS = (signal.SIGINT, signal.SIGTERM)


class Terminated(BaseException):
    """SIGTERM came. Like KeyboardInterrupt it is no Exception, so that nobody takes it for a failure and goes on."""


_asked = []


def _raise(number, _frame):
    _asked.append(number)
    raise KeyboardInterrupt if number == signal.SIGINT else Terminated


def asked():
    """The request that came first, or None. An exception can get lost (in a destructor, in the callbacks of an import), this not."""
    return _asked[0] if _asked else None


def listen():
    """From now on requests raise; those that came while they were blocked do so here."""
    for number in SIGNALS:
        signal.signal(number, _raise)
    signal.pthread_sigmask(signal.SIG_UNBLOCK, SIGNALS)


def ignore_terminal():
    """Nothing is left to interrupt; SIGTERM ends the process the plain way."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    signal.signal(signal.SIGTERM, signal.SIG_DFL)


@contextlib.contextmanager
def _masked(how):
    former = signal.pthread_sigmask(how, SIGNALS)
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, former)


def held():
    """Context in which requests wait until it is left, or until a context `heard` is entered within."""
    return _masked(signal.SIG_BLOCK)


def heard():
    """Context within `held` that lets requests in."""
    return _masked(signal.SIG_UNBLOCK)


@contextlib.contextmanager
def unwrapped():
    """Context that a request leaves as itself, also where Python has made a RuntimeError of it (in the callbacks of a class's members,
    as dataclasses have, before 3.12)."""
    try:
        yield
    except RuntimeError as error:
        if isinstance(error.__cause__, (KeyboardInterrupt, Terminated)):
            raise error.__cause__ from None
        raise
