"""A case as `fsi_case` reads and checks it: the only reader of case files is in C++."""

import json
import re
from dataclasses import dataclass, field
from pathlib import Path

from fsi_launch import paths
from fsi_launch.failure import Failure, INTERNAL_ERROR, UserMistake
from fsi_launch.telling import AS_NAMED, answer_of

REFERENCE_PROGRAMS = {  # reference kinds computed by a program of their own
    "piston_1d": "reference_piston",
    "rotating_disk": "reference_disk",
}
EXACT_KINDS = ("elastic_piston", "riemann", "wall_between_gases", "clamped_wall")   # whose solution reference_exact writes beside a run


@dataclass
class Case:
    """What the launcher needs to know. `text` is the resolved case: parameters and overrides filled in, and behind a parameter its formula."""

    name: str
    text: str
    programs: dict      # {participant: executable}, in the order they start
    reference: str      # kind
    expect: list        # of {quantity, max, min, equals}
    end: float = 0.0    # time.end
    times: tuple = ()   # of output
    projection: str = ""    # of the interface
    remarks: tuple = ()     # lines about what is valid and seldom meant
    unused: tuple = ()      # parameters that nothing in the case needs
    digest: str = None      # of what a restart must not change
    cost: dict = field(default_factory=dict)    # {participant: {points, seconds_a_step}}, about

    def speaker(self):
        """The participant that reports progress: the coupler, or the standalone solver."""
        return list(self.programs)[-1]


# --- formulas of parameters

FORMULA = "    # formula: "      # between a parameter's number and the formula that gave it, in a resolved case
PARAMETERS = r"^parameters:[ \t]*(?:#.*)?\n((?:[ \t]+.*\n|[ \t]*\n|#.*\n)*)"      # the section, an entry on each line


def _is_number(text):
    try:
        float(text)
    except ValueError:
        return False
    return True


def _entries_of(section):
    """[(name, value, formula that a resolved case has behind it)] of the lines of a section of parameters."""
    found = []
    for line in section.splitlines():
        if entry := re.fullmatch(r"\s+([A-Za-z_]\w*):\s+(.+)", line):
            value, _, formula = entry[2].partition(FORMULA)
            found.append((entry[1], value.split(" #")[0].strip().strip("\"'"), formula.strip()))
    return found


def formulas(text):
    """{parameter: its formula} of a resolved case."""
    section = re.search(PARAMETERS, text, flags=re.MULTILINE)
    return {name: formula for name, _, formula in _entries_of(section[1] if section else "") if formula}


def without_formulas(text):
    return re.sub(f"{re.escape(FORMULA)}.*", "", text)


def with_formulas(resolved, written, overrides):
    """A resolved case with the formulas behind the numbers that they gave; `written`: the text of the case it was made from. Where that is
    itself resolved, its formulas hold no more when a parameter is set: numbers do not follow."""
    section = re.search(PARAMETERS, f"{written}\n", flags=re.MULTILINE)
    given = dict(pair.partition("=")[::2] for pair in overrides)
    same = not any(key.split(".")[0] == "parameters" for key in given)
    known = {name: value if not _is_number(value) else formula if same else "" for name, value, formula in _entries_of(section[1] if section else "")}
    known |= {key.removeprefix("parameters."): "" if _is_number(value) else value.strip() for key, value in given.items() if key.startswith("parameters.")}
    if "parameters" in given or not (target := re.search(PARAMETERS, resolved, flags=re.MULTILINE)):
        return resolved

    def told(line):
        name, _, value = line.strip().partition(": ")
        return f"{line}{FORMULA}{known[name]}" if known.get(name) and _is_number(value) else line
    return resolved[:target.start(1)] + "".join(f"{told(line)}\n" for line in target[1].splitlines()) + resolved[target.end(1):]


# --- the programs' answers

def _ask(verb, case, overrides, laws, *options):
    command = [paths.program("fsi_case"), verb, case, *options]
    command += [f"--set={override}" for override in overrides] + [f"--solid={law}" for law in laws]
    answer = answer_of(command, f"fsi: looking at the grids of {case}; where they do not fit, others are tried")
    if answer.returncode == 2:
        raise UserMistake(answer.stderr.strip() or "the case is wrong")
    if answer.returncode != 0:
        raise Failure(INTERNAL_ERROR, f"fsi_case failed ({answer.returncode}): {answer.stderr.strip()}")
    return answer.stdout


def check(case, overrides, laws):
    """One line about a case that is right. Throws UserMistake with file:line:column."""
    return _ask("check", case, overrides, laws).strip()


def resolve(case, overrides, laws, former=None):
    """The checked Case. `former`: the case of a run that it must be able to go on with. Throws UserMistake with
    file:line:column."""
    answer = json.loads(_ask("resolve", case, overrides, laws, *([f"--restart={former}"] if former else [])))
    written = Path(answer.get("path", ""))
    text = with_formulas(answer["resolved"], written.read_text(**AS_NAMED), overrides) if written.is_file() else answer["resolved"]
    return Case(name=answer["name"], text=text,
                programs={entry["name"]: entry["executable"] for entry in answer["participants"]},
                reference=answer["reference"]["kind"], expect=answer["expect"],
                end=answer["time"]["end"], times=tuple(answer["output_times"]),
                projection=answer["projection"], unused=tuple(answer["unused"]), remarks=tuple(answer["remarks"]), digest=answer["restart_digest"],
                cost={entry["program"]: entry for entry in answer["cost"]["programs"]})
