/// A solid that is not a continuum: a piston on a spring and a damper, one degree of freedom.
///
///     wall |--/\/\/\--|######|
///          |---[==]---|######|  gas        m q'' = F(t) - k q - c q' + (force of the gas)
///                     |######|
///                        --> e, q
///
/// It shows what a solver of your own needs: a hello, one message out and one in per step, and an ending that
/// everybody hears. docs/bring_your_own_solid.md goes through it line by line.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "common/bus/solver_session.hpp"
#include "common/case/grid_points.hpp"
#include "common/core/failure.hpp"
#include "common/grid/interface_geometry.hpp"
#include "common/io/csv_writer.hpp"
#include "common/program/program.hpp"
#include "common/wire/messages.hpp"

namespace {

using fsi::Vec2;

constexpr int points = 5;            ///< on the piston's face; the gas may have any other number
constexpr double steps_in_time = 5;  ///< at least so many in the time sqrt(m / k) or m / c

/// Motion along one line, advanced by a prediction and a correction of second order.
struct Oscillator {
  double mass = 1, stiffness = 0, damping = 0;
  double q = 0, q_dot = 0;  ///< position from rest, velocity

  double own_load() const { return -stiffness * q - damping * q_dot; }

  /// To the end of a step, with the acceleration of the last two.
  void predict(double step) {
    q_old = q;
    q_dot_old = q_dot;
    q += step * (q_dot + 0.5 * step * a);
    q_dot += step * a;
    dt = step;
  }

  /// The velocity at the end of the step is known now.
  void correct(double velocity) {
    q_dot = velocity;
    if (dt == 0) return;
    q = q_old + 0.5 * dt * (q_dot_old + q_dot);
    const double mean = (q_dot - q_dot_old) / dt;
    a = mean + (dt_before > 0 ? dt / (dt + dt_before) * (mean - mean_before) : 0);
    mean_before = mean;
    dt_before = dt;
  }

  double q_old = 0, q_dot_old = 0, a = 0, mean_before = 0, dt = 0, dt_before = 0;
};

/// The piston in the plane: where its face is, and how it speaks of it.
class Piston {
 public:
  Piston(const fsi::SolidSpec& spec, fsi::Side face) : spec_(spec) {
    x_0_ = fsi::points_on_side(spec.grid, face, points);
    n_ = fsi::grid::normals(x_0_, fsi::grid::Curve::open, fsi::grid::outward(face));
    e_ = {n_[0], n_[points]};
    width_ = Vec2(x_0_[points - 1] - x_0_[0], x_0_[2 * points - 1] - x_0_[points]).norm();
    const double depth =
        fsi::direction_of(face) == 0 ? spec.grid.x_b - spec.grid.x_a : spec.grid.y_b - spec.grid.y_a;
    motion = {
        .mass = spec.rho * width_ * depth, .stiffness = number("stiffness"), .damping = number("damping")};
  }

  fsi::wire::Hello hello(const std::string& digest) const {
    fsi::wire::Hello hello;
    hello.role = "solid";
    hello.name = spec_.name;
    hello.law = "spring and damper";
    hello.config_digest = digest;
    hello.points = points;
    hello.interfaces.push_back({.name = spec_.name, .dimension = 2, .x = x_0_, .n = n_});
    return hello;
  }

  /// The state at t as the coupler wants it: face, and response of the one mode, n . dx/dq = 1.
  fsi::wire::PredictedInterface state(std::uint64_t step, double t) const {
    fsi::wire::PredictedInterface state;
    state.interface = spec_.name;
    state.step = step;
    state.t = t;
    state.dt_bid = largest_step();
    state.dt_reason = "spring and damper";
    for (int c = 0; c < 2; ++c) {
      for (int k = 0; k < points; ++k) {
        state.x.push_back(x_0_[static_cast<std::size_t>(c * points + k)] + motion.q * e_[c]);
        state.v.push_back(motion.q_dot * e_[c]);
      }
    }
    state.modal = {.modes = 1,
                   .M = {motion.mass},
                   .N = std::vector<double>(points, 1.0),
                   .q_dot = {motion.q_dot},
                   .f_own = {motion.own_load() + pull(t)}};
    return state;
  }

  /// Force of the gas along e, from the projected traction.
  double force(const fsi::wire::ProjectedInterface& gas) const { return width_ * gas.w_n[points / 2]; }
  Vec2 centre() const {
    return {0.5 * (x_0_[0] + x_0_[points - 1]) + motion.q * e_[0],
            0.5 * (x_0_[points] + x_0_[2 * points - 1]) + motion.q * e_[1]};
  }
  const Vec2& direction() const { return e_; }

  Oscillator motion;

 private:
  double number(const std::string& name) const {
    const auto found = spec_.data.find(name);
    if (found != spec_.data.end() && found->second >= 0) return found->second;
    throw fsi::UserMistake(fmt::format("solids.{}.data: write `{}: NUMBER`, not negative", spec_.name, name));
  }

  double largest_step() const {
    const double never = std::numeric_limits<double>::infinity();
    const double spring = motion.stiffness > 0 ? std::sqrt(motion.mass / motion.stiffness) : never;
    const double damper = motion.damping > 0 ? motion.mass / motion.damping : never;
    return std::min(spring, damper) / steps_in_time;
  }

  /// The case's body force on the whole piston.
  double pull(double t) const {
    if (!spec_.body_force) return 0;
    return motion.mass / spec_.rho *
           e_.dot(Vec2(spec_.body_force->c1(0, 0, t), spec_.body_force->c2(0, 0, t)));
  }

  const fsi::SolidSpec& spec_;
  std::vector<double> x_0_, n_;
  Vec2 e_;
  double width_ = 0;
};

/// Steps until the coupler says stop.
void loop(fsi::bus::SolverSession& session, Piston& piston, fsi::io::CsvWriter& table, fsi::io::Part& part) {
  double t = 0;
  for (std::uint64_t step = 0;; ++step) {
    const fsi::wire::PredictedInterface predicted = piston.state(step, t);
    session.publish(predicted);
    const fsi::wire::ProjectedInterface& answer = session.receive(predicted.interface, step);
    piston.motion.correct(answer.v_n[points / 2]);
    const Vec2 force = piston.force(answer) * piston.direction();
    const Vec2 centre = piston.centre(), velocity = piston.motion.q_dot * piston.direction();
    table.row({t, force[0], force[1], piston.force(answer) * piston.motion.q_dot, centre[0], centre[1],
               velocity[0], velocity[1]});
    if (answer.stop) return;
    piston.motion.predict(answer.dt_next);
    t = answer.t_next;
    fsi::count_step(part, t, answer.dt_next);
    ++part.substeps;
    fsi::throw_if_interrupted();
  }
}

void run(const fsi::Setup& setup, fsi::io::Part& part) {
  const auto spec = std::ranges::find(setup.problem.solids, setup.name, &fsi::SolidSpec::name);
  if (spec == setup.problem.solids.end()) throw fsi::UserMistake("the case has no solid " + setup.name);
  const auto side = std::ranges::find(spec->boundary, fsi::BoundaryKind::interface, &fsi::BoundarySpec::kind);
  if (side == spec->boundary.end()) throw fsi::UserMistake("no side of the piston is an interface");
  if (!setup.restart.empty()) throw fsi::UserMistake("the spring piston keeps no checkpoints: start anew");
  Piston piston(*spec, fsi::all_sides[side - spec->boundary.begin()]);
  part.points = points;
  fsi::io::CsvWriter table(
      fmt::format("{}/forces_{}.csv", setup.run_dir, setup.name),
      {"t [time]", "force1 [force/depth]", "force2 [force/depth]", "power [power/depth]", "centre1 [length]",
       "centre2 [length]", "velocity1 [length/time]", "velocity2 [length/time]"});
  fsi::bus::SolverSession session({.run = setup.run,
                                   .key = setup.key,
                                   .peer_timeout_s = setup.problem.time.peer_timeout,
                                   .step_timeout_s = setup.problem.time.step_timeout,
                                   .throw_if_interrupted = fsi::throw_if_interrupted},
                                  piston.hello(setup.problem.digest));
  try {
    loop(session, piston, table, part);
    session.leave();
  } catch (const fsi::Failure& failure) {
    session.abort(failure.code(), failure.what());
    throw;
  }
}

}  // namespace

int main(int argc, char** argv) {
  return fsi::run_program(argc, argv, "piston", "solid", run);
}
