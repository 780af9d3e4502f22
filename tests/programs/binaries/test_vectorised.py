#!/usr/bin/python3
"""The loops over points that take nearly all the time of a run are vector code, in every program as it was built: one
reference to a temporary in such a loop, and the compiler silently makes it several times slower.

A loop that was vectorised is there once as vector code, without a scalar operation in it, and once or several times as
scalar code for the points that are left over, one by one in a loop or unrolled. The vector code must do at least as much per
pass as the scalar code does per point; then nothing of the loop was left out of it, whatever the width of the vectors.
"""

import json
import re
import subprocess
import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from running import BIN, ROOT  # noqa: E402

SOLID = ("solid::GodunovSweep<.*::predict\\(", *(f"solid::WavePasses<.*::{loop}\\(" for loop in ("waves", "solve_faces1", "solve_faces2")),
         *(f"solid::StressUpwinding<.*::{loop}\\(" for loop in ("find_shares", "correct_faces1", "correct_faces2", "add_decay")),
         "solid::WavePasses<.*::spread_squared<", "solid::PointPasses<.*::update<.*NoTerms", "solid::PointPasses<.*::update<.*AllDissipation",
         *(f"solid::{loop}<" for loop in ("find_misses", "find_stresses", "find_impedances", "show_interface")),
         "solid::take_newton_steps\\(", "solid::add_relaxation<",
         "solid::add_tangential_stress_dissipation<", "solid::add_displacement_dissipation<", "solid::add_bulk_diffusion\\(")
FIND_STIFFNESS = "solid::PointPasses<.*::find_stiffness\\("  # of laws whose K takes longer than the rest of the prediction
GAS = (*(f"fluid::{loop}<" for loop in ("predict_row", "flux_row", "update_row", "viscosity_row")), "::cartesian_rates<",
       "::mapped_rates<", "fluid::conserved_row\\(", "fluid::add_viscous_flux_row\\(",
       *(f"fluid::{loop}\\(" for loop in ("metric_row", "corner_row", "face_row_1", "face_row_2", "volume_row")))
INSTRUCTION = re.compile(r"^\s*([0-9a-f]+):\t(.*)$")
ARITHMETIC = re.compile(r"^v?(?:add|sub|mul|div|sqrt|fn?m(?:add|sub)\d+)([ps])d\s")
JUMP = re.compile(r"^j\w+\s+([0-9a-f]+)\s")
ENDS = re.compile(r"^(?:(?:bnd |notrack )?j|ret|ud2|hlt)")
GOES_AWAY = re.compile(r"^(?:(?:bnd |notrack )?jmp|ret|ud2|hlt)")
WIDEST = 8  # numbers in a vector of any x86-64 processor: up to seven points are left over


def functions(program):
    """(name, [(address, instruction)]) of a program."""
    listing = subprocess.run(["objdump", "-d", "--no-show-raw-insn", "-C", program], capture_output=True, text=True,
                             check=True).stdout
    for block in re.split(r"\n\n(?=[0-9a-f]+ <)", listing):
        name, _, body = block.strip().partition("\n")
        lines = [INSTRUCTION.match(line) for line in body.splitlines()]
        yield name, [(int(line.group(1), 16), line.group(2)) for line in lines if line]


def arithmetic(code):
    """(packed, scalar) floating-point operations among instructions."""
    kinds = [match.group(1) for _, text in code if (match := ARITHMETIC.match(text))]
    return kinds.count("p"), kinds.count("s")


def blocks_of(code):
    """({block: last instruction}, {block: blocks that may come next}); a block is named by the place of its first
    instruction in the function."""
    place = {address: k for k, (address, _) in enumerate(code)}
    jumps = {k: place.get(int(match.group(1), 16)) for k, (_, text) in enumerate(code) if (match := JUMP.match(text))}
    starts = sorted({0, *(target for target in jumps.values() if target is not None),
                     *(k + 1 for k, (_, text) in enumerate(code) if ENDS.match(text) and k + 1 < len(code))})
    last = {start: end - 1 for start, end in zip(starts, [*starts[1:], len(code)])}
    falls = {start: {end + 1} & last.keys() if not GOES_AWAY.match(code[end][1]) else set() for start, end in last.items()}
    return last, {start: falls[start] | {jumps.get(last[start])} - {None} for start in starts}


def dominators(following):
    """The blocks every way from the function's beginning to a block passes, itself among them, of each that can be reached."""
    reached, to_do = {0: {0}}, [0]
    while to_do:
        block = to_do.pop()
        for successor in following[block]:
            passed = {successor} | (reached[block] & reached.get(successor, reached[block]))
            if passed != reached.get(successor):
                reached[successor] = passed
                to_do.append(successor)
    return reached


def innermost_loops(code):
    """Instructions of each loop that has no other loop in it: what lies between a block and a jump back to it that is reached
    through that block alone. (Jumps back to what all cases share, such as the function's end, close no loop.)"""
    last, following = blocks_of(code)
    passed = dominators(following)
    loops = {}
    for end in passed:
        for head in following[end] & passed[end]:
            body, to_do = loops.setdefault(head, {head}), [end]
            while to_do:
                if (block := to_do.pop()) not in body:
                    body.add(block)
                    to_do += [other for other in passed if block in following[other]]
    return [[instruction for block in sorted(body) for instruction in code[block:last[block] + 1]]
            for head, body in loops.items() if not body & (loops.keys() - {head})]


def shortcoming(code):
    """Why a function is no vectorised loop, or ""."""
    loops = [arithmetic(loop) for loop in innermost_loops(code)]
    vector = sum(packed for packed, scalar in loops if scalar == 0)
    if vector == 0:
        return "no loop of vector code alone"
    # What is done per point: a scalar loop around one point, packed parts of which are the rest of other points.
    per_point = min((scalar for packed, scalar in loops if scalar > packed), default=0)
    if vector < 0.9 * per_point:  # the two may be put together a little differently
        return f"{vector} operations in vector code, {per_point} in scalar code"
    scalar = arithmetic(code)[1]
    if scalar > (WIDEST - 1) * 1.1 * vector:
        return f"{vector} operations in vector code, {scalar} in all scalar code"
    return ""


class Kernels(unittest.TestCase):
    def check(self, program, kernels):
        code = dict(functions(BIN / program))
        for kernel in kernels:
            of_kernel = {name: code[name] for name in code if re.search(kernel, name)}
            self.assertTrue(of_kernel, f"{program} has no {kernel}")
            for name, instructions in of_kernel.items():
                self.assertEqual(shortcoming(instructions), "", name)

    def test_gas(self):
        self.check("fluid_solver", GAS)

    def test_moving_grids_are_looked_over(self):
        """In every step. Points that are left over share edges, so they are fewer operations than so many points would be."""
        code = dict(functions(BIN / "fluid_solver"))
        for loop in ("cell_quality", "check_cells"):
            loops = [arithmetic(one) for name in code if f"grid::{loop}(" in name for one in innermost_loops(code[name])]
            self.assertTrue(any(scalar == 0 < packed for packed, scalar in loops), loop)

    def test_solids_of_every_law(self):
        for program in sorted(path.name for path in BIN.glob("solid_solver_*")):
            if program not in ("solid_solver_rigid", "solid_solver_beam"):  # which have no grid of points
                law = (ROOT / "solid_solver" / "laws" / f"{program.removeprefix('solid_solver_')}.hpp").read_text(encoding="utf-8")
                self.check(program, SOLID if "quick_stiffness" in law else (FIND_STIFFNESS, *SOLID))


class Options(unittest.TestCase):
    """g++ takes the optimisation of precompiled headers for that of the source: -O3 and the rounding of one source would be lost."""

    @staticmethod
    def optimisation(entry):
        """What of a command decides on loops and rounding: of each kind the last."""
        return [(re.findall(pattern, entry["command"]) or [""])[-1] for pattern in (r" -O\S+", r" -ffp-contract=\S+", r" -march=\S+")]

    def test_precompiled_headers_have_the_optimisation_of_the_sources_that_take_them(self):
        commands = json.loads((BIN.parent / "compile_commands.json").read_text(encoding="utf-8"))
        made = {entry["file"].removesuffix(".cxx"): entry for entry in commands if entry["file"].endswith("/cmake_pch.hxx.cxx")}
        taken = [(header, entry) for entry in commands if entry["file"].endswith(".cpp") or "/Unity/" in entry["file"]
                 for header in re.findall(r" -include (\S+/cmake_pch\.hxx) ", entry["command"])]
        self.assertGreater(sum(" -O3 " in entry["command"] for entry in commands), 10)
        if made:  # not with a compiler cache
            self.assertGreater(len(taken), 10)
        for header, entry in taken:
            self.assertEqual(self.optimisation(entry), self.optimisation(made[header]), entry["file"])


class Measure(unittest.TestCase):
    """What the measure says of listings made for it."""

    @staticmethod
    def loop(start, *texts):
        code = [(start + k, text) for k, text in enumerate(texts)]
        return [*code, (start + len(texts), f"jne    {start:x} <f>")]

    def test_vector_loop_with_its_rest(self):
        vector, rest = ["vmulpd x", "vaddpd x"], ["vmulsd x", "vaddsd x"]
        self.assertEqual(shortcoming(self.loop(1, *vector)), "")
        self.assertEqual(shortcoming([*self.loop(1, *vector), *self.loop(20, *rest)]), "")
        self.assertEqual(shortcoming([*self.loop(1, *vector), *enumerate(7 * rest, start=20)]), "")

    def test_rest_that_jumps_back_to_the_end_of_all_cases(self):
        """Points that are left over stand behind the function's end here and there, unrolled: no loop of three points."""
        vector, rest = ["vmulpd x", "vaddpd x"], ["vmulsd x", "vaddsd x"]
        code = [*self.loop(1, *vector), (4, "je     20 <f>"), (5, "ret"), *enumerate(3 * rest, start=0x20),
                (0x26, "jmp    5 <f>")]
        self.assertEqual(shortcoming(code), "")

    def test_loop_around_a_loop_and_its_rest(self):
        vector, rest = ["vmulpd x", "vaddpd x"], ["vmulsd x", "vaddsd x"]
        code = [(0, "nop"), *self.loop(1, *vector), *enumerate(3 * rest, start=4), (0xa, "jne    0 <f>"), (0xb, "ret")]
        self.assertEqual(shortcoming(code), "")
        self.assertEqual([arithmetic(loop) for loop in innermost_loops(code)], [(2, 0)])

    def test_scalar_loop(self):
        self.assertNotEqual(shortcoming(self.loop(1, "vmulsd x", "vaddsd x")), "")

    def test_loop_with_one_scalar_operation(self):
        self.assertNotEqual(shortcoming(self.loop(1, "vmulpd x", "vaddpd x", "vdivsd x")), "")

    def test_loop_of_which_a_part_was_vectorised(self):
        part, rest = self.loop(1, "vmulpd x", "vaddpd x"), self.loop(20, *["vmulsd x"] * 10)
        self.assertNotEqual(shortcoming([*part, *rest]), "")


if __name__ == "__main__":
    unittest.main()
