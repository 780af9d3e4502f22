#include "reference/disk_file.hpp"

#include <algorithm>

#include "common/io/atomic_file.hpp"
#include "common/io/grid_writer.hpp"
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
  io::Hdf5 solid = group.make_group("solid");
  solid.write("r_bar", output.r_bar);
  solid.write("u1", output.u1);
  solid.write("u2", output.u2);
  solid.write("v1", output.v1);
  solid.write("v2", output.v2);
  solid.write("P11", output.P11);
  solid.write("P12", output.P12);
  solid.write("P21", output.P21);
  solid.write("P22", output.P22);
  io::Hdf5 gas = group.make_group("gas");
  gas.write("r", output.r);
  gas.write("rho", output.rho);
  gas.write("v", output.v);
  gas.write("p", output.p);
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
  io::Hdf5 file = io::Hdf5::create(io::aside(path));
  write_errors(file, largest(errors));
  if (!run.broke.empty()) file.write_attribute("broke", run.broke);
  for (std::size_t k = 0; k < run.outputs.size(); ++k) {
    const bool known = k < errors.size();
    write_output(file.make_group(io::output_name(k)), run.outputs[k], known ? errors[k] : Difference{});
  }
  file.close();
  io::rename_into_place(path);
}

}  // namespace fsi::reference
