#!/usr/bin/python3
"""docs/results.md and docs/record_results.py belong together: every section has its study, every study can be asked for; and links of the
documentation lead to headings that are there."""

import importlib
import re
import sys
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
DOCS = ROOT / "docs"
ASKED_FOR = re.compile(r'record_results\.py(?: --check| --list)?((?:\s+"[^"$]+")+)')
TEXTS = [path for pattern in ("*.md", "docs/*.md", "docs/*.py", "tests/**/*.md", "tests/**/*.py", "gallery/*.md", ".ci/*")
         for path in ROOT.glob(pattern) if path.is_file()]

sys.dont_write_bytecode = True
sys.path.insert(0, str(DOCS))
import record_results  # noqa: E402

TITLES = [title for title, _ in record_results.all_studies()]


class Recorded(unittest.TestCase):
    def test_titles_are_of_one_study_each(self):
        self.assertEqual(len(TITLES), len(set(TITLES)))

    def test_every_section_has_its_study(self):
        sections = set(record_results.kept_sections()) - {"The paper's tables in one", "What differs from the paper", "Contents"}
        self.assertEqual(sections - set(TITLES), set())

    def test_every_study_is_among_all(self):
        modules = [importlib.import_module(path.stem) for path in DOCS.glob("*.py") if "\ndef studies(" in path.read_text(encoding="utf-8")]
        self.assertGreater(len(modules), 5)
        for module in modules:
            self.assertEqual({title for title, _ in module.studies(record_results)} - set(TITLES), set(), module.__name__)

    def test_studies_that_texts_name_are_there(self):
        named = {word for path in TEXTS for words in ASKED_FOR.findall(path.read_text(encoding="utf-8"))
                 for word in re.findall(r'"([^"]+)"', words)}
        self.assertGreater(len(named), 2)
        for word in named:
            self.assertTrue(any(" ".join(word.split()) in title for title in TITLES), word)

    def test_links_lead_to_headings(self):
        pages = {path: path.read_text(encoding="utf-8") for path in ROOT.rglob("*.md") if "build" not in path.parts and "runs" not in path.parts}
        headings = {path: {record_results.anchor(title) for title in re.findall(r"^#+ (.*)$", text, flags=re.M)} for path, text in pages.items()}
        links = [(path, target) for path, text in pages.items() for target in re.findall(r"\]\(([^)\s:]*#[^)\s]+)\)", text)]
        self.assertGreater(len(links), 100)
        for path, link in links:
            with self.subTest(page=str(path.relative_to(ROOT)), link=link):
                name, _, heading = link.partition("#")
                page = (path.parent / name).resolve() if name else path
                if page in headings:
                    self.assertIn(heading, headings[page])

    def test_words_that_no_title_has_are_refused(self):
        with self.assertRaises(SystemExit) as refused:
            record_results.chosen_studies(["Rotating disk", "no such study"])
        self.assertIn("'no such study'", str(refused.exception))
        self.assertNotIn("Rotating disk", str(refused.exception))


if __name__ == "__main__":
    unittest.main()
