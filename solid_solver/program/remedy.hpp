#pragma once
/// What to change in a case whose solid has broken, by its scheme and its material.

#include <fmt/format.h>

#include <string>
#include <utility>

#include "common/case/case.hpp"

namespace fsi::solid {

/// @param stiffness lambda / mu. Of nearly incompressible solids, Poisson's ratios beyond 0.45, (41) is taken out and never
///                  put in: what it does to the traction of loaded sides is in proportion to lambda (docs/theory_solid.md)
/// @param softens   the law carries no waves beyond some strain, and another one does
inline std::string remedy_for(const std::string& solid, const SolidScheme& scheme, double stiffness,
                              bool softens) {
  const std::string path = "solids." + solid + ".scheme";
  const bool nearly_incompressible = stiffness > 10;
  const auto is_zero = [](const fsi::Beta& beta) { return beta.rate == 0 && beta.scaled == 0; };
  if (scheme.limiter == SolidLimiter::none) return path + ".limiter: minmod, for jumps";
  for (const auto& [key, beta] :
       {std::pair{"tangential_stress", &scheme.tangential_stress},
        std::pair{"displacement", &scheme.displacement}, std::pair{"relaxation", &scheme.relaxation}}) {
    if (is_zero(*beta) && !(nearly_incompressible && beta == &scheme.relaxation))
      return fmt::format("{} without `{}`, whose default damps what no wave carries", path, key);
  }
  if (softens) return fmt::format("--solid {}=neo_hookean, unless the strains are small", solid);
  if (nearly_incompressible && !is_zero(scheme.relaxation))
    return fmt::format("{}.relaxation: {{scaled: 0}}, for lambda is {:.3g} mu", path, stiffness);
  if (!nearly_incompressible && scheme.relaxation.scaled < 0.5) return path + ".relaxation: {scaled: 0.5}";
  return "a smaller time.cfl";
}

}  // namespace fsi::solid
