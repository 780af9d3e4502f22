"""`fsi gallery`: validated problems, each with its data, repeated by one command."""

import csv
import json
import re
from dataclasses import dataclass
from pathlib import Path

from fsi_launch import case as cases
from fsi_launch.failure import DONE, EXPECTATION_MISSED, UserMistake
from fsi_launch.gallery import problems
from fsi_launch.results import new_folder, whole_file
from fsi_launch.results.summary import aligned
from fsi_launch.telling import AS_NAMED

HEADING = ("quantity", "computed", "known", "allowed", "verdict")


@dataclass
class Row:
    """One comparison. `allowed` is a distance from `known`; where that is None, `allowed` is the largest value."""

    what: str
    computed: float
    known: float
    allowed: float

    def passes(self):
        if self.computed is None:
            return False
        return abs(self.computed - self.known) <= self.allowed if self.known is not None else self.computed <= self.allowed

    def texts(self):
        known = "" if self.known is None else f"{self.known:.5g}"
        allowed = f"at most {self.allowed:.3g}" if self.known is None else f"+- {self.allowed:.2g}"
        computed = "none" if self.computed is None else f"{self.computed:.5g}"
        return [self.what, computed, known, allowed, "pass" if self.passes() else "FAIL"]


def compare(problem, run):
    """(rows, curves) of a run in its folder; curves: [(entry, computed, known)]."""
    from fsi_launch.gallery import measures
    rows, curves = [], []
    for entry in problem.numbers:
        value = measures.number(run, entry["computed"])
        known = entry.get("known")
        rows.append(Row(entry["what"], value, known, entry["at_most"] if known is None else entry["within"]))
    for entry in problem.curves:
        table = measures.reference(problem.data())
        computed = measures.curve(run, entry["computed"])
        known = tuple(table[name] for name in entry["data"])
        rows.append(Row(f"{entry['what']}: mean distance", measures.distance(computed, known), None, entry["at_most"]))
        curves.append((entry, computed, known))
    return rows, curves


def _write_tables(directory, problem, rows):
    texts = [row.texts() for row in rows]
    with whole_file.writing(directory / "comparison.csv", newline="") as file:
        csv.writer(file, lineterminator="\n").writerows([HEADING, *texts])
    lines = [f"# {problem.title}", "", problem.source, "", f"`{problem.command()}`", "", f"| {' | '.join(HEADING)} |",
             "|" + "---|" * len(HEADING), *(f"| {' | '.join(text)} |" for text in texts)]
    whole_file.write(directory / "comparison.md", "\n".join(lines) + "\n")
    whole_file.write(directory / "comparison.json", json.dumps(
        {"problem": problem.name, "command": problem.command(), "passes": all(row.passes() for row in rows),
         "rows": [{"quantity": row.what, "computed": row.computed, "known": row.known, "allowed": row.allowed, "passes": row.passes()}
                  for row in rows]}, indent=2) + "\n")


def judge(problem, run, directory):
    """Compares a run, writes tables and a picture into the folder and prints the table; True if all passes."""
    from fsi_launch.plot.look import style
    from fsi_launch.gallery import measures, picture
    rows, curves = compare(problem, run)
    _write_tables(directory, problem, rows)
    if curves:
        style.use()
        others = {code: measures.reference(path) for code, path in problem.others().items()}
        style.save(picture.draw(problem, curves, others), directory / "comparison.png")
    print("\n".join(aligned([list(HEADING), *(row.texts() for row in rows)])))
    return all(row.passes() for row in rows)


def _but_what_is_expected(text):
    """The text of a resolved case without its `expect`: a run with another law has not all of it, and no number depends on it."""
    return re.sub(r"^expect:.*\n?(?:[ \t]+.*\n?|\n)*", "", cases.without_formulas(text), flags=re.MULTILINE).rstrip()


def _expect_run_of(problem, run):
    """In the folder `run` is a run of this problem that came to its end. Throws UserMistake."""
    try:
        status = json.loads((run / "summary.json").read_text(**AS_NAMED))["status"]
        text = (run / "case.yaml").read_text(**AS_NAMED)
    except (OSError, ValueError, LookupError, TypeError):
        raise UserMistake(f"--compare: there is no run in '{run}', or it has no summary; leave --compare away to make it") from None
    if status != "completed":
        raise UserMistake(f"--compare: the run in '{run}' is not whole, its status is {status!r}; add --overwrite in place of --compare to make it again")
    own = cases.resolve(problem.case, list(problem.set), list(problem.solid)).text
    if _but_what_is_expected(text) != _but_what_is_expected(own):
        from fsi_launch.plot.several_runs import several
        keys = several.different([several.entries(_but_what_is_expected(one)) for one in (own, text)])
        raise UserMistake(f"--compare: the run in '{run}' is none of {problem.name}{': its case differs in ' if keys else ''}{', '.join(keys[:3])}; "
                          "add --overwrite in place of --compare to make one, or name another --out")


def _list():
    shown = [problems.problem(name) for name in problems.names()]
    width = max(len(problem.name) for problem in shown)
    for problem in shown:
        print(f"{problem.name:{width}}  {problem.title}")
    return DONE


def main(options):
    """Lists the problems, or repeats one."""
    if options.problem is None:
        return _list()
    problem = problems.problem(options.problem)
    from fsi_launch import plot
    plot.style_or_mistake()
    if options.compare and not options.out:
        raise UserMistake("--compare: say which folder's run is to be compared, --out DIR")
    directory = Path(options.out) if options.out else new_folder.claimed(f"gallery-{problem.name}")
    run = directory / "run"
    if not options.compare:
        from fsi_launch.run import Request, run as start
        result = start(Request(case=problem.case, overrides=list(problem.set), laws=list(problem.solid), out=str(run),
                               overwrite=options.overwrite, progress=options.progress, judge=False))
        if result.code != DONE:
            return result.code
    else:
        _expect_run_of(problem, run)
    print(f"{problem.title}. {problem.source}")
    passed = judge(problem, run, directory)
    print(f"{'passes' if passed else 'FAILS'}; table and picture in {directory}")
    return DONE if passed else EXPECTATION_MISSED
