#pragma once
/// What to change in a case whose solid has broken, by its scheme, its material and how it came to it.

#include <fmt/format.h>

#include <cstdint>
#include <string>
#include <utility>

#include "common/case/case.hpp"
#include "common/case/report/remarks.hpp"
#include "common/core/archive.hpp"

namespace fsi::solid {

/// How long a solid has been pressed together until it broke. Noise does that within a few steps, a load takes many.
class Squeeze {
 public:
  static constexpr double strong = 0.4;  ///< det F [-], below which no scheme keeps a body from folding
  static constexpr std::uint64_t lasting = 20;  ///< [steps]

  /// @param det_F the least of a step
  void add(double det_F) {
    steps_ = det_F < strong ? steps_ + 1 : 0;
    if (steps_ > 0) det_F_ = det_F;
  }
  /// The last det F of a solid that its load breaks; 1 for any other.
  double by_load() const { return steps_ >= lasting ? det_F_ : 1; }
  void archive(Archive& archive) {
    archive.number("steps", steps_);
    archive.number("det_F", det_F_);
  }

 private:
  std::uint64_t steps_ = 0;
  double det_F_ = 1;
};

/// @param squeezed  Squeeze::by_load
/// @param stiffness lambda / mu. Of nearly incompressible solids, Poisson's ratios beyond 0.45, (41) is taken out and never
///                  put in: what it does to the traction of loaded sides is in proportion to lambda (docs/theory_solid.md)
/// @param softens   the law carries no waves beyond some strain, and another one does
/// @param pressed   pressure_over_stiffness
/// @param stopped   stagnation_over_stiffness
inline std::string remedy_for(const std::string& solid, const SolidScheme& scheme, double stiffness,
                              bool softens, double squeezed = 1, double pressed = 0, double stopped = 0) {
  if (pressed > crushing)
    return fmt::format(
        "a stiffer solids.{} or a weaker load: the pressure of the gas differs from p_e by up to "
        "{:.3g} times its lambda + 2 mu",
        solid, pressed);
  if (squeezed < 1)
    return fmt::format(
        "a stiffer solids.{} or a weaker load: pressure had squeezed it to {:.2g} of its volume "
        "there before; sharp corners of clamped sides, and free sides that are pressed along themselves by a "
        "third, where they crease, get there the sooner the finer the grid is",
        solid, squeezed);
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
  if (stopped > heavy)
    return fmt::format(
        "a stiffer solids.{} or a weaker load: where it brings the gas to rest, that presses it with about "
        "{:.2g} "
        "times its lambda + 2 mu",
        solid, stopped);
  if (nearly_incompressible && !is_zero(scheme.relaxation))
    return fmt::format("{}.relaxation: {{scaled: 0}}, for lambda is {:.3g} mu", path, stiffness);
  if (!nearly_incompressible && scheme.relaxation.scaled < 0.5) return path + ".relaxation: {scaled: 0.5}";
  if (scheme.limiter != SolidLimiter::minmod) return path + ".limiter: minmod";
  return "a smaller time.cfl";
}

}  // namespace fsi::solid
