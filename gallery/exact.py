#!/usr/bin/python3
"""Writes the data files of the problems that have exact solutions: gallery/NAME/data.csv and the numbers it prints.

Each solution is found here from the equations themselves, by root finding or fine integration, without any code of the solvers."""

import csv
import math
from pathlib import Path

FOLDER = Path(__file__).resolve().parent
GAMMA = 1.4


def write(name, heading, rows, about):
    with open(FOLDER / name / "data.csv", "w", encoding="utf-8", newline="") as file:
        file.write(f"# {about}\n")
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(heading)
        writer.writerows([[f"{value:.9g}" for value in row] for row in rows])


def bisect(function, low, high):
    """Where a function changes its sign."""
    sign = function(low) > 0
    for _ in range(60):
        middle = 0.5 * (low + high)
        if (function(middle) > 0) == sign:
            low = middle
        else:
            high = middle
    return 0.5 * (low + high)


def runge_kutta(slopes, state, t_0, t_1, steps):
    """[(t, state)] of a system of ordinary differential equations."""
    h, found = (t_1 - t_0) / steps, [(t_0, state)]
    for k in range(steps):
        t = t_0 + k * h
        def shifted(by, slope):
            return [x + by * s for x, s in zip(state, slope)]
        a = slopes(t, state)
        b = slopes(t + h / 2, shifted(h / 2, a))
        c = slopes(t + h / 2, shifted(h / 2, b))
        d = slopes(t + h, shifted(h, c))
        state = [x + h / 6 * (i + 2 * j + 2 * k + m) for x, i, j, k, m in zip(state, a, b, c, d)]
        found.append((t + h, state))
    return found


# --- gas dynamics


def velocity_change(p, rho_k, p_k):
    """By how much a wave that raises the pressure from p_k to p changes the velocity: a shock (Rankine-Hugoniot) or a rarefaction."""
    if p > p_k:     # mass flux j with j^2 = (p - p_k) / (1/rho_k - 1/rho), and rho by the Hugoniot curve
        rho = rho_k * ((GAMMA + 1) * p + (GAMMA - 1) * p_k) / ((GAMMA - 1) * p + (GAMMA + 1) * p_k)
        return math.sqrt((p - p_k) * (1 / rho_k - 1 / rho))
    a_k = math.sqrt(GAMMA * p_k / rho_k)
    return 2 * a_k / (GAMMA - 1) * ((p / p_k) ** ((GAMMA - 1) / (2 * GAMMA)) - 1)


def sod():
    left, right, t, x_0 = (1.0, 0.0, 1.0), (0.125, 0.0, 0.1), 0.2, 0.5
    p = bisect(lambda p: velocity_change(p, left[0], left[2]) + velocity_change(p, right[0], right[2]), 0.1, 1.0)
    v = velocity_change(p, right[0], right[2])
    rho_right = right[0] * ((GAMMA + 1) * p + (GAMMA - 1) * right[2]) / ((GAMMA - 1) * p + (GAMMA + 1) * right[2])
    rho_left = left[0] * (p / left[2]) ** (1 / GAMMA)
    shock = v / (1 - right[0] / rho_right)   # mass through the shock is the same on both sides
    a_left, a_star = math.sqrt(GAMMA * left[2] / left[0]), math.sqrt(GAMMA * p / rho_left)

    def state(x):
        s = (x - x_0) / t
        if s < -a_left:
            return left
        if s < v - a_star:     # v + 2 a / (gamma - 1) and the entropy are those of the left, and v - a = s
            a = (2 * a_left - (GAMMA - 1) * s) / (GAMMA + 1)
            rho = left[0] * (a / a_left) ** (2 / (GAMMA - 1))
            return rho, s + a, a * a * rho / GAMMA
        return (rho_left, v, p) if s < v else (rho_right, v, p) if s < shock else right

    write("sod", ("x", "rho", "v", "p"), [(x, *state(x)) for x in (k / 1000 for k in range(1001))],
          "exact solution of Sod's Riemann problem at t = 0.2")
    print(f"sod: p = {p:.6f}, v = {v:.6f}, rho = {rho_left:.6f} and {rho_right:.6f}, shock at x = {x_0 + shock * t:.6f}")


def vortex():
    """Pressure over the distance from the centre: the pressure gradient holds the gas on its circle, dp/dr = rho v^2 / r, at constant
    entropy, integrated from afar."""
    strength, radius, most = 0.3, 0.2, 8.0

    def slope(r, p):
        rho = (GAMMA * p) ** (1 / GAMMA)     # of the gas afar: rho = 1, p = 1 / gamma
        swirl = strength * (r / radius) * math.exp(0.5 * (1 - (r / radius) ** 2))
        return rho * swirl ** 2 / r if r > 0 else 0.0

    found = runge_kutta(lambda s, state: [-slope(most * radius - s, state[0])], [1 / GAMMA], 0.0, most * radius, 3200)
    rows = sorted((most * radius - s, p) for s, (p,) in found)
    write("vortex", ("r", "p"), rows[::8], "pressure over the distance from the centre of the vortex, by integration of dp/dr = rho v^2 / r")


def oblique(mach, turn):
    """Ratio of the pressures over the weaker of the oblique shocks that turn a stream by an angle."""
    def turned(angle):
        return math.atan(2 / math.tan(angle) * (mach ** 2 * math.sin(angle) ** 2 - 1) / (mach ** 2 * (GAMMA + math.cos(2 * angle)) + 2))
    least = math.asin(1 / mach)
    strongest = max((least + (math.pi / 2 - least) * k / 5000 for k in range(5001)), key=turned)
    angle = bisect(lambda angle: turned(angle) - turn, least, strongest)
    return 1 + 2 * GAMMA / (GAMMA + 1) * ((mach * math.sin(angle)) ** 2 - 1)


def cylinder_in_shock():
    """A shock of Mach 2 meets the wall of a cylinder: where it does, it is reflected as from a plane wall with the slope that the
    cylinder has there. Seen from the point where it meets the wall, the gas ahead comes along the wall, and the reflected shock
    turns it back along the wall."""
    mach = 2.0
    p_1 = 1 + 2 * GAMMA / (GAMMA + 1) * (mach ** 2 - 1)
    rho_1 = (GAMMA + 1) * mach ** 2 / ((GAMMA - 1) * mach ** 2 + 2)
    found = [p_1 * ((3 * GAMMA - 1) * p_1 - (GAMMA - 1)) / ((GAMMA - 1) * p_1 + GAMMA + 1)]      # at the front the wall is across
    for degrees in (10, 20, 30):
        along = mach / math.tan(math.radians(degrees))      # of the gas ahead, along the shock
        turn = math.atan2(along, mach / rho_1) - math.atan2(along, mach)
        found.append(p_1 * oblique(math.hypot(along, mach / rho_1) / math.sqrt(p_1 / rho_1), turn))
    print("cylinder_in_shock: p = " + ", ".join(f"{p / GAMMA:.4f}" for p in found) + " at 0, 10, 20 and 30 degrees")


# --- gas and solid


def elastic_piston():
    """The path F = -t^4/16 is given; the gas follows by a simple wave from rest, p = 1/gamma, a = 1."""
    rows = []
    for k in range(201):
        t = 0.8 * k / 200
        v = -0.25 * t ** 3
        p = (1 + 0.5 * (GAMMA - 1) * v) ** (2 * GAMMA / (GAMMA - 1)) / GAMMA
        rows.append((t, -0.0625 * t ** 4, v, 1 / GAMMA - p))
    write("elastic_piston", ("t", "x", "v", "stress"), rows, "path and velocity of the interface, stress of the solid there: p_e - p")


def shock_on_solid():
    """A shock of Mach 2 hits a linear elastic solid, rho = 10, lambda = mu = 40: p - p_e = z_p |v| there, a wave of the gas comes back."""
    mach, z = 2.0, math.sqrt(10.0 * 120.0)
    p_0 = 1 / GAMMA
    p_1 = bisect(lambda p: velocity_change(p, 1.0, p_0) - 2 / (GAMMA + 1) * (mach - 1 / mach), p_0, 100 * p_0)
    rho_1 = ((GAMMA + 1) * p_1 + (GAMMA - 1) * p_0) / ((GAMMA - 1) * p_1 + (GAMMA + 1) * p_0)
    v_1 = velocity_change(p_1, 1.0, p_0)
    p = bisect(lambda p: v_1 - velocity_change(p, rho_1, p_1) - (p - p_0) / z, p_0, 100 * p_0)
    v, arrival = -(p - p_0) / z, 0.1 / mach
    write("shock_on_solid", ("t", "v", "u"), [(t, v if t > arrival else 0.0, v * max(0.0, t - arrival)) for t in (k / 2000 for k in range(501))],
          "velocity and displacement of the end of the solid")
    print(f"shock_on_solid: v = {v:.8f}, stress = {-(p - p_0):.8f}")


def plate():
    """m v' = -2 p(t) - v with the pulse p = sin^4(pi (t - 0.1) / 0.6) between 0.1 and 0.7; rho = a = m = 1."""
    def pulse(t):
        return math.sin(math.pi * (t - 0.1) / 0.6) ** 4 if 0.1 < t < 0.7 else 0.0
    found = runge_kutta(lambda t, state: [-2 * pulse(t) - state[0]], [0.0], 0.0, 1.0, 2000)
    write("plate", ("t", "v"), [(t, v) for t, (v,) in found[::10]], "velocity of the plate over the size of the pulse")


def elastica():
    """A cantilever under an even dead load across, q E I / L^3, bent without stretching or shear: theta'' = -q (1 - s) cos theta, found by
    shooting; theta is the turning of the line, x across and y along the beam at rest. The load grows so slowly that nothing swings."""
    def tip(q):
        def line(curvature):
            return runge_kutta(lambda s, state: [state[1], -q * (1 - s) * math.cos(state[0]), math.sin(state[0]), math.cos(state[0])],
                               [0.0, curvature, 0.0, 0.0], 0.0, 1.0, 100)[-1][1]
        theta, _, x, y = line(bisect(lambda curvature: line(curvature)[1], 0.0, 4.0))     # no moment at the free end
        return x, y - 1, -theta

    def load(t):
        return 5 * (t / 10 - math.sin(0.2 * math.pi * t) / (2 * math.pi))

    write("elastica", ("t", "u1", "u2", "theta"), [(t, *tip(load(t))) for t in (0.5 * k for k in range(21))],
          "tip of a cantilever while an even dead load grows to 5 E I / L^3: displacements and angle")
    print("elastica: tip u = ({:.6f}, {:.6f}), turned by {:.6f}".format(*tip(5.0)))


def panel_flutter():
    """A hinged plate beside a stream of Mach 3 by piston theory with its damping, eight sines by Galerkin's method (a = rho = a_0 = 1,
    d = 0.01, rho a / (rho_s d) = 0.01, lambda = 377): m w_tt + D w_xxxx = -rho U^2 / beta (w_x + (M^2 - 2) / (M^2 - 1) w_t / U)."""
    mach, ratio, lam, modes, pluck = 3.0, 0.01, 377.0, 8, 1e-8
    beta = math.sqrt(mach ** 2 - 1)
    mass, bending, push = 1 / ratio, mach ** 2 / (beta * lam), mach ** 2 / beta
    damping = push * (mach ** 2 - 2) / (mach ** 2 - 1) / mach
    numbers = range(1, modes + 1)
    # twice the integrals of sin(n pi x) d/dx sin(l pi x)
    slope = [[4 * n * l / (n * n - l * l) if (n + l) % 2 else 0.0 for l in numbers] for n in numbers]

    def rates(t, state):
        q, v = state[:modes], state[modes:]
        force = [-bending * (n * math.pi) ** 4 * q[n - 1] - push * sum(c * x for c, x in zip(slope[n - 1], q)) - damping * v[n - 1]
                 for n in numbers]
        return [*v, *(f / mass for f in force)]

    start = [0.0] * modes + [pluck, 0.5 * pluck] + [0.0] * (modes - 2)
    found = runge_kutta(rates, start, 0.0, 100.0, 4000)
    write("panel_flutter", ("t", "w"),
          [(t, sum(state[n - 1] * math.sin(0.75 * n * math.pi) for n in numbers)) for t, state in found[::10]],
          "displacement at three quarters of a hinged plate, a tenth above the onset of flutter, by piston theory")


if __name__ == "__main__":
    for solution in (sod, vortex, cylinder_in_shock, elastic_piston, shock_on_solid, plate, elastica, panel_flutter):
        solution()
