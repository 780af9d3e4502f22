#pragma once
/// Fields of one program on its component grids, as a series of output times (layout: docs/output.md).
///
///   DIR/fields/fluid_000000.h5 ...   one file per output time, whole or not there
///   DIR/fluid.h5                   the whole series: group per output time, linked to those files
///
/// All of them are written to temporary files, synced and renamed, so
/// that a kill at any moment leaves a series that opens.

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "common/core/archive.hpp"
#include "common/core/field.hpp"

namespace fsi::io {

/// One plane of a field under the name it has in the file.
struct NamedPlane {
  std::string name;
  ConstFieldView field;
  int plane = 0;
};

/// Dataset of bytes that VTK's programs, ParaView among them, look for: points they leave out, with their cells.
inline constexpr std::string_view vtk_ghost_type = "vtkGhostType";

/// What is written of one component grid. Ghost lines are left out.
struct GridOutput {
  std::string grid;  ///< name of the component grid
  ConstFieldView x;  ///< planes 0, 1: positions; reference positions x_bar where `u` is given
  ConstFieldView u;  ///< planes 0, 1: displacement of a solid; empty for a gas
  std::vector<NamedPlane> fields;
  /// What each point is, row by row: 0 unused, 1 discretised, 2 interpolated; empty where all are
  /// discretised. Written as `kind`, and as `vtkGhostType`; fields are not a number at unused points.
  std::vector<std::uint8_t> kinds = {};
  bool sparse = false;  ///< most points are unused: compressed
};

class GridWriter {
 public:
  /// `name` is "fluid", "fluid_<name>" or "solid_<name>". @throws OutputFailed
  GridWriter(std::string run_dir, std::string name);

  /// Adds one output time. Groups are counted "000000", "000001", ... in the order they are written.
  /// @throws OutputFailed; the outputs before remain
  void write(double t, std::uint64_t step, std::span<const GridOutput> grids);
  /// Writes the fields as DIR/<folder>/<name>.h5, apart from the series. @throws OutputFailed
  void write_apart(const std::string& folder, double t, std::uint64_t step,
                   std::span<const GridOutput> grids) const;
  /// Notes the outputs so far; on loading, removes what came after. @throws OutputFailed
  void archive(Archive& archive);

 private:
  std::string run_dir_, name_;
  std::size_t outputs_ = 0;

  std::string path_of(std::size_t output) const;
  void write_master() const;
};

/// Name of the group of output number `index`.
std::string output_name(std::size_t index);

}  // namespace fsi::io
