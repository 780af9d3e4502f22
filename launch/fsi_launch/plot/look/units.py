"""Labels with units. A case that says `units: SI` has pictures that say m, s and Pa; others have bare names, for their numbers are
those of any consistent system."""

import re

SYMBOLS = {"none": {}, "SI": {
    "time": "s", "length": "m", "depth": "m", "area": "m$^2$", "volume": "m$^3$", "mass": "kg", "force": "N", "energy": "J",
    "power": "W", "rad": "rad", "force/area": "Pa", "force*length/depth": "N"}}

_symbols = SYMBOLS["none"]      # of the pictures that are being drawn, as matplotlib keeps their look


def use(system):
    """Takes the symbols of a system, "SI" or "none", for all labels from now on."""
    global _symbols     # noqa: PLW0603
    _symbols = SYMBOLS[system]


def use_those_of(cases):
    """Those that all these cases say, by the entries of each (several.entries); bare names where they differ."""
    said = {case.get("units", "none") for case in cases}
    use("SI" if said == {"SI"} else "none")


def symbol(unit):
    """The symbol of a unit such as "length/time"; "" where there is none."""
    if not _symbols or not unit:
        return ""
    if unit in _symbols:
        return _symbols[unit]
    words = re.findall(r"([*/]?)(\w+)", unit)
    if any(word not in _symbols for _, word in words):
        return ""
    return "".join({"*": " ", "/": "/", "": ""}[sign] + _symbols[word] for sign, word in words)


def label(name, unit):
    """A name with its unit: "x [m]"."""
    found = symbol(unit)
    return f"{name} [{found}]" if found else name


def moment(t, digits=4):
    """ "t = 0.5 s" """
    return f"t = {t:.{digits}g} {symbol('time')}".rstrip()


def heading(text):
    """The heading of a column of a table with its unit in symbols, where there are some: "power [W/m]"."""
    match = re.fullmatch(r"(.*) \[(.*)\]", text)
    found = symbol(match[2]) if match else ""
    return f"{match[1]} [{found}]" if found else text
