#!/usr/bin/python3
"""A restart goes on from the last set of checkpoint files that is whole, whatever format a program keeps its state in."""

import json
import unittest
import zlib

from launcher import InScratch

from fsi_launch import restart


class Sets(InScratch):
    def write(self, step, states):
        """The set of a step, with its manifest. `states`: {file: content}."""
        folder = self.folder / "checkpoints" / f"{step:08}"
        folder.mkdir(parents=True)
        for file, content in states.items():
            (folder / file).write_bytes(content)
        files = {file.split(".")[0]: {"file": file, "bytes": len(content), "crc32": zlib.crc32(content)}
                 for file, content in states.items()}
        (folder / "manifest.json").write_text(json.dumps({"step": step, "t": 0.1 * step, "files": files}))
        return folder

    def test_latest_whole_one_counts(self):
        states = {"fluid.h5": b"gas", "piston.state": b"q = 0.5\n"}
        self.write(10, states)
        newest = self.write(20, states)
        self.assertEqual(restart.latest(self.folder).step, 20)
        (newest / "piston.state").write_bytes(b"q = 0.6\n")
        flaws = []
        self.assertEqual(restart.latest(self.folder, flaws.append).step, 10)
        self.assertEqual(flaws, ["the checkpoint of step 20 is damaged: piston.state is not what was written"])

    def test_one_that_lacks_a_file_or_its_manifest_is_not_used(self):
        (self.write(10, {"fluid.h5": b"gas"}) / "manifest.json").unlink()
        (self.write(20, {"fluid.h5": b"gas", "piston.state": b"q"}) / "piston.state").unlink()
        self.assertIsNone(restart.latest(self.folder))


if __name__ == "__main__":
    unittest.main()
