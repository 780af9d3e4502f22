#include "common/case/read/build_domain.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>

#include "common/case/schema/boundary_facts.hpp"

namespace fsi {

namespace {

using config::fail;
using config::Node;
using schema::Key;
using schema::Type;

/// What the kind of a side has for keys.
std::span<const Key> keys_of(const Owner& owner, BoundaryKind kind) {
  return owner.is_gas ? schema::gas_boundary(kind).keys : schema::solid_boundary(kind).keys;
}

void read_rectangle(const Node& node, const std::string& path, GridSpec& grid) {
  const auto read = [&](const char* key, double& a, double& b) {
    const Node& ends = *node.find(key);
    a = *ends.items[0].number;
    b = *ends.items[1].number;
    if (!(b > a))
      fail(ends.place, fmt::format("{}.{}", path, key), "the second end must be greater than the first");
  };
  read("x", grid.x_a, grid.x_b);
  read("y", grid.y_a, grid.y_b);
}

constexpr double fewest_points = 5, most_points = 1e5;

double points_along(double length, double spacing) {
  return std::round(length / spacing) + 1;
}

/// What to write in the place of a spacing that a rectangle cannot have: 32 to 80 cells along the shorter side, fewer where the
/// longer one would have too many. @param is_h it is that of the resolution, as are others then
std::string other_spacing(bool is_h, double width, double height) {
  const double finest = std::max(std::min(width, height) / 80, std::max(width, height) / (most_points - 2));
  const double decade = std::pow(10, std::floor(std::log10(finest)));
  const double spacing = (finest <= decade       ? 1
                          : finest <= 2 * decade ? 2
                          : finest <= 5 * decade ? 5
                                                 : 10) *
                         decade;
  return fmt::format(
      "write `{}` for {} x {} of them",
      is_h ? fmt::format("grid: {{factor: {:.4g}}}", 0.1 / spacing) : fmt::format("spacing: {:.4g}", spacing),
      points_along(width, spacing), points_along(height, spacing));
}

void read_points(const Node& node, const std::string& path, double h, GridSpec& grid) {
  const Node* counts = node.find("points");
  const Node* spacing = node.find("spacing");
  if (counts != nullptr && spacing != nullptr)
    fail(spacing->place, path, "give `points` or `spacing`, one of them");
  if (counts == nullptr && spacing == nullptr) {
    fail(node.place, path, "`points: [.., ..]` is missing (or `spacing: h` for a rectangle)");
  }
  if (counts != nullptr) {
    grid.n1 = static_cast<int>(*counts->items[0].number);
    grid.n2 = static_cast<int>(*counts->items[1].number);
    return;
  }
  const double width = grid.x_b - grid.x_a, height = grid.y_b - grid.y_a;
  const double n1 = points_along(width, *spacing->number), n2 = points_along(height, *spacing->number);
  if (!(std::min(n1, n2) >= fewest_points) || !(std::max(n1, n2) <= most_points)) {
    fail(spacing->place, path + ".spacing",
         fmt::format("gives {} x {} points; {} to {} are possible in each direction: {}", n1, n2,
                     fewest_points, most_points, other_spacing(*spacing->number == h, width, height)));
  }
  grid.n1 = static_cast<int>(n1);
  grid.n2 = static_cast<int>(n2);
}

/// A state of the gas on one line, as the file has it.
std::string as_written(const Node& state) {
  const auto formula = [](const Node& node) {
    return node.text.find_first_of(",:") == std::string::npos ? node.text : fmt::format("\"{}\"", node.text);
  };
  const Node &v = *state.find("v"), *p = state.find("p");
  const Node& p_or_T = p != nullptr ? *p : *state.find("T");
  return fmt::format("{{rho: {}, v: [{}, {}], {}: {}}}", formula(*state.find("rho")), formula(v.items[0]),
                     formula(v.items[1]), p != nullptr ? "p" : "T", formula(p_or_T));
}

/// What a side of this kind takes where there is no reference solution.
std::string data_for(const Owner& owner, const std::string& kind) {
  const Node* initial = owner.is_gas ? owner.node.find("initial") : nullptr;
  if (initial == nullptr || (initial->find("p") == nullptr) == (initial->find("T") == nullptr))
    return "give the data here";
  return fmt::format("write {{kind: {}, state: {}}} for the gas that is there at the start", kind,
                     as_written(*initial));
}

BoundarySpec boundary_from_word(const Reader& reader, const Owner& owner, const Node& node,
                                const std::string& path) {
  BoundarySpec result;
  if (const BoundaryKind zero = schema::kind_for_zero(node.text);
      !owner.is_gas && zero != BoundaryKind::none) {
    result.kind = zero;
    result.vector = VectorExpressions{Expression(0.0), Expression(0.0)};
    return result;
  }
  result.kind = named<BoundaryKind>(node.text).value();
  if (std::ranges::any_of(keys_of(owner, result.kind), schema::takes_reference))
    result.from_reference = reader.from_reference(node, path, data_for(owner, node.text));
  if (result.kind == BoundaryKind::interface && owner.is_gas) {
    if (owner.partner.empty())
      fail(node.place, path, "write {kind: interface, solid: NAME}: the case has not one solid");
    result.solid = owner.partner;
  }
  return result;
}

/// The value of a key of the kind, by its type; words and names have places of their own.
void read_value(const Reader& reader, const Key& key, const Node& value, const std::string& path,
                BoundarySpec& result) {
  const std::string name(key.name);
  switch (key.type) {
    case Type::number:
    case Type::integer:
      result.numbers[name] = *value.number;
      return;
    case Type::field:
      result.fields.insert_or_assign(name, reader.expression(value));
      return;
    case Type::vector:
      if (name == "value") {
        result.vector = reader.vector(value);
      } else if (name == "velocity") {
        result.velocity = reader.vector(value);
      } else {
        result.vectors.insert_or_assign(name, reader.vector(value));
      }
      return;
    case Type::section:
      result.state = reader.gas_state(value, fmt::format("{}.{}", path, name));
      return;
    default:
      return;
  }
}

}  // namespace

BoundarySpec build_boundary(const Reader& reader, const Owner& owner, const Node& node,
                            const std::string& path) {
  if (node.is_scalar()) return boundary_from_word(reader, owner, node, path);
  BoundarySpec result;
  result.kind = named<BoundaryKind>(node.find("kind")->text).value();
  Reader::assign(node, "solid", result.solid);
  Reader::assign(node, "fluid", result.fluid);
  Reader::assign(node, "load", result.load);
  for (const Key& key : keys_of(owner, result.kind)) {
    const Node* value = node.find(key.name);
    if (value == nullptr) continue;
    if (schema::takes_reference(key) && reader.from_reference(*value, path)) {
      result.from_reference = true;
    } else {
      read_value(reader, key, *value, path, result);
    }
  }
  if (result.from_reference && result.velocity)
    fail(node.find("velocity")->place, path + ".velocity",
         "has no effect: `reference` brings the velocity with the displacement; leave it out");
  return result;
}

GridSpec build_grid(const Reader& reader, const Owner& owner) {
  if (owner.node.find("grid") == nullptr)
    fail(
        owner.node.place, owner.path,
        fmt::format("`grid` is missing; write {}{{x: [.., ..], y: [.., ..], spacing: h}}",
                    owner.path.starts_with("solids.")
                        ? "a `shape`, along which it meets the gas all around and grids are chosen, or, with "
                          "one `interface` among its sides, "
                        : ""));
  const Node& node = *owner.node.find("grid");
  const std::string path = owner.path + ".grid";
  GridSpec grid;
  grid.name = owner.name;
  Reader::assign(node, "name", grid.name);
  Reader::assign(node, "shake", grid.shake);
  if (const Node* seed = node.find("shake_seed")) grid.shake_seed = static_cast<std::uint64_t>(*seed->number);
  if (const Node* degrees = node.find("rotation")) grid.rotation = *degrees->number * std::numbers::pi / 180;
  if (const Node* map = node.find("map")) {
    grid.kind = GridSpec::Kind::mapped;
    grid.map = reader.vector(*map);
    grid.moving = grid.map.c1.uses("t") || grid.map.c2.uses("t");
  } else {
    read_rectangle(node, path, grid);
  }
  read_points(node, path, reader.scope().constants.at("h"), grid);
  return grid;
}

std::array<BoundarySpec, 4> build_boundaries(const Reader& reader, const Owner& owner, GridSpec& grid) {
  const std::string path = owner.path + ".boundary";
  std::array<BoundarySpec, 4> result;
  const Node* boundary = owner.node.find("boundary");
  if (boundary == nullptr) {
    if (owner.node.find("shape") == nullptr)
      fail(owner.node.place, owner.path, "`boundary` is missing (the four sides of the grid)");
    result.fill({.kind = BoundaryKind::none});
    return result;
  }
  const Node& node = *boundary;
  const auto spec = [&](Side side) -> BoundarySpec& { return result[static_cast<std::size_t>(side)]; };
  for (const Side side : all_sides) {
    spec(side) =
        build_boundary(reader, owner, *node.find(name_of(side)), fmt::format("{}.{}", path, name_of(side)));
  }
  for (const auto& [side, opposite] :
       {std::pair{Side::left, Side::right}, std::pair{Side::bottom, Side::top}}) {
    const bool here = spec(side).kind == BoundaryKind::periodic;
    const bool there = spec(opposite).kind == BoundaryKind::periodic;
    if (here != there) {
      fail(node.place, path,
           fmt::format("{} is periodic and {} is not; write both", name_of(here ? side : opposite),
                       name_of(here ? opposite : side)));
    }
    grid.periodic[static_cast<std::size_t>(direction_of(side))] = here;
  }
  return result;
}

}  // namespace fsi
