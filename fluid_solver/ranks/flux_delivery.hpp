#pragma once
/// Fluxes through the rim of a level, brought from the ranks that swept the faces to those that impose them on the
/// next coarser level. Like Delivery: every rank finds for itself what it sends and what it gets.

#include <cstddef>
#include <utility>
#include <vector>

#include "common/ranks/ranks.hpp"
#include "fluid_solver/kernels/face_fluxes.hpp"

namespace fsi::fluid {

class FluxDelivery {
 public:
  FluxDelivery() = default;
  FluxDelivery(int ranks, int rank)
      : rank_(rank),
        out_(static_cast<std::size_t>(ranks)),
        in_(out_),
        sent_(out_.size()),
        got_(out_.size()) {}

  /// Rank `to` needs a face that rank `from` has swept. Faces may be told more than once.
  void need(int from, int to, int direction, std::size_t face);
  /// No more needs follow.
  void close();
  /// Brings the fluxes.
  void run(Ranks& ranks, FaceFluxes& noted);

 private:
  using Faces = std::vector<std::pair<int, std::size_t>>;  ///< direction and number in the list
  int rank_ = 0;
  std::vector<Faces> out_, in_;                  ///< by rank
  std::vector<std::vector<double>> sent_, got_;  ///< work memory, by rank
};

}  // namespace fsi::fluid
