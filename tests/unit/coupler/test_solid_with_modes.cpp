/// Exchanges with a solid that has degrees of freedom.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "common/core/failure.hpp"
#include "coupler/coupler.hpp"
#include "exchanges.hpp"
#include "messages.hpp"

namespace fsi::coupler {
namespace {

using namespace testing;

/// A solid of k modes; 0: a deformable one.
wire::PredictedInterface solid_of_modes(std::size_t modes, std::uint64_t step) {
  auto solid = solid_state(n, step);
  if (modes == 0) return solid;
  solid.w.clear();
  solid.Z.clear();
  solid.modal = {.modes = static_cast<std::int32_t>(modes),
                 .S = {},
                 .g = std::vector<double>(modes),
                 .N = {},
                 .q_dot = std::vector<double>(modes)};
  for (std::size_t m = 0; m < modes; ++m) {
    for (wire::SparseMatrix* matrix : {&solid.modal.S, &solid.modal.N}) {
      matrix->row.push_back(static_cast<std::int32_t>(m));
      matrix->column.push_back(static_cast<std::int32_t>(m));
      matrix->value.push_back(1);
    }
  }
  return solid;
}

TEST(Coupler, ABodyWithModesIsRefusedByTheTraditionalScheme) {
  for (const Projection how : {Projection::full, Projection::simplified, Projection::traditional}) {
    CouplerOptions options = until(1);
    options.combination.projection = how;
    Coupler coupler(options, piston_hellos(n));
    const std::vector first{gas_state(n, 0), solid_of_modes(1, 0)};
    if (how != Projection::traditional) {
      EXPECT_NO_THROW(coupler.step(first));
      continue;
    }
    try {
      coupler.step(first);
      FAIL() << "the modal form has the added mass in itself";
    } catch (const UserMistake& mistake) {
      const std::string words = mistake.what();
      EXPECT_NE(words.find("interface.projection"), std::string::npos) << words;
      EXPECT_NE(words.find("\"solid\""), std::string::npos) << words;
    }
  }
}

TEST(Coupler, AModalResponseThatIsNoMatrixOfItsSizeIsNamed) {
  auto solid = solid_of_modes(2, 0);
  solid.modal.N.column.back() = static_cast<std::int32_t>(n);
  EXPECT_NE(failure<PeerLost>(gas_state(n, 0), solid).find("the mode vectors"), std::string::npos);
  solid = solid_of_modes(2, 0);
  solid.modal.S.row.pop_back();
  EXPECT_NE(failure<PeerLost>(gas_state(n, 0), solid).find("the modal response S"), std::string::npos);
  solid = solid_of_modes(2, 0);
  solid.modal.S.value.back() = std::nan("");
  EXPECT_NE(failure<Diverged>(gas_state(n, 0), solid).find("the modal response S is nan"), std::string::npos);
}

TEST(Coupler, ABodyWhoseVelocitiesAreNotThoseOfItsModesIsNamed) {
  const auto body = [](double v, double N, double q_dot) {
    auto solid = solid_of_modes(1, 0);
    solid.v = everywhere(n, v, 0.2);
    solid.modal = one_mode(1, 0, std::vector<double>(n, N), q_dot);
    return solid;
  };
  Coupler(until(1), piston_hellos(n)).step(std::vector{gas_state(n, 0), body(0.5, 0.25, 2)});
  for (const auto& [N, q_dot] : {std::pair{0.25, 0.5}, {-1.0, 0.5}, {1.0, 1.5}}) {
    const std::string told = failure<PeerLost>(gas_state(n, 0), body(0.5, N, q_dot));
    EXPECT_NE(told.find("with n.v = 0.5, but its modes with N q_dot = "), std::string::npos) << N << told;
  }
}

TEST(Coupler, ABodyThatGivesWayToItsOwnMotionIsNamed) {
  auto solid = solid_of_modes(2, 0);
  solid.modal.S.value.back() = -1;
  EXPECT_NE(failure<PeerLost>(gas_state(n, 0), solid).find("S(1, 1) = -1"), std::string::npos);
}

TEST(Coupler, ASolidThatBeginsElsewhereThanItsHelloIsNamed) {
  auto solid = solid_of_modes(1, 0);
  solid.x = vertical_line(n, 0.4 / (n - 1));
  Coupler(until(1), piston_hellos(n)).step(std::vector{gas_state(n, 0), solid});
  solid.x = vertical_line(n, 0.6 / (n - 1));
  EXPECT_NE(failure<PeerLost>(gas_state(n, 0), solid).find("but its hello has it at (0, "),
            std::string::npos);
  std::reverse(solid.x.begin() + n, solid.x.end());
  EXPECT_NE(failure<PeerLost>(gas_state(n, 0), solid).find("in the same order"), std::string::npos);
}

TEST(Coupler, ImpedancesOfDifferentSolidsAreNamed) {
  auto solid = solid_state(n, 0);  // Z11 = 2, normals along x
  for (const double z_p : {0.6, 7.0}) {
    solid.z_p = z_p;
    Coupler(until(1), piston_hellos(n)).step(std::vector{gas_state(n, 0), solid});
  }
  for (const double z_p : {0.4, 9.0}) {
    solid.z_p = z_p;
    EXPECT_NE(failure<PeerLost>(gas_state(n, 0), solid).find("but n.Z.n from 2 to 2"), std::string::npos)
        << z_p;
  }
}

TEST(Coupler, AModeThatNothingResistsIsNamed) {
  constexpr std::size_t modes = 20;  // many: a sparse factorisation, which cannot leave a mode out
  Coupler coupler(until(1), piston_hellos(n));
  auto solid = solid_of_modes(n, 0);
  solid.modal.modes = modes;
  solid.modal.g.assign(modes, 0);
  solid.modal.q_dot.assign(modes, 0);
  coupler.step(std::vector{gas_state(n, 0), solid});
  solid.step = 1;
  try {
    coupler.step(std::vector{gas_state(n, 1), solid});
    FAIL() << "modes without mass that do not meet the gas";
  } catch (const Diverged& broken) {
    EXPECT_NE(std::string(broken.what()).find("nothing resists one of its 20 modes"), std::string::npos)
        << broken.what();
  }
}

TEST(Coupler, ASolidIsToldTheVelocitiesOfItsModesAndTheGasIsNot) {
  Coupler coupler(until(1), piston_hellos(n));
  coupler.step(std::vector{gas_state(n, 0), solid_of_modes(2, 0)});
  auto gas = gas_state(n, 1);
  gas.p[1] = 3;
  const auto answers = coupler.step(std::vector{gas, solid_of_modes(2, 1)});
  EXPECT_TRUE(answers[0].q_dot.empty());
  ASSERT_EQ(answers[1].q_dot.size(), 2U);
  for (std::size_t k = 0; k < 2; ++k) EXPECT_EQ(answers[1].q_dot[k], answers[1].v_n[k]);
  EXPECT_LT(answers[1].q_dot[1], 0);
}

TEST(Coupler, ASolidThatChangesTheNumberOfItsModesIsNamed) {
  for (const auto& [first, then] : {std::pair{1U, 2U}, {2U, 1U}, {1U, 0U}, {0U, 1U}}) {
    Coupler coupler(until(1), piston_hellos(n));
    coupler.step(std::vector{gas_state(n, 0), solid_of_modes(first, 0)});
    coupler.step(std::vector{gas_state(n, 1), solid_of_modes(first, 1)});
    try {
      coupler.step(std::vector{gas_state(n, 2), solid_of_modes(then, 2)});
      FAIL() << first << " modes, then " << then;
    } catch (const PeerLost& lost) {
      const std::string words = lost.what();
      EXPECT_NE(words.find("\"solid\" sent modal.modes = " + std::to_string(then)), std::string::npos)
          << words;
      EXPECT_NE(words.find(std::to_string(first) + " before"), std::string::npos) << words;
    }
  }
}

}  // namespace
}  // namespace fsi::coupler
