"""record_results.py --check: do the recorded tables repeat? Numbers are compared one by one, each within its stated scatter."""

import re

NUMBER = re.compile(r"[-+]?(?:\d+\.\d*|\.\d+|\d+)(?:[eE][-+]?\d+)?|nan|inf")
SCATTER = 2e-2      # of a number's size: another instruction set rounds differently, and limiters decide on round-off
ROUND_OFF = 1e-11   # numbers below are round-off, whatever they are
STEPS = 2           # of counts, such as time steps
ORDER = 0.1         # of observed orders of convergence
ENDLESS = ("nan", "inf")
# What depends on the machine and not on the numerics: these columns, and all numbers of these sections.
MEASURED = re.compile(r"wall|\[s\]|\[ms|updates/s|MiB|\[%\]|time of|processor")
MACHINES = ("Benchmarks", "What watching costs", "What live pictures cost", "Signals to every program", "Two ranks against one",
            "time of each program", "Sanitizers", "Mutat", "Kernels by instruction set", "bare Debians", "level of x86-64",
            "The suite again", "The suite beside", "From clone", "protecting the bus")


def _rows(text):
    """[(heading, cells)] of every table row; other lines with numbers as a row of one cell."""
    rows, heading = [], None
    for line in text.splitlines():
        if not line.startswith("|"):
            heading = None
            continue
        cells = [cell.strip() for cell in line.strip().strip("|").split("|")]
        if heading is None:
            heading = cells
        elif not set(line) <= set("|-"):
            rows.append((heading, cells))
    return rows


def _last_place(number):
    """What one unit in the last digit of a printed number is worth."""
    mantissa, _, exponent = number.lower().partition("e")
    return 10.0 ** (int(exponent or 0) - len(mantissa.partition(".")[2]))


def _tolerance(x, y, is_order):
    """By how much two printed numbers may differ."""
    whole = not re.search(r"[.e]", x + y, re.I)
    size = max(abs(float(x)), abs(float(y)))
    return max(ORDER if is_order else SCATTER * size, ROUND_OFF, STEPS if whole else 1.01 * max(_last_place(x), _last_place(y)))


def _same(old, new, is_order):
    """True if two cells say the same within the scatter."""
    a, b = NUMBER.findall(old), NUMBER.findall(new)
    if NUMBER.sub("#", old) != NUMBER.sub("#", new) or len(a) != len(b):
        return False
    return all(x == y or (x not in ENDLESS and y not in ENDLESS and abs(float(x) - float(y)) <= _tolerance(x, y, is_order))
               for x, y in zip(a, b))


def is_of_the_machine(title):
    """Whether the section holds what the machine does, and not the numerics."""
    return any(word in title for word in MACHINES)


def differences(title, old, new):
    """Lines that say which cells of a section do not repeat."""
    if is_of_the_machine(title):
        return []
    before, after = _rows(old), _rows(new)
    if [row[0] for row in before] != [row[0] for row in after] or len(before) != len(after):
        return [f"{title}: the tables have other rows or columns than those recorded"]
    found = []
    for (heading, a), (_, b) in zip(before, after):
        for column, x, y in zip(heading, a, b):
            is_order = column in ("rate", "order") or a[0] == "fit"
            if not MEASURED.search(column) and not _same(x, y, is_order):
                found.append(f"{title}: row {a[0]!r}, column {column!r}: recorded {x}, now {y}")
    return found
