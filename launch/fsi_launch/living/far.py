"""What `fsi run --hosts` starts on another machine: it runs one program of the run and passes signals on to it.

far.py look    says which of the files of a run are to be seen here
far.py run     runs a program; a line on standard input is `signal NUMBER`, the end of standard input is the end of the connection

Both get a line of JSON on standard input, which nobody else can read: the key of the run is in it. They print one at the end.
"""

import contextlib
import json
import os
import selectors
import signal
import subprocess
import sys
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2]))
from fsi_launch.living import processes, ranks  # noqa: E402
from fsi_launch.living.supervise import leashed  # noqa: E402
from fsi_launch.telling import AS_NAMED  # noqa: E402

ALONE = 60.0    # [s] from the end of the connection to SIGKILL: a checkpoint may be written


def look(order):
    """{case: text of the case file, missing: programs that are not here, writable: may the folder be written into?,
    lack: why ranks have no room}"""
    try:
        os.chdir(order["folder"])
        text = Path(order["case"]).read_text(**AS_NAMED)
    except OSError:
        text = None
    return {"case": text, "missing": [path for path in order["programs"] if not os.access(path, os.X_OK)],
            "writable": os.access(order["run"], os.W_OK), "lack": ranks.lack_of_room(order["ranks"])}


class Guard:
    """Runs the program until it ends."""

    def __init__(self, order):
        self._ranks = order["ranks"]
        self._report = os.memfd_create("report")
        self._memory = contextlib.ExitStack()
        programs = Path(order["environment"]["AMP_FSI_BIN"])
        memory = ranks.memory([self._ranks] if self._ranks > 1 else [], order["command"][0], programs)
        environment = os.environ | order["environment"] | self._memory.enter_context(memory)
        # mpirun passes no open files on.
        environment["AMP_FSI_REPORT"] = str(self._report) if self._ranks == 1 else f"/proc/{os.getpid()}/fd/{self._report}"
        os.chdir(order["folder"])
        with open(order["log"], "ab") as log:
            self._process = subprocess.Popen(
                leashed(order["command"], start=str(programs / "fsi_start")), stdin=subprocess.DEVNULL, stdout=log, stderr=log,
                start_new_session=True, env=environment, pass_fds=(self._report,))
        self._kill_at = float("inf")

    def _send(self, number):
        if self._ranks > 1:
            ranks.send(self._process, number)
            return
        self._process.send_signal(number)
        self._process.send_signal(signal.SIGCONT)   # a stopped program must hear it too

    def _hear(self, selector):
        """Signals; with the connection the launcher is gone, or soon will be."""
        data = os.read(sys.stdin.fileno(), 4096)
        if not data:
            selector.unregister(sys.stdin)
            self._send(signal.SIGTERM)
            self._kill_at = time.monotonic() + ALONE
        for line in data.decode("ascii", "replace").splitlines():
            word, _, number = line.partition(" ")
            if word == "signal" and number.isdecimal():
                self._send(int(number))

    def wait(self):
        """{code: exit code, report: what the program left}"""
        pidfd = os.pidfd_open(self._process.pid)
        with selectors.DefaultSelector() as selector:
            selector.register(pidfd, selectors.EVENT_READ)
            selector.register(sys.stdin, selectors.EVENT_READ)
            ended = False
            while not ended:
                for key, _ in selector.select(0.5):
                    ended = ended or key.fileobj == pidfd
                    if key.fileobj is sys.stdin and not ended:
                        self._hear(selector)
                if time.monotonic() > self._kill_at:
                    self._send(signal.SIGKILL)
        for pid in ranks.members(self._process.pid) if self._ranks > 1 else ():     # they do not outlive their mpirun
            processes.signal_to(pid, signal.SIGKILL)
        processes.end_group(self._process.pid)
        self._memory.close()
        return {"code": self._process.wait(), "report": os.pread(self._report, os.fstat(self._report).st_size, 0).decode("utf-8", "replace")}


def _order():
    """The first line, and not a byte more: what follows is for later."""
    line = b""
    while not line.endswith(b"\n") and (byte := os.read(sys.stdin.fileno(), 1)):
        line += byte
    return json.loads(line)


def main():
    signal.signal(signal.SIGHUP, signal.SIG_IGN)
    order = _order()
    told = look(order) if sys.argv[1] == "look" else Guard(order).wait()
    with contextlib.suppress(BrokenPipeError, ConnectionError):
        print(json.dumps(told), flush=True)


if __name__ == "__main__":
    main()
