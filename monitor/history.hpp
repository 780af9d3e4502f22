#pragma once
/// What was, in bounded memory: a run may last for days.

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "common/wire/messages.hpp"

namespace fsi::monitor {

/// A quantity over a growing abscissa, at most `capacity` points. When it is full, every second point goes,
/// the smaller one of a pair by size, so that peaks stay; from
/// then on only every second newcomer counts, and so on.
class Series {
 public:
  struct Point {
    double at = 0, value = 0;  ///< [s], [unit of the quantity]
  };
  static constexpr std::size_t capacity = 600;

  /// Points that do not lie behind the last one are left out.
  void add(double at, double value);
  /// The history: a point may stand for many newcomers, the last one too.
  const std::vector<Point>& points() const { return points_; }
  /// What was added last, as it was; none before there was anything.
  const std::optional<Point>& newest() const { return newest_; }

 private:
  void thin_out();

  std::vector<Point> points_;
  std::optional<Point> newest_;
  std::size_t every_ = 1;     ///< newcomers per point
  std::size_t gathered_ = 0;  ///< newcomers in the last point
};

/// Who limits the step, over the time of a run: one entry for each change that was heard, at most `capacity`;
/// then every second goes.
class Limiters {
 public:
  struct Change {
    double t = 0;    ///< from then on [time]
    std::string by;  ///< a program, or a setting of the case
  };
  static constexpr std::size_t capacity = 512;

  void add(double t, const std::string& by);
  const std::vector<Change>& changes() const { return changes_; }

 private:
  std::vector<Change> changes_;
};

/// The quantities of a run over its time t.
class History {
 public:
  /// From the telemetry of the program that speaks for the run.
  void add(const wire::Telemetry& leader);
  /// Under a name "dt", "INTERFACE.gap" ...; what lies before the last point of that name is left out.
  void add(const std::string& name, double t, double value) { series_[name].add(t, value); }
  /// Steps taken before anybody watched, what was proposed for them and who limited them, from the coupler's
  /// table in the folder of the run. Unreadable: nothing.
  void read_table(const std::string& path);
  /// By name; empty before there was anything.
  const Series& of(const std::string& name) const;
  const std::map<std::string, Series>& all() const { return series_; }
  const Limiters& limiters() const { return limiters_; }

 private:
  Limiters limiters_;
  std::map<std::string, Series> series_;
};

}  // namespace fsi::monitor
