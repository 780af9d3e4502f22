/// reference_piston --case CASE.yaml --run-dir DIR: writes DIR/reference.h5, the fine one-dimensional
/// solution of a piston case, with an estimate of its own error from a run with half as many points.

#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <string>
#include <utility>

#include "common/case/case.hpp"
#include "common/io/atomic_file.hpp"
#include "common/io/hdf5.hpp"
#include "reference/piston_case.hpp"
#include "reference/reference_main.hpp"

namespace fsi::reference {
namespace {

void write_output(io::Hdf5 group, const PistonOutput& output) {
  group.write_attribute("t", output.t);
  write_columns(group.make_group("solid"), {{"x_bar", output.x_bar},
                                            {"u", output.u},
                                            {"v", output.v_bar},
                                            {"P11", output.P11},
                                            {"P22", output.P22}});
  write_columns(group.make_group("gas"),
                {{"x", output.x}, {"rho", output.rho}, {"v", output.v}, {"p", output.p}});
}

/// Order of accuracy seen in three runs, each with half the points
/// of the one before. Below 1.5 the motion is not smooth.
double observed_rate(const Difference& fine, const Difference& coarse) {
  return std::log2(coarse.P_bar / fine.P_bar);
}

void run(const std::string& case_path, const std::string& run_dir) {
  const Case problem = load_case(case_path);
  const PistonProblem piston = piston_from_case(problem);
  const int points = points_from_case(problem);
  const PistonRun fine = solve_piston_while_sound(piston, points);
  const auto half = solve_piston_while_sound(piston, points / 2).outputs;
  const Difference difference = compare(fine.outputs, half);
  const double rate =
      observed_rate(difference, compare(half, solve_piston_while_sound(piston, points / 4).outputs));
  const Difference error = error_from(difference);
  io::make_directory(run_dir);
  write_table(run_dir + "/reference.h5", fine, error,
              [&](io::Hdf5 group, std::size_t k) { write_output(std::move(group), fine.outputs[k]); });
  if (!fine.broke.empty())
    fmt::print(stderr, "reference_piston: warning: {}; no errors from then on\n", fine.broke);
  fmt::print("reference_piston: {} points per unit length; observed order {:.2f}; estimated errors {}\n",
             points, rate, words_of(error));
  warn_of_shock("reference_piston", rate, "drive the piston more gently");
}

}  // namespace
}  // namespace fsi::reference

int main(int argc, char** argv) {
  return fsi::reference::run_reference(argc, argv, "reference_piston",
                                       "Fine one-dimensional solution of a piston case", fsi::reference::run);
}
