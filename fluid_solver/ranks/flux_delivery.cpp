#include "fluid_solver/ranks/flux_delivery.hpp"

#include <algorithm>

namespace fsi::fluid {

namespace {

FaceValues& flux_of(FaceFluxes& noted, const std::pair<int, std::size_t>& face) {
  return (face.first == 0 ? noted.along : noted.between).flux(face.second);
}

}  // namespace

void FluxDelivery::need(int from, int to, int direction, std::size_t face) {
  if (from == to) return;
  if (from == rank_) out_[static_cast<std::size_t>(to)].emplace_back(direction, face);
  if (to == rank_) in_[static_cast<std::size_t>(from)].emplace_back(direction, face);
}

void FluxDelivery::close() {
  for (std::vector<Faces>* side : {&out_, &in_}) {
    for (Faces& faces : *side) {
      std::ranges::sort(faces);
      const auto doubles = std::ranges::unique(faces);
      faces.erase(doubles.begin(), doubles.end());
    }
  }
}

void FluxDelivery::run(Ranks& ranks, FaceFluxes& noted) {
  std::vector<Parcel> sent, received;
  constexpr std::size_t width = std::tuple_size_v<FaceValues>;
  for (std::size_t other = 0; other < out_.size(); ++other) {
    if (!out_[other].empty()) {
      sent_[other].clear();
      for (const auto& face : out_[other]) {
        const FaceValues& flux = flux_of(noted, face);
        sent_[other].insert(sent_[other].end(), flux.begin(), flux.end());
      }
      sent.push_back({static_cast<int>(other), sent_[other]});
    }
    if (!in_[other].empty()) {
      got_[other].resize(width * in_[other].size());
      received.push_back({static_cast<int>(other), got_[other]});
    }
  }
  ranks.exchange(sent, received);
  for (std::size_t other = 0; other < in_.size(); ++other) {
    const double* from = got_[other].data();
    for (const auto& face : in_[other]) {
      std::copy_n(from, width, flux_of(noted, face).begin());
      from += width;
    }
  }
}

}  // namespace fsi::fluid
