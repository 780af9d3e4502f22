"""The questions of `fsi new` on a terminal: one for each option of weight that was not given."""

import math
from dataclasses import dataclass
from pathlib import Path
from typing import Callable

from fsi_launch.failure import UserMistake
from fsi_launch.new import materials, outline

FLOWS = ("shock", "stream")
LAWS = ("neo_hookean", "saint_venant_kirchhoff", "linear_elastic", "rigid")


@dataclass
class Question:
    """What is asked for; `read` makes the value of the answer or throws UserMistake or ValueError."""

    option: str
    words: str
    default: Callable       # of the options: the text that an empty answer stands for
    read: Callable


def _number(text):
    value = float(text)
    if not (value > 0 and math.isfinite(value)):
        raise UserMistake("a finite number above 0, please")
    return value


def _one_of(choices):
    def read(text):
        if text not in choices:
            raise UserMistake(f"one of {', '.join(choices)}, please")
        return text
    return read


def _existing(text):
    outline.read(Path(text), straight=True)  # that there are enough for a curve is seen in the end
    return text


def _material(text):
    materials.material_of(text)
    return text


QUESTIONS = (
    Question("outline", "outline of the body: a file with x, y on each line; nothing for a circle", lambda options: "", _existing),
    Question("size", "its length [m]; nothing to take the file's numbers", lambda options: "" if options.outline else "0.1", _number),
    Question("flow", "what comes: a shock or a stream", lambda options: "shock", _one_of(FLOWS)),
    Question("mach", "its Mach number", lambda options: "0.5" if options.flow == "stream" else "1.3", _number),
    Question("material", f"material: {', '.join(materials.TABLE)}, or RHO,E,NU", lambda options: "aluminium", _material),
    Question("law", f"law: {', '.join(LAWS)}", lambda options: "neo_hookean", _one_of(LAWS)),
    Question("end", "end of the run [s]; nothing to choose it", lambda options: "", _number),
)


def _answer(question, options, ask, say):
    """The value of one answer, None where that is nothing; asks again until it can be read."""
    default = question.default(options)
    while True:
        text = ask(f"{question.words}{f' [{default}]' if default else ''}: ").strip() or default
        if not text:
            return None
        try:
            return question.read(text)
        except UserMistake as mistake:
            say(f"  {mistake}")
        except ValueError:
            say(f"  '{text}' is no number")


def ask_for_missing(options, ask=input, say=print):
    """Fills in the options that were not given. `ask` gives the answer to a text, `say` shows one."""
    say("A gas around a body, in SI units; the gas is air unless --density, --pressure or --gamma say otherwise.")
    for question in QUESTIONS:
        if getattr(options, question.option) is None:
            try:
                setattr(options, question.option, _answer(question, options, ask, say))
            except EOFError:
                raise UserMistake("no more answers; --defaults asks for none") from None
