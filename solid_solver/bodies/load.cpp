#include "solid_solver/bodies/load.hpp"

#include <cstddef>
#include <vector>

#include "common/interface/point_lengths.hpp"

namespace fsi::bodies {

GasLoad operator+(const GasLoad& a, const GasLoad& b) {
  return {.force = a.force + b.force, .moment = a.moment + b.moment, .power = a.power + b.power};
}

GasLoad load_of_gas(std::span<const double> x, std::span<const double> n, std::span<const double> w_n,
                    std::span<const double> v_n) {
  const std::size_t points = x.size() / 2;
  std::vector<double> ds(points);
  point_lengths(x, n, ds);
  GasLoad load;
  for (std::size_t k = 0; k < points; ++k) {
    const double pull = ds[k] * w_n[k];
    const Vec2 force = pull * Vec2(n[k], n[points + k]);
    load.force += force;
    load.moment += x[k] * force.y() - x[points + k] * force.x();
    load.power += pull * v_n[k];
  }
  return load;
}

void GasLoad::archive(Archive& archive) {
  archive.values("force", {force.data(), 2});
  archive.number("moment", moment);
  archive.number("power", power);
}

void Impulse::archive(Archive& archive) {
  archive.inside("sum", [&] { sum_.archive(archive); });
  archive.inside("last", [&] { last_.archive(archive); });
}

void Impulse::add(const GasLoad& load, double dt) {
  sum_.force += 0.5 * dt * (last_.force + load.force);
  sum_.moment += 0.5 * dt * (last_.moment + load.moment);
  sum_.power += 0.5 * dt * (last_.power + load.power);
  last_ = load;
}

}  // namespace fsi::bodies
