#pragma once
/// Messages of small runs for the tests of the coupler.

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "common/core/time/backward_difference.hpp"
#include "common/wire/messages.hpp"

namespace fsi::coupler::testing {

/// Points on the line x = `x`, y = 0 .. 1, component-major.
inline std::vector<double> vertical_line(std::size_t n, double x) {
  std::vector<double> points(2 * n, x);
  for (std::size_t k = 0; k < n; ++k) points[n + k] = static_cast<double>(k) / static_cast<double>(n - 1);
  return points;
}

/// The same vector at n points.
inline std::vector<double> everywhere(std::size_t n, double c1, double c2) {
  std::vector<double> values(2 * n, c1);
  for (std::size_t k = 0; k < n; ++k) values[n + k] = c2;
  return values;
}

/// A mass without any other load, by backward differences.
struct BdfBody {
  double mass = 1;
  double now = 0, before = 0, dt = 0, dt_before = 0;

  double S() const { return backward_difference(dt, dt_before).leading * mass; }
  double g() const { return mass * backward_difference(dt, dt_before).history(now, before); }
  /// Velocity at the end of a step, and the next one's size.
  void take(double q_dot, double dt_next) {
    before = now;
    now = q_dot;
    dt_before = dt;
    dt = dt_next;
  }
};

/// A solid of one mode of velocity N at the points, S q_dot = g + dt f.
inline wire::ModalResponse one_mode(double S, double g, const std::vector<double>& N, double q_dot = 0) {
  wire::ModalResponse modal{
      .modes = 1, .S = {.row = {0}, .column = {0}, .value = {S}}, .g = {g}, .N = {}, .q_dot = {q_dot}};
  for (std::size_t k = 0; k < N.size(); ++k) {
    modal.N.row.push_back(0);
    modal.N.column.push_back(static_cast<std::int32_t>(k));
    modal.N.value.push_back(N[k]);
  }
  return modal;
}

inline wire::Hello fluid_hello(std::vector<wire::InterfaceInfo> interfaces) {
  wire::Hello hello;
  hello.role = "fluid";
  hello.name = "fluid";
  hello.interfaces = std::move(interfaces);
  return hello;
}

inline wire::Hello solid_hello(const std::string& name, wire::InterfaceInfo interface) {
  wire::Hello hello;
  hello.role = "solid";
  hello.name = name;
  hello.interfaces = {std::move(interface)};
  return hello;
}

/// A solid on the left of the line x = 0 and the gas on its right.
inline std::vector<wire::Hello> piston_hellos(std::size_t n, const std::string& solid = "solid") {
  return {fluid_hello({{.name = solid, .dimension = 2, .x = vertical_line(n, 0), .n = {}}}),
          solid_hello(solid,
                      {.name = solid, .dimension = 2, .x = vertical_line(n, 0), .n = everywhere(n, 1, 0)})};
}

inline wire::PredictedInterface gas_state(std::size_t n, std::uint64_t step,
                                          const std::string& interface = "solid") {
  wire::PredictedInterface state;
  state.from = "fluid";
  state.interface = interface;
  state.step = step;
  state.proposed_dt = 0.1;
  state.dt_reason = "sound";
  state.x = vertical_line(n, 0);
  state.v = everywhere(n, 0, 0);
  state.p.assign(n, 1.0);
  state.z_f.assign(n, 1.0);
  state.p_e = 1.0;
  return state;
}

inline wire::PredictedInterface solid_state(std::size_t n, std::uint64_t step,
                                            const std::string& name = "solid") {
  wire::PredictedInterface state;
  state.from = name;
  state.interface = name;
  state.step = step;
  state.proposed_dt = 0.1;
  state.dt_reason = "p-wave";
  state.x = vertical_line(n, 0);
  state.v = everywhere(n, 0, 0);
  state.w = everywhere(n, 0, 0);
  state.Z.assign(3 * n, 0.0);
  for (std::size_t k = 0; k < n; ++k) {
    state.Z[k] = 2.0;
    state.Z[2 * n + k] = 1.0;
  }
  state.z_p = 2.0;
  return state;
}

}  // namespace fsi::coupler::testing
