/// reference_piston --case CASE.yaml --run-dir DIR: writes DIR/reference.h5, the fine one-dimensional
/// solution of a piston case, with an estimate of its own error from a run with half as many points.

#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <string>

#include "common/case/case.hpp"
#include "common/core/command_line.hpp"
#include "common/core/failure.hpp"
#include "common/io/atomic_file.hpp"
#include "common/io/grid_writer.hpp"
#include "common/io/hdf5.hpp"
#include "reference/piston_case.hpp"

namespace fsi::reference {
namespace {

void write_output(io::Hdf5 group, const PistonOutput& output) {
  group.write_attribute("t", output.t);
  io::Hdf5 solid = group.make_group("solid");
  solid.write("x_bar", output.x_bar);
  solid.write("u", output.u);
  solid.write("v", output.v_bar);
  solid.write("P11", output.P11);
  solid.write("P22", output.P22);
  io::Hdf5 gas = group.make_group("gas");
  gas.write("x", output.x);
  gas.write("rho", output.rho);
  gas.write("v", output.v);
  gas.write("p", output.p);
}

void write_table(const std::string& path, const PistonRun& run, const PistonDifference& error) {
  io::Hdf5 file = io::Hdf5::create(io::aside(path));
  file.write_attribute("estimated_error_rho", error.rho);
  file.write_attribute("estimated_error_v", error.v);
  file.write_attribute("estimated_error_p", error.p);
  file.write_attribute("estimated_error_u_bar", error.u_bar);
  file.write_attribute("estimated_error_v_bar", error.v_bar);
  file.write_attribute("estimated_error_P_bar", error.P_bar);
  if (!run.broke.empty()) file.write_attribute("broke", run.broke);
  for (std::size_t k = 0; k < run.outputs.size(); ++k)
    write_output(file.make_group(io::output_name(k)), run.outputs[k]);
  file.close();
  io::rename_into_place(path);
}

/// A second-order scheme with half the points is four times
/// as wrong, so the difference is three times the error.
PistonDifference error_from(PistonDifference difference) {
  for (double* value : {&difference.rho, &difference.v, &difference.p, &difference.u_bar, &difference.v_bar,
                        &difference.P_bar}) {
    *value /= 3;
  }
  return difference;
}

/// Order of accuracy seen in three runs, each with half the points
/// of the one before. Below 1.5 the motion is not smooth.
double observed_rate(const PistonDifference& fine, const PistonDifference& coarse) {
  return std::log2(coarse.P_bar / fine.P_bar);
}

void run(const std::string& case_path, const std::string& run_dir) {
  const Case problem = load_case(case_path);
  const PistonProblem piston = piston_from_case(problem);
  const int points = points_from_case(problem);
  const PistonRun fine = solve_piston_while_sound(piston, points);
  const auto half = solve_piston_while_sound(piston, points / 2).outputs;
  const PistonDifference difference = compare(fine.outputs, half);
  const double rate =
      observed_rate(difference, compare(half, solve_piston_while_sound(piston, points / 4).outputs));
  const PistonDifference error = error_from(difference);
  io::make_directory(run_dir);
  write_table(run_dir + "/reference.h5", fine, error);
  if (!fine.broke.empty())
    fmt::print(stderr, "reference_piston: warning: {}; no errors from then on\n", fine.broke);
  fmt::print(
      "reference_piston: {} points per unit length; observed order {:.2f}; estimated errors rho {:.1e}, v "
      "{:.1e}, "
      "p {:.1e}, u_bar {:.1e}, v_bar {:.1e}, P_bar {:.1e}\n",
      points, rate, error.rho, error.v, error.p, error.u_bar, error.v_bar, error.P_bar);
  if (rate < 1.5) {
    fmt::print(
        stderr,
        "reference_piston: warning: order {:.2f} instead of 2: a wave has steepened into a shock, where the "
        "isentropic reference is wrong; drive the piston more gently or end earlier\n",
        rate);
  }
}

}  // namespace
}  // namespace fsi::reference

int main(int argc, char** argv) {
  fsi::CommandLine line("Fine one-dimensional solution of a piston case");
  std::string case_path;
  std::string run_dir;
  line.add_option("--case", case_path, "case file (YAML)").required();
  line.add_option("--run-dir", run_dir, "folder of the results").required();
  try {
    if (!line.parse(argc, argv)) return 0;
    fsi::reference::run(case_path, run_dir);
    return static_cast<int>(fsi::ExitCode::done);
  } catch (const fsi::Failure& failure) {
    fmt::print(stderr, "reference_piston: {}\n", failure.what());
    return static_cast<int>(failure.code());
  }
}
