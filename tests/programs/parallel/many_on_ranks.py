"""Many runs on several ranks, by hand (test_ranks.py --all, --in-turn, --restarts, --kills): all shipped cases, on ranks and from checkpoints of
other ranks, and somebody who is killed at a random moment.
"""

import json
import os
import random
import re
import shutil
import signal
import subprocess
import tempfile
from pathlib import Path

from comparing import health, numbers, results
from running import BIN, Launched, ROOT, let_pass, processes, until
from fsi_launch.living.ranks import knows_ranks

# Cases that the tests of test_ranks.py have on several numbers of ranks: `--in-turn` leaves them out where none is named.
TESTED = ("bar_on_wall", "elastic_piston", "isentropic_vortex", "manufactured_piston", "shock_ellipse", "sod_tube", "solid_manufactured")

# Other rows for everybody after so many steps, in whatever way.
RECUT = "from fsi_launch.living import ranks\nranks.EXTRA = ['--recut', '{every}']\n"

# A run that lasts, with a gas of two ranks.
LASTING = ("elastic_piston", "--set", "grid.factor=2", "--set", "time.dt=1e-7", "--set", "output.times=[1e-6, 0.8]", "--set",
           "expect={}", "--ranks", "fluid=2")


def few_steps(case, steps):
    """Options for a run of about so many steps."""
    answer = subprocess.run([BIN / "fsi_case", "check", case], capture_output=True, text=True, check=True, cwd=ROOT).stdout
    steps_of = re.search(r"steps? of ([0-9.e+-]+)[;,\s]", answer)
    if steps_of is None:
        return ["--set", "expect={}", "--set", "output.checkpoint_at_end=true"]
    end = steps * float(steps_of.group(1))
    return ["--set", f"time.end={end:.6g}", "--set", f"output.times=[{end / 2:.6g}, {end:.6g}]", "--set", "expect={}",
            "--set", "output.checkpoint_at_end=true"]


def digest_of(directory):
    """What two runs must have in common: files, numbers, the state in the checkpoint."""
    import h5py
    state = {}
    for path in sorted(directory.glob("checkpoints/*/*.h5")):
        with h5py.File(path) as file:
            def take(name, one, of=path.name):
                if isinstance(one, h5py.Dataset) and "report" not in name:
                    state[of, name] = one[()].tobytes()
            file.visititems(take)
    run = Launched.__new__(Launched)
    run.directory = directory
    return results(directory), numbers(run.summary()), health(directory), state


def shipped(cases):
    """(path, name, who can have ranks) of the shipped cases where somebody can, or those of them that are named."""
    for path in sorted((ROOT / "configs").glob("*.yaml")):
        if path.stem == "template" or cases and path.stem not in cases:
            continue
        told = json.loads(subprocess.run([BIN / "fsi_case", "resolve", path], capture_output=True, text=True, check=True, cwd=ROOT).stdout)
        able = [one["name"] for one in told["participants"] if knows_ranks(one["executable"])]
        if able:
            yield path, path.stem, able


def on_ranks(able, number):
    return ["--ranks", ",".join(f"{name}={number}" for name in able)] if number > 1 else []


def restart_all(numbers_of_ranks, cases, steps=16):
    """The names of cases whose restart on other ranks is not the run that was never interrupted."""
    failed = []
    for path, case, able in shipped(cases):
        with tempfile.TemporaryDirectory() as scratch:
            options = few_steps(f"configs/{path.name}", steps)
            whole = Launched(Path(scratch), case, *options, out="whole")
            verdicts = [] if whole.wait() == 0 else [f"1: {whole.stderr.strip().splitlines()[-1]}"]
            for before, after in zip(numbers_of_ranks, [*numbers_of_ranks[1:], numbers_of_ranks[0]]):
                if verdicts and "same" not in verdicts[-1]:
                    break
                verdicts.append(restarted(Path(scratch), case, [*options, *on_ranks(able, before)], on_ranks(able, after), whole))
                verdicts[-1] = f"{before} -> {after}: {verdicts[-1]}"
        failed += [] if all("same" in verdict for verdict in verdicts) else [case]
        print(f"{case:25} {', '.join(verdicts)}", flush=True)
    return failed


def restarted(scratch, case, options, ranks, whole):
    """What became of a run that goes on from its first checkpoint on other ranks, in a word."""
    for every in (10, 4, 2):    # of few steps
        run = Launched(scratch, case, *options, "--set", f"output.checkpoint_every={every}", out=f"run{len(list(scratch.iterdir()))}")
        if run.wait() != 0:
            return run.stderr.strip().splitlines()[-1]
        if len(run.checkpoints()) > 1:
            break
    for step in run.checkpoints()[1:]:
        shutil.rmtree(next(one for one in run.directory.glob("checkpoints/*") if int(one.name) == step))
    again = Launched(scratch, "--restart", str(run.directory), *ranks, out=None)
    again.directory = run.directory
    if again.wait() != 0:
        return again.stderr.strip().splitlines()[-1]
    same = [mine == its for mine, its in zip(digest_of(whole.directory)[:3], digest_of(again.directory)[:3])]
    return f"same from step {run.checkpoints()[0]}" if all(same) else f"DIFFERENT {same}"


def compare(name, case_file, able, layouts, steps):
    """What became of one case on each layout, (ranks, rows anew after so many steps or 0), the first of which the others must repeat."""
    verdicts, whole = [], None
    for number, every in layouts:
        with tempfile.TemporaryDirectory() as scratch:
            run = Launched(Path(scratch), name, *few_steps(case_file, steps), *on_ranks(able, number),
                           script=RECUT.format(every=every) if every else None)
            if run.wait() != 0:
                verdicts.append(f"{number}: {run.stderr.strip().splitlines()[-1]}")
                break
            found = digest_of(run.directory)
        whole = whole or found
        same = [mine == its for mine, its in zip(whole, found)]
        verdicts.append(f"{number}{'*' if every else ''}: {'same' if all(same) else f'DIFFERENT {same}'}")
    print(f"{name:25} {', '.join(verdicts)}", flush=True)
    return all("same" in verdict for verdict in verdicts)


def compare_all(numbers_of_ranks, cases, steps=16):
    """The names of cases that differ on some number of ranks, or where rows are shared out anew."""
    layouts = [(1, 0), *((number, 0) for number in numbers_of_ranks), (numbers_of_ranks[-1], 5)]
    return [case for path, case, able in shipped(cases) if not compare(case, f"configs/{path.name}", able, layouts, steps)]


def compare_in_turn(numbers_of_ranks, cases, steps=8):
    """The same with one of the numbers for each case, by turns, and rows shared out anew in every second round."""
    failed = []
    for k, (path, case, able) in enumerate(one for one in shipped(cases) if cases or one[1] not in TESTED):
        number, again = numbers_of_ranks[k % len(numbers_of_ranks)], 3 * (k // len(numbers_of_ranks) % 2)
        if not compare(case, f"configs/{path.name}", able, [(1, 0), (number, again)], steps):
            failed.append(case)
    return failed


def kill_again_and_again(runs, seed):
    """The number of runs that did not end as they should."""
    chance, failed = random.Random(seed), 0
    for number in range(runs):
        with tempfile.TemporaryDirectory() as scratch:
            run = Launched(Path(scratch), *LASTING[:-1], "fluid=2,solid=2")
            run.until_stepping()
            let_pass(chance.uniform(0, 0.5))
            ranks = {f"rank {rank} of {name}": int(pid) for name in ("fluid", "solid")
                     for rank, pid in re.findall(r"rank (\d+) is process (\d+)", run.log(name))}
            others = {f"{one.program} of {one.name}": one.pid for one in processes.programs_of(run.directory)
                      if one.pid not in ranks.values()}
            who, pid = chance.choice(sorted((ranks | others).items()))
            word = chance.choice(["SIGKILL", "SIGKILL", "SIGSTOP"]) if "mpirun" not in who else "SIGKILL"
            os.kill(pid, signal.Signals[word])
            code, reason = run.wait(), run.summary()["reason"]
            gone = until(lambda: not run.leftovers() and not any(Path(f"/proc/{one}").exists() for one in ranks.values()))
            sound = code == 4 and gone and who.split()[-1] in reason
            failed += 0 if sound else 1
            print(f"{number:4} {word} {who:28} exit {code}: {'' if sound else 'WRONG '}{reason}", flush=True)
    return failed
