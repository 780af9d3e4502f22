"""Random outlines in a gas, as the text of a case file, and how narrow they are: the same ones for a seed on every machine.

A shock of Mach 1.5 starts two grid spacings to the left of the leftmost body and meets it in the first steps.
"""

import math
import random
from dataclasses import dataclass

FACTOR = 2
H = 0.1 / FACTOR  # distance of the background's points
MACH = 1.5
BEHIND_SHOCK = 1 + 2 * 1.4 / 2.4 * (MACH**2 - 1)  # pressure there, in parts of that before it

HEAD = """title: "{title}"
parameters: {{gamma: 1.4, mach: {mach}, x_shock: {x_shock:.4f}, p_0: 1 / gamma,
  p_1: p_0 * (1 + 2 * gamma / (gamma + 1) * (mach^2 - 1)), rho_1: (gamma + 1) * mach^2 / ((gamma - 1) * mach^2 + 2),
  v_1: 2 / (gamma + 1) * (mach - 1 / mach)}}
grid: {{factor: {factor}}}
time: {{end: 1, multirate: true}}
fluid:
  gamma: gamma
  p_e: p_0
  grid: {{x: [-2, 2], y: [-2, 2]}}
  boundary: {{left: {{kind: inflow, state: {{rho: rho_1, v: [v_1, 0], p: p_1}}}}, right: outflow, bottom: slip_wall, top: slip_wall}}
  initial: {{rho: "x < x_shock ? rho_1 : 1", v: ["x < x_shock ? v_1 : 0", 0], p: "x < x_shock ? p_1 : p_0"}}
solids:
"""

SOLID = "  {name}:\n    law: {law}\n    rho: 10\n{stiffness}    shape: {shape}\n"
STIFFNESS = "    lambda: 50\n    mu: 50\n"
STANDING = "    boundary: {left: free, right: free, bottom: clamped, top: free}\n"


@dataclass
class Body:
    """A shape of the case file, and points along it (of a spline: those it goes through)."""

    shape: str
    points: list
    stands: bool = False
    has_corners: bool = False


@dataclass
class Case:
    """`thickness`, `gap` (between bodies or to a wall) and the sharpest `corner` [degrees]; infinite where there is none."""

    name: str
    kind: str
    text: str
    thickness: float
    gap: float
    corner: float

    def is_roomy(self):
        """Four spacings everywhere, and corners of 30 degrees at least."""
        return min(self.thickness, self.gap) >= 4 * H and self.corner >= 30


def listed(points):
    return "[" + ", ".join(f"[{x:.4f}, {y:.4f}]" for x, y in points) + "]"


def star_points(rng, count, radius, roughness, centre=(0, 0)):
    """Points around a centre, in order: no polygon through them crosses itself."""
    turn = rng.uniform(0, 2 * math.pi)
    angles = [turn + 2 * math.pi * (k + rng.uniform(-0.25, 0.25)) / count for k in range(count)]
    radii = [radius * rng.uniform(1 - roughness, 1) for _ in angles]
    return [(centre[0] + r * math.cos(a), centre[1] + r * math.sin(a)) for r, a in zip(radii, angles)]


def ellipse(centre, a, b, angle=0.0):
    """`angle` in degrees."""
    c, s = math.cos(math.radians(angle)), math.sin(math.radians(angle))
    turns = [2 * math.pi * k / 240 for k in range(240)]
    points = [(centre[0] + a * math.cos(t) * c - b * math.sin(t) * s, centre[1] + a * math.cos(t) * s + b * math.sin(t) * c) for t in turns]
    return Body(f"{{kind: ellipse, centre: [{centre[0]:.4f}, {centre[1]:.4f}], semi_axes: [{a:.4f}, {b:.4f}], angle: {angle:.1f}}}", points)


def spline_through(points):
    return Body(f"{{kind: spline, through: {listed(points)}}}", points)


def polygon_of(points):
    return Body(f"{{kind: polygon, corners: {listed(points)}}}", points, has_corners=True)


def spline(rng):
    return [spline_through(star_points(rng, rng.randint(4, 12), rng.uniform(0.4, 0.9), rng.uniform(0, 0.5)))]


def polygon(rng):
    return [polygon_of(star_points(rng, rng.randint(3, 7), rng.uniform(0.5, 0.9), rng.uniform(0, 0.6)))]


def thin(rng):
    """An ellipse or a bar, 2 to 50 times as long as it is thick."""
    half, ratio, angle = rng.uniform(0.4, 1), math.exp(rng.uniform(math.log(2), math.log(50))), rng.uniform(0, 180)
    if rng.random() < 0.5:
        return [ellipse((0, 0), half, half / ratio, angle)]
    c, s = math.cos(math.radians(angle)), math.sin(math.radians(angle))
    corners = [(half * x * c - half / ratio * y * s, half * x * s + half / ratio * y * c) for x, y in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
    return [polygon_of(corners)]


def narrow_distance(rng):
    """20 h to 2 h, small ones as often as large ones."""
    return H * math.exp(rng.uniform(math.log(2), math.log(20)))


def pair(rng):
    """Two ellipses one behind the other, or a spline behind an ellipse."""
    a, b, distance = rng.uniform(0.25, 0.5), rng.uniform(0.25, 0.5), narrow_distance(rng)
    left = -(a + b + distance) / 2 + a
    first = ellipse((left, 0), a, rng.uniform(0.3, 0.6))
    if rng.random() < 0.5:
        return [first, ellipse((left + a + distance + b, 0), b, rng.uniform(0.3, 0.6))]
    points = star_points(rng, rng.randint(5, 9), b, 0.3)
    shift = left + a + distance - min(x for x, _ in points)
    return [first, spline_through([(x + shift, y) for x, y in points])]


def near_wall(rng):
    a, b, distance = rng.uniform(0.2, 0.6), rng.uniform(0.2, 0.6), narrow_distance(rng)
    return [ellipse((0, -2 + distance + b), a, b)]


def standing(rng):
    """A polygon that stands on the lower wall."""
    width, height, lean = rng.uniform(0.3, 1), rng.uniform(0.3, 0.9), rng.uniform(-0.2, 0.2)
    top = width * rng.uniform(0.4, 1)
    corners = [(-width / 2, -2), (-top / 2 + lean, -2 + height), (top / 2 + lean, -2 + height), (width / 2, -2)]
    shape = f"{{kind: polygon, corners: {listed(corners)}, walls: [bottom, bottom]}}"
    return [Body(shape, corners, stands=True, has_corners=True)]


KINDS = (spline, polygon, thin, pair, near_wall, standing)


def edges_of(points):
    return list(zip(points, points[1:] + points[:1]))


def area_of(points):
    return 0.5 * sum(x1 * y2 - x2 * y1 for (x1, y1), (x2, y2) in edges_of(points))


def thickness_of(points):
    """The shortest way along a normal to an opposite edge: one that is parallel but for 30 degrees, so that corners do not count."""
    turn = 1 if area_of(points) > 0 else -1
    edges = edges_of(points)
    directions = [(x2 - x1, y2 - y1) for (x1, y1), (x2, y2) in edges]
    least = math.inf
    for ((x1, y1), _), (dx, dy) in zip(edges, directions):
        length = math.hypot(dx, dy)
        nx, ny = -turn * dy / length, turn * dx / length
        for part in (0.25, 0.5, 0.75):
            x, y = x1 + part * dx, y1 + part * dy
            for ((ax, ay), _), (ex, ey) in zip(edges, directions):
                across = nx * ey - ny * ex
                if dx * ex + dy * ey > -math.cos(math.radians(30)) * length * math.hypot(ex, ey) or across == 0:
                    continue
                way = ((ax - x) * ey - (ay - y) * ex) / across
                at = ((ax - x) * ny - (ay - y) * nx) / across
                if way > 1e-9 and 0 <= at <= 1:
                    least = min(least, way)
    return least


def sharpest_corner(points):
    """Smallest angle between two edges, inside or outside [degrees]."""
    sharpest = 180.0
    for k, (x, y) in enumerate(points):
        (ax, ay), (bx, by) = points[k - 1], points[(k + 1) % len(points)]
        angle = math.degrees(abs(math.atan2((ax - x) * (by - y) - (ay - y) * (bx - x), (ax - x) * (bx - x) + (ay - y) * (by - y))))
        sharpest = min(sharpest, angle)
    return sharpest


def gap_of(bodies):
    """Between two bodies, or between one that does not stand on it and the lower wall."""
    if len(bodies) == 2:
        return min(math.dist(p, q) for p in bodies[0].points for q in bodies[1].points)
    return math.inf if bodies[0].stands else min(y for _, y in bodies[0].points) + 2


def case(seed, number):
    """Case `number` of a seed."""
    rng = random.Random(f"{seed}/{number}")
    kind = KINDS[number % len(KINDS)]
    bodies = kind(rng)
    x_shock = min(x for body in bodies for x, _ in body.points) - 2 * H
    title = f"random outline {number} of seed {seed}: {kind.__name__}"
    text = HEAD.format(title=title, mach=MACH, x_shock=x_shock, factor=FACTOR)
    for k, body in enumerate(bodies):
        law = rng.choice(("rigid", "neo_hookean", "saint_venant_kirchhoff"))
        if body.stands and law == "rigid":  # it would be torn off its wall
            law = "neo_hookean"
        text += SOLID.format(name=f"body_{k}", law=law, stiffness="" if law == "rigid" else STIFFNESS, shape=body.shape)
        text += STANDING if body.stands else ""
    return Case(name=f"{kind.__name__}_{number}", kind=kind.__name__, text=text,
                thickness=min(thickness_of(body.points) for body in bodies), gap=gap_of(bodies),
                corner=min((sharpest_corner(body.points) for body in bodies if body.has_corners), default=180.0))
