"""`fsi submit`: a script for Slurm that runs a case on nodes of a cluster.

With several nodes it is a heterogeneous job, whose components start together: the first has the launcher, the coupler and whoever has no
node of his own; each of the others one program, which the launcher reaches by srun.
"""

import os
import re
import shlex
from pathlib import Path

from fsi_launch import case as cases
from fsi_launch import paths
from fsi_launch.failure import DONE, UserMistake
from fsi_launch.living import ranks
from fsi_launch.living.hosts import COUPLER
from fsi_launch.results import whole_file
from fsi_launch.telling import tell

CHECKPOINT_BEFORE = 120     # [s] before the end of the time that was asked for: two steps and a checkpoint
TIME = r"\d+(:\d{1,2}){0,2}|\d+-\d{1,2}(:\d{1,2}){0,2}"     # as sbatch takes it


def _apart(case, asked, nodes):
    """Participants with a node of their own: those with most ranks, gases before solids."""
    solvers = [name for name in case.programs if name != COUPLER]
    if nodes > 1 and COUPLER not in case.programs:
        raise UserMistake(f"submit: this case has a single program, which takes one node; leave --nodes {nodes} away")
    if nodes > len(solvers) + 1:
        raise UserMistake(f"submit: --nodes {nodes}, but there are {len(solvers)} programs besides the coupler: one node more than those at "
                          "most")
    def weight(name):
        return -asked.get(name, 1), case.programs[name] != ranks.GAS
    return sorted(solvers, key=weight)[:nodes - 1]


def _component(cores, options):
    return [f"#SBATCH --nodes=1 --ntasks=1 --cpus-per-task={cores}", *(f"#SBATCH {option}" for option in options)]


def _header(case, asked, apart, options):
    """What is asked of Slurm."""
    here = sum(asked.get(name, 1) for name in case.programs if name not in apart and name != COUPLER)
    lines = ["#!/bin/bash", f"# {case.name}, by fsi submit: sbatch takes this file.",
             f"#SBATCH --job-name={case.name}", f"#SBATCH --output={case.name}-%j.out"]
    if options.time:
        lines += [f"#SBATCH --time={options.time}", f"#SBATCH --signal=B:TERM@{CHECKPOINT_BEFORE}"]
    lines += _component(max(here, 1), options.option)
    for name in apart:
        lines += ["#SBATCH hetjob", *_component(asked.get(name, 1), options.option)]
    return lines


def _places(apart):
    """Lines that make `hosts`: who runs on another node than this one."""
    if not apart:
        return []
    shell = shlex.quote(str(paths.ROOT / "launch" / "slurm_shell"))  # a line for a shell, as FSI_RSH is; quoted once more for this one
    lines = ["", f"export FSI_RSH={shlex.quote(shell)}", "hosts=''",
             'first() { local nodes; mapfile -t nodes < <(scontrol show hostnames "$1"); echo "${nodes[0]}"; }', 'here=$(first "$SLURM_JOB_NODELIST_HET_GROUP_0")',
             "add() {  # NAME GROUP NODES",
             '  local node; node=$(first "$3")',
             '  [[ $node == "$here" ]] || hosts+="${hosts:+,}$1=$2@$node"', "}"]
    return lines + [f'add {shlex.quote(name)} {group} "$SLURM_JOB_NODELIST_HET_GROUP_{group}"' for group, name in enumerate(apart, 1)]


def script(case, options):
    """The text. `options`: of the command line."""
    if options.time and not re.fullmatch(TIME, options.time):
        raise UserMistake(f"submit: --time {options.time} is no time for Slurm; write minutes, HH:MM:SS or DAYS-HH")
    if options.ranks == "auto":
        raise UserMistake("submit: --ranks auto counts the cores of this machine; write --ranks NAME=N,..")
    asked = ranks.wanted(options.ranks, case)
    apart = _apart(case, asked, options.nodes)
    words = [str(paths.ROOT / "launch" / "fsi"), "run", options.case, "--no-progress"]
    words += [f"--set={override}" for override in options.overrides] + [f"--solid={law}" for law in options.laws]
    words += [*(["--ranks", options.ranks] if options.ranks else []), *(["--out", options.results] if options.results else [])]
    hosts = ' ${hosts:+--hosts "$hosts"}' if apart else ""
    return "\n".join([
        *_header(case, asked, apart, options), "", "set -euo pipefail", f"cd {shlex.quote(os.getcwd())}",
        f"export FSI_BIN={shlex.quote(str(paths.BIN.resolve()))}", *_places(apart), "",
        "trap 'kill -TERM $(jobs -p) 2> /dev/null || true' TERM   # the run writes a checkpoint, and ends",
        f"{shlex.join(words)}{hosts} &", "run=$!",
        "code=0", 'wait "$run" || code=$?', 'while kill -0 "$run" 2> /dev/null; do code=0; wait "$run" || code=$?; done', 'exit "$code"', ""])


def main(options):
    """Writes it, or prints it."""
    text = script(cases.resolve(options.case, options.overrides, options.laws), options)
    if options.print:
        print(text, end="")
        return DONE
    path = Path(options.out or f"{Path(options.case).stem}.sbatch")
    if path.exists() and not options.overwrite:
        raise UserMistake(f"submit: {path} is there already; name another --out, or add --overwrite")
    whole_file.write(path, text)
    tell(f"{path}: sbatch {shlex.quote(str(path))} submits it (docs/scaling.md)")
    return DONE
