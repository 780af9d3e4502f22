"""Programs of a run on other machines (`fsi run --hosts`): who is where, and how they are started.

    launcher --- ssh HOST python3 far.py ---> program      what to run and the key of the run, as a line on standard input
             <---- one line of JSON at the end ----        its exit code and report

The launcher and the coupler stay here. Nothing is copied: the programs, the case and the folder of the results lie on a file system that
all see at the same place, which is looked at before anything starts. The connection is the program's lifeline: where it
ends, the program is asked to end. A program that hears nothing of the coupler any more ends by itself, as on one machine.
"""

import contextlib
import json
import os
import shlex
import shutil
import signal
import socket
import subprocess
import sys
import time
from dataclasses import dataclass
from pathlib import Path

from fsi_launch.failure import UserMistake
from fsi_launch.telling import AS_NAMED

SHELL = "ssh -T -o BatchMode=yes -o ConnectTimeout=10 -o ServerAliveInterval=5 -o ServerAliveCountMax=6"
LOOKS_FOR = 30.0    # [s] from asking a machine what it sees to its answer
LAST_WORD = 1.0     # [s] from SIGKILL over the connection to the end of the connection
COUPLER = "coupler"
FAR = Path(__file__).with_name("far.py")


@dataclass(frozen=True)
class Host:
    """Another machine. `name`: as the remote shell takes it; `address`: where its programs meet the others."""

    name: str
    address: str


def _host(word, text):
    name, _, address = word.partition("/")
    if not name or name.startswith("-"):
        raise UserMistake(f"--hosts {text}: '{word}' is no machine; write NAME=HOST, or NAME=HOST/ADDRESS")
    try:
        address = socket.getaddrinfo(address or name.rpartition("@")[2], None, socket.AF_INET, socket.SOCK_DGRAM)[0][4][0]
    except OSError as error:
        raise UserMistake(f"--hosts {text}: no address of {address or name} is known here ({error.strerror}); write it behind the name: "
                          f"{name}/ADDRESS") from None
    if address.startswith("127."):
        raise UserMistake(f"--hosts {text}: {name} is this machine itself ({address}); leave it away, or write the address by which others "
                          f"reach it: {name}/ADDRESS")
    return Host(name, address)


def wanted(text, case, ranks=None, protection="encrypt"):
    """{participant: Host} of those that run elsewhere, from `fluid=a,disk=b`."""
    if text is None:
        return {}
    if COUPLER not in case.programs:
        raise UserMistake(f"--hosts {text}: this case has a single program; start the run on that machine instead")
    if protection == "off":
        raise UserMistake("--hosts: what goes over a network is encrypted; leave --no-security away")
    if ranks == "auto":
        raise UserMistake("--hosts: --ranks auto counts the cores of this machine; write --ranks NAME=N,..")
    asked = {}
    for word in text.split(","):
        name, _, host = word.partition("=")
        if name == COUPLER:
            raise UserMistake(f"--hosts {text}: the coupler runs where the command is given; give it on {host or 'the other machine'}")
        if name not in case.programs:
            raise UserMistake(f"--hosts {text}: the case has no participant '{name}'; it has "
                              f"{', '.join(one for one in case.programs if one != COUPLER)}")
        asked[name] = _host(host, text)
    return asked


def _own_address(address):
    """By which that machine reaches this one. Nothing is sent."""
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as way:
        try:
            way.connect((address, 9))
        except OSError as error:
            raise UserMistake(f"--hosts: there is no way to {address}: {error.strerror}") from None
        return way.getsockname()[0]


def networks(asked):
    """{address: what BusOptions of common/bus call network}, with "" for this machine's; {} where all is here."""
    if not asked:
        return {}
    own = {_own_address(host.address): host.name for host in asked.values()}
    if len(own) > 1:
        raise UserMistake("--hosts: " + " and ".join(f"{name} is reached from {address}" for address, name in own.items())
                          + "; choose addresses of one network: NAME=HOST/ADDRESS")
    here = next(iter(own))
    if here in {host.address for host in asked.values()}:
        raise UserMistake(f"--hosts: {here} is this machine itself; leave it away")
    all_of_them = [here, *dict.fromkeys(host.address for host in asked.values())]
    return {"" if one == here else one: ",".join([one, *(other for other in all_of_them if other != one)]) for one in all_of_them}


# --- before the run


def _command(shell, host, word):
    """Of this machine. The other one gets a single line, as ssh passes it on."""
    far = shlex.join([sys.executable, "-s", "-P", "-X", "utf8", "-B", str(FAR), word])
    return [*shlex.split(shell or os.environ.get("FSI_RSH") or SHELL), host.name, far]


def _look(shell, host, order):
    """What a machine says of what it sees."""
    command = _command(shell, host, "look")
    remedy = f"it must be possible to log in there without a password: try {shlex.join(command[:-1])} true"
    try:
        answer = subprocess.run(command, input=json.dumps(order) + "\n", capture_output=True, **AS_NAMED, timeout=LOOKS_FOR, check=False)
    except subprocess.TimeoutExpired:
        raise UserMistake(f"--hosts: {host.name} has not answered for {LOOKS_FOR:g} s; {remedy}") from None
    except OSError as error:
        raise UserMistake(f"--hosts: cannot execute {command[0]}: {error.strerror}; name another --remote-shell") from None
    if (told := last_word(answer.stdout)) is None:
        words = (answer.stderr.strip() or answer.stdout.strip() or f"exit code {answer.returncode}").splitlines()[-1]
        raise UserMistake(f"--hosts: nothing can be started on {host.name}: {words}; {remedy}")
    return told


def last_word(text):
    """The object that far.py ends with, or None. Before it there may be what a login says."""
    for line in reversed(text.splitlines()):
        with contextlib.suppress(ValueError):
            if isinstance(told := json.loads(line), dict):
                return told
    return None


def expect_all(asked, shell, directory, programs, ranked):
    """Looks whether all machines see the same files. `programs`: {participant: words of its command}. `ranked`: {participant: ranks} of
    those with several. Throws UserMistake."""
    def look(host):
        words = {word for name, command in programs.items() if asked.get(name) == host for word in command}
        needed = [word for word in sorted(words) if "/" in word and os.access(word, os.X_OK) and os.path.isfile(word)]
        order = {"folder": os.getcwd(), "case": str(directory / "case.yaml"), "programs": needed, "run": str(directory),
                 "ranks": [number for name, number in ranked.items() if asked.get(name) == host]}
        told = _look(shell, host, order)
        case = (directory / "case.yaml").read_text(**AS_NAMED)
        if told.get("case") != case:
            raise UserMistake(f"--hosts: {host.name} does not see {directory.resolve()}, or sees another one; programs, case and results must "
                              "lie on a file system that all machines see at the same place (NFS)")
        if missing := told.get("missing"):
            raise UserMistake(f"--hosts: {host.name} has no {' and no '.join(missing)}; it must be there too")
        if not told.get("writable"):
            raise UserMistake(f"--hosts: {host.name} may not write into {directory.resolve()}")
        if lack := told.get("lack"):
            raise UserMistake(f"--hosts: on {host.name} {lack}")

    from concurrent.futures import ThreadPoolExecutor   # slow to load, and of no use on one machine
    with ThreadPoolExecutor() as pool:
        for _ in pool.map(look, dict.fromkeys(asked.values())):
            pass


# --- in the run


@dataclass
class Place:
    """Where a Program of the supervisor runs, and by which shell it is reached."""

    host: Host
    shell: str = None


class Far:
    """A program on another machine, as the supervisor sees a process: what it waits for and sends signals to is the connection."""

    def __init__(self, program, command, log, leashed):
        """`leashed`: what makes of a command one that dies with the launcher."""
        place = program.place
        self._host = place.host
        self._killed_at = None
        self._process = subprocess.Popen(
            leashed(_command(place.shell, place.host, "run")), stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=log,
            start_new_session=True)
        self.pid, self.stdout = self._process.pid, self._process.stdout
        order = {"folder": os.getcwd(), "command": command, "environment": program.environment, "log": os.path.abspath(log.name),
                 "ranks": program.ranks}
        self._say(json.dumps(order))

    def _say(self, line):
        with contextlib.suppress(OSError, ValueError):   # the connection is gone, which the supervisor sees by itself
            self._process.stdin.write(line.encode() + b"\n")
            self._process.stdin.flush()

    def send_signal(self, number):
        """By word of mouth; SIGKILL also to the connection, if it does not take the word."""
        if number == signal.SIGKILL:
            now = time.monotonic()
            self._killed_at = self._killed_at or now
            if now - self._killed_at > LAST_WORD:
                self._process.kill()
        self._say(f"signal {int(number)}")

    def kill(self):
        """The connection, and nothing is said."""
        self._process.kill()

    def wait(self):
        """Exit code of the connection."""
        return self._process.wait()

    def close(self):
        with contextlib.suppress(OSError):
            self._process.stdin.close()
        self.stdout.close()

    def cut(self, code):
        """Why there was no last word, for people."""
        return f"the connection to {self._host.name} ended before it did (exit code {code} of the remote shell)"


def expect_shell(shell):
    """Throws UserMistake where the remote shell is not there."""
    word = shlex.split(shell or os.environ.get("FSI_RSH") or SHELL)[:1]
    if not word or not shutil.which(word[0]):
        raise UserMistake(f"--hosts: there is no {word[0] if word else 'remote shell'} here; install openssh-client, or name another "
                          "--remote-shell")
