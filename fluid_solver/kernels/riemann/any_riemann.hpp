#pragma once
/// The Riemann solvers a case can choose. One more is one file and one name here (and in `Riemann`).

#include <variant>

#include "fluid_solver/kernels/riemann/riemann_hllc.hpp"
#include "fluid_solver/kernels/riemann/riemann_roe.hpp"

namespace fsi::fluid {

using AnyRiemann = std::variant<RiemannRoe, RiemannHllc>;

}  // namespace fsi::fluid
