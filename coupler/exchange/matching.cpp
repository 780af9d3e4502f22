#include "coupler/exchange/matching.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/core/component_major.hpp"
#include "common/core/failure.hpp"
#include "common/core/types.hpp"
#include "coupler/exchange/curve_interpolation.hpp"

namespace fsi::coupler {

namespace {

constexpr double same_point = 1e-3;  ///< of the mean spacing of the points
constexpr double same_curve = 0.05;  ///< of the mean spacing of the coarser side

double mean_spacing(const std::vector<double>& x) {
  const std::size_t n = x.size() / 2;
  double sum = 0;
  for (std::size_t k = 1; k < n; ++k) sum += (vector_at(x, k) - vector_at(x, k - 1)).norm();
  return sum / static_cast<double>(n - 1);
}

void expect_fluid(std::span<const wire::Hello> hellos) {
  const auto is_fluid = [](const wire::Hello& hello) { return hello.role == "fluid"; };
  if (std::ranges::none_of(hellos, is_fluid))
    throw PeerLost("a coupled run needs a program with the role \"fluid\"");
}

void check_normals(const wire::Hello& hello, const wire::InterfaceInfo& info) {
  constexpr double tolerance = 1e-3;
  if (info.n.size() != info.x.size()) return;  // refused with its reason by `Curve`
  for (std::size_t k = 0; k < info.n.size() / 2; ++k) {
    const double length = vector_at(info.n, k).norm();
    if (std::abs(length - 1) <= tolerance) continue;
    throw PeerLost(
        fmt::format("\"{}\" gives normal {} of interface \"{}\" the length {:.6g}; send unit normals",
                    hello.name, k, info.name, length));
  }
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

/// Index of the two points of the same number that are farthest apart.
std::size_t farthest_pair(const std::vector<double>& gas, const std::vector<double>& solid) {
  std::size_t worst = 0;
  const auto distance = [&](std::size_t k) { return (vector_at(gas, k) - vector_at(solid, k)).norm(); };
  for (std::size_t k = 1; k < gas.size() / 2; ++k) {
    if (distance(k) > distance(worst)) worst = k;
  }
  return worst;
}

bool same_points(const std::vector<double>& gas, const std::vector<double>& solid) {
  if (gas.size() != solid.size()) return false;
  const std::size_t k = farthest_pair(gas, solid);
  return (vector_at(gas, k) - vector_at(solid, k)).norm() <= same_point * mean_spacing(gas);
}

/// One side's points and what it is called in messages.
struct Points {
  std::string of;
  const std::vector<double>& x;
};

/// Throws unless the points of `to` lie on the curve through those of `from`.
void check_curve(const InterfacePair& pair, const Points& from, const Points& to, double tolerance) {
  const std::string& name = pair.name;
  const CurveInterpolation curve(from.x, to.x, pair.periodic);
  if (curve.largest_distance() <= tolerance) return;
  const Vec2 x = vector_at(to.x, curve.farthest());
  throw UserMistake(
      fmt::format("interface \"{}\": gas and solid do not meet: point {} of the {} is at ({:.6g}, {:.6g}), "
                  "{:.3g} from the side of the {}; let the grids of fluid and solids.{} have the same curve "
                  "on this side",
                  name, curve.farthest(), to.of, x.x(), x.y(), curve.largest_distance(), from.of, name));
}

std::vector<double> normals_at(const std::vector<double>& to, const wire::InterfaceInfo& solid,
                               bool periodic) {
  std::vector<double> n(to.size());
  if (solid.n.size() != solid.x.size()) return {};  // refused with its reason by `Curve`
  CurveInterpolation(solid.x, to, periodic).linear(solid.n, n);
  return n;
}

/// Both sides of an interface whose points differ.
InterfacePair interpolated(InterfacePair pair, const wire::InterfaceInfo& gas,
                           const wire::InterfaceInfo& solid) {
  const bool gas_is_coarser = gas.x.size() < solid.x.size();
  const double tolerance = same_curve * mean_spacing(gas_is_coarser ? gas.x : solid.x);
  const Points of_gas{"gas", gas.x}, of_solid{"solid", solid.x};
  check_curve(pair, of_solid, of_gas, tolerance);
  check_curve(pair, of_gas, of_solid, tolerance);
  pair.x = gas_is_coarser ? solid.x : gas.x;
  pair.n0 = gas_is_coarser ? solid.n : normals_at(gas.x, solid, pair.periodic);
  pair.coarser = {.is_gas = gas_is_coarser,
                  .x = gas_is_coarser ? gas.x : solid.x,
                  .n0 = gas_is_coarser ? normals_at(gas.x, solid, pair.periodic) : solid.n};
  return pair;
}

/// `pair` has the names.
InterfacePair pair_of(InterfacePair pair, const wire::InterfaceInfo& gas, const wire::InterfaceInfo& solid) {
  if (!same_points(gas.x, solid.x)) return interpolated(std::move(pair), gas, solid);
  pair.x = gas.x;
  pair.n0 = solid.n;
  return pair;
}

/// Adds the interfaces of one gas.
void match_gas(const wire::Hello& fluid, std::span<const wire::Hello> hellos,
               std::span<const std::string> periodic, std::vector<InterfacePair>& pairs) {
  for (const wire::InterfaceInfo& gas : fluid.interfaces) {
    check_shape(fluid, gas);
    if (const auto other = std::ranges::find(pairs, gas.name, &InterfacePair::name); other != pairs.end()) {
      throw PeerLost(fmt::format(
          "the gases \"{}\" and \"{}\" both say that interface \"{}\" is theirs; where a solid meets "
          "several gases it has an interface with each, <solid>.<gas>",
          other->fluid, fluid.name, gas.name));
    }
    for (const wire::Hello& hello : hellos) {
      if (hello.role != "solid") continue;
      for (const wire::InterfaceInfo& solid : hello.interfaces) {
        if (solid.name != gas.name) continue;
        check_shape(hello, solid);
        check_normals(hello, solid);
        const bool goes_on = std::ranges::find(periodic, gas.name) != periodic.end();
        pairs.push_back(pair_of({.fluid = fluid.name,
                                 .solid = hello.name,
                                 .name = gas.name,
                                 .x = {},
                                 .n0 = {},
                                 .periodic = goes_on},
                                gas, solid));
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
}

}  // namespace

std::vector<InterfacePair> match_interfaces(std::span<const wire::Hello> hellos,
                                            std::span<const std::string> periodic) {
  expect_fluid(hellos);
  std::vector<InterfacePair> pairs;
  for (const wire::Hello& hello : hellos) {
    if (hello.role == "fluid") match_gas(hello, hellos, periodic, pairs);
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
