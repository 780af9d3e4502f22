#include "common/program/reference_from_case.hpp"

#include <utility>

#include "common/core/failure.hpp"

namespace fsi {

namespace {

/// A gas given by the formulas of the case file.
class Formulas final : public exact::Solution {
 public:
  explicit Formulas(GasExpressions gas) : gas_(std::move(gas)) {}

  exact::GasState gas(double x, double y, double t) const override {
    return {.rho = gas_.rho(x, y, t), .v1 = gas_.v1(x, y, t), .v2 = gas_.v2(x, y, t), .p = gas_.p(x, y, t)};
  }
  exact::SolidState solid(double, double, double) const override {
    throw UserMistake(
        "the formulas of the reference describe a gas only; write kind: manufactured and u for a solid");
  }

 private:
  GasExpressions gas_;
};

}  // namespace

std::shared_ptr<const exact::Solution> reference_from_case(const Case& problem, const std::string& run_dir) {
  const ReferenceSpec& spec = problem.reference;
  if (spec.kind == ReferenceKind::none) return nullptr;
  if (spec.in_formulas()) {
    if (!spec.fluid) return nullptr;
    return std::make_shared<Formulas>(*spec.fluid);
  }
  return exact::make_solution(spec.kind, spec.numbers, run_dir);
}

}  // namespace fsi
