#include "solid_solver/boundary/joined_sides.hpp"

#include <cmath>
#include <utility>

namespace fsi::solid {

JoinedSides::JoinedSides(std::vector<Stretch> stretches, const std::vector<int>& points, bool closed)
    : stretches_(std::move(stretches)), closed_(closed), starts_{0}, values_(stretches_.size()) {
  for (const int n : points) starts_.push_back(starts_.back() + static_cast<std::size_t>(n) - 1);
}

void JoinedSides::put_together(std::span<const std::span<const double>> sides, std::span<double> all) const {
  const std::size_t components = all.size() / points();
  for (std::size_t side = 0; side < sides.size(); ++side) {
    const std::size_t n = count(side);
    for (std::size_t c = 0; c < components; ++c) {
      for (std::size_t m = 0; m < n; ++m)
        all[c * points() + starts_[side] + m] = sides[side][c * n + at(side, m)];
    }
  }
}

void JoinedSides::join(std::span<const SolidInterface> sides, SolidInterface& whole) const {
  const std::size_t n = points(), last = stretches_.size() - 1;
  std::vector<std::span<const double>> lists(sides.size());
  const auto put = [&](std::vector<double> SolidInterface::*list, std::size_t components) {
    for (std::size_t side = 0; side < sides.size(); ++side) lists[side] = sides[side].*list;
    (whole.*list).resize(components * n);
    put_together(lists, whole.*list);
  };
  put(&SolidInterface::x, 2);
  put(&SolidInterface::v, 2);
  put(&SolidInterface::w, 2);
  put(&SolidInterface::Z, 3);
  whole.z_p = sides.front().z_p;
  whole.fixed.resize(n);
  for (std::size_t side = 0; side < sides.size(); ++side) {
    for (std::size_t m = 0; m < count(side); ++m)
      whole.fixed[starts_[side] + m] = sides[side].fixed[at(side, m)];
  }
  for (std::size_t side = 1; side <= last; ++side) join_corner(sides[side - 1], sides[side], side, whole);
  if (!closed_) return;
  join_corner(sides[last], sides[0], 0, whole);
  for (std::vector<double>* list : {&whole.x, &whole.v, &whole.w, &whole.Z}) {
    for (std::size_t c = 0; c < list->size() / n; ++c) (*list)[c * n + n - 1] = (*list)[c * n];
  }
  whole.fixed[n - 1] = whole.fixed[0];
}

/// The corner at which `side` begins.
void JoinedSides::join_corner(const SolidInterface& before, const SolidInterface& after, std::size_t side,
                              SolidInterface& whole) const {
  const std::size_t n = points(), k = starts_[side], previous = k > 0 ? k - 1 : n - 2;
  const std::size_t side_before = side > 0 ? side - 1 : stretches_.size() - 1;
  const auto distance = [&](std::size_t a, std::size_t b) {
    return std::hypot(whole.x[a] - whole.x[b], whole.x[n + a] - whole.x[n + b]);
  };
  const double chord = distance(k + 1, previous);
  const double part_before = distance(k, previous) / chord, part_after = distance(k + 1, k) / chord;
  const std::size_t n_before = count(side_before), n_after = count(side);
  const std::size_t end = at(side_before, n_before - 1), begin = at(side, 0);
  const auto add_up = [&](std::vector<double> SolidInterface::*list, std::size_t components) {
    for (std::size_t c = 0; c < components; ++c)
      (whole.*list)[c * n + k] =
          part_before * (before.*list)[c * n_before + end] + part_after * (after.*list)[c * n_after + begin];
  };
  add_up(&SolidInterface::w, 2);
  add_up(&SolidInterface::Z, 3);
}

void JoinedSides::split(const InterfaceValues& whole, std::vector<InterfaceValues>& sides) {
  const std::size_t n_all = points(), last = stretches_.size() - 1;
  for (std::size_t side = 0; side <= last; ++side) {
    const std::size_t n = count(side);
    std::vector<double>& own = values_[side];
    own.resize(4 * n);
    for (std::size_t m = 0; m < n; ++m) {
      const std::size_t from = starts_[side] + m, to = at(side, m);
      own[to] = whole.n[from];
      own[n + to] = whole.n[n_all + from];
      own[2 * n + to] = whole.v_n[from];
      own[3 * n + to] = whole.w_n[from];
    }
    const bool goes_on_before = closed_ || side > 0, goes_on_after = closed_ || side < last;
    const bool against = stretches_[side].against;
    const std::span<const double> values(own);
    sides.push_back(
        {.side = stretches_[side].side,
         .n = values.subspan(0, 2 * n),
         .v_n = values.subspan(2 * n, n),
         .w_n = values.subspan(3 * n, n),
         .grid = whole.grid,
         .goes_on = {against ? goes_on_after : goes_on_before, against ? goes_on_before : goes_on_after}});
  }
}

}  // namespace fsi::solid
