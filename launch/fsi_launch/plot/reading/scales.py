"""Natural scales of a run: what is far below them is round-off and is drawn as zero."""

import re
from dataclasses import dataclass

import numpy as np

NEGLIGIBLE = 1e-11  # part of a natural scale


@dataclass
class Scales:
    """Sizes of the things a case is about, in its own units."""

    length: float
    speed: float
    pressure: float

    def of(self, unit):
        """Scale of a unit such as "force*length/depth"; 0 for one that is not known, as all are
        without fields: nothing is below it."""
        force = self.pressure * self.length ** 2
        words = {"length": self.length, "depth": self.length, "area": self.length ** 2, "rad": 1.0, "force": force,
                 "time": self.length / self.speed, "power": force * self.speed,
                 "energy": force * self.length}
        result = 1.0
        for sign, word in re.findall(r"([*/]?)(\w+)", unit):
            result = result / (words.get(word) or np.inf) if sign == "/" else result * words.get(word, 0.0)
        return result

    def floor(self, unit):
        """Values up to this one are round-off."""
        return NEGLIGIBLE * self.of(unit)


def _largest(grids, quantity):
    return max((np.abs(quantity(grid)[grid.used()]).max() for grid in grids), default=0.0)


def of_run(series):
    """The scales of the fields: size of the domain, speed of sound in the gas and its pressure; of a solid alone the
    largest speed and stress it shows."""
    grids = [grid for one in series for output in one.outputs for grid in output.grids]
    if not grids:
        return Scales(0.0, 1.0, 0.0)
    gas = [grid for grid in grids if "p" in grid.fields]
    solid = [grid for grid in grids if "P11" in grid.fields]
    length = max(np.ptp(x[grid.used()]) for grid in grids for x in (grid.x1, grid.x2))
    if gas:
        speed = _largest(gas, lambda grid: np.sqrt(grid.fields["p"] / grid.fields["rho"]) + grid.speed())
        return Scales(length, speed, _largest(gas, lambda grid: grid.fields["p"]))
    return Scales(length, _largest(solid, lambda grid: grid.speed()) or 1.0,
                  _largest(solid, lambda grid: grid.fields["P11"]))
