#include "monitor/recording/field_files.hpp"

#include <algorithm>
#include <deque>
#include <filesystem>
#include <optional>
#include <utility>

#include "common/core/failure.hpp"
#include "common/core/field.hpp"
#include "common/io/grid_writer.hpp"
#include "common/io/hdf5.hpp"
#include "common/program/picture.hpp"

namespace fsi::monitor {

namespace {

namespace fs = std::filesystem;

/// Outputs of one program and quantity that are given at once.
constexpr std::size_t at_once = 4;

/// One plane of a field from a dataset of a file.
void fill(Field& field, int plane, const io::Array& array) {
  const int n1 = field.layout().n1;
  for (std::size_t k = 0; k < array.values.size(); ++k) {
    const auto place = static_cast<int>(k);
    field(plane, place % n1, place / n1) = array.values[k];
  }
}

/// The grids of one output time, as far as a quantity needs them. They own what their outputs show.
class Output {
 public:
  Output(const io::Hdf5& file, const std::vector<std::string>& planes) {
    for (const std::string& name : file.names()) add(name, file.group(name), planes);
  }
  const std::vector<io::GridOutput>& grids() const { return grids_; }

 private:
  void add(const std::string& name, const io::Hdf5& group, const std::vector<std::string>& planes) {
    const std::vector<std::uint64_t> shape = group.shape("x1");
    if (shape.size() != 2 || !std::ranges::all_of(planes, [&](const auto& one) { return group.has(one); }))
      return;
    const Layout layout(static_cast<int>(shape[1]), static_cast<int>(shape[0]));
    const bool deforms = group.has("x1_bar") && group.has("x2_bar");
    const Field& x = positions(layout, group, deforms ? "_bar" : "");
    Field& values = fields_.emplace_back(layout, static_cast<int>(planes.size()));
    io::GridOutput grid{.grid = name, .x = x.view(), .u = {}, .fields = {}};
    if (deforms) grid.u = displacements(layout, group, x).view();
    for (std::size_t k = 0; k < planes.size(); ++k) {
      fill(values, static_cast<int>(k), group.read(planes[k]));
      grid.fields.push_back(
          {.name = planes[k], .field = std::as_const(values).view(), .plane = static_cast<int>(k)});
    }
    if (group.has("kind")) {
      for (const double kind : group.read("kind").values)
        grid.kinds.push_back(static_cast<std::uint8_t>(kind));
    }
    grids_.push_back(std::move(grid));
  }

  const Field& positions(const Layout& layout, const io::Hdf5& group, const std::string& of) {
    Field& x = fields_.emplace_back(layout, 2);
    fill(x, 0, group.read("x1" + of));
    fill(x, 1, group.read("x2" + of));
    return x;
  }

  /// Of a solid: at points that are not used they say nothing, so that pictures take those beside them.
  const Field& displacements(const Layout& layout, const io::Hdf5& group, const Field& rest) {
    const Field& now = positions(layout, group, "");
    Field& u = fields_.emplace_back(layout, 2);
    for (const int c : {0, 1}) {
      for (int j = 0; j < layout.n2; ++j) {
        for (int i = 0; i < layout.n1; ++i) u(c, i, j) = now(c, i, j) - rest(c, i, j);
      }
    }
    return u;
  }

  std::deque<Field> fields_;
  std::vector<io::GridOutput> grids_;
};

/// What an output shows of a quantity; none where it has nothing of it. @throws OutputFailed
std::optional<wire::Picture> picture_in(const io::Hdf5& output, const std::string& quantity) {
  const Output fields(output, planes_of(quantity));
  std::optional<wire::Picture> picture = picture_of(fields.grids(), quantity);
  if (picture) picture->step = static_cast<std::uint64_t>(output.number_attribute("step"));
  return picture;
}

/// "fluid.h5" -> {"fluid", "fluid"}, "solid_beam.h5" -> {"beam", "solid"}; none for other files.
std::optional<std::pair<std::string, std::string>> speaker_of(const fs::path& path) {
  const std::string stem = path.stem().string();
  if (path.extension() != ".h5") return std::nullopt;
  if (stem == "fluid") return std::pair{stem, stem};
  for (const std::string role : {"fluid", "solid"}) {
    if (stem.starts_with(role + "_")) return std::pair{stem.substr(role.size() + 1), role};
  }
  return std::nullopt;
}

}  // namespace

std::vector<FieldFiles::Series> FieldFiles::series() const {
  std::vector<Series> found;
  std::error_code none;
  for (const auto& entry : fs::directory_iterator(run_dir_, none)) {
    if (const auto speaker = speaker_of(entry.path()))
      found.push_back({.path = entry.path().string(), .from = speaker->first, .role = speaker->second});
  }
  std::ranges::sort(found, {}, &Series::from);
  return found;
}

std::vector<wire::Picture> FieldFiles::next_of(const Series& one, const std::string& quantity, double until) {
  std::vector<wire::Picture> pictures;
  const io::Hdf5 file = io::Hdf5::open(one.path);
  const auto outputs = static_cast<std::size_t>(file.number_attribute("outputs"));
  std::size_t& given = given_[{one.from, quantity}];
  while (given < outputs && pictures.size() < at_once) {
    try {
      const io::Hdf5 output = file.group(io::output_name(given));
      const double t = output.number_attribute("t");
      if (t > until) break;
      if (std::optional<wire::Picture> picture = picture_in(output, quantity)) {
        picture->from = one.from;
        picture->role = one.role;
        picture->t = t;
        pictures.push_back(std::move(*picture));
      }
    } catch (const OutputFailed&) {
      if (given + 1 == outputs) break;  // the newest one may be there soon
    }
    ++given;
  }
  return pictures;
}

std::vector<wire::Picture> FieldFiles::next(const std::vector<std::string>& wishes, double until) {
  std::vector<wire::Picture> all;
  if (run_dir_.empty()) return all;
  for (const Series& one : series()) {
    for (const std::string& wish : wishes) {
      if (!wish.starts_with(one.role + ".")) continue;
      const std::string quantity = wish.substr(one.role.size() + 1);
      if (planes_of(quantity).empty()) continue;
      try {
        for (wire::Picture& picture : next_of(one, quantity, until)) all.push_back(std::move(picture));
      } catch (const OutputFailed&) {
        continue;  // the series is damaged, or about to be replaced
      }
    }
  }
  return all;
}

}  // namespace fsi::monitor
