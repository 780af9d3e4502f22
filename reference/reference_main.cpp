#include "reference/reference_main.hpp"

#include <fmt/format.h>

#include <cstdio>

#include "common/core/command_line.hpp"
#include "common/core/failure.hpp"

namespace fsi::reference {

void write_errors(io::Hdf5& group, const Difference& error) {
  group.write_attribute("estimated_error_rho", error.rho);
  group.write_attribute("estimated_error_v", error.v);
  group.write_attribute("estimated_error_p", error.p);
  group.write_attribute("estimated_error_u_bar", error.u_bar);
  group.write_attribute("estimated_error_v_bar", error.v_bar);
  group.write_attribute("estimated_error_P_bar", error.P_bar);
}

void write_columns(io::Hdf5 group, std::initializer_list<Column> columns) {
  for (const Column& column : columns) group.write(column.name, column.values);
}

std::string words_of(const Difference& error) {
  return fmt::format("rho {:.1e}, v {:.1e}, p {:.1e}, u_bar {:.1e}, v_bar {:.1e}, P_bar {:.1e}", error.rho,
                     error.v, error.p, error.u_bar, error.v_bar, error.P_bar);
}

void warn_of_shock(const std::string& program, double rate, const std::string& remedy) {
  constexpr double least = 1.5;
  if (rate >= least) return;
  fmt::print(
      stderr,
      "{}: warning: order {:.2f} instead of 2: a wave has steepened into a shock, where the isentropic "
      "reference is wrong; {} or end earlier\n",
      program, rate, remedy);
}

int run_reference(int argc, char** argv, const std::string& program, const std::string& title,
                  const std::function<void(const std::string&, const std::string&)>& body) {
  CommandLine line(title);
  std::string case_path;
  std::string run_dir;
  line.add_option("--case", case_path, "case file (YAML)").required();
  line.add_option("--run-dir", run_dir, "folder of the results").required();
  try {
    if (!line.parse(argc, argv)) return 0;
    body(case_path, run_dir);
    return static_cast<int>(ExitCode::done);
  } catch (const Failure& failure) {
    fmt::print(stderr, "{}: {}\n", program, failure.what());
    return static_cast<int>(failure.code());
  }
}

}  // namespace fsi::reference
