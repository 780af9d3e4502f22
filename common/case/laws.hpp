#pragma once
/// The constitutive laws a case may ask for: each has an executable solid_solver_<law>.

#include <array>
#include <string_view>

namespace fsi {

inline constexpr std::array<std::string_view, 3> law_names{"linear_elastic", "saint_venant_kirchhoff",
                                                           "neo_hookean"};

}  // namespace fsi
