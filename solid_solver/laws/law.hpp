#pragma once
/// What a constitutive law is to the solid solver: three pure
/// functions of the deformation gradient F (plane strain).

#include <concepts>
#include <map>
#include <optional>
#include <string>
#include <string_view>

namespace fsi::solid {

/// 2 x 2 tensor as plain numbers, so that loops over points vectorise. a12 is row 1, column 2.
struct Tensor2 {
  double a11 = 0, a12 = 0, a21 = 0, a22 = 0;  ///< [unit of the tensor]
};

/// paper eq. (5): K_ijkl = dP_ij/dF_kl, as the ten entries that K_ijkl = K_lkji leaves (misprinted after eq.
/// (8)). k1122 is i = 1, j = 1, k = 2, l = 2. The other six: K1211 = K1121, K1212 = K2121, K2111 = K1112,
/// K2211 = K1122, K2212 = K2122, K2221 = K1222.
struct Stiffness {
  double k1111 = 0, k1112 = 0, k1121 = 0, k1122 = 0, k1221 = 0, k1222 = 0, k2112 = 0, k2121 = 0, k2122 = 0,
         k2222 = 0;
};

/// A number that one law takes besides lambda and mu. A law L lists those it has in `L::own_numbers`.
template <class L>
struct OwnNumber {
  std::string_view key;      ///< of the solid in a case file
  std::string_view meaning;  ///< for the documentation of the case file, and where it is missing
  std::string_view unit;     ///< pressure, ..; "-" of a pure number
  double L::*member;
  double typical;  ///< for the tests that run over all laws [that of `unit`]
};

/// What a law says of numbers with which its energy has no lower bound, of the first one that is at fault: `what` and the
/// bound on it, if there is one, and `why`.
struct BrokenBound {
  std::string_view key;  ///< of the number in a case file
  std::string_view what;
  std::optional<double> bound = {};  ///< [that of the number]
  std::string_view why = {};
};

/// A law whose numbers have bounds: checked where a case is read.
template <class L>
concept HasBounds = requires(const L law) {
  { law.broken_bound() } -> std::same_as<std::optional<BrokenBound>>;
};

/// A constitutive law: strain energy psi per unit reference volume, nominal stress P_ij = dpsi/dF_ji,
/// stiffness K. Each is a pure, branch-free function of F that a compiler can vectorise; `L{lambda, mu}`
/// makes one, whose own numbers, if there are any, are then to be set.
template <class L>
concept Law = requires(const L law, const Tensor2 F) {
  { L::name } -> std::convertible_to<std::string_view>;
  { L::objective } -> std::convertible_to<bool>;  ///< a rigid rotation makes no stress
  { law.psi(F) } -> std::same_as<double>;
  { law.P(F) } -> std::same_as<Tensor2>;
  { law.K(F) } -> std::same_as<Stiffness>;
  { law.lambda } -> std::convertible_to<double>;
  { law.mu } -> std::convertible_to<double>;
};

/// A law that carries no waves beyond some strain: `where_soft` says where, and which other law does.
template <class L>
concept Softens = requires {
  { L::where_soft } -> std::convertible_to<std::string_view>;
};

/// The law with the Lame constants and with its own numbers by their keys. Whether they are there and in
/// their range is checked where a case is read (common/case/read/build_material.hpp).
template <Law L>
L law_with(double lambda, double mu, const std::map<std::string, double>& numbers) {
  L law{.lambda = lambda, .mu = mu};
  if constexpr (requires { L::own_numbers; }) {
    for (const OwnNumber<L>& own : L::own_numbers)
      law.*own.member = numbers.find(std::string(own.key))->second;
  }
  return law;
}

}  // namespace fsi::solid
