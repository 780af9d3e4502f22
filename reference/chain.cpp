#include "reference/chain.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "common/core/failure.hpp"

namespace fsi::reference {

namespace {

/// The material's law among the alternatives from the k-th on.
template <std::size_t k = 0>
std::optional<AnyLaw> law_among(const Material& material) {
  if constexpr (k == std::variant_size_v<AnyLaw>) {
    return std::nullopt;
  } else {
    using L = std::variant_alternative_t<k, AnyLaw>;
    if (L::name == material.law) return solid::law_with<L>(material.lambda, material.mu, material.own);
    return law_among<k + 1>(material);
  }
}

}  // namespace

AnyLaw law_of(const Material& material) {
  if (const auto law = law_among(material)) return *law;
  throw UserMistake(fmt::format(
      "the one-dimensional reference knows no law '{}'; write one of laws with a stress, such as neo_hookean",
      material.law));
}

Difference error_from(Difference difference) {
  for (const auto quantity : differences) difference.*quantity /= 3;
  return difference;
}

std::vector<double> at_masses(std::span<const double> middle, Start start) {
  const std::size_t n = middle.size();
  std::vector<double> values(n + 1);
  for (std::size_t k = 2; k + 1 < n; ++k) {
    values[k] = (9 * (middle[k - 1] + middle[k]) - middle[k - 2] - middle[k + 1]) / 16;
  }
  const auto at_end = [](double a, double b, double c) { return (15 * a - 10 * b + 3 * c) / 8; };
  const auto next_to_end = [](double a, double b, double c) { return (3 * a + 6 * b - c) / 8; };
  if (start == Start::mirror) {
    values[0] = (9 * middle[0] - middle[1]) / 8;
    values[1] = (8 * middle[0] + 9 * middle[1] - middle[2]) / 16;
  } else {
    values[0] = at_end(middle[0], middle[1], middle[2]);
    values[1] = next_to_end(middle[0], middle[1], middle[2]);
  }
  values[n] = at_end(middle[n - 1], middle[n - 2], middle[n - 3]);
  values[n - 1] = next_to_end(middle[n - 1], middle[n - 2], middle[n - 3]);
  return values;
}

std::vector<double> output_times(std::vector<double> times, double end) {
  times.push_back(end);
  times.push_back(0);
  std::ranges::sort(times);
  const auto same = [](double a, double b) { return std::fabs(a - b) <= 1e-12 * std::max(1.0, b); };
  times.erase(std::unique(times.begin(), times.end(), same), times.end());
  return times;
}

double largest_difference(std::span<const double> a, std::span<const double> x,
                          const exact::CubicTable& table, std::size_t column) {
  double largest = 0;
  for (std::size_t k = 0; k < a.size(); ++k) {
    if (x[k] <= table.back()) largest = std::max(largest, std::fabs(a[k] - table(x[k])[column]));
  }
  return largest;
}

}  // namespace fsi::reference
