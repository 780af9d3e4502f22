#!/usr/bin/python3
"""Which program was the cause when a run failed, and what is said about it."""

import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from launcher import InScratch, piston  # noqa: E402
from fsi_launch.results import summary, verdict  # noqa: E402
from fsi_launch.living.supervise import Ending, Outcome  # noqa: E402


class Verdict(InScratch):
    def judge(self, *endings, signal=0, **parts):
        endings = [Ending(name, code, 0.0) for name, code in endings]
        return verdict.judge(Outcome(endings, signal), piston(), self.folder, parts)

    def test_failure_is_recorded_with_where_it_began(self):
        place = {"step": 12, "t": 0.3, "grid": "gas", "point": [4, 2], "position": [0.4, 0.2], "what": "p = -1"}
        broke = {"reason": "step 12, t = 0.3: p = -1", "origin": "fluid", "steps": 11, "t": 0.29, "failure": place}
        heard = {"reason": "fluid: step 12, t = 0.3: p = -1", "origin": "fluid", "steps": 11, "t": 0.29, "failure": place}
        found = self.judge(("coupler", 3), ("solid", 3), ("fluid", 3), fluid=broke, solid=heard, coupler=heard)
        self.assertEqual((found.code, found.reason), (3, "fluid: step 12, t = 0.3: p = -1"))
        self.assertEqual(found.failure, place | {"origin": "fluid", "told_by": "fluid", "exit_code": 3, "signal": None, "program": None,
                                                 "interface": None, "reference_position": None})

    def test_failure_of_a_program_that_left_no_report_has_no_place(self):
        found = self.judge(("coupler", 4), ("solid", 4), ("fluid", -9))
        self.assertEqual(found.failure, {"origin": "fluid", "told_by": "fluid", "exit_code": 4, "signal": "SIGKILL",
                                         "what": found.reason} | dict.fromkeys(verdict.PLACE))

    def test_a_solid_called_like_a_word_before_a_colon_is_not_taken_for_the_origin(self):
        own = {"reason": "solid: no such thing", "origin": "fluid"}
        self.assertEqual(self.judge(("fluid", 1), ("solid", 4), ("coupler", 4), fluid=own).reason, "fluid: solid: no such thing")

    def test_verdict_on_a_stopped_program_is_that_of_its_peers_not_that_it_was_killed(self):
        own = {"reason": "solid (pid 7) has been silent for 4 s (time.peer_timeout); is it stopped?", "origin": "coupler"}
        heard = {"reason": f"coupler: {own['reason']}", "origin": "coupler"}
        endings = [Ending("fluid", 4, 0.0), Ending("solid", -9, 0.1, ours=True), Ending("coupler", 4, 0.2)]
        found = verdict.judge(Outcome(endings), piston(), self.folder, {"fluid": heard, "coupler": own})
        self.assertEqual((found.code, found.reason), (4, f"coupler: {own['reason']}"))

    def test_program_that_ended_as_if_all_were_well_is_told_with_its_exit_code(self):
        seen = {"reason": "solid 'solid' (pid 1695) has died", "origin": "coupler"}
        heard = {"reason": "coupler ended the run: solid 'solid' (pid 1695) has died", "origin": "coupler"}
        endings = [Ending("solid", 0, 0.0), Ending("coupler", 4, 1.0), Ending("fluid", 4, 1.1)]
        found = verdict.judge(Outcome(endings), piston(), self.folder, {"coupler": seen, "fluid": heard})
        self.assertEqual(found.code, 4)
        self.assertRegex(found.reason, r"^lost solid.*: it ended with exit code 0 before the run was over$")
        self.assertEqual(found.failure["origin"], "solid")

    def test_program_that_another_one_saw_dead_is_lost_also_where_mpirun_had_to_be_ended(self):
        seen = {"reason": "fluid (pid 1695) has died", "origin": "coupler"}
        heard = {"reason": "coupler ended the run: fluid (pid 1695) has died", "origin": "coupler"}
        endings = [Ending("coupler", 4, 1.0), Ending("solid", 4, 1.1), Ending("fluid", 143, 9.0, ours=True)]
        found = verdict.judge(Outcome(endings), piston(), self.folder, {"coupler": seen, "solid": heard})
        self.assertEqual((found.code, found.reason.partition(":")[0]), (4, "lost fluid (fluid_solver)"))
        self.assertEqual(found.failure["origin"], "fluid")

    def test_program_that_was_ending_already_when_it_was_asked_to_says_why(self):
        own = {"reason": "coupler (pid 7) has been silent for 4 s (time.peer_timeout); is it stopped?", "origin": "fluid"}
        heard = {"reason": f"fluid: {own['reason']}", "origin": "fluid"}
        endings = [Ending("solid", 4, 0.0), Ending("coupler", -9, 0.1, ours=True, stopped=True), Ending("fluid", 4, 0.6, ours=True)]
        found = verdict.judge(Outcome(endings), piston(), self.folder, {"fluid": own, "solid": heard})
        self.assertEqual((found.code, found.reason), (4, f"fluid: {own['reason']}"))

    def test_program_that_stayed_stopped_when_all_others_had_ended_well_is_lost(self):
        endings = [Ending("solid", 0, 0.0), Ending("coupler", 0, 0.1), Ending("fluid", -15, 5.0, ours=True, stopped=True)]
        found = verdict.judge(Outcome(endings), piston(), self.folder, {})
        self.assertEqual((found.code, found.reason), (4, "lost fluid (fluid_solver): it did not end by itself; somebody had stopped it"))

    def test_program_that_was_killed_by_the_limit_of_a_file_is_output_that_failed(self):
        self.assertEqual(self.judge(("solid", -25), ("fluid", 4), ("coupler", 4)).code, 5)

    def test_run_that_ended_well_although_it_was_asked_to_end_is_complete(self):
        done = {"status": "completed"}
        found = self.judge(("fluid", 0), ("solid", 0), ("coupler", 0), signal=15, fluid=done, solid=done, coupler=done)
        self.assertEqual((found.code, found.status), (0, "completed"))
        self.assertEqual(self.judge(("fluid", 0), ("solid", 0), ("coupler", 143), signal=15).code, 143)
        self.assertEqual(self.judge(("reference", 0), signal=2).code, 130)

    def test_copy_in_memory_stands_for_a_part_that_the_disk_lacks(self):
        copies = {"fluid": '{"reason": "no space"}', "solid": "", "coupler": "{"}
        self.assertEqual(summary.read_parts(self.folder, piston().programs, copies), {"fluid": {"reason": "no space"}})


if __name__ == "__main__":
    unittest.main()
