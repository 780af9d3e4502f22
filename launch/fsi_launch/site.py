"""`fsi docs`: the pages of docs/ as a site, made by mkdocs."""

import re
import shutil
import subprocess
import sys
import webbrowser

from fsi_launch import paths
from fsi_launch.failure import DONE, Failure, INTERNAL_ERROR
from fsi_launch.telling import AS_NAMED

PAGES, SITE = paths.ROOT / "build" / "site_pages", paths.ROOT / "build" / "site"
FROM_ELSEWHERE = {"idl/README.md": "wire.md", "monitor/README.md": "watching.md", "gallery/README.md": "gallery.md"}   # pages that lie beside what they describe


def _link(target, folder):
    """A link of a page in `folder` as the site has it: to another page, or to the source in the checkout."""
    path, mark, place = target.partition("#")
    if not path or "://" in path:
        return target
    found = (folder / path).resolve()
    inside = FROM_ELSEWHERE.get(str(found.relative_to(paths.ROOT))) if found.is_relative_to(paths.ROOT) else None
    if inside:
        return inside + mark + place
    if found.is_relative_to(paths.ROOT / "docs"):
        return str(found.relative_to(paths.ROOT / "docs")) + mark + place
    return found.as_uri()


def _copy(page, name):
    text = page.read_text(encoding="utf-8")
    text = re.sub(r"\]\(([^)\s]+)\)", lambda match: f"]({_link(match[1], page.parent)})", text)
    # A list that follows its sentence at once is one for GitHub; mkdocs wants an empty line between.
    text = re.sub(r"^(?![-|>\s]|\d+\.)(.+)\n(?=- )", r"\1\n\n", text, flags=re.M)
    (PAGES / name).write_text(text, encoding="utf-8")


def main(options):
    """Makes build/site, prints where it begins, and opens it."""
    shutil.rmtree(PAGES, ignore_errors=True)
    shutil.copytree(paths.ROOT / "docs" / "figures", PAGES / "figures")
    shutil.copy(paths.ROOT / "docs" / "site.css", PAGES)
    for page in sorted((paths.ROOT / "docs").glob("*.md")):
        _copy(page, page.name)
    for source, name in FROM_ELSEWHERE.items():
        _copy(paths.ROOT / source, name)
    answer = subprocess.run(["mkdocs", "build", "--strict"], cwd=paths.ROOT, stdin=subprocess.DEVNULL, capture_output=True,
                            **AS_NAMED, check=False)
    if answer.returncode != 0:
        said = [line for line in (answer.stdout + answer.stderr).splitlines() if not line.startswith("INFO")]
        raise Failure(INTERNAL_ERROR, "mkdocs: " + "\n".join(said))
    begin = (SITE / "index.html").as_uri()
    print(begin)
    if options.open and sys.stdout.isatty():
        webbrowser.open(begin)
    return DONE
