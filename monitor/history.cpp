#include "monitor/history.hpp"

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <sstream>

namespace fsi::monitor {

namespace {

/// Larger by size; what is not finite counts most.
bool larger(double one, double other) {
  if (!std::isfinite(one)) return true;
  return std::isfinite(other) && std::abs(one) > std::abs(other);
}

std::vector<std::string> split(const std::string& line) {
  std::vector<std::string> cells;
  std::istringstream stream(line);
  for (std::string cell; std::getline(stream, cell, ',');) cells.push_back(cell);
  return cells;
}

/// "beam.gap [length]" -> "beam.gap"
std::string without_unit(const std::string& heading) {
  return heading.substr(0, heading.find(" ["));
}

bool is_proposal(const std::string& heading) {
  return heading.ends_with(".proposed_dt");
}

}  // namespace

void Series::add(double at, double value) {
  if (newest_ && !(at > newest_->at)) return;
  newest_ = {.at = at, .value = value};
  if (gathered_ > 0 && gathered_ < every_) {
    Point& last = points_.back();
    last.at = at;
    if (larger(value, last.value)) last.value = value;
    ++gathered_;
    return;
  }
  if (points_.size() >= capacity) thin_out();
  points_.push_back({.at = at, .value = value});
  gathered_ = 1;
}

void Series::thin_out() {
  std::vector<Point> kept;
  for (std::size_t k = 0; k + 1 < points_.size(); k += 2) {
    const Point &one = points_[k], &next = points_[k + 1];
    kept.push_back({.at = next.at, .value = larger(one.value, next.value) ? one.value : next.value});
  }
  if (points_.size() % 2 == 1) kept.push_back(points_.back());
  points_ = std::move(kept);
  every_ *= 2;
}

void Limiters::add(double t, const std::string& by) {
  if (by.empty() || (!changes_.empty() && (changes_.back().by == by || !(t > changes_.back().t)))) return;
  if (changes_.size() >= capacity) {
    for (std::size_t k = 1; 2 * k < changes_.size(); ++k) changes_[k] = changes_[2 * k];
    changes_.resize((changes_.size() + 1) / 2);
  }
  changes_.push_back({.t = t, .by = by});
}

void History::add(const wire::Telemetry& leader) {
  limiters_.add(leader.t, leader.limited_by);
  if (leader.t > 0) add("dt", leader.t, leader.dt);  // no step led to the initial state
  for (const wire::Telemetry::Interface& side : leader.interfaces) {
    add(side.name + ".velocity_jump", leader.t, side.velocity_jump);
    add(side.name + ".traction_jump", leader.t, side.traction_jump);
    add(side.name + ".shear", leader.t, side.shear);
    add(side.name + ".gap", leader.t, side.gap);
    add(side.name + ".power", leader.t, side.power);
    add(side.name + ".p_max", leader.t, side.p_max);
  }
}

void History::read_table(const std::string& path) {
  std::ifstream file(path);
  std::string line;
  if (!std::getline(file, line)) return;
  std::vector<std::string> headings = split(line);
  std::size_t time = headings.size();
  for (std::size_t k = 0; k < headings.size(); ++k) {
    headings[k] = without_unit(headings[k]);
    if (headings[k] == "t") time = k;
  }
  double before = 0;  // what is said of a step was agreed on where it began
  while (std::getline(file, line)) {
    const std::vector<std::string> cells = split(line);
    if (cells.size() != headings.size() || time >= cells.size()) continue;
    const double t = std::strtod(cells[time].c_str(), nullptr);
    for (std::size_t k = 0; k < cells.size(); ++k) {
      const bool of_step = headings[k] == "dt" || headings[k] == "limited_by" || is_proposal(headings[k]);
      if (k == time || headings[k] == "step" || (of_step && t == 0))
        continue;  // none led to the initial state
      if (headings[k] == "limited_by") {
        limiters_.add(before, cells[k]);
      } else {
        add(headings[k], is_proposal(headings[k]) ? before : t, std::strtod(cells[k].c_str(), nullptr));
      }
    }
    before = t;
  }
}

const Series& History::of(const std::string& name) const {
  static const Series none;
  const auto found = series_.find(name);
  return found == series_.end() ? none : found->second;
}

}  // namespace fsi::monitor
