#include "monitor/terminal/plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace fsi::monitor {

namespace {

struct Range {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();
  void take(double value) {
    low = std::min(low, value);
    high = std::max(high, value);
  }
  bool empty() const { return !(low <= high); }
  /// Wide enough that noise in the last digits of a constant does not fill the picture.
  Range widened(double floor = 0) const {
    const double least = std::max({1e-6 * std::max(std::abs(low), std::abs(high)), floor, 1e-300});
    if (high - low >= least) return *this;
    return {.low = low - least, .high = high + least};
  }
};

double ordinate(const Plot& plot, double y) {
  if (!plot.logarithmic) return y;
  return y > 0 || plot.floor > 0 ? std::log10(std::max(y, plot.floor))
                                 : std::numeric_limits<double>::quiet_NaN();
}

bool shown(const PlotCurve& curve, const Plot& plot, std::size_t k) {
  return std::isfinite(curve.x[k]) && std::isfinite(ordinate(plot, curve.y[k]));
}

/// Dots in the characters of an area; a character has the style of the last curve in it.
class Canvas {
 public:
  Canvas(const Area& area, bool braille)
      : area_(area),
        per_column_(braille ? 2 : 1),
        per_row_(braille ? 4 : 1),
        dots_(static_cast<std::size_t>(area.columns) * static_cast<std::size_t>(area.rows)) {}

  int width() const { return area_.columns * per_column_; }
  int height() const { return area_.rows * per_row_; }

  /// Dots from the left and from the bottom.
  void set(int x, int y, const PlotCurve& curve) {
    if (x < 0 || y < 0 || x >= width() || y >= height()) return;
    const int from_top = height() - 1 - y;
    Dots& dots =
        dots_[static_cast<std::size_t>(from_top / per_row_) * static_cast<std::size_t>(area_.columns) +
              static_cast<std::size_t>(x / per_column_)];
    if (per_row_ == 1) {
      dots.character = static_cast<char32_t>(curve.mark);
    } else {
      constexpr std::array<std::array<unsigned, 2>, 4> bits = {
          {{0x01, 0x08}, {0x02, 0x10}, {0x04, 0x20}, {0x40, 0x80}}};
      const auto row = static_cast<std::size_t>(from_top % per_row_),
                 column = static_cast<std::size_t>(x % per_column_);
      dots.character = (dots.character == 0 ? U'\u2800' : dots.character) | bits[row][column];
    }
    dots.style = curve.style;
  }

  void show(Frame& frame) const {
    for (int row = 0; row < area_.rows; ++row) {
      for (int column = 0; column < area_.columns; ++column) {
        const Dots& dots = dots_[static_cast<std::size_t>(row) * static_cast<std::size_t>(area_.columns) +
                                 static_cast<std::size_t>(column)];
        if (dots.character != 0)
          frame.put(area_.column + column, area_.row + row, dots.character, dots.style);
      }
    }
  }

 private:
  struct Dots {
    char32_t character = 0;
    Style style = Style::plain;
  };
  Area area_;
  int per_column_, per_row_;
  std::vector<Dots> dots_;
};

void line(Canvas& canvas, const PlotCurve& curve, std::array<int, 2> from, std::array<int, 2> to) {
  const int steps = std::max({std::abs(to[0] - from[0]), std::abs(to[1] - from[1]), 1});
  for (int k = 0; k <= steps; ++k) {
    const double part = static_cast<double>(k) / steps;
    canvas.set(static_cast<int>(std::lround(from[0] + part * (to[0] - from[0]))),
               static_cast<int>(std::lround(from[1] + part * (to[1] - from[1]))), curve);
  }
}

/// A dotted line where y is 0.
void draw_zero(Canvas& canvas, const Range& y) {
  constexpr int apart = 4;
  const PlotCurve dots{.style = Style::dim, .mark = '.'};
  const int height = static_cast<int>(std::lround(-y.low / (y.high - y.low) * (canvas.height() - 1)));
  for (int place = 0; place < canvas.width(); place += apart) canvas.set(place, height, dots);
}

void draw_curve(Canvas& canvas, const Plot& plot, const PlotCurve& curve, const Range& x, const Range& y) {
  const auto place = [&](std::size_t k) -> std::array<int, 2> {
    const double right = (curve.x[k] - x.low) / (x.high - x.low);
    const double up = (ordinate(plot, curve.y[k]) - y.low) / (y.high - y.low);
    return {static_cast<int>(std::lround(right * (canvas.width() - 1))),
            static_cast<int>(std::lround(up * (canvas.height() - 1)))};
  };
  const std::size_t n = std::min(curve.x.size(), curve.y.size());
  for (std::size_t k = 0; k < n; ++k) {
    if (!shown(curve, plot, k)) continue;
    const bool joined = k > 0 && shown(curve, plot, k - 1);
    line(canvas, curve, place(joined ? k - 1 : k), place(k));
  }
}

}  // namespace

void draw(Frame& frame, const Area& area, const Plot& plot, bool braille) {
  if (area.columns < 4 || area.rows < 2) return;
  Range x, y, values;
  for (const PlotCurve& curve : plot.curves) {
    for (std::size_t k = 0; k < std::min(curve.x.size(), curve.y.size()); ++k) {
      if (!shown(curve, plot, k)) continue;
      x.take(curve.x[k]);
      y.take(ordinate(plot, curve.y[k]));
      values.take(curve.y[k]);
    }
  }
  const int title_end = frame.put(
      area.column, area.row, plot.title.substr(0, static_cast<std::size_t>(area.columns)), Style::strong);
  if (x.empty()) return;
  const std::string range = fmt::format("{} .. {}", compact(values.low), compact(values.high));
  if (title_end + 1 + static_cast<int>(range.size()) <= area.column + area.columns) {
    frame.put_right(area.column + area.columns, area.row, range, Style::dim);
  }
  Canvas canvas({.column = area.column, .row = area.row + 1, .columns = area.columns, .rows = area.rows - 1},
                braille);
  const Range across = x.widened(), up = y.widened(plot.logarithmic ? 0 : plot.floor);
  if (!plot.logarithmic && up.low < 0 && up.high > 0) draw_zero(canvas, up);
  for (const PlotCurve& curve : plot.curves) draw_curve(canvas, plot, curve, across, up);
  canvas.show(frame);
}

std::string compact(double value, int width) {
  if (std::isnan(value)) return "nan";
  if (std::isinf(value)) return value > 0 ? "inf" : "-inf";
  for (int digits = 4; digits > 0; --digits) {
    std::string text = fmt::format("{:.{}g}", value, digits);
    if (std::ssize(text) <= width) return text;
  }
  std::string too_narrow(static_cast<std::size_t>(width), '#');
  return too_narrow;
}

}  // namespace fsi::monitor
