"""The outline of the body in a new case: a circle, or points from a file."""

import math
import re
from dataclasses import dataclass, replace
from pathlib import Path

from fsi_launch.failure import UserMistake

FEWEST = 4              # points of a smooth curve
FEWEST_CORNERS = 3      # of straight edges
SHARP = 100             # [degree] turns beyond those of a square are meant as corners
CLEAR = 45              # [degree] so are these, where the points on one side of them turn by less than BESIDE of it: a blunt tail
BESIDE = 0.1
# Units [m] that a heading may name.
UNITS = {"um": 1e-6, "mm": 1e-3, "cm": 1e-2, "m": 1.0, "km": 1e3, "in": 0.0254, "ft": 0.3048}
SPELLINGS = {"µm": "um", "μm": "um", "inch": "in", "inches": "in", "feet": "ft", "foot": "ft",
             **{f"{prefix}met{ending}": unit for prefix, unit in (("micro", "um"), ("milli", "mm"), ("centi", "cm"), ("", "m"), ("kilo", "km"))
                for ending in ("re", "res", "er", "ers")}}
OF_COLUMN = r"\b[xy][^\W_]*\s*(?:[_/(\[]|\bin\b)\s*(?:in\s+)?([a-zµμ]+)"      # x_mm, x [mm], x (in mm), x/mm, x in mm


@dataclass(frozen=True)
class Outline:
    """Points (x, y) of a closed outline in their order, or a circle about the origin where there are none."""

    path: Path = None
    points: tuple = ()
    radius: float = 0.0
    unit: str = ""      # that the heading of its file names
    title: str = ""     # of its file: what is said about it
    headings: int = 0   # lines before its points that are no comments
    changed: bool = False   # are the points other ones than the lines of its file say

    def box(self):
        """(x low, x high, y low, y high)"""
        if not self.points:
            return -self.radius, self.radius, -self.radius, self.radius
        x, y = zip(*self.points)
        return min(x), max(x), min(y), max(y)

    def size(self):
        """The longer side of the box [m]."""
        x_low, x_high, y_low, y_high = self.box()
        return max(x_high - x_low, y_high - y_low)


DECIMAL = r"[+-]?\d+,\d+(?:[eE][+-]?\d+)?"      # a number with a decimal comma


def _decimal_commas(line):
    """The two parts of a line whose numbers have decimal commas, or None: only between them is another sign, `;` or a tab."""
    parts = [part.strip() for part in re.split(r"[;\t]", line) if part.strip()]
    numbers = len(parts) == 2 and all(re.fullmatch(DECIMAL, part) or _is_number(part) for part in parts)
    return [part.replace(",", ".") for part in parts] if numbers and "," in "".join(parts) else None


def _numbers(line):
    words = _decimal_commas(line) or re.split(r"[,;\s]+", line.strip())
    return tuple(float(word) for word in words if word)


def _is_number(word):
    try:
        float(word.strip("\"'"))
        return True
    except ValueError:
        return False


def _names_columns(text):
    """Words, and no number among them."""
    return not any(map(_is_number, re.split(r"[,;\s]+", text)))


def _is_title(text):
    """Is a first line one of a file of points of an airfoil? It begins with no number, has a word or a name such as E387, and is no
    heading: that has separators, or words that begin with x and y."""
    if _names_columns(text):
        return not re.search(r"[,;\t]", text) and not all(re.match("[\"']?[xy]", word.lower()) for word in text.split())
    words = re.split(r"[,;\s]+", text)
    return not _is_number(words[0]) and any(re.fullmatch(r"[^\W\d_]\w*", word) and not _is_number(word) for word in words)


def _words(text):
    return re.findall(r"[a-zµμ]+", text.lower())


def _speaks_of_columns(comment):
    """Does a comment name the columns x and y, or the unit?"""
    words = set(_words(comment))
    return _names_columns(comment) and ({"x", "y"} <= words or bool({"unit", "units"} & words))


def _unit(heading, place):
    """The unit that the names of columns have, or else one that stands among them, or "". Throws UserMistake where there are several."""
    def known(words):
        return sorted({SPELLINGS.get(word, word) for word in words} & UNITS.keys())
    plain = heading.lower().replace('"', "").replace("'", "")
    free = [word for word in _words(heading) if word != "in"]    # that one may be no unit
    found = known(re.findall(OF_COLUMN, plain)) or known(free) or known(re.findall(r"\b[xy]\s+(in)\s*(?:[,;]|$)", plain))
    if len(found) > 1:
        raise UserMistake(f"{place}: '{heading[:30]}' names several units, {', '.join(found)}; write both columns in one")
    return found[0] if found else ""


def _check_order(heading, place):
    """Throws UserMistake where y is named before x."""
    names = [word for word in _words(heading) if word in ("x", "y")]
    if names[:2] == ["y", "x"]:
        raise UserMistake(f"{place}: '{heading[:30]}' has y before x; write x first")


def _row(text, place, before):
    """The numbers of a line, two or three; `before`: those of the line before. Throws UserMistake."""
    try:
        found = _numbers(text)
    except ValueError:
        found = ()
    two = len(words := text.split()) == 2 and not _decimal_commas(text) and any(re.fullmatch(DECIMAL, word) for word in words)
    if two or len(found) not in (2, 3) or not all(map(math.isfinite, found)):
        commas = "; with decimal commas put ; or a tab between x and y, as in 0,5; 1,0" if two or len(found) == 4 and text.count(",") > 1 else ""
        raise UserMistake(f"{place}: '{text[:30]}' is no point: write two finite numbers, x, y{commas}")
    if before and len(found) != len(before):
        raise UserMistake(f"{place}: '{text[:30]}' has {len(found)} numbers, the line before it {len(before)}; write two on each, x, y")
    return found


def _in_a_plane(rows, path):
    """Points x, y; a third number on each line has to be the same on all. Throws UserMistake."""
    third = {row[2] for row in rows if len(row) > 2}
    if len(third) > 1:
        raise UserMistake(f"{path}: it has three numbers on each line, and the third is no constant: it goes from {min(third):g} to {max(third):g}; "
                          "an outline lies in a plane, write two, x, y")
    return [row[:2] for row in rows]


NEAR = 0.05     # part of the extent of an airfoil that its two sides begin apart at most


def _once_around(points):
    """The points of an airfoil given as two sides from nose to tail, after a line with how many each has; None of other files."""
    upper, lower = (int(number) if number.is_integer() else 0 for number in points[0]) if points else (0, 0)
    if min(upper, lower) < FEWEST_CORNERS or len(points) != 1 + upper + lower:
        return None
    sides = points[1:1 + upper], points[1 + upper:]
    extent = max(math.dist(sides[0][0], point) for side in sides for point in side)
    return sides[0][::-1] + sides[1] if math.dist(sides[0][0], sides[1][0]) <= NEAR * extent else None


def _without_repeated(points):
    """Each point once where it stands several times in turn, the first one also at the end."""
    kept = [point for point, before in zip(points, [None, *points]) if point != before]
    return kept[:-1] if len(kept) > 1 and kept[0] == kept[-1] else kept


def read(path, straight=False):
    """The Outline in a file with x, y on each line; comments begin with #. The first line may be a title; it, or a comment before
    the points, may name the columns. An airfoil may be given by its two sides. `straight`: with edges between the points. Throws UserMistake with
    file:line."""
    path = Path(path)
    try:
        lines = path.read_text(encoding="utf-8-sig").splitlines()    # some editors begin a text with a byte-order mark
    except (OSError, UnicodeDecodeError) as error:
        raise UserMistake(f"--outline {path}: cannot be read ({getattr(error, 'strerror', None) or 'it is no UTF-8 text'})") from None
    rows, unit, title, headings, first, changed = [], "", "", 0, True, False
    for number, line in enumerate(lines, 1):
        text, _, comment = (part.strip() for part in line.partition("#"))
        if not text:
            if not rows and _speaks_of_columns(comment):
                unit = unit or _unit(comment, f"{path}:{number}")
            continue
        is_first, first = first, False
        named = not rows and _names_columns(text)
        here = _unit(text, f"{path}:{number}") if named else ""
        unit = unit or here
        if is_first and _is_title(text) and not re.search(OF_COLUMN, text.lower()) and not {"x", "y"} <= set(_words(text)):
            title = f"line {number}, '{text[:60]}', is taken as a title"
        elif named:
            _check_order(text, f"{path}:{number}")
        else:
            rows.append(_row(text, f"{path}:{number}", rows[-1] if rows else ()))
            changed = changed or len(rows[-1]) > 2 or bool(_decimal_commas(text))
            continue
        headings += 1
    plane = _in_a_plane(rows, path)
    if sides := _once_around(plane):
        title = f"{f'{title}; ' if title else ''}it has the points of two sides, {plane[0][0]:g} and {plane[0][1]:g}"
    points = _without_repeated(sides or plane)
    fewest = FEWEST_CORNERS if straight else FEWEST
    if len(points) < fewest:
        raise UserMistake(f"{path}: an outline needs {fewest} points or more, x, y on each line; there are {len(points)}"
                          + ("" if straight else f" (--straight: {FEWEST_CORNERS} or more, as corners)"))
    outline = Outline(path, tuple(points), unit=unit, title=title, headings=headings, changed=bool(changed or sides or len(points) < len(plane) - (plane[0] == plane[-1])))
    if straight:
        outline = _without_points_within_edges(outline)
    if outline.size() <= 0:
        raise UserMistake(f"{path}: all points are the same")
    return outline


def scaled(outline, size):
    """The outline with its longer side `size` long, about the origin of its coordinates."""
    factor = size / outline.size()
    return replace(outline, path=None, points=tuple((factor * x, factor * y) for x, y in outline.points), radius=factor * outline.radius)


def in_metres(outline):
    """The outline with its numbers taken in the unit that its heading names."""
    factor = UNITS.get(outline.unit, 1.0)
    return outline if factor == 1.0 else scaled(outline, factor * outline.size())


def taken(outline, name):
    """What is said of the size it has."""
    x_low, x_high, y_low, y_high = outline.box()
    why = f"the numbers in {name} are in {outline.unit}, as its heading says: " if outline.unit else ""
    return f"{why}the outline is {x_high - x_low:.4g} x {y_high - y_low:.4g} m (--size makes its longer side another length)"


def is_block(outline):
    """Are its points the corners of a body with four sides, none of them hollow?"""
    points = outline.points
    turns = [(b[0] - a[0]) * (c[1] - b[1]) - (b[1] - a[1]) * (c[0] - b[0])
             for a, b, c in zip(points, points[1:] + points[:1], points[2:] + points[:2])]
    return len(points) == 4 and (min(turns) > 0 or max(turns) < 0)


def from_its_foot(outline):
    """The same corners, the two lowest of them, on which the body stands, at the ends. Throws UserMistake."""
    points, low = outline.points, outline.box()[2]
    near = 1e-9 * outline.size()
    for k in range(len(points)):
        turned = points[k:] + points[:k]
        if turned[0][1] - low <= near and turned[-1][1] - low <= near:
            return replace(outline, points=tuple((x, low if y - low <= near else y) for x, y in turned))
    raise UserMistake("--on-wall: the outline has no level edge at its lowest point on which it could stand")


def _edges(outline):
    """(dx, dy) from each point to the next."""
    points = outline.points
    return [(b[0] - a[0], b[1] - a[1]) for a, b in zip(points, points[1:] + points[:1])]


def _signed_turns(outline):
    """Angle by which the lines from point to point turn at each point, -pi to pi; counter-clockwise ones are positive."""
    edges = _edges(outline)
    return [math.atan2(a[0] * b[1] - a[1] * b[0], a[0] * b[0] + a[1] * b[1]) for a, b in zip(edges[-1:] + edges, edges)]


def turns(outline):
    """The same without their signs."""
    return [abs(turn) for turn in _signed_turns(outline)]


def largest_turn(outline):
    """[degree]"""
    return math.degrees(max(turns(outline)))


def _is_corner(before, turn, after):
    """Is a point meant as a corner, from how far the lines turn there and at its neighbours?"""
    return turn > math.radians(SHARP) or turn > math.radians(CLEAR) and min(before, after) < BESIDE * turn


def corners(outline):
    """(turn [degree] beyond which points are meant as corners, are some of these hollow); (None, False) where none are."""
    signed, found = _signed_turns(outline), turns(outline)
    meant = [_is_corner(*three) for three in zip(found[-1:] + found, found, found[1:] + found[:1])]
    least = min((turn for turn, is_corner in zip(found, meant) if is_corner), default=math.inf)
    most = max((turn for turn, is_corner in zip(found, meant) if not is_corner), default=0.0)
    if most < math.radians(SHARP) < least or least <= most:     # one turn tells them apart, or no turn does
        angle = SHARP
    else:
        angle = round(math.degrees(0.5 * (least + most)))
    around = math.copysign(1.0, sum(signed))
    taken = [turn * around for turn in signed if abs(turn) > math.radians(angle)]
    return (angle, any(turn < 0 for turn in taken)) if taken else (None, False)


def _without_points_within_edges(outline):
    """The corners alone; an outline of fewer than three stays."""
    kept = tuple(point for turn, point in zip(turns(outline), outline.points) if turn > 1e-6)
    return replace(outline, points=kept) if len(kept) >= FEWEST_CORNERS else outline


ROUND = 90              # [degree] in all, by SEVERAL points that turn by CLEAR at most: between its corners an outline is a smooth curve
SEVERAL = 6


def is_round(outline):
    """Is it a smooth curve between its corners, if it has any?"""
    slight = [turn for turn in turns(outline) if 1e-6 < turn <= math.radians(CLEAR)]
    return len(slight) >= SEVERAL and sum(slight) > math.radians(ROUND)


def shortest_edge(outline):
    return min(math.hypot(*edge) for edge in _edges(outline))


def rounded_away(outline, radius, foot=False):
    """(how far arcs of this radius stay behind the corner where they do most, that corner); `foot`: the first and the last one stay."""
    lost = [(radius * (1 / math.cos(0.5 * turn) - 1), point) for turn, point in zip(turns(outline), outline.points) if turn < math.pi]
    return max(lost[1:-1] if foot else lost)


def largest_radius(outline):
    """Of arcs at the corners that just fit: an arc takes radius * tan(turn / 2) of the edges on both of its sides."""
    taken = [math.tan(0.5 * turn) for turn in turns(outline)]
    return min((math.hypot(*edge) / (a + b) for edge, a, b in zip(_edges(outline), taken, taken[1:] + taken[:1]) if a + b > 0), default=0.0)
