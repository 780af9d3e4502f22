"""Random outlines in a gas, as the text of a case file: the same ones for a seed on every machine."""

import math
import random

HEAD = """title: "{title}"
parameters: {{gamma: 1.4, mach: 1.5, x_shock: {x_shock}, p_0: 1 / gamma,
  p_1: p_0 * (1 + 2 * gamma / (gamma + 1) * (mach^2 - 1)), rho_1: (gamma + 1) * mach^2 / ((gamma - 1) * mach^2 + 2),
  v_1: 2 / (gamma + 1) * (mach - 1 / mach)}}
grid: {{factor: {factor}}}
time: {{end: {end}, multirate: true}}
fluid:
  gamma: gamma
  p_e: p_0
  grid: {{x: [-2, 2], y: [-2, 2]}}
  boundary: {{left: {{kind: inflow, state: {{rho: rho_1, v: [v_1, 0], p: p_1}}}}, right: outflow, bottom: slip_wall, top: slip_wall}}
  initial: {{rho: "x < x_shock ? rho_1 : 1", v: ["x < x_shock ? v_1 : 0", 0], p: "x < x_shock ? p_1 : p_0"}}
solids:
"""

SOLID = """  {name}:
    law: neo_hookean
    rho: 10
    lambda: 50
    mu: 50
    shape: {shape}
"""

STANDING = "    boundary: {left: free, right: free, bottom: clamped, top: free}\n"


def listed(points):
    return "[" + ", ".join(f"[{x:.4f}, {y:.4f}]" for x, y in points) + "]"


def star_points(rng, count, radius, roughness, centre=(0, 0)):
    """Points around a centre, in order: no outline through them crosses itself."""
    turn = rng.uniform(0, 2 * math.pi)
    angles = [turn + 2 * math.pi * (k + rng.uniform(-0.25, 0.25)) / count for k in range(count)]
    radii = [radius * rng.uniform(1 - roughness, 1) for _ in angles]
    return [(centre[0] + r * math.cos(a), centre[1] + r * math.sin(a)) for r, a in zip(radii, angles)]


def spline(rng):
    points = star_points(rng, rng.randint(4, 12), rng.uniform(0.4, 0.9), rng.uniform(0, 0.5))
    return [f"{{kind: spline, through: {listed(points)}}}"], False


def polygon(rng):
    points = star_points(rng, rng.randint(3, 7), rng.uniform(0.5, 0.9), rng.uniform(0, 0.4))
    return [f"{{kind: polygon, corners: {listed(points)}}}"], False


def thin(rng):
    return [f"{{kind: ellipse, semi_axes: [{rng.uniform(0.5, 1):.3f}, {rng.uniform(0.1, 0.25):.3f}], "
            f"angle: {rng.uniform(0, 180):.1f}}}"], False


def pair(rng):
    """Two ellipses, their distance along x from 20 h to 2 h."""
    h, a, b = 0.05, rng.uniform(0.25, 0.5), rng.uniform(0.25, 0.5)
    distance = h * math.exp(rng.uniform(math.log(2), math.log(20)))
    left = -(a + b + distance) / 2 + a - 0.1
    right = left + a + distance + b
    return [f"{{kind: ellipse, centre: [{left:.4f}, 0], semi_axes: [{a:.4f}, {rng.uniform(0.3, 0.6):.4f}]}}",
            f"{{kind: ellipse, centre: [{right:.4f}, 0], semi_axes: [{b:.4f}, {rng.uniform(0.3, 0.6):.4f}]}}"], False


def near_wall(rng):
    radius, h = rng.uniform(0.2, 0.6), 0.05
    distance = h * math.exp(rng.uniform(math.log(2), math.log(20)))
    return [f"{{kind: circle, centre: [0, {-2 + distance + radius:.4f}], radius: {radius:.4f}}}"], False


def standing(rng):
    """A polygon that stands on the lower wall."""
    width, height, lean = rng.uniform(0.3, 1), rng.uniform(0.3, 0.9), rng.uniform(-0.2, 0.2)
    top = width * rng.uniform(0.4, 1)
    corners = [(-width / 2, -2), (-top / 2 + lean, -2 + height), (top / 2 + lean, -2 + height), (width / 2, -2)]
    return [f"{{kind: polygon, corners: {listed(corners)}, walls: [bottom, bottom]}}"], True


KINDS = (spline, polygon, thin, pair, near_wall, standing)


def case(seed, number, factor=2, end=1.0):
    """Name and text of case `number` of a seed."""
    rng = random.Random(f"{seed}/{number}")
    kind = KINDS[number % len(KINDS)]
    shapes, stands = kind(rng)
    text = HEAD.format(title=f"random outline {number} of seed {seed}: {kind.__name__}", x_shock=-1.2, factor=factor, end=end)
    for k, shape in enumerate(shapes):
        text += SOLID.format(name=f"body_{k}", shape=shape) + (STANDING if stands else "")
    return f"{kind.__name__}_{number}", text
