#!/usr/bin/python3
"""Gases and solids that several ranks compute: the same files to the bit as with one, for any number of ranks and whatever rows they
get, also after a restart on other ranks; and when a rank is killed or stopped, or mpirun is, all end and the rank is named.

test_ranks.py --kills N [SEED]           so many runs with two ranks for gas and solid each, of which somebody is killed or stopped
test_ranks.py --all [RANKS..] [CASE..]  all shipped cases, or these, for some steps, with so many ranks (default: 2 3 4 7)
test_ranks.py --in-turn [RANKS..] [CASE..]  the same with one of the numbers (default: 2 3 4) for each case, by turns; of the shipped cases those
                                        that no test below has: `programs.ranks_in_turn` of the suite
test_ranks.py --restarts [RANKS..] [CASE..]  the same, from a checkpoint of the first number of ranks on with the second, and so on around
                                        (default: 3 2 4)
"""

import contextlib
import os
import re
import shutil
import signal
import socket
import subprocess
import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from comparing import Comparing  # noqa: E402
from running import BIN, EndToEnd, FSI, PATIENT, processes, until  # noqa: E402
from fsi_launch.living import ranks  # noqa: E402
from fsi_launch.living.processes import namespace  # noqa: E402
from many_on_ranks import LASTING, RECUT, compare_all, compare_in_turn, kill_again_and_again, restart_all  # noqa: E402

MISSING = [what for what, there in (("libfsi_ranks_mpi.so", (BIN / "libfsi_ranks_mpi.so").is_file()),
                                    ("mpirun", shutil.which("mpirun"))) if not there]
if not MISSING and ranks.other_mpi():
    MISSING.append("Open MPI 4 or 5")

def memory_of(run):
    """The folder that the ranks of a run share; None when there is none."""
    return next((found for place in (ranks.SHARED, ranks.ON_DISK) for found in place.glob(f"{ranks.FOLDER}*-{run.process.pid}-*")), None)


# As LASTING, with a solid of two ranks.
LASTING_SOLID = (*LASTING[:-1], "solid=2")

# A panel between two gases, each with a grid along it before a background of two levels.
TWO_GASES = """
title: Waves on both sides of a panel between two gases with levels
parameters:
  thickness: 0.5
  amplitude: 0.2
grid: {factor: 4}
time: {end: 0.3, cfl: 0.9}
fluids:
  left:
    gamma: 1.4
    p_e: 1
    grid: {x: [-1.5, 0.3], y: [0, 1], spacing: h, levels: 2, refine: {threshold: 0.02}}
    body_fitted:
      - {name: strip_left, solid: panel, walls: [bottom, top], lines: 8}
    boundary: {left: outflow, right: outflow, bottom: slip_wall, top: slip_wall}
    initial: {rho: "1.4 * (x < -0.6 ? 1.2 : 1)", v: [0, 0], p: "x < -0.6 ? 1.5 : 1"}
  right:
    gamma: 5 / 3
    p_e: 1
    grid: {x: [thickness - 0.3, 2], y: [0, 1], spacing: h, levels: 2, refine: {threshold: 0.02}}
    body_fitted:
      - {name: strip_right, solid: panel, walls: [bottom, top], lines: 8}
    boundary: {left: outflow, right: outflow, bottom: slip_wall, top: slip_wall}
    initial: {rho: "0.4 * (1 + amplitude * exp(-40 * ((x - 1.2)^2 + (y - 0.4)^2)))", v: [0, 0], p: "1 + amplitude * exp(-40 * ((x - 1.2)^2 + (y - 0.4)^2))"}
solids:
  panel:
    law: neo_hookean
    rho: 2
    lambda: 4
    mu: 4
    grid: {x: [0, thickness], y: [0, 1], spacing: h}
    boundary:
      left: {kind: interface, fluid: left}
      right: {kind: interface, fluid: right}
      bottom: clamped
      top: clamped
output: {times: [0.15, 0.3]}
expect: {status: completed}
"""


class OnRanks(Comparing):
    def setUp(self):
        super().setUp()
        if MISSING:
            self.skipTest(f"no Open MPI: {', '.join(MISSING)} is missing (apt-get install openmpi-bin libopenmpi-dev, build again)")

    who = ("fluid",)    # has ranks

    def ranks(self, number):
        return ["--ranks", ",".join(f"{name}={number}" for name in self.who)]

    def on(self, number, *arguments, folder=None, every=0):
        """A whole run with so many ranks."""
        run = self.launch(*arguments, "--set", "expect={}", *self.ranks(number), out=folder or f"on{number}_{every}",
                          script=RECUT.format(every=every) if every else None)
        self.assertEqual(run.wait(), 0, run.stderr)
        return run

    def assert_layouts(self, *arguments, numbers_of_ranks=(2, 3), every=7):
        """The same with one rank, with more, and with the last of these numbers, which get other rows again and again."""
        whole = self.on(1, *arguments)
        for number in numbers_of_ranks[:-1]:
            self.assert_same(whole, self.on(number, *arguments))
        self.assert_same(whole, self.on(numbers_of_ranks[-1], *arguments, every=every))
        return whole

    def assert_restarts_on_other_ranks(self, *arguments):
        whole = self.on(1, *arguments)
        for before, after in ((2, 3), (3, 1), (1, 2)):
            first = self.on(before, *arguments, folder=f"from{before}")
            shutil.copytree(first.directory, self.folder / f"to{after}")
            run = self.launch("--restart", str(self.folder / f"to{after}"), *self.ranks(after), out=None)
            run.directory = self.folder / f"to{after}"
            self.assertEqual(run.wait(), 0, run.stderr)
            self.assert_same(whole, run)


class Layout(OnRanks):
    def test_moving_body_before_a_background(self):
        self.assert_layouts("shock_ellipse", "--set", "grid.factor=4", "--set", "time.end=0.4", "--set", "output.times=[0.2, 0.4]",
                            "--set", "output.probes=[{name: a, in: fluid, x: 0, y: 2.3}, {name: b, in: fluid, x: -2, y: -3}]",
                            numbers_of_ranks=(2, 4))

    def test_levels_around_a_moving_body(self):
        self.assert_layouts("shock_ellipse", "--set", "grid.factor=4", "--set", "fluid.grid.levels=3", "--set", "time.end=0.4",
                            "--set", "output.times=[0.2, 0.4]", "--set",
                            "output.probes=[{name: a, in: fluid, x: 0, y: 2.3}, {name: b, in: fluid, x: -2, y: -3}]",
                            numbers_of_ranks=(3, 7))

    def test_levels_of_a_lone_gas(self):
        self.assert_layouts("sod_tube", "--set", "grid.factor=8", "--set", "fluid.grid.levels=2", "--set", "time.end=0.1",
                            "--set", "output.times=[0.1]", numbers_of_ranks=(3,), every=4)

    def test_two_gases_with_levels(self):
        case = self.folder / "two_gases.yaml"
        case.write_text(TWO_GASES, encoding="utf-8")
        whole, uniform = self.complete(case), self.complete(case, *(f"--set=fluids.{name}.grid.levels=1" for name in ("left", "right")),
                                                           out="uniform")
        for every in (0, 6):
            run = self.launch(case, "--ranks", "left=2,right=3", out=f"ranks{every}", script=RECUT.format(every=every) if every else None)
            self.assertEqual(run.wait(), 0, run.stderr)
            self.assert_same(whole, run)
        import h5py
        with h5py.File(whole.directory / "solid_panel.h5") as levels, h5py.File(uniform.directory / "solid_panel.h5") as one:
            moved, expected = (file["000001/panel/u1"][()] for file in (levels, one))
            self.assertGreater(abs(expected).max(), 1e-4)
            self.assertLess(abs(moved - expected).max(), 1e-3 * abs(expected).max())

    def test_restart_of_levels_on_other_ranks(self):
        self.assert_restarts_on_other_ranks("shock_ellipse", "--set", "grid.factor=4", "--set", "fluid.grid.levels=3", "--set", "time.end=0.3",
                                            "--set", "output.times=[0.1, 0.3]", "--set", "output.checkpoint_every=20")

    def test_periods_across_the_rows(self):
        self.assert_layouts("isentropic_vortex", "--set", "grid.factor=2", "--set", "time.end=0.2", numbers_of_ranks=(3, 7), every=2)


class LayoutOfSolids(OnRanks):
    who = ("solid",)

    def test_piston_whose_sides_all_ranks_have(self):
        self.assert_layouts("elastic_piston", "--set", "grid.factor=2", "--set", "time.end=0.3", "--set", "output.times=[0.1, 0.3]",
                            "--set", "output.probes=[{name: a, in: solid, x: -0.3, y: 0.1}]", numbers_of_ranks=(2, 3))

    def test_solid_without_a_gas(self):
        self.assert_layouts("solid_manufactured", "--set", "time.end=0.05", "--set", "output.times=[0.05]", numbers_of_ranks=(2, 4))


class LayoutOfABar(OnRanks):
    """An interface along three sides of one grid, which each rank closes as a whole within a macro step."""

    who = ("bar",)
    STIFF = ("bar_on_wall", "--set", "parameters.E=1400", "--set", "time.multirate=true", "--set", "time.end=0.7", "--set", "output.times=[0.5, 0.7]")

    def test_round_corners_with_substeps(self):
        self.assert_layouts(*self.STIFF, numbers_of_ranks=(2, 4))

    def test_restart_on_other_ranks(self):
        self.assert_restarts_on_other_ranks(*self.STIFF, "--set", "output.checkpoint_every=20")


class LayoutOfAnEllipse(OnRanks):
    who = ("ellipse",)

    def test_overlapping_grids_and_substeps(self):
        self.assert_layouts("shock_ellipse", "--set", "grid.factor=4", "--set", "time.end=0.4", "--set", "output.times=[0.2, 0.4]",
                            "--set", "output.probes=[{name: a, in: ellipse, x: -1.5, y: 0}, {name: b, in: ellipse, x: -1.5, y: 0.9}]",
                            numbers_of_ranks=(2, 4))

    def test_restart_on_other_ranks(self):
        self.assert_restarts_on_other_ranks("shock_ellipse", "--set", "grid.factor=2", "--set", "time.end=0.5", "--set",
                                            "output.times=[0.2, 0.5]", "--set", "output.checkpoint_every=5")

    def test_numbers_that_break_do_so_in_the_same_words(self):
        arguments = ("shock_ellipse", "--solid", "ellipse=saint_venant_kirchhoff", "--set", "parameters.mach=2.8", "--set",
                     "parameters.stiffness=0.8", "--set", "grid.factor=2", "--set", "expect={}")
        reasons = []
        for number in (1, 3):
            run = self.launch(*arguments, *self.ranks(number), out=f"broken{number}")
            self.assertEqual(run.wait(), 3, run.stderr)
            self.assertIn("on side bottom the law saint_venant_kirchhoff", run.summary()["reason"])
            reasons.append(run.summary()["reason"])
        self.assertEqual(*reasons)


class LayoutOfAPiston(OnRanks):
    who = ("fluid", "solid")

    def test_sources_of_a_chosen_solution(self):
        self.assert_layouts("manufactured_piston", "--set", "grid.factor=1", "--set", "time.end=0.1")

    def test_restart_on_other_ranks(self):
        self.assert_restarts_on_other_ranks("elastic_piston", "--set", "grid.factor=2", "--set", "time.end=0.3", "--set",
                                            "output.times=[0.1, 0.3]", "--set", "output.checkpoint_every=10")


class LayoutOfBoth(OnRanks):
    who = ("fluid", "ellipse")

    def test_moving_body(self):
        self.assert_layouts("shock_ellipse", "--set", "grid.factor=2", "--set", "time.end=0.4", "--set", "output.times=[0.4]")


class Losing(OnRanks):
    lasting = LASTING

    def ranks_of(self, run):
        """Processes of the ranks, by rank, and their mpirun."""
        run.until_stepping()
        ours = [one for one in processes.programs_of(run.directory) if one.name == self.who[0]]
        mpirun = next(one.pid for one in ours if one.program == "mpirun")
        logged = re.findall(r"rank (\d+) is process (\d+)", run.log(self.who[0]))
        self.assertEqual(len(logged), 2)
        return {int(rank): int(pid) for rank, pid in logged}, mpirun

    def lose(self, rank, number):
        run = self.launch(*self.lasting, script=PATIENT)
        ranks, mpirun = self.ranks_of(run)
        self.assertEqual(len(list(memory_of(run).rglob("*_segment.*"))), 2)
        os.kill(mpirun if rank is None else ranks[rank], number)
        self.assertEqual(run.wait(), 4, run.stderr)
        self.assertEqual(run.summary()["status"], "failed")
        self.assertTrue(until(lambda: not any(Path(f"/proc/{pid}").exists() for pid in (*ranks.values(), mpirun))))
        self.assert_nothing_left(run)
        self.assertIsNone(memory_of(run))
        return run.summary()["reason"]


class Faults(Losing):
    def test_killed_rank(self):
        self.assertRegex(self.lose(1, signal.SIGKILL), rf"rank 1 of {self.who[0]}")

    def test_killed_first_rank(self):
        self.assertIn(f"lost {self.who[0]}", self.lose(0, signal.SIGKILL))


class FaultsOfLaunchers(Losing):
    """To whom the ranks of gases and solids are the same."""

    def test_memory_of_killed_launchers_is_freed_by_the_next_run(self):
        run = self.launch(*self.lasting, script=PATIENT)
        _, mpirun = self.ranks_of(run)
        self.assertIsNotNone(memory_of(run))
        run.process.kill()
        os.kill(mpirun, signal.SIGKILL)
        run.wait()  # the next run with ranks, perhaps one of another test, frees what is left
        strange = Path(f"/dev/shm/{ranks.FOLDER}{namespace()}-{os.getpid()}x")    # of somebody else
        strange.mkdir()
        self.addCleanup(strange.rmdir)
        other = self.launch(*self.lasting, out="other")
        other.until_stepping()
        self.assertIsNone(memory_of(run))
        other.process.send_signal(signal.SIGTERM)
        self.assertEqual(other.wait(), 143, other.stderr)
        self.assert_nothing_left(run)

    def test_stopped_rank(self):
        self.assertRegex(self.lose(1, signal.SIGSTOP), rf"rank 1 of {self.who[0]} \(process \d+\): it has been stopped for 4\.?\d* s")

    def test_killed_mpirun(self):
        name = self.who[0]
        self.assertRegex(self.lose(None, signal.SIGKILL), rf"lost {name}|lost mpirun \(process \d+\), which started the ranks of {name}")

    def test_end_on_request_leaves_a_checkpoint(self):
        run = self.launch(*self.lasting)
        ranks, mpirun = self.ranks_of(run)
        run.process.send_signal(signal.SIGTERM)
        self.assertEqual(run.wait(), 143, run.stderr)
        self.assertEqual(len(run.checkpoints()), 1)
        self.assert_nothing_left(run)


class LittleMemory(OnRanks):
    """On a machine whose /dev/shm is small, as that of containers can be."""

    before = ("unshare", "-m", "sh", "-c", 'mount -t tmpfs -o size=4m tmpfs /dev/shm && exec "$@"', "sh")
    short = ("elastic_piston", "--set", "grid.factor=2", "--set", "time.end=0.1", "--set", "output.times=[0.1]", "--set", "expect={}",
             "--ranks", "fluid=2")

    def setUp(self):
        super().setUp()
        if subprocess.run([*self.before, "true"], capture_output=True, check=False).returncode != 0:
            self.skipTest("nothing can be mounted here")

    def test_the_disk_takes_its_place(self):
        run = self.complete(*self.short)
        self.assertIsNone(memory_of(run))

    def test_without_a_disk_either_it_is_told_what_is_small_and_how_to_enlarge_it(self):
        run = self.launch(*self.short, script="from fsi_launch.living import ranks\nranks.ON_DISK = ranks.SHARED\n")
        self.assertEqual(run.wait(), 2, run.stderr)
        self.assertRegex(run.stderr, r"--ranks fluid=2: the ranks share up to \d+ MB, .* /dev/shm has 4 MB .*; enlarge /dev/shm .*--shm-size")
        self.assertFalse(run.directory.exists())


class Network(OnRanks):
    """Of what several ranks bring with them; the bus has tests of its own."""

    def listening(self, pids):
        """Addresses where these processes listen by TCP."""
        sockets = set()
        for pid in pids:
            for descriptor in Path(f"/proc/{pid}/fd").iterdir():
                with contextlib.suppress(OSError):
                    sockets.add(os.readlink(descriptor))
        found = set()
        for family, table in ((socket.AF_INET, "tcp"), (socket.AF_INET6, "tcp6")):
            for line in Path(f"/proc/net/{table}").read_text(encoding="ascii").splitlines()[1:]:
                words = line.split()
                if words[3] == "0A" and f"socket:[{words[9]}]" in sockets:
                    number = bytes.fromhex(words[1].partition(":")[0])
                    native = b"".join(number[k:k + 4][::-1] for k in range(0, len(number), 4))
                    found.add(socket.inet_ntop(family, native))
        return found

    def test_nobody_listens_beyond_this_machine(self):
        run = self.launch(*LASTING)
        run.until_stepping()
        mpirun = next(one.pid for one in processes.programs_of(run.directory) if one.program == "mpirun")
        self.assertIn("127.0.0.1", self.listening([mpirun]))
        self.assertLessEqual(self.listening([mpirun, *ranks.members(mpirun)]), {"127.0.0.1", "::1"})
        run.process.send_signal(signal.SIGTERM)
        self.assertEqual(run.wait(), 143, run.stderr)
        self.assertIsNone(memory_of(run))


class FaultsOfSolids(Faults):
    who = ("solid",)
    lasting = LASTING_SOLID


class Refusals(EndToEnd):
    def refused(self, text, case="elastic_piston", *more):
        run = self.launch(case, *more, "--ranks", text)
        self.assertEqual(run.wait(), 2, run.stderr)
        return run.stderr

    def test_rigid_solid(self):
        self.assertIn("ellipse (solid_solver_rigid) computes in one process only; several can compute a gas or a solid with a grid: fluid",
                      self.refused("ellipse=2", "shock_ellipse", "--solid", "ellipse=rigid"))

    def test_stranger(self):
        self.assertIn("no participant 'gas'; it has", self.refused("gas=2"))

    def test_no_number(self):
        self.assertIn("'fluid=0' is not NAME=N with N from 1 to 64", self.refused("fluid=0"))

    def test_check_says_the_same_and_who_would_have_how_many(self):
        def checked(text):
            return subprocess.run([FSI, "check", "shock_ellipse", "--ranks", text], env=os.environ | {"FSI_BIN": str(BIN)}, capture_output=True,
                                  text=True, check=False)
        refused, right = checked("gas=2"), checked("fluid=2")
        self.assertEqual(refused.returncode, 2)
        self.assertIn("no participant 'gas'; it has", refused.stderr)
        if MISSING:  # a run would not start
            self.assertEqual(right.returncode, 2)
            self.assertRegex(right.stderr, "install openmpi-bin libopenmpi-dev|Open MPI 4")
            return
        self.assertEqual(right.returncode, 0, right.stderr)
        self.assertRegex(right.stdout, r"ranks: fluid: 2 ranks, about \d+ points each\n")


if __name__ == "__main__":
    if "--kills" in sys.argv:
        sys.exit(1 if kill_again_and_again(int(sys.argv[2]), int((sys.argv[3:] or [1])[0])) else 0)
    for option, compare, default in (("--all", compare_all, [2, 3, 4, 7]), ("--in-turn", compare_in_turn, [2, 3, 4]),
                                     ("--restarts", restart_all, [3, 2, 4])):
        if option in sys.argv:
            if MISSING:
                print(f"no Open MPI: {', '.join(MISSING)} is missing (apt-get install openmpi-bin libopenmpi-dev, build again)")
                sys.exit(77)
            words = sys.argv[2:]
            counts = [int(word) for word in words if word.isdecimal()] or default
            sys.exit(1 if compare(counts, [word for word in words if not word.isdecimal()]) else 0)
    unittest.main()
