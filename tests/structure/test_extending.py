#!/usr/bin/python3
"""One more law, Riemann solver, boundary, shape or case is one file and at most one line: in a copy of the tree each is added as its
README says, the files it took are counted, and what knows it by itself is compiled (by a compiler that writes nothing)."""

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
  constexpr std::optional<BrokenBound> broken_bound() const {
    if (soft <= mu) return {};
    return {{.key = "soft", .what = "must be at most mu = ", .bound = mu, .why = ": it would flow"}};
  }
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

GAS_BOUNDARY = """#pragma once
/// A pressure that is given at an outlet, for a test.
#include <array>
#include "fluid_solver/boundary/gas_side.hpp"
namespace fsi::fluid {
struct BackPressure {
  double p = 0;  ///< [pressure]
  static constexpr std::array keys{
      schema::Key{.name = "p_back", .meaning = "pressure behind it", .unit = "pressure", .required = true, .range = schema::positive}};
  static constexpr GasBoundaryFacts facts{.meaning = "the pressure is given", .keys = keys, .is_open = true};
  static BackPressure from(const BoundaryData& data) { return {data.numbers.at("p_back")}; }
  void set_points(const GasSide& side) const {
    for (int k = 0; k < side.points.n(); ++k) {
      if (!side.points.live(k)) continue;
      StateVector state = load(side.q, side.points.at(k, 0));
      state[3] = p;
      store(side.q, side.points.at(k, 0), state);
    }
  }
  static void set_ghosts(const GasSide& side) { extrapolate_ghosts(side); }
};
}  // namespace fsi::fluid
"""

SOLID_BOUNDARY = """#pragma once
/// A side that is shaken to and fro, for a test.
#include <array>
#include <cmath>
#include "solid_solver/boundary/side_data.hpp"
namespace fsi::solid {
struct Shaken {
  static constexpr std::array keys{schema::Key{.name = "amplitude", .meaning = "how far", .unit = "length", .fallback = "1"}};
  static constexpr SolidBoundaryFacts facts{.meaning = "it is shaken", .keys = keys, .holds = Hold::motion};
  static Boundary from(const SideData& data) {
    const auto found = data.numbers.find("amplitude");
    const double far = found == data.numbers.end() ? 1 : found->second;
    Boundary result{.condition = {.motion = Condition::Motion::given}};
    result.vector = [far](double, double, double t) -> Vec2 { return {far * std::sin(t), 0}; };
    result.velocity = rate_of(result.vector, data.time_scale);
    return result;
  }
};
}  // namespace fsi::solid
"""

SHAPE = """#pragma once
/// A drop, for a test.
#include <array>
#include <cmath>
#include <numbers>
#include "common/case/shapes/shape.hpp"
namespace fsi::shapes {
struct Drop {
  static constexpr std::array keys{
      schema::Key{.name = "length", .meaning = "from end to end", .unit = "length", .required = true, .range = schema::positive}};
  static constexpr ShapeFacts facts{.meaning = "a drop", .keys = keys, .may_be_open = false};
  static grid::PlaneCurve curve(const ShapeSection& section) {
    const double a = section.number("length", 1) / 2, turn = 2 * std::numbers::pi;
    grid::PlaneCurve drop;
    drop.position = [=](double s) { return Vec2(a * std::cos(turn * s), 0.5 * a * std::sin(turn * s)); };
    drop.slope = [=](double s) { return Vec2(-turn * a * std::sin(turn * s), 0.5 * turn * a * std::cos(turn * s)); };
    return drop;
  }
};
}  // namespace fsi::shapes
"""

# What holds only where everybody has learnt of the new ones by itself.
KNOWN = """
#include "common/case/schema/boundary_words.hpp"
#include "common/case/schema/law_numbers.hpp"
#include "common/case/shapes/every_shape.hpp"
#include "common/core/choices.hpp"
#include "fluid_solver/boundary/every_boundary.hpp"
#include "fluid_solver/kernels/riemann/every_riemann.hpp"
#include "solid_solver/boundary/every_boundary.hpp"
using namespace fsi;
template <class Every>
constexpr std::size_t count = std::variant_size_v<Every>;
template <class Every, std::size_t before_last = 0>
using Last = std::variant_alternative_t<count<Every> - 1 - before_last, Every>;
static_assert(named<BoundaryKind>("back_pressure") && named<BoundaryKind>("shaken"), "no case can ask for the boundaries");
static_assert(fluid::boundary_kinds.back() == BoundaryKind::back_pressure && solid::boundary_kinds.back() == BoundaryKind::shaken);
static_assert(std::is_same_v<Last<fluid::Boundary, 1>, fluid::BackPressure>, "the gas does not have the boundary");
static_assert(std::is_same_v<Last<solid::EveryBoundary>, solid::Shaken>, "the solid does not have the boundary");
static_assert(Last<fluid::Boundary, 1>::facts.keys.front().name == "p_back" && Last<fluid::Boundary, 1>::facts.is_open);
static_assert(!schema::is_said_by_a_word(fluid::BackPressure::facts.keys), "it is nothing without its pressure");
static_assert(schema::is_said_by_a_word(solid::Shaken::facts.keys), "its key has a default");
static_assert(shapes::shape_names.back() == "drop" && shapes::shape_facts.back().keys.front().name == "length");
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
                                "-D", "FSI_PRECOMPILED=OFF", "-D", "FSI_TOGETHER=OFF", "-D", "CMAKE_BUILD_TYPE=Debug"],
                               capture_output=True, text=True, check=False)
        self.assertEqual(cmake.returncode, 0, cmake.stderr)
        return {entry["file"]: entry for entry in json.loads((build / "compile_commands.json").read_text(encoding="utf-8"))}

    def understood(self, commands, *files):
        """Lets the compiler read these files of one library as one, with the options of the first."""
        together = self.root / "build" / "together.cpp"
        together.write_text("".join(f'#include "{self.root / file}"\n' for file in files), encoding="utf-8")
        entry = commands[str(self.root / files[0])]
        words = shlex.split(entry["command"])
        words = [str(together) if word == entry["file"] else word for word in words[:words.index("-o")]
                 + words[words.index("-o") + 2:]] + ["-fsyntax-only"]
        answer = subprocess.run(words, cwd=entry["directory"], capture_output=True, text=True, check=False)
        self.assertEqual(answer.returncode, 0, answer.stderr[-3000:])

    def add_kind(self, folder, family, name, kind, where, text):
        self.add(where, text, (f"{folder}/kinds.cmake", f"fsi_kind({family} ", f"fsi_kind({family} {name} {kind})"))

    def test_law_riemann_solver_boundaries_and_shape_with_keys_of_their_own_are_a_file_and_a_line_each(self):
        self.add_kind("solid_solver", "law", "spongy", "Spongy", "solid_solver/laws/spongy.hpp", LAW)
        self.add_kind("solid_solver", "solid_boundary", "shaken", "Shaken", "solid_solver/boundary/kinds/shaken.hpp", SOLID_BOUNDARY)
        self.add_kind("fluid_solver", "riemann_solver", "plain", "RiemannPlain", "fluid_solver/kernels/riemann/riemann_plain.hpp",
                      RIEMANN)
        self.add_kind("fluid_solver", "gas_boundary", "back_pressure", "BackPressure",
                      "fluid_solver/boundary/kinds/back_pressure.hpp", GAS_BOUNDARY)
        self.add_kind("common/case", "shape", "drop", "Drop", "common/case/shapes/drop.hpp", SHAPE)
        commands = self.configured()
        self.assertTrue(any(file.endswith("/spongy_solver.cpp") for file in commands), "no program of the law is built")
        (self.root / "build/known.cpp").write_text(KNOWN, encoding="utf-8")
        self.understood(commands, "fluid_solver/component.cpp", "build/known.cpp", "fluid_solver/boundary/boundary_conditions.cpp",
                        "fluid_solver/program/from_case.cpp")
        self.understood(commands, *(f"common/case/{name}.cpp" for name in ("schema/schema_fluid", "schema/schema_solid", "schema/schema_shape",
                                                                           "read/build_shape", "read/build_material")))
        self.understood(commands, "reference/chain.cpp")
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
