#include "common/io/grid_writer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <limits>

#include "common/core/failure.hpp"
#include "common/io/atomic_file.hpp"
#include "common/io/hdf5.hpp"

namespace fsi::io {

namespace {

/// Rows first <= j < end.
struct Rows {
  Rows(std::uint64_t first_row, std::uint64_t end_row)
      : first(static_cast<int>(first_row)), end(static_cast<int>(end_row)) {}
  int first, end;
};

/// Rows of a plane without ghosts and padding, one after the other.
std::vector<double> packed(const ConstFieldView& field, int plane, const Rows& rows) {
  std::vector<double> values;
  values.reserve(static_cast<std::size_t>(field.layout.n1) * static_cast<std::size_t>(rows.end - rows.first));
  for (int j = rows.first; j < rows.end; ++j) {
    const double* row = field.row(plane, j);
    values.insert(values.end(), row, row + field.layout.n1);
  }
  return values;
}

Packing packing_of(const GridOutput& grid) {
  return grid.sparse ? Packing::deflated : Packing::plain;
}

/// A component of where the points are.
std::vector<double> moved(const GridOutput& grid, int component, const Rows& rows) {
  std::vector<double> x = packed(grid.x, component, rows);
  if (grid.u.data == nullptr) return x;
  const std::vector<double> u = packed(grid.u, component, rows);
  for (std::size_t k = 0; k < x.size(); ++k) x[k] += u[k];
  return x;
}

/// x1 and x2, and both point by point as x: what every XDMF reader takes for a curvilinear grid.
void write_positions(Hdf5& group, const GridOutput& grid, const std::array<std::uint64_t, 2>& shape) {
  const Packing packing = packing_of(grid);
  for (const int c : {0, 1}) {
    const std::string name = fmt::format("x{}", c + 1);
    if (grid.u.data != nullptr) {
      group.write(name + "_bar", shape, packing, [&](std::uint64_t first, std::uint64_t end) {
        return packed(grid.x, c, {first, end});
      });
    }
    group.write(name, shape, packing, [&](std::uint64_t first, std::uint64_t end) {
      return moved(grid, c, {first, end});
    });
  }
  group.write(
      "x", std::array{shape[0], shape[1], std::uint64_t{2}}, packing,
      [&](std::uint64_t first, std::uint64_t end) {
        const std::vector<double> x1 = moved(grid, 0, {first, end}), x2 = moved(grid, 1, {first, end});
        std::vector<double> both(2 * x1.size());
        for (std::size_t k = 0; k < x1.size(); ++k) {
          both[2 * k] = x1[k];
          both[2 * k + 1] = x2[k];
        }
        return both;
      });
}

/// What each point is, for readers of the file and for VTK.
void write_kinds(Hdf5& group, const GridOutput& grid, const std::array<std::uint64_t, 2>& shape) {
  const auto width = static_cast<std::ptrdiff_t>(shape[1]);
  group.write("kind", shape, packing_of(grid), [&](std::uint64_t first, std::uint64_t end) {
    const auto from = grid.kinds.begin();
    return std::vector<double>(from + static_cast<std::ptrdiff_t>(first) * width,
                               from + static_cast<std::ptrdiff_t>(end) * width);
  });
  constexpr std::uint8_t shown = 0, hidden = 2;  // vtkDataSetAttributes::HIDDENPOINT
  std::vector<std::uint8_t> ghost_type(grid.kinds.size());
  std::ranges::transform(grid.kinds, ghost_type.begin(), [](int kind) { return kind == 0 ? hidden : shown; });
  group.write(std::string(vtk_ghost_type), ghost_type, shape, packing_of(grid));
}

void write_grid(Hdf5 group, const GridOutput& grid) {
  const std::array shape{static_cast<std::uint64_t>(grid.x.layout.n2),
                         static_cast<std::uint64_t>(grid.x.layout.n1)};
  write_positions(group, grid, shape);
  for (const auto& field : grid.fields) {
    group.write(field.name, shape, packing_of(grid), [&](std::uint64_t first, std::uint64_t end) {
      std::vector<double> values = packed(field.field, field.plane, {first, end});
      const auto before = static_cast<std::size_t>(first * shape[1]);
      for (std::size_t k = 0; !grid.kinds.empty() && k < values.size(); ++k) {
        if (grid.kinds[before + k] == 0) values[k] = std::numeric_limits<double>::quiet_NaN();
      }
      return values;
    });
  }
  if (!grid.kinds.empty()) write_kinds(group, grid, shape);
}

/// @throws OutputFailed where an output of a series that goes on is not there or cannot be read
void check_output(const std::string& path) {
  constexpr const char* why = "a restart continues the series it belongs to";
  if (!std::filesystem::exists(path)) throw OutputFailed(fmt::format("'{}' is missing: {}", path, why));
  try {
    const Hdf5 file = Hdf5::open(path);
    file.number_attribute("t");
    file.number_attribute("step");
    for (const std::string& grid : file.names()) {
      const Hdf5 group = file.group(grid);
      for (const std::string& field : group.names()) group.shape(field);
    }
  } catch (const OutputFailed& failure) {
    throw OutputFailed(
        fmt::format("'{}' is damaged: {}; put it back as it was ({})", path, why, failure.what()));
  }
}

void write_file(const std::string& path, double t, std::uint64_t step, std::span<const GridOutput> grids) {
  Hdf5 file = Hdf5::create(aside(path));
  file.write_attribute("t", t);
  file.write_attribute("step", step);
  for (const auto& grid : grids) write_grid(file.make_group(grid.grid), grid);
  file.close();
  rename_into_place(path);
}

}  // namespace

std::string output_name(std::size_t index) {
  return fmt::format("{:06}", index);
}

GridWriter::GridWriter(std::string run_dir, std::string name)
    : run_dir_(std::move(run_dir)), name_(std::move(name)) {
  make_directory(run_dir_ + "/fields");
}

std::string GridWriter::path_of(std::size_t output) const {
  return fmt::format("{}/fields/{}_{}.h5", run_dir_, name_, output_name(output));
}

void GridWriter::write(double t, std::uint64_t step, std::span<const GridOutput> grids) {
  write_file(path_of(outputs_), t, step, grids);
  ++outputs_;
  write_master();
}

void GridWriter::write_apart(const std::string& folder, double t, std::uint64_t step,
                             std::span<const GridOutput> grids) const {
  make_directory(fmt::format("{}/{}", run_dir_, folder));
  write_file(fmt::format("{}/{}/{}.h5", run_dir_, folder, name_), t, step, grids);
}

void GridWriter::write_master() const {
  const std::string path = fmt::format("{}/{}.h5", run_dir_, name_);
  Hdf5 file = Hdf5::create(aside(path));
  file.write_attribute("outputs", static_cast<std::uint64_t>(outputs_));
  for (std::size_t k = 0; k < outputs_; ++k) {
    file.link(output_name(k), fmt::format("fields/{}_{}.h5", name_, output_name(k)), "/");
  }
  file.close();
  rename_into_place(path);
}

void GridWriter::archive(Archive& archive) {
  archive.number("outputs", outputs_);
  if (!archive.loading()) return;
  for (std::size_t k = 0; k < outputs_; ++k) check_output(path_of(k));
  for (std::size_t k = outputs_; std::filesystem::remove(path_of(k)); ++k) continue;
  if (outputs_ > 0) {
    write_master();
  } else {
    std::filesystem::remove(fmt::format("{}/{}.h5", run_dir_, name_));
  }
}

}  // namespace fsi::io
