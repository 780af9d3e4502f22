#include "fluid_solver/measures/strong_shocks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "common/core/field.hpp"
#include "common/core/types.hpp"
#include "common/grid/intervals.hpp"

namespace fsi::fluid {

namespace {

/// Cells that a captured shock takes at most.
constexpr int thickness = 4;
/// The gas must be compressed along a line by this part of what the jump of pressure asks for: an expansion is not, and a
/// shock that lies askew is in no danger.
constexpr double along_the_line = 0.7;

/// Of the lower pressure, the density there, the higher pressure, and how much slower the gas becomes along the line.
struct Jump {
  double p_low, rho_low, p_high, slowed;
};

/// Mach number of the shock that makes such a jump; 0 where none does.
double mach_of(const Jump& jump, double gamma) {
  const double mach = std::sqrt(1 + (gamma + 1) / (2 * gamma) * (jump.p_high / jump.p_low - 1));
  const double slows = 2 / (gamma + 1) * (mach - 1 / mach) * std::sqrt(gamma * jump.p_low / jump.rho_low);
  return jump.slowed > along_the_line * slows ? mach : 0;
}

/// Looks at the points of one grid and those some points further along a line.
class Line {
 public:
  Line(const grid::WatchedGrid& on, double gamma, int di, int dj)
      : on_(on),
        gamma_(gamma),
        least_ratio_(1 + 2 * gamma / (gamma + 1) * (ShockWatch::faintest * ShockWatch::faintest - 1)),
        di_(di * thickness),
        dj_(dj * thickness) {}

  /// Mach number of a shock between point (i, j) and the other; 0: there is none.
  double shock_at(int i, int j) const {
    const double here = on_.q(3, i, j), there = on_.q(3, i + di_, j + dj_);
    const double low = std::min(here, there), high = std::max(here, there);
    if (!(low > 0 && high > least_ratio_ * low) || !all_between(i, j)) return 0;
    const Vec2 way(on_.x(0, i + di_, j + dj_) - on_.x(0, i, j), on_.x(1, i + di_, j + dj_) - on_.x(1, i, j));
    const Vec2 slower(on_.q(1, i, j) - on_.q(1, i + di_, j + dj_),
                      on_.q(2, i, j) - on_.q(2, i + di_, j + dj_));
    const double rho = here < there ? on_.q(0, i, j) : on_.q(0, i + di_, j + dj_);
    return mach_of({.p_low = low, .rho_low = rho, .p_high = high, .slowed = slower.dot(way.normalized())},
                   gamma_);
  }

 private:
  bool all_between(int i, int j) const {
    for (int row = j; row <= j + dj_; ++row)
      if (!on_.points->contains({i, i + di_ + 1}, row)) return false;
    return true;
  }

  const grid::WatchedGrid& on_;
  double gamma_, least_ratio_;
  int di_, dj_;
};

}  // namespace

ShockWatch::ShockWatch(double gamma, std::vector<std::string> grids)
    : Watch({{.components = {"p"}, .first = 3, .floor = 0}}, std::move(grids)), gamma_(gamma) {}

void ShockWatch::look(std::span<const grid::WatchedGrid> grids, double t) {
  begin();
  for (std::size_t g = 0; g < grids.size(); ++g) {
    const grid::WatchedGrid& on = grids[g];
    const int n2 = on.q.layout.n2;
    const Line rows(on, gamma_, 1, 0), columns(on, gamma_, 0, 1);
    const auto note = [&](double mach, int i, int j) {
      if (mach <= now().size) return;
      keep({.size = mach,
            .component = 0,
            .grid = static_cast<int>(g),
            .i = i,
            .j = j,
            .place = {on.x(0, i, j), on.x(1, i, j)},
            .t = t});
    };
    for (int j = 0; j < n2; ++j) {
      for (const grid::Interval& run : on.points->row(j)) {
        for (int i = run.begin; i < run.end - thickness; ++i) note(rows.shock_at(i, j), i, j);
        for (int i = run.begin; i < run.end && j < n2 - thickness; ++i) note(columns.shock_at(i, j), i, j);
      }
    }
  }
}

std::string ShockWatch::in_words(const grid::Finding& shock) const {
  return fmt::format(
      R"(shock of Mach {:.2g} along lines of grid "{}", point ({}, {}) at ({:.6g}, {:.6g}), t = {:.4g})",
      shock.size, grid_of(shock), shock.i, shock.j, shock.place.x(), shock.place.y(), shock.t);
}

}  // namespace fsi::fluid
