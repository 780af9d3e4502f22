"""Makes the launcher's modules importable, and gives tests a folder of their own."""

import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[3] / "launch"))


class InScratch(unittest.TestCase):
    """Each test gets an empty folder `self.folder` that is removed afterwards."""

    def setUp(self):
        scratch = tempfile.TemporaryDirectory(prefix="fsi-launch-")
        self.addCleanup(scratch.cleanup)
        self.folder = Path(scratch.name)
