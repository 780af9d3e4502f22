#!/usr/bin/python3
"""Two network namespaces, joined by a pair of virtual cables, as two machines: another name, other processes, another network; and a
remote shell between them whose connections are cut with the cable.

two_machines.py serve ADDRESS          the other machine's part of the shell
two_machines.py ADDRESS COMMAND        executes a line there; standard input and output are the connection
"""

import contextlib
import os
import select
import socket
import subprocess
import sys
import threading
from pathlib import Path

PORT = 6022
NAME = "farhost"
HERE = Path(__file__).resolve()


class Machines:
    """Makes both, here and there. `reason`: why that cannot be, or "". """

    def __init__(self):
        number = os.getpid() % 250
        self._spaces = [f"fsi-{os.getpid()}-{one}" for one in ("here", "there")]
        self.here, self.there = f"10.213.{number}.1", f"10.213.{number}.2"
        self._server = None
        self.reason = self._made()

    def _made(self):
        here, there = self._spaces
        cables = [f"f{os.getpid()}a", f"f{os.getpid()}b"]
        commands = [f"netns add {here}", f"netns add {there}", f"link add {cables[0]} type veth peer name {cables[1]}"]
        for space, cable, address in zip(self._spaces, cables, (self.here, self.there)):
            commands += [f"link set {cable} netns {space}", f"-n {space} link set {cable} name wire", f"-n {space} link set lo up",
                         f"-n {space} addr add {address}/24 dev wire", f"-n {space} link set wire up"]
        for command in commands:
            try:
                subprocess.run(["ip", *command.split()], check=True, capture_output=True, text=True)
            except OSError as error:
                return f"no `ip` (iproute2): {error.strerror}"
            except subprocess.CalledProcessError as error:
                return f"no network namespaces here: ip {command}: {error.stderr.strip()}"
        return self._serve(there)

    def _serve(self, space):
        """The other machine has a name and processes of its own."""
        begin = f"mount -t proc proc /proc; hostname {NAME}; exec {sys.executable} {HERE} serve {self.there}"
        self._server = subprocess.Popen(["ip", "netns", "exec", space, "unshare", "--uts", "--mount", "--pid", "--fork", "--kill-child",
                                         "sh", "-c", begin], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        if self._server.stdout.readline().strip() == "serving":
            return ""
        return f"no namespaces of processes and names here: {self._server.stderr.read().strip()}"

    def words_here(self):
        """Before a command that is to run on the first machine."""
        return ["ip", "netns", "exec", self._spaces[0]]

    def shell(self):
        return f"{sys.executable} {HERE}"

    def cut(self):
        subprocess.run(["ip", "-n", self._spaces[0], "link", "set", "wire", "down"], check=True)

    def remove(self):
        if self._server:
            self._server.kill()
            self._server.wait()
            self._server.stdout.close()
            self._server.stderr.close()
        for space in self._spaces:
            with contextlib.suppress(OSError):  # there may be no ip
                subprocess.run(["ip", "netns", "delete", space], check=False, capture_output=True)


def _serve(address):
    with socket.create_server((address, PORT)) as server:
        print("serving", flush=True)
        while True:
            connection, _ = server.accept()
            threading.Thread(target=_obey, args=(connection,), daemon=True).start()


def _obey(connection):
    """A command line, then its input; the end of its output is the end of the connection."""
    with connection:
        line = b""
        while not line.endswith(b"\n"):
            byte = connection.recv(1)
            if not byte:
                return
            line += byte
        subprocess.run(["sh", "-c", line.decode()], stdin=connection, stdout=connection, stderr=connection, check=False)
        with contextlib.suppress(OSError):
            connection.shutdown(socket.SHUT_RDWR)


def _ask(address, command):
    """Exit code: 0, or 255 without a connection, as ssh says it."""
    try:
        connection = socket.create_connection((address, PORT))
    except OSError as error:
        print(f"no connection to {address}: {error}", file=sys.stderr)
        return 255
    connection.sendall(command.encode() + b"\n")
    sources = [sys.stdin.fileno(), connection.fileno()]
    while True:
        for ready in select.select(sources, [], [])[0]:
            data = os.read(ready, 65536)
            if ready == connection.fileno():
                if not data:
                    return 0
                os.write(sys.stdout.fileno(), data)
            elif data:
                connection.sendall(data)
            else:
                sources.remove(ready)
                connection.shutdown(socket.SHUT_WR)


if __name__ == "__main__":
    if sys.argv[1] == "serve":
        _serve(sys.argv[2])
    else:
        sys.exit(_ask(sys.argv[1], " ".join(sys.argv[2:])))
