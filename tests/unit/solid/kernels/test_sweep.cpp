// One step of the sweep, without a solver around it: fields
// whose next values the equations of motion give exactly.

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <utility>

#include "solid_solver/boundary/ghost_lines.hpp"
#include "solid_solver/kernels/sweep/dissipation.hpp"
#include "solid_solver/kernels/sweep/godunov_sweep.hpp"
#include "solid_solver/laws/neo_hookean.hpp"
#include "tests/convergence/solid/skewed_grid.hpp"

namespace fsi::solid {
namespace {

constexpr int cells = 10;
constexpr double rho = 1.7;
const NeoHookean law{.lambda = 1.2, .mu = 0.8};

/// A grid with its metrics, and one step of the sweep on it.
class Block {
 public:
  explicit Block(grid::MovingGrid grid)
      : grid_(std::move(grid)), metrics_(grid_.x()), points_(grid_.layout()) {}
  /// Points of these columns alone are advanced.
  Block(grid::MovingGrid grid, grid::Interval columns)
      : grid_(std::move(grid)), metrics_(grid_.x()), points_(points_in(grid_.layout(), columns)) {}

  /// The state after a step from `state(x)`, given at ghosts too.
  template <Limiter limiter>
  Field step(const std::function<SolidState(const Vec2&)>& state, double dt, const Vec2& force = Vec2::Zero(),
             Look look = Look::all) {
    return step_with<limiter>(state, dt, force, look,
                              [](const auto& sweep, ConstFieldView, FieldView) { return sweep.run(); });
  }
  /// The same, as `run` runs the sweep from one field to the next.
  template <Limiter limiter, class Run>
  Field step_with(const std::function<SolidState(const Vec2&)>& state, double dt, const Vec2& force,
                  Look look, const Run& run) {
    const Layout& layout = grid_.layout();
    Field q(layout, plane::count), next(layout, plane::count), b(layout, 2), work(sweep_work, 1);
    for (int j = -2; j < layout.n2 + 2; ++j) {
      for (int i = -2; i < layout.n1 + 2; ++i) {
        store(q.view(), layout.at(i, j), state(position(i, j)));
        b(0, i, j) = force.x();
        b(1, i, j) = force.y();
      }
    }
    const SweepData data{.points = &points_,
                         .q = q.view(),
                         .next = next.view(),
                         .force = b.view(),
                         .work = work.view(),
                         .rho = rho,
                         .dt = dt,
                         .look = look};
    result =
        metrics_.cartesian()
            ? run(GodunovSweep<NeoHookean, CartesianRow, limiter>(data, metrics_, law), q.view(), next.view())
            : run(GodunovSweep<NeoHookean, MappedRow, limiter>(data, metrics_, law), q.view(), next.view());
    return next;
  }
  Vec2 position(int i, int j) const { return {grid_.x()(0, i, j), grid_.x()(1, i, j)}; }
  const Layout& layout() const { return grid_.layout(); }
  const grid::MovingGrid& grid() const { return grid_; }
  const ReferenceMetrics& metrics() const { return metrics_; }

  SweepResult result;

 private:
  static SolidPoints points_in(const Layout& layout, grid::Interval columns) {
    grid::RowSets some;
    for (int j = 0; j < layout.n2; ++j) {
      some.append(columns);
      some.end_row();
    }
    return {layout, some, grid::all_points(layout.n1, layout.n2)};
  }

  grid::MovingGrid grid_;
  ReferenceMetrics metrics_;
  SolidPoints points_;
};

/// Applies `check(state, x)` to all points of a field.
template <class Check>
void at_all_points(const Block& block, const Field& q, const Check& check) {
  for (int j = 0; j < block.layout().n2; ++j) {
    for (int i = 0; i < block.layout().n1; ++i)
      check(load(q.view(), block.layout().at(i, j)), block.position(i, j));
  }
}

Tensor2 tensor(const Mat2& F) {
  return {F(0, 0), F(0, 1), F(1, 0), F(1, 1)};
}

double distance(const Tensor2& a, const Tensor2& b) {
  return std::max(
      {std::abs(a.a11 - b.a11), std::abs(a.a12 - b.a12), std::abs(a.a21 - b.a21), std::abs(a.a22 - b.a22)});
}

const Mat2 stretch{{1.1, 0.2}, {-0.1, 0.95}}, rate{{0.3, -0.5}, {0.2, 0.4}};
const Vec2 drift(0.3, -0.7);

TEST(Eq35Sweep, LeavesABodyInUniformStressAtRest) {
  for (const auto& grid : {test::skewed_grid, test::unit_square}) {
    Block block(grid(cells));
    const auto uniform = [](const Vec2& x) {
      return SolidState{
          .u = (stretch - Mat2::Identity()) * x, .v = Vec2::Zero(), .P = law.P(tensor(stretch))};
    };
    const auto check = [&](const SolidState& s, const Vec2& x) {
      EXPECT_LT((s.u - uniform(x).u).norm(), 1e-14);
      EXPECT_LT(s.v.norm(), 1e-13);  // forces of size h that cancel, over h^2
      EXPECT_LT(distance(s.P, uniform(x).P), 1e-13);
    };
    at_all_points(block, block.step<Limiter::none>(uniform, 0.01), check);
    at_all_points(block, block.step<Limiter::minmod>(uniform, 0.01), check);
    EXPECT_NEAR(block.result.min_det_F, stretch.determinant(), 1e-13);
    EXPECT_EQ(block.result.broken, 0);
  }
}

/// A mapped grid whose cells all look alike, on which face values of linear fields are exact.
grid::MovingGrid sheared_square(int number) {
  return test::grid_of([](double r, double s) { return Vec2(r + 0.2 * s, 0.1 * r + s); }, number);
}

TEST(Eq36Sweep, StressFollowsTheLawThroughAUniformStrainRateEq37) {
  // F grows by dt L. The midpoint rule for dP = K : L has an error of dt^3: an eighth at half of the step.
  for (const auto& grid : {sheared_square, test::unit_square}) {
    Block block(grid(cells));
    const auto error_after = [&](double dt) {
      const auto state = [](const Vec2& x) {
        return SolidState{
            .u = (stretch - Mat2::Identity()) * x, .v = drift + rate * x, .P = law.P(tensor(stretch))};
      };
      const Tensor2 P = law.P(tensor(stretch + dt * rate));
      double error = 0;
      at_all_points(block, block.step<Limiter::none>(state, dt), [&](const SolidState& s, const Vec2& x) {
        EXPECT_LT((s.v - state(x).v).norm(), 1e-12);
        EXPECT_LT((s.u - state(x).u - dt * state(x).v).norm(), 1e-13);
        error = std::max(error, distance(s.P, P));
      });
      return error;
    };
    const double coarse = error_after(0.04), fine = error_after(0.02);
    EXPECT_LT(coarse, 1e-4);
    EXPECT_NEAR(coarse / fine, 8, 0.5);
  }
}

TEST(Eq35Sweep, ForcesAreTheDivergenceOfTheStressOverItsFirstIndexEq2) {
  // Linear stresses: div P = (P11,1 + P21,2, P12,1 + P22,2), constant.
  Block block(test::unit_square(cells));
  const double dt = 0.01;
  const Vec2 force(0.4, -0.9);
  const auto state = [](const Vec2& x) {
    return SolidState{.u = Vec2::Zero(),
                      .v = drift,
                      .P = {0.3 * x.x() + 1.1 * x.y(), -0.7 * x.x() + 0.6 * x.y(), 0.9 * x.x() + 0.5 * x.y(),
                            1.3 * x.x() - 0.2 * x.y()}};
  };
  const Vec2 acceleration = (Vec2(0.3 + 0.5, -0.7 - 0.2) + force) / rho;
  const auto check = [&](const SolidState& s, const Vec2& x) {
    EXPECT_LT((s.v - drift - dt * acceleration).norm(), 1e-13) << x;
    EXPECT_LT((s.u - dt * drift - 0.5 * dt * dt * acceleration).norm(), 1e-15) << x;
  };
  at_all_points(block, block.step<Limiter::none>(state, dt, force), check);
  at_all_points(block, block.step<Limiter::minmod>(state, dt, force), check);
}

TEST(Eq35Sweep, ForcesAreThoseOfTheStressAtHalfTimeInAStretchedBody) {
  // In uniform stress nothing pushes at first. A strain rate that varies makes stresses that do, half of a
  // step later: v changes by dt div P(F + dt/2 grad v) / rho, here with quadratic v, far from rest.
  const Mat2 F{{1.4, 0.5}, {-0.3, 0.8}};
  const double dt = 0.002;
  const auto velocity = [](const Vec2& x) {
    return Vec2(0.7 * x.x() * x.x() - 0.4 * x.x() * x.y(), 0.5 * x.x() * x.y() + 0.9 * x.y() * x.y());
  };
  const auto stress = [&](const Vec2& x) {
    const Mat2 L{{1.4 * x.x() - 0.4 * x.y(), -0.4 * x.x()}, {0.5 * x.y(), 0.5 * x.x() + 1.8 * x.y()}};
    return law.P(tensor(F + 0.5 * dt * L));
  };
  const auto push = [&](const Vec2& x) -> Vec2 {
    const double e = 1e-3;
    const Tensor2 right = stress(x + Vec2(e, 0)), left = stress(x - Vec2(e, 0)), up = stress(x + Vec2(0, e)),
                  down = stress(x - Vec2(0, e));
    return Vec2(right.a11 - left.a11 + up.a21 - down.a21, right.a12 - left.a12 + up.a22 - down.a22) /
           (2 * e * rho);
  };
  Block block(test::unit_square(cells));
  const auto state = [&](const Vec2& x) {
    return SolidState{.u = (F - Mat2::Identity()) * x, .v = velocity(x), .P = law.P(tensor(F))};
  };
  double error = 0, size = 0;
  at_all_points(block, block.step<Limiter::none>(state, dt), [&](const SolidState& s, const Vec2& x) {
    const Vec2 expected = dt * push(x);
    error = std::max(error, (s.v - velocity(x) - expected).norm());
    size = std::max(size, expected.norm());
  });
  EXPECT_LT(error,
            0.01 * size);  // the stress at half time is known to the order of dt: 0.002 times rates of 2
}

TEST(Eq44Sweep, RateIsThatOfThePWaveOverBothSpacings) {
  Block block(test::unit_square(cells));
  const auto rest = [](const Vec2&) { return SolidState{.u = Vec2::Zero(), .v = Vec2::Zero(), .P = {}}; };
  block.step<Limiter::none>(rest, 0.01);
  const double c_p = std::sqrt((law.lambda + 2 * law.mu) / rho);
  EXPECT_NEAR(std::sqrt(block.result.rate_squared), c_p * (cells + cells), 1e-12);
  EXPECT_EQ(block.result.min_det_F, 1);
}

TEST(Eq35Sweep, APlaneWaveMovesOnWithItsOwnSpeedInEveryDirection) {
  // Small plane p-waves u = a n f(n.x - c t) obey the linear
  // equations; the error of one step is that of the scheme.
  const double wave_number = 2 * std::numbers::pi, size = 1e-7, dt = 0.004;
  const double c_p = std::sqrt((law.lambda + 2 * law.mu) / rho);
  for (const double angle : {0.0, 0.9, 2.2, 4.0}) {
    const Vec2 n(std::cos(angle), std::sin(angle));
    const auto wave = [&](const Vec2& x, double t) {
      const double phase = wave_number * (n.dot(x) - c_p * t), slope = size * std::cos(phase);
      const Mat2 E = slope * n * n.transpose();
      const Mat2 P = law.lambda * E.trace() * Mat2::Identity() + 2 * law.mu * E;
      return SolidState{.u = size / wave_number * std::sin(phase) * n, .v = -c_p * slope * n, .P = tensor(P)};
    };
    Block block(test::skewed_grid(40));
    const Field next = block.step<Limiter::none>([&](const Vec2& x) { return wave(x, 0); }, dt);
    double v_error = 0, P_error = 0;
    at_all_points(block, next, [&](const SolidState& s, const Vec2& x) {
      v_error = std::max(v_error, (s.v - wave(x, dt).v).norm());
      P_error = std::max(P_error, distance(s.P, wave(x, dt).P));
    });
    // The step changes v by k c_p dt = 0.03 of its size; two
    // per cent of that are missed at 40 points a wavelength.
    const double change = size * wave_number * c_p * dt;
    EXPECT_LT(v_error, 0.03 * change * c_p) << angle;
    EXPECT_LT(P_error, 0.03 * change * (law.lambda + 2 * law.mu)) << angle;
  }
}

TEST(Sweep, MakesTheSameStepWhetherItLooksAtTheWavesOrNot) {
  const auto state = [](const Vec2& x) {
    return SolidState{.u = 0.02 * Vec2(std::sin(3 * x.y()), std::cos(2 * x.x())),
                      .v = {std::cos(x.x()), x.x() * x.y()},
                      .P = {0.1 * x.x(), 0.2, -0.1 * x.y(), 0.3}};
  };
  for (const int more : {0, 5}) {
    Block block(test::skewed_grid(cells + more));
    const Field all = block.step<Limiter::minmod>(state, 0.01);
    const SweepResult with_waves = block.result;
    const Field less = block.step<Limiter::minmod>(state, 0.01, Vec2::Zero(), Look::soundness);
    EXPECT_TRUE(std::ranges::equal(all.values(), less.values()));
    EXPECT_EQ(block.result.min_det_F, with_waves.min_det_F);
    EXPECT_GT(with_waves.rate_squared, 0);
    EXPECT_EQ(block.result.rate_squared, 0);
  }
}

/// Points enough for several strips of a sweep, bent or along the axes.
grid::MovingGrid long_grid(bool bent) {
  constexpr double length = 40;
  return {{.name = "long",
           .n1 = 1013,
           .n2 = 5,
           .mapping = [bent](double r, double s, double) -> Vec2 {
             return {length * r + (bent ? 0.01 * s : 0.0), 0.2 * s + (bent ? 0.03 * std::sin(8 * r) : 0.0)};
           }},
          0};
}

SolidState wavy(const Vec2& x) {
  return {.u = 0.02 * Vec2(std::sin(3 * x.y()), std::cos(2 * x.x())),
          .v = {std::cos(x.x()), x.x() * x.y()},
          .P = {0.1 * std::sin(x.x()), 0.2, -0.1 * x.y(), 0.3 * std::cos(3 * x.x())}};
}

TEST(Sweep, MakesTheSameStepOfAPointWhateverElseIsAdvanced) {
  // Runs begin and end at all places of a block and beside the ends of strips; points beside them keep what they have.
  for (const bool bent : {false, true}) {
    Block whole(long_grid(bent));
    const Field all = whole.step<Limiter::minmod>(wavy, 0.004);
    for (int k = 0; k < 24; ++k) {
      const grid::Interval columns = {331 + k, 333 + 2 * k + k * k};
      Block some(long_grid(bent), columns);
      const Field next = some.step<Limiter::minmod>(wavy, 0.004);
      int wrong = 0;
      for (int p = 0; p < plane::count; ++p) {
        for (int j = 0; j < 5; ++j) {
          for (int i = -2; i < 1015; ++i) {
            const bool advanced = i >= columns.begin && i < columns.end;
            if (next(p, i, j) != (advanced ? all(p, i, j) : 0.0)) ++wrong;
          }
        }
      }
      EXPECT_EQ(wrong, 0) << columns.begin << " to " << columns.end << (bent ? ", bent" : "");
    }
  }
}

TEST(Sweep, CountsAGhostPointThatSettlesOnceWhereStripsMeet) {
  // Beyond the bottom, and there alone, the displacement turns the material inside out.
  const auto folded = [](const Vec2& x) {
    return SolidState{.u = {0, x.y() < -1e-9 ? -1.5 * x.y() : 0.0}, .v = Vec2::Zero(), .P = {}};
  };
  Block block(long_grid(false));
  block.step<Limiter::minmod>(folded, 0.004);
  EXPECT_EQ(block.result.settled, 1013);
  EXPECT_EQ(block.result.broken, 0);
}

TEST(Eq39Eq40Eq41Sweep, TermsAddedWhileAStepIsMadeAreThoseAddedAfterwards) {
  constexpr DissipationBetas betas{.P = 0.3, .u = 0.4, .r = 0.6};
  const auto compare = [&]<class Row, class Gradient>(Block& block) {
    const auto terms = [&](int j, ConstFieldView q) {
      return AllDissipation(q, Row(block.metrics(), j), Gradient(block.grid().x(), block.metrics(), j), law,
                            betas, j);
    };
    const Field at_once = block.step_with<Limiter::minmod>(
        wavy, 0.01, Vec2::Zero(), Look::all, [&](const auto& sweep, ConstFieldView q, FieldView) {
          return sweep.run([&](int j) { return terms(j, q); }, [](RowRun) {});
        });
    const Field one_by_one = block.step_with<Limiter::minmod>(
        wavy, 0.01, Vec2::Zero(), Look::all, [&](const auto& sweep, ConstFieldView q, FieldView next) {
          return sweep.run([](int) { return NoTerms(); },
                           [&](RowRun run) {
                             add_tangential_stress_dissipation<Row>(q, next, block.metrics(), betas.P, run);
                             const Gradient gradient(block.grid().x(), block.metrics(), run.j);
                             add_displacement_dissipation(q, next, gradient, betas.u, run);
                             add_relaxation(q, next, gradient, law, betas.r, run);
                           });
        });
    const Field none = block.step<Limiter::minmod>(wavy, 0.01);
    double difference = 0, size = 0;
    for (std::size_t k = 0; k < none.values().size(); ++k) {
      difference = std::max(difference, std::abs(at_once.values()[k] - one_by_one.values()[k]));
      size = std::max(size, std::abs(at_once.values()[k] - none.values()[k]));
    }
    EXPECT_LT(difference, 1e-14);
    EXPECT_GT(size, 1e-3);
  };
  Block square(test::unit_square(cells)), skewed(test::skewed_grid(cells));
  compare.operator()<CartesianRow, CartesianGradient4>(square);
  compare.operator()<MappedRow, MappedGradient4>(skewed);
}

TEST(Sweep, NoticesWhatIsInsideOutWithoutLookingAtTheWaves) {
  Block block(test::skewed_grid(cells));
  const auto strained = [](double factor) {
    return [factor](const Vec2& x) {
      return SolidState{.u = {(factor - 1) * x.x(), 0}, .v = Vec2::Zero(), .P = {}};
    };
  };
  for (const Look look : {Look::soundness, Look::all}) {
    block.step<Limiter::none>(strained(0.5), 0.01, Vec2::Zero(), look);
    EXPECT_EQ(block.result.broken, 0);
    EXPECT_NEAR(block.result.min_det_F, 0.5, 1e-12);
    block.step<Limiter::none>(strained(-0.5), 0.01, Vec2::Zero(), look);
    EXPECT_GT(block.result.broken, 0);
  }
}

}  // namespace
}  // namespace fsi::solid
