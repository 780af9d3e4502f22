"""Who names no folder gets one that nobody else has."""

import os
import sys
import threading
import unittest
import unittest.mock
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from launcher import InScratch  # noqa: E402
from fsi_launch.failure import Failure, OUTPUT_FAILED  # noqa: E402
from fsi_launch.results import new_folder  # noqa: E402


class NewFolder(InScratch):
    def setUp(self):
        super().setUp()
        self.addCleanup(os.chdir, os.getcwd())
        os.chdir(self.folder)

    def test_those_who_begin_at_once_get_one_each(self):
        found = []
        threads = [threading.Thread(target=lambda: found.append(new_folder.claimed("case"))) for _ in range(20)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(len(set(found)), 20)
        for directory in found:
            self.assertTrue(directory.is_dir())
            self.assertRegex(str(directory), r"^runs/case-\d{8}-\d{6}(-\d+)?$")

    def test_without_a_name_left_the_option_is_named(self):
        Path("runs").mkdir()
        with unittest.mock.patch.object(Path, "mkdir", side_effect=[None, *[FileExistsError()] * 999]):
            with self.assertRaisesRegex(Failure, "no free name for case-.* in runs/; name a folder with --out") as raised:
                new_folder.claimed("case")
        self.assertEqual(raised.exception.code, OUTPUT_FAILED)


if __name__ == "__main__":
    unittest.main()
