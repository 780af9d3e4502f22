#pragma once
/// Where the gas has a shock: for judging points that fell back to first order.

#include <array>
#include <functional>

#include "common/core/field.hpp"
#include "common/grid/intervals.hpp"
#include "common/ranks/rows/rank_rows.hpp"

namespace fsi::fluid {

/// Two neighbouring points whose pressures differ by more
/// than this part of the smaller one belong to a shock.
inline constexpr double shock_jump = 0.05;
/// So many cells around a shock count as inside it.
inline constexpr int shock_reach = 5;

/// A grid with values: its state (planes rho, v1, v2, p), which of its points count, and in which directions
/// the last point is the first one again.
struct ShockField {
  ConstFieldView q;
  const grid::RowSets& valid;
  std::array<bool, 2> periodic = {};
};

/// Whether within `shock_reach` cells of point (i, j), in both directions of its grid, two neighbours along a
/// grid line that have a value belong to a shock.
bool inside_shock(const ShockField& field, int i, int j);
/// The same, looking at pairs along and above rows of one's own only: of several ranks, one will see it.
bool inside_shock(const ShockField& field, int i, int j, const std::function<bool(int)>& own);
/// Whether all that `inside_shock` looks at around a point of row j are values one has.
bool sees_all(const ShockField& field, const RankRows& rows, int j);

}  // namespace fsi::fluid
