#include "common/case/read/build.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <numbers>
#include <utility>

#include "common/case/document/fluid_sections.hpp"
#include "common/case/document/reader.hpp"
#include "common/case/read/build_block.hpp"
#include "common/case/read/build_bodies.hpp"
#include "common/case/read/build_domain.hpp"
#include "common/case/read/build_levels.hpp"
#include "common/case/read/build_material.hpp"
#include "common/case/read/build_shape.hpp"
#include "common/case/read/idle_sides.hpp"
#include "common/case/read/name_gases.hpp"
#include "common/case/schema/laws.hpp"
#include "common/core/input/suggest.hpp"
#include "common/core/time/time_schedule.hpp"

namespace fsi {

namespace {

using config::fail;
using config::Node;

/// Named numbers under `key`.
std::map<std::string, double> numbers_of(const Node& owner, const char* key) {
  std::map<std::string, double> result;
  if (const Node* node = owner.find(key)) {
    for (const config::Entry& entry : node->entries) result[entry.key] = *entry.value.number;
  }
  return result;
}

/// A step so small that the run would never end is a mistake.
double largest_step_of(const Node& dt, double end) {
  constexpr double most_steps = 1e9;
  if (end / *dt.number > most_steps) {
    fail(dt.place, "time.dt",
         fmt::format("{:.3g} would take {:.3g} steps to the end, t = {:.6g}; at most {:.0e} are possible",
                     *dt.number, end / *dt.number, end, most_steps));
  }
  return *dt.number;
}

TimeSpec time_of(const Node& node) {
  TimeSpec result;
  Reader::assign(node, "end", result.end);
  Reader::assign(node, "cfl", result.cfl);
  Reader::assign(node, "growth", result.growth);
  Reader::assign(node, "multirate", result.multirate);
  Reader::assign(node, "robin_order", result.robin_order);
  if (const Node* dt = node.find("dt")) result.dt = largest_step_of(*dt, result.end);
  Reader::assign(node, "join_timeout", result.join_timeout);
  Reader::assign(node, "peer_timeout", result.peer_timeout);
  Reader::assign(node, "step_timeout", result.step_timeout);
  return result;
}

GasScheme gas_scheme_of(const Node& node) {
  GasScheme result;
  Reader::assign(node, "riemann", result.riemann);
  Reader::assign(node, "limiter", result.limiter);
  Reader::assign(node, "entropy_fix", result.entropy_fix);
  if (node.find("shock_viscosity") != nullptr)
    Reader::assign(node, "shock_viscosity", result.shock_viscosity.emplace());
  Reader::assign(node, "linear_diffusion", result.linear_diffusion);
  return result;
}

FluidSpec fluid_of(const Reader& reader, const FluidSection<const Node>& section,
                   const std::vector<SolidSpec>& solids) {
  const Node& node = *section.node;
  const Owner owner{.node = node,
                    .name = section.name,
                    .path = section.path,
                    .partner = solids.size() == 1 ? solids.front().name : "",
                    .is_gas = true};
  FluidSpec result;
  result.name = section.name;
  result.path = section.path;
  Reader::assign(node, "gamma", result.gamma);
  Reader::assign(node, "p_e", result.p_e);
  result.grid = build_grid(reader, owner);
  result.refine = build_levels(*node.find("grid"), section.path + ".grid", result.grid);
  result.boundary = build_boundaries(reader, owner, result.grid);
  check_levels(*node.find("grid"), section.path + ".grid", result);
  result.body_fitted = build_fitted_grids(reader, owner, result.boundary, solids);
  if (const Node* scheme = node.find("scheme")) result.scheme = gas_scheme_of(*scheme);
  const Node& initial = *node.find("initial");
  const std::string path = section.path + ".initial";
  result.initial_from_reference = reader.from_reference(initial, path);
  if (!result.initial_from_reference) result.initial = reader.gas_state(initial, path);
  return result;
}

/// `scaled`: its part that does not depend on the time step, where the scheme does not have the key.
Beta beta_of(const Node* scheme, const char* key, double scaled) {
  const Node* node = scheme == nullptr ? nullptr : scheme->find(key);
  if (node == nullptr) return {.rate = 0, .scaled = scaled};
  Beta result;
  Reader::assign(*node, "rate", result.rate);
  Reader::assign(*node, "scaled", result.scaled);
  return result;
}

/// What no wave carries grows without the three beta: they are on unless the scheme says otherwise.
SolidScheme solid_scheme_of(const Node* node) {
  SolidScheme result;
  result.tangential_stress = beta_of(node, "tangential_stress", 0.5);
  result.displacement = beta_of(node, "displacement", 0.5);
  result.relaxation = beta_of(node, "relaxation", 0.2);
  if (node == nullptr) return result;
  Reader::assign(*node, "limiter", result.limiter);
  Reader::assign(*node, "bulk_diffusion", result.bulk_diffusion);
  return result;
}

/// `program` and an external law go together, and so does `data`.
void check_program(const SolidSpec& solid, const Node& node, const std::string& path) {
  if (solid.law == external_law) {
    if (solid.program.empty())
      fail(node.place, path, "law `external` needs `program: NAME`, the program that is the solid");
    return;
  }
  for (const char* key : {"program", "data"})
    if (const Node* own = node.find(key))
      fail(own->place, fmt::format("{}.{}", path, key), "belongs to `law: external`; leave it out");
}

/// Whether its ends alone hold every motion of a beam that does not deform.
bool holds_itself(const BeamSpec& beam) {
  const auto count = [&](BeamEnd kind) { return std::ranges::count(beam.ends, kind); };
  if (count(BeamEnd::clamped) > 0 || count(BeamEnd::pinned) == 2) return true;
  if (count(BeamEnd::guided) < 2) return count(BeamEnd::pinned) == 1 && count(BeamEnd::guided) == 1;
  const std::size_t n = beam.line.size();
  const Vec2 first = (beam.line[1] - beam.line[0]).normalized(),
             last = (beam.line[n - 1] - beam.line[n - 2]).normalized();
  return std::fabs(cross(first, last)) > 1e-6;  // two guided ends move across their lines, which differ
}

/// A beam may have no mass where its ends, or the gas, hold every motion: nothing resists the sliding of a free
/// one, or of a ring, along itself.
void check_mass(const SolidSpec& solid, bool in_gas, const Node& node, const std::string& path) {
  if (solid.rho > 0) return;
  const std::string& place = node.find("rho")->place;
  if (!solid.beam)
    fail(place, path + ".rho", "must be > 0 [mass/volume], is 0: only a beam may have no mass");
  const bool held = std::ranges::any_of(solid.beam->ends, [](BeamEnd end) { return end != BeamEnd::free; });
  if (!held || solid.beam->closed)
    fail(place, path + ".rho",
         "must be > 0 [mass/volume], is 0: nothing would resist the sliding of this beam along itself; hold "
         "one of its ends, or give it a mass");
  if (in_gas || holds_itself(*solid.beam)) return;
  fail(place, path + ".rho",
       fmt::format(
           "must be > 0 [mass/volume], is 0: without a gas nothing would resist that this beam {}; clamp "
           "one of its ends, or give it a mass",
           std::ranges::count(solid.beam->ends, BeamEnd::pinned) > 0 ? "turns" : "moves across its line"));
}

SolidSpec solid_of(const Reader& reader, const config::Entry& entry) {
  const Node& node = entry.value;
  const Owner owner{.node = node, .name = entry.key, .path = "solids." + entry.key, .partner = ""};
  SolidSpec result;
  result.name = entry.key;
  Reader::assign(node, "law", result.law);
  Reader::assign(node, "program", result.program);
  result.data = numbers_of(node, "data");
  check_program(result, node, owner.path);
  Reader::assign(node, "rho", result.rho);
  if (const Node* motion = node.find("motion")) {
    if (result.law != "rigid")
      fail(motion->place, owner.path + ".motion", "belongs to `law: rigid`; leave it out");
    result.fixed = motion->text == "fixed";
  }
  result.mounting = build_mounting(reader, node, owner.path, result.law == rigid_law);
  build_material(node, owner.path, result);
  result.grid = build_solid_grid(reader, owner);
  result.boundary = build_boundaries(reader, owner, result.grid);
  result.body_fitted = build_outline_grid(reader, owner, result.boundary);
  refuse_idle_sides(node, owner.path, result);
  complete_block(node, owner.path, result);
  result.scheme = solid_scheme_of(node.find("scheme"));
  result.beam = build_beam(reader, node, result.law, owner.path);
  check_mass(result, !fluid_sections(reader.root()).empty(), node, owner.path);
  if (const Node* force = node.find("body_force")) result.body_force = reader.vector(*force);
  const Node* initial = node.find("initial");
  if (initial == nullptr) return result;
  result.initial_from_reference = reader.from_reference(*initial, owner.path + ".initial");
  if (const Node* u = initial->find("u")) result.initial_u = reader.vector(*u);
  if (const Node* v = initial->find("v")) result.initial_v = reader.vector(*v);
  return result;
}

ReferenceSpec reference_of(const Reader& reader) {
  ReferenceSpec result;
  const Node* node = reader.root().find("reference");
  if (node == nullptr) return result;
  for (const config::Entry& entry : node->entries) {
    if (entry.key == "kind") {
      result.kind = named<ReferenceKind>(entry.value.text).value();
    } else if (entry.key == "fluid") {
      result.fluid = reader.gas_state(entry.value, "reference.fluid");
    } else if (entry.key == "u") {
      result.u = reader.vector(entry.value);
    } else if (entry.key == "v") {
      result.v = reader.vector(entry.value);
    } else if (entry.key == "P") {
      result.P = reader.tensor(entry.value);
    } else {
      const double unit = entry.key == "rotation" ? std::numbers::pi / 180 : 1;
      result.numbers[entry.key] = *entry.value.number * unit;
    }
  }
  return result;
}

void add_multiples(const Node& every, double end, std::vector<double>& times) {
  constexpr double most = 1e5;
  const double count = std::floor(end / *every.number * (1 + 1e-12));  // the end itself in spite of rounding
  if (!(count <= most)) {
    fail(every.place, "output.every",
         fmt::format("asks for {} output times; at most {} are possible", count, most));
  }
  for (double k = 0; k <= count; ++k) times.push_back(std::min(k * *every.number, end));
}

OutputSpec output_of(const Node* node, double end) {
  OutputSpec result;
  if (node == nullptr) return {.times = {end}, .probes = {}};
  Reader::assign(*node, "checkpoint_every", result.checkpoint_every);
  Reader::assign(*node, "checkpoint_seconds", result.checkpoint_seconds);
  Reader::assign(*node, "checkpoint_at_end", result.checkpoint_at_end);
  if (const Node* word = node->find("on_failure")) result.go_on = word->text == "go_on";
  const Node* times = node->find("times");
  const Node* every = node->find("every");
  if (times != nullptr) {
    for (const Node& item : times->items) {
      result.times.push_back(*item.number);
      if (*item.number > end) result.left_out.push_back(*item.number);
    }
  }
  if (every != nullptr) add_multiples(*every, end, result.times);
  result.times = distinct_times(std::move(result.times), end);
  if (result.times.empty()) result.times = {end};
  if (const Node* probes = node->find("probes")) {
    for (const Node& item : probes->items) {
      result.probes.push_back(
          {item.find("name")->text, item.find("in")->text, *item.find("x")->number, *item.find("y")->number});
    }
  }
  return result;
}

Expectation expectation_of(const config::Entry& entry) {
  Expectation result{.quantity = entry.key, .max = {}, .min = {}, .equals = {}};
  if (entry.value.is_scalar()) {
    result.equals = entry.value.text;
    return result;
  }
  if (const Node* max = entry.value.find("max")) result.max = *max->number;
  if (const Node* min = entry.value.find("min")) result.min = *min->number;
  if (const Node* equals = entry.value.find("equals")) result.equals = equals->text;
  if (!result.max && !result.min && !result.equals) {
    fail(entry.place, "expect." + entry.key, "expects nothing; write {max: ..}, {min: ..} or a word");
  }
  if (result.min && result.max && *result.min > *result.max)
    fail(entry.place, "expect." + entry.key,
         fmt::format("cannot be met: min, {:g}, is above max, {:g}", *result.min, *result.max));
  return result;
}

/// The name of a case becomes part of the names of files.
std::string case_name_of(const Node& root) {
  const Node& node = *root.find("name");
  const bool begins_well = !node.text.starts_with('.') && !node.text.starts_with('-');
  if (node.text.empty() || !begins_well || !std::ranges::all_of(node.text, fits_case_name)) {
    fail(node.place, "name",
         fmt::format("{} cannot name files; use letters, digits, _, - and ., these two not first",
                     in_ticks(node.text)));
  }
  if (node.text.size() > longest_case_name) {
    fail(node.place, "name",
         fmt::format("has {} characters; it becomes part of the names of files, at most {} fit",
                     node.text.size(), longest_case_name));
  }
  return node.text;
}

}  // namespace

bool fits_case_name(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '.' || c == '-';
}

Case build_case(const Node& root, const Scope& scope) {
  const Reader reader(root, scope);
  Case result;
  result.name = case_name_of(root);
  Reader::assign(root, "title", result.title);
  if (const Node* units = root.find("units")) result.in_si = units->text == "SI";
  result.parameters = numbers_of(root, "parameters");
  result.grid_factor = scope.constants.at("j");
  result.time = time_of(*root.find("time"));
  if (const Node* node = root.find("interface")) {
    Reader::assign(*node, "projection", result.interface.projection);
    Reader::assign(*node, "riemann", result.interface.riemann);
    if (const Node* motion = node->find("motion")) result.interface.motion = reader.vector(*motion);
  }
  if (const Node* node = root.find("solids")) {
    for (const config::Entry& entry : node->entries) result.solids.push_back(solid_of(reader, entry));
  }
  for (const FluidSection<const Node>& section : fluid_sections(root))
    result.fluids.push_back(fluid_of(reader, section, result.solids));
  name_gases(result, root);
  result.output = output_of(root.find("output"), result.time.end);
  result.reference = reference_of(reader);
  if (const Node* node = root.find("expect")) {
    for (const config::Entry& entry : node->entries) result.expect.push_back(expectation_of(entry));
  }
  return result;
}

}  // namespace fsi
