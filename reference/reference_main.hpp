#pragma once
/// What the programs of the references share: command line, errors in their files, the warning about shocks.

#include <functional>
#include <initializer_list>
#include <string>
#include <vector>

#include "common/io/atomic_file.hpp"
#include "common/io/grid_writer.hpp"
#include "common/io/hdf5.hpp"
#include "reference/chain.hpp"

namespace fsi::reference {

/// Writes estimated_error_rho, .. into a file or one of its groups.
void write_errors(io::Hdf5& group, const Difference& error);

/// A row of an output and its name in the file.
struct Column {
  const char* name;
  const std::vector<double>& values;
};
void write_columns(io::Hdf5 group, std::initializer_list<Column> columns);

/// Writes reference.h5: the errors, why the run ended early if it did, and a group per output, filled by
/// `write_output(group, number)`. @throws OutputFailed when the file cannot be written
template <class Output, class WriteOutput>
void write_table(const std::string& path, const Run<Output>& run, const Difference& error,
                 const WriteOutput& write_output) {
  io::Hdf5 file = io::Hdf5::create(io::aside(path));
  write_errors(file, error);
  if (!run.broke.empty()) file.write_attribute("broke", run.broke);
  for (std::size_t k = 0; k < run.outputs.size(); ++k) {
    write_output(file.make_group(io::output_name(k)), k);
  }
  file.close();
  io::rename_into_place(path);
}

/// "rho .., v .., p .., u_bar .., v_bar .., P_bar .."
std::string words_of(const Difference& error);

/// Says so where two runs show an order of accuracy below 1.5: then the motion is not smooth.
void warn_of_shock(const std::string& program, double rate, const std::string& remedy);

/// Runs `body(case file, folder of the results)` with the command line's; the exit code.
int run_reference(int argc, char** argv, const std::string& program, const std::string& title,
                  const std::function<void(const std::string&, const std::string&)>& body);

}  // namespace fsi::reference
