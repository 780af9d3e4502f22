#include "fluid_solver/boundary/wall_motion.hpp"

#include "fluid_solver/boundary/ghost_lines.hpp"

namespace fsi::fluid {

WallMotion wall_at_rest(std::size_t points) {
  const std::vector<double> zero(2 * points, 0.0);
  return {.normal = zero, .velocity = zero, .acceleration = zero, .mid_velocity = zero, .bend = zero};
}

void WallMotion::archive(Archive& archive) {
  archive.values("normal", normal);
  archive.values("velocity", velocity);
  archive.values("acceleration", acceleration);
  archive.values("mid_velocity", mid_velocity);
  archive.values("bend", bend);
}

void advance_motion(WallMotion& wall, ConstFieldView x, ConstFieldView x_before, const SidePoints& side,
                    const StepHistory& history) {
  const auto [dt, before, earlier, order] = history;
  const auto n = static_cast<std::size_t>(side.n());
  for (std::size_t point = 0; point < n; ++point) {
    const auto [i, j] = side.at(static_cast<int>(point), 0);
    for (const int c : {0, 1}) {
      const std::size_t k = static_cast<std::size_t>(c) * n + point;
      const double first = (x(c, i, j) - x_before(c, i, j)) / dt;
      const double second = order > 1 ? (first - wall.mid_velocity[k]) / (dt + before) : 0;
      const double third = order > 2 ? (second - wall.bend[k]) / (dt + before + earlier) : 0;
      wall.velocity[k] = first + dt * (second + (dt + before) * third);
      wall.acceleration[k] = 2 * (second + (2 * dt + before) * third);
      wall.mid_velocity[k] = first;
      wall.bend[k] = second;
    }
  }
}

void start_motion(WallMotion& wall, const std::array<std::vector<double>, 4>& x, double delta) {
  for (std::size_t k = 0; k < wall.velocity.size(); ++k) {
    const double x1 = x[1][k] - x[0][k], x2 = x[2][k] - x[0][k], x3 = x[3][k] - x[0][k];
    wall.velocity[k] = (3 * x1 - 1.5 * x2 + x3 / 3) / delta;
    wall.acceleration[k] = (-5 * x1 + 4 * x2 - x3) / (delta * delta);
    wall.mid_velocity[k] = wall.velocity[k];
    wall.bend[k] = 0.5 * wall.acceleration[k];
  }
}

void measure_normals(WallMotion& wall, ConstFieldView x, const SidePoints& side) {
  const auto n = static_cast<std::size_t>(side.n());
  for (std::size_t k = 0; k < n; ++k) {
    const Vec2 normal = inward_normal(x, side, static_cast<int>(k));
    wall.normal[k] = normal[0];
    wall.normal[n + k] = normal[1];
  }
}

}  // namespace fsi::fluid
