"""A case in other units of length, time and density: every value times the power of its unit that the schema says, formulas too.

With powers of two nothing is rounded, so that what the programs make of it differs from what they make of the case itself by powers of
two alone.
"""

import csv
import json
import re
import subprocess
from dataclasses import dataclass

import numpy as np
import yaml

from running import BIN

# Of what a file of results has beside the units in its header: powers of length, time, density.
LENGTH, TIME, DENSITY, VELOCITY, PRESSURE, PURE = (1, 0, 0), (0, 1, 0), (0, 0, 1), (1, -1, 0), (2, -2, 1), (0, 0, 0)
FIELDS = {
    **dict.fromkeys(("x", "x1", "x2", "x1_bar", "x2_bar", "u1", "u2"), LENGTH), **dict.fromkeys(("v1", "v2"), VELOCITY),
    **dict.fromkeys(("p", "P11", "P12", "P21", "P22"), PRESSURE), "rho": DENSITY, "theta": PURE, "kind": PURE, "vtkGhostType": PURE,
    **dict.fromkeys(("N", "Q"), (3, -2, 1)), "M": (4, -2, 1),
}
WORDS = {"length": LENGTH, "time": TIME, "depth": PURE, "rad": PURE, "-": PURE, "velocity": VELOCITY, "pressure": PRESSURE,
         "area": LENGTH, "mass": (2, 0, 1), "force": (3, -2, 1), "power": (4, -3, 1), "energy": (4, -2, 1), "moment": (4, -2, 1)}
# Of the data of an external solid, which only its program knows.
DATA = {"spring_piston": {"stiffness": (2, -2, 1), "damping": (2, -1, 1)}}


@dataclass
class Units:
    """The power of two that the numbers of a length, a time and a density are multiplied by."""
    length: int
    time: int
    density: int

    def power(self, powers):
        return sum(mine * its for mine, its in zip((self.length, self.time, self.density), powers))

    def factor(self, powers):
        return 2.0 ** self.power(powers)


def schema():
    return json.loads(subprocess.run([BIN / "fsi_case", "schema"], capture_output=True, text=True, check=True).stdout)


class Rewriting:
    """Takes a case as its file has it; `folder`: where files that it names are, `to`: where they are written in the other units."""

    def __init__(self, units, folder, to):
        self.units, self.folder, self.to = units, folder, to
        self.schema = schema()

    def whole(self, case):
        case = {key: value for key, value in case.items() if key != "expect"}
        case["parameters"] = {name: self.formula(value) for name, value in case.get("parameters", {}).items()}
        case["definitions"] = {name: self.formula(value) for name, value in case.get("definitions", {}).items()}
        return self.section(case, self.schema["allOf"][0], {"parameters", "definitions"})

    def section(self, value, about, done=()):
        """A mapping; keys of which the schema says a default with a dimension get it where they are missing."""
        properties = self.object_for(value, about)
        if properties is None:
            return value
        written = {}
        for key, one in value.items():
            written[key] = one if key in done else self.value(key, one, properties[key])
        for key, its in properties.items():
            missing = its.get("default")
            if key not in value and missing and any(self.powers(its)):
                written[key] = self.scaled(missing, self.powers(its))
        return written

    def object_for(self, value, about):
        """What the schema says of the keys of this mapping: the definition of its kind. None for a mapping with names of the user's."""
        for one in self.alternatives(about):
            if one.get("type") != "object" or "properties" not in one:
                continue
            kind = one["properties"].get("kind", {}).get("const")
            if kind is None or value.get("kind", kind) == kind and ("kind" in value or "kind" not in one.get("required", [])):
                return one["properties"]
        return None

    def alternatives(self, about):
        """All that a value may be."""
        if "$ref" in about:
            name = about["$ref"].rsplit("/", 1)[1].replace("%20", " ")
            yield from self.alternatives(self.schema["definitions"][name])
        elif "allOf" in about or "anyOf" in about:
            for one in (*about.get("allOf", ()), *about.get("anyOf", ())):
                yield from self.alternatives(one)
        else:
            yield about

    @staticmethod
    def powers(about):
        unit = about.get("x-unit", {})
        return tuple(unit.get(name, 0) for name in ("length", "time", "density"))

    def value(self, key, value, about):
        known = list(self.alternatives(about))
        if isinstance(value, dict):
            named = next((one["additionalProperties"] for one in known if isinstance(one.get("additionalProperties"), dict)), None)
            if named is None:
                return self.with_units_of_its_program(value, self.section(value, about))
            return {name: self.value(key, one, named) for name, one in value.items()}
        if isinstance(value, list):
            items = next(one["items"] for one in known if one.get("type") == "array")
            return [self.value(key, one, items if "x-unit" in items or "x-unit" not in about else {**items, "x-unit": about["x-unit"]})
                    for one in value]
        if key == "file":
            return self.points(value)
        if isinstance(value, bool) or any(value in one.get("enum", ()) for one in known):
            return value
        if not any(one.get("type") in ("number", "integer", ["number", "string"]) for one in known):
            return value
        return self.scaled(self.formula(value, of_parameters=key == "map"), self.powers(about))

    def with_units_of_its_program(self, before, section):
        units = DATA.get(before.get("program"), {})
        if units:
            section["data"] = {name: self.scaled(self.formula(one), units[name]) for name, one in before["data"].items()}
        return section

    def formula(self, value, of_parameters=False):
        """The same value from positions, times and spacings in the other units; the r of a map is no radius."""
        if not isinstance(value, str):
            return value
        units = {**dict.fromkeys("xyh" if of_parameters else "xyhr", LENGTH), "t": TIME}
        return re.sub(r"\b[xyhrt]\b(?!\s*\()",
                      lambda name: f"({name[0]} * {self.units.factor([-p for p in units[name[0]]])!r})" if name[0] in units else name[0], value)

    def scaled(self, value, powers):
        factor = self.units.factor(powers)
        if factor == 1:
            return value
        return f"({value}) * {factor!r}" if isinstance(value, str) else value * factor

    def points(self, name):
        """A file of points."""
        lines = []
        for line in (self.folder / name).read_text(encoding="utf-8").splitlines():
            try:
                lines.append(", ".join(repr(self.scaled(float(word), LENGTH)) for word in line.split(",")))
            except ValueError:
                lines.append(line)
        (self.to / name).write_text("\n".join(lines) + "\n", encoding="utf-8")
        return name


def written(case, path):
    path.write_text(yaml.safe_dump(case, sort_keys=False, allow_unicode=True, width=10000), encoding="utf-8")
    return path


def powers_of(text):
    """Of a unit in a header: length/time^2, force*time/depth."""
    total = np.zeros(3, dtype=int)
    sign = 1
    for word in re.split(r"([*/])", text.strip()):
        if word in "*/":
            sign = -1 if word == "/" else 1
            continue
        name, _, exponent = word.strip().partition("^")
        if name != "1":
            total += sign * int(exponent or 1) * np.array(WORDS[name])
    return tuple(int(power) for power in total)


def column_powers(header):
    name, _, unit = header.partition("[")
    if unit:
        return powers_of(unit.rstrip("]"))
    return FIELDS.get(name.rsplit(".", 1)[-1].strip(), PURE)


def differences(directory, other, units):
    """What differs between the results of a run and those of the same in other units, a line each."""
    names = [sorted(path.relative_to(folder).as_posix() for path in folder.rglob("*")
                    if path.is_file() and (path.suffix == ".csv" or path.suffix == ".h5" and path.parent.name == "fields"))
             for folder in (directory, other)]
    if names[0] != names[1]:
        return [f"files {set(names[0]) ^ set(names[1])}"]
    found = []
    for name in names[0]:
        compare = compare_tables if name.endswith(".csv") else compare_fields
        found += [f"{name}: {what}" for what in compare(directory / name, other / name, units)]
    return found


def same_bits(values, others, power):
    values, others = np.asarray(values, dtype=float), np.asarray(others, dtype=float)
    return values.shape == others.shape and np.array_equal(np.ldexp(values, power), others, equal_nan=True)


def how_much(values, others, power):
    values, others = np.ldexp(np.asarray(values, dtype=float), power), np.asarray(others, dtype=float)
    if values.shape != others.shape:
        return f"shapes {values.shape}, {others.shape}"
    scale = max(np.nanmax(np.abs(values)), 1e-300)
    return f"{np.sum(~((values == others) | np.isnan(values)))} values, by up to {np.nanmax(np.abs(values - others)) / scale:.1e} of {scale:.3g}"


def compare_fields(path, other, units):
    import h5py
    with h5py.File(path) as one, h5py.File(other) as two:
        pairs = [(f"attribute {key}", one.attrs[key], two.attrs.get(key), TIME if key == "t" else PURE) for key in one.attrs]
        one.visititems(lambda name, data: pairs.append((name, data[()], two[name][()], FIELDS[name.rsplit("/", 1)[-1]]))
                       if isinstance(data, h5py.Dataset) else None)
    return [f"{name}: {how_much(a, b, units.power(powers))}" for name, a, b, powers in pairs if not same_bits(a, b, units.power(powers))]


# Columns that hold no numbers.
NO_NUMBERS = ("limited_by",)


def compare_tables(path, other, units):
    one, two = (list(csv.reader(file.read_text(encoding="utf-8").splitlines())) for file in (path, other))
    if one[0] != two[0] or len(one) != len(two):
        return [f"{len(one)} lines of {one[0]}, {len(two)} of {two[0]}"]
    found = []
    for k, header in enumerate(one[0]):
        a, b = ([line[k] for line in table[1:]] for table in (one, two))
        if header in NO_NUMBERS:
            found += [f"{header}: {a}, {b}"] if a != b else []
            continue
        a, b = ([float(text) for text in column] for column in (a, b))
        power = units.power(column_powers(header.strip()))
        if not same_bits(a, b, power):
            found.append(f"{header}: {how_much(a, b, power)}")
    return found
