#include "common/exact/disk_table.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/core/failure.hpp"
#include "common/io/hdf5.hpp"

namespace fsi::exact {

namespace {

/// Adds the images of the first two points on the other side of the centre.
void mirror(std::vector<double>& values, double sign) {
  values.insert(values.begin(), {sign * values.at(2), sign * values.at(1)});
}

CubicTable solid_table(const io::Hdf5& group) {
  std::vector<double> r = group.read("r_bar").values;
  if (r.size() < 4 || r.front() != 0)
    throw OutputFailed("reference.h5: the radii of the solid must begin with the centre");
  mirror(r, -1);
  std::vector<std::vector<double>> columns;
  for (const char* name : {"u1", "u2", "v1", "v2"}) {
    columns.push_back(group.read(name).values);
    mirror(columns.back(), -1);
  }
  for (const char* name : {"P11", "P12", "P21", "P22"}) {
    columns.push_back(group.read(name).values);
    mirror(columns.back(), 1);
  }
  return {std::move(r), std::move(columns)};
}

CubicTable gas_table(const io::Hdf5& group) {
  return {group.read("r").values, {group.read("rho").values, group.read("v").values, group.read("p").values}};
}

/// Unit vector of the ray through (x, y); any at the centre.
Vec2 ray(double x, double y, double r) {
  return r > 0 ? Vec2(x / r, y / r) : Vec2(1, 0);
}

}  // namespace

double angular_velocity(double omega_0, double r_bar) {
  return omega_0 * std::pow(4 * r_bar * (1 - r_bar), 4);
}

DiskTable::DiskTable(const std::string& path) : TabulatedSolution(path, gas_table, solid_table) {}

GasState DiskTable::gas(double x, double y, double t) const {
  const CubicTable& table = gas_at(t);
  const double r = std::hypot(x, y);
  const auto values = table(std::clamp(r, table.front(), table.back()));
  const Vec2 e = ray(x, y, r);
  return {.rho = values[0], .v1 = values[1] * e[0], .v2 = values[1] * e[1], .p = values[2]};
}

SolidState DiskTable::solid(double x_bar, double y_bar, double t) const {
  const CubicTable& table = solid_at(t);
  const double r = std::hypot(x_bar, y_bar);
  const auto values = table(std::min(r, table.back()));
  const Vec2 e = ray(x_bar, y_bar, r);
  Mat2 turn;  // Rbar^T: its columns are the directions along and across the ray
  turn << e[0], -e[1], e[1], e[0];
  Mat2 P;
  P << values[4], values[5], values[6], values[7];
  SolidState state;
  state.u = turn * Vec2(values[0], values[1]);
  state.v = turn * Vec2(values[2], values[3]);
  state.P = turn * P * turn.transpose();
  return state;
}

}  // namespace fsi::exact
