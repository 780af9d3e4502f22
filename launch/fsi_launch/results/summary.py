"""summary.json: the parts every program leaves in DIR/parts, merged, and what the case expects of it."""

import contextlib
import csv
import json
import math
import textwrap
from pathlib import Path

from fsi_launch import version
from fsi_launch.results import whole_file

ERROR_ORDER = ("rho", "v1", "v2", "T", "p", "u_bar", "v_bar", "P_bar")
PARTICIPANT_KEYS = ("role", "status", "points", "substeps", "compute_s", "wait_s", "time_s", "point_updates_per_s",
                    "peak_memory_mib")

ROUTINE = ("bounded_side_points",)  # counters that any strong shock at a wall makes: they are written, not printed


def read_parts(directory, participants, copies=None):
    """{participant: part}; a program that left no part is not in it. `copies`: texts of parts that a full disk may lack."""
    parts = {}
    for name in participants:
        try:
            parts[name] = json.loads((Path(directory) / "parts" / f"{name}.json").read_text(encoding="utf-8"))
        except (OSError, ValueError):
            with contextlib.suppress(ValueError):
                parts[name] = json.loads((copies or {}).get(name, ""))
    return {name: part for name, part in parts.items() if isinstance(part, dict)}


def _merged(parts, key, combine):
    """One dictionary of numbers out of the parts' dictionaries `key`."""
    merged = {}
    for part in parts.values():
        for name, value in (part.get(key) or {}).items():
            merged[name] = combine(merged[name], value) if name in merged else value
    return merged


def _worse(a, b):
    """The larger error; null (not finite) is the worst."""
    return None if a is None or b is None else max(a, b)


def _ordered(errors):
    known = [name for name in ERROR_ORDER if name in errors]
    return {name: errors[name] for name in known + sorted(errors.keys() - set(known))}


def _worst(parts, key):
    """The worst that any program found in its fields, with its name, or None: ripples (`noise`), grids that differ (`disagreement`), shocks
    of gases without viscosity (`strong_shock`)."""
    found = [{"value": one["value"], "participant": name} | one for name, part in parts.items() if (one := part.get(key))]
    return max(found, key=lambda one: one["value"] or 0, default=None)


def _last_line(directory):
    """{t, steps} of the last line of interface.csv, or None."""
    try:
        with open(Path(directory) / "interface.csv", encoding="utf-8", newline="") as file:
            rows = list(csv.DictReader(file))
        return {"t": float(rows[-1]["t [time]"]), "steps": int(rows[-1]["step"])}
    except (OSError, ValueError, LookupError, TypeError, csv.Error):
        return None


def last_known(directory, told, begun_from=None):
    """{t, steps} a run has come to as far as is known without reports of its programs, or None. `told`: the same as they last said;
    `begun_from`: of the checkpoint of a restart, whose table may go on beyond it before the first step."""
    found = [told, begun_from, _last_line(directory) if told or not begun_from else None]
    return max((one for one in found if one), key=lambda one: one["steps"], default=None)


def merge(parts, case, status, reason, wall_s, known=None, done=()):
    """The summary of a run, whatever became of it, from what its programs left. `case` is the launcher's Case; `known`: the
    {t, steps} that count where the speaker left no report; `done`: names of programs that ended with exit code 0."""
    participants = case.programs
    speaker = parts.get(case.speaker()) or max([*parts.values(), *([known] if known else [])], key=lambda part: part.get("t", 0), default={})
    summary = {
        "status": status, "reason": reason, "case": case.name,
        "t": speaker.get("t", 0.0), "t_end": case.end, "steps": speaker.get("steps", 0),
        "dt": {"min": speaker.get("dt_min"), "max": speaker.get("dt_max"), "limited_by": speaker.get("dt_limited_by") or {}},
        "wall_s": round(wall_s, 4),
        "participants": {}, "errors": _ordered(_merged(parts, "errors", _worse)),
        "interface": speaker.get("interface") or {},
        "counters": {"first_order_fallbacks": 0, "floors": 0} | _merged(parts, "counters", lambda a, b: a + b),
    }
    if missing := next((part["reason"] for part in parts.values() if part.get("status") == "completed" and part.get("reason")), None):
        summary["errors_missing"] = missing
    for name, program in participants.items():
        part = parts.get(name, {"status": "completed" if name in done and status != "failed" else "lost"})
        summary["participants"][name] = {"program": program} | {
            key: part[key] for key in PARTICIPANT_KEYS if key in part}
    for key in ("noise", "disagreement", "strong_shock"):
        if found := _worst(parts, key):
            summary[key] = found
    if overlap := {name: part["overlap"] for name, part in parts.items() if part.get("overlap")}:
        summary["overlap"] = overlap
    conservation = {name: part["conservation"] for name, part in parts.items() if part.get("conservation")}
    if conservation:
        summary["conservation"] = conservation
    return summary | {"build": version.built()}


def write(directory, summary):
    """Writes DIR/summary.json, whole or not at all."""
    whole_file.write(Path(directory) / "summary.json", json.dumps(summary, indent=2) + "\n")


# --- expectations


def value_at(summary, quantity):
    """The value at a path like "errors.rho", or None; of a counter that no program of the run has, 0."""
    value = summary
    for key in quantity.split("."):
        if not isinstance(value, dict) or key not in value:
            return 0 if quantity.startswith("counters.") else None
        value = value[key]
    return value


def _as_number(text):
    """The number a text stands for, or None."""
    try:
        return float(text)
    except ValueError:
        return None


def _is_met(value, entry):
    is_number = isinstance(value, (int, float))
    if (wanted := entry.get("equals")) is not None:
        return value == _as_number(wanted) if is_number else str(value) == str(wanted)
    if not is_number or not math.isfinite(value):
        return False
    return not ((entry.get("max") is not None and value > entry["max"])
                or (entry.get("min") is not None and value < entry["min"]))


def _bound(entry):
    if entry.get("equals") is not None:
        return f"must be {entry['equals']}"
    bounds = [f"{word} {entry[key]:g}" for key, word in (("min", "at least"), ("max", "at most"))
              if entry.get(key) is not None]
    return "must be " + " and ".join(bounds)


def missed_expectations(summary, expect):
    """One line for every expectation that is not met; the results go to summary["expectations"]."""
    missed, results = [], []
    for entry in expect:
        value = value_at(summary, entry["quantity"])
        met = _is_met(value, entry)
        results.append({key: item for key, item in entry.items() if item is not None} | {"value": value, "met": met})
        if not met:
            shown = "missing" if value is None else f"{value:.6g}" if isinstance(value, float) else value
            missed.append(f"check failed: {entry['quantity']} = {shown}, {_bound(entry)}")
    if results:
        summary["expectations"] = results
    return missed


# --- for people

WIDE = 80               # of what is no terminal
ERROR_WIDTH = 11        # of a column of errors
LEAST_WANTED = ("updates", "waiting", "computing", "points")    # columns that narrow terminals do without, in this order


def aligned(rows):
    """Rows of text as aligned columns: the first to the left, the others to the right."""
    widths = [max(len(row[k]) for row in rows) for k in range(len(rows[0]))]
    return ["  " + "  ".join(cell.ljust(w) if k == 0 else cell.rjust(w) for k, (cell, w) in enumerate(zip(row, widths)))
            for row in rows]


def limiters(counts):
    """Who limited the steps and in what share of them: "fluid 98 %, time.growth 2 %"; those below half a per cent are left out."""
    total = sum(counts.values())
    shares = [(100 * count / total, name) for name, count in counts.items() if count]
    return ", ".join(f"{name} {share:.0f} %" for share, name in sorted(shares, key=lambda one: -one[0]) if share >= 0.5)


def _number(value, form="{:.3g}"):
    return "-" if value is None else form.format(value)


LEAST_PERCENT = 1e-6    # that is written in digits


def percent(part):
    """A part of something in per cent as people write it, in two digits: 100 %, 7300 %, 0.00052 %."""
    value = 100 * abs(part)
    if not math.isfinite(value):
        return f"{value} %"
    if 0 < value < LEAST_PERCENT:
        return "less than 1e-6 %"
    digits = 1 - math.floor(math.log10(value)) if value else 0    # after the point
    text = f"{round(value, digits):.{max(digits, 0)}f}"
    return f"{text.rstrip('0').rstrip('.') if digits > 0 else text} %"


def _rate(value):
    return "-" if not value else f"{value / 1e6:.2f} M/s"


def _participant_rows(summary):
    rows = [["participant", "points", "own steps", "computing", "waiting", "updates", "memory"]]
    for name, part in summary["participants"].items():
        program = part["program"].removeprefix("solid_solver_")
        label = name if program in (name, f"{name}_solver") else f"{name} ({program})"
        rows.append([label, str(part.get("points", "-")), str(part.get("substeps", "-")),
                     _number(part.get("compute_s"), "{:.2f} s"), _number(part.get("wait_s"), "{:.2f} s"),
                     _rate(part.get("point_updates_per_s")), _number(part.get("peak_memory_mib"), "{:.0f} MiB")])
    return rows


def _table(rows, width):
    """Aligned columns, as many as go into `width`: the first row names them."""
    rows = [list(row) for row in rows]
    for unwanted in LEAST_WANTED:
        if max(map(len, aligned(rows))) <= width:
            break
        k = rows[0].index(unwanted)
        rows = [row[:k] + row[k + 1:] for row in rows]
    return aligned(rows)


def _folded(lines, width):
    """The lines with those that are too long for `width` gone on in the next one."""
    return [part for line in lines for part in
            (textwrap.wrap(line, width, subsequent_indent="    ", break_long_words=False, break_on_hyphens=False) if len(line) > width else [line])]


def _place_in_words(found):
    point, place = (", ".join(f"{value:.6g}" for value in found[key]) for key in ("point", "place"))
    return f"grid \"{found['grid']}\", point ({point}) at ({place})"


def noise_in_words(summary):
    """One line where the solution is rippled by the grid, or ""."""
    noise = summary.get("noise") or {}
    if not noise.get("noisy"):
        return ""
    return (f"noise of the grid's scale: {noise['field']} of {noise['participant']} ripples by {percent(noise['value'])} of "
            f"its range, {_place_in_words(noise)}, t = {noise['t']:.4g}")


def disagreement_in_words(summary):
    """One line where two grids have different solutions at one place, or ""."""
    found = summary.get("disagreement") or {}
    if not found.get("large"):
        return ""
    return (f"grids disagree where they overlap: {found['field']} of {found['participant']} differs by {percent(found['value'])} of its range "
            f"between {_place_in_words(found)}, and the background, t = {found['t']:.4g}; "
            "do not trust the flow there: a finer grid resolves it (docs/output.md, disagreement)")


def strong_shock_in_words(summary):
    """One line where a gas without shock viscosity has a shock that such a gas does not keep, or ""."""
    found = summary.get("strong_shock") or {}
    if not found.get("strong"):
        return ""
    gas = found["participant"]
    scheme = f"{gas if gas == 'fluid' else f'fluids.{gas}'}.scheme"
    return (f"a shock of Mach {found['value']:.2g} along grid lines of {gas}, {_place_in_words(found)}, t = {found['t']:.4g}: such a shock may break up; "
            f"write {scheme}.shock_viscosity: 0.5, or 0 to say that it is meant (docs/theory_fluid.md, shocks along grid lines)")


MISSED_MASS = 0.05      # part of the mass that a gas had at the start
MISSED_MOMENTUM = 0.05  # part of the momentum that the gas gave a solid
ROUND_OFF = 1e-12       # part of pressure x speed x time^2: what the gas presses in the run on a side as long as its way


def mass_lines(summary):
    """A line for each gas that has lost mass, or won some, which no flux carried over its boundary."""
    lines = []
    for name, totals in summary.get("conservation", {}).items():
        missed, mass = abs(totals.get("mass_defect") or 0), totals.get("mass_initial") or 0
        if missed > MISSED_MASS * mass > 0:
            lines.append(f"  warning: the mass of {name} is off by {percent(missed / mass)} of what it was at the start: its grid is too coarse for this flow, and "
                         "forces may be wrong; take a larger grid.factor (docs/output.md, budgets)")
    return lines


def momentum_lines(summary):
    """A line for each solid that has not the momentum that the gas gave it."""
    lines, interface = [], summary.get("interface", {})
    floor = ROUND_OFF * (interface.get("traction_scale") or 0) * (interface.get("velocity_scale") or 0) * (summary.get("t") or 0) ** 2
    for name, totals in summary.get("conservation", {}).items():
        missed = math.hypot(totals.get("momentum1_defect") or 0, totals.get("momentum2_defect") or 0)
        if (scale := totals.get("momentum_scale") or 0) and missed > max(MISSED_MOMENTUM * scale, floor):
            lines.append(f"  warning: the momentum of {name} is off by {percent(missed / scale)} of what the gas gave it; a finer grid brings it nearer "
                         "(docs/output.md, budgets)")
    return lines


TURNED = 0.05    # angle, in rad, from which on a linear law says something else than the others


def turned_lines(summary, directory):
    """A line for each solid of linear elasticity that has turned: its law takes the rotation for a strain."""
    lines = []
    for name, part in summary["participants"].items():
        angle = _largest_angle(Path(directory) / f"forces_{name}.csv") if part.get("program") == "solid_solver_linear_elastic" else 0
        if angle > TURNED:
            lines.append(f"  warning: {name} has turned by {math.degrees(angle):.1f} degrees, which its law, linear_elastic, takes for a strain; "
                         f"saint_venant_kirchhoff is the same law for bodies that turn (solids.{name}.law)")
    return lines


def _largest_angle(table):
    """In a table of forces, whose last line a run that broke off may have left half; 0 where there is none."""
    angle = 0
    with contextlib.suppress(OSError, ValueError, TypeError, csv.Error):
        text = table.read_text(encoding="utf-8")
        for row in csv.DictReader(text[:text.rfind("\n") + 1].splitlines()):
            angle = max(angle, abs(float(row.get("angle [rad]"))))
    return angle


def _interface_lines(interface):
    """The jumps beside what they are to be compared with."""
    def jump(name, scale, of):
        value, size = interface.get(f"max_{name}_jump"), interface.get(scale)
        part = f" ({percent(value / size)} of {of} {size:.3g})" if value is not None and size else ""
        return f"{name} {_number(value, '{:.2e}')}{part}"
    lines = []
    if "max_velocity_jump" in interface:
        jumps = [jump("velocity", "velocity_scale", "the gas's speed,")]
        if interface.get("max_traction_jump") != 0:     # a body that has no stress of its own takes that of the gas
            jumps.append(jump("traction", "traction_scale", "the gas's pressure,"))
        lines.append(f"  interface: largest jumps before the projection: {', '.join(jumps)}")
    if "max_gap" in interface:
        lines.append(f"  interface: largest gap {_number(interface['max_gap'], '{:.2e}')}")
    return lines


def _error_lines(errors, width):
    names, count = list(errors), max(1, (width - 1) // ERROR_WIDTH)
    lines = ["  errors (maximum norm)"]
    for part in (names[k:k + count] for k in range(0, len(names), count)):
        lines += aligned([part, [_number(errors[name], "{:.2e}") for name in part]])
    return lines


SOUND_AMPLIFICATION = 3.125  # of errors by points that interpolate from each other (common/grid/overlap/composite_grid.hpp)


def overlap_lines(summary):
    """Where grids overlapped less well than they should, one line for each program."""
    lines = []
    for name, overlap in summary.get("overlap", {}).items():
        said = []
        if (amplification := overlap.get("amplification")) is None or amplification > SOUND_AMPLIFICATION:
            said.append(f"interpolation amplified errors {_number(amplification, '{:.3g}')} times (sound: {SOUND_AMPLIFICATION:g}), "
                        f"{_place_in_words(overlap)}, t = {overlap['t']:.4g}")
        if narrowed := overlap["narrowed"]:
            said.append(f"{narrowed} points with fewer donors")
        if left_out := overlap["lines_left_out"]:
            said.append(f"{left_out} grid lines left out")
        if said:
            lines.append(f"  overlap of {name}'s grids: {'; '.join(said)}")
    return lines


def describe(summary, directory, width=None):
    """The end of a run as lines of text, for a terminal of `width` columns or for none."""
    dt = summary["dt"]
    head = f"{summary['case']} {summary['status']}: t = {summary['t']:.6g}, {summary['steps']} steps"
    if dt["min"] is not None and summary["steps"]:
        head += f" of {dt['min']:.3g} to {dt['max']:.3g}"
    lines = [f"{head}, {summary['wall_s']:.2f} s", *_table(_participant_rows(summary), width or math.inf)]
    if said := limiters(dt.get("limited_by") or {}):
        lines.append(f"  step limited by: {said}")
    if summary["errors"]:
        lines += _error_lines(summary["errors"], width or WIDE)
    if summary.get("errors_missing"):
        lines.append(f"  no errors: {summary['errors_missing']}")
    if interface := summary["interface"]:
        lines += _interface_lines(interface)
    if counted := {key: value for key, value in summary["counters"].items() if value and key not in ROUTINE}:
        lines.append("  counters: " + ", ".join(f"{key.replace('_', ' ')} {value:g}" for key, value in counted.items()))
    lines += overlap_lines(summary) + mass_lines(summary) + momentum_lines(summary) + turned_lines(summary, directory)
    lines += [f"  warning: {said}" for said in (noise_in_words(summary), disagreement_in_words(summary), strong_shock_in_words(summary)) if said]
    if summary.get("expectations"):
        met = sum(entry["met"] for entry in summary["expectations"])
        lines.append(f"  expectations: {met} of {len(summary['expectations'])} met")
    return "\n".join([*(_folded(lines, width) if width else lines), f"  results in {directory}"])
