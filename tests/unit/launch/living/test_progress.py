#!/usr/bin/python3
"""The progress lines of the programs are understood, other lines are left alone."""

import contextlib
import errno
import io
import os
import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
import launcher  # noqa: E402,F401  the path of the launcher's modules
from fsi_launch.living import progress  # noqa: E402


class Gone(io.StringIO):
    """A terminal that was closed; it counts how often it was written to."""

    asked = 0

    def write(self, text):
        self.asked += 1
        raise OSError(errno.EIO, "Input/output error")


class Lines(unittest.TestCase):
    def test_line_of_a_program(self):
        state = progress.parse("progress step=12 t=0.03 dt=1e-3 limit=fluid_waves t_end=.8")
        self.assertEqual(state, {"step": 12, "t": 0.03, "dt": 1e-3, "t_end": 0.8, "limit": "fluid waves"})

    def test_other_lines(self):
        for text in ("", "hello", "progress", "progress step=x t=1 dt=1 t_end=1", "progressive step=1"):
            self.assertIsNone(progress.parse(text))

    def test_hours(self):
        self.assertEqual([progress.clock(s) for s in (5, 65, 3725)], ["0:05", "1:05", "1:02:05"])

    def test_silent_when_asked(self):
        out = io.StringIO()
        shown = progress.Progress(enabled=False, out=out)
        shown.hear("progress step=1 t=0.1 dt=0.1 limit=fluid t_end=1")
        shown.tick()
        shown.close()
        self.assertEqual(out.getvalue(), "")

    def test_who_takes_nothing_now_holds_nobody_up(self):
        reader, writer = os.pipe()
        self.addCleanup(os.close, reader)
        os.set_blocking(writer, False)
        with contextlib.suppress(BlockingIOError):
            while True:
                os.write(writer, b"." * 4096)
        os.set_blocking(writer, True)
        with os.fdopen(writer, "w", encoding="ascii") as out:
            shown = progress.Progress(out=out)
            shown.hear("progress step=1 t=0.1 dt=0.1 limit=fluid t_end=1")
            shown.tick()    # comes back
            self.assertNotIn(b"%", os.read(reader, 1 << 20))
            shown._drawn = 0
            shown.tick()
        self.assertIn(b"10 %", os.read(reader, 1 << 20))

    def test_who_cannot_be_shown_anything_is_shown_nothing_more(self):
        for ready in (True, False):
            out = Gone()
            out.isatty = lambda ready=ready: ready
            shown = progress.Progress(out=out)
            shown.hear("progress step=1 t=0.1 dt=0.1 limit=fluid t_end=1")
            for _ in range(2):
                shown._drawn = float("-inf")
                shown.tick()
            shown.close()
            self.assertEqual(out.asked, 1)


class Widths(unittest.TestCase):
    """The line fits every terminal and leaves away what matters least."""

    def setUp(self):
        self.shown = progress.Progress(out=io.StringIO())
        self.shown._began -= 75
        for step, t in ((1, 0.1), (2, 0.2)):
            self.shown.hear(f"progress step={step} t={t} dt=0.1 limit=waves_in_the_solid t_end=1")
        first, *_ = self.shown._history
        self.shown._history[0] = (first[0] - 10, *first[1:])

    def test_no_line_is_too_long(self):
        for width in range(5, 140):
            self.assertLessEqual(len(self.shown.text(width)), width)

    def test_narrow_terminal_keeps_bar_part_and_time_left(self):
        line = self.shown.text(40)
        for words in ("[", "20 %", "1:20 left"):
            self.assertIn(words, line)
        self.assertNotIn("steps/s", line)

    def test_sixty_columns_say_steps_time_and_limits_of_neither(self):
        line = self.shown.text(60)
        for words in ("20 %", "t 0.2 of 1", "step 2", "left"):
            self.assertIn(words, line)

    def test_the_end_has_no_step(self):
        self.assertIn("dt 1.0e-01", self.shown.text(120))
        self.shown.hear("progress step=3 t=1 dt=0 limit= t_end=1")
        self.assertNotIn("dt", self.shown.text(120))

    def test_wide_terminal_says_everything(self):
        line = self.shown.text(120)
        for words in ("dt 1.0e-01 (waves in the solid)", "steps/s", "1:15", "1:20 left"):
            self.assertIn(words, line)


if __name__ == "__main__":
    unittest.main()
