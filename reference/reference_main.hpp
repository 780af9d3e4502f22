#pragma once
/// What the programs of the references share: command line, errors in their files, the warning about shocks.

#include <functional>
#include <string>

#include "common/io/hdf5.hpp"
#include "reference/chain.hpp"

namespace fsi::reference {

/// Writes estimated_error_rho, .. into a file or one of its groups.
void write_errors(io::Hdf5& group, const Difference& error);

/// "rho .., v .., p .., u_bar .., v_bar .., P_bar .."
std::string words_of(const Difference& error);

/// Says so where two runs show an order of accuracy below 1.5: then the motion is not smooth.
void warn_of_shock(const std::string& program, double rate, const std::string& remedy);

/// Runs `body(case file, folder of the results)` with the command line's; the exit code.
int run_reference(int argc, char** argv, const std::string& program, const std::string& title,
                  const std::function<void(const std::string&, const std::string&)>& body);

}  // namespace fsi::reference
