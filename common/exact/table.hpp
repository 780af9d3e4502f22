#pragma once
/// A one-dimensional solution tabulated on fine points at output times, as `reference_piston` computes it.

#include <functional>
#include <string>
#include <vector>

#include "common/exact/solution.hpp"

namespace fsi::io {
class Hdf5;
}

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

/// What a run of a one-dimensional reference leaves: a table of gas and solid per output time. Asked at a time
/// that is not in it it throws: it is a yardstick at output times, not a source of boundary data.
class TabulatedSolution : public Solution {
 public:
  bool only_at_output_times() const override { return true; }
  std::string missing_at(double t) const override { return reason_beyond(times_, broke_, t); }
  const std::vector<double>& times() const { return times_; }

 protected:
  /// How a group of the file becomes a table.
  using Reading = std::function<CubicTable(const io::Hdf5& group)>;
  /// @throws OutputFailed when the file cannot be read
  TabulatedSolution(const std::string& path, const Reading& gas, const Reading& solid);

  const CubicTable& gas_at(double t) const { return gas_[index_of_time(times_, t)]; }
  const CubicTable& solid_at(double t) const { return solid_[index_of_time(times_, t)]; }

 private:
  std::vector<double> times_;
  std::string broke_;  ///< why the run that made it ended early; empty where it did not
  std::vector<CubicTable> gas_, solid_;
};

/// The piston in uniaxial strain: motion along x only, the same for every y.
class PistonTable final : public TabulatedSolution {
 public:
  /// @throws OutputFailed when the file cannot be read
  explicit PistonTable(const std::string& path);

  GasState gas(double x, double y, double t) const override;
  SolidState solid(double x_bar, double y_bar, double t) const override;
};

}  // namespace fsi::exact
