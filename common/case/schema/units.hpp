#pragma once
/// The units that keys are in, as powers of a case's own units of length, time and density.

#include <array>
#include <optional>
#include <string_view>

namespace fsi::schema {

/// length^L time^T density^D; a pressure is density length^2 / time^2.
struct Dimensions {
  int length = 0;
  int time = 0;
  int density = 0;
};

struct Unit {
  std::string_view name;  ///< as keys have it
  Dimensions dimensions = {};
};

inline constexpr std::array<Unit, 20> units{{
    {.name = "-"},
    {.name = "degree"},
    {.name = "cell"},
    {.name = "steps"},
    {.name = "s"},  // of the clock, not of the case
    {.name = "length", .dimensions = {.length = 1}},
    {.name = "1/length", .dimensions = {.length = -1}},
    {.name = "time", .dimensions = {.time = 1}},
    {.name = "1/time", .dimensions = {.time = -1}},
    {.name = "length/time^4", .dimensions = {.length = 1, .time = -4}},
    {.name = "velocity", .dimensions = {.length = 1, .time = -1}},
    {.name = "pressure volume/mass", .dimensions = {.length = 2, .time = -2}},
    {.name = "mass/volume", .dimensions = {.density = 1}},
    {.name = "mass/area", .dimensions = {.length = 1, .density = 1}},
    {.name = "pressure", .dimensions = {.length = 2, .time = -2, .density = 1}},
    {.name = "force/volume", .dimensions = {.length = 1, .time = -2, .density = 1}},
    {.name = "force/length/depth", .dimensions = {.length = 2, .time = -2, .density = 1}},
    {.name = "force*length/depth", .dimensions = {.length = 4, .time = -2, .density = 1}},
    {.name = "force*time/length/depth", .dimensions = {.length = 2, .time = -1, .density = 1}},
    {.name = "force*length*time/depth", .dimensions = {.length = 4, .time = -1, .density = 1}},
}};

/// Nothing for a word that is no unit.
constexpr std::optional<Dimensions> dimensions_of(std::string_view unit) {
  for (const Unit& known : units) {
    if (known.name == unit) return known.dimensions;
  }
  return std::nullopt;
}

}  // namespace fsi::schema
