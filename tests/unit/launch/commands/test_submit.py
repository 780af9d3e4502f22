#!/usr/bin/python3
"""`fsi submit`: what is asked of Slurm, and that the script does its work where stand-ins take the place of Slurm's commands."""

import os
import shutil
import signal
import subprocess
import sys
import unittest
from argparse import Namespace
from pathlib import Path
from types import SimpleNamespace
from unittest import mock

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from launcher import InScratch  # noqa: E402
from fsi_launch import paths, submit  # noqa: E402
from fsi_launch.failure import UserMistake  # noqa: E402

CASE = SimpleNamespace(name="shock", programs={"fluid": "fluid_solver", "disk": "solid_solver_svk", "plate": "solid_solver_beam",
                                               "coupler": "coupler"})
STANDALONE = SimpleNamespace(name="sod", programs={"fluid": "fluid_solver"})

SLURM = {
    "scontrol": '[ "$1 $2" = "show hostnames" ] || exit 9\necho "$3" | sed "s/\\[0*\\([0-9]*\\).*/\\1/"\necho another\n',
    "srun": 'echo "$@" > "$FOLDER/srun"\nfor last; do :; done\nexec sh -c "$last"\n',
}


def options(**given):
    return Namespace(**{"case": "shock", "overrides": [], "laws": [], "nodes": 1, "ranks": None, "time": None, "option": [], "results": None,
                        "out": None, "print": False, "overwrite": False} | given)


class Script(unittest.TestCase):
    def asked(self, case=CASE, **given):
        """[options of a component] per component."""
        lines = [line.removeprefix("#SBATCH ") for line in submit.script(case, options(**given)).splitlines() if line.startswith("#SBATCH ")]
        components = [[]]
        for line in lines:
            if line == "hetjob":
                components.append([])
            else:
                components[-1].append(line)
        return components

    def test_one_node_for_all(self):
        self.assertEqual(self.asked(), [["--job-name=shock", "--output=shock-%j.out", "--nodes=1 --ntasks=1 --cpus-per-task=3"]])

    def test_a_node_for_who_has_most_ranks(self):
        head, gas = self.asked(nodes=2, ranks="fluid=16", time="2:00:00", option=["--partition=short"])
        self.assertEqual(head, ["--job-name=shock", "--output=shock-%j.out", "--time=2:00:00", "--signal=B:TERM@120",
                                "--nodes=1 --ntasks=1 --cpus-per-task=2", "--partition=short"])
        self.assertEqual(gas, ["--nodes=1 --ntasks=1 --cpus-per-task=16", "--partition=short"])

    def test_a_node_for_each(self):
        self.assertEqual([component[-1].rpartition("=")[2] for component in self.asked(nodes=4, ranks="fluid=3")], ["1", "3", "1", "1"])

    def test_directives_come_before_the_first_command(self):
        lines = submit.script(CASE, options(nodes=3)).splitlines()
        first = next(k for k, line in enumerate(lines) if line and not line.startswith("#"))
        self.assertFalse(any(line.startswith("#SBATCH") for line in lines[first:]))

    def test_what_cannot_be(self):
        for words, case, given in (("has a single program", STANDALONE, {"nodes": 2}), ("one node more than those", CASE, {"nodes": 5}),
                                   ("no time for Slurm", CASE, {"time": "soon"}), ("counts the cores of this machine", CASE, {"ranks": "auto"}),
                                   ("plate (solid_solver_beam) computes in one process only", CASE, {"ranks": "plate=2"})):
            with self.subTest(words), self.assertRaisesRegex(UserMistake, words.replace("(", r"\(").replace(")", r"\)")):
                submit.script(case, options(**given))


class Job(InScratch):
    """The script is executed, with stand-ins for Slurm and for the launcher."""

    def setUp(self):
        super().setUp()
        self.root = self.folder / "a checkout"
        shutil.copytree(paths.ROOT / "launch", self.root / "launch", ignore=lambda *_: ["fsi", "fsi_launch", "amp_fsi"])
        self.programs = self.folder / "programs"
        self.programs.mkdir()
        for name, body in SLURM.items():
            self._write(self.programs / name, body)

    def _write(self, path, body):
        path.write_text(f"#!/bin/bash\n{body}", encoding="utf-8")
        path.chmod(0o755)

    def job(self, launcher, **given):
        """A started script. `launcher`: what `fsi` does in it."""
        self._write(self.root / "launch" / "fsi", launcher)
        with mock.patch.object(paths, "ROOT", self.root):
            text = submit.script(CASE, options(**given))
        path = self.folder / "job"
        path.write_text(text, encoding="utf-8")
        nodes = {f"SLURM_JOB_NODELIST_HET_GROUP_{k}": node for k, node in enumerate(("n[07-08]", "n[07]", "m12"))}
        job = subprocess.Popen(["bash", str(path)], env=os.environ | nodes | {
            "PATH": f"{self.programs}:{os.environ['PATH']}", "FOLDER": str(self.folder)}, stdout=subprocess.PIPE)
        self.addCleanup(job.stdout.close)
        return job

    def told(self, name):
        return (self.folder / name).read_text(encoding="utf-8").strip()

    def test_who_has_a_node_of_his_own_runs_there(self):
        job = self.job('printf "%s\\n" "$*" > "$FOLDER/run"\nwords="echo a \\"b c\\" > $FOLDER/there"\n'
                       'eval "$FSI_RSH" 2@m12 \'"$words"\'\nexit 3\n', nodes=3,
                       ranks="fluid=4", overrides=["a=[1, 2]"])
        self.assertEqual(job.wait(), 3, "the exit code of the run")
        # The second component got a node of the first one: who runs there is here.
        self.assertEqual(self.told("run"), "run shock --no-progress --set=a=[1, 2] --ranks fluid=4 --hosts disk=2@m12")
        self.assertEqual(self.told("there"), "a b c")
        self.assertTrue(self.told("srun").startswith("--het-group=2 --nodelist=m12 --nodes=1 --ntasks=1 sh -c "))

    def test_end_of_the_time_is_passed_on(self):
        job = self.job('trap "echo ended > $FOLDER/end; exit 143" TERM\necho begun\nwhile :; do sleep 0.05; done\n')
        self.assertEqual(job.stdout.readline(), b"begun\n")
        job.send_signal(signal.SIGTERM)
        self.assertEqual(job.wait(), 143)
        self.assertEqual(self.told("end"), "ended", "the script waits for the run's end")


if __name__ == "__main__":
    unittest.main()
