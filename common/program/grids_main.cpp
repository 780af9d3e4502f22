/// fsi_grids CASE DIR: the grids of a case at t = 0 as DIR/fluid.h5 and DIR/solid_<name>.h5, as a run writes
/// them but without fields: for pictures before anything is started.

#include <fmt/format.h>

#include <array>
#include <cstdio>
#include <optional>
#include <string>
#include <vector>

#include "common/case/case.hpp"
#include "common/case/grids/composite_from_case.hpp"
#include "common/core/command_line.hpp"
#include "common/core/failure.hpp"
#include "common/io/grid_writer.hpp"
#include "common/program/grid_from_case.hpp"

namespace {

using fsi::BodyFittedSpec;
using fsi::GridSpec;

/// Positions as planes 0, 1 of a grid of their own: a body without grids inside has its outline, twice.
fsi::Field outline_of(const fsi::CurveSpec& curve) {
  fsi::Field x(fsi::Layout(curve.points(), 2), 2);
  for (int i = 0; i < curve.points(); ++i) {
    const auto k = static_cast<std::size_t>(i), n = static_cast<std::size_t>(curve.points());
    for (int j = 0; j < 2; ++j) {
      x(0, i, j) = curve.x[k];
      x(1, i, j) = curve.x[n + k];
    }
  }
  return x;
}

/// A background and what is fitted before it, with the room that near curves leave each other, connected.
void write_grids(const std::string& folder, const std::string& name, const GridSpec& background,
                 const std::vector<BodyFittedSpec>& fitted) {
  std::vector<fsi::grid::MovingGrid> grids = fsi::grids_at_start(fitted);
  grids.emplace(grids.begin(), fsi::grid_from_case(background, false), 0);
  std::optional<fsi::grid::CompositeGrid> composite;
  if (!fitted.empty()) {
    std::vector<fsi::ConstFieldView> bodies;
    for (std::size_t k = 1; k < grids.size(); ++k) bodies.push_back(grids[k].x());
    composite.emplace(fsi::background_of(background), fsi::bodies_of(fitted));
    composite->connect(bodies, 0);
  }
  std::vector<fsi::io::GridOutput> output;
  for (std::size_t k = 0; k < grids.size(); ++k) {
    output.push_back({.grid = grids[k].name(),
                      .x = grids[k].x(),
                      .u = {},
                      .fields = {},
                      .kinds = fsi::kinds_of(composite ? &*composite : nullptr, static_cast<int>(k))});
  }
  fsi::io::GridWriter(folder, name).write(0, 0, output);
}

/// Whether the program of a solid computes on the grids of the case; others know its outline only.
bool has_grids(const fsi::SolidSpec& solid) {
  return solid.law != "rigid" && solid.law != "beam" && solid.law != "external";
}

void write_solid(const std::string& folder, const fsi::SolidSpec& solid) {
  const std::string name = "solid_" + solid.name;
  if (solid.body_fitted.empty() || has_grids(solid)) {
    write_grids(folder, name, solid.grid, fsi::fitted_grids(solid));
    return;
  }
  const fsi::Field x = outline_of(solid.body_fitted.front().curve);
  const std::array output{
      fsi::io::GridOutput{.grid = "outline", .x = x.view(), .u = {}, .fields = {}, .kinds = {}}};
  fsi::io::GridWriter(folder, name).write(0, 0, output);
}

int run(int argc, const char* const* argv) {
  std::string name, folder;
  std::vector<std::string> overrides, laws;
  fsi::CommandLine line("fsi_grids: the grids of a case at t = 0");
  line.add_option("CASE", name, "a path, or a name in configs/").required();
  line.add_option("DIR", folder, "folder for fluid.h5 and solid_<name>.h5").required();
  line.add_option("--set", overrides, "KEY=VALUE, in place of what the file says (repeatable)");
  line.add_option("--solid", laws, "NAME=LAW, the law of a solid (repeatable)");
  if (!line.parse(argc, argv)) return 0;
  const fsi::Case problem =
      fsi::load_case(fsi::find_case(name, {"configs", fsi::configs_folder()}), overrides, laws);
  for (const fsi::FluidSpec& fluid : problem.fluids)
    write_grids(folder, fsi::fields_name(fluid), fluid.grid, fluid.body_fitted);
  for (const fsi::SolidSpec& solid : problem.solids) write_solid(folder, solid);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const fsi::Failure& failure) {
    fmt::print(stderr, "fsi_grids: {}\n", failure.what());
    return static_cast<int>(failure.code());
  } catch (const std::exception& error) {
    fmt::print(stderr, "fsi_grids: internal error: {}\n", error.what());
    return static_cast<int>(fsi::ExitCode::internal_error);
  }
}
