#!/usr/bin/python3
"""The progress lines of the programs are understood, other lines are left alone."""

import io
import unittest

import launcher  # noqa: F401  the path of the modules

from fsi_launch import progress


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


if __name__ == "__main__":
    unittest.main()
