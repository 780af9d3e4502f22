/// Points that are donors of each other where sweeps over them do not settle: the small linear system itself.

#include <Eigen/SparseLU>
#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "common/grid/interpolation.hpp"

namespace fsi::grid {

namespace {

using Matrix = Eigen::SparseMatrix<double>;
using Column = Eigen::VectorXd;

/// The unknowns: points of the implicit lists, numbered in the order of the lists.
class Unknowns {
 public:
  Unknowns(std::span<const InterpolationList> lists, std::span<const FieldView> fields)
      : numbers_(fields.size()) {
    for (const InterpolationList& list : lists) {
      if (!list.implicit) continue;
      std::vector<int>& numbers = numbers_[static_cast<std::size_t>(list.target_grid)];
      numbers.resize(fields[static_cast<std::size_t>(list.target_grid)].layout.plane_size(), none);
      for (const std::int32_t at : list.target) numbers[static_cast<std::size_t>(at)] = count_++;
    }
  }
  int count() const { return count_; }
  /// -1: the value there is known.
  int number(int grid, std::ptrdiff_t at) const {
    const std::vector<int>& numbers = numbers_[static_cast<std::size_t>(grid)];
    return numbers.empty() ? none : numbers[static_cast<std::size_t>(at)];
  }

 private:
  static constexpr int none = -1;
  std::vector<std::vector<int>> numbers_;
  int count_ = 0;
};

/// Calls action(list, entry, at, weight) for every donor of the implicit points.
template <class Action>
void each_donor(std::span<const InterpolationList> lists, std::span<const FieldView> fields,
                const Action& action) {
  for (const InterpolationList& list : lists) {
    if (!list.implicit) continue;
    const auto width = static_cast<std::size_t>(list.width);
    const std::ptrdiff_t stride = fields[static_cast<std::size_t>(list.donor_grid)].layout.stride;
    for (std::size_t k = 0; k < list.size(); ++k) {
      for (std::size_t m = 0; m < width * width; ++m) {
        const std::ptrdiff_t at = list.donor[k] + static_cast<std::ptrdiff_t>(m / width) * stride +
                                  static_cast<std::ptrdiff_t>(m % width);
        action(list, k, at, list.weight[k * width * width + m]);
      }
    }
  }
}

Matrix matrix_of(const Unknowns& unknowns, std::span<const InterpolationList> lists,
                 std::span<const FieldView> fields) {
  std::vector<Eigen::Triplet<double>> entries;
  for (int k = 0; k < unknowns.count(); ++k) entries.emplace_back(k, k, 1.0);
  each_donor(lists, fields, [&](const InterpolationList& list, std::size_t k, std::ptrdiff_t at, double w) {
    const int donor = unknowns.number(list.donor_grid, at);
    if (donor >= 0) entries.emplace_back(unknowns.number(list.target_grid, list.target[k]), donor, -w);
  });
  Matrix matrix(unknowns.count(), unknowns.count());
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

/// What the points take from points whose values are known.
Column known_part(const Unknowns& unknowns, std::span<const InterpolationList> lists,
                  std::span<const FieldView> fields, int plane) {
  Column sum = Column::Zero(unknowns.count());
  each_donor(lists, fields, [&](const InterpolationList& list, std::size_t k, std::ptrdiff_t at, double w) {
    if (unknowns.number(list.donor_grid, at) >= 0) return;
    sum[unknowns.number(list.target_grid, list.target[k])] +=
        w * fields[static_cast<std::size_t>(list.donor_grid)].plane(plane)[at];
  });
  return sum;
}

/// The point that takes the largest part of its value from others like it: where the overlap is worst.
ImplicitPoint most_dependent(const Unknowns& unknowns, std::span<const InterpolationList> lists,
                             std::span<const FieldView> fields) {
  Column on_others = Column::Zero(unknowns.count());
  each_donor(lists, fields, [&](const InterpolationList& list, std::size_t k, std::ptrdiff_t at, double w) {
    if (unknowns.number(list.donor_grid, at) >= 0)
      on_others[unknowns.number(list.target_grid, list.target[k])] += std::abs(w);
  });
  Eigen::Index worst = 0;
  on_others.maxCoeff(&worst);
  ImplicitPoint point;
  for (std::size_t l = 0; l < lists.size(); ++l) {
    for (std::size_t k = 0; lists[l].implicit && k < lists[l].size(); ++k) {
      if (unknowns.number(lists[l].target_grid, lists[l].target[k]) == worst) point = {l, k};
    }
  }
  return point;
}

}  // namespace

std::optional<ImplicitPoint> solve_implicit(std::span<const InterpolationList> lists,
                                            std::span<const FieldView> fields) {
  constexpr double tolerable = 1e-9;  // of the equations, in parts of the largest value
  const Unknowns unknowns(lists, fields);
  const Matrix matrix = matrix_of(unknowns, lists, fields);
  Eigen::SparseLU<Matrix> factors(matrix);
  if (factors.info() != Eigen::Success) return most_dependent(unknowns, lists, fields);
  for (int plane = 0; plane < fields.front().planes; ++plane) {
    const Column known = known_part(unknowns, lists, fields, plane);
    const Column values = factors.solve(known);
    const double largest = std::max(values.lpNorm<Eigen::Infinity>(), known.lpNorm<Eigen::Infinity>());
    if (!((matrix * values - known).lpNorm<Eigen::Infinity>() <= tolerable * largest))
      return most_dependent(unknowns, lists, fields);
    for (const InterpolationList& list : lists) {
      if (!list.implicit) continue;
      double* plane_values = fields[static_cast<std::size_t>(list.target_grid)].plane(plane);
      for (const std::int32_t at : list.target)
        plane_values[at] = values[unknowns.number(list.target_grid, at)];
    }
  }
  return std::nullopt;
}

}  // namespace fsi::grid
