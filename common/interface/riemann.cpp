#include "common/interface/riemann.hpp"

#include <fmt/format.h>

#include "common/core/failure.hpp"

namespace fsi {

Projection projection_named(const std::string& name) {
  if (name == "full") return Projection::full;
  if (name == "simplified") return Projection::simplified;
  if (name == "traditional") return Projection::traditional;
  throw UserMistake(fmt::format(
      "interface.projection: there is no projection \"{}\"; write full, simplified or traditional", name));
}

}  // namespace fsi
