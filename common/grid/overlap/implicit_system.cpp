#include "common/grid/overlap/implicit_system.hpp"

#include <Eigen/SparseLU>
#include <algorithm>
#include <cmath>
#include <limits>

namespace fsi::grid {

namespace {

using Matrix = Eigen::SparseMatrix<double>;
using Column = Eigen::VectorXd;

/// Calls action(at, weight) for every donor of a point.
template <class Action>
void each_donor(const InterpolationList& list, std::size_t point, int stride, const Action& action) {
  const auto width = static_cast<std::size_t>(list.width);
  for (std::size_t m = 0; m < width * width; ++m) {
    const std::ptrdiff_t at = list.donor[point] + static_cast<std::ptrdiff_t>(m / width) * stride +
                              static_cast<std::ptrdiff_t>(m % width);
    action(static_cast<std::size_t>(at), list.weight[point * width * width + m]);
  }
}

/// The number of each unknown, -1 where a value is known, by the position in a plane of its grid.
std::vector<std::vector<std::int32_t>> numbers_of(std::span<const InterpolationList> lists,
                                                  std::span<const Layout> layouts) {
  std::vector<std::vector<std::int32_t>> numbers(layouts.size());
  std::int32_t count = 0;
  for (const InterpolationList& list : lists) {
    if (!list.implicit) continue;
    std::vector<std::int32_t>& of_grid = numbers[static_cast<std::size_t>(list.target_grid)];
    of_grid.resize(layouts[static_cast<std::size_t>(list.target_grid)].plane_size(), -1);
    for (const std::int32_t at : list.target) of_grid[static_cast<std::size_t>(at)] = count++;
  }
  return numbers;
}

}  // namespace

struct ImplicitSystem::Factors {
  Eigen::SparseLU<Matrix> lu;
};

ImplicitSystem::ImplicitSystem(std::span<const InterpolationList> lists, std::span<const Layout> layouts) {
  const std::vector<std::vector<std::int32_t>> numbers = numbers_of(lists, layouts);
  double most = 0;
  for (std::size_t l = 0; l < lists.size(); ++l) {
    if (!lists[l].implicit) continue;
    const std::vector<std::int32_t>& donors = numbers[static_cast<std::size_t>(lists[l].donor_grid)];
    const int stride = layouts[static_cast<std::size_t>(lists[l].donor_grid)].stride;
    for (std::size_t k = 0; k < lists[l].size(); ++k) {
      Entry entry{.place = {l, k}};
      each_donor(lists[l], k, stride, [&](std::size_t at, double w) {
        const bool known = donors.empty() || donors[at] < 0;
        (known ? entry.on_known : entry.on_unknown) += std::abs(w);
      });
      most = std::max(most, entry.on_unknown);
      entries_.push_back(entry);
    }
  }
  // Each sweep leaves at most this part of an error: 1e-13 of it after 43 of the 50 sweeps there are.
  constexpr double settles = 0.5;
  if (most > settles) factor(lists, layouts, numbers);
}

void ImplicitSystem::factor(std::span<const InterpolationList> lists, std::span<const Layout> layouts,
                            std::span<const std::vector<std::int32_t>> numbers) {
  std::vector<Eigen::Triplet<double>> values;
  for (std::size_t row = 0; row < entries_.size(); ++row) {
    const auto [l, k] = entries_[row].place;
    const std::vector<std::int32_t>& donors = numbers[static_cast<std::size_t>(lists[l].donor_grid)];
    const int stride = layouts[static_cast<std::size_t>(lists[l].donor_grid)].stride;
    values.emplace_back(static_cast<int>(row), static_cast<int>(row), 1.0);
    if (entries_[row].on_unknown == 0) continue;
    each_donor(lists[l], k, stride, [&](std::size_t at, double w) {
      if (donors[at] >= 0) values.emplace_back(static_cast<int>(row), donors[at], -w);
    });
  }
  const auto n = static_cast<Eigen::Index>(entries_.size());
  Matrix matrix(n, n);
  matrix.setFromTriplets(values.begin(), values.end());
  factors_ = std::make_shared<Factors>();
  factors_->lu.compute(matrix);
  estimate();
}

/// Hager's method for the largest row sum of A^-1 D, D the weights on known values and what an equation is off by itself: a
/// row of it is known after one solve with A^T; one with A says which other row is larger.
void ImplicitSystem::estimate() {
  const auto n = static_cast<Eigen::Index>(entries_.size());
  amplification_ = std::numeric_limits<double>::infinity();
  worst_ =
      static_cast<std::size_t>(std::ranges::max_element(entries_, {}, &Entry::on_unknown) - entries_.begin());
  through_.clear();
  if (factors_->lu.info() != Eigen::Success) return;
  Column known(n);
  for (Eigen::Index k = 0; k < n; ++k) known[k] = entries_[static_cast<std::size_t>(k)].on_known + own_error;
  Column unit = Column::Constant(n, 1.0 / static_cast<double>(n));
  constexpr int most_rows = 6;
  double largest = 0;
  Eigen::Index candidate = -1;  // its row is the sum of `unit`'s
  for (int row = 0; row < most_rows; ++row) {
    const Column through = known.cwiseProduct(factors_->lu.transpose().solve(unit));
    const double sum = through.lpNorm<1>();
    if (!std::isfinite(sum)) return;
    if (candidate >= 0) {
      if (sum <= largest) break;
      largest = sum;
      worst_ = static_cast<std::size_t>(candidate);
      through_.assign(through.data(), through.data() + n);
    }
    const Column signs = through.unaryExpr([](double y) { return y < 0 ? -1.0 : 1.0; });
    const Column change = factors_->lu.solve(known.cwiseProduct(signs));
    Eigen::Index next = 0;
    if (!std::isfinite(change.cwiseAbs().maxCoeff(&next))) return;
    if (next == candidate) break;
    candidate = next;
    unit = Column::Unit(n, next);
  }
  amplification_ = std::max(largest, 1.0);
}

std::vector<ImplicitPoint> ImplicitSystem::amplifiers(std::span<const InterpolationList> lists) const {
  const auto wide = [&](std::size_t k) {
    return lists[entries_[k].place.list].width == 3 && entries_[k].on_unknown > 0;
  };
  double largest = 0;
  for (std::size_t k = 0; k < through_.size(); ++k)
    if (wide(k)) largest = std::max(largest, std::abs(through_[k]));
  constexpr double part = 0.25;  // of the largest one's share: the point's own neighbourhood
  std::vector<ImplicitPoint> points;
  for (std::size_t k = 0; k < entries_.size(); ++k) {
    if (wide(k) && (largest == 0 || k == worst_ || std::abs(through_[k]) >= part * largest))
      points.push_back(entries_[k].place);
  }
  return points;
}

std::vector<ImplicitPoint> ImplicitSystem::dependents(std::span<const InterpolationList> lists,
                                                      double more_than) const {
  std::vector<ImplicitPoint> points;
  for (const Entry& entry : entries_) {
    if (lists[entry.place.list].width == 3 && entry.on_unknown > more_than) points.push_back(entry.place);
  }
  return points;
}

void ImplicitSystem::solve(std::span<const InterpolationList> lists,
                           std::span<const FieldView> fields) const {
  if (!factored()) {
    settle_implicit(lists, fields);
    return;
  }
  const auto to = [&](const Entry& entry, int plane) -> double& {
    const InterpolationList& list = lists[entry.place.list];
    return fields[static_cast<std::size_t>(list.target_grid)].plane(plane)[list.target[entry.place.point]];
  };
  const int planes = fields.front().planes;
  Eigen::MatrixXd known(static_cast<Eigen::Index>(entries_.size()), planes);
  for (int plane = 0; plane < planes; ++plane) {
    for (const Entry& entry : entries_) to(entry, plane) = 0;  // what is left of the sums is the known part
    Eigen::Index row = 0;
    for (const Entry& entry : entries_) {
      const InterpolationList& list = lists[entry.place.list];
      const FieldView from = fields[static_cast<std::size_t>(list.donor_grid)];
      double sum = 0;
      each_donor(list, entry.place.point, from.layout.stride,
                 [&](std::size_t at, double w) { sum += w * from.plane(plane)[at]; });
      known(row++, plane) = sum;
    }
  }
  const Eigen::MatrixXd values = factors_->lu.solve(known);
  for (int plane = 0; plane < planes; ++plane) {
    Eigen::Index row = 0;
    for (const Entry& entry : entries_) to(entry, plane) = values(row++, plane);
  }
}

}  // namespace fsi::grid
