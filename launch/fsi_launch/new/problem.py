"""What a new case is about, in numbers, and what follows from them."""

import math
from dataclasses import dataclass

from fsi_launch.failure import UserMistake
from fsi_launch.new.materials import Material
from fsi_launch.new.outline import Outline

BEFORE, BEHIND, BESIDE = 1.5, 2.5, 1.5      # gas around the body, in lengths of it
SHOCK_AT = 0.5      # before the body, in lengths of it
SHOCK_PASSES, STREAM_PASSES = 2.5, 2.0      # lengths of the body until the end
OUTPUTS = 10
LEAST_SPACING, LARGEST_SPACING = 2e-7, 1e6      # [m]; grid.factor = 0.1 / h is at most 1e6, with half the spacing too


@dataclass(frozen=True)
class Problem:
    """A body in a gas; SI units throughout."""

    name: str
    outline: Outline
    material: Material
    straight: bool = False      # edges between the points of the outline,
    sharp: bool = True          # and sharp corners between those of a rigid body that are long enough
    flow: str = "shock"         # or stream
    mach: float = 1.3
    rho: float = 1.225          # dry air at 15 degrees Celsius and one atmosphere (the ISO 2533 standard atmosphere at sea level)
    p: float = 101325.0
    gamma: float = 1.4
    law: str = "neo_hookean"
    fixed: bool = False
    on_wall: bool = False       # stands on the lower wall of the gas, clamped
    end: float = None           # of the run; None: chosen
    cells: int = 20             # along the body

    def check(self):
        """Throws UserMistake."""
        if self.flow == "shock" and self.mach <= 1:
            raise UserMistake(f"--mach {self.mach:g}: a shock is faster than sound, above 1; --flow stream takes any")
        for option, value in (("mach", self.mach), ("density", self.rho), ("pressure", self.p), ("end", 1.0 if self.end is None else self.end)):
            if not value > 0:
                raise UserMistake(f"--{option} {value:g}: must be above 0")
        if not 1 < self.gamma <= 10:
            raise UserMistake(f"--gamma {self.gamma:g}: must be above 1 and at most 10")
        if not 5 <= self.cells <= 1000:
            raise UserMistake(f"--cells {self.cells}: must be 5 to 1000")
        if not LEAST_SPACING <= (spacing := self.outline.size() / self.cells) <= LARGEST_SPACING:
            raise UserMistake(f"the body is {self.outline.size():g} m long, its {self.cells} cells (--cells) are {spacing:g} m; write a --size of "
                              f"{LEAST_SPACING * self.cells:g} to {LARGEST_SPACING * self.cells:g}")
        if self.fixed and self.law != "rigid":
            raise UserMistake("--fixed holds a rigid body; add --law rigid")

        if self.on_wall and not self.straight:
            raise UserMistake("--on-wall is for a body with straight edges; add --outline FILE --straight")
        if self.on_wall and self.law == "rigid" and not self.fixed:
            raise UserMistake("--on-wall: nothing would hold a rigid body on the wall; add --fixed")

    def sound(self):
        """Speed of sound of the gas at rest [m/s]."""
        return math.sqrt(self.gamma * self.p / self.rho)

    def spacing(self):
        """A round number near the length of the body over the cells [m]."""
        return _round_down(self.outline.size() / self.cells)

    def domain(self):
        """(x low, x high, y low, y high) of the gas, whole spacings around the body [m]."""
        x_low, x_high, y_low, y_high = self.outline.box()
        length, step = self.outline.size(), 5 * self.spacing()
        def down(value):
            return step * math.floor(value / step + 1e-9)
        return (down(x_low - BEFORE * length), -down(-x_high - BEHIND * length), y_low if self.on_wall else down(y_low - BESIDE * length),
                -down(-y_high - BESIDE * length))

    def shock(self):
        """Where it is at t = 0 [m]: a third of a spacing beside a line of points. On a line round-off would decide which side of the shock
        its points are on, and differently on each grid; so it is on none when the spacing is halved."""
        step = self.spacing()
        return step * (round((self.outline.box()[0] - SHOCK_AT * self.outline.size()) / step) - 1 / 3)

    def duration(self):
        """Until the shock has passed the body, or the stream twice its length [s]."""
        lengths = SHOCK_PASSES if self.flow == "shock" else STREAM_PASSES
        return self.end or float(f"{lengths * self.outline.size() / (self.mach * self.sound()):.2g}")


def _round_down(value):
    """1, 2, 2.5 or 5 times a power of ten."""
    power = 10.0 ** math.floor(math.log10(value) + 1e-9)
    return max(unit for unit in (1, 2, 2.5, 5) if unit * power <= value * (1 + 1e-9)) * power
