"""The bar a person watches while a run goes on, from the `progress ...` lines of the coupler or the standalone solver."""

import collections
import select
import shutil
import sys
import time

from fsi_launch.telling import silence

BAR = 24            # characters, at most
SHORTEST_BAR = 8    # with fewer there is none
LINE_EVERY = 5.0    # [s] between lines when the output is not a terminal
DRAW_EVERY = 0.1    # [s] between two states of the bar
WINDOW = 10.0       # [s] over which speed is measured


def parse(text):
    """{key: value} of a line `progress step=12 t=0.03 dt=1e-3 limit=fluid t_end=.8`, or None for any other line."""
    words = text.split()
    if not words or words[0] != "progress":
        return None
    values = dict(word.split("=", 1) for word in words[1:] if "=" in word)
    try:
        state = {key: float(values[key]) for key in ("t", "dt", "t_end")}
        state["step"] = int(values["step"])
    except (KeyError, ValueError):
        return None
    state["limit"] = values.get("limit", "").replace("_", " ")
    return state


def clock(seconds):
    """3725 -> 1:02:05"""
    minutes, s = divmod(int(seconds), 60)
    hours, m = divmod(minutes, 60)
    return f"{hours}:{m:02}:{s:02}" if hours else f"{m}:{s:02}"


def fitting(words, width):
    """The words that go into a line: [(rank, text)] in the order of the line; where they do not fit those of the highest rank are
    left away first."""
    words = list(words)
    while len(words) > 1 and sum(len(text) + 2 for _, text in words) - 2 > width:
        words.remove(max(words, key=lambda word: word[0]))
    return [text for _, text in words]


def _takes(out):
    """Does it take a line without waiting? What is no file does."""
    try:
        return bool(select.select([], [out], [], 0)[1])
    except (OSError, ValueError):
        return True


class Progress:
    """Shows the newest state on `out`; `enabled=False` keeps silent."""

    def __init__(self, enabled=True, out=None):
        self._out = out or sys.stderr
        self._enabled = enabled
        self._bar = self._out.isatty()
        self._state = None
        self._history = collections.deque()
        self._began = self._drawn = time.monotonic()
        self._on_screen = False

    def hear(self, text):
        """Takes a line a program printed."""
        if state := parse(text):
            self._state = state
            now = time.monotonic()
            self._history.append((now, state["step"], state["t"]))
            while now - self._history[0][0] > WINDOW and len(self._history) > 2:
                self._history.popleft()

    def reached(self):
        """{t, steps} of the newest state, or None before the first."""
        return self._state and {"t": self._state["t"], "steps": self._state["step"]}

    def tick(self):
        """Draws when it is time to."""
        now = time.monotonic()
        if self._state and self._enabled and now - self._drawn >= (DRAW_EVERY if self._bar else LINE_EVERY):
            self._drawn = now
            self._draw()

    def close(self):
        """Removes the bar."""
        if self._on_screen:
            self._show("\r\033[K")

    def _speed(self):
        """(steps per second, time of the problem per second), or (0, 0) while unknown."""
        (first, step0, t0), (last, step1, t1) = self._history[0], self._history[-1]
        seconds = last - first
        return ((step1 - step0) / seconds, (t1 - t0) / seconds) if seconds > 0 else (0.0, 0.0)

    def _part(self):
        state = self._state
        return min(1.0, max(0.0, state["t"] / state["t_end"])) if state["t_end"] > 0 else 0.0

    def _words(self):
        """(rank, text) of all there is to say; rank 0 is said on the narrowest terminal."""
        state, (steps, rate) = self._state, self._speed()
        words = [(0, f"{100 * self._part():3.0f} %"), (2, f"t {state['t']:.3g} of {state['t_end']:.3g}"), (3, f"step {state['step']}")]
        if state["dt"] > 0:     # the end has none
            words.append((5, f"dt {state['dt']:.1e}" + (f" ({state['limit']})" if state["limit"] else "")))
        if rate > 0:
            words.append((6, f"{steps:.0f} steps/s"))
        words.append((4, clock(time.monotonic() - self._began)))
        if rate > 0:
            words.append((1, f"{clock((state['t_end'] - state['t']) / rate)} left"))
        return words

    def text(self, width):
        """The line for a terminal of so many columns, with a bar; None: all words and no bar."""
        if width is None:
            return "  ".join(word for _, word in self._words())
        text = "  ".join(fitting(self._words(), width - SHORTEST_BAR - 4))  # brackets and spaces
        room = min(BAR, width - len(text) - 4)
        if room < SHORTEST_BAR:
            return text[:width]
        full = round(room * self._part())
        return f"[{'=' * full}{' ' * (room - full)}]  {text}"

    def _draw(self):
        if self._bar:
            self._on_screen = True
            self._show("\r" + self.text(shutil.get_terminal_size().columns - 1) + "\033[K")
        else:
            self._show(self.text(None) + "\n")

    def _show(self, text):
        """Where nothing can be shown any more, as on a terminal that was closed, the run goes on in silence; one that does not take
        anything now, as after Ctrl-S, must not hold the launcher up."""
        if not _takes(self._out):
            return
        try:
            self._out.write(text)
            self._out.flush()
        except OSError:
            self._enabled = self._on_screen = False
            silence(self._out)
