#include "common/exact/solution.hpp"

#include <fmt/format.h>

#include <stdexcept>
#include <utility>

#include "common/core/failure.hpp"
#include "common/exact/disk_table.hpp"
#include "common/exact/elastic_piston.hpp"
#include "common/exact/riemann.hpp"
#include "common/exact/table.hpp"
#include "common/exact/wall_between_gases.hpp"

namespace fsi::exact {

namespace {

/// Named numbers of a case's `reference` section; each must be asked for.
class Numbers {
 public:
  Numbers(ReferenceKind kind, std::map<std::string, double> numbers)
      : kind_(name_of(kind)), left_(std::move(numbers)) {}

  double take(const std::string& name, double otherwise) {
    names_ += (names_.empty() ? "" : ", ") + name;
    const auto found = left_.find(name);
    if (found == left_.end()) return otherwise;
    const double value = found->second;
    left_.erase(found);
    return value;
  }
  void expect_none_left() const {
    if (left_.empty()) return;
    throw UserMistake(
        fmt::format("reference: '{}' knows no number '{}'; it has {}", kind_, left_.begin()->first, names_));
  }

 private:
  std::string kind_, names_;
  std::map<std::string, double> left_;
};

std::unique_ptr<Solution> make_elastic_piston(Numbers numbers) {
  ElasticPistonData data;
  data.density_ratio = numbers.take("density_ratio", data.density_ratio);
  data.c_p = numbers.take("c_p", data.c_p);
  data.amplitude = numbers.take("amplitude", data.amplitude);
  data.rotation = numbers.take("rotation", data.rotation);
  data.gamma = numbers.take("gamma", data.gamma);
  data.rho_0 = numbers.take("rho_0", data.rho_0);
  data.a_0 = numbers.take("a_0", data.a_0);
  numbers.expect_none_left();
  return std::make_unique<ElasticPiston>(data);
}

std::unique_ptr<Solution> make_riemann_tube(Numbers numbers) {
  const TubeState sod_left{.rho = 1, .v = 0, .p = 1};
  const TubeState sod_right{.rho = 0.125, .v = 0, .p = 0.1};
  const TubeState left{.rho = numbers.take("rho_left", sod_left.rho),
                       .v = numbers.take("v_left", sod_left.v),
                       .p = numbers.take("p_left", sod_left.p)};
  const TubeState right{.rho = numbers.take("rho_right", sod_right.rho),
                        .v = numbers.take("v_right", sod_right.v),
                        .p = numbers.take("p_right", sod_right.p)};
  const double gamma = numbers.take("gamma", 1.4);
  const double x_0 = numbers.take("x_0", 0.5);
  numbers.expect_none_left();
  return std::make_unique<RiemannTube>(Riemann(left, right, gamma), left, right, x_0);
}

/// What walls between two gases and clamped ones have in common.
void take_wall(Numbers& numbers, WallBetweenGasesData& data) {
  data.p = numbers.take("p", data.p);
  data.thickness = numbers.take("thickness", data.thickness);
  data.rho_bar = numbers.take("rho_bar", data.rho_bar);
  data.c_p = numbers.take("c_p", data.c_p);
  data.size = numbers.take("size", data.size);
  data.distance = numbers.take("distance", data.distance);
  data.length = numbers.take("length", data.length);
}

std::unique_ptr<Solution> make_wall_between_gases(Numbers numbers) {
  WallBetweenGasesData data;
  data.gamma_left = numbers.take("gamma_left", data.gamma_left);
  data.gamma_right = numbers.take("gamma_right", data.gamma_right);
  data.rho_left = numbers.take("rho_left", data.rho_left);
  data.rho_right = numbers.take("rho_right", data.rho_right);
  constexpr double none = -1;
  if (const double mass = numbers.take("mass", none); mass != none) data.mass = mass;
  take_wall(numbers, data);
  numbers.expect_none_left();
  return std::make_unique<WallBetweenGases>(data);
}

std::unique_ptr<Solution> make_clamped_wall(Numbers numbers) {
  WallBetweenGasesData data;
  data.clamped = true;
  data.gamma_left = numbers.take("gamma", data.gamma_left);
  data.rho_left = numbers.take("rho", data.rho_left);
  take_wall(numbers, data);
  numbers.expect_none_left();
  return std::make_unique<WallBetweenGases>(data);
}

}  // namespace

std::unique_ptr<Solution> make_solution(ReferenceKind kind, const std::map<std::string, double>& numbers,
                                        const std::string& run_dir) {
  try {
    switch (kind) {
      case ReferenceKind::elastic_piston:
        return make_elastic_piston({kind, numbers});
      case ReferenceKind::wall_between_gases:
        return make_wall_between_gases({kind, numbers});
      case ReferenceKind::clamped_wall:
        return make_clamped_wall({kind, numbers});
      case ReferenceKind::riemann:
        return make_riemann_tube({kind, numbers});
      case ReferenceKind::piston_1d:
        return std::make_unique<PistonTable>(run_dir + "/reference.h5");
      case ReferenceKind::rotating_disk:
        return std::make_unique<DiskTable>(run_dir + "/reference.h5");
      case ReferenceKind::none:
      case ReferenceKind::expressions:
      case ReferenceKind::manufactured:
        break;
    }
  } catch (const std::invalid_argument& error) {
    throw UserMistake(fmt::format("reference: {}: {}", name_of(kind), error.what()));
  }
  throw UserMistake(fmt::format("reference: '{}' is no solution by itself", name_of(kind)));
}

}  // namespace fsi::exact
