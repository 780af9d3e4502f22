"""A case as `fsi_case` reads and checks it: the only reader of case files is in C++."""

import json
from dataclasses import dataclass, field

from fsi_launch import paths
from fsi_launch.failure import Failure, INTERNAL_ERROR, UserMistake
from fsi_launch.telling import answer_of

REFERENCE_PROGRAMS = {  # reference kinds computed by a program of their own
    "piston_1d": "reference_piston",
    "rotating_disk": "reference_disk",
}
EXACT_KINDS = ("elastic_piston", "riemann", "wall_between_gases", "clamped_wall")   # whose solution reference_exact writes beside a run


@dataclass
class Case:
    """What the launcher needs to know. `text` is the resolved case: parameters and overrides filled in."""

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
    return Case(name=answer["name"], text=answer["resolved"],
                programs={entry["name"]: entry["executable"] for entry in answer["participants"]},
                reference=answer["reference"]["kind"], expect=answer["expect"],
                end=answer["time"]["end"], times=tuple(answer["output_times"]),
                projection=answer["projection"], unused=tuple(answer["unused"]), remarks=tuple(answer["remarks"]), digest=answer["restart_digest"],
                cost={entry["program"]: entry for entry in answer["cost"]["programs"]})
