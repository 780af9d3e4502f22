#!/usr/bin/python3
"""One more law, Riemann solver or case is one file and at most one line: in a copy of the tree each is added as its README
says, the files it took are counted, and what knows it by itself is compiled (by a compiler that writes nothing)."""

import json
import os
import shlex
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

ROOT = Path(os.environ.get("FSI_ROOT", Path(__file__).resolve().parents[2]))
LEFT_OUT = {"build", "runs", ".git", "__pycache__", ".cache", "docs", "tests", "gallery", "bench"}

LAW = """#pragma once
/// A neo-Hookean law with three numbers of its own, for a test.
#include <array>
#include "solid_solver/laws/law.hpp"
#include "solid_solver/laws/logarithm.hpp"
#include "solid_solver/laws/shape_and_area.hpp"
namespace fsi::solid {
struct Spongy {
  static constexpr std::string_view name = "spongy";
  static constexpr bool objective = true;
  double lambda = 0, mu = 0, soft = 0, wide = 0, late = 0;
  static constexpr std::array<OwnNumber<Spongy>, 3> own_numbers{
      {{.key = "soft", .meaning = "softness", .unit = "-", .member = &Spongy::soft, .typical = 0.1},
       {.key = "wide", .meaning = "width", .unit = "length", .member = &Spongy::wide, .typical = 0.2},
       {.key = "late", .meaning = "delay", .unit = "time", .member = &Spongy::late, .typical = 0.3}}};
  double psi(const Tensor2& F) const {
    const double log_J = logarithm(determinant_of(F));
    return 0.5 * lambda * log_J * log_J - mu * log_J + 0.5 * mu * stretch_of(F);
  }
  [[gnu::always_inline]] Tensor2 P(const Tensor2& F) const {
    return stress_of_shape_and_area(F, mu, lambda * logarithm(determinant_of(F)) - mu);
  }
  [[gnu::always_inline]] Stiffness K(const Tensor2& F) const {
    return stiffness_of_shape_and_area(F, mu, mu - lambda * logarithm(determinant_of(F)), lambda);
  }
};
static_assert(Law<Spongy>);
}  // namespace fsi::solid
"""

RIEMANN = """#pragma once
/// Rusanov's flux with one speed, for a test.
#include <cmath>
#include "fluid_solver/kernels/riemann/face_state.hpp"
#include "fluid_solver/kernels/riemann/riemann_split.hpp"
namespace fsi::fluid {
struct RiemannPlain {
  RiemannSplit split;
  static RiemannPlain with(const RiemannNumbers& numbers) { return {.split = {.gamma = numbers.gamma}}; }
  [[gnu::always_inline]] FaceFlux operator()(const FaceState& L, const FaceState& R, double g_n) const {
    return split(L, R, g_n);
  }
};
}  // namespace fsi::fluid
"""

# What holds only where everybody has learnt of the new ones by itself.
KNOWN = """
#include "common/case/schema/law_numbers.hpp"
#include "common/core/choices.hpp"
#include "fluid_solver/kernels/riemann/every_riemann.hpp"
using namespace fsi;
static_assert(named<RiemannSolver>("plain"), "no case can ask for the Riemann solver");
static_assert(std::is_same_v<std::variant_alternative_t<std::variant_size_v<fluid::AnyRiemann> - 1, fluid::AnyRiemann>,
                             fluid::RiemannPlain>, "the gas does not have it");
constexpr std::array none{schema::Key{.name = "law"}};
constexpr auto keys = schema::with_law_numbers<none>();
constexpr const schema::Key* key_of(std::string_view name) {
  for (const schema::Key& key : keys)
    if (key.name == name) return &key;
  return nullptr;
}
static_assert(key_of("soft") != nullptr && key_of("wide") != nullptr, "the case file has no key for a number of the law");
static_assert(key_of("late")->unit == "time" && key_of("late")->meaning == "delay");
"""

CASE = """title: A tube, for a test
grid: {factor: 2}
time: {end: 0.1}
fluid:
  gamma: 1.4
  grid: {x: [0, 1], y: [0, 1], spacing: h}
  boundary: {left: outflow, right: outflow, bottom: symmetry, top: symmetry}
  initial: {rho: 1, v: [0, 0], p: 1}
"""


class Extending(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.root = Path(folder.name) / "tree"
        shutil.copytree(ROOT, cls.root, ignore=lambda where, names: [
            name for name in names if name == "__pycache__" or (Path(where) == ROOT and name in LEFT_OUT)])
        cls.before = cls.contents()

    @classmethod
    def contents(cls):
        return {path.relative_to(cls.root).as_posix(): path.read_bytes()
                for path in cls.root.rglob("*") if path.is_file() and "build" not in path.relative_to(cls.root).parts[:1]}

    def add(self, where, text, line=None):
        """The recipe: a file, and a line behind the last one of its kind; checks that this is all."""
        before = self.contents()
        (self.root / where).write_text(text, encoding="utf-8")
        if line is not None:
            place, beginning, words = line
            lines = (self.root / place).read_text(encoding="utf-8").splitlines()
            last = max(k for k, old in enumerate(lines) if old.startswith(beginning))
            (self.root / place).write_text("\n".join([*lines[:last + 1], words, *lines[last + 1:]]) + "\n", encoding="utf-8")
        after = self.contents()
        self.assertEqual(after.keys() - before.keys(), {where})
        changed = [name for name in before if after[name] != before[name]]
        self.assertEqual(len(changed), 0 if line is None else 1)
        for name in changed:
            self.assertEqual(after[name].count(b"\n") - before[name].count(b"\n"), 1)

    def configured(self):
        """{file: command that compiles it}"""
        build = self.root / "build"
        cmake = subprocess.run(["cmake", "-S", self.root, "-B", build, "-G", "Ninja", "-D", "BUILD_TESTING=OFF", "-D", "FSI_BENCH=OFF",
                                "-D", "FSI_PRECOMPILED=OFF", "-D", "CMAKE_BUILD_TYPE=Debug"], capture_output=True, text=True, check=False)
        self.assertEqual(cmake.returncode, 0, cmake.stderr)
        return {entry["file"]: entry for entry in json.loads((build / "compile_commands.json").read_text(encoding="utf-8"))}

    def understood(self, entry, file=None):
        """Lets the compiler read a file, this one's or another with the same options."""
        words = shlex.split(entry["command"])
        words = [str(file) if file and word == entry["file"] else word for word in words[:words.index("-o")]
                 + words[words.index("-o") + 2:]] + ["-fsyntax-only"]
        answer = subprocess.run(words, cwd=entry["directory"], capture_output=True, text=True, check=False)
        self.assertEqual(answer.returncode, 0, answer.stderr[-3000:])

    def test_law_with_three_numbers_and_riemann_solver_are_a_file_and_a_line_each(self):
        self.add("solid_solver/laws/spongy.hpp", LAW,
                 ("solid_solver/CMakeLists.txt", "fsi_solid_solver(", "fsi_solid_solver(spongy Spongy)"))
        self.add("fluid_solver/kernels/riemann/riemann_plain.hpp", RIEMANN,
                 ("fluid_solver/CMakeLists.txt", "fsi_riemann_solver(", "fsi_riemann_solver(plain RiemannPlain)"))
        commands = self.configured()
        self.assertTrue(any(file.endswith("/spongy_solver.cpp") for file in commands), "no program of the law is built")
        known = self.root / "build" / "known.cpp"
        known.write_text(KNOWN, encoding="utf-8")
        component = commands[str(self.root / "fluid_solver/component.cpp")]
        self.understood(component)
        self.understood(component, known)
        self.understood(commands[str(self.root / "common/case/read/build_material.cpp")])
        self.understood(commands[str(self.root / "reference/chain.cpp")])
        laws = (self.root / "build/generated/common/case/schema/laws.hpp").read_text(encoding="utf-8")
        self.assertIn('"spongy"', laws, "no case can ask for the law")

    def test_case_is_a_file(self):
        self.add("configs/tube_of_a_test.yaml", CASE)
        program = Path(os.environ.get("FSI_BIN", ROOT / "build/release/bin")) / "fsi_case"
        if not program.exists():
            self.skipTest(f"{program} is not built")
        answer = subprocess.run([program, "resolve", self.root / "configs/tube_of_a_test.yaml"], capture_output=True, text=True,
                                check=False)
        self.assertEqual(answer.returncode, 0, answer.stderr)


if __name__ == "__main__":
    unittest.main()
