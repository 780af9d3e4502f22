#include "monitor/recording/recording_block.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <span>
#include <string>

#include "common/core/failure.hpp"
#include "common/io/place_json.hpp"

namespace fsi::monitor {

namespace {

using Side = wire::Telemetry::Interface;

/// Texts by number: each is stored once per block.
class Texts {
 public:
  double number(const std::string& text) {
    const auto [place, added] = numbers_.try_emplace(text, texts_.size());
    if (added) texts_.push_back(text);
    return static_cast<double>(place->second);
  }
  const std::vector<std::string>& all() const { return texts_; }

 private:
  std::map<std::string, std::size_t> numbers_;
  std::vector<std::string> texts_;
};

/// A table of numbers with named columns.
struct Table {
  std::string name;
  const char* columns;
  std::vector<double> values = {};
  std::size_t width = 0;
  void row(std::span<const double> numbers) {
    width = numbers.size();
    values.insert(values.end(), numbers.begin(), numbers.end());
  }
  void write(io::Hdf5& group) const {
    group.write_attribute(name + "_columns", std::string(columns));
    if (width == 0) return;
    group.write(name, values, std::array<std::uint64_t, 2>{values.size() / width, width});
  }
};

constexpr const char* message_columns =
    "at from role state host pid step t t_end dt dt_reason compute_s wait_s point_updates_per_s min_rho "
    "min_p min_det_F min_cell_quality "
    "first_order_fallbacks floors messages bytes round_trip_p50_us round_trip_p99_us interfaces noise "
    "proposed_dt limited_by traffic limits";
constexpr std::size_t message_width = 30;
constexpr const char* traffic_columns =
    "interface from messages bytes missing dropped latency_p50_us latency_p99_us";
constexpr std::size_t traffic_width = 8;
constexpr const char* limit_columns = "by steps";
constexpr std::size_t limit_width = 2;
constexpr const char* interface_columns =
    "name velocity_jump traction_jump gap power p_min p_max v_min v_max closed points has_traction "
    "shear velocity_scale traction_scale";
constexpr std::size_t interface_width = 15;
constexpr const char* profile_columns =
    "s x1 x2 p_predicted p_predicted_solid p_projected v_predicted v_predicted_gas v_projected "
    "w_tangential x1_start x2_start";
constexpr std::size_t profile_width = 12;
constexpr const char* abort_columns = "at from exit_code reason";
constexpr std::size_t abort_width = 4;
constexpr const char* place_columns = "place what";
constexpr std::size_t place_width = 2;

double count(std::uint64_t number) {
  return static_cast<double>(number);
}

void add_profile(Table& profiles, const Side& side) {
  const std::size_t n = side.s.size();
  const auto at = [](const std::vector<double>& values, std::size_t k) {
    return k < values.size() ? values[k] : std::nan("");
  };
  for (std::size_t k = 0; k < n; ++k) {
    profiles.row(std::array{side.s[k], at(side.x, k), at(side.x, n + k), at(side.p_predicted, k),
                            at(side.p_predicted_solid, k), at(side.p_projected, k), at(side.v_predicted, k),
                            at(side.v_predicted_gas, k), at(side.v_projected, k), at(side.w_tangential, k),
                            at(side.x_start, k), at(side.x_start, n + k)});
  }
}

std::uint64_t whole(double number) {
  return number >= 0 && number < 1e18 ? static_cast<std::uint64_t>(number) : 0;
}

/// Rows of a table that may be missing.
class Rows {
 public:
  Rows(const io::Hdf5& group, const std::string& name, std::size_t width) : width_(width) {
    if (!group.has(name)) return;
    array_ = group.read(name);
    if (array_.shape.size() != 2 || array_.shape[1] != width)
      throw OutputFailed(fmt::format("the recording's table '{}' has not {} columns", name, width));
  }
  std::size_t size() const { return array_.values.size() / width_; }
  bool more() const { return next_ < size(); }
  std::span<const double> take() {
    if (!more()) throw OutputFailed("a table of the recording is too short");
    return std::span(array_.values).subspan(width_ * next_++, width_);
  }

 private:
  io::Array array_;
  std::size_t width_, next_ = 0;
};

using TextOf = std::function<std::string(double)>;

Side side_from(std::span<const double> row, Rows& profiles, const TextOf& text) {
  Side side;
  side.name = text(row[0]);
  side.velocity_jump = row[1];
  side.traction_jump = row[2];
  side.gap = row[3];
  side.power = row[4];
  side.p_min = row[5];
  side.p_max = row[6];
  side.v_min = row[7];
  side.v_max = row[8];
  side.closed = row[9] != 0;
  side.shear = row[12];
  side.velocity_scale = row[13];
  side.traction_scale = row[14];
  std::vector<double> x2, x2_start;
  for (std::uint64_t k = 0; k < whole(row[10]); ++k) {
    const auto point = profiles.take();
    side.s.push_back(point[0]);
    side.x.push_back(point[1]);
    x2.push_back(point[2]);
    side.x_start.push_back(point[10]);
    x2_start.push_back(point[11]);
    side.p_predicted.push_back(point[3]);
    if (row[11] != 0) {
      side.p_predicted_solid.push_back(point[4]);
      side.w_tangential.push_back(point[9]);
    }
    side.p_projected.push_back(point[5]);
    side.v_predicted.push_back(point[6]);
    side.v_predicted_gas.push_back(point[7]);
    side.v_projected.push_back(point[8]);
  }
  side.x.insert(side.x.end(), x2.begin(), x2.end());
  side.x_start.insert(side.x_start.end(), x2_start.begin(), x2_start.end());
  return side;
}

wire::Telemetry telemetry_from(std::span<const double> row, const TextOf& text) {
  return {.run = {},
          .from = text(row[1]),
          .role = text(row[2]),
          .state = text(row[3]),
          .host = text(row[4]),
          .pid = static_cast<std::int32_t>(whole(row[5])),
          .step = whole(row[6]),
          .t = row[7],
          .t_end = row[8],
          .dt = row[9],
          .dt_reason = text(row[10]),
          .proposed_dt = row[26],
          .limited_by = text(row[27]),
          .limits = {},
          .compute_s = row[11],
          .wait_s = row[12],
          .point_updates_per_s = row[13],
          .health = {.min_rho = row[14],
                     .min_p = row[15],
                     .min_det_F = row[16],
                     .min_cell_quality = row[17],
                     .first_order_fallbacks = whole(row[18]),
                     .floors = whole(row[19])},
          .noise = text(row[25]),
          .messages = whole(row[20]),
          .bytes = whole(row[21]),
          .round_trip_p50_us = row[22],
          .round_trip_p99_us = row[23],
          .interfaces = {},
          .traffic = {}};
}

wire::Traffic traffic_from(std::span<const double> row, const TextOf& text) {
  return {.interface = text(row[0]),
          .from = text(row[1]),
          .messages = whole(row[2]),
          .bytes = whole(row[3]),
          .missing = whole(row[4]),
          .dropped = whole(row[5]),
          .latency_p50_us = row[6],
          .latency_p99_us = row[7]};
}

std::string json_of(const Place& place) {
  using nlohmann::ordered_json;
  return io::to_json(place).dump(-1, ' ', false, ordered_json::error_handler_t::replace);
}

/// Its place is in the sentence only where it is no number, and in recordings of former versions.
wire::Abort abort_from(std::span<const double> row, Rows& places, const TextOf& text) {
  wire::Abort abort{
      .run = {}, .from = text(row[1]), .exit_code = static_cast<std::int32_t>(row[2]), .what = text(row[3])};
  if (!places.more()) return abort;
  const auto place = places.take();
  try {
    abort.place = io::place_of(nlohmann::json::parse(text(place[0])));
    abort.what = text(place[1]);
  } catch (const nlohmann::json::exception&) {
    return abort;
  }
  return abort;
}

/// The tables of a block, filled message by message.
class Tables {
 public:
  void add(double at, const wire::Telemetry& m) {
    add_state(at, m);
    for (const wire::StepsLimited& limit : m.limits)
      limits_.row(std::array{texts_.number(limit.by), count(limit.steps)});
    for (const wire::Traffic& line : m.traffic) {
      traffic_.row(std::array{texts_.number(line.interface), texts_.number(line.from), count(line.messages),
                              count(line.bytes), count(line.missing), count(line.dropped),
                              line.latency_p50_us, line.latency_p99_us});
    }
    for (const Side& side : m.interfaces) add_side(side);
  }
  void add(double at, const wire::Abort& abort) {
    aborts_.row(std::array{at, texts_.number(abort.from), static_cast<double>(abort.exit_code),
                           texts_.number(abort.reason())});
    places_.row(std::array{texts_.number(json_of(abort.place)), texts_.number(abort.what)});
  }
  void write(io::Hdf5& group) const {
    for (const Table* table : {&messages_, &sides_, &profiles_, &traffic_, &limits_, &aborts_, &places_})
      table->write(group);
    for (std::size_t k = 0; k < texts_.all().size(); ++k)
      group.write_attribute(fmt::format("text_{}", k), texts_.all()[k]);
  }

 private:
  Texts texts_;
  Table messages_{.name = "messages", .columns = message_columns};
  Table sides_{.name = "interfaces", .columns = interface_columns};
  Table profiles_{.name = "profiles", .columns = profile_columns};
  Table traffic_{.name = "traffic", .columns = traffic_columns};
  Table limits_{.name = "limits", .columns = limit_columns};
  Table aborts_{.name = "aborts", .columns = abort_columns};
  Table places_{.name = "places", .columns = place_columns};

  void add_state(double at, const wire::Telemetry& m) {
    messages_.row(std::array{at,
                             texts_.number(m.from),
                             texts_.number(m.role),
                             texts_.number(m.state),
                             texts_.number(m.host),
                             static_cast<double>(m.pid),
                             count(m.step),
                             m.t,
                             m.t_end,
                             m.dt,
                             texts_.number(m.dt_reason),
                             m.compute_s,
                             m.wait_s,
                             m.point_updates_per_s,
                             m.health.min_rho,
                             m.health.min_p,
                             m.health.min_det_F,
                             m.health.min_cell_quality,
                             count(m.health.first_order_fallbacks),
                             count(m.health.floors),
                             count(m.messages),
                             count(m.bytes),
                             m.round_trip_p50_us,
                             m.round_trip_p99_us,
                             count(m.interfaces.size()),
                             texts_.number(m.noise),
                             m.proposed_dt,
                             texts_.number(m.limited_by),
                             count(m.traffic.size()),
                             count(m.limits.size())});
  }

  void add_side(const Side& side) {
    sides_.row(std::array{texts_.number(side.name), side.velocity_jump, side.traction_jump, side.gap,
                          side.power, side.p_min, side.p_max, side.v_min, side.v_max, side.closed ? 1.0 : 0.0,
                          count(side.s.size()), side.p_predicted_solid.empty() ? 0.0 : 1.0, side.shear,
                          side.velocity_scale, side.traction_scale});
    add_profile(profiles_, side);
  }
};

}  // namespace

void write_block(io::Hdf5& group, const std::vector<Heard>& heard) {
  Tables tables;
  for (const Heard& one : heard) {
    if (one.telemetry) tables.add(one.at, *one.telemetry);
    if (one.abort) tables.add(one.at, *one.abort);
  }
  tables.write(group);
}

std::vector<Heard> read_block(const io::Hdf5& group) {
  std::map<std::uint64_t, std::string> known;
  const TextOf text = [&](double number) {
    const auto [place, added] = known.try_emplace(whole(number));
    if (added) place->second = group.text_attribute(fmt::format("text_{}", place->first));
    return place->second;
  };
  Rows messages(group, "messages", message_width), sides(group, "interfaces", interface_width),
      profiles(group, "profiles", profile_width), traffic(group, "traffic", traffic_width),
      limits(group, "limits", limit_width), aborts(group, "aborts", abort_width),
      places(group, "places", place_width);
  std::vector<Heard> heard;
  while (messages.more()) {
    const auto row = messages.take();
    wire::Telemetry& telemetry =
        heard.emplace_back(Heard{.at = row[0]}).telemetry.emplace(telemetry_from(row, text));
    for (std::uint64_t k = 0; k < whole(row[24]); ++k)
      telemetry.interfaces.push_back(side_from(sides.take(), profiles, text));
    for (std::uint64_t k = 0; k < whole(row[28]); ++k)
      telemetry.traffic.push_back(traffic_from(traffic.take(), text));
    for (std::uint64_t k = 0; k < whole(row[29]); ++k) {
      const auto limit = limits.take();
      telemetry.limits.push_back({.by = text(limit[0]), .steps = whole(limit[1])});
    }
  }
  while (aborts.more()) {
    const auto row = aborts.take();
    heard.push_back({.at = row[0], .abort = abort_from(row, places, text)});
  }
  return heard;
}

}  // namespace fsi::monitor
