#!/usr/bin/python3
"""Who gets how many ranks and which cores by --ranks, and what is said where that cannot be."""

import json
import os
import sys
import unittest
from pathlib import Path
from types import SimpleNamespace
from unittest import mock

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from launcher import InScratch  # noqa: E402
from fsi_launch import paths  # noqa: E402
from fsi_launch.failure import UserMistake  # noqa: E402
from fsi_launch.living import processes, ranks  # noqa: E402
from fsi_launch.results import verdict  # noqa: E402


def case(cost=None, **programs):
    return SimpleNamespace(programs=programs, cost=cost or {})


PISTON = case(fluid="fluid_solver", solid="solid_solver_beam", coupler="coupler")
ELLIPSE = {"fluid": "fluid_solver", "ellipse": "solid_solver_neo_hookean", "coupler": "coupler"}
TWO_GASES = case(left="fluid_solver", right="fluid_solver", plate="solid_solver_beam", coupler="coupler")


def with_cores(number):
    return mock.patch("os.sched_getaffinity", return_value=set(range(number)))


class Wanted(InScratch):
    def refused(self, text):
        with self.assertRaises(UserMistake) as caught:
            ranks.wanted(text, PISTON)
        return str(caught.exception)

    def test_nothing_asked_or_one_rank_is_nothing_new(self):
        self.assertEqual(ranks.wanted(None, PISTON), {})
        self.assertEqual(ranks.wanted("fluid=1,solid=1", PISTON), {})

    def test_each_gas_its_own(self):
        self.assertEqual(ranks.wanted("left=2,right=3", TWO_GASES), {"left": 2, "right": 3})

    def test_what_cannot_be(self):
        self.assertIn("solid (solid_solver_beam) computes in one process only", self.refused("solid=2"))
        self.assertIn("no participant 'gas'; it has fluid, solid, coupler", self.refused("gas=2"))
        for program in ("solid_solver_rigid", "bin/mine"):
            with self.assertRaises(UserMistake) as caught:
                ranks.wanted("solid=2", case(solid=program))
            self.assertIn(f"solid ({program}) computes in one process only", str(caught.exception))
        for word in ("fluid", "fluid=0", "fluid=65", "fluid=two"):
            self.assertIn(f"'{word}' is not NAME=N with N from 1 to 64", self.refused(word))

    def test_solids_with_a_grid(self):
        self.assertEqual(ranks.wanted("fluid=2,ellipse=3", case(**ELLIPSE)), {"fluid": 2, "ellipse": 3})

    def test_auto_gives_a_core_to_who_has_most_to_do(self):
        cost = {"fluid": {"points": 1e6, "seconds_a_step": 0.1}, "ellipse": {"points": 1e5, "seconds_a_step": 0.25}}
        for cores, expected in ((2, {}), (3, {"ellipse": 2}), (4, {"ellipse": 3}), (5, {"ellipse": 3, "fluid": 2}),
                                (16, {"fluid": 11, "ellipse": 5})):     # a rank has 20 000 points
            with with_cores(cores):
                self.assertEqual(ranks.wanted("auto", case(cost, **ELLIPSE)), expected, cores)

    def test_auto_takes_the_cores_that_others_leave(self):
        for cores, expected in ((2, {}), (3, {"fluid": 2}), (8, {"fluid": 7})):
            with with_cores(cores):
                self.assertEqual(ranks.wanted("auto", PISTON), expected)
        with with_cores(8):
            self.assertEqual(ranks.wanted("auto", TWO_GASES), {"left": 4, "right": 3})

    def test_cores_are_disjoint_where_there_are_enough(self):
        with with_cores(8):
            found = ranks.cores({"left": 3, "right": 4})
            self.assertEqual([len(found["left"]), len(found["right"])], [3, 4])
            self.assertFalse(found["left"] & found["right"])
            self.assertEqual(ranks.cores({"left": 4, "right": 4}), {})

    def test_without_mpi_one_is_told_what_to_install(self):
        with mock.patch.object(paths, "BIN", self.folder), mock.patch("shutil.which", return_value=None):
            ranks.expect_mpi({})
            with self.assertRaises(UserMistake) as caught:
                ranks.expect_mpi({"fluid": 2})
        self.assertIn("sudo apt-get install openmpi-bin libopenmpi-dev", str(caught.exception))

    def mpirun(self, words):
        """One that says so of itself is first in PATH."""
        path = self.folder / str(len(list(self.folder.iterdir()))) / "mpirun"
        path.parent.mkdir()
        path.write_text(f"#!/bin/sh\necho '{words}'\n", encoding="utf-8")
        path.chmod(0o755)
        return mock.patch.dict("os.environ", PATH=f"{path.parent}:/usr/bin:/bin")

    def test_each_open_mpi_is_told_in_its_own_words(self):
        for words, known in (("mpirun (Open MPI) 4.1.4", "--mca btl self,vader"), ("mpirun (Open MPI) 5.0.7", "--pmixmca ptl_base_if_include lo")):
            with self.mpirun(words):
                self.assertEqual(ranks.other_mpi(), "")
                command = " ".join(ranks.command(["program", "--name", "fluid"], 3))
                self.assertIn(known, command)
                self.assertTrue(command.endswith(" program --name fluid --ranks 3"), command)
                with ranks.memory([3]) as memory:
                    folder, _, file = memory.pop("LD_PRELOAD").partition(":")[0].rpartition("/")
                    self.assertEqual((set(memory.values()), file), ({folder}, ranks.LOOPBACK))
                self.assertFalse(any(Path(one).exists() for one in memory.values()))

    def test_other_kinds_are_refused_by_name(self):
        for file in (ranks.MODULE, ranks.LOOPBACK):
            (self.folder / file).touch()
        for words, name in (("mpirun (Open MPI) 6.0.1", "Open MPI 6.0.1"), ("HYDRA build details:", "HYDRA build details:"), ("", "an unknown kind")):
            with self.mpirun(words), mock.patch.object(paths, "BIN", self.folder), self.assertRaises(UserMistake) as caught:
                ranks.expect_mpi({"fluid": 2})
            self.assertRegex(str(caught.exception), f"mpirun is of {name}, and ranks go with Open MPI 4 and 5 .* leave --ranks away")

    def test_nobody_begins_whose_mpirun_would_listen_on_the_network(self):
        (self.folder / ranks.MODULE).touch()
        for words in ("mpirun (Open MPI) 4.1.4", "mpirun (Open MPI) 5.0.7"):
            with self.mpirun(words), mock.patch.object(paths, "BIN", self.folder), self.assertRaises(UserMistake) as caught:
                ranks.expect_mpi({"fluid": 2})
            self.assertIn(f"{ranks.LOOPBACK} in {self.folder} is missing", str(caught.exception))

    def test_who_is_to_blame_is_who_was_lost_first(self):
        (self.folder / "parts").mkdir()
        told = {1: "lost rank 2 of fluid (process 12): it has ended", 3: "lost rank 3 of gas (process 1): it has ended"}
        for rank, reason in told.items():
            (self.folder / "parts" / f"fluid.rank{rank}.json").write_text(json.dumps({"reason": reason}), encoding="utf-8")
        first = "fluid: lost rank 1 of fluid (process 11): it has ended"
        self.assertEqual(verdict._of_ranks("fluid", self.folder, first), told[1])
        self.assertEqual(verdict._of_ranks("fluid", self.folder, "the disk is full"), "the disk is full")

    def test_what_mpirun_noticed_is_said_in_one_piece(self):
        (self.folder / "log").mkdir()
        for told in ("mpirun noticed that process rank 1 with PID 0 on node a exited on signal 9 (Killed).",
                     "prterun noticed that process rank 1 with PID 0 on node a exited on\nsignal 9 (Killed)."):
            (self.folder / "log" / "fluid.out").write_text(f"begun\n---\n{told}\n---\nbye\n", encoding="utf-8")
            self.assertEqual(verdict._last_line(self.folder, "fluid"), told.replace("\n", " "))

    def test_who_goes_on_after_a_stop_does_not_blame_those_who_left_because_of_it(self):
        (self.folder / "parts").mkdir()
        left = self.folder / "parts" / "fluid.rank1.json"
        stopped, ended = "lost rank {} of fluid (process 10): it has been stopped for 4 s", "lost rank {} of fluid (process 11): it has ended"
        for first, later in ((stopped, ended), (ended, stopped)):
            left.write_text(json.dumps({"reason": later.format(0)}), encoding="utf-8")
            self.assertIn("stopped", verdict._of_ranks("fluid", self.folder, first.format(1)))


class Room(InScratch):
    """What ranks share lies in memory where there is room for it, else on the disk."""

    def rooms(self, shared, on_disk):
        """Two such places with so many MiB each."""
        rooms = {ranks.SHARED: shared * ranks.MIB, ranks.ON_DISK: on_disk * ranks.MIB}
        return mock.patch.object(ranks, "_room", rooms.get)

    def test_it_is_in_memory_where_all_of_it_fits(self):
        known = ranks.TOLD["4"]
        for numbers, least in (([2], 17.25), ([8], 42), ([2, 2], 34.5)):
            for shared, place in ((least, ranks.SHARED), (least - 0.1, ranks.ON_DISK)):
                with self.rooms(shared, 1000):
                    self.assertEqual(ranks._place(numbers, known), place)  # noqa: SLF001

    def test_who_has_room_nowhere_is_told_how_much_it_takes_and_what_to_do(self):
        with self.rooms(1, 3), mock.patch.object(ranks, "told", return_value=ranks.TOLD["4"]):
            self.assertRegex(ranks.lack_of_room([2]), "share up to 18 MB, .* /dev/shm has 1 MB and /tmp has 3 MB; enlarge /dev/shm .*fewer ranks")
            self.assertEqual(ranks.lack_of_room([]), "")
        with self.rooms(1, 18), mock.patch.object(ranks, "told", return_value=ranks.TOLD["4"]):
            self.assertEqual(ranks.lack_of_room([2]), "")

    def test_a_place_that_is_not_there_or_has_no_bound(self):
        self.assertEqual(ranks._room(self.folder / "nowhere"), 0)  # noqa: SLF001
        self.assertGreater(ranks._room(self.folder), 0)  # noqa: SLF001
        unbounded = SimpleNamespace(f_blocks=0, f_bavail=0, f_frsize=4096)
        with mock.patch("os.statvfs", return_value=unbounded):
            self.assertEqual(ranks._room(self.folder), float("inf"))  # noqa: SLF001


class LeftBehind(InScratch):
    """What launchers leave that were killed; others in containers may share the folder, whose pids are numbers of other processes."""

    def test_folders_of_dead_launchers_go_and_those_of_the_living_and_of_other_containers_stay(self):
        here, living = processes.namespace(), os.getpid()
        born = processes.start_time(living)
        dead = self.folder / f"{ranks.FOLDER}{here}-{living}-{born + 1}-a"
        stay = [self.folder / f"{ranks.FOLDER}{space}-{living}-{start}-a" for space, start in ((here, born), (here + 1, born + 1))]
        for folder in (dead, *stay):
            folder.mkdir()
        ranks._forget_dead(self.folder)  # noqa: SLF001
        self.assertEqual(sorted(self.folder.iterdir()), sorted(stay))

    def test_a_run_has_a_folder_that_others_leave_alone(self):
        with mock.patch.object(ranks, "SHARED", self.folder), mock.patch.object(ranks, "told", return_value=ranks.TOLD["4"]), \
                ranks.memory([2]) as names:
            folder = Path(names["OMPI_MCA_orte_tmpdir_base"])
            ranks._forget_dead(self.folder)  # noqa: SLF001
            self.assertTrue(folder.is_dir())
            with mock.patch.object(processes, "namespace", return_value=1):
                ranks._forget_dead(self.folder)  # noqa: SLF001
            self.assertTrue(folder.is_dir())
        self.assertFalse(folder.exists())


if __name__ == "__main__":
    unittest.main()
