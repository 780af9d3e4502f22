#pragma once
/// Telemetry as a run might send it.

#include <unistd.h>

#include <cstdint>
#include <string>

#include "common/wire/messages.hpp"
#include "monitor/registry.hpp"

namespace fsi::monitor {

inline wire::Telemetry telemetry(const std::string& role, const std::string& name, std::uint64_t step,
                                 double t) {
  wire::Telemetry result;
  result.role = role;
  result.from = name;
  result.state = "computing";
  result.step = step;
  result.t = t;
  result.t_end = 4;
  result.dt = 0.01;
  result.limited_by = "fluid";
  result.limits = {{.by = "fluid", .steps = step}};
  result.compute_s = 3;
  result.wait_s = 1;
  return result;
}

/// The coupler's, with a ramp of pressure and velocity along one interface of n points.
inline wire::Telemetry with_interface(const std::string& name, std::size_t n) {
  wire::Telemetry result = telemetry("coupler", "coupler", 7, 1);
  auto& side = result.interfaces.emplace_back();
  side.name = name;
  for (std::size_t k = 0; k < n; ++k) {
    const double s = static_cast<double>(k) / static_cast<double>(n - 1);
    side.s.push_back(s);
    side.x.push_back(s);
    side.p_predicted.push_back(1 + s);
    side.p_predicted_solid.push_back(1 + 2 * s);
    side.w_tangential.push_back(0.1 * s);
    side.p_projected.push_back(1 + 1.5 * s);
    side.v_predicted.push_back(s);
    side.v_predicted_gas.push_back(-s);
    side.v_projected.push_back(0);
  }
  side.x.insert(side.x.end(), n, 0.0);
  side.x_start = side.x;
  side.velocity_scale = side.traction_scale = 1;
  side.shear = 0.1;
  return result;
}

inline RunEntry entry(const std::string& run, const std::string& name = "piston") {
  return {.run = run, .name = name, .dir = "", .pid = getpid()};
}

}  // namespace fsi::monitor
