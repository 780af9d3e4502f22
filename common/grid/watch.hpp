#pragma once
/// What is worth telling people about the fields on component grids: the worst place of all, now and since the
/// start. What is looked for is up to each kind of watch.

#include <cstddef>
#include <string>
#include <vector>

#include "common/core/archive.hpp"
#include "common/core/field.hpp"
#include "common/core/types.hpp"
#include "common/grid/intervals.hpp"

namespace fsi::grid {

/// A quantity whose components are the planes first, first + 1, ... of a field.
struct WatchedQuantity {
  std::vector<std::string> components;  ///< their names
  int first = 0;
  double floor = 0;  ///< ranges below this are round-off [unit of the quantity]

  int planes() const { return static_cast<int>(components.size()); }
};

/// The fields on a component grid.
struct WatchedGrid {
  ConstFieldView q;
  ConstFieldView x;                 ///< positions
  const RowSets* points = nullptr;  ///< those to look at
};

/// One place.
struct Finding {
  double size = 0;  ///< a part of the quantity's range; 0: nothing was found [-]
  int component = 0, grid = 0, i = 0, j = 0;
  Vec2 place = Vec2::Zero();
  double t = 0;  ///< [time]
};

class Watch {
 public:
  Watch(std::vector<WatchedQuantity> quantities, std::vector<std::string> grids);
  virtual ~Watch() = default;
  Watch(const Watch&) = default;
  Watch(Watch&&) = default;
  Watch& operator=(const Watch&) = default;
  Watch& operator=(Watch&&) = default;

  /// Of the last look.
  const Finding& now() const { return now_; }
  /// The largest since the start.
  const Finding& worst() const { return worst_; }
  const std::string& component_of(const Finding& found) const;
  const std::string& grid_of(const Finding& found) const;
  /// With field, size, grid, place and time, for people.
  virtual std::string in_words(const Finding& found) const = 0;

 protected:
  const std::vector<WatchedQuantity>& quantities() const { return quantities_; }
  /// Of a look: forgets what the last one found.
  void begin() { now_ = {}; }
  /// Keeps what is worse than all before, of this look and since the start.
  void keep(const Finding& found);
  void archive_findings(Archive& archive);

 private:
  std::vector<WatchedQuantity> quantities_;
  std::vector<std::string> grids_, components_;
  Finding now_, worst_;
};

}  // namespace fsi::grid
