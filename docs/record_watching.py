#!/usr/bin/python3
"""What it costs a run that somebody looks at its live pictures, as a table for docs/results.md.

record_watching.py [--pairs N] [--wish PICTURES] [CASE [--set KEY=VALUE ..]]

Two runs of the same case go on at the same time, so that whatever else the machine does takes as much from both; one is watched without a
break, as the page does it: its stream of states, and its pictures of the gas's pressure, the solids' speed and the outlines. Compared is the
processor time of all programs of a run: the pictures are drawn in them.
"""

import argparse
import hashlib
import json
import os
import statistics
import subprocess
import tempfile
import threading
import time
import urllib.request
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
FSI = str(ROOT / "launch" / "fsi")


def start(folder, options):
    words = [FSI, "run", options.case, "--out", str(folder), "--no-progress", *(f"--set={one}" for one in options.set)]
    return subprocess.Popen(words, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)


class Watcher:
    """The monitor of a run, and somebody who asks it for all that the page shows until `stop`."""

    def __init__(self, folder, wish):
        while not (folder / "interface.csv").is_file():
            time.sleep(0.05)
        self.seen, self._wish = {}, wish
        self._monitor = subprocess.Popen([FSI, "monitor", str(folder), "--web", "0"], stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, text=True)
        self._url = self._monitor.stdout.readline().partition("#")[0].strip()
        self._over = threading.Event()
        self._threads = [threading.Thread(target=self._ask, args=[one], daemon=True) for one in ([self._pictures] if wish else []) + [self._states]]
        for thread in self._threads:
            thread.start()

    def _ask(self, what):
        try:
            what()
        except OSError:     # the monitor is gone
            return

    def _pictures(self):
        version = 0
        while not self._over.is_set():
            with urllib.request.urlopen(f"{self._url}api/pictures?after={version}&wish={self._wish}", timeout=60) as answer:
                version, data = int(answer.headers["X-AMP-FSI-Version"]), answer.read()
            place = 0
            while place < len(data):
                length = int.from_bytes(data[place:place + 4], "little")
                header = json.loads(data[place + 4:place + 4 + length])
                self.seen.setdefault(header["from"], set()).add(header["step"])
                place += 4 + length
                for grid in header["grids"]:
                    points = grid["n1"] * grid["n2"]
                    place += 4 * (grid["n1"] + grid["n2"] if grid["straight"] else 2 * points) + 4 * ((points + 1) // 2)

    def _states(self):
        with urllib.request.urlopen(f"{self._url}api/events", timeout=60) as stream:
            while not self._over.is_set() and stream.readline():
                pass

    def stop(self):
        self._over.set()
        self._monitor.kill()
        self._monitor.wait()
        self._monitor.stdout.close()


def processor_time(run):
    """Of a run that has ended and of all its programs [s]."""
    _, status, used = os.wait4(run.pid, 0)
    run.returncode = os.waitstatus_to_exitcode(status)
    if run.returncode:
        raise SystemExit(f"a run ended with {run.returncode}")
    return used.ru_utime + used.ru_stime


def digest(folder):
    """Of its tables."""
    return hashlib.sha256(b"".join(path.read_bytes() for path in sorted(folder.glob("*.csv")))).hexdigest()


def pair(folder, options, watched_first):
    """(processor times alone and watched, pictures seen by program); ends the program where the results differ."""
    names = ("watched", "alone") if watched_first else ("alone", "watched")
    runs = {name: start(folder / name, options) for name in names}
    watcher = Watcher(folder / "watched", options.wish)
    used = {name: processor_time(runs[name]) for name in ("watched", "alone")}
    watcher.stop()
    if digest(folder / "alone") != digest(folder / "watched"):
        raise SystemExit("the watched run has other results")
    return used["alone"], used["watched"], {name: len(steps) for name, steps in watcher.seen.items()}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("case", nargs="?", default="shock_ellipse")
    parser.add_argument("--set", action="append", default=[])
    parser.add_argument("--pairs", type=int, default=5)
    parser.add_argument("--wish", default="fluid.pressure,solid.speed,coupler.outline", help="the pictures; '' for the numbers alone")
    options = parser.parse_args()
    print(f"{options.case}, {options.wish or 'no pictures'}, {options.pairs} pairs, load {os.getloadavg()[0]:.0f}\n\n| nobody watches [s] | somebody watches [s] | ratio | pictures |\n|---|---|---|---|")
    ratios = []
    for k in range(options.pairs):
        with tempfile.TemporaryDirectory() as scratch:
            alone, watched, seen = pair(Path(scratch), options, k % 2 == 0)
        ratios.append(watched / alone)
        print(f"| {alone:.2f} | {watched:.2f} | {ratios[-1]:.3f} | {', '.join(f'{name} {count}' for name, count in sorted(seen.items()))} |", flush=True)
    print(f"\nmedian ratio {statistics.median(ratios):.3f}; the tables of both runs are the same, bit for bit")


if __name__ == "__main__":
    main()
