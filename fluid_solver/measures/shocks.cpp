#include "fluid_solver/measures/shocks.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace fsi::fluid {

namespace {

/// Index of a point of a line with n points, seen from a periodic neighbour or from beyond the end (none).
std::optional<int> index_of(int k, int n, bool periodic) {
  if (periodic) return (k % (n - 1) + n - 1) % (n - 1);
  if (k < 0 || k >= n) return std::nullopt;
  return k;
}

/// Pressure of a point; 0 where it has none.
double pressure(const ShockField& field, int i, int j) {
  const auto column = index_of(i, field.q.layout.n1, field.periodic[0]);
  const auto row = index_of(j, field.q.layout.n2, field.periodic[1]);
  return column && row && field.valid.contains(*column, *row) ? field.q(3, *column, *row) : 0.0;
}

bool jumps(double p, double p_next) {
  return p > 0 && p_next > 0 && std::fabs(p - p_next) > shock_jump * std::min(p, p_next);
}

}  // namespace

bool inside_shock(const ShockField& field, int i, int j) {
  return inside_shock(field, i, j, [](int) { return true; });
}

bool inside_shock(const ShockField& field, int i, int j, const std::function<bool(int)>& own) {
  for (int b = j - shock_reach; b <= j + shock_reach; ++b) {
    const auto row = index_of(b, field.q.layout.n2, field.periodic[1]);
    if (!row || !own(*row)) continue;
    for (int a = i - shock_reach; a <= i + shock_reach; ++a) {
      const double p = pressure(field, a, b);
      if (a < i + shock_reach && jumps(p, pressure(field, a + 1, b))) return true;
      if (b < j + shock_reach && jumps(p, pressure(field, a, b + 1))) return true;
    }
  }
  return false;
}

bool sees_all(const ShockField& field, const RankRows& rows, int j) {
  if (rows.all) return true;
  const bool closed = field.periodic[1];
  const int low = closed ? j - shock_reach : std::max(j - shock_reach, 0),
            high = closed ? j + shock_reach : std::min(j + shock_reach, field.q.layout.n2 - 1);
  constexpr int complete = RankRows::halo - 1;  // rows of the halo
  return low >= rows.own.first - complete && high < rows.own.end + complete;
}

}  // namespace fsi::fluid
