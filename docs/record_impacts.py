"""The studies of record_results.py about plane shocks on solids, against the exact gas-solid Riemann problem."""

import csv
import math

GAMMA = 1.4
P_0 = 1 / GAMMA     # of the gas at rest, rho = a = 1, in which the solids are free of stress
MACHS = (1.1, 1.3, 1.5, 2)
FACTORS = (4, 8, 16, 32)
SOLIDS = ((0.1, "light"), (10, "heavy"))
LAWS = ("linear_elastic", "saint_venant_kirchhoff", "neo_hookean")


# --- the exact solution: the velocity and the pressure at which the waves of both sides meet


def stress(law, modulus, stretch):
    """P11 of a uniaxial stretch for lambda = mu = modulus."""
    if law == "linear_elastic":
        return 3 * modulus * (stretch - 1)
    if law == "saint_venant_kirchhoff":
        return 1.5 * modulus * (stretch**3 - stretch)
    return modulus * (stretch - 1 / stretch + math.log(stretch) / stretch)


def velocity_of_solid(law, modulus, rho_bar, stretch):
    """That behind the wave which compresses a solid at rest. Saint Venant-Kirchhoff grows softer: a fan, the integral of the
    wave speed sqrt(modulus (9 F^2 - 3) / 2 / rho_bar); the others do not: a discontinuity."""
    if law != "saint_venant_kirchhoff":
        return -math.sqrt(stress(law, modulus, stretch) * (stretch - 1) / rho_bar)
    speed = lambda f: math.sqrt(max(1.5 * modulus * (3 * f * f - 1), 0) / rho_bar)
    n = 2000
    step = (1 - stretch) / n
    return -step * sum(speed(stretch + (k + 0.5) * step) for k in range(n))


def behind_shock(mach):
    """(rho, v, p) behind the shock."""
    g = GAMMA
    return ((g + 1) * mach**2 / ((g - 1) * mach**2 + 2), -2 / (g + 1) * (mach - 1 / mach),
            (1 + 2 * g / (g + 1) * (mach**2 - 1)) / g)


def velocity_of_gas(mach, pressure):
    """That behind the wave which brings the gas behind the shock to this pressure."""
    rho, v, p = behind_shock(mach)
    g = GAMMA
    if pressure > p:
        return v + (pressure - p) * math.sqrt(2 / ((g + 1) * rho) / (pressure + (g - 1) / (g + 1) * p))
    return v + 2 / (g - 1) * math.sqrt(g * p / rho) * ((pressure / p) ** ((g - 1) / (2 * g)) - 1)


def impact(law, rho_bar, mach):
    """(velocity, pressure) of the interface, or None where the solid bears no such pressure and stays hyperbolic."""
    modulus = 4 * rho_bar

    def excess(stretch):
        return (velocity_of_solid(law, modulus, rho_bar, stretch)
                - velocity_of_gas(mach, P_0 - stress(law, modulus, stretch)))

    low, high = 1 / math.sqrt(3) if law == "saint_venant_kirchhoff" else 1e-6, 1.0
    if excess(low) > 0:
        return None
    for _ in range(60):
        middle = 0.5 * (low + high)
        low, high = (low, middle) if excess(middle) > 0 else (middle, high)
    return velocity_of_solid(law, modulus, rho_bar, high), P_0 - stress(law, modulus, high)


# --- the runs


def at_the_end(directory):
    """(velocity, pressure) of the solid's end at the last time, from the probe."""
    with open(directory / "probes.csv", encoding="utf-8") as file:
        last = list(csv.DictReader(file))[-1]
    return float(last["tip.v1"]), P_0 - float(last["tip.P11"])


COMMANDS = []  # as typed, of the runs made


def _cell(tools, law, rho_bar, mach, factor):
    settings = [f"parameters.rho_bar={rho_bar}", f"parameters.mach={mach}", f"grid.factor={factor}", "time.peer_timeout=60"]
    directory, _, command = tools.run_once(f"impact-{law}-{rho_bar}-{mach}-{factor}", "shock_on_solid", settings,
                                           [f"solid={law}"])
    COMMANDS.append(command)
    found = tools.summary_of(directory)
    exact = impact(law, rho_bar, mach)
    if found.get("status") != "completed":
        return f"t = {found.get('t', 0):.3f}" + ("" if exact else ": " + found.get("reason", "").split(": ")[-1])
    velocity, pressure = at_the_end(directory)
    noise = tools.value_at(found, "noise.value") or 0
    errors = f"{velocity - exact[0]:.1e}, {pressure - exact[1]:.1e}" if exact else "no solution"
    return errors + (f", noise {100 * noise:.1g} %" if noise > 0.03 else "")


def impacts(tools):
    """Errors of v and p at the interface 0.2 after the impact; the time of the end of runs that broke."""
    rows = []
    for rho_bar, weight in SOLIDS:
        for law in LAWS:
            for mach in MACHS:
                exact = impact(law, rho_bar, mach)
                rows.append([weight, law, f"{mach}", *(f"{value:.4f}" for value in exact or ()), *([] if exact else ["none", "none"]),
                             *(_cell(tools, law, rho_bar, mach, factor) for factor in FACTORS)])
    heading = ["solid", "law", "Mach", "v exact", "p exact", *(f"h = 1/{10 * factor}" for factor in FACTORS)]
    return "\n".join([f"last: `{COMMANDS[-1]}`", "",
                      "Errors of v and p at the interface 0.2 after the impact; where a run broke, when and why.", "",
                      "| " + " | ".join(heading) + " |", "|" + "---|" * len(heading),
                      *("| " + " | ".join(row) + " |" for row in rows)]) + "\n"


def studies(tools):
    yield "Plane shocks on solids between slip walls", lambda: impacts(tools)
