#pragma once
/// A one-dimensional solution tabulated on fine points at output times, as `reference_piston` computes it.

#include <string>
#include <vector>

#include "common/exact/solution.hpp"

namespace fsi::exact {

/// Interpolates columns of values over strictly increasing
/// abscissae by cubics through the four nearest points.
class CubicTable {
 public:
  /// `columns` of the same length as `x`. @throws std::invalid_argument
  /// for fewer than four points or x not increasing
  CubicTable(std::vector<double> x, std::vector<std::vector<double>> columns);

  /// All columns at x; outside the table the nearest cubic continues.
  std::vector<double> operator()(double x) const;
  double front() const { return x_.front(); }
  double back() const { return x_.back(); }

 private:
  std::vector<double> x_;
  std::vector<std::vector<double>> columns_;
};

/// Index of the time `t` in `times`. @throws UserMistake naming the times there are
std::size_t index_of_time(const std::vector<double>& times, double t);

/// Why a table that was made to the time where its run `broke` says nothing of time t; empty where it does.
std::string reason_beyond(const std::vector<double>& times, const std::string& broke, double t);

/// The piston in uniaxial strain: motion along x only, the same for every y. Asked at a time that is not in
/// the table it throws: the table is a yardstick at output times, not a source of boundary data.
class PistonTable final : public Solution {
 public:
  /// @throws OutputFailed when the file cannot be read
  explicit PistonTable(const std::string& path);

  GasState gas(double x, double y, double t) const override;
  SolidState solid(double x_bar, double y_bar, double t) const override;
  bool only_at_output_times() const override { return true; }
  std::string missing_at(double t) const override { return reason_beyond(times_, broke_, t); }
  const std::vector<double>& times() const { return times_; }

 private:
  std::vector<double> times_;
  std::string broke_;  ///< why the run that made it ended early; empty where it did not
  std::vector<CubicTable> gas_, solid_;
};

}  // namespace fsi::exact
