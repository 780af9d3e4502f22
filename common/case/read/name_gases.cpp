#include "common/case/read/name_gases.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

namespace fsi {

void name_gases(Case& problem, const config::Node& root) {
  for (SolidSpec& solid : problem.solids) {
    std::vector<std::string> gases;
    for (const FluidSpec& fluid : problem.fluids) {
      if (meets(fluid, solid.name)) gases.push_back(fluid.name);
    }
    if (gases.size() > 1 && !solid.body_fitted.empty()) {
      const config::Node& shape = *root.find("solids")->find(solid.name)->find("shape");
      config::fail(
          shape.place, fmt::format("solids.{}.shape", solid.name),
          fmt::format("the gases {} have a grid along it; an outline meets one gas: leave it to the one in "
                      "which it lies, or, for a solid between gases, write in the place of `shape` a `grid` "
                      "with an interface side for each of them",
                      fmt::join(gases, " and ")));
    }
    const auto complete = [&](std::array<BoundarySpec, 4>& boundary) {
      for (BoundarySpec& spec : boundary) {
        if (spec.kind != BoundaryKind::interface || !spec.fluid.empty() || gases.empty()) continue;
        if (gases.size() > 1) {
          config::fail(
              root.find("solids")->find(solid.name)->place, fmt::format("solids.{}", solid.name),
              fmt::format("the gases {} meet it; write {{kind: interface, fluid: NAME}} at each of its "
                          "interfaces",
                          fmt::join(gases, " and ")));
        }
        spec.fluid = gases.front();
      }
    };
    complete(solid.boundary);
    for (BodyFittedSpec& fitted : solid.body_fitted) complete(fitted.boundary);
  }
}

}  // namespace fsi
