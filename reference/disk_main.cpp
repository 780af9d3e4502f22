/// reference_disk --case CASE.yaml --run-dir DIR: writes DIR/reference.h5, the fine one-dimensional solution
/// of a disk that turns in a gas, with an estimate of its own error from a run with half as many points.

#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <string>

#include "common/case/case.hpp"
#include "common/io/atomic_file.hpp"
#include "reference/disk_case.hpp"
#include "reference/disk_file.hpp"
#include "reference/reference_main.hpp"

namespace fsi::reference {
namespace {

void run(const std::string& case_path, const std::string& run_dir) {
  const Case problem = load_case(case_path);
  const DiskProblem disk = disk_from_case(problem);
  const int points = disk_points_from_case(problem);
  const DiskRun run = solve_disk_while_sound(disk, points);
  const std::vector<DiskOutput>& fine = run.outputs;
  const auto half = solve_disk_while_sound(disk, points / 2).outputs;
  const auto errors = estimated_errors(fine, half);
  const auto errors_of_half = estimated_errors(half, solve_disk_while_sound(disk, points / 4).outputs);
  const double rate = std::log2(largest(errors_of_half).P_bar / largest(errors).P_bar);
  io::make_directory(run_dir);
  write_disk_table(run_dir + "/reference.h5", run, errors);
  if (!run.broke.empty())
    fmt::print(stderr, "reference_disk: warning: {}; no errors from then on\n", run.broke);
  const Difference error = largest(errors);
  const DiskTotals& first = fine.front().totals;
  const DiskTotals& last = fine.back().totals;
  fmt::print(
      "reference_disk: {} points per unit length; observed order {:.2f}; estimated errors {}; change of "
      "energy "
      "{:.1e} of {:.3e}, of angular momentum {:.1e} of {:.3e}\n",
      points, rate, words_of(error), last.energy() - first.energy(), first.energy(),
      last.angular_momentum - first.angular_momentum, first.angular_momentum);
  warn_of_shock("reference_disk", rate, "turn the disk more gently");
}

}  // namespace
}  // namespace fsi::reference

int main(int argc, char** argv) {
  return fsi::reference::run_reference(argc, argv, "reference_disk",
                                       "Fine one-dimensional solution of a disk that turns in a gas",
                                       fsi::reference::run);
}
