#!/usr/bin/python3
"""The entries of runs are read by their user alone, since they hold the keys of runs."""

import json
import os
import socket
import sys
import unittest
from pathlib import Path
from unittest import mock

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from launcher import InScratch  # noqa: E402
from fsi_launch.living import registry  # noqa: E402
from fsi_launch.failure import Failure  # noqa: E402


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
        with registry.Entry("run-1", self.folder, "piston", "sign", ("fluid", "coupler")) as entry:
            self.assertEqual((self.mode(folder), self.mode(entry.path)), (0o700, 0o600))
            self.assertEqual(json.loads(entry.path.read_text(encoding="utf-8"))["key"], entry.key)
        self.assertFalse(entry.path.exists())

    def test_each_run_has_a_key_of_its_own_that_cannot_be_guessed(self):
        keys = {registry.Entry(f"run-{k}", self.folder, "piston", "sign", ("fluid", "coupler")).key for k in range(100)}
        self.assertEqual(len(keys), 100)
        self.assertEqual({len(key) for key in keys}, {len("sign:") + 2 * registry.KEY_BYTES})

    def test_key_says_how_the_run_is_protected(self):
        for protection in ("sign", "encrypt"):
            key = registry.Entry("run-1", self.folder, "piston", protection, ("fluid", "coupler")).key
            self.assertEqual(key.partition(":")[0], protection)
        self.assertEqual(registry.Entry("run-1", self.folder, "piston", "off", ("fluid", "coupler")).key, "")

    def test_folder_of_somebody_else_gets_no_key(self):
        folder = registry.folder()
        folder.mkdir()
        with mock.patch("os.getuid", return_value=os.getuid() + 1), mock.patch.object(registry, "folder", lambda: folder):
            with self.assertRaisesRegex(Failure, "belongs to somebody else"):
                registry.Entry("run-1", self.folder, "piston", "sign", ("fluid", "coupler")).__enter__()
        self.assertEqual(list(folder.iterdir()), [])

    def test_without_a_runtime_folder_the_entries_lie_where_nobody_else_can_make_a_name(self):
        with mock.patch.dict(os.environ, {"XDG_RUNTIME_DIR": "", "HOME": str(self.folder)}), \
                mock.patch.object(registry, "_is_own", lambda path, own=registry._is_own: str(path) == str(self.folder) and own(path)):
            self.assertEqual(registry.folder(), self.folder / ".cache" / "amp-fsi" / socket.gethostname())
            with registry.Entry("run-1", self.folder, "piston", "sign", ("fluid", "coupler")) as entry:
                self.assertEqual((self.mode(entry.path.parent), self.mode(entry.path)), (0o700, 0o600))

    def test_process_with_the_number_of_a_launcher_that_is_gone_does_not_stand_for_it(self):
        entry = registry.Entry("run-1", self.folder, "piston", "sign", ("fluid", "coupler"))
        entry.content["pid"] = 1    # somebody else has that number
        with entry:
            self.assertIsNone(registry.running_in(self.folder))
            self.assertFalse(entry.path.exists())
        with registry.Entry("run-2", self.folder, "piston", "sign", ("fluid", "coupler")):
            self.assertEqual(registry.running_in(self.folder), os.getpid())

    def test_link_in_the_place_of_the_folder_gets_no_key(self):
        (self.folder / "elsewhere").mkdir()
        registry.folder().symlink_to(self.folder / "elsewhere")
        with self.assertRaisesRegex(Failure, "belongs to somebody else"):
            registry.Entry("run-1", self.folder, "piston", "sign", ("fluid", "coupler")).__enter__()


if __name__ == "__main__":
    unittest.main()
