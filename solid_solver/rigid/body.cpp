#include "solid_solver/rigid/body.hpp"

#include <cmath>
#include <utility>

namespace fsi::rigid {

namespace {

Vec2 turned(const Vec2& r) {
  return {-r.y(), r.x()};
}

Pose moved(const Pose& pose, const Vec3& by) {
  return {.centre = pose.centre + by.head<2>(), .angle = pose.angle + by[2]};
}

}  // namespace

RigidBody::RigidBody(Outline outline, const Inertia& inertia, double rho, Eigen::MatrixXd modes)
    : outlines_{std::move(outline)},
      reference_centre_(inertia.centre),
      dynamics_{.mass = rho * inertia.area,
                .moment_of_inertia = rho * inertia.second_moment,
                .modes = std::move(modes)},
      pose_{.centre = inertia.centre},
      old_pose_(pose_) {
  start(Vec3::Zero());
}

void RigidBody::start(const Vec3& V) {
  s_ = modal_load(V);  // the columns of B are orthogonal unit vectors
  old_s_ = older_s_ = s_;
  acceleration_ = old_mean_ = Eigen::VectorXd::Zero(modes());
}

void RigidBody::advance(double dt) {
  old_pose_ = pose_;
  older_s_ = old_s_;
  old_s_ = s_;
  old_dt_ = dt_;
  dt_ = dt;
  pose_ = moved(old_pose_, dynamics_.modes * (dt * (old_s_ + 0.5 * dt * acceleration_)));
  s_ = old_s_ + dt * acceleration_;
}

Eigen::MatrixXd RigidBody::response() const {
  return difference().leading * mass_matrix();
}

Eigen::VectorXd RigidBody::history(const Vec3& own_load) const {
  const Eigen::VectorXd past = difference().history(old_s_, older_s_);
  return mass_matrix() * past + dt_ * modal_load(own_load);
}

void RigidBody::correct(const Eigen::VectorXd& s) {
  s_ = s;
  pose_ = moved(old_pose_, dynamics_.modes * (0.5 * dt_ * (old_s_ + s_)));
  take_acceleration();
}

/// The mean acceleration of the step belongs to its middle; the trend of two steps brings it to the end.
void RigidBody::take_acceleration() {
  const Eigen::VectorXd mean = (s_ - old_s_) / dt_;
  const double reach = old_dt_ > 0 ? dt_ / (dt_ + old_dt_) : 0.0;
  acceleration_ = mean + reach * (mean - old_mean_);
  old_mean_ = mean;
}

void RigidBody::archive(Archive& archive) {
  const auto vector = [&](const char* name, Eigen::VectorXd& v) {
    archive.values(name, {v.data(), static_cast<std::size_t>(v.size())});
  };
  const auto pose = [&](const char* name, Pose& at) {
    archive.inside(name, [&] {
      archive.values("centre", {at.centre.data(), 2});
      archive.number("angle", at.angle);
    });
  };
  pose("pose", pose_);
  pose("old_pose", old_pose_);
  vector("s", s_);
  vector("old_s", old_s_);
  vector("older_s", older_s_);
  vector("acceleration", acceleration_);
  vector("old_mean", old_mean_);
  archive.number("dt", dt_);
  archive.number("old_dt", old_dt_);
}

Eigen::MatrixXd RigidBody::mass_matrix() const {
  const Vec3 masses(dynamics_.mass, dynamics_.mass, dynamics_.moment_of_inertia);
  return dynamics_.modes.transpose() * masses.asDiagonal() * dynamics_.modes;
}

Eigen::MatrixXd RigidBody::mode_vectors(std::size_t outline) const {
  const std::vector<double> x = positions(outline);
  const std::vector<double> normals =
      grid::normals(x, outlines_[outline].ends, outlines_[outline].orientation);
  const std::size_t n = points(outline);
  Eigen::MatrixXd N(3, static_cast<Eigen::Index>(n));
  for (std::size_t k = 0; k < n; ++k) {
    const Vec2 normal(normals[k], normals[n + k]);
    const Vec2 turning = turned(Vec2(x[k], x[n + k]) - pose_.centre);
    N.col(static_cast<Eigen::Index>(k)) << normal.x(), normal.y(), normal.dot(turning);
  }
  return dynamics_.modes.transpose() * N;
}

Vec2 RigidBody::position(const Vec2& x_bar) const {
  const Vec2 r = x_bar - reference_centre_;
  return pose_.centre + std::cos(pose_.angle) * r + std::sin(pose_.angle) * turned(r);
}

Vec2 RigidBody::velocity_at(const Vec2& x) const {
  const Vec3 v = velocity();
  return v.head<2>() + v[2] * turned(x - pose_.centre);
}

std::vector<double> RigidBody::positions(std::size_t outline) const {
  const std::vector<double>& x_bar = outlines_[outline].x;
  const std::size_t n = points(outline);
  std::vector<double> x(2 * n);
  for (std::size_t k = 0; k < n; ++k) {
    const Vec2 now = position({x_bar[k], x_bar[n + k]});
    x[k] = now.x();
    x[n + k] = now.y();
  }
  return x;
}

std::vector<double> RigidBody::velocities(std::span<const double> x) const {
  const std::size_t n = x.size() / 2;
  std::vector<double> v(2 * n);
  for (std::size_t k = 0; k < n; ++k) {
    const Vec2 now = velocity_at({x[k], x[n + k]});
    v[k] = now.x();
    v[n + k] = now.y();
  }
  return v;
}

std::vector<double> RigidBody::centripetal_accelerations(std::span<const double> x) const {
  const std::size_t n = x.size() / 2;
  const double omega = velocity()[2];
  std::vector<double> a(2 * n);
  for (std::size_t i = 0; i < 2 * n; ++i) a[i] = -omega * omega * (x[i] - pose_.centre[i < n ? 0 : 1]);
  return a;
}

double RigidBody::angular_momentum() const {
  const Vec3 v = velocity();
  return dynamics_.mass * turned(pose_.centre).dot(v.head<2>()) + dynamics_.moment_of_inertia * v[2];
}

}  // namespace fsi::rigid
