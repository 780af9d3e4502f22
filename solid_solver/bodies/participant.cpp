#include "solid_solver/bodies/participant.hpp"

#include <utility>

#include "common/grid/geometry/interface_geometry.hpp"
#include "common/io/write_each.hpp"

namespace fsi::bodies {

BodyParticipant::BodyParticipant(const Setup& setup, const SolidSpec& spec,
                                 std::span<const char* const> quantities)
    : setup_(setup),
      spec_(spec),
      probe_places_(probe_places(setup, spec.name)),
      quantities_(quantities),
      fields_(setup.run_dir, "solid_" + spec.name),
      forces_(setup, spec.name),
      probe_table_(probe_table(setup, spec.name, quantities)) {}

void BodyParticipant::begin(Shape shape, const std::string& grid,
                            const std::function<Vec2(std::size_t, std::size_t)>& inside, bool around) {
  shape_ = std::move(shape);
  initial_ = totals();
  for (std::size_t l = 0; l < shape_.outlines.size(); ++l) {
    const std::vector<double>& x = shape_.outlines[l].x;
    const std::size_t n = x.size() / 2, columns = around ? n + 1 : n;
    Drawn& drawn = drawn_.emplace_back();
    drawn.grid = l == 0 ? grid : grid + "_" + gases_at(spec_)[l];
    drawn.reference = Field(Layout(static_cast<int>(columns), 2), 2);
    drawn.state = Field(Layout(static_cast<int>(columns), 2), static_cast<int>(quantities_.size()));
    for (std::size_t i = 0; i < columns; ++i) {
      const Vec2 inner = inside(l, i % n);
      for (int c = 0; c < 2; ++c) {
        drawn.reference(c, static_cast<int>(i), 0) = x[static_cast<std::size_t>(c) * n + i % n];
        drawn.reference(c, static_cast<int>(i), 1) = inner[c];
      }
    }
  }
}

wire::Hello BodyParticipant::hello() const {
  wire::Hello hello;
  hello.role = "solid";
  hello.name = spec_.name;
  hello.law = spec_.law;
  hello.config_digest = setup_.problem.digest;
  hello.points = static_cast<std::uint64_t>(shape_.points);
  if (!shape_.meets_gas) return hello;
  const std::vector<std::string> gases = gases_at(spec_);
  for (std::size_t l = 0; l < shape_.outlines.size(); ++l) {
    const Outline& outline = shape_.outlines[l];
    hello.interfaces.push_back({.name = interface_name(spec_, gases[l]),
                                .dimension = 2,
                                .x = outline.x,
                                .n = grid::normals(outline.x, outline.ends, outline.orientation)});
  }
  return hello;
}

std::vector<io::GridOutput> BodyParticipant::fields() {
  std::vector<io::GridOutput> grids;
  std::vector<double> values(quantities_.size());
  for (std::size_t l = 0; l < drawn_.size(); ++l) {
    Drawn& drawn = drawn_[l];
    for (int i = 0; i < drawn.reference.layout().n1; ++i) {
      for (int j = 0; j < 2; ++j) {
        values_at({.outline = l,
                   .i = static_cast<std::size_t>(i),
                   .inside = j == 1,
                   .x_bar = {drawn.reference(0, i, j), drawn.reference(1, i, j)}},
                  values);
        for (std::size_t k = 0; k < values.size(); ++k) drawn.state(static_cast<int>(k), i, j) = values[k];
      }
    }
    std::vector<io::NamedPlane> planes;
    for (std::size_t k = 0; k < quantities_.size(); ++k)
      planes.push_back({quantities_[k], drawn.state.view(), static_cast<int>(k)});
    grids.push_back({.grid = drawn.grid,
                     .x = drawn.reference.view(),
                     .u = drawn.state.view(),
                     .fields = std::move(planes)});
  }
  return grids;
}

void BodyParticipant::write_fields(double t, std::uint64_t step) {
  fields_.write(t, step, fields());
}

/// The body as it is: predicted where the others broke.
void BodyParticipant::write_last_state(double t, std::uint64_t step) {
  fields_.write_apart("last_state", t, step, fields());
}

void BodyParticipant::take(std::span<const GasLoad> loads) {
  for (std::size_t k = 0; k < loads.size(); ++k) load_ = k == 0 ? loads[k] : load_ + loads[k];
  impulse_.add(load_, dt_);
}

void BodyParticipant::write_rows(double t, const BodyMotion& motion, std::span<const double> probes) {
  io::write_each([&] { forces_.row(t, load_, motion); },
                 [&] {
                   if (!probe_table_) return;
                   std::vector<double> row{t};
                   row.insert(row.end(), probes.begin(), probes.end());
                   probe_table_->row(row);
                 });
}

void BodyParticipant::flush_tables() {
  io::write_each([&] { forces_.flush(); },
                 [&] {
                   if (probe_table_) probe_table_->flush();
                 });
}

void BodyParticipant::archive(Archive& archive) {
  archive_motion(archive);
  archive.inside("load", [&] { load_.archive(archive); });
  archive.inside("impulse", [&] { impulse_.archive(archive); });
  archive.number("dt", dt_);
  archive.inside("fields", [&] { fields_.archive(archive); });
  archive.inside("forces", [&] { forces_.archive(archive); });
  if (probe_table_) archive.inside("probes", [&] { probe_table_->archive(archive); });
}

void BodyParticipant::report(double /*t*/, io::Part& part) const {
  part.health["min_det_F"] = 1;
  part.conservation = conservation_of(totals(), initial_, impulse_.sum(), is_surrounded());
}

}  // namespace fsi::bodies
