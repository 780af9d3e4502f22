#!/usr/bin/python3
"""The pages of docs/ make a site without a dead link."""

import contextlib
import io
import types
import unittest
from unittest import mock

import launcher

from fsi_launch import site
from fsi_launch.failure import Failure


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
