/// reference_exact --case CASE.yaml --run-dir DIR: the exact solution of a case along the line that its run computed,
/// beside the run as DIR/reference.h5, for pictures and tables. Unlike the other references it comes after the run: the
/// places are those of its outputs.

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "common/case/case.hpp"
#include "common/exact/solution.hpp"
#include "common/io/atomic_file.hpp"
#include "common/io/hdf5.hpp"
#include "reference/exact_line.hpp"
#include "reference/reference_main.hpp"

namespace fsi::reference {
namespace {

/// The outputs of a program, or nothing where the run did not come so far.
std::unique_ptr<io::Hdf5> outputs_of(const std::string& run_dir, const std::string& name) {
  const std::string path = run_dir + "/" + name + ".h5";
  if (!std::filesystem::exists(path)) return nullptr;
  return std::make_unique<io::Hdf5>(io::Hdf5::open(path));
}

void write_gas(io::Hdf5 group, const GasLine& line) {
  group.write("x", line.x);
  group.write("rho", line.rho);
  group.write("v", line.v);
  group.write("p", line.p);
}

void write_solid(io::Hdf5 group, const SolidLine& line) {
  group.write("x_bar", line.x_bar);
  group.write("u", line.u);
  group.write("v", line.v);
  group.write("P11", line.P11);
}

/// Lines of all gases one after the other, and of the solid, at each output time that every program has.
void write_lines(const Case& problem, const exact::Solution& solution, const std::string& run_dir) {
  std::vector<std::unique_ptr<io::Hdf5>> gases, solids;
  for (const FluidSpec& fluid : problem.fluids) gases.push_back(outputs_of(run_dir, fields_name(fluid)));
  for (const SolidSpec& solid : problem.solids) solids.push_back(outputs_of(run_dir, "solid_" + solid.name));
  const auto missing = [](const auto& file) { return file == nullptr; };
  if (gases.empty() || std::ranges::any_of(gases, missing) || std::ranges::any_of(solids, missing)) return;
  const std::string path = run_dir + "/reference.h5";
  io::Hdf5 file = io::Hdf5::create(io::aside(path));
  for (const std::string& output : gases.front()->names()) {
    const auto lacks = [&](const auto& one) { return !one->has(output); };
    if (std::ranges::any_of(gases, lacks) || std::ranges::any_of(solids, lacks)) break;
    const double t = gases.front()->group(output).number_attribute("t");
    io::Hdf5 group = file.make_group(output);
    group.write_attribute("t", t);
    GasLine gas;
    for (const auto& one : gases) append_gas(gas, solution, middle_line(one->group(output), ""), t);
    write_gas(group.make_group("gas"), gas);
    if (solids.size() == 1 && problem.solids.front().law != "beam") {
      const LineEnds line = middle_line(solids.front()->group(output), "_bar");
      write_solid(group.make_group("solid"), solid_line(solution, line, t));
    }
  }
  file.close();
  io::rename_into_place(path);
}

void run(const std::string& case_path, const std::string& run_dir) {
  const Case problem = load_case(case_path);
  if (!has_exact_line(problem)) return;
  const auto solution = exact::make_solution(problem.reference.kind, problem.reference.numbers, run_dir);
  write_lines(problem, *solution, run_dir);
}

}  // namespace
}  // namespace fsi::reference

int main(int argc, char** argv) {
  return fsi::reference::run_reference(argc, argv, "reference_exact",
                                       "Exact solution along the line of a run", fsi::reference::run);
}
