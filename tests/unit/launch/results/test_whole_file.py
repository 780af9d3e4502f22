"""Files that are written whole or not at all."""

import os
import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from launcher import InScratch  # noqa: E402
from fsi_launch.results import whole_file  # noqa: E402


class WholeFile(InScratch):
    def test_one_takes_the_place_of_another(self):
        path = self.folder / "table.csv"
        whole_file.write(path, "one\n")
        whole_file.write(path, "other\n")
        self.assertEqual(path.read_text(encoding="utf-8"), "other\n")
        self.assertEqual(os.listdir(self.folder), ["table.csv"])

    def test_an_error_within_leaves_what_was_there_and_has_the_name(self):
        path = self.folder / "table.csv"
        whole_file.write(path, "one\n")
        with self.assertRaises(OSError) as raised:
            with whole_file.writing(path) as file:
                file.write("half of it")
                raise OSError(28, "No space left on device")
        self.assertEqual((raised.exception.errno, raised.exception.filename), (28, str(path)))
        self.assertEqual(path.read_text(encoding="utf-8"), "one\n")
        self.assertEqual(os.listdir(self.folder), ["table.csv"])

    def test_what_is_refused_by_the_disk_has_its_name(self):
        with self.assertRaises(OSError) as raised:
            whole_file.write("/dev/full", "text\n" * 100000)
        self.assertEqual(raised.exception.filename, "/dev/full")
        with self.assertRaises(OSError) as raised:
            whole_file.write(self.folder / "no" / "table.csv", "text")
        self.assertEqual(raised.exception.filename, str(self.folder / "no" / "table.csv"))

    def test_links_and_devices_stay_what_they_are(self):
        link, target = self.folder / "link", self.folder / "target"
        link.symlink_to(target)
        whole_file.write(link, "text\n")
        self.assertTrue(link.is_symlink())
        self.assertEqual(target.read_text(encoding="utf-8"), "text\n")
        pipe = self.folder / "pipe"
        os.mkfifo(pipe)
        end = os.open(pipe, os.O_RDONLY | os.O_NONBLOCK)
        whole_file.write(pipe, "told\n")
        self.assertEqual(os.read(end, 100), b"told\n")
        os.close(end)
        self.assertEqual(sorted(os.listdir(self.folder)), ["link", "pipe", "target"])


if __name__ == "__main__":
    unittest.main()
