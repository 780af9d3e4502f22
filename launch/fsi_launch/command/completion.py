"""`fsi completion`: completion of the command line for bash, from the same parser that reads it."""

import argparse
import difflib

from fsi_launch import paths
from fsi_launch.gallery import problems

SCRIPT = """# Completion of AMP-FSI's command for bash: source <({command} completion)
_fsi() {{
  local word=${{COMP_WORDS[COMP_CWORD]}} verb=${{COMP_WORDS[1]}} words files=
  if ((COMP_CWORD == 1)); then
    words='{verbs}'
  else
    case $verb in
{cases}
    esac
  fi
  mapfile -t COMPREPLY < <(compgen -W "$words" -- "$word")
  [[ -z $files || $word == -* ]] || mapfile -t -O ${{#COMPREPLY[@]}} COMPREPLY < <(compgen -f -- "$word")
}}
complete -o filenames -F _fsi fsi ./launch/fsi launch/fsi
"""


def _verbs(parser):
    return next(action for action in parser._actions if isinstance(action, argparse._SubParsersAction)).choices  # noqa: SLF001


def _options(verb):
    actions = verb._actions  # noqa: SLF001  argparse has no other way to ask
    return [option for action in actions for option in action.option_strings if option.startswith("--")]


def meant(parser, verb, words):
    """The option of a verb that is most like the first of these words that is none of its own, or None."""
    unknown = next((word.partition("=")[0] for word in words if word.startswith("--")), "")
    return next(iter(difflib.get_close_matches(unknown, _options(_verbs(parser)[verb]), n=1)), None)


def _words(verb):
    """What may follow a verb: its options, and where it takes a case the names in configs/, where a problem those of the gallery."""
    actions = verb._actions  # noqa: SLF001
    words = _options(verb)
    if any(action.dest == "case" for action in actions):
        words += sorted(path.stem for path in (paths.ROOT / "configs").glob("*.yaml"))
    if any(action.dest == "problem" for action in actions):
        words += problems.names()
    return words


def script(parser):
    """The text of the script."""
    verbs = _verbs(parser)
    cases = "\n".join(f"      {name}) words='{' '.join(_words(verb))}' files=yes ;;" for name, verb in verbs.items())
    return SCRIPT.format(command=paths.COMMAND, verbs=" ".join(verbs), cases=cases)
