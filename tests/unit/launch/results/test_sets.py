#!/usr/bin/python3
"""A restart goes on from the last set of checkpoint files that is whole, whatever format a program keeps its state in."""

import json
import sys
import unittest
import zlib
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from launcher import InScratch  # noqa: E402
from fsi_launch.results import restart  # noqa: E402


class Sets(InScratch):
    def write(self, step, states):
        """The set of a step, with its manifest. `states`: {file: content}."""
        folder = self.folder / "checkpoints" / f"{step:08}"
        folder.mkdir(parents=True)
        for file, content in states.items():
            (folder / file).write_bytes(content)
        files = {file.split(".")[0]: {"file": file, "bytes": len(content), "crc32": zlib.crc32(content)}
                 for file, content in states.items()}
        (folder / "manifest.json").write_text(json.dumps({"step": step, "t": 0.1 * step, "case": "a case", "files": files}))
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

    def test_set_of_another_case_is_not_used(self):
        self.write(10, {"fluid.h5": b"gas"})
        newest = self.write(20, {"fluid.h5": b"gas"}) / "manifest.json"
        newest.write_text(newest.read_text().replace("a case", "another"))
        flaws = []
        self.assertEqual(restart.latest(self.folder, flaws.append, "a case").step, 10)
        self.assertEqual(flaws, ["the checkpoint of step 20 is of another case"])

    def test_manifest_with_anything_in_it_is_a_flaw_with_words(self):
        self.write(10, {"fluid.h5": b"gas"})
        manifest = self.write(20, {"fluid.h5": b"gas"}) / "manifest.json"
        whole = manifest.read_text()
        for old, new, words in (('"step": 20', '"step": 1e400', "step is inf"), ('"step": 20', '"step": -20', "step is -20"),
                                ('"step": 20', '"step": 21', "step is 21"), ('"t": 2.0', '"t": NaN', "t is nan"),
                                ('"t": 2.0', '"t": null', "t is None"), ('"bytes": 3', '"bytes": "3"', "bytes is '3'"),
                                ('"file": "fluid.h5"', '"file": "../fluid.h5"', "names no file of fluid"),
                                ('"file": "fluid.h5"', '"file": 7', "names no file of fluid"), (whole, "[]", "names no files"),
                                (whole, "{", "cannot be read"), (whole, "[" * 100000, "cannot be read"),
                                (whole, '{"files": []}', "names no files")):
            manifest.write_text(whole.replace(old, new))
            flaws = []
            self.assertEqual(restart.latest(self.folder, flaws.append).step, 10, new)
            self.assertRegex(" ".join(flaws), rf"^the checkpoint of step 20 is damaged: .*{words}")

    def test_only_folders_with_the_programs_names_are_sets(self):
        states = {"fluid.h5": b"gas"}
        elsewhere = self.write(40, states)
        elsewhere.rename(self.folder / "elsewhere")
        elsewhere.symlink_to(self.folder / "elsewhere", target_is_directory=True)
        for name in ("keep", "50_old", "5\u0660", str(1 << 64)):
            (self.folder / "checkpoints" / name / "x").mkdir(parents=True)
        (self.folder / "checkpoints" / "60").write_text("a file")
        self.assertIsNone(restart.latest(self.folder))
        for step in (10, 20, 30):
            self.write(step, states)
        flaws = []
        self.assertEqual(restart.latest(self.folder, flaws.append).step, 30)
        self.assertEqual(flaws, [])

    def test_one_that_lacks_a_file_or_its_manifest_is_not_used(self):
        (self.write(10, {"fluid.h5": b"gas"}) / "manifest.json").unlink()
        (self.write(20, {"fluid.h5": b"gas", "piston.state": b"q"}) / "piston.state").unlink()
        self.assertIsNone(restart.latest(self.folder))


if __name__ == "__main__":
    unittest.main()
