/// A solid that is not a continuum: a piston on a spring and a damper, one degree of freedom.
///
///     wall |--/\/\/\--|######|
///          |---[==]---|######|  gas        m q'' = F(t) - k q - c q' + (force of the gas)
///                     |######|
///                        --> e, q
///
/// It shows what a solver of your own needs: a hello, a state to publish, what to do with the answer, and the
/// numbers a restart needs. docs/bring_your_own_solid.md goes through it line by line.

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "common/case/grids/grid_points.hpp"
#include "common/core/archive.hpp"
#include "common/core/failure.hpp"
#include "common/core/time/backward_difference.hpp"
#include "common/grid/geometry/interface_geometry.hpp"
#include "common/io/csv_writer.hpp"
#include "common/program/participant.hpp"
#include "common/program/program.hpp"
#include "common/wire/messages.hpp"

namespace {

using fsi::Vec2;

constexpr int points = 5;  ///< on the piston's face; the gas may have any other number

/// Motion along one line: predicted with the acceleration, then what the coupler makes of its response.
struct Oscillator {
  double mass = 1, stiffness = 0, damping = 0;
  double q = 0, q_dot = 0;  ///< position from rest, velocity

  /// To the end of a step, with the acceleration of the last two.
  void predict(double step) {
    q_older = q_old;
    q_dot_older = q_dot_old;
    q_old = q;
    q_dot_old = q_dot;
    q += step * (q_dot + 0.5 * step * a);
    q_dot += step * a;
    dt_before = dt;
    dt = step;
  }

  /// How it answers a load f at the end of the step: S q_dot = g + dt f. Backward differences for q_dot and
  /// for q, which is (h + dt q_dot) / b at the end, with b the leading weight and h the past.
  struct Response {
    double S, g;
  };
  Response response(double pull) const {
    const fsi::BackwardDifference bdf = difference();
    const double b = bdf.leading, h = bdf.history(q_old, q_older);
    return {.S = b * mass + dt * (damping + dt * stiffness / b),
            .g = mass * bdf.history(q_dot_old, q_dot_older) + dt * (pull - stiffness * h / b)};
  }

  /// The velocity at the end of the step is known now.
  void correct(double velocity) {
    q_dot = velocity;
    if (dt == 0) return;
    const fsi::BackwardDifference bdf = difference();
    q = (bdf.history(q_old, q_older) + dt * q_dot) / bdf.leading;
    const double mean = (q_dot - q_dot_old) / dt;
    a = mean + (dt_before > 0 ? dt / (dt + dt_before) * (mean - mean_before) : 0);
    mean_before = mean;
  }

  /// All that the next steps depend on.
  void archive(fsi::Archive& archive) {
    for (const auto& [name, value] : {std::pair{"q", &q},
                                      {"q_dot", &q_dot},
                                      {"q_old", &q_old},
                                      {"q_older", &q_older},
                                      {"q_dot_old", &q_dot_old},
                                      {"q_dot_older", &q_dot_older},
                                      {"a", &a},
                                      {"mean_before", &mean_before},
                                      {"dt", &dt},
                                      {"dt_before", &dt_before}})
      archive.number(name, *value);
  }

  fsi::BackwardDifference difference() const { return fsi::backward_difference(dt, dt_before); }

  double q_old = 0, q_older = 0, q_dot_old = 0, q_dot_older = 0, a = 0, mean_before = 0, dt = 0,
         dt_before = 0;
};

/// The side of the piston that meets the gas.
fsi::Side face_of(const fsi::SolidSpec& spec) {
  const auto side = std::ranges::find(spec.boundary, fsi::BoundaryKind::interface, &fsi::BoundarySpec::kind);
  if (side == spec.boundary.end()) throw fsi::UserMistake("no side of the piston is an interface");
  return fsi::all_sides[side - spec.boundary.begin()];
}

/// The piston in the plane: where its face is, how it speaks of it, and what it hears.
class Piston final : public fsi::Participant {
 public:
  explicit Piston(const fsi::Setup& setup)
      : digest_(setup.problem.digest),
        spec_(fsi::solid_of(setup)),
        table_(fmt::format("{}/forces_{}.csv", setup.run_dir, setup.name),
               {"t [time]", "force1 [force/depth]", "force2 [force/depth]", "power [power/depth]",
                "centre1 [length]", "centre2 [length]", "velocity1 [length/time]", "velocity2 [length/time]"},
               setup.opening()) {
    const fsi::Side face = face_of(spec_);
    x_0_ = fsi::points_on_side(spec_.grid, face, points);
    n_ = fsi::grid::normals(x_0_, fsi::grid::Curve::open, fsi::grid::outward(face));
    e_ = {n_[0], n_[points]};
    width_ = Vec2(x_0_[points - 1] - x_0_[0], x_0_[2 * points - 1] - x_0_[points]).norm();
    const double depth =
        fsi::direction_of(face) == 0 ? spec_.grid.x_b - spec_.grid.x_a : spec_.grid.y_b - spec_.grid.y_a;
    centre_ = 0.5 * (Vec2(x_0_[0] + x_0_[points - 1], x_0_[points] + x_0_[2 * points - 1]) - depth * e_);
    motion_ = {
        .mass = spec_.rho * width_ * depth, .stiffness = number("stiffness"), .damping = number("damping")};
  }

  fsi::wire::Hello hello() const override {
    fsi::wire::Hello hello;
    hello.role = "solid";
    hello.name = spec_.name;
    hello.law = "spring and damper";
    hello.config_digest = digest_;
    hello.points = points;
    hello.interfaces.push_back({.name = spec_.name, .dimension = 2, .x = x_0_, .n = n_});
    return hello;
  }

  fsi::ProposedTimeStep compute_time_step() const override {
    return {.dt = std::numeric_limits<double>::infinity(), .reason = "implicit"};
  }

  /// The predicted state as the coupler wants it: face, and response of the one mode, n . dx/dq = 1.
  void fill(std::size_t /*interface*/, fsi::wire::PredictedInterface& state) const override {
    state.x.clear();
    state.v.clear();
    for (int c = 0; c < 2; ++c) {
      for (int k = 0; k < points; ++k) {
        state.x.push_back(x_0_[static_cast<std::size_t>(c * points + k)] + motion_.q * e_[c]);
        state.v.push_back(motion_.q_dot * e_[c]);
      }
    }
    const Oscillator::Response response = motion_.response(pull(state.t));
    state.modal = {.modes = 1,
                   .S = {.row = {0}, .column = {0}, .value = {response.S}},
                   .g = {response.g},
                   .N = {.row = std::vector<std::int32_t>(points, 0),
                         .column = {0, 1, 2, 3, 4},
                         .value = std::vector<double>(points, 1.0)},
                   .q_dot = {motion_.q_dot}};
  }

  /// The answer: velocity of the face, and by the traction the force of the gas along e.
  void apply_bcs(double /*t*/, fsi::ProjectedStates gas) override {
    motion_.correct(gas.front()->q_dot.front());
    force_ = width_ * gas.front()->w_n[points / 2];
  }

  void write_tables(double t, double /*dt*/, fsi::ProjectedStates /*gas*/) override {
    const Vec2 force = force_ * e_, velocity = motion_.q_dot * e_, centre = centre_ + motion_.q * e_;
    table_.row(
        {t, force[0], force[1], force_ * motion_.q_dot, centre[0], centre[1], velocity[0], velocity[1]});
  }

  void flush_tables() override { table_.flush(); }

  void advance(double /*t*/, double dt, int /*substeps*/, fsi::ProjectedStates /*gas*/) override {
    motion_.predict(dt);
  }

  void archive(fsi::Archive& archive) override {
    archive.inside("motion", [&] { motion_.archive(archive); });
    archive.inside("table", [&] { table_.archive(archive); });
  }

 private:
  double number(const std::string& name) const {
    const auto found = spec_.data.find(name);
    if (found != spec_.data.end() && found->second >= 0) return found->second;
    throw fsi::UserMistake(fmt::format("solids.{}.data: write `{}: NUMBER`, not negative", spec_.name, name));
  }

  /// The case's body force of the reference centre, on the whole piston.
  double pull(double t) const {
    if (!spec_.body_force) return 0;
    const auto& [c1, c2] = *spec_.body_force;
    return motion_.mass / spec_.rho *
           e_.dot(Vec2(c1(centre_[0], centre_[1], t), c2(centre_[0], centre_[1], t)));
  }

  const std::string& digest_;
  const fsi::SolidSpec& spec_;
  fsi::io::CsvWriter table_;
  std::vector<double> x_0_, n_;
  Vec2 e_, centre_;  ///< along which it moves; of its mass, at rest
  double width_ = 0, force_ = 0;
  Oscillator motion_;
};

}  // namespace

int main(int argc, char** argv) {
  return fsi::run_program(argc, argv, "piston", "solid", [](const fsi::Setup& setup, fsi::io::Part& part) {
    Piston piston(setup);
    participate(setup, part, piston);
  });
}
