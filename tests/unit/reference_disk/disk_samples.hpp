#pragma once
/// Disks that several tests turn.

#include <string>

#include "common/exact/disk_table.hpp"
#include "reference/disk_chain.hpp"

namespace fsi::reference {

/// The paper's disk (section 5.2) in a gas of density ratio delta.
inline DiskProblem papers_disk(double delta, double omega_0, std::vector<double> times) {
  DiskProblem disk;
  disk.rho_0 = 1.4 / delta;
  disk.p_0 = disk.p_e = 1 / delta;
  disk.v_r = [](double) { return 0.0; };
  disk.v_theta = [omega_0](double r) { return r * exact::angular_velocity(omega_0, r); };
  disk.times = std::move(times);
  return disk;
}

inline DiskProblem with_law(DiskProblem disk, const std::string& law) {
  disk.material.law = law;
  return disk;
}

}  // namespace fsi::reference
