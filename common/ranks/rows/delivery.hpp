#pragma once
/// Values that are brought from the ranks that own them to those that need them. All ranks know the cut and how
/// the grids are connected, so each finds for itself what it sends and what it gets.

#include <cstddef>
#include <span>
#include <vector>

#include "common/core/field.hpp"
#include "common/ranks/ranks.hpp"
#include "common/ranks/rows/cut.hpp"

namespace fsi {

class Delivery {
 public:
  Delivery() = default;
  Delivery(const Cut& cut, int rank);

  /// A rank needs a strip, which lies in one row. Strips may be told more than once.
  void need(int rank, const Strip& strip);
  /// No more needs follow: doubles are taken out.
  void close();

  /// Brings the strips of all planes of the fields, one per grid.
  void run(Ranks& ranks, std::span<const FieldView> fields);

  /// Values of a plane that this rank sends, and gets.
  std::size_t sent() const;
  std::size_t received() const;

 private:
  const Cut* cut_ = nullptr;
  int rank_ = 0;
  std::vector<std::vector<Strip>> out_, in_;               ///< by rank
  std::vector<std::vector<double>> sent_values_, values_;  ///< work memory, by rank
};

}  // namespace fsi
