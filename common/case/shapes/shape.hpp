#pragma once
/// What a shape is to the case file. One is a file in this folder with
///
///     facts                 its documentation and its own keys
///     curve(ShapeSection)   the curve, of what a case says
///
/// The curves themselves are functions in common/grid/shapes, or of the file's own.

#include <array>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "common/case/schema/schema.hpp"
#include "common/core/input/config.hpp"
#include "common/core/types.hpp"
#include "common/grid/shapes/plane_curve.hpp"

namespace fsi::shapes {

struct ShapeFacts {
  std::string_view meaning;                ///< for docs/case_file.md
  std::span<const schema::Key> keys = {};  ///< its own, besides `kind` and those of every curve
  bool may_be_open = true;                 ///< its ends may stand on walls
};

/// A section `shape` that was validated.
struct ShapeSection {
  const config::Node& node;
  const std::string& path;  ///< for messages
  grid::Curve ends;         ///< closed, or open from wall to wall

  static Vec2 pair_of(const config::Node& node) { return {*node.items[0].number, *node.items[1].number}; }

  double number(std::string_view key, double fallback) const {
    const config::Node* const value = node.find(key);
    return value == nullptr ? fallback : *value->number;
  }
  Vec2 pair(std::string_view key, const Vec2& fallback) const {
    const config::Node* const value = node.find(key);
    return value == nullptr ? fallback : pair_of(*value);
  }
  /// Of a key that is there.
  std::vector<Vec2> points(std::string_view key) const {
    std::vector<Vec2> points;
    for (const config::Node& item : node.find(key)->items) points.push_back(pair_of(item));
    return points;
  }
};

inline constexpr schema::Key centre_key{.name = "centre",
                                        .type = schema::Type::pair,
                                        .meaning = "its middle",
                                        .unit = "length",
                                        .fallback = "[0, 0]"};
inline constexpr schema::Key point_element{
    .name = "point", .type = schema::Type::pair, .meaning = "[x, y]", .unit = "length"};
inline constexpr schema::Key blunt_key{
    .name = "blunt",
    .meaning = "corners that turn by more than 110 degrees are cut off where the sides are so far apart",
    .unit = "length",
    .fallback = "0.5 * h",
    .range = schema::positive};

}  // namespace fsi::shapes
