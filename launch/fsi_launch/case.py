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

FORMULA = "    # formula: "      # in the text of a resolved case, between the number of a parameter and the formula of others that gave it
PARAMETER = re.compile(rf"^  (\w+): \S+{FORMULA}(.*)$", flags=re.MULTILINE)


def formulas(text):
    """{parameter: its formula} of a resolved case."""
    return dict(PARAMETER.findall(text))


def without_formulas(text):
    return PARAMETER.sub(lambda line: line[0].partition(FORMULA)[0], text)


def with_formulas(resolved, known):
    """The text of a resolved case with the formulas {parameter: formula} behind the numbers that they gave."""
    section, told = False, []
    for line in resolved.splitlines():
        section = line == "parameters:" or section and line.startswith(" ")
        formula = known.get(line.strip().partition(":")[0]) if section else None
        told.append(f"{line}{FORMULA}{formula}" if formula else line)
    return "\n".join([*told, ""])


def _kept(path, overrides):
    """The formulas that a case has which was resolved before: none where a parameter is set now, since its numbers do not follow."""
    if not path.is_file() or any(one.startswith("parameters") for one in overrides):
        return {}
    return formulas(path.read_text(**AS_NAMED))


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
    known = answer["formulas"] or _kept(Path(answer["path"]), overrides)
    return Case(name=answer["name"], text=with_formulas(answer["resolved"], known),
                programs={entry["name"]: entry["executable"] for entry in answer["participants"]},
                reference=answer["reference"]["kind"], expect=answer["expect"],
                end=answer["time"]["end"], times=tuple(answer["output_times"]),
                projection=answer["projection"], unused=tuple(answer["unused"]), remarks=tuple(answer["remarks"]), digest=answer["restart_digest"],
                cost={entry["program"]: entry for entry in answer["cost"]["programs"]})
