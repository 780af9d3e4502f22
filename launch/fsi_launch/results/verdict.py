"""What became of a run: which program was the cause when it failed, and what to say about it."""

import json
import re
import signal
from dataclasses import dataclass

from fsi_launch.failure import DONE, INTERRUPTED, OUTPUT_FAILED, PEER_LOST, TERMINATED

DISK_SIGNALS = (-signal.SIGXFSZ,)   # a file grew larger than the shell allows

# The words of a program whose peer's process is there no more (common/bus/peers/peer.cpp).
DEAD = re.compile(r"(?:the |solid |fluid )?'?([^\s']+)'? \(pid \d+(?: on \S+)?\) has died")

# Where in a run something failed, as the programs report it (common/io/place_json.hpp).
PLACE = ("program", "step", "t", "interface", "grid", "point", "position", "reference_position")


@dataclass
class Verdict:
    """`failure`: the record of summary.json, or None."""

    code: int
    status: str
    reason: str = ""
    failure: dict = None


def _is_consequence(ending):
    """Programs that end because another one did: by losing it, or by our signal."""
    return not ending.early and not (ending.cut and not ending.ours) and (ending.ours or ending.code in (PEER_LOST, INTERRUPTED, TERMINATED))


def root_cause(endings, origins=None):
    """The ending that made the others fail, or None when all went well. `origins`: whose failure each program reports; one
    that reports nothing says its own."""
    origins = origins or {}
    failures = [ending for ending in endings if ending.code != 0 or ending.early]
    causes = [ending for ending in failures if not _is_consequence(ending)] or failures
    own = [ending for ending in causes if origins.get(ending.name) == ending.name]
    unsaid = [ending for ending in causes if ending.name not in origins and not ending.ours]
    if own and unsaid:  # who is killed says nothing, nor does a program of somebody else's that ends as it is told
        unsaid = [ending for ending in unsaid if ending.lost() or ending.early or ending.code not in {one.code for one in own}]
    first = sorted(own + unsaid, key=endings.index)
    return next(iter(first or causes), None)


def _last_line(directory, name):
    """The last words of a program, for when it left no reason."""
    try:
        lines = (directory / "log" / f"{name}.out").read_text(encoding="utf-8", errors="replace").split("\n")
    except OSError:
        return ""
    told = [line.strip() for line in lines if line.strip("- ")]
    for k in reversed(range(len(told))):
        if told[k].startswith(("mpirun noticed", "prterun noticed")):
            return told[k] if told[k].endswith(".") else " ".join(told[k:k + 2])    # Open MPI 5 breaks it in two
    return told[-1] if told else ""


def _last_words(directory, name):
    words = _last_line(directory, name)
    return f"; its last words: {words}" if words else ""


def _of_ranks(name, directory, reason):
    """The reason of a participant with ranks: where one lost another one that could still say why it ended, that is why. Who goes on
    after it had been stopped finds that the others have ended; that is no reason."""
    chain, seen = [reason], {"0"}  # the first reason is that of rank 0
    while (found := re.search(rf"lost rank (\d+) of {re.escape(name)} ", chain[-1])) and found.group(1) not in seen:
        seen.add(found.group(1))
        try:
            left = json.loads((directory / "parts" / f"{name}.rank{found.group(1)}.json").read_text(encoding="utf-8"))
        except (OSError, ValueError):
            break
        chain.append(left.get("reason") or chain[-1])
    return next((one for one in reversed(chain) if not one.endswith(": it has ended")), chain[-1])


def _label(name, case):
    program = case.programs.get(name, name)
    return name if program == name else f"{name} ({program})"


def _seen_dead(ending, case, part):
    """The participant that this one saw dead before its own end was known: mpirun has its time to tell of its ranks."""
    found = DEAD.fullmatch(part.get("reason") or "")
    return found.group(1) if found and found.group(1) in case.programs and part.get("origin", ending.name) == ending.name else None


def _explain(ending, case, directory, part, endings):
    """(exit code, reason) of the run from the ending that caused it. `part`: what that program left."""
    label = _label(ending.name, case)
    if dead := _seen_dead(ending, case, part):
        how = f"{ending.name} saw that it had died"
        if any(one.name == dead and one.code == 0 for one in endings):
            how = "it ended with exit code 0 before the run was over"
        return PEER_LOST, f"lost {_label(dead, case)}: {how}{_last_words(directory, dead)}"
    if ending.lost():
        name = signal.Signals(-ending.code).name
        code = OUTPUT_FAILED if ending.code in DISK_SIGNALS else PEER_LOST
        if part.get("reason"):  # of several ranks one was killed, and another one could say which
            return code, f"{_of_ranks(ending.name, directory, part['reason'])}: {name}"
        return code, f"lost {label}: ended by {name}{_last_words(directory, ending.name)}"
    if ending.early:
        return PEER_LOST, (f"lost {label}: it ended before the run began, with exit code {ending.code}"
                           f"{_last_words(directory, ending.name)}")
    if ending.cut:
        return PEER_LOST, f"lost {label}: {ending.cut}{_last_words(directory, ending.name)}"
    if ending.ours and not (ending.code == PEER_LOST and part.get("reason")):  # who had lost another one was ending already
        return PEER_LOST, f"lost {label}: it did not end by itself" + "; somebody had stopped it" * ending.stopped
    reason = _of_ranks(ending.name, directory, part.get("reason") or _last_line(directory, ending.name))
    code = ending.code if ending.code in range(1, 6) else PEER_LOST
    if part.get("origin", ending.name) != ending.name:
        return code, reason
    reason = reason or f"exit code {ending.code}"
    if code == PEER_LOST and len(case.programs) == 1:  # it had nobody to lose but itself
        return code, f"lost {label}: {reason}"
    return code, f"{ending.name}: {reason}"


def _record(ending, parts, code, what, case):
    """The failure of a run for summary.json. `origin`: the participant where it began."""
    part = parts.get(ending.name, {})
    known = part.get("failure") or {}
    return {"origin": _seen_dead(ending, case, part) or part.get("origin") or ending.name, "told_by": ending.name, "exit_code": code,
            "signal": signal.Signals(-ending.code).name if ending.lost() else None,
            "what": known.get("what") or part.get("reason") or what} | {key: known.get(key) for key in PLACE}


def _all_done(outcome, case):
    """Every program of the run has ended well."""
    return {ending.name for ending in outcome.endings if ending.code == 0 and not ending.early} >= set(case.programs)


def judge(outcome, case, directory, parts):
    """The Verdict on a run whose programs have all ended. `parts`: what they left."""
    if outcome.signal and not _all_done(outcome, case):
        if outcome.signal == signal.SIGINT:
            return Verdict(INTERRUPTED, "failed", "interrupted (Ctrl-C)")
        return Verdict(TERMINATED, "failed", f"ended on request ({signal.Signals(outcome.signal).name})")
    origins = {name: part["origin"] for name, part in parts.items() if part.get("origin")}
    if cause := root_cause(outcome.endings, origins):
        code, reason = _explain(cause, case, directory, parts.get(cause.name, {}), outcome.endings)
        return Verdict(code, "failed", reason, _record(cause, parts, code, reason, case))
    for part in parts.values():
        if part.get("status") == "stopped":
            return Verdict(DONE, "stopped", part.get("reason") or "stopped on request")
    if not parts:   # a program of somebody else's, alone
        ending = next(one for one in outcome.endings if one.name in case.programs)
        reason = f"lost {ending.name}: it ended without a word, and left no report{_last_words(directory, ending.name)}"
        return Verdict(PEER_LOST, "failed", reason, _record(ending, parts, PEER_LOST, reason, case))
    return Verdict(DONE, "completed")
