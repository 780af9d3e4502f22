#include "common/case/read/build_bodies.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "common/case/schema/laws.hpp"

namespace fsi {

namespace {

using config::fail;
using config::Node;

// --- rigid bodies

constexpr std::array<const char*, 4> mounting_keys{"degrees_of_freedom", "pivot", "spring", "damper"};

std::array<bool, 3> freedoms_of(const Node& list, const std::string& path) {
  if (list.items.empty()) fail(list.place, path, "leaves no motion; write `motion: fixed` in its place");
  std::array<bool, 3> free{};
  for (const Node& word : list.items) {
    const auto k =
        static_cast<std::size_t>(std::ranges::find(rigid_motions, word.text) - rigid_motions.begin());
    if (free[k]) fail(word.place, path, fmt::format("`{}` stands there twice; leave one out", word.text));
    free[k] = true;
  }
  return free;
}

/// Formulas of the section `motion`, and whether the other motions are free by default: they are not.
void take_given(const Reader& reader, const Node& section, const std::string& path, MountingSpec& mounting) {
  if (section.entries.empty())
    fail(section.place, path, "says of no motion what it is; give `x`, `y` or `rotation`, or leave it out");
  mounting.free = {};
  for (const config::Entry& entry : section.entries) {
    const auto k =
        static_cast<std::size_t>(std::ranges::find(rigid_motions, entry.key) - rigid_motions.begin());
    const Expression formula = reader.expression(entry.value);
    for (const char* variable : {"x", "y", "r", "s"}) {
      if (formula.uses(variable))
        fail(entry.place, fmt::format("{}.{}", path, entry.key),
             fmt::format("the body moves as a whole: a formula of `t` alone, not of `{}`", variable));
    }
    mounting.given[k] = formula;
  }
}

void refuse_given_twice(const MountingSpec& mounting, const Node& list, const std::string& path) {
  for (const Node& word : list.items) {
    const auto k =
        static_cast<std::size_t>(std::ranges::find(rigid_motions, word.text) - rigid_motions.begin());
    if (mounting.given[k])
      fail(word.place, path,
           fmt::format("`{}` is given by `motion`, and cannot be free; leave one of them out", word.text));
  }
}

/// Stiffnesses or resistances of a section; of motions that there are.
std::array<double, 3> values_of(const Node& section, const std::array<bool, 3>& free,
                                const std::string& path) {
  std::array<double, 3> values{};
  for (const config::Entry& entry : section.entries) {
    const auto k =
        static_cast<std::size_t>(std::ranges::find(rigid_motions, entry.key) - rigid_motions.begin());
    values[k] = *entry.value.number;
    if (values[k] > 0 && !free[k])
      fail(entry.place, fmt::format("{}.{}", path, entry.key),
           fmt::format("`{}` is not among the `degrees_of_freedom`; add it there, or leave this out",
                       entry.key));
  }
  return values;
}

// --- beams

constexpr double fewest_elements = 3, most_elements = 5000;  ///< elements, as in the schema

/// Does the last point say where the first one is again? Numbers that were computed meet to round-off.
bool comes_back(const std::vector<Vec2>& line) {
  constexpr double round_off = 1e-6;  // of the way to the second point
  return (line.back() - line.front()).norm() < round_off * (line[1] - line[0]).norm();
}

std::vector<Vec2> line_of(const Node& list, bool closed, const std::string& path) {
  std::vector<Vec2> line;
  for (const Node& item : list.items) line.emplace_back(*item.items[0].number, *item.items[1].number);
  const bool straight = line.size() == 2 && !closed;
  if (!straight && line.size() < 4) {
    fail(list.place, path + ".line",
         closed ? "a ring needs four points or more" : "give two points (a straight line), or four and more");
  }
  for (std::size_t k = 1; k < line.size(); ++k) {
    if (line[k] == line[k - 1])
      fail(list.items[k].place, path + ".line", fmt::format("point {} is the one before it again", k + 1));
  }
  if (closed && comes_back(line))
    fail(list.items.back().place, path + ".line",
         "a ring closes by itself; leave out its last point, the first one again");
  return line;
}

/// As many as fit with the length h.
int elements_of(const Reader& reader, const BeamSpec& beam) {
  double length = beam.closed ? (beam.line.front() - beam.line.back()).norm() : 0;
  for (std::size_t k = 1; k < beam.line.size(); ++k) length += (beam.line[k] - beam.line[k - 1]).norm();
  return static_cast<int>(
      std::clamp(std::round(length / reader.scope().constants.at("h")), fewest_elements, most_elements));
}

}  // namespace

MountingSpec build_mounting(const Reader& reader, const Node& solid, const std::string& path, bool rigid) {
  const Node* motion = solid.find("motion");
  const bool fixed = motion != nullptr && motion->text == "fixed";
  for (const char* key : mounting_keys) {
    const Node* given = solid.find(key);
    if (given == nullptr || (rigid && !fixed)) continue;
    fail(given->place, fmt::format("{}.{}", path, key),
         rigid ? "the body is fixed (`motion: fixed`) and moves nowhere; leave one of them out"
               : "belongs to `law: rigid`; leave it out");
  }
  MountingSpec result;
  if (motion != nullptr && motion->is_map()) take_given(reader, *motion, path + ".motion", result);
  if (const Node* list = solid.find("degrees_of_freedom")) {
    result.free = freedoms_of(*list, path + ".degrees_of_freedom");
    refuse_given_twice(result, *list, path + ".degrees_of_freedom");
  }
  if (const Node* pivot = solid.find("pivot"))
    result.pivot = Vec2(*pivot->items[0].number, *pivot->items[1].number);
  if (const Node* spring = solid.find("spring"))
    result.spring = values_of(*spring, result.free, path + ".spring");
  if (const Node* damper = solid.find("damper"))
    result.damper = values_of(*damper, result.free, path + ".damper");
  return result;
}

std::optional<BeamSpec> build_beam(const Reader& reader, const Node& solid, std::string_view law,
                                   const std::string& path) {
  const Node* node = solid.find("beam");
  if (node == nullptr) {
    if (law == beam_law) {
      fail(solid.place, path,
           "law `beam` needs the section `beam: {line: [[x, y], [x, y]], thickness: d, ends: [.., ..]}`");
    }
    return std::nullopt;
  }
  const std::string where = path + ".beam";
  BeamSpec beam;
  Reader::assign(*node, "closed", beam.closed);
  beam.line = line_of(*node->find("line"), beam.closed, where);
  beam.thickness = reader.expression(*node->find("thickness"));
  beam.elements = elements_of(reader, beam);
  Reader::assign(*node, "elements", beam.elements);
  if (const Node* ends = node->find("ends")) {
    if (ends->items.size() != 2) fail(ends->place, where + ".ends", "must be two words, [clamped, free]");
    if (beam.closed) fail(ends->place, where + ".ends", "a ring has none; leave them out");
    for (std::size_t k = 0; k < 2; ++k) beam.ends[k] = named<BeamEnd>(ends->items[k].text).value();
  }
  const bool loose = std::ranges::count(beam.ends, BeamEnd::free) > 0;
  if (!beam.closed && loose && beam.line.size() > 2 && comes_back(beam.line)) {
    fail(node->find("line")->items.back().place, where + ".line",
         "comes back to its first point, where an end is free and would come apart; for a ring write "
         "`closed: true` "
         "and leave this point out");
  }
  return beam;
}

}  // namespace fsi
