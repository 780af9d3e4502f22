#!/usr/bin/python3
"""Makes the pictures of both monitors in docs/figures: live_view, live_histories, live_dark, live_phone and live_terminal.

record_screens.py [--case CASE] [--pause-at STEP] [--out FOLDER]

A run is paused at a step, so that all show the same, and looked at in a headless Chromium and on a terminal of 100 x 34, whose characters a
page then draws. Takes Debian's chromium.
"""

import argparse
import fcntl
import html
import os
import pty
import re
import select
import struct
import subprocess
import sys
import tempfile
import termios
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT / "tests" / "programs"))
from monitor import browser  # noqa: E402

FSI = str(ROOT / "launch" / "fsi")
COLUMNS, ROWS = 100, 34
SECONDS = 20        # for a screen to fill
PALETTE = ("#1c1f24", "#e06c75", "#98c379", "#e5c07b", "#61afef", "#c678dd", "#56b6c2", "#dcdfe4")


# --- the terminal


class Screen:
    """What a terminal shows of the sequences that ncurses writes for TERM=xterm: characters, bold, reverse, eight colours."""

    def __init__(self):
        self.cells = [[(" ", "")] * COLUMNS for _ in range(ROWS)]
        self.x = self.y = 0
        self.style = {}
        self.top, self.bottom = 0, ROWS - 1      # of what scrolls

    def write(self, text):
        for sequence, end, other, character in re.findall(r"\x1b\[([0-9;?>]*)([@-~])|(\x1b[()].|\x1b\][^\x07]*\x07|\x1b.)|(.)", text, flags=re.S):
            if end:
                self._control(sequence, end)
            elif other == "\x1bM":
                self._scroll(self.top, -1) if self.y == self.top else self._move(0, -1)
            elif not other:
                self._put(character)

    def _put(self, character):
        if character == "\r":
            self.x = 0
        elif character == "\n":
            self._scroll(self.top, 1) if self.y == self.bottom else self._move(0, 1)
        elif character == "\b":
            self.x = max(self.x - 1, 0)
        elif character >= " ":
            self._set(character)

    def _move(self, across, down):
        self.x, self.y = min(max(self.x + across, 0), COLUMNS - 1), min(max(self.y + down, 0), ROWS - 1)

    def _scroll(self, first, count):
        """Moves the lines from `first` to the last that scrolls up by `count`, or down where it is negative."""
        lines, empty = self.cells[first:self.bottom + 1], [[(" ", "")] * COLUMNS for _ in range(abs(count))]
        moved = lines[count:] + empty if count > 0 else empty + lines[:count]
        self.cells[first:self.bottom + 1] = moved

    def _set(self, character):
        if self.x < COLUMNS:
            self.cells[self.y][self.x] = (character, self._css())
            self.last, self.x = character, self.x + 1

    def _css(self):
        front, back = self.style.get("front", PALETTE[7]), self.style.get("back", "")
        if self.style.get("reverse"):
            front, back = back or PALETTE[0], front
        return f"color:{front};" + (f"background:{back};" if back else "") + ("font-weight:bold;" if self.style.get("bold") else "") \
            + ("opacity:.6;" if self.style.get("dim") else "")

    def _control(self, sequence, end):
        if sequence.startswith(("?", ">")):
            return
        numbers = [int(word or 0) for word in sequence.split(";")]
        n = max(1, numbers[0])
        moves = {"A": (0, -n), "B": (0, n), "C": (n, 0), "D": (-n, 0)}
        if end in moves:
            self._move(*moves[end])
        elif end in "LMST":
            self._scroll(self.y if end in "LM" else self.top, n if end in "MS" else -n)
        elif end == "r":
            self.top, self.bottom = n - 1, (numbers[1] if len(numbers) > 1 else ROWS) - 1
            self.x = self.y = 0
        elif end in "Hf":
            self.y, self.x = n - 1, max(1, numbers[1] if len(numbers) > 1 else 1) - 1
        elif end == "G":
            self.x = n - 1
        elif end == "d":
            self.y = n - 1
        elif end == "b":
            for _ in range(n):
                self._set(self.last)
        elif end in "JKXP":
            self._clear(end, numbers[0], n)
        elif end == "m":
            self._look(numbers)
        self._move(0, 0)

    def _clear(self, end, kind, n):
        empty = (" ", self._css())
        line = self.cells[self.y]
        if end == "P":      # the rest of the line moves to the left
            self.cells[self.y] = line[:self.x] + line[self.x + n:] + [empty] * min(n, COLUMNS - self.x)
            return
        first, last = (0, self.x + 1) if end == "K" and kind == 1 else (self.x, self.x + n if end == "X" else COLUMNS)
        first = 0 if kind == 2 and end != "X" else first
        for k in range(first, min(last, COLUMNS)):
            line[k] = empty
        if end == "J":
            for row in self.cells[self.y + 1:] if kind == 0 else self.cells:
                row[:] = [empty] * COLUMNS

    def _look(self, numbers):
        for number in numbers:
            if number == 0:
                self.style = {}
            elif number in (1, 2, 7):
                self.style[{1: "bold", 2: "dim", 7: "reverse"}[number]] = True
            elif number in (22, 27):
                self.style = {key: value for key, value in self.style.items() if key not in (("bold", "dim") if number == 22 else ("reverse",))}
            elif 30 <= number <= 37:
                self.style["front"] = PALETTE[number - 30]
            elif 40 <= number <= 47:
                self.style["back"] = PALETTE[number - 40]
            elif number in (39, 49):
                self.style.pop("front" if number == 39 else "back", None)

    def page(self):
        lines = ["".join(f'<span style="{css}">{html.escape(character)}</span>' for character, css in row) for row in self.cells]
        style = "display:grid;grid-auto-rows:17px;font:14px/17px 'DejaVu Sans Mono',monospace"
        cell = "<style>b{font-weight:inherit}span{display:inline-block;width:8.43px;height:17px;overflow:hidden;vertical-align:top}</style>"
        return (f'<!DOCTYPE html><meta charset="utf-8">{cell}<body style="margin:0;background:{PALETTE[0]};padding:10px">'
                f'<div style="{style};white-space:pre">' + "".join(f"<div>{line}</div>" for line in lines) + "</div>")


def terminal(command):
    """The Screen that a command fills."""
    screen = Screen()
    pid, master = pty.fork()
    if pid == 0:
        fcntl.ioctl(0, termios.TIOCSWINSZ, struct.pack("HHHH", ROWS, COLUMNS, 0, 0))
        os.environ |= {"TERM": "xterm", "LC_ALL": "C.UTF-8"}
        os.execv(command[0], command)
    end, text = time.monotonic() + SECONDS, b""
    while time.monotonic() < end:
        if select.select([master], [], [], 0.2)[0]:
            text += os.read(master, 65536)
    os.write(master, b"q")
    screen.write(text.decode(errors="replace"))
    os.close(master)
    os.waitpid(pid, 0)
    return screen


# --- the page


def until(page, script):
    end = time.monotonic() + 6 * SECONDS
    while not page.value(script):
        if time.monotonic() > end:
            raise SystemExit(f"the page never came to {script}")
        time.sleep(0.2)


def shoot(page, path, width, height, scroll=0, mobile=False):
    page.ask("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=1, mobile=mobile)
    page.value(f"window.scrollTo(0, {scroll})")
    time.sleep(3)
    page.picture(path)
    print(path)


def shoot_page(page, out):
    until(page, "currentFrame() && currentFrame().pictures.size > 1")
    shoot(page, out / "live_view.png", 1400, 1000)
    history = "[...document.querySelectorAll('section')].find((section) => section.innerText.startsWith('History'))"
    shoot(page, out / "live_histories.png", 1400, 1000, f"{history}.offsetTop - 130")
    shoot(page, out / "live_phone.png", 390, 844, mobile=True)
    page.value("document.getElementById('theme').click()")
    shoot(page, out / "live_dark.png", 1400, 1000)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--case", default="shock_ellipse")
    parser.add_argument("--pause-at", default="400")
    parser.add_argument("--out", type=Path, default=ROOT / "docs" / "figures")
    options = parser.parse_args()
    program = browser.Browser(browser.find())
    page = program.page()
    with tempfile.TemporaryDirectory() as scratch:
        folder = f"{scratch}/run"
        run = subprocess.Popen([FSI, "run", options.case, "--out", folder, "--pause-at", options.pause_at, "--no-progress"],
                               stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL)
        while not Path(folder, "interface.csv").is_file():
            time.sleep(0.1)
        monitor = subprocess.Popen([FSI, "monitor", folder, "--web", "0"], stdout=subprocess.PIPE, text=True)
        page.show(monitor.stdout.readline().strip())    # it sees all of the run until the pause
        until(page, "document.getElementById('status').innerText === 'paused'")
        screen = terminal([FSI, "monitor", folder])
        shoot_page(page, options.out)
        drawn = Path(scratch, "terminal.html")
        drawn.write_text(screen.page(), encoding="utf-8")
        page.show(drawn.as_uri())
        shoot(page, options.out / "live_terminal.png", round(8.43 * COLUMNS) + 20, 17 * ROWS + 20)
        subprocess.run([FSI, "ctl", folder, "stop"], check=False, capture_output=True)
        run.wait()
        monitor.kill()
        monitor.wait()
    program.close()


if __name__ == "__main__":
    main()
