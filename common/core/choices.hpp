#pragma once
/// What a case chooses from: enumerations, each with the one table of its names that the schema, its
/// documentation, the reader, the programs and their messages share. A new value is one line in its
/// enumeration and one in its table; a `switch` that does not know it yet does not compile (-Wswitch).

#include <array>
#include <cstddef>
#include <optional>
#include <string_view>

#include "common/core/riemann_solvers.hpp"

namespace fsi {

/// Limiter of the slopes in the gas; none: centred slopes.
enum class GasLimiter { none, minmod, mc, van_leer };
/// The quantity whose bends are followed by a refined background.
enum class RefinedQuantity { rho, p };
/// Limiter of the slopes in a solid.
enum class SolidLimiter { none, minmod, mc };

/// How the states of the two sides of an interface are combined.
enum class Projection {
  full,        ///< with the solid's impedance matrix and its tangential traction, paper eq. (28)
  simplified,  ///< with the scalar impedance z_p of the solid at rest, paper eq. (29)
  traditional  ///< the solid gives the velocity, the gas the traction; unstable for light solids
};

/// The gas's side of that.
enum class GasResponse {
  exact,  ///< its whole wave curve, shock or rarefaction
  linear  ///< the tangent of that curve, as in (28)
};

/// The configuration whose area and normal the load of a side belongs to.
enum class LoadConfiguration {
  current,    ///< the deformed body: eta of paper eq. (13), a pressure along the present normal
  reference,  ///< the undeformed body: eta = 1, a pressure along n0, as in small-strain theory. Differs from
              ///< the paper: with the linear law, ripples of an interface that follows its load grow without
              ///< bound, the shorter the faster, once the load is a few shear moduli (docs/theory_solid.md)
};

/// The solution that a case is compared with, and that may give it data.
enum class ReferenceKind {
  none,
  elastic_piston,
  wall_between_gases,
  clamped_wall,
  riemann,
  piston_1d,      ///< a fine one-dimensional run
  rotating_disk,  ///< a fine run in the radius alone
  expressions,
  manufactured  ///< formulas that forces and sources make exact
};

/// What holds an end of a beam.
enum class BeamEnd {
  free,
  pinned,   ///< its place is held
  clamped,  ///< its place and its direction are held
  guided,   ///< its direction is held, and it moves across the line only
};

/// A value and how it is written.
template <class E>
struct Named {
  E value;
  std::string_view name;
};

/// The table of an enumeration.
template <class E>
inline constexpr std::array<Named<E>, 0> names_of{};

template <>
inline constexpr auto names_of<RiemannSolver> = [] {
  std::array<Named<RiemannSolver>, riemann_solver_names.size()> table{};
  for (std::size_t k = 0; k < table.size(); ++k)
    table[k] = {static_cast<RiemannSolver>(k), riemann_solver_names[k]};
  return table;
}();
template <>
inline constexpr std::array names_of<GasLimiter>{
    Named<GasLimiter>{GasLimiter::none, "none"},
    Named<GasLimiter>{GasLimiter::minmod, "minmod"},
    Named<GasLimiter>{GasLimiter::mc, "mc"},
    Named<GasLimiter>{GasLimiter::van_leer, "van_leer"},
};
template <>
inline constexpr std::array names_of<RefinedQuantity>{
    Named<RefinedQuantity>{RefinedQuantity::rho, "rho"},
    Named<RefinedQuantity>{RefinedQuantity::p, "p"},
};
template <>
inline constexpr std::array names_of<SolidLimiter>{
    Named<SolidLimiter>{SolidLimiter::none, "none"},
    Named<SolidLimiter>{SolidLimiter::minmod, "minmod"},
    Named<SolidLimiter>{SolidLimiter::mc, "mc"},
};
template <>
inline constexpr std::array names_of<Projection>{
    Named<Projection>{Projection::full, "full"},
    Named<Projection>{Projection::simplified, "simplified"},
    Named<Projection>{Projection::traditional, "traditional"},
};
template <>
inline constexpr std::array names_of<GasResponse>{
    Named<GasResponse>{GasResponse::exact, "exact"},
    Named<GasResponse>{GasResponse::linear, "linear"},
};
template <>
inline constexpr std::array names_of<LoadConfiguration>{
    Named<LoadConfiguration>{LoadConfiguration::current, "current"},
    Named<LoadConfiguration>{LoadConfiguration::reference, "reference"},
};
template <>
inline constexpr std::array names_of<ReferenceKind>{
    Named<ReferenceKind>{ReferenceKind::none, "none"},
    Named<ReferenceKind>{ReferenceKind::elastic_piston, "elastic_piston"},
    Named<ReferenceKind>{ReferenceKind::wall_between_gases, "wall_between_gases"},
    Named<ReferenceKind>{ReferenceKind::clamped_wall, "clamped_wall"},
    Named<ReferenceKind>{ReferenceKind::riemann, "riemann"},
    Named<ReferenceKind>{ReferenceKind::piston_1d, "piston_1d"},
    Named<ReferenceKind>{ReferenceKind::rotating_disk, "rotating_disk"},
    Named<ReferenceKind>{ReferenceKind::expressions, "expressions"},
    Named<ReferenceKind>{ReferenceKind::manufactured, "manufactured"},
};
template <>
inline constexpr std::array names_of<BeamEnd>{
    Named<BeamEnd>{BeamEnd::free, "free"},
    Named<BeamEnd>{BeamEnd::pinned, "pinned"},
    Named<BeamEnd>{BeamEnd::clamped, "clamped"},
    Named<BeamEnd>{BeamEnd::guided, "guided"},
};

/// An enumeration with such a table.
template <class E>
concept Choice = !names_of<E>.empty();

/// All names, for a schema.
template <Choice E>
inline constexpr auto words_of = [] {
  std::array<std::string_view, names_of<E>.size()> words;
  for (std::size_t k = 0; k < words.size(); ++k) words[k] = names_of<E>[k].name;
  return words;
}();

template <Choice E>
constexpr std::string_view name_of(E value) {
  for (const Named<E>& named : names_of<E>)
    if (named.value == value) return named.name;
  return {};
}

/// The value of a name; none where there is no such name.
template <Choice E>
constexpr std::optional<E> named(std::string_view name) {
  for (const Named<E>& one : names_of<E>)
    if (one.name == name) return one.value;
  return std::nullopt;
}

}  // namespace fsi
