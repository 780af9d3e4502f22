#!/usr/bin/python3
"""What is told while a program answers, and that it does not outlive the one who asks."""

import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path
from unittest import mock

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
import launcher  # noqa: E402
from fsi_launch import telling  # noqa: E402


class Order(unittest.TestCase):
    """Python keeps what is printed to a file until much of it has come together, or the command ends."""

    @staticmethod
    def command(words):
        """What a script of these words says, and the environment for it."""
        begin = f"import sys; sys.path.insert(0, {str(launcher.ROOT / 'launch')!r}); from fsi_launch.telling import tell; "
        kept = {name: value for name, value in os.environ.items() if name != "PYTHONUNBUFFERED"}
        return {"args": [sys.executable, "-c", begin + words], "env": kept, "text": True, "check": False}

    def test_what_was_printed_before_comes_before_in_one_file(self):
        said = subprocess.run(**self.command("print('one'); tell('two'); print('three')"), stdout=subprocess.PIPE, stderr=subprocess.STDOUT).stdout
        self.assertEqual(said, "one\ntwo\nthree\n")

    def test_a_full_disk_is_told_when_the_command_ends(self):
        with open("/dev/full", "w", encoding="utf-8") as full:
            ended = subprocess.run(**self.command("print('one'); tell('two'); sys.stdout.flush()"), stdout=full, stderr=subprocess.PIPE)
        self.assertTrue(ended.stderr.startswith("two\n"), ended.stderr)
        self.assertIn("No space left", ended.stderr)


class Answers(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.gate = Path(folder.name) / "gate"
        os.mkfifo(self.gate)
        watched = mock.patch.object(telling, "is_watched", lambda: True)
        watched.start()
        self.addCleanup(watched.stop)

    def test_of_a_program_that_is_quick_come_alone(self):
        with mock.patch.object(telling, "tell") as told:
            answer = telling.answer_of(["sh", "-c", "echo yes; echo but >&2; exit 2"], "waiting", 1e6)
        self.assertEqual((answer.stdout, answer.stderr, answer.returncode, told.call_count), ("yes\n", "but\n", 2, 0))

    def test_of_a_slow_one_are_announced(self):
        """It waits until three lines were told, after 0.5, 1 and 2 s."""
        lines = []

        def hear(line):
            lines.append(line)
            if len(lines) == 3:
                with open(self.gate, "w", encoding="utf-8"):
                    pass

        with mock.patch.object(telling, "tell", hear):
            answer = telling.answer_of(["sh", "-c", f"cat < {self.gate}; echo yes"], "waiting", 0.5)
        self.assertEqual((lines[:3], answer.stdout), ([f"waiting ({seconds} s so far)" for seconds in (0, 1, 2)], "yes\n"))

    def test_of_a_slow_one_come_alone_where_nobody_waits(self):
        """What a script reads does not depend on how fast the machine is."""
        with mock.patch.object(telling, "is_watched", lambda: False), mock.patch.object(telling, "tell") as told:
            answer = telling.answer_of(["sh", "-c", "sleep 0.2; echo yes"], "waiting", 0.01)
        self.assertEqual((answer.stdout, told.call_count), ("yes\n", 0))

    def test_are_not_waited_for_by_one_who_is_interrupted(self):
        with mock.patch.object(telling, "tell", side_effect=KeyboardInterrupt), self.assertRaises(KeyboardInterrupt):
            telling.answer_of(["sh", "-c", f"exec cat < {self.gate}"], "waiting", 0.01)


if __name__ == "__main__":
    unittest.main()
