#include "common/case/report/memory.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <type_traits>

#include "common/case/document/fluid_sections.hpp"
#include "common/case/schema/laws.hpp"

namespace fsi {

namespace {

using config::Node;

/// Bytes at the peak of a run for each point: fields at two times, coordinates, metrics, lists of donors, and
/// what output and checkpoints gather. Measured; tests/programs/runs/test_memory.py
/// holds them against the programs.
struct Cost {
  double lattice;  ///< rectangle along the axes
  double mapped;   ///< any other grid of the case
  double fitted;   ///< marched from a curve
};
constexpr Cost gas_cost{.lattice = 185, .mapped = 235, .fitted = 500};
constexpr Cost solid_cost{.lattice = 340, .mapped = 450, .fitted = 600};
constexpr Cost rigid_cost{.lattice = 0, .mapped = 0, .fitted = 0};
constexpr double program_cost = 24e6;    ///< without any points, the bus included
constexpr double coupler_cost = 23.5e6;  ///< it holds no fields
constexpr double interface_cost = 1700;  ///< of the coupler, for each point of an interface

double points_of(const GridSpec& grid) {
  return static_cast<double>(grid.n1) * grid.n2;
}

double points_of(const BodyFittedSpec& grid) {
  return static_cast<double>(grid.curve.points()) * grid.lines;
}

/// A rectangle that stays where it is. The grid of a gas goes with the solid it meets; that of a solid is its reference
/// configuration.
template <class Owner>
bool is_lattice(const Owner& owner) {
  constexpr bool is_gas = std::is_same_v<Owner, FluidSpec>;
  const bool moves = is_gas && std::ranges::any_of(owner.boundary, [](const BoundarySpec& side) {
                       return side.kind == BoundaryKind::interface;
                     });
  return owner.grid.kind == GridSpec::Kind::rectangle && owner.grid.rotation == 0 && !moves;
}

template <class Owner>
MemoryNeed need_of(const std::string& program, const Owner& owner, const Cost& cost) {
  const bool lattice = is_lattice(owner);
  MemoryNeed need{.program = program, .points = points_of(owner.grid), .bytes = program_cost};
  need.bytes += (lattice ? cost.lattice : cost.mapped) * need.points;
  for (const BodyFittedSpec& fitted : fitted_grids(owner)) {
    need.points += points_of(fitted);
    need.bytes += cost.fitted * points_of(fitted);
  }
  return need;
}

double number_in(const std::filesystem::path& path) {
  std::ifstream file(path);
  double value = unlimited_memory;
  file >> value;  // "max" is no number
  return file ? value : unlimited_memory;
}

/// "MemAvailable:   123 kB"
double available_in_meminfo() {
  std::ifstream file("/proc/meminfo");
  std::string word;
  while (file >> word) {
    double kibibytes = 0;
    if (word == "MemAvailable:" && file >> kibibytes) return 1024 * kibibytes;
  }
  return unlimited_memory;
}

/// What the control groups of this process leave, the containing ones too.
double available_in_groups() {
  namespace fs = std::filesystem;
  std::ifstream file("/proc/self/cgroup");
  double least = unlimited_memory;
  for (std::string line; std::getline(file, line);) {
    const bool unified = line.starts_with("0::"), memory = line.find(":memory:") != std::string::npos;
    if (!unified && !memory) continue;
    const fs::path root = unified ? "/sys/fs/cgroup" : "/sys/fs/cgroup/memory";
    const char *most = unified ? "memory.max" : "memory.limit_in_bytes",
               *used = unified ? "memory.current" : "memory.usage_in_bytes";
    for (fs::path group = line.substr(line.rfind(':') + 1);; group = group.parent_path()) {
      const fs::path folder = root / group.relative_path();
      const double limit = number_in(folder / most), now = number_in(folder / used);
      if (limit < unlimited_memory && now < unlimited_memory)
        least = std::min(least, std::max(0.0, limit - now));
      if (group == group.parent_path()) break;
    }
  }
  return least;
}

/// The place of the grid that has most points, and its key.
std::pair<const Node*, std::string> largest_grid(const Case& problem, const Node& root) {
  double most = -1;
  std::pair<const Node*, std::string> largest{&root, ""};
  const auto look = [&](const auto& owner, const Node& node, const std::string& path) {
    const auto offer = [&](double points, const char* key) {
      const Node* place = node.find(key);
      if (points <= most || place == nullptr) return;
      most = points;
      largest = {place, path + "." + key};
    };
    offer(points_of(owner.grid), "grid");
    double fitted = 0;
    for (const BodyFittedSpec& grid : fitted_grids(owner)) fitted += points_of(grid);
    offer(fitted, node.find("body_fitted") != nullptr ? "body_fitted" : "shape");
  };
  for (const FluidSpec& fluid : problem.fluids) look(fluid, fluid_section_of(root, fluid.name), fluid.path);
  for (const SolidSpec& solid : problem.solids)
    look(solid, *root.find("solids")->find(solid.name), "solids." + solid.name);
  return largest;
}

}  // namespace

std::vector<MemoryNeed> memory_of(const Case& problem) {
  std::vector<MemoryNeed> needs;
  double meeting = 0;
  for (const FluidSpec& fluid : problem.fluids) needs.push_back(need_of(fluid.name, fluid, gas_cost));
  for (const SolidSpec& solid : problem.solids) {
    if (solid.law == external_law) continue;
    needs.push_back(need_of(solid.name, solid, is_continuum(solid.law) ? solid_cost : rigid_cost));
    for (const BodyFittedSpec& fitted : solid.body_fitted) meeting += fitted.curve.points();
    if (solid.body_fitted.empty()) meeting += solid.grid.n1 + solid.grid.n2;
  }
  if (!problem.fluids.empty() && !problem.solids.empty())
    needs.push_back({"coupler", meeting, coupler_cost + interface_cost * meeting});
  return needs;
}

double total_memory(const Case& problem) {
  double bytes = 0;
  for (const MemoryNeed& need : memory_of(problem)) bytes += need.bytes;
  return bytes;
}

std::string bytes_text(double bytes) {
  if (bytes < 1e9) return fmt::format("{:.0f} MB", bytes / 1e6);
  return bytes < 1e12 ? fmt::format("{:.1f} GB", bytes / 1e9) : fmt::format("{:.4g} TB", bytes / 1e12);
}

double available_memory() {
  return std::min(available_in_meminfo(), available_in_groups());
}

void check_memory(const Case& problem, const Node& root, double available) {
  double fixed = 0, by_points = 0, points = 0;
  std::vector<std::string> parts;
  for (const MemoryNeed& need : memory_of(problem)) {
    const double own = need.program == "coupler" ? coupler_cost : program_cost;
    fixed += own;
    by_points += need.bytes - own;
    points += need.program == "coupler" ? 0 : need.points;
    parts.push_back(fmt::format("{} {}", need.program, bytes_text(need.bytes)));
  }
  if (fixed + by_points <= available) return;
  const double fitting = std::max(0.0, points * (available - fixed) / by_points);
  const auto [place, path] = largest_grid(problem, root);
  config::fail(
      place->place, path,
      fmt::format("{:.4g} points need about {} of memory ({}); {} are free, which is enough for about "
                  "{:.2g} points in all",
                  points, bytes_text(fixed + by_points), fmt::join(parts, ", "), bytes_text(available),
                  fitting));
}

}  // namespace fsi
