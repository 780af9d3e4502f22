#include "common/ranks/rows/delivery.hpp"

#include <algorithm>
#include <tuple>

namespace fsi {

namespace {

/// Sorts strips and joins those that touch.
void join(std::vector<Strip>& strips) {
  std::ranges::sort(strips, {}, [](const Strip& s) { return std::tuple(s.grid, s.j, s.begin); });
  std::size_t kept = 0;
  for (const Strip& strip : strips) {
    if (kept > 0) {
      Strip& last = strips[kept - 1];
      if (last.grid == strip.grid && last.j == strip.j && strip.begin <= last.end) {
        last.end = std::max(last.end, strip.end);
        continue;
      }
    }
    strips[kept++] = strip;
  }
  strips.resize(kept);
}

std::size_t points_of(std::span<const Strip> strips) {
  std::size_t points = 0;
  for (const Strip& strip : strips) points += static_cast<std::size_t>(strip.end - strip.begin);
  return points;
}

/// Calls action(first value in a field, count) for every strip and plane in a fixed order.
template <class Action>
void each_run(std::span<const Strip> strips, std::span<const FieldView> fields, const Action& action) {
  for (const Strip& strip : strips) {
    const FieldView& field = fields[static_cast<std::size_t>(strip.grid)];
    for (int plane = 0; plane < field.planes; ++plane)
      action(field.row(plane, strip.j) + strip.begin, strip.end - strip.begin);
  }
}

}  // namespace

Delivery::Delivery(const Cut& cut, int rank)
    : cut_(&cut),
      rank_(rank),
      out_(static_cast<std::size_t>(cut.ranks())),
      in_(out_.size()),
      sent_values_(out_.size()),
      values_(out_.size()) {}

void Delivery::need(int rank, const Strip& strip) {
  const int owner = cut_->owner(strip.grid, strip.j);
  if (owner == rank) return;
  if (rank == rank_) in_[static_cast<std::size_t>(owner)].push_back(strip);
  if (owner == rank_) out_[static_cast<std::size_t>(rank)].push_back(strip);
}

void Delivery::close() {
  for (std::vector<Strip>& strips : out_) join(strips);
  for (std::vector<Strip>& strips : in_) join(strips);
}

void Delivery::run(Ranks& ranks, std::span<const FieldView> fields) {
  std::vector<Parcel> sent, received;
  const auto planes = static_cast<std::size_t>(fields.front().planes);
  for (std::size_t other = 0; other < out_.size(); ++other) {
    if (!out_[other].empty()) {
      std::vector<double>& values = sent_values_[other];
      values.resize(planes * points_of(out_[other]));
      double* to = values.data();
      each_run(out_[other], fields, [&to](const double* from, int n) { to = std::copy_n(from, n, to); });
      sent.push_back({static_cast<int>(other), values});
    }
    if (!in_[other].empty()) {
      values_[other].resize(planes * points_of(in_[other]));
      received.push_back({static_cast<int>(other), values_[other]});
    }
  }
  ranks.exchange(sent, received);
  for (std::size_t other = 0; other < in_.size(); ++other) {
    if (in_[other].empty()) continue;
    const double* from = values_[other].data();
    each_run(in_[other], fields, [&from](double* to, int n) { std::copy_n(from, n, to), from += n; });
  }
}

std::size_t Delivery::sent() const {
  std::size_t points = 0;
  for (const std::vector<Strip>& strips : out_) points += points_of(strips);
  return points;
}

std::size_t Delivery::received() const {
  std::size_t points = 0;
  for (const std::vector<Strip>& strips : in_) points += points_of(strips);
  return points;
}

}  // namespace fsi
