#include "common/program/picture.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>

namespace fsi {

namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// Every how many points of a grid there is a sample, along its two directions.
struct Stride {
  int i = 1, j = 1;
};

std::vector<int> samples_of(int n, int every) {
  std::vector<int> samples;
  for (int k = 0; k < n - 1; k += every) samples.push_back(k);
  samples.push_back(n - 1);
  return samples;
}

/// A point of a grid.
struct Point {
  int i = 0, j = 0;
};

/// One grid with its quantity and its samples.
class Sampled {
 public:
  Sampled(const io::GridOutput& grid, const std::string& quantity)
      : grid_(grid), steep_(quantity == "schlieren") {
    for (const std::string& name : planes_of(quantity)) {
      const auto found = std::ranges::find(grid.fields, name, &io::NamedPlane::name);
      if (found != grid.fields.end()) planes_.push_back(*found);
    }
    complete_ = !planes_.empty() && planes_.size() == planes_of(quantity).size() &&
                planes_.front().field.layout == grid.x.layout;
    take(coarsest_for_check());
    straight_ = is_straight();
  }

  bool complete() const { return complete_; }
  const Layout& layout() const { return grid_.x.layout; }

  void take(Stride every) {
    every_ = every;
    i_ = samples_of(layout().n1, every.i);
    j_ = samples_of(layout().n2, every.j);
  }

  /// With these strides.
  std::size_t bytes(Stride every) const {
    const std::size_t n1 = count(layout().n1, every.i), n2 = count(layout().n2, every.j);
    return sizeof(std::uint16_t) * n1 * n2 + sizeof(float) * (straight_ ? n1 + n2 : 2 * n1 * n2);
  }

  wire::Picture::Grid grid() const {
    wire::Picture::Grid result{.name = grid_.grid,
                               .n1 = static_cast<std::uint32_t>(i_.size()),
                               .n2 = static_cast<std::uint32_t>(j_.size()),
                               .straight = is_straight(),
                               .x = {},
                               .level = {}};
    if (result.straight) {
      for (const int i : i_) result.x.push_back(static_cast<float>(grid_.x(0, i, j_.front())));
      for (const int j : j_) result.x.push_back(static_cast<float>(grid_.x(1, i_.front(), j)));
      return result;
    }
    for (const int c : {0, 1}) {
      for (const int j : j_) {
        for (const int i : i_) result.x.push_back(static_cast<float>(position(c, {i, j})));
      }
    }
    return result;
  }

  std::vector<double> values() const {
    std::vector<double> result;
    result.reserve(i_.size() * j_.size());
    for (const int j : j_) {
      for (const int i : i_) result.push_back(steep_ ? steepest_near({i, j}) : value_near({i, j}));
    }
    return result;
  }

 private:
  const io::GridOutput& grid_;
  bool steep_, complete_ = false, straight_ = false;
  std::vector<io::NamedPlane> planes_;
  Stride every_;
  std::vector<int> i_, j_;

  static std::size_t count(int n, int every) {
    return static_cast<std::size_t>((n - 1 + every - 1) / every + 1);
  }
  Stride coarsest_for_check() const {
    constexpr int samples = 64;
    return {1 + layout().n1 / samples, 1 + layout().n2 / samples};
  }

  bool used(Point at) const {
    if (at.i < 0 || at.j < 0 || at.i >= layout().n1 || at.j >= layout().n2) return false;
    const auto place = static_cast<std::size_t>(at.j) * static_cast<std::size_t>(layout().n1) +
                       static_cast<std::size_t>(at.i);
    return grid_.kinds.empty() || grid_.kinds[place] != 0;
  }

  /// The same lines parallel to the axes for all samples.
  bool is_straight() const {
    if (grid_.u.data != nullptr) return false;
    for (const int j : j_) {
      for (const int i : i_) {
        if (grid_.x(0, i, j) != grid_.x(0, i, j_.front()) || grid_.x(1, i, j) != grid_.x(1, i_.front(), j))
          return false;
      }
    }
    return true;
  }

  double position(int c, Point at) const {
    if (grid_.u.data == nullptr) return grid_.x(c, at.i, at.j);
    const std::optional<Point> source = nearest_used(at);
    return grid_.x(c, at.i, at.j) + (source ? grid_.u(c, source->i, source->j) : 0);
  }

  /// The point itself, or the nearest that is used within a stride.
  std::optional<Point> nearest_used(Point at) const {
    if (used(at)) return at;
    std::optional<Point> nearest;
    double least = std::numeric_limits<double>::infinity();
    for (int b = 1 - every_.j; b < every_.j; ++b) {
      for (int a = 1 - every_.i; a < every_.i; ++a) {
        const double distance = std::hypot(a, b);
        if (distance >= least || !used({at.i + a, at.j + b})) continue;
        least = distance;
        nearest = Point{at.i + a, at.j + b};
      }
    }
    return nearest;
  }

  double value_near(Point at) const {
    const std::optional<Point> source = nearest_used(at);
    if (!source) return nan;
    if (planes_.size() == 1) return planes_[0].field(planes_[0].plane, source->i, source->j);
    double sum = 0;
    for (const io::NamedPlane& one : planes_) {
      const double value = one.field(one.plane, source->i, source->j);
      sum += value * value;
    }
    return std::sqrt(sum);
  }

  /// Largest |grad| among the points that are nearer to this sample than to others.
  double steepest_near(Point at) const {
    double steepest = -1;  // none yet
    for (int b = -(every_.j / 2); b <= every_.j / 2; ++b) {
      for (int a = -(every_.i / 2); a <= every_.i / 2; ++a)
        steepest = std::max(steepest, steepness({at.i + a, at.j + b}));
    }
    return steepest < 0 ? nan : steepest;
  }

  /// |grad f| by differences to the neighbours that are used, one-sided where there is only one; -1 of a
  /// point that is not used.
  double steepness(Point at) const {
    if (!used(at)) return -1;
    const std::ptrdiff_t here = layout().at(at.i, at.j), line = layout().stride;
    const std::ptrdiff_t left = used({at.i - 1, at.j}) ? here - 1 : here,
                         right = used({at.i + 1, at.j}) ? here + 1 : here,
                         below = used({at.i, at.j - 1}) ? here - line : here,
                         above = used({at.i, at.j + 1}) ? here + line : here;
    const double *f = planes_[0].field.plane(planes_[0].plane), *x = grid_.x.plane(0), *y = grid_.x.plane(1);
    const double across = f[right] - f[left], x1 = x[right] - x[left], y1 = y[right] - y[left];
    const double up = f[above] - f[below], x2 = x[above] - x[below], y2 = y[above] - y[below];
    const double g1 = across * y2 - up * y1, g2 = up * x1 - across * x2;
    return std::sqrt(g1 * g1 + g2 * g2) / std::fabs(x1 * y2 - y1 * x2);
  }
};

/// Strides when there shall be a sample every `every` points, but of a thin grid at least so many intervals,
/// and no more samples than a picture may have.
Stride stride_of(const Layout& shape, int every, int intervals) {
  const auto along = [&](int n) {
    constexpr int most = static_cast<int>(wire::Picture::most_samples) - 1;
    return std::max(std::min(every, std::max(1, (n - 1) / intervals)), (n - 1 + most - 1) / most);
  };
  return {std::max(1, along(shape.n1)), std::max(1, along(shape.n2))};
}

/// The finest samples that a picture has room for.
void choose_samples(std::vector<Sampled>& grids) {
  constexpr int widest = 1 << 16;
  for (const int intervals : {8, 2, 1}) {
    for (int every = 1; every < widest; every += 1 + every / 8) {
      std::size_t bytes = 0;
      for (const Sampled& grid : grids) bytes += grid.bytes(stride_of(grid.layout(), every, intervals));
      if (bytes > largest_picture && (every + 1 + every / 8 < widest || intervals > 1)) continue;
      for (Sampled& grid : grids) grid.take(stride_of(grid.layout(), every, intervals));
      return;
    }
  }
}

}  // namespace

const std::vector<std::string>& planes_of(const std::string& quantity) {
  static const std::vector<std::string> none;
  static const std::map<std::string, std::vector<std::string>> all{{"pressure", {"p"}},
                                                                   {"density", {"rho"}},
                                                                   {"schlieren", {"rho"}},
                                                                   {"speed", {"v1", "v2"}},
                                                                   {"stress", {"P11", "P12", "P21", "P22"}}};
  const auto found = all.find(quantity);
  return found == all.end() ? none : found->second;
}

std::optional<wire::Picture> picture_of(std::span<const io::GridOutput> grids, const std::string& quantity) {
  std::vector<Sampled> sampled;
  for (const io::GridOutput& grid : grids) sampled.emplace_back(grid, quantity);
  if (sampled.empty() || sampled.size() > wire::Picture::most_grids ||
      !std::ranges::all_of(sampled, &Sampled::complete))
    return std::nullopt;
  choose_samples(sampled);
  wire::Picture picture;
  picture.quantity = quantity;
  std::vector<std::vector<double>> values;
  for (const Sampled& grid : sampled) {
    picture.grids.push_back(grid.grid());
    values.push_back(grid.values());
  }
  set_levels(picture, values);
  return picture;
}

void set_levels(wire::Picture& picture, std::span<const std::vector<double>> values) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const std::vector<double>& of_grid : values) {
    for (const double value : of_grid) {
      if (!std::isfinite(value)) continue;
      low = std::min(low, value);
      high = std::max(high, value);
    }
  }
  picture.low = low <= high ? low : 0;
  picture.high = low <= high ? high : 0;
  constexpr double steps = wire::Picture::highest - wire::Picture::lowest;
  const double range = picture.high - picture.low;
  for (std::size_t k = 0; k < values.size(); ++k) {
    std::vector<std::uint16_t>& level = picture.grids[k].level;
    level.clear();
    for (const double value : values[k]) {
      const double part = range > 0 ? (value - picture.low) / range : 0;
      level.push_back(std::isfinite(value)
                          ? static_cast<std::uint16_t>(wire::Picture::lowest + std::lround(part * steps))
                          : wire::Picture::no_value);
    }
  }
}

}  // namespace fsi
