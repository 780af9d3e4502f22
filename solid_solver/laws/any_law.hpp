#pragma once
/// A law whose type is not known when compiling: for what asks it now and then, and not at every point of a step.

#include <functional>

#include "solid_solver/laws/law.hpp"

namespace fsi::solid {

struct AnyLaw {
  double lambda = 0, mu = 0;  ///< [pressure]
  std::function<Tensor2(const Tensor2& F)> P;
  std::function<Stiffness(const Tensor2& F)> K;

  template <Law L>
  AnyLaw(const L& law)  // NOLINT(google-explicit-constructor): every law is one
      : lambda(law.lambda),
        mu(law.mu),
        P([law](const Tensor2& F) { return law.P(F); }),
        K([law](const Tensor2& F) { return law.K(F); }) {}
};

}  // namespace fsi::solid
