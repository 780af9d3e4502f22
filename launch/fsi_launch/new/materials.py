"""Materials by name, in SI units. The numbers are typical ones: density and Young's modulus lie within the ranges that M. F. Ashby,
Materials Selection in Mechanical Design (Butterworth-Heinemann), tabulates for the class; Poisson's ratio is that in common use."""

import math
from dataclasses import dataclass

from fsi_launch.failure import UserMistake


@dataclass(frozen=True)
class Material:
    """An isotropic elastic material."""

    name: str
    rho: float      # density [kg/m^3]
    E: float        # Young's modulus [Pa]
    nu: float       # Poisson's ratio [-]
    note: str = ""


TABLE = {material.name: material for material in (
    Material("steel", 7850, 205e9, 0.29, "low-carbon steel"),
    Material("aluminium", 2700, 70e9, 0.33, "aluminium alloy"),
    Material("titanium", 4430, 114e9, 0.34, "titanium alloy"),
    Material("glass", 2470, 70e9, 0.22, "soda-lime glass"),
    Material("polycarbonate", 1200, 2.3e9, 0.37),
    Material("acrylic", 1190, 3.0e9, 0.37, "PMMA"),
    Material("polyethylene", 950, 0.8e9, 0.42),
    # Natural rubber keeps its volume (nu = 0.4995): its pressure waves, thirty times as fast as its shear waves, would set the
    # time step and show nothing. With 0.49 the volume changes a little, the shape as it should.
    Material("rubber", 930, 2.0e6, 0.49, "natural rubber; its own nu is 0.4995"),
    Material("foam", 50, 2.0e6, 0.3, "flexible polymer foam"),
)}


def material_of(text):
    """A material by its name, or of three numbers `rho,E,nu`. Throws UserMistake."""
    if text in TABLE:
        return TABLE[text]
    try:
        rho, modulus, nu = (float(word) for word in text.split(","))
    except ValueError:
        raise UserMistake(f"no material '{text}': write one of {', '.join(TABLE)}, or three numbers RHO,E,NU "
                          "like 7850,205e9,0.29") from None
    if not (0 < rho < math.inf and 0 < modulus < math.inf and 0 <= nu < 0.5):
        raise UserMistake(f"material {text}: the density and Young's modulus must be finite and above 0, and Poisson's ratio from 0 to below 0.5")
    return Material("a material of one's own", rho, modulus, nu)
