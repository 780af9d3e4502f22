#include "coupler/interface_motion.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "common/core/component_major.hpp"

namespace fsi::coupler {

namespace {

/// Points that lie closer than this part of the curve's length are one.
constexpr double coincident = 1e-9;

/// For derivatives of a path in time, part of the time in which it changes by much: truncation and rounding
/// are of the order of 1e-8.
constexpr double path_step = 1e-4;

/// Derivative of the position with respect to the index at point k.
Vec2 tangent(std::span<const double> x, const Curve& curve, std::size_t k) {
  const std::size_t last = x.size() / 2 - 1;
  if (k > 0 && k < last) return 0.5 * (vector_at(x, k + 1) - vector_at(x, k - 1));
  if (curve.periodic) return 0.5 * (vector_at(x, 1) - (vector_at(x, last - 1) - period_of(x)));
  if (curve.closed) return 0.5 * (vector_at(x, 1) - vector_at(x, last - 1));
  if (last == 1) return vector_at(x, 1) - vector_at(x, 0);
  if (k == 0) return 2.0 * vector_at(x, 1) - 1.5 * vector_at(x, 0) - 0.5 * vector_at(x, 2);
  return 1.5 * vector_at(x, last) - 2.0 * vector_at(x, last - 1) + 0.5 * vector_at(x, last - 2);
}

double length(std::span<const double> x) {
  double sum = 0;
  for (std::size_t k = 1; k < x.size() / 2; ++k) sum += (vector_at(x, k) - vector_at(x, k - 1)).norm();
  return sum;
}

}  // namespace

bool is_closed(std::span<const double> x) {
  const std::size_t n = x.size() / 2;
  return n > 3 && (vector_at(x, 0) - vector_at(x, n - 1)).norm() < coincident * length(x);
}

Vec2 period_of(std::span<const double> x) {
  return vector_at(x, x.size() / 2 - 1) - vector_at(x, 0);
}

Curve::Curve(std::span<const double> x, std::span<const double> n0, bool is_periodic)
    : n(x.size() / 2), periodic(is_periodic) {
  if (n < 2 || x.size() != 2 * n) throw std::invalid_argument("an interface needs at least two points");
  if (n0.size() != x.size())
    throw std::invalid_argument("the solid says no normals of its reference boundary");
  closed = periodic || is_closed(x);
  double agreement = 0;
  for (std::size_t k = 0; k < n; ++k) {
    const Vec2 t = tangent(x, *this, k).normalized();
    agreement += Vec2(t.y(), -t.x()).dot(vector_at(n0, k)) / static_cast<double>(n);
  }
  if (!(std::abs(agreement) > 0.5)) {
    throw std::invalid_argument("the solid's reference normals do not stand on the interface curve");
  }
  sign = agreement > 0 ? 1 : -1;
  first.n0 = vector_at(n0, 0);
  last.n0 = vector_at(n0, n - 1);
}

void unit_normals(const Curve& curve, std::span<const double> x, std::span<double> n) {
  for (std::size_t k = 0; k < curve.n; ++k) {
    const Vec2 t = tangent(x, curve, k).normalized();
    n[k] = curve.sign * t.y();
    n[curve.n + k] = -curve.sign * t.x();
  }
  for (const auto& [end, k] : {std::pair(curve.first, std::size_t{0}), std::pair(curve.last, curve.n - 1)}) {
    if (!end.slides) continue;
    n[k] = end.n0.x();
    n[curve.n + k] = end.n0.y();
  }
}

void arclength(std::span<const double> x, std::span<double> s) {
  s[0] = 0;
  for (std::size_t k = 1; k < x.size() / 2; ++k)
    s[k] = s[k - 1] + (vector_at(x, k) - vector_at(x, k - 1)).norm();
}

PrescribedMotion::PrescribedMotion(Path path, std::span<const double> x)
    : path_(std::move(path.position)), step_(path_step * path.time_scale), x_(x.begin(), x.end()) {}

template <class Value>
void PrescribedMotion::each(std::span<double> out, const Value& value) const {
  const std::size_t n = x_.size() / 2;
  for (std::size_t k = 0; k < n; ++k) {
    const Vec2 result = value(x_[k], x_[n + k]);
    out[k] = result[0];
    out[n + k] = result[1];
  }
}

void PrescribedMotion::position(double t, std::span<double> x) const {
  each(x, [&](double x1, double x2) { return path_(x1, x2, t); });
}

void PrescribedMotion::velocity(double t, std::span<double> v) const {
  each(v, [&](double x1, double x2) -> Vec2 {
    return (path_(x1, x2, t + step_) - path_(x1, x2, t - step_)) / (2 * step_);
  });
}

void PrescribedMotion::acceleration(double t, std::span<double> a) const {
  each(a, [&](double x1, double x2) -> Vec2 {
    return (path_(x1, x2, t + step_) - 2 * path_(x1, x2, t) + path_(x1, x2, t - step_)) / (step_ * step_);
  });
}

void InterfaceMotion::start(std::span<const double> v, std::span<const double> a) {
  std::ranges::copy(v, v_.begin());
  if (a.empty()) {
    std::ranges::fill(a_, 0.0);
  } else {
    std::ranges::copy(a, a_.begin());
  }
}

void InterfaceMotion::take(std::span<const double> v, double dt) {
  // The mean acceleration of the last step belongs to its middle;
  // the trend of the last two brings it to the end.
  const double reach = steps_ > 0 ? dt / (dt + dt_) : 0.0;
  for (std::size_t k = 0; k < v_.size(); ++k) {
    const double mean = (v[k] - v_[k]) / dt;
    a_[k] = mean + reach * (mean - mean_[k]);
    mean_[k] = mean;
    v_[k] = v[k];
  }
  ++steps_;
  dt_ = dt;
}

void InterfaceMotion::archive(Archive& archive) {
  archive.values("v", v_);
  archive.values("a", a_);
  archive.values("mean", mean_);
  archive.number("dt", dt_);
  archive.number("steps", steps_);
}

void InterfaceMotion::command(std::span<const double> x_solid, double dt, std::span<double> x_next) const {
  for (std::size_t k = 0; k < v_.size(); ++k) x_next[k] = x_solid[k] + dt * (v_[k] + 0.5 * dt * a_[k]);
}

}  // namespace fsi::coupler
