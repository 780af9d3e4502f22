"""The study of panel flutter for docs/record_results.py: growth and frequency of a hinged plate beside a stream, and piston theory."""

import csv

import numpy as np

LAMBDAS = ("310", "330", "350", "377", "400")
FACTORS = (2, 4, 8)
MACH, MASS_RATIO = 3.0, 0.01    # of the case, with rho = a_0 = a = 1


def _most(found):
    """The eigenvalue that grows most; of those that decay alike, as the first two modes below the onset, the slower one."""
    alike = found[found.real > found.real.max() - 1e-3]
    return alike[np.abs(alike.imag).argmin()]


def theory(lam, damping=True, modes=12):
    """The eigenvalue s of w = exp(s t) that grows most, by piston theory: Galerkin's method with sines."""
    beta, mass = np.sqrt(MACH**2 - 1), 1 / MASS_RATIO
    n = np.arange(1, modes + 1)
    odd = (n[:, None] + n) % 2 == 1
    slope = np.where(odd, 4 * np.outer(n, n) / np.where(odd, n[:, None]**2 - n**2, 1), 0)
    stiffness = np.diag(MACH**2 / (beta * lam) * (n * np.pi)**4) + MACH**2 / beta * slope
    resistance = MACH / beta * (MACH**2 - 2) / (MACH**2 - 1) * damping * np.eye(modes)
    zero, one = np.zeros((modes, modes)), np.eye(modes)
    found = np.linalg.eigvals(np.block([[zero, one], [-stiffness / mass, -resistance / mass]]))
    slow = found[np.abs(found.imag) < 1]    # of the first two modes, which meet
    return _most(slow)


def measured(directory, begin=10.0, every=1.0, exponentials=4):
    """The same of a run, from the displacement of its probe: the sum of exponentials that fits it (matrix pencil)."""
    with open(directory / "probes.csv", encoding="utf-8", newline="") as file:
        heading, *rows = csv.reader(file)
    column = next(k for k, title in enumerate(heading) if title.startswith("panel.u2"))
    t, u = np.array([[float(row[0]), float(row[column])] for row in rows]).T
    samples = np.interp(np.arange(begin, t[-1], every), t, u)
    width = len(samples) // 3
    pencil = np.array([samples[k:k + width + 1] for k in range(len(samples) - width)])
    basis = np.linalg.svd(pencil, full_matrices=False)[2][:exponentials].T
    found = np.log(np.linalg.eigvals(np.linalg.pinv(basis[:-1]) @ basis[1:]).astype(complex)) / every
    return _most(found)


def onset(growths):
    """lambda at which the growth, linear between those below and above it, becomes positive."""
    lams = [float(lam) for lam in LAMBDAS]
    for a, b, below, above in zip(lams, lams[1:], growths, growths[1:]):
        if below < 0 <= above:
            return a, b
    return None


def _shown(s):
    return f"{s.real:+.4f} {abs(s.imag):.4f}"


def _growths(tools):
    rows, found, typed = [], {}, ""
    for lam in LAMBDAS:
        row = [lam, _shown(theory(float(lam)))]
        for factor in FACTORS:
            directory, _, typed = tools.run_once(f"flutter-{lam}-{factor}", "panel_flutter",
                                                 [f"grid.factor={factor}", f"parameters.lambda={lam}"])
            found[factor, lam] = measured(directory)
            row.append(_shown(found[factor, lam]))
        rows.append(row)
    brackets = []
    for factor in FACTORS:
        between = onset([found[factor, lam].real for lam in LAMBDAS])
        brackets.append(f"{between[0]:g} .. {between[1]:g}" if between else "-")
    rows.append(["onset", "343.66", *brackets])
    heading = ["lambda", "piston theory", *(f"h = 1/{10 * factor}" for factor in FACTORS)]
    table = "\n".join(["| " + " | ".join(heading) + " |", "|" + "---|" * len(heading), *("| " + " | ".join(row) + " |" for row in rows)])
    return f"last run: `{typed}`\n\nGrowth and angular frequency of the mode that grows most or decays least, per unit of time a / a_0:\n\n{table}\n"


def studies(tools):
    """(title, function) of each study; `tools`: the functions of record_results."""
    yield "Panel flutter, growth above and below the onset", lambda: _growths(tools)
