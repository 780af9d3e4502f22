#include "common/exact/table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "common/core/failure.hpp"
#include "common/io/hdf5.hpp"

namespace fsi::exact {

CubicTable::CubicTable(std::vector<double> x, std::vector<std::vector<double>> columns)
    : x_(std::move(x)), columns_(std::move(columns)) {
  if (x_.size() < 4) throw std::invalid_argument("a cubic table needs four points");
  const auto not_rising = [](double a, double b) { return !(a < b); };
  if (std::ranges::adjacent_find(x_, not_rising) != x_.end()) {
    throw std::invalid_argument("the abscissae of a cubic table must increase");
  }
  for (const auto& column : columns_) {
    if (column.size() != x_.size())
      throw std::invalid_argument("a column of a cubic table has the wrong length");
  }
}

std::vector<double> CubicTable::operator()(double x) const {
  const auto above = std::ranges::upper_bound(x_, x) - x_.begin();
  const auto first = static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(above - 2, 0, std::ssize(x_) - 4));
  std::vector<double> result(columns_.size(), 0.0);
  for (std::size_t m = first; m < first + 4; ++m) {
    double weight = 1;  // Lagrange
    for (std::size_t k = first; k < first + 4; ++k) {
      if (k != m) weight *= (x - x_[k]) / (x_[m] - x_[k]);
    }
    for (std::size_t c = 0; c < columns_.size(); ++c) result[c] += weight * columns_[c][m];
  }
  return result;
}

namespace {

CubicTable read_table(const io::Hdf5& group, const std::vector<std::string>& names) {
  std::vector<std::vector<double>> columns;
  columns.reserve(names.size());
  for (const auto& name : names) columns.push_back(group.read(name).values);
  std::vector<double> x = std::move(columns.front());
  columns.erase(columns.begin());
  return {std::move(x), std::move(columns)};
}

/// Round-off of times: of the longest one, whatever their unit.
double round_off_of(const std::vector<double>& times) {
  double longest = 0;
  for (const double t : times) longest = std::max(longest, std::fabs(t));
  return 1e-9 * longest;
}

}  // namespace

TabulatedSolution::TabulatedSolution(const std::string& path, const Reading& gas, const Reading& solid) {
  const io::Hdf5 file = io::Hdf5::open(path);
  if (file.has_attribute("broke")) broke_ = file.text_attribute("broke");
  for (const auto& name : file.names()) {
    const io::Hdf5 output = file.group(name);
    times_.push_back(output.number_attribute("t"));
    gas_.push_back(gas(output.group("gas")));
    solid_.push_back(solid(output.group("solid")));
  }
}

PistonTable::PistonTable(const std::string& path)
    : TabulatedSolution(
          path,
          [](const io::Hdf5& group) {
            return read_table(group, {"x", "rho", "v", "p"});
          },
          [](const io::Hdf5& group) {
            return read_table(group, {"x_bar", "u", "v", "P11", "P22"});
          }) {}

std::size_t index_of_time(const std::vector<double>& times, double t) {
  for (std::size_t k = 0; k < times.size(); ++k) {
    if (std::fabs(times[k] - t) <= round_off_of(times)) return k;
  }
  throw UserMistake(fmt::format(
      "the reference solution is not tabulated at t = {}; it has t = {}. Add the time to output.times", t,
      fmt::join(times, ", ")));
}

std::string reason_beyond(const std::vector<double>& times, const std::string& broke, double t) {
  if (broke.empty() || (!times.empty() && t <= times.back() + round_off_of(times))) return "";
  return "the reference solution ends before: " + broke;
}

GasState PistonTable::gas(double x, double /*y*/, double t) const {
  const auto values = gas_at(t)(x);
  return {.rho = values[0], .v1 = values[1], .v2 = 0, .p = values[2]};
}

SolidState PistonTable::solid(double x_bar, double /*y_bar*/, double t) const {
  const auto values = solid_at(t)(x_bar);
  SolidState state;
  state.u[0] = values[0];
  state.v[0] = values[1];
  state.P(0, 0) = values[2];
  state.P(1, 1) = values[3];
  return state;
}

}  // namespace fsi::exact
