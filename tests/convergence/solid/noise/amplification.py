#!/usr/bin/python3
"""Largest amplification of a wave in one step of the solid's scheme, from its symbol: amplification.py

The 8 x 8 matrix G of a whole step (sweep, paper eqs. (39) to (41)) in a uniformly strained neo-Hookean body, for waves of all directions,
with upwinding of the stress as in paper eq. (36) and softened as in docs/theory_solid.md, *Solids under pressure*. Written from the
equations with numpy, apart from the solver; `Eq36StressUpwinding` and `RoundOffNoise` are about what the programs do.
"""

import numpy as np

CELLS = (1, 4, 8)                   # height over width
BETAS = ((0.5, 0.5, 0.2), (0.1, 0.1, 0.5), (1, 1, 0.2), (0.5, 0.5, 0))     # beta^P, beta^u, beta^r
STIFFNESSES = (1, 4, 49)            # lambda over mu
STATES = {"at rest": ((1, 0), (0, 1)), "stretched by 1.3": ((1.3, 0), (0, 1)), "sheared by 0.4": ((1, 0.4), (0, 1)),
          "pressed to 0.95": ((0.95, 0), (0, 0.95)), "pressed to 0.7": ((0.7, 0), (0, 0.7)), "pressed to 0.5 along x": ((0.5, 0), (0, 1)),
          "pressed and sheared": ((0.7, 0.3), (0, 0.9)), "pulled to 1.1": ((1.1, 0), (0, 1.1))}
CFL, WAVES, MEAN_SHARE, WITHOUT_RELAXATION = 0.9, 9, 0.8, 1e-4


def stiffness(F, lam, mu=1.0):
    """K[i, j, k, l] = d2 psi / dF_ij dF_kl of the neo-Hookean law."""
    inverse, identity = np.linalg.inv(F), np.eye(2)
    return (mu * np.einsum("ik,jl->ijkl", identity, identity) + lam * np.einsum("ji,lk->ijkl", inverse, inverse)
            + (mu - lam * np.log(np.linalg.det(F))) * np.einsum("jk,li->ijkl", inverse, inverse))


def root(A):
    """The positive root of a positive 2 x 2 matrix."""
    d = np.sqrt(np.linalg.det(A))
    return (A + d * np.eye(2)) / np.sqrt(np.trace(A) + 2 * d)


class Body:
    """A strained body with rho = 1 and cells of width 1 and height `height`."""

    def __init__(self, F, lam, height):
        self.K, self.per = stiffness(np.array(F, float), lam), (1.0, 1.0 / height)
        self.A = [self.K[:, a, :, a] for a in range(2)]
        self.Z = [root(A) if np.linalg.eigvalsh(A)[0] > 0 else None for A in self.A]

    def carries_waves(self):
        return all(Z is not None for Z in self.Z)

    def rates(self):
        """c_p |grad r| along both directions."""
        return [np.sqrt(np.linalg.eigvalsh(A)[1]) * per for A, per in zip(self.A, self.per)]

    def coupling(self):
        inner = np.linalg.inv(self.Z[0]) @ self.K[:, 0, :, 1] @ np.linalg.inv(self.Z[1])
        return np.linalg.norm(inner, 2) ** 2

    def largest_decay(self):
        """The largest eigenvalue of M, bounded as the solver does."""
        N = self.per[0] * self.per[1] * self.K[:, 0, :, 1]
        Z = [Z * per for Z, per in zip(self.Z, self.per)]
        shared = np.trace(np.linalg.solve(Z[0], N) @ np.linalg.solve(Z[1], N.T))
        a, b = self.rates()
        return 0.5 * (a + b + np.sqrt((a - b) ** 2 + 4 * shared))


def time_step(body, share, betas):
    P, u, r = betas
    sum_of_rates, beta = sum(body.rates()), max(P + r, u) / 2
    decay = share * body.largest_decay() + (1 - share) * sum_of_rates
    return min(CFL * np.sqrt(1 - beta ** 2) / sum_of_rates, (2 - r - 0.5 * P) / (2 * decay))


def amplification(body, share, betas, limited):
    """Largest |eigenvalue| of G over all waves. `limited`: the slopes are zero, as at extrema."""
    P_damping, u_damping, r = betas
    dt, K = time_step(body, share, betas), body.K
    angle = np.linspace(-np.pi, np.pi, 2 * WAVES + 1)
    xi, eta = (values.ravel() for values in np.meshgrid(angle[WAVES:], angle))
    waves = [xi, eta]
    one = np.broadcast_to(np.eye(8, dtype=complex), (len(xi), 8, 8))
    u, v, P = one[:, 0:2], one[:, 2:4], one[:, 4:8].reshape(-1, 2, 2, 8)     # functionals of the state; P[force, direction of the face]
    times = lambda factor, q: factor.reshape(-1, *[1] * (q.ndim - 1)) * q    # noqa: E731
    stress = lambda *along: sum(np.einsum("ijk,wkm->wijm", K[:, :, :, a], body.per[a] * along[a]) for a in range(2))    # noqa: E731
    half = [np.zeros_like(w) if limited else 0.5j * np.sin(w) for w in waves]
    v_half = v + dt * sum(body.per[a] * times(half[a], P[:, :, a]) for a in range(2))
    P_half = P + dt * stress(*(times(half[a], v) for a in range(2)))
    force, mean, upwind, decay = 0, [], [], 0
    for a in range(2):
        shift, backwards = np.exp(1j * waves[a]), 1 - np.exp(-1j * waves[a])
        jump = times(shift, P_half - times(half[a], P)) - (P_half + times(half[a], P))
        v_low, v_high = v_half + times(half[a], v), times(shift, v_half - times(half[a], v))
        f_low, f_high = (P_half + times(half[a], P))[:, :, a], times(shift, P_half - times(half[a], P))[:, :, a]
        force = force + body.per[a] * times(backwards, 0.5 * (f_low + f_high) + 0.5 * body.Z[a] @ (v_high - v_low))
        mean.append(times(backwards, 0.5 * (v_low + v_high)))
        upwind.append(times(backwards, 0.5 * np.linalg.inv(body.Z[a]) @ (f_high - f_low)))
        decay = decay + 0.5 * body.rates()[a] * times(backwards, jump)
    v_new = v + dt * force
    fourth = [np.sin(w / 2) ** 4 for w in waves]
    tangential = np.stack([times(fourth[1], P[:, :, 0]), times(fourth[0], P[:, :, 1])], axis=2)
    wide = [1j * (4 / 3 * np.sin(w) - np.sin(2 * w) / 6) for w in waves]
    P_new = P + dt * (stress(*mean) + share * stress(*upwind) + (1 - share) * decay) - 0.5 * P_damping * tangential
    P_new = P_new - r * (P - stress(*(times(wide[a], u) for a in range(2))))
    u_new = u + dt * ((1 - MEAN_SHARE) * v_half + 0.5 * MEAN_SHARE * (v + v_new)) - 0.5 * u_damping * times(sum(fourth), u)
    G = np.concatenate([u_new, v_new, P_new.reshape(-1, 4, 8)], axis=1)
    return np.abs(np.linalg.eigvals(G)).max()


def worst(F, lam, betas, softened):
    """Over cells of all shapes, with the slopes as they are and without; None where the body carries no waves."""
    found = []
    for height in CELLS:
        body = Body(F, lam, height)
        if not body.carries_waves():
            return None
        limit = 1 + max(0.5 * betas[2], WITHOUT_RELAXATION)
        share = min(1, limit / body.coupling()) ** 2 if softened else 1
        found += [amplification(body, share, betas, limited) - 1 for limited in (False, True)]
    return max(found)


def as_text(growth):
    return "no waves" if growth is None else "0" if growth < 1e-12 else f"{growth:.1e}"


def main():
    names = [", ".join(f"{beta:g}" for beta in betas) for betas in BETAS]
    print("Largest growth per step, as in (36) / softened, with beta_P, beta_u, beta_r:\n")
    print(f"| state | lambda / mu | {' | '.join(names)} |\n|---|---|{'---|' * len(names)}")
    for state, F in STATES.items():
        for lam in STIFFNESSES:
            cells = [" / ".join(as_text(worst(F, lam, betas, softened)) for softened in (False, True)) for betas in BETAS]
            print(f"| {state} | {lam} | {' | '.join(cells)} |", flush=True)


if __name__ == "__main__":
    main()
