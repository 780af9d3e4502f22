#include "coupler/matching.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common/core/failure.hpp"
#include "common/core/types.hpp"

namespace fsi::coupler {

namespace {

constexpr double largest_distance = 1e-3;  ///< of the mean spacing of the points

Vec2 point(const std::vector<double>& x, std::size_t k) {
  return {x[k], x[x.size() / 2 + k]};
}

double mean_spacing(const std::vector<double>& x) {
  const std::size_t n = x.size() / 2;
  double sum = 0;
  for (std::size_t k = 1; k < n; ++k) sum += (point(x, k) - point(x, k - 1)).norm();
  return sum / static_cast<double>(n - 1);
}

const wire::Hello& the_fluid(std::span<const wire::Hello> hellos) {
  const auto is_fluid = [](const wire::Hello& hello) { return hello.role == "fluid"; };
  if (std::ranges::count_if(hellos, is_fluid) != 1) {
    throw PeerLost("a coupled run needs exactly one program with the role \"fluid\"");
  }
  return *std::ranges::find_if(hellos, is_fluid);
}

void check_shape(const wire::Hello& hello, const wire::InterfaceInfo& info) {
  if (info.dimension != 2) {
    throw PeerLost(
        fmt::format("\"{}\" says that interface \"{}\" has {} dimensions; this coupler moves curves in 2",
                    hello.name, info.name, info.dimension));
  }
  if (info.x.size() < 4 || info.x.size() % 2 != 0) {
    throw PeerLost(
        fmt::format("\"{}\" gives {} coordinates for interface \"{}\"; at least two points are needed",
                    hello.name, info.x.size(), info.name));
  }
  for (const double coordinate : info.x) {
    if (!std::isfinite(coordinate)) {
      throw PeerLost(fmt::format("\"{}\" gives positions on interface \"{}\" that are not finite", hello.name,
                                 info.name));
    }
  }
}

/// Throws unless the points of both sides lie on each other.
void check_points(const std::string& name, const std::vector<double>& gas, const std::vector<double>& solid) {
  const std::size_t n = gas.size() / 2;
  if (solid.size() != gas.size()) {
    throw UserMistake(
        fmt::format("interface \"{}\": the gas has {} points and the solid {}; give the grids of fluid and "
                    "solids.{} the same number of "
                    "points along this side",
                    name, n, solid.size() / 2, name));
  }
  const double tolerance = largest_distance * mean_spacing(gas);
  const auto distance = [&](std::size_t k, std::size_t l) {
    return (point(gas, k) - point(solid, l)).norm();
  };
  std::size_t worst = 0;
  bool reversed = true;
  for (std::size_t k = 0; k < n; ++k) {
    if (distance(k, k) > distance(worst, worst)) worst = k;
    reversed = reversed && distance(k, n - 1 - k) <= tolerance;
  }
  if (distance(worst, worst) <= tolerance) return;
  if (reversed) {
    throw UserMistake(
        fmt::format("interface \"{}\": the points of gas and solid run in opposite directions; turn the "
                    "parameter along this side "
                    "round in the grid of fluid or of solids.{}",
                    name, name));
  }
  const Vec2 g = point(gas, worst);
  const Vec2 s = point(solid, worst);
  throw UserMistake(
      fmt::format("interface \"{}\": the points of gas and solid do not meet: point {} is at ({:.6g}, "
                  "{:.6g}) in the gas and at ({:.6g}, "
                  "{:.6g}) in the solid, {:.3g} apart; let the grids of fluid and solids.{} have the same "
                  "curve on this side",
                  name, worst, g.x(), g.y(), s.x(), s.y(), distance(worst, worst), name));
}

}  // namespace

std::vector<InterfacePair> match_interfaces(std::span<const wire::Hello> hellos) {
  const wire::Hello& fluid = the_fluid(hellos);
  std::vector<InterfacePair> pairs;
  for (const wire::InterfaceInfo& gas : fluid.interfaces) {
    check_shape(fluid, gas);
    for (const wire::Hello& hello : hellos) {
      if (hello.role != "solid") continue;
      for (const wire::InterfaceInfo& solid : hello.interfaces) {
        if (solid.name != gas.name) continue;
        check_shape(hello, solid);
        check_points(gas.name, gas.x, solid.x);
        pairs.push_back(
            {.fluid = fluid.name, .solid = hello.name, .name = gas.name, .x = gas.x, .n0 = solid.n});
      }
    }
    if (std::ranges::count(pairs, gas.name, &InterfacePair::name) != 1) {
      throw UserMistake(
          fmt::format("interface \"{}\": the gas has a side with this name, so exactly one side of one solid "
                      "must have it too; write it "
                      "in the boundaries of solids.{}",
                      gas.name, gas.name));
    }
  }
  for (const wire::Hello& hello : hellos) {
    for (const wire::InterfaceInfo& info : hello.interfaces) {
      if (std::ranges::count(pairs, info.name, &InterfacePair::name) == 1) continue;
      throw UserMistake(fmt::format(
          "interface \"{}\": no side of the gas has this name; write it in the boundaries of fluid",
          info.name));
    }
  }
  return pairs;
}

}  // namespace fsi::coupler
