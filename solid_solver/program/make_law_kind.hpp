#pragma once
/// The kind of a law from its type: where its solver is compiled (law_solver.cpp.in).

#include <memory>
#include <utility>

#include "solid_solver/program/law_kind.hpp"
#include "solid_solver/solid_solver.hpp"

namespace fsi::solid {

template <Law L>
LawKind law_kind() {
  static constexpr auto law_of = [](const LawNumbers& numbers) {
    return law_with<L>(numbers.lambda, numbers.mu, numbers.own);
  };
  return {.name = L::name,
          .softens = Softens<L>,
          .law = [](const LawNumbers& numbers) { return AnyLaw(law_of(numbers)); },
          .solver = [](std::vector<SolidPart> parts, std::vector<grid::BodyFittedGrid> bodies,
                       const LawNumbers& numbers,
                       const SolidOptions& options) -> std::unique_ptr<AnySolidSolver> {
            return std::make_unique<SolidSolver<L>>(std::move(parts), std::move(bodies), law_of(numbers),
                                                    options, 0);
          }};
}

}  // namespace fsi::solid
