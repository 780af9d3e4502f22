"""What a picture of one run says above all else: the case, its grid, the laws, and the parameters that are not as the case ships (of a
case of one's own nobody knows which of its parameters matter)."""

import re
import textwrap

from fsi_launch import paths
from fsi_launch.plot.look import units

MOST = 4        # parameters
LETTERS = 13    # of the line in an inch
SHORTEST = 30   # line, where a picture is narrow

_caption = ""   # of the pictures that are being drawn, as the units of their labels


def _parameters(text):
    """{name: number} of the section `parameters` of a case, as far as they are plain numbers."""
    section = re.search(r"^parameters:\n((?:[ \t]+.*\n|[ \t]*\n)*)", text, flags=re.MULTILINE)
    found = {}
    for line in section[1].splitlines() if section else ():
        name, _, value = line.split("#")[0].strip().partition(":")
        try:
            found[name] = float(value)
        except ValueError:
            continue
    return found


def _own_parameters(name, text):
    """Those of a run that differ from the case of configs/ it was made from."""
    shipped = paths.ROOT / "configs" / f"{name}.yaml"
    if not shipped.is_file():
        return {}
    usual = _parameters(shipped.read_text(encoding="utf-8"))
    return {key: value for key, value in _parameters(text).items() if key in usual and usual[key] != value}


def spacing(factor, unit=""):
    """That of a case with this `grid.factor`, in words."""
    if unit:
        return f"h = {0.1 / factor:.4g} {unit}"
    return f"h = 1/{10 * factor:g}" if factor > 0.1 else f"h = {0.1 / factor:g}"


def of_case(text, entries):
    """One line; `entries`: what several.entries says of the text of a resolved case."""
    name = entries.get("name", "")
    words = [name] if name else []
    if "grid.factor" in entries:
        words.append(spacing(float(entries["grid.factor"]), units.SYMBOLS[entries.get("units", "none")].get("length", "")))
    laws = [value.replace("_", " ") for key, value in entries.items() if re.fullmatch(r"solids\.[^.]+\.law", key)]
    words += dict.fromkeys(laws)
    words += [f"{key} = {value:g}" for key, value in list(_own_parameters(name, text).items())[:MOST]]
    return ", ".join(words)


def use(line):
    """Takes a line for all pictures from now on; "" for none."""
    global _caption     # noqa: PLW0603
    _caption = line


def head(figure, line):
    """Writes a line above all else, in as many as the width of the picture makes of it."""
    figure.suptitle(textwrap.fill(line, max(SHORTEST, int(LETTERS * figure.get_figwidth()))), x=0.01, ha="left", fontsize=10)


def write(figure):
    """Puts it before what a picture says of itself."""
    if not _caption:
        return
    own = figure._suptitle.get_text() if figure._suptitle else ""      # noqa: SLF001
    if not own.startswith(_caption):
        head(figure, f"{_caption}: {own}" if own else _caption)
