#include "reference/disk_file.hpp"

#include <algorithm>
#include <utility>

#include "common/io/hdf5.hpp"
#include "reference/reference_main.hpp"

namespace fsi::reference {

namespace {

void write_output(io::Hdf5 group, const DiskOutput& output, const Difference& error) {
  group.write_attribute("t", output.t);
  group.write_attribute("energy", output.totals.energy());
  group.write_attribute("kinetic_energy_solid", output.totals.kinetic_solid);
  group.write_attribute("kinetic_energy_gas", output.totals.kinetic_gas);
  group.write_attribute("strain_energy", output.totals.strain);
  group.write_attribute("gas_energy", output.totals.gas);
  group.write_attribute("angular_momentum", output.totals.angular_momentum);
  write_errors(group, error);
  write_columns(group.make_group("solid"), {{"r_bar", output.r_bar},
                                            {"u1", output.u1},
                                            {"u2", output.u2},
                                            {"v1", output.v1},
                                            {"v2", output.v2},
                                            {"P11", output.P11},
                                            {"P12", output.P12},
                                            {"P21", output.P21},
                                            {"P22", output.P22}});
  write_columns(group.make_group("gas"),
                {{"r", output.r}, {"rho", output.rho}, {"v", output.v}, {"p", output.p}});
}

}  // namespace

Difference largest(const std::vector<Difference>& all) {
  Difference result;
  for (const auto& one : all) {
    for (const auto quantity : differences) result.*quantity = std::max(result.*quantity, one.*quantity);
  }
  return result;
}

std::vector<Difference> estimated_errors(const std::vector<DiskOutput>& fine,
                                         const std::vector<DiskOutput>& half) {
  std::vector<Difference> errors;
  for (std::size_t k = 0; k < std::min(fine.size(), half.size()); ++k) {
    errors.push_back(error_from(compare(fine[k], half[k])));
  }
  return errors;
}

void write_disk_table(const std::string& path, const DiskRun& run, const std::vector<Difference>& errors) {
  write_table(path, run, largest(errors), [&](io::Hdf5 group, std::size_t k) {
    write_output(std::move(group), run.outputs[k], k < errors.size() ? errors[k] : Difference{});
  });
}

}  // namespace fsi::reference
