#pragma once
/// Noise of the scale of the grid, and where it is worst.
///
///       *   *   *        Along a grid line, a ripple is a row of maxima and minima that follow each other
///      / \ / \ / \       within three points: six turns at least, five swings between them. Its amplitude is
///     /   *   *   \      half the smallest of five swings, its size that amplitude over the range of values
///                        the quantity has on all grids.
///
/// A shock, a kink, a contact or a lonely peak has at most three such turns, and a wave that the grid
/// resolves, of eight points and more, has them further apart. A ripple on a slope steeper than itself has no
/// turns and goes unseen.

#include <array>
#include <span>
#include <string>
#include <vector>

#include "common/core/archive.hpp"
#include "common/grid/watch.hpp"

namespace fsi::grid {

/// Above this size a program says so.
inline constexpr double noisy = 0.03;  ///< amplitude over range [-]

/// Maxima and minima of a row of values that come one by one.
class TurnCounter {
 public:
  /// The row begins anew with this value.
  void start(double value) { *this = TurnCounter{value}; }
  /// Half the smallest of the last five swings; 0 where there were fewer, one after the other.
  double next(double value);

  TurnCounter() = default;

 private:
  explicit TurnCounter(double value) : last_(value), turn_(value) {}

  static constexpr int reach = 3;  ///< most points from one turn to the next
  double last_ = 0, turn_ = 0;     ///< value before, and at the last turn [unit of the quantity]
  int direction_ = 0;              ///< the values rise (1) or fall (-1)
  int away_ = 0;                   ///< points since the last turn
  bool turned_ = false;            ///< there was one
  int count_ = 0;                  ///< swings in succession
  std::array<double, 5> swings_{};
};

class RippleWatch final : public Watch {
 public:
  static constexpr double faintest = 1e-3;  ///< smaller ripples are none [-]
  /// Steps between two looks: together they cost less than a hundredth of a run.
  static constexpr int every = 100;

  RippleWatch(std::vector<WatchedQuantity> quantities, std::vector<std::string> grids);

  /// Looks at all fields of all grids at time t. The range of a quantity is the largest it had since the
  /// start: noise that is left when all waves are gone does not count as more than it was.
  void look(std::span<const WatchedGrid> grids, double t);
  /// Range of each quantity, at least its floor [unit of the quantity].
  std::span<const double> ranges() const { return ranges_; }
  /// `v1 ripples by 4.1 % on grid "solid", point (12, 3) at (0.1, 0.2), t = 6.2`
  std::string in_words(const Finding& ripple) const override;
  void archive(Archive& archive);

 private:
  /// One component on one grid.
  struct Place {
    const WatchedGrid& on;
    int plane;
    double range;   ///< [unit of the quantity]
    Finding found;  ///< without its size and point
  };
  void look_along_rows(const Place& at);
  void look_along_columns(const Place& at);
  void note(const Place& at, double amplitude, int i, int j);

  std::vector<double> ranges_;        ///< of the quantities
  std::vector<TurnCounter> columns_;  ///< work memory: a counter per column,
  std::vector<int> column_rows_;      ///< and the row it saw last
};

}  // namespace fsi::grid
