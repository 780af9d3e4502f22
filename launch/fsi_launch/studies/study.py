"""`fsi study`: the same case with every combination of some of its values; what came out as text, markdown, CSV, JSON and a picture.

Runs that are there already, of the same case by the same build of the programs, are not made again: a study that was interrupted goes on by the same command.
"""

import csv
import itertools
import json
import math
import os
import re
import subprocess
import time
import zlib
from dataclasses import dataclass, field
from pathlib import Path

from fsi_launch import case as cases, paths, version
from fsi_launch.failure import DONE, EXPECTATION_MISSED, UserMistake
from fsi_launch.living.supervise import leashed
from fsi_launch.run import needed
from fsi_launch.results import new_folder, whole_file
from fsi_launch.results.summary import aligned, value_at
from fsi_launch.telling import AS_NAMED, tell

LOOK = 0.05             # [s] between two looks at the runs that are going on
STATISTICS = {"last": lambda values: values[-1], "min": lambda values: min(_known(values), default=None),
              "max": lambda values: max(_known(values), default=None)}
OF_A_BODY = ("centre1", "centre2", "angle")     # shown where there are no errors


@dataclass
class Trial:
    """One combination of values, and what became of it."""

    values: dict            # {key of the case: text}
    directory: Path
    case: cases.Case = None
    seconds: float = 0.0
    code: int = None        # exit code of its run; None: not yet
    summary: dict = field(default_factory=dict)
    former: dict = field(default_factory=dict)  # {file: moment} of what lay in its folder before its run began

    def name(self):
        return self.directory.name

    def files(self, pattern):
        """Files of its folder that are its own run's: one that is refused leaves those of the run before it."""
        return [path for path in sorted(self.directory.glob(pattern)) if self.former.get(path.name) != _moment(path)]

    def table(self, name):
        """Path of one of its tables, or None."""
        return next((path for path in self.files("*.csv") if path.stem == name), None)


# --- what is asked for


def values_of(text):
    """(key, values) of KEY=VALUE,VALUE,..; a comma within brackets belongs to a value."""
    key, found, rest = text.partition("=")
    values, depth = [""], 0
    for letter in rest:
        depth += (letter in "[{(") - (letter in "]})")
        if letter == "," and depth == 0:
            values.append("")
        else:
            values[-1] += letter
    values = [value.strip() for value in values]
    if not found or not key.strip() or not all(values):
        raise UserMistake(f"--vary {text}: write KEY=VALUE,VALUE,.., as --vary parameters.rho_bar=0.1,1,10")
    return key.strip(), values


def _moment(path):
    """What changes when a file is written anew."""
    found = path.stat()
    return found.st_mtime_ns, found.st_ino


LONGEST_NAME, KEPT = 200, 120    # [byte] of a folder; of a longer one so much is kept


def _folder_name(values, short):
    said = ",".join(f"{short[key]}={value}" for key, value in values.items())
    name = re.sub(r"[^\w.,=+-]", "_", said)
    if len(os.fsencode(name)) <= LONGEST_NAME:
        return name
    return f"{os.fsencode(name)[:KEPT].decode(errors='ignore')}-{zlib.crc32(said.encode(errors='surrogateescape')):08x}"


def trials(vary, directory):
    """All combinations, the last key varying fastest. `vary`: {key: values}"""
    last = [key.rpartition(".")[2] for key in vary]
    short = {key: one if last.count(one) == 1 else key for key, one in zip(vary, last)}
    found = []
    for combination in itertools.product(*vary.values()):
        values = dict(zip(vary, combination))
        found.append(Trial(values, Path(directory) / _folder_name(values, short)))
    if len({trial.directory for trial in found}) < len(found):
        raise UserMistake("--vary names a value twice, or values that differ in letters no folder can have")
    return found


def _overrides(trial, options):
    return [*options.overrides, *(f"{key}={value}" for key, value in trial.values.items())]


def _finished(trial):
    """True if a former study has made this run, with the same case and this build of the programs."""
    try:
        summary = json.loads((trial.directory / "summary.json").read_text(**AS_NAMED))
        same = (trial.directory / "case.yaml").read_text(**AS_NAMED) == trial.case.text
    except (OSError, ValueError):
        return False
    if same and summary.get("status") == "completed" and summary.get("build") == version.built():
        trial.summary, trial.code = summary, DONE
    return trial.code is not None


# --- the runs


def _start(trial, options):
    trial.former = {path.name: _moment(path) for pattern in ("summary.json", "*.csv") for path in trial.directory.glob(pattern)}
    command = [str(paths.ROOT / "launch" / "fsi"), "run", options.case, "--no-progress", "--overwrite", "--out", str(trial.directory)]
    command += [f"--set={override}" for override in _overrides(trial, options)] + [f"--solid={law}" for law in options.laws]
    return subprocess.Popen(leashed(command), stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, **AS_NAMED,
                            env=os.environ | {"FSI_BIN": str(paths.BIN)})


def _end(trial, process, started):
    trial.code, trial.seconds = process.returncode, time.monotonic() - started
    said = process.stderr.read().strip().splitlines()
    process.stderr.close()
    said = [line for line in said if line.startswith("fsi: ")] or said
    own = trial.files("summary.json")
    trial.summary = json.loads(own[0].read_text(**AS_NAMED)) if own else {
        "status": "failed", "reason": said[-1].removeprefix("fsi: ") if said else ""}
    if trial.code == EXPECTATION_MISSED and trial.summary["status"] == "completed":
        trial.code = DONE   # what the case expects holds for its own values


def _describe(trial, count, total):
    text = f"{count}/{total}  {trial.name()}: {trial.summary['status']}, {trial.seconds:.1f} s"
    return text if trial.code == DONE else f"{text}: {trial.summary.get('reason')}"


def _make(waiting, options, done, total):
    """Runs the trials, options.jobs at a time."""
    waiting, going = list(waiting), []
    try:
        while waiting or going:
            while waiting and len(going) < options.jobs:
                trial = waiting.pop(0)
                going.append((trial, _start(trial, options), time.monotonic()))
            for entry in [entry for entry in going if entry[1].poll() is not None]:
                going.remove(entry)
                _end(*entry)
                if entry[0].code == DONE:
                    _expect_shown(entry[0], options.show)
                done += 1
                tell(_describe(entry[0], done, total))
            time.sleep(LOOK)
    finally:
        for _, process, _ in going:
            process.terminate()
        for _, process, _ in going:
            process.communicate()


# --- what came out


def _finite(value):
    """A number that JSON can say; None in the place of any other, and of words."""
    return value if isinstance(value, (int, float)) and math.isfinite(value) else None


def _number(text):
    try:
        return _finite(float(text))
    except (TypeError, ValueError):
        return None


def _known(values):
    return [value for value in values if value is not None]


def _columns(path):
    """{name: heading} of a table's columns; the unit behind the name is not part of it."""
    with open(path, **AS_NAMED, newline="") as file:
        return {heading.split(" ")[0]: heading for heading in next(csv.reader(file), [])}


def _of_table(path, column, statistic):
    heading = _columns(path).get(column)
    with open(path, **AS_NAMED, newline="") as file:
        values = [_number(row[heading]) for row in csv.DictReader(file)] if heading else []
    return STATISTICS[statistic](values) if values else None


def _expect_shown(trial, wanted):
    """A quantity that a completed run cannot have ends the study at once: the others would lack it too."""
    for name in wanted:
        path = name.partition(":")[0]
        table, _, column = path.partition(".")
        if value_at(trial.summary, path) is not None or table == "errors":
            continue        # a run without errors may still be followed by one that has them
        file = trial.table(table)
        if not file and table not in trial.summary:
            tables = ", ".join(one.stem for one in trial.files("*.csv"))
            raise UserMistake(f"--show {name}: there is no {table!r} in summary.json and no such table; there are {tables}")
        if file and column not in _columns(file):
            raise UserMistake(f"--show {name}: {table} has no column {column!r}; it has {', '.join(_columns(file))}")


def quantity(trial, wanted):
    """The number behind a path of summary.json like errors.rho, or behind TABLE.COLUMN[:last|min|max] of one of the run's
    tables like forces_disk.angle:max; None where there is none. What is no finite number is left out of min and max."""
    path, _, statistic = wanted.partition(":")
    value = value_at(trial.summary, path)
    if isinstance(value, (int, float)):
        return _finite(value)
    table, _, column = path.partition(".")
    file = trial.table(table)
    return _of_table(file, column, statistic or "last") if file else None


def unit(found, wanted):
    """The unit of a column of a table, in the words of its heading; "" of anything else."""
    table, _, column = wanted.partition(":")[0].partition(".")
    file = next((file for trial in found if (file := trial.table(table))), None)
    heading = _columns(file).get(column, "") if file else ""
    return heading.partition(" [")[2].rstrip("]")


def _shown(found, wanted):
    """The quantities of the table: those asked for, or all errors, or where the bodies are at the end."""
    if wanted:
        return wanted
    errors = list(dict.fromkeys(f"errors.{name}" for trial in found for name in trial.summary.get("errors", {})))
    tables = sorted({path.stem for trial in found for path in trial.files("forces_*.csv")})
    return errors or [f"{table}.{column}" for table in tables for column in OF_A_BODY]


def result_of(found, case, vary, wanted):
    """The content of study.json."""
    shown = _shown(found, wanted)
    rows = [{"values": trial.values, "folder": trial.name(), "status": trial.summary["status"], "t": _finite(trial.summary.get("t")),
             "steps": trial.summary.get("steps"), "wall_s": _finite(trial.summary.get("wall_s")),
             "quantities": {name: quantity(trial, name) for name in shown}} for trial in found]
    return {"case": case, "vary": vary, "quantities": shown, "units": {name: unit(found, name) for name in shown}, "rows": rows}


def _cell(value):
    return "-" if value is None else value if isinstance(value, str) else f"{value:.4g}"


def _rows(result):
    rows = [[*result["vary"], "status", "t", "steps", "wall [s]", *result["quantities"]]]
    for row in result["rows"]:
        rows.append([*row["values"].values(), row["status"], *map(_cell, (row["t"], row["steps"], row["wall_s"])),
                     *map(_cell, row["quantities"].values())])
    return rows


def as_markdown(result):
    heading, *body = ["| " + " | ".join(row) + " |" for row in _rows(result)]
    return "\n".join([heading, "|" + "---|" * (heading.count("|") - 1), *body]) + "\n"


def _write_csv(result, path):
    with whole_file.writing(path, newline="") as file:
        writer = csv.writer(file)
        writer.writerow([*result["vary"], "status", "t", "steps", "wall_s", *result["quantities"]])
        for row in result["rows"]:
            writer.writerow([*row["values"].values(), row["status"], row["t"], row["steps"], row["wall_s"], *row["quantities"].values()])


def _draw(result, directory, cases_of_runs):
    """True where there was something to draw. The picture of another table is gone."""
    (directory / "study.png").unlink(missing_ok=True)
    from fsi_launch.plot.look import style, units
    from fsi_launch.plot.several_runs import several, study
    style.use()
    units.use_those_of([several.entries(text) for text in cases_of_runs])
    drawn = list(study.pictures(result))
    for name, figure in drawn:
        style.save(figure, directory / f"{name}.png")
    return bool(drawn)


def _made(out, name):
    """The folder of the study: the one that was named, or a new one."""
    if out:
        Path(out).mkdir(parents=True, exist_ok=True)
        return Path(out)
    return new_folder.claimed(f"study-{name}")


def _expect_used(vary, found):
    """Throws UserMistake where a parameter is varied that no trial needs: their runs would all be alike."""
    for key in vary:
        section, _, name = key.partition(".")
        if section == "parameters" and all(name in trial.case.unused for trial in found):
            raise UserMistake(f"--vary {key}: no other value of the case needs this parameter, and all runs would be alike; write it where it is meant")


def main(options):
    """Runs the study, prints its table and writes study.{txt,md,csv,json,png}."""
    vary = dict(map(values_of, options.vary))
    if len(vary) < len(options.vary):
        raise UserMistake("--vary names a key twice; write all its values behind one")
    for wanted in options.show:
        if (statistic := wanted.partition(":")[2]) and statistic not in STATISTICS:
            raise UserMistake(f"--show {wanted}: write {', '.join(STATISTICS)} behind the colon")
    name = cases.resolve(options.case, options.overrides, options.laws).name
    found = trials(vary, "")
    for trial in found:     # a mistake in the last one must not show after hours
        trial.case = cases.resolve(options.case, _overrides(trial, options), options.laws)
    _expect_used(vary, found)
    paths.build([program for trial in found for program in needed(trial.case)])
    directory = _made(options.out, name)
    for trial in found:
        trial.directory = directory / trial.directory
    waiting = [trial for trial in found if not _finished(trial)]
    if done := len(found) - len(waiting):
        tell(f"{done} of {len(found)} runs are there already")
    for trial in found:
        if trial.code == DONE:
            _expect_shown(trial, options.show)
    _make(waiting, options, done, len(found))
    result = result_of(found, name, vary, options.show)
    text = "\n".join(aligned(_rows(result))) + "\n"
    print(text, end="")
    whole_file.write(directory / "study.txt", text)
    whole_file.write(directory / "study.md", as_markdown(result))
    whole_file.write(directory / "study.json", json.dumps(result, indent=2) + "\n")
    _write_csv(result, directory / "study.csv")
    drawn = _draw(result, directory, [trial.case.text for trial in found])
    tell(f"tables{' and picture' if drawn else ''} in {directory}")
    return next((trial.code for trial in found if trial.code != DONE), DONE)
