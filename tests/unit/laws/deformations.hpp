#pragma once
/// Deformation gradients, differences and index notation for the tests of the laws.

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <variant>
#include <vector>

#include "common/core/types.hpp"
#include "solid_solver/laws/every_law.hpp"

namespace fsi::solid::testing {

/// All laws for typed tests.
template <class Variant>
struct TypesOf;
template <class... Types>
struct TypesOf<std::variant<Types...>> {
  using type = ::testing::Types<Types...>;
};
using EveryLawTested = TypesOf<solid::EveryLaw>::type;

inline Tensor2 plain(const Mat2& A) {
  return {A(0, 0), A(0, 1), A(1, 0), A(1, 1)};
}

inline Mat2 matrix(const Tensor2& A) {
  return (Mat2() << A.a11, A.a12, A.a21, A.a22).finished();
}

inline Mat2 rotation(double angle) {
  return (Mat2() << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle)).finished();
}

/// From the rest state to large stretch, shear and turn; all with det F > 0.
inline std::vector<Mat2> deformations() {
  const Mat2 stretch = (Mat2() << 1.3, 0.1, 0.1, 0.8).finished();
  const Mat2 shear = (Mat2() << 1.0, 0.7, 0.0, 1.0).finished();
  const Mat2 squeeze = (Mat2() << 0.7, -0.2, 0.1, 0.9).finished();
  const Mat2 general = (Mat2() << 0.9, 0.4, -0.3, 1.2).finished();
  return {Mat2::Identity(),        stretch, shear, squeeze, general, rotation(2.0) * stretch,
          rotation(-1.1) * general};
}

/// The law with these moduli, and with typical values of what only it takes.
template <class L>
L typical(double lambda, double mu) {
  L law{.lambda = lambda, .mu = mu};
  if constexpr (requires { L::own_numbers; }) {
    for (const auto& own : L::own_numbers) law.*own.member = own.typical;
  }
  return law;
}

/// K_ijkl (indices 0 or 1) out of the ten stored entries and the six that K_ijkl = K_lkji gives.
inline double entry(const Stiffness& K, int i, int j, int k, int l) {
  const double all[16] = {K.k1111, K.k1112, K.k1121, K.k1122, K.k1121, K.k2121, K.k1221, K.k1222,
                          K.k1112, K.k2112, K.k2121, K.k2122, K.k1122, K.k2122, K.k1222, K.k2222};
  return all[8 * i + 4 * j + 2 * k + l];
}

/// Central difference of `f` (a function of F) along component (k, l).
template <class Function>
auto difference(const Function& f, const Mat2& F, int k, int l, double h) {
  Mat2 ahead = F;
  Mat2 behind = F;
  ahead(k, l) += h;
  behind(k, l) -= h;
  using Value = decltype(f(F));
  return Value((f(ahead) - f(behind)) / (2 * h));
}

/// Step of the differences: truncation ~ h^2 and rounding ~ 1e-16 / h both stay near 1e-10.
inline constexpr double step = 1e-5;
/// Bound on the error of those differences, with moduli of order one and the deformations above.
inline constexpr double difference_error = 2e-8;

}  // namespace fsi::solid::testing
