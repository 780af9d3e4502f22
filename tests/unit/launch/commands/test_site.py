#!/usr/bin/python3
"""The pages of docs/ make a site without a dead link."""

import contextlib
import io
import sys
import types
import unittest
from pathlib import Path
from unittest import mock

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
import launcher  # noqa: E402
from fsi_launch import site  # noqa: E402
from fsi_launch.failure import Failure  # noqa: E402


class Site(launcher.InScratch):
    def made(self):
        said = io.StringIO()
        with contextlib.redirect_stdout(said):
            site.main(types.SimpleNamespace(open=False))
        return said.getvalue().strip()

    def test_every_page_is_there(self):
        self.assertEqual(self.made(), (site.SITE / "index.html").as_uri())
        for page in (site.paths.ROOT / "docs").glob("*.md"):
            self.assertTrue((site.SITE / f"{page.stem}.html").is_file(), page)

    def test_no_page_shows_the_source_of_a_picture(self):
        self.made()
        for page in site.SITE.glob("*.html"):
            self.assertNotIn("language-mermaid", page.read_text(encoding="utf-8"), page)
        self.assertTrue((site.SITE / "site.css").is_file())

    def test_dead_link_is_found(self):
        with mock.patch.object(site, "FROM_ELSEWHERE", {}), self.assertRaisesRegex(Failure, "wire.md"):
            self.made()


if __name__ == "__main__":
    unittest.main()
