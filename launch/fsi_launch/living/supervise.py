"""Runs the programs of one run side by side, each in a session of its own, and sees to it that all of them end.

When one fails, the others notice on the bus and end by themselves; whoever has not done so after `GRACE` seconds is
terminated, then killed; one that is stopped (SIGSTOP) cannot, and is killed at once. Before the run has begun nobody can notice
anything, and there is nothing to save: then all end at once. Ctrl-C and SIGTERM end all of them the same way.
"""

import contextlib
import fcntl
import os
import selectors
import signal
import subprocess
import time
from dataclasses import dataclass, field

from fsi_launch import paths
from fsi_launch.failure import INTERRUPTED, PEER_LOST, TERMINATED
from fsi_launch.living import hosts, interrupts, processes, ranks

GRACE = 4.0         # [s] from a program's failure to SIGTERM for the others: they should have ended by then
NOT_BEGUN = 0.5     # [s] the same before everybody has joined
KILL_AFTER = 4.0    # [s] from that SIGTERM to SIGKILL: who has lost another one tells the rest for a second before it ends (common/bus)
STOP_GRACE = 60.0   # [s] from Ctrl-C or SIGTERM to SIGKILL: a checkpoint is written, which takes two steps; so
STOP_STEPS = 4      # many times more than the longest time between two lines of progress
ASKED_AGAIN = 1.0   # [s] from the first Ctrl-C or SIGTERM: what comes sooner is the same request (`timeout` sends two), later a second one
AFTER_STOP = 5.0    # [s] from the first end after that to SIGTERM for the others
LAST_GRACE = 60.0   # [s] from the first program's good end to SIGTERM for the others: results may be written
STOPPED = 4.0       # [s] that a program may be stopped after such an end, before it is asked to go on and end
PIPE_SIZE = 1 << 20
SIGNALS = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)


@dataclass
class Program:
    """One program to run. `listen`: its standard output goes to the caller line by line, not to its log."""

    name: str
    command: list
    listen: bool = False
    environment: dict = field(default_factory=dict)     # besides the launcher's own
    tell_pids: bool = False     # by --pids, of those that were started before
    report: int = None  # descriptor of a file in memory for a copy of what it leaves (AMP_FSI_REPORT)
    ranks: int = 1      # more: the command is an mpirun
    cores: set = None   # on which it may run; None: on all
    place: hosts.Place = None   # another machine


@dataclass
class Ending:
    """How a program ended. `ours`: the supervisor sent it the signal. `early`: it ended as if all were well, but the run had
    not begun. `stopped`: somebody had stopped it (SIGSTOP). `cut`: it ran on another machine, and why nothing is known of its end."""

    name: str
    code: int
    when: float
    ours: bool = False
    early: bool = False
    stopped: bool = False
    cut: str = ""

    def lost(self):
        return self.code < 0 and not self.ours


@dataclass
class Outcome:
    """How all of them ended, in order of time; `signal` is the one that ended the launcher, or 0."""

    endings: list = field(default_factory=list)
    signal: int = 0


def leashed(command, cores=None, start=None):
    """The command of a program that dies with this process, even if that is killed with SIGKILL. `start`: the program that sees to it
    (launch/start.cpp)."""
    on = ",".join(str(core) for core in sorted(cores)) if cores else "-"
    return [start or paths.program("fsi_start"), str(os.getpid()), on, *command]


class Supervisor:
    """Starts programs and waits for all to end. `on_line(text)` gets the lines of programs that `listen`,
    `on_tick()` is called about ten times a second."""

    def __init__(self, log_dir, on_line=lambda text: None, on_tick=lambda: None):
        self._log_dir = log_dir
        self._on_line = on_line
        self._on_tick = on_tick
        self._selector = selectors.DefaultSelector()
        self._processes = {}
        self._pidfds = {}
        self._signalled = set()
        self._stopped_since = {}    # {name: moment} of programs that somebody has stopped
        self._ranked = set()        # names of those that several processes compute
        self._far = {}              # {name: lines from the other machine} of those that run on one
        self._reports = {}
        self._terminate_at = self._kill_at = float("inf")
        self._outcome = Outcome()
        self._asked_at = None       # to end
        self._begun = True          # everybody has joined, as far as one knows
        self._drain = lambda: None  # takes in what the program that listens has said
        self._last_line, self._longest_pause = None, 0.0    # between two lines of progress

    def run(self, programs):
        """Starts all, returns the Outcome when none is left."""
        with self._signals_caught():
            if number := interrupts.asked():  # and yet we came here: its exception got lost
                self._outcome.signal = number
                return self._outcome
            self._begun = len(programs) == 1 or not any(program.listen for program in programs)
            try:
                for program in programs:
                    self._start(program)
                while self._processes:
                    self._wait_for_events()
                    self._keep_deadlines()
                    self._on_tick()
            finally:
                self._end_everything()
        return self._outcome

    # --- starting

    def _start(self, program):
        environment, command = os.environ | program.environment, list(program.command)
        self._reports[program.name] = program.report
        if program.report is not None:
            # mpirun passes no open files on.
            environment["AMP_FSI_REPORT"] = str(program.report) if program.ranks == 1 else f"/proc/{os.getpid()}/fd/{program.report}"
        if program.tell_pids:
            command += ["--pids", ",".join(f"{name}={process.pid}" for name, process in self._processes.items()
                                           if name not in self._ranked and name not in self._far)]
        with open(self._log_dir / f"{program.name}.out", "ab") as log:
            if program.place:
                process = hosts.Far(program, command, log, leashed)
                self._far[program.name] = []
            else:
                process = subprocess.Popen(
                    leashed(command, program.cores), stdin=subprocess.DEVNULL, stdout=subprocess.PIPE if program.listen else log,
                    stderr=log, start_new_session=True, env=environment,
                    pass_fds=() if program.report is None else (program.report,))
        self._processes[program.name] = process
        if program.ranks > 1:
            self._ranked.add(program.name)
        pidfd = os.pidfd_open(process.pid)
        self._pidfds[program.name] = pidfd
        self._selector.register(pidfd, selectors.EVENT_READ, lambda: self._ended(program.name))
        if program.place:
            self._listen(process.stdout, self._far[program.name].append)
        elif program.listen:
            self._drain = self._listen(process.stdout, self._heard)

    def _listen(self, pipe, heard):
        """Its lines go to `heard`. Returns what takes in some of those that have come; false when there are none."""
        with contextlib.suppress(OSError):  # room for a launcher that is stopped for a while
            fcntl.fcntl(pipe, fcntl.F_SETPIPE_SZ, PIPE_SIZE)
        os.set_blocking(pipe.fileno(), False)
        rest = bytearray()

        def read():
            if pipe.closed:
                return False
            data = pipe.read(65536)
            if data == b"":
                with contextlib.suppress(KeyError):
                    self._selector.unregister(pipe)
                pipe.close()
                return False
            rest.extend(data or b"")
            *lines, tail = rest.split(b"\n")
            rest[:] = tail
            for line in lines:
                heard(line.decode("utf-8", "replace"))
            return bool(data)

        self._selector.register(pipe, selectors.EVENT_READ, read)
        return read

    def _heard(self, line):
        self._begun = self._begun or line.startswith(("joined", "progress "))
        if line.startswith("progress "):
            now = time.monotonic()
            if self._last_line is not None:
                self._longest_pause = max(self._longest_pause, now - self._last_line)
            self._last_line = now
        self._on_line(line)

    # --- waiting

    def _wait_for_events(self):
        for key, _ in self._selector.select(0.1):
            key.data()

    def _ended(self, name):
        process = self._processes.pop(name)
        self._selector.unregister(self._pidfds[name])
        os.close(self._pidfds.pop(name))
        if not self._begun:
            self._drain()
        if name in self._ranked and name not in self._far:    # its ranks do not outlive it
            for pid in ranks.members(process.pid):
                processes.signal_to(pid, signal.SIGKILL)
        if name not in self._far:
            processes.end_group(process.pid)
        code, cut = process.wait(), ""
        if name in self._far:
            code, cut = self._far_end(name, process, code)
        if name in self._ranked and code - 128 in signal.valid_signals() and code not in (INTERRUPTED, TERMINATED):
            code = 128 - code       # as mpirun tells of a rank that a signal ended; its own failures have greater codes
        ending = Ending(name, code, time.monotonic(), name in self._signalled, stopped=name in self._stopped_since, cut=cut)
        ending.early = ending.code == 0 and not self._begun
        self._outcome.endings.append(ending)
        grace = self._grace_after(ending)
        self._end_by(ending.when + grace, ending.when + grace + KILL_AFTER)

    def _far_end(self, name, connection, code):
        """(exit code, why nothing is known of its end) of a program on another machine. Its report becomes one of ours."""
        if not connection.stdout.closed:
            rest = self._selector.unregister(connection.stdout)
            while rest.data():
                continue
        connection.close()
        told = hosts.last_word("\n".join(self._far[name]))
        if told is None:
            return PEER_LOST, connection.cut(code)
        if self._reports[name] is not None:
            os.pwrite(self._reports[name], told["report"].encode(), 0)
        return told["code"], ""

    def _grace_after(self, ending):
        """[s] that the others have then."""
        if not self._begun:
            return NOT_BEGUN
        if ending.code == 0:
            return LAST_GRACE
        return AFTER_STOP if self._outcome.signal else GRACE

    def _end_by(self, terminate_at, kill_at):
        self._terminate_at = min(self._terminate_at, terminate_at)
        self._kill_at = min(self._kill_at, kill_at)

    def _keep_deadlines(self):
        now = time.monotonic()
        if self._outcome.endings and not self._outcome.signal:
            self._end_stopped(now, any(ending.code != 0 or ending.early for ending in self._outcome.endings))
        if now >= self._kill_at:
            self._send(signal.SIGKILL)
        elif now >= self._terminate_at:
            self._terminate_at = float("inf")
            self._send(signal.SIGTERM)

    def _end_stopped(self, now, failed):
        """Programs that somebody has stopped: killed after a failure; after a good end asked to go on and end, if they stay stopped."""
        for name, process in self._processes.items():
            state = None
            with contextlib.suppress(OSError):
                state = processes.state_of(process.pid)
            if state != "T":
                if name not in self._signalled:
                    self._stopped_since.pop(name, None)
                continue
            since = self._stopped_since.setdefault(name, now)
            if failed or now - since >= STOPPED:
                self._send(signal.SIGKILL if failed else signal.SIGTERM, [name])

    def _send(self, number, names=None):
        """To all, or to those named."""
        for name in list(self._processes) if names is None else names:
            process = self._processes[name]
            self._signalled.add(name)
            with contextlib.suppress(ProcessLookupError):
                if name in self._ranked and name not in self._far:
                    ranks.send(process, number)
                    continue
                process.send_signal(number)
                if name not in self._far:
                    process.send_signal(signal.SIGCONT)  # a stopped program must hear it too

    def _end_everything(self):
        """Only after an error of our own is anything left here."""
        self._send(signal.SIGKILL)
        for name in list(self._processes):
            if name in self._far:
                self._processes[name].kill()
            self._ended(name)
        self._selector.close()

    # --- signals to the launcher

    @contextlib.contextmanager
    def _signals_caught(self):
        read_end, write_end = os.pipe2(os.O_NONBLOCK | os.O_CLOEXEC)
        old_wakeup = signal.set_wakeup_fd(write_end)
        caught = [n for n in SIGNALS if n != signal.SIGHUP or signal.getsignal(n) != signal.SIG_IGN]  # nohup
        old_handlers = {number: signal.signal(number, lambda *_: None) for number in caught}
        self._selector.register(read_end, selectors.EVENT_READ, lambda: self._asked_to_end(os.read(read_end, 64)))
        try:
            yield
        finally:
            for number, handler in old_handlers.items():
                signal.signal(number, handler)
            signal.set_wakeup_fd(old_wakeup)
            with contextlib.suppress(BlockingIOError):  # one that came when nobody waited any more
                self._asked_to_end(os.read(read_end, 64))
            os.close(read_end)
            os.close(write_end)

    def _asked_to_end(self, numbers):
        """First request: ask the programs to end. Second request: kill them. Signals that come together are one request: who ends a
        group of processes may reach the launcher twice."""
        now = time.monotonic()
        for number in numbers:
            if number not in SIGNALS:
                continue
            if self._outcome.signal:
                if now - self._asked_at >= ASKED_AGAIN:
                    self._end_by(now, now)
            else:
                self._outcome.signal, self._asked_at = number, now
                pause = 0.0 if self._last_line is None else max(self._longest_pause, now - self._last_line)
                self._end_by(now, now + STOP_GRACE + STOP_STEPS * pause)
