#include "common/io/xdmf.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <string_view>
#include <vector>

#include "common/io/atomic_file.hpp"
#include "common/io/grid_writer.hpp"
#include "common/io/hdf5.hpp"

namespace fsi::io {

namespace {

/// One component grid at one output time.
struct Block {
  double t = 0;
  std::string text;  ///< its <Grid> element
};

std::string data_item(const std::string& reference, const std::string& dimensions) {
  const bool bytes = reference.ends_with(vtk_ghost_type);
  return fmt::format(R"(<DataItem Dimensions="{}" NumberType="{}" Precision="{}" Format="HDF">{}</DataItem>)",
                     dimensions, bytes ? "UChar" : "Float", bytes ? 1 : 8, reference);
}

bool is_position(std::string_view name) {
  return name.starts_with('x');
}

std::string grid_element(const Hdf5& group, const std::string& name, const std::string& location) {
  const auto shape = group.shape("x1");
  const std::string dimensions = fmt::format("{} {}", shape.at(0), shape.at(1));
  std::string text = fmt::format(R"(        <Grid Name="{}" GridType="Uniform">
          <Topology TopologyType="2DSMesh" Dimensions="{}"/>
          <Geometry GeometryType="XY">
            {}
          </Geometry>
)",
                                 name, dimensions, data_item(location + "/x", dimensions + " 2"));
  for (const auto& field : group.names()) {
    if (is_position(field)) continue;
    fmt::format_to(std::back_inserter(text),
                   R"(          <Attribute Name="{}" AttributeType="Scalar" Center="Node">
            {}
          </Attribute>
)",
                   field, data_item(fmt::format("{}/{}", location, field), dimensions));
  }
  return text + "        </Grid>\n";
}

/// All grids of all output times of one program.
void collect(const std::string& run_dir, const std::string& program, std::vector<Block>& blocks) {
  const Hdf5 master = Hdf5::open(fmt::format("{}/{}.h5", run_dir, program));
  for (const auto& output : master.names()) {
    if (!master.has(output)) continue;  // its file was taken away
    const Hdf5 group = master.group(output);
    const double t = group.number_attribute("t");
    for (const auto& grid : group.names()) {
      const std::string location = fmt::format("fields/{}_{}.h5:/{}", program, output, grid);
      blocks.push_back({t, grid_element(group.group(grid), fmt::format("{}/{}", program, grid), location)});
    }
  }
}

/// Programs that wrote fields: fluid first, then the solids by name.
std::vector<std::string> programs_in(const std::string& run_dir) {
  std::vector<std::string> programs;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(run_dir, error)) {
    const std::string name = entry.path().stem().string();
    const bool ours = name == "fluid" || name.starts_with("fluid_") || name.starts_with("solid_");
    if (ours && entry.path().extension() == ".h5") programs.push_back(name);
  }
  std::ranges::sort(programs);
  return programs;
}

bool same_time(double a, double b) {
  return std::fabs(a - b) <= 1e-9 * std::max(std::fabs(a), std::fabs(b));
}

}  // namespace

std::size_t write_xdmf(const std::string& run_dir) {
  std::vector<Block> blocks;
  for (const auto& program : programs_in(run_dir)) collect(run_dir, program, blocks);
  std::ranges::stable_sort(blocks, {}, &Block::t);

  std::string text = R"(<?xml version="1.0"?>
<Xdmf Version="2.0">
  <Domain>
    <Grid Name="run" GridType="Collection" CollectionType="Temporal">
)";
  std::size_t times = 0;
  for (auto block = blocks.begin(); block != blocks.end();) {
    const auto end =
        std::find_if(block, blocks.end(), [&](const Block& b) { return !same_time(b.t, block->t); });
    fmt::format_to(std::back_inserter(text),
                   R"(      <Grid Name="output" GridType="Collection" CollectionType="Spatial">
        <Time Value="{}"/>
)",
                   block->t);
    for (; block != end; ++block) text += block->text;
    text += "      </Grid>\n";
    ++times;
  }
  text += "    </Grid>\n  </Domain>\n</Xdmf>\n";
  write_atomically(run_dir + "/run.xmf", text);
  return times;
}

}  // namespace fsi::io
