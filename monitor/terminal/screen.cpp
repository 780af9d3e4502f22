#include "monitor/terminal/screen.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "monitor/terminal/plot.hpp"

namespace fsi::monitor {

namespace {

using Side = wire::Telemetry::Interface;

/// Parts of an interface's scale: what varies by less along it is not worth a picture; a jump that is smaller
/// is none; a power that varies by less of what its scales and its length make is still.
constexpr double unseen = 1e-9, round_off = 1e-14, still = 1e-11;

/// What makes a power of an interface round-off.
double still_power(const Side& side) {
  return still * side.velocity_scale * side.traction_scale * (side.s.empty() ? 0 : side.s.back());
}

/// False of a rigid body or a beam, say: there is nothing that the gas's traction could be compared with.
bool has_stress(const Side& side) {
  return side.s.size() < 2 || !side.p_predicted_solid.empty();
}

Style style_of_status(const std::string& status) {
  if (status == "running" || status == "alive") return Style::good;
  if (status == "aborted" || status == "lost" || status == "failed" || status == "stopped" ||
      status == "silent")
    return Style::bad;
  if (status == "paused") return Style::warning;
  return status == "done" || status == "ended" ? Style::strong : Style::plain;
}

/// 1234567 -> "1.2M"
std::string short_count(double value) {
  if (value < 999.5) return fmt::format("{:.0f}", value);
  if (value < 999.5e3) return fmt::format("{:.{}f}k", 1e-3 * value, value < 99.5e3 ? 1 : 0);
  if (value < 999.5e6) return fmt::format("{:.{}f}M", 1e-6 * value, value < 99.5e6 ? 1 : 0);
  return fmt::format("{:.1f}G", 1e-9 * value);
}

/// ", 98 % of the steps": of those that the present limiter has limited.
std::string share_limited(const wire::Telemetry& leader) {
  double all = 0, own = 0;
  for (const wire::StepsLimited& one : leader.limits) {
    all += static_cast<double>(one.steps);
    if (one.by == leader.limited_by) own += static_cast<double>(one.steps);
  }
  return own > 0 ? fmt::format(", {:.0f} % of the steps", 100 * own / all) : "";
}

/// Two times in one unit, "0.4/1.2 ms".
std::string trips(double p50_us, double p99_us) {
  if (!(p50_us > 0)) return "-";
  if (p99_us < 9999.5) return fmt::format("{:.0f}/{:.0f}us", p50_us, p99_us);
  return fmt::format("{:.1f}/{:.0f}ms", 1e-3 * p50_us, 1e-3 * p99_us);
}

/// Draws from top to bottom.
class Painter {
 public:
  Painter(const RunState& state, double now, const View& view, Extent extent)
      : state_(state),
        view_(view),
        now_(now),
        frame_(extent, view.braille ? U'\u2026' : U'>'),
        columns_(frame_.extent().columns) {}

  Frame paint() {
    title();
    heading();
    programs();
    health();
    interfaces();
    const int left = frame_.extent().rows - 1 - row_;
    if (left >= 4 && state_.leader() != nullptr) {
      const int history_rows = left >= 9 ? std::clamp(2 * left / 5, 4, 12) : 0;
      if (chosen() != nullptr) profiles(left - history_rows);
      if (chosen() == nullptr || history_rows > 0) histories(frame_.extent().rows - 1 - row_);
    }
    last_line();
    if (view_.help) help();
    return std::move(frame_);
  }

 private:
  const Side* chosen() const {
    const auto& sides = state_.interfaces();
    return sides.empty() ? nullptr : &sides[view_.interface % sides.size()];
  }

  void title() {
    frame_.fill({.column = 0, .row = 0, .columns = columns_, .rows = 1}, U' ', Style::title);
    frame_.put(1, 0, fmt::format("AMP-FSI  {}  {}", state_.run().name, state_.run().run), Style::title);
    const std::string status = fmt::format(" {} ", state_.status());
    frame_.put_right(columns_, 0, status, style_of_status(state_.status()));
    row_ = 1;
  }

  void heading() {
    const wire::Telemetry* leader = state_.leader();
    if (const auto& abort = state_.abort()) {
      frame_.put(0, row_++, fmt::format("{} ended the run: {}", abort->from, abort->reason()), Style::bad);
    }
    if (leader == nullptr) {
      frame_.put(0, row_++, "nothing heard yet", Style::dim);
      return;
    }
    const std::string start = fmt::format("t {:.6g} of {:.6g} ", leader->t, leader->t_end);
    const auto remaining = state_.remaining_s();
    const std::string end =
        fmt::format(" {:5.1f} %  left {}", 100 * state_.progress(),
                    remaining && state_.status() == "running" ? duration_text(*remaining) : "-");
    const int column = frame_.put(0, row_, start, Style::strong);
    bar(column, columns_ - static_cast<int>(end.size()) - column);
    frame_.put_right(columns_, row_, end);
    ++row_;
    frame_.put(
        0, row_++,
        fmt::format("step {}  {:.1f} steps/s  dt {:.4g}  limited by {}{}", leader->step, state_.steps_per_s(),
                    leader->dt, leader->dt_reason.empty() ? "-" : leader->dt_reason, share_limited(*leader)));
  }

  void bar(int column, int width) {
    const int full = static_cast<int>(std::lround(state_.progress() * width));
    for (int k = 0; k < width; ++k) {
      const bool done = k < full;
      const char32_t character = view_.braille ? (done ? U'\u2588' : U'\u2591') : (done ? U'#' : U'.');
      frame_.put(column + k, row_, character, done ? Style::good : Style::dim);
    }
  }

  void programs() {
    if (state_.programs().empty()) return;
    const int name = 12 + std::clamp(columns_ - 80, 0, 12);
    frame_.put(0, row_++,
               fmt::format("{:<{}} {:<8} {:>8} {:>7} {:>6} {:>6} {:>6} {:>6} {:>12}", "program", name,
                           "state", "step", "comp/wt", "Mpt/s", "step/s", "msg/s", "byte/s", "p50/p99"),
               Style::dim);
    for (const auto& [from, program] : state_.programs()) {
      if (row_ >= frame_.extent().rows - 1) return;
      const Rates rates = state_.rates(from);
      const std::string standing = state_.standing(from, now_);
      const auto share = rates.computing ? rates.computing : computing_share(program);
      const std::string busy =
          share ? fmt::format("{:.0f}/{:.0f}%", 100 * *share, 100 - std::round(100 * *share)) : "-";
      const std::string speed =
          program.point_updates_per_s > 0 ? fmt::format("{:.2f}", 1e-6 * program.point_updates_per_s) : "-";
      frame_.put(0, row_, from.substr(0, static_cast<std::size_t>(name)));
      frame_.put(name + 1, row_, standing, style_of_status(standing));
      frame_.put(name + 10, row_++,
                 fmt::format("{:>8} {:>7} {:>6} {:>6} {:>6} {:>6} {:>12}", program.step, busy, speed,
                             short_count(rates.steps_per_s), short_count(rates.messages_per_s),
                             short_count(rates.bytes_per_s),
                             trips(program.round_trip_p50_us, program.round_trip_p99_us)));
    }
  }

  /// Over all programs, in one line.
  void health() {
    constexpr double none = std::numeric_limits<double>::infinity();
    double rho = none, p = none, det_F = none, cells = none;
    std::uint64_t fallbacks = 0, floors = 0;
    for (const auto& [name, program] : state_.programs()) {
      const wire::Health& health = program.health;
      if (program.role == "fluid") {
        rho = std::min(rho, health.min_rho);
        p = std::min(p, health.min_p);
        cells = std::min(cells, health.min_cell_quality);
        fallbacks += health.first_order_fallbacks;
        floors += health.floors;
      } else if (program.role == "solid") {
        det_F = std::min(det_F, health.min_det_F);
      }
    }
    std::string line = "min";
    if (rho < none) line += fmt::format(" rho {:.4g}  p {:.4g}", rho, p);
    if (cells < none) line += fmt::format("  cells {:.2f}", cells);
    if (det_F < none) line += fmt::format("  det F {:.4g}", det_F);
    if (rho < none) line += fmt::format("  first order {}  floors {}", fallbacks, floors);
    if (line == "min") return;
    const auto broken = state_.non_finite();
    const int end = frame_.put(0, row_, line + "  ", Style::plain);
    if (broken.empty()) {
      frame_.put(end, row_++, "all finite", Style::good);
    } else {
      frame_.put(0, row_++, fmt::format("NOT FINITE: {}", fmt::join(broken, ", ")), Style::bad);
    }
    for (const auto& [name, program] : state_.programs()) {
      if (program.noise.empty() || row_ >= frame_.extent().rows - 1) continue;
      frame_.put(0, row_++, fmt::format("WARNING, {}: {}", name, program.noise), Style::warning);
    }
  }

  void interfaces() {
    const auto& sides = state_.interfaces();
    if (sides.empty()) return;
    const int name = 13 + std::clamp(columns_ - 80, 0, 12);
    frame_.put(0, row_++,
               fmt::format("{:<{}} {:>7} {:>7} {:>7} {:>8} {:>15} {:>17}", "at", name, "v jump", "w jump",
                           "gap", "power", "p min, max", "v_n min, max"),
               Style::dim);
    const std::size_t most = static_cast<std::size_t>(std::max(1, (frame_.extent().rows - row_) / 5));
    const std::size_t selected = view_.interface % sides.size();
    const std::size_t first = selected < most ? 0 : selected + 1 - most;
    for (std::size_t k = first; k < std::min(sides.size(), first + most); ++k) {
      const Side& side = sides[k];
      frame_.put(
          0, row_++,
          fmt::format("{:<{}} {:>7} {:>7} {:>7} {:>8} {:>7} {:>7} {:>8} {:>8}",
                      side.name.substr(0, static_cast<std::size_t>(name)), name,
                      compact(side.velocity_jump, 7), has_stress(side) ? compact(side.traction_jump, 7) : "-",
                      compact(side.gap, 7), compact(side.power, 8), compact(side.p_min, 7),
                      compact(side.p_max, 7), compact(side.v_min, 8), compact(side.v_max, 8)),
          sides.size() > 1 && k == selected ? Style::selected : Style::plain);
    }
  }

  void profiles(int rows) {
    const Side& side = *chosen();
    int column =
        frame_.put(0, row_,
                   fmt::format("along {}, s {:.3g} .. {:.3g}   predicted: ", side.name.substr(0, 20),
                               side.s.empty() ? 0 : side.s.front(), side.s.empty() ? 0 : side.s.back()),
                   Style::dim);
    column = frame_.put(column, row_, view_.braille ? "gas" : "gas g", Style::gas);
    column = frame_.put(column + 1, row_, view_.braille ? "solid" : "solid s", Style::solid);
    frame_.put(column + 3, row_++, view_.braille ? "projected" : "projected *", Style::projected);
    const int half = columns_ / 2;
    const auto curves = [&](const std::vector<double>& gas, const std::vector<double>& solid,
                            const std::vector<double>& projected) {
      return std::vector<PlotCurve>{{.x = side.s, .y = gas, .style = Style::gas, .mark = 'g'},
                                    {.x = side.s, .y = solid, .style = Style::solid, .mark = 's'},
                                    {.x = side.s, .y = projected, .style = Style::projected, .mark = '*'}};
    };
    draw(frame_, {.column = 0, .row = row_, .columns = half - 1, .rows = rows - 1},
         {.title = "p",
          .curves = curves(side.p_predicted, side.p_predicted_solid, side.p_projected),
          .floor = unseen * side.traction_scale},
         view_.braille);
    draw(frame_, {.column = half, .row = row_, .columns = columns_ - half, .rows = rows - 1},
         {.title = "v_n",
          .curves = curves(side.v_predicted_gas, side.v_predicted, side.v_projected),
          .floor = unseen * side.velocity_scale},
         view_.braille);
    row_ += rows - 1;
  }

  struct Small {
    std::string title, series;
    bool logarithmic = false;
    double floor = 0;   ///< see Plot
    bool none = false;  ///< there is no such thing in this run
  };

  void histories(int rows) {
    std::vector<Small> small = {{.title = "dt", .series = "dt"}};
    if (const Side* side = chosen()) {
      small = {{.title = "v jump",
                .series = side->name + ".velocity_jump",
                .logarithmic = true,
                .floor = round_off * side->velocity_scale},
               {.title = "w jump",
                .series = side->name + ".traction_jump",
                .logarithmic = true,
                .floor = round_off * side->traction_scale,
                .none = !has_stress(*side)},
               {.title = "dt", .series = "dt"},
               {.title = "power", .series = side->name + ".power", .floor = still_power(*side)}};
      if (columns_ >= 120)
        small.push_back({.title = "gap", .series = side->name + ".gap", .logarithmic = true});
    }
    const int width = columns_ / static_cast<int>(small.size());
    for (std::size_t k = 0; k < small.size(); ++k) {
      PlotCurve curve{.style = Style::projected};
      for (const auto& point : state_.history().of(small[k].series).points()) {
        if (small[k].none) break;
        curve.x.push_back(point.at);
        curve.y.push_back(point.value);
      }
      const std::string last = small[k].none ? "-" : curve.y.empty() ? "" : compact(curve.y.back());
      draw(frame_, {.column = static_cast<int>(k) * width, .row = row_, .columns = width - 1, .rows = rows},
           {.title = fmt::format("{}{} {}", small[k].logarithmic ? "lg " : "", small[k].title, last),
            .curves = {std::move(curve)},
            .logarithmic = small[k].logarithmic,
            .floor = small[k].floor},
           view_.braille);
    }
    row_ += rows;
  }

  void last_line() {
    const int row = frame_.extent().rows - 1;
    if (row < 1) return;
    frame_.fill({.column = 0, .row = row, .columns = columns_, .rows = 1}, U' ', Style::plain);
    if (view_.ask_stop) {
      frame_.put(0, row, "stop the run after this step? y: yes   any other key: no", Style::warning);
    } else if (!view_.message.empty()) {
      frame_.put(0, row, view_.message, Style::warning);
    } else {
      frame_.put(0, row, fmt::format("{}TAB interface  h help  q quit", view_.controls), Style::dim);
    }
  }

  void help() {
    constexpr std::array lines = {
        "p pause     r resume     c write a checkpoint",
        "s stop after this step, gracefully (asks first)",
        "TAB, arrows: next interface     q leave; the run goes on",
        "",
        "comp/wt   computing and waiting over the last seconds",
        "Mpt/s     million grid points advanced per computing second",
        "p50/p99   the others' answer: half, 99 of 100 are faster",
        "v jump    largest n.v of gas minus solid, predicted",
        "w jump    largest difference of the tractions, predicted",
        "gap       largest distance of the two sides",
        "power     of the gas on the solid, projected",
    };
    constexpr int width = 64;
    const int height = static_cast<int>(lines.size()) + 2;
    const int column = std::max(0, (columns_ - width) / 2),
              row = std::max(1, (frame_.extent().rows - height) / 2);
    frame_.fill({.column = column, .row = row, .columns = width, .rows = height}, U' ', Style::title);
    box({.column = column, .row = row, .columns = width, .rows = height});
    for (int k = 0; k < static_cast<int>(lines.size()); ++k) {
      frame_.put(column + 2, row + 1 + k, lines[static_cast<std::size_t>(k)], Style::title);
    }
  }

  /// A line round an area.
  void box(const Area& area) {
    const int right = area.column + area.columns - 1, low = area.row + area.rows - 1;
    const auto edge = [&](char32_t drawn, char32_t ascii) { return view_.braille ? drawn : ascii; };
    for (int k = area.column; k <= right; ++k) {
      for (const int row : {area.row, low}) frame_.put(k, row, edge(U'\u2500', U'-'), Style::title);
    }
    for (int k = area.row; k <= low; ++k) {
      for (const int column : {area.column, right})
        frame_.put(column, k, edge(U'\u2502', U'|'), Style::title);
    }
    frame_.put(area.column, area.row, edge(U'\u250c', U'+'), Style::title);
    frame_.put(right, area.row, edge(U'\u2510', U'+'), Style::title);
    frame_.put(area.column, low, edge(U'\u2514', U'+'), Style::title);
    frame_.put(right, low, edge(U'\u2518', U'+'), Style::title);
  }

  const RunState& state_;
  const View& view_;
  double now_;
  Frame frame_;
  int columns_;
  int row_ = 0;
};

}  // namespace

Frame screen(const RunState& state, double now, const View& view, Extent extent) {
  return Painter(state, now, view, extent).paint();
}

Frame chooser(const std::vector<RunEntry>& runs, std::size_t selected, Extent extent) {
  Frame frame(extent);
  const int columns = frame.extent().columns;
  frame.fill({.column = 0, .row = 0, .columns = columns, .rows = 1}, U' ', Style::title);
  frame.put(1, 0, "AMP-FSI  several runs are going on", Style::title);
  const std::size_t most = static_cast<std::size_t>(std::max(1, frame.extent().rows - 4));
  const std::size_t first = selected < most ? 0 : selected + 1 - most;
  for (std::size_t k = first; k < std::min(runs.size(), first + most); ++k) {
    const int row = 2 + static_cast<int>(k - first);
    const Style style = k == selected ? Style::selected : Style::plain;
    frame.put(1, row,
              fmt::format("{} {}  {}  {}", k == selected ? '>' : ' ', runs[k].run, runs[k].name, runs[k].dir),
              style);
  }
  frame.put(0, frame.extent().rows - 1, "arrows choose  ENTER watch  q quit", Style::dim);
  return frame;
}

}  // namespace fsi::monitor
