#!/usr/bin/python3
"""The entries of runs are read by their user alone, since they hold the keys of runs."""

import json
import os
import unittest
from unittest import mock

from launcher import InScratch

from fsi_launch import registry
from fsi_launch.failure import Failure


class Registry(InScratch):
    def setUp(self):
        super().setUp()
        variables = mock.patch.dict(os.environ, {"XDG_RUNTIME_DIR": str(self.folder)})
        variables.start()
        self.addCleanup(variables.stop)

    def mode(self, path):
        return path.stat().st_mode & 0o777

    def test_nobody_else_can_read_an_entry_or_its_folder(self):
        folder = registry.folder()
        folder.mkdir(mode=0o755)
        with registry.Entry("run-1", self.folder, "piston", "sign") as entry:
            self.assertEqual((self.mode(folder), self.mode(entry.path)), (0o700, 0o600))
            self.assertEqual(json.loads(entry.path.read_text(encoding="utf-8"))["key"], entry.key)
        self.assertFalse(entry.path.exists())

    def test_each_run_has_a_key_of_its_own_that_cannot_be_guessed(self):
        keys = {registry.Entry(f"run-{k}", self.folder, "piston", "sign").key for k in range(100)}
        self.assertEqual(len(keys), 100)
        self.assertEqual({len(key) for key in keys}, {len("sign:") + 2 * registry.KEY_BYTES})

    def test_key_says_how_the_run_is_protected(self):
        for protection in ("sign", "encrypt"):
            key = registry.Entry("run-1", self.folder, "piston", protection).key
            self.assertEqual(key.partition(":")[0], protection)
        self.assertEqual(registry.Entry("run-1", self.folder, "piston", "off").key, "")

    def test_folder_of_somebody_else_gets_no_key(self):
        with mock.patch("os.getuid", return_value=os.getuid() + 1):
            registry.folder().mkdir()
            with self.assertRaisesRegex(Failure, "belongs to somebody else"):
                registry.Entry("run-1", self.folder, "piston", "sign").__enter__()
        self.assertEqual(list(registry.folder().iterdir()), [])

    def test_link_in_the_place_of_the_folder_gets_no_key(self):
        (self.folder / "elsewhere").mkdir()
        registry.folder().symlink_to(self.folder / "elsewhere")
        with self.assertRaisesRegex(Failure, "belongs to somebody else"):
            registry.Entry("run-1", self.folder, "piston", "sign").__enter__()


if __name__ == "__main__":
    unittest.main()
