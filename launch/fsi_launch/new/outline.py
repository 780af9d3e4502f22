"""The outline of the body in a new case: a circle, or points from a file."""

import math
import re
from dataclasses import dataclass
from pathlib import Path

from fsi_launch.failure import UserMistake

FEWEST = 4              # points of a smooth curve
FEWEST_CORNERS = 3      # of straight edges
SHARP = 100             # [degree] turns beyond those of a square are meant as corners
CLEAR = 45              # [degree] so are these, where the points on one side of them turn by less than BESIDE of it: a blunt tail
BESIDE = 0.1


@dataclass(frozen=True)
class Outline:
    """Points (x, y) of a closed outline in their order, or a circle about the origin where there are none."""

    path: Path = None
    points: tuple = ()
    radius: float = 0.0

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


def _numbers(line):
    return tuple(float(word) for word in re.split(r"[,;\s]+", line.strip()) if word)


def _names_columns(text):
    """Words, and no number among them."""
    for word in re.split(r"[,;\s]+", text):
        try:
            float(word.strip("\"'"))
            return False
        except ValueError:
            pass
    return True


def read(path, straight=False):
    """The Outline in a file with x, y on each line; comments begin with #, and the first line may name the columns. `straight`: with
    edges between the points. Throws UserMistake with file:line."""
    path = Path(path)
    try:
        lines = path.read_text(encoding="utf-8-sig").splitlines()    # some editors begin a text with a byte-order mark
    except (OSError, UnicodeDecodeError) as error:
        raise UserMistake(f"--outline {path}: cannot be read ({getattr(error, 'strerror', None) or 'it is no UTF-8 text'})") from None
    points = []
    for number, line in enumerate(lines, 1):
        text = line.split("#")[0].strip()
        if not text or (not points and _names_columns(text)):
            continue
        try:
            x, y = _numbers(text)
            if not (math.isfinite(x) and math.isfinite(y)):
                raise ValueError
        except ValueError:
            raise UserMistake(f"{path}:{number}: '{text[:30]}' is no point: write two finite numbers, x, y") from None
        points.append((x, y))
    if len(points) > 1 and points[0] == points[-1]:
        points.pop()
    fewest = FEWEST_CORNERS if straight else FEWEST
    if len(points) < fewest:
        raise UserMistake(f"{path}: an outline needs {fewest} points or more, x, y on each line; there are {len(points)}"
                          + ("" if straight else f" (--straight: {FEWEST_CORNERS} or more, as corners)"))
    outline = Outline(path, tuple(points))
    if outline.size() <= 0:
        raise UserMistake(f"{path}: all points are the same")
    return outline


def scaled(outline, size):
    """The outline with its longer side `size` long, about the origin of its coordinates."""
    factor = size / outline.size()
    return Outline(None, tuple((factor * x, factor * y) for x, y in outline.points), factor * outline.radius)


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
            return Outline(outline.path, tuple((x, low if y - low <= near else y) for x, y in turned), outline.radius)
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
