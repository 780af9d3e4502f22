#pragma once
/// Interpolation points that are donors of each other: a small linear system of its own.
///
///     u_k = sum over known donors + sum over unknown ones      A u = K f,   A = 1 - (weights on unknowns)
///
/// Three things may happen. The weights on unknowns are small: sweeps over the points settle, and nothing is
/// factored. They are not: A is factored, once for each connection of the grids. A amplifies: an error of one
/// donor arrives several times as large, or no solution exists; the points through which it does are named,
/// and the grids give them two donors per direction in place of three. Such weights are not negative and add
/// up to one, so A is an M-matrix that amplifies nothing and has an inverse wherever every point depends,
/// over any number of others, on a known one.

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "common/core/field.hpp"
#include "common/grid/overlap/interpolation.hpp"

namespace fsi::grid {

/// Entry `point` of list `list`.
struct ImplicitPoint {
  std::size_t list = 0, point = 0;
  bool operator==(const ImplicitPoint&) const = default;
};

class ImplicitSystem {
 public:
  /// The points of the implicit lists; `layouts` are those
  /// of the grids. Factors A where sweeps need not settle.
  ImplicitSystem(std::span<const InterpolationList> lists, std::span<const Layout> layouts);

  bool factored() const { return factors_ != nullptr; }
  /// What an equation is off by itself, as a part of the values: a smooth solution of 50 points to a wave is interpolated about
  /// as well [-]. It is in the amplification, so that points which have known values by weights of round-off only, as where points
  /// of two grids coincide and are each other's donors, are found whatever the processor makes of their positions.
  static constexpr double own_error = 1e-4;

  /// How much larger than its cause an error of known values may arrive: the largest sum of sizes of the
  /// weights of a point on known values and of `own_error`, from estimates of the norm of A^-1 (Hager 1984). About 1 where no
  /// weight is negative and known values are near, infinite where A has no inverse.
  double amplification() const { return amplification_; }
  /// The point that is worst off.
  ImplicitPoint worst() const { return entries_[worst_].place; }
  /// Points with three donors per direction through which most of that happens; all of those there are where
  /// A has no inverse. None: there is nothing left to lower.
  std::vector<ImplicitPoint> amplifiers(std::span<const InterpolationList> lists) const;
  /// Points with three donors per direction whose weights on
  /// others like them add up to more than that in size.
  std::vector<ImplicitPoint> dependents(std::span<const InterpolationList> lists, double more_than) const;

  /// Sets the points of the implicit lists in all planes to their common solution; by sweeps where nothing is
  /// factored, from the values they have. `lists` are those of the constructor.
  void solve(std::span<const InterpolationList> lists, std::span<const FieldView> fields) const;

 private:
  /// An unknown: its entry, and how much it takes.
  struct Entry {
    ImplicitPoint place;
    double on_known = 0, on_unknown = 0;  ///< sums of sizes of its weights [-]
  };
  struct Factors;

  std::vector<Entry> entries_;
  std::shared_ptr<Factors> factors_;
  double amplification_ = 1;  ///< [-]
  std::size_t worst_ = 0;
  std::vector<double> through_;  ///< of the worst point's error: what comes in at each unknown

  void factor(std::span<const InterpolationList> lists, std::span<const Layout> layouts,
              std::span<const std::vector<std::int32_t>> numbers);
  void estimate();
};

}  // namespace fsi::grid
