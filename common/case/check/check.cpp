#include "common/case/check/check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common/case/check/check_beam.hpp"
#include "common/case/check/check_ends.hpp"
#include "common/case/check/check_expectations.hpp"
#include "common/case/check/check_geometry.hpp"
#include "common/case/check/check_images.hpp"
#include "common/case/check/check_interfaces.hpp"
#include "common/case/check/check_overlap.hpp"
#include "common/case/check/check_places.hpp"
#include "common/case/check/check_rim.hpp"
#include "common/case/check/given/check_motions.hpp"
#include "common/case/check/given/check_reference.hpp"
#include "common/case/check/given/check_side_data.hpp"
#include "common/case/check/given/check_starts.hpp"
#include "common/case/check/given/given.hpp"
#include "common/case/check/given/sample.hpp"
#include "common/case/document/fluid_sections.hpp"
#include "common/case/document/node_at.hpp"
#include "common/case/grids/grid_points.hpp"
#include "common/case/schema/laws.hpp"
#include "common/core/input/suggest.hpp"
#include "common/core/types.hpp"

namespace fsi {

namespace {

using config::fail;
using config::Node;

/// A cell of a grid: what its two edges from the first corner span has a positive area where the second
/// is to the left of the first.
struct SampledCell {
  int i = 0, j = 0;
  Vec2 x;  ///< its first corner
  double area = 0;
};

std::vector<SampledCell> sample_cells(const GridSpec& grid, double t) {
  const int samples = t > 0 ? 16 : 64;  // in each direction
  const int step1 = std::max(1, (grid.n1 - 1) / samples);
  const int step2 = std::max(1, (grid.n2 - 1) / samples);
  std::vector<SampledCell> cells;
  for (int j = 0; j + 1 < grid.n2; j += step2) {
    for (int i = 0; i + 1 < grid.n1; i += step1) {
      const Vec2 x = position(grid, i, j, t);
      const Vec2 along1 = position(grid, i + 1, j, t) - x;
      const Vec2 along2 = position(grid, i, j + 1, t) - x;
      cells.push_back({.i = i, .j = j, .x = x, .area = along1[0] * along2[1] - along1[1] * along2[0]});
    }
  }
  return cells;
}

/// The cells of a sample have positive area: a map that folds costs one look, not a run.
void check_grid(const GridSpec& grid, const Node& node, const std::string& path, double t = 0) {
  const std::vector<SampledCell> cells = sample_cells(grid, t);
  const auto is_sound = [](const SampledCell& cell) { return cell.area > 0 && std::isfinite(cell.area); };
  const auto wrong = std::ranges::find_if_not(cells, is_sound);
  if (wrong == cells.end()) return;
  if (t == 0 && std::ranges::all_of(cells, [](const SampledCell& cell) {
        return cell.area < 0 && std::isfinite(cell.area);
      })) {
    fail(node.place, path,
         "`map` is left-handed: where r grows to the right, s grows downwards; write 1 - s in the place of "
         "s, so that bottom and top change places, or 1 - r in that of r, so that left and right do");
  }
  fail(node.place, path,
       fmt::format("the grid folds at point ({}, {}) at t = {:.4g}, near ({:.6g}, {:.6g}); change `map`{}",
                   wrong->i, wrong->j, t, wrong->x[0], wrong->x[1],
                   t > 0 ? ", or let time.end be smaller" : ""));
}

/// Density and pressure are positive and everything is finite at the points at time t.
void check_state(const GasExpressions& state, const std::vector<Vec2>& points, const Node& node,
                 const std::string& path, double t = 0) {
  for (const Vec2& x : points) {
    const auto check = [&](const Expression& quantity, const char* name, bool must_be_positive) {
      const double value = quantity(x[0], x[1], t);
      if (std::isfinite(value) && (value > 0 || !must_be_positive)) return;
      const Node* own = node.find(name);
      fail(own == nullptr ? node.place : own->place, fmt::format("{}.{}", path, name),
           fmt::format("is {} at ({:.6g}, {:.6g}), t = {:.4g}; must be {}", value, x[0], x[1], t,
                       must_be_positive ? "> 0" : "finite"));
    };
    check(state.rho, "rho", true);
    check(state.p, node.find("p") != nullptr ? "p" : "T", true);
    check(state.v1, "v", false);
    check(state.v2, "v", false);
  }
}

/// What is given on curves.
void check_states_on_curves(const Case& problem, const FluidSpec& fluid, const Node& node) {
  for (const GivenOnCurve& given : given_on_curves(fluid, node)) {
    if (!given.spec.state) continue;
    for (int k = 0; k < looked_at_times; ++k)
      check_state(*given.spec.state, given.points, node_at(given.node, {"state"}), given.path + ".state",
                  looked_at_time(problem, k));
  }
}

void check_fluid(const Case& problem, const FluidSpec& fluid, const Node& root) {
  const Node& node = fluid_section_of(root, fluid.name);
  const std::string& path = fluid.path;
  for (int k = 0; k < (fluid.grid.moving ? looked_at_times : 1); ++k)
    check_grid(fluid.grid, node_at(node, {"grid"}), path + ".grid", looked_at_time(problem, k));
  check_overlap({.background = fluid.grid, .body_fitted = fluid.body_fitted, .owner = node, .path = path});
  if (fluid.initial)
    check_state(*fluid.initial, sample_points(fluid), node_at(node, {"initial"}), path + ".initial");
  if (problem.reference.fluid) {
    // The source that makes a chosen solution one is taken at all points, behind curves too.
    const bool everywhere = problem.reference.kind == ReferenceKind::manufactured;
    check_state(*problem.reference.fluid, everywhere ? sample_points(fluid.grid) : sample_points(fluid),
                node_at(root, {"reference", "fluid"}), "reference.fluid");
  }
  for (const Side side : all_sides) {
    const BoundarySpec& spec = fluid.boundary[static_cast<std::size_t>(side)];
    if (!spec.state) continue;
    for (int k = 0; k < times_of_known_values(fluid, side, *spec.state); ++k) {
      const double t = looked_at_time(problem, k);
      check_state(*spec.state, sample_points(fluid.grid, side, t),
                  node_at(node, {"boundary", name_of(side), "state"}),
                  fmt::format("{}.boundary.{}.state", path, name_of(side)), t);
    }
  }
  check_states_on_curves(problem, fluid, node);
}

std::vector<std::string> solid_names(const Case& problem) {
  std::vector<std::string> names;
  for (const SolidSpec& solid : problem.solids) names.push_back(solid.name);
  return names;
}

/// The scheme without added mass is not there where the gas's answer is part of the solid's motion.
void check_projection(const Case& problem, const Node& root) {
  if (problem.interface.projection != Projection::traditional || problem.fluids.empty()) return;
  for (const SolidSpec& solid : problem.solids) {
    if (is_continuum(solid.law) || solid.law == external_law) continue;
    fail(node_at(root, {"interface", "projection"}).place, "interface.projection",
         fmt::format("traditional is not there for the {} `{}`, which is moved together with the gas's "
                     "answer to it; write simplified or full, which are the same for it",
                     solid.law == beam_law ? "beam" : "rigid solid", solid.name));
  }
  if (!problem.time.multirate || problem.solids.empty()) return;
  fail(
      node_at(root, {"time", "multirate"}).place, "time.multirate",
      "does not go with `interface.projection: traditional`, whose substeps would be closed with the solid's "
      "impedance; write false");
}

void check_probes(const Case& problem, const Node& root) {
  std::vector<std::string> places = solid_names(problem);
  for (const FluidSpec& fluid : problem.fluids) places.push_back(fluid.name);
  for (std::size_t k = 0; k < problem.output.probes.size(); ++k) {
    const ProbeSpec& probe = problem.output.probes[k];
    const Node& node = node_at(root, {"output", "probes"}).items[k];
    if (std::find(places.begin(), places.end(), probe.in) == places.end()) {
      fail(node.find("in")->place, fmt::format("output.probes[{}].in", k),
           fmt::format("{} is neither {} nor a solid{}", in_ticks(probe.in),
                       problem.fluids.size() > 1 ? "one of `fluids`" : "`fluid`",
                       did_you_mean(probe.in, places)));
    }
    const auto solid = std::ranges::find(problem.solids, probe.in, &SolidSpec::name);
    if (solid != problem.solids.end() && !solid->program.empty()) {
      fail(node.find("in")->place, fmt::format("output.probes[{}].in", k),
           fmt::format("{} is a program of its own (`law: external`), and what is inside only it knows; "
                       "put the probe into a gas, or leave it out",
                       in_ticks(probe.in)));
    }
    const auto before = problem.output.probes.begin() + static_cast<std::ptrdiff_t>(k);
    if (std::ranges::find(problem.output.probes.begin(), before, probe.name, &ProbeSpec::name) != before)
      fail(node.find("name")->place, fmt::format("output.probes[{}].name", k),
           fmt::format("there are two probes {}; choose another name", in_ticks(probe.name)));
  }
}

/// What is scaled is there in any step, however small: too much of it leaves none that is stable. paper eq. (45)
void check_scheme(const SolidSpec& solid, const Node& node) {
  const SolidScheme& scheme = solid.scheme;
  const double together = scheme.tangential_stress.scaled + scheme.relaxation.scaled,
               most = std::max(together, scheme.displacement.scaled);
  if (most < 2) return;
  fail(node.find("scheme")->place, fmt::format("solids.{}.scheme", solid.name),
       fmt::format("the `scaled` part of {} must be less than 2, is {:.3g}: it damps as much in any step, "
                   "however small; write less of it, or give it as `rate`",
                   together < 2 ? "displacement" : "tangential_stress and relaxation together", most));
}

/// The grid of a solid is its reference configuration.
void check_solid_grid(const SolidSpec& solid, const Node& node) {
  const std::string path = fmt::format("solids.{}.grid", solid.name);
  for (const char* key : {"shake", "shake_seed"}) {
    if (const Node* own = node.find(key))
      fail(own->place, fmt::format("{}.{}", path, key), "the grid of a solid lies still; leave it out");
  }
  if (solid.grid.moving)
    fail(node_at(node, {"map"}).place, path + ".map",
         "must not depend on t: the grid of a solid is its reference configuration");
  check_grid(solid.grid, node, path);
}

/// Every program has a name of its own.
void check_names(const Case& problem, const Node& root) {
  for (std::size_t k = 0; k < problem.solids.size(); ++k) {
    const std::string& name = problem.solids[k].name;
    if (name != "fluid" && name != "coupler" && fluid_named(problem, name) == nullptr) continue;
    fail(node_at(root, {"solids"}).entries[k].place, "solids",
         fmt::format("`{}` is the name of another program; choose another", name));
  }
  const Node& fluids = node_at(root, {"fluids"});
  if (&fluids == &root) return;
  if (root.find("fluid") != nullptr)
    fail(fluids.place, "fluids", "goes in the place of `fluid`; write all gases here");
  for (const config::Entry& entry : fluids.entries) {
    if (entry.key == "fluid" || entry.key == "coupler")
      fail(entry.place, "fluids",
           fmt::format("`{}` is the name of another program; choose another", entry.key));
  }
}

}  // namespace

void check_case(const Case& problem, const Node& root) {
  if (problem.fluids.empty() && problem.solids.empty()) {
    fail(root.place, "", "the case has neither `fluid` nor `solids`; write at least one");
  }
  if (problem.fluids.empty() && problem.solids.size() > 1) {
    fail(node_at(root, {"solids"}).place, "solids",
         "several solids without a gas have nothing in common; write one case for each");
  }
  check_names(problem, root);
  check_geometry(problem, root);
  check_rim(problem, root);
  check_laws(problem, root);
  for (const FluidSpec& fluid : problem.fluids) check_fluid(problem, fluid, root);
  for (const SolidSpec& solid : problem.solids) {
    check_solid_grid(solid, node_at(root, {"solids", solid.name, "grid"}));
    if (!is_continuum(solid.law)) continue;  // need their outline only
    check_scheme(solid, node_at(root, {"solids", solid.name}));
    check_overlap({.background = solid.grid,
                   .body_fitted = fitted_grids(solid),
                   .owner = node_at(root, {"solids", solid.name}),
                   .path = "solids." + solid.name});
  }
  check_images(problem, root);
  check_reference(problem, root);
  check_starts(problem, root);
  check_motions(problem, root);
  check_side_data(problem, root);
  check_interfaces(problem, root);
  check_held_ends(problem, root);
  check_beams(problem, root);
  check_projection(problem, root);
  check_probes(problem, root);
  check_probe_places(problem, root);
  check_expectations(problem, root);
}

}  // namespace fsi
