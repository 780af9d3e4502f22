#pragma once
/// What the one-dimensional references share: the laws, values
/// at masses from springs, differences of two runs.

#include <map>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "common/exact/table.hpp"
#include "solid_solver/laws/gent.hpp"
#include "solid_solver/laws/linear_elastic.hpp"
#include "solid_solver/laws/mooney_rivlin.hpp"
#include "solid_solver/laws/neo_hookean.hpp"
#include "solid_solver/laws/saint_venant_kirchhoff.hpp"

namespace fsi::reference {

using AnyLaw = std::variant<solid::LinearElastic, solid::SaintVenantKirchhoff, solid::NeoHookean,
                            solid::MooneyRivlin, solid::Gent>;

/// The law of that name; `own`: its numbers besides lambda and mu. @throws UserMistake for an unknown one
AnyLaw law_named(const std::string& name, double lambda, double mu,
                 const std::map<std::string, double>& own = {});

/// What the springs do before the first one.
enum class Start { end, mirror };

/// Values at the n + 1 ends of n >= 4 equal springs from those in their middles: cubic inside, quadratic at
/// the ends. `mirror`: the values are even about the first end.
std::vector<double> at_masses(std::span<const double> middle, Start start = Start::end);

/// `times`, t = 0 and t = `end`, increasing and each once.
std::vector<double> output_times(std::vector<double> times, double end);

/// Largest difference of the values `a` at the places `x` from a column of a finer run's table, read only
/// where the table reaches.
double largest_difference(std::span<const double> a, std::span<const double> x,
                          const exact::CubicTable& table, std::size_t column);

}  // namespace fsi::reference
