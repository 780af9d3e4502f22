#include "solid_solver/rigid/body.hpp"

#include <cmath>
#include <utility>

#include "common/interface/modal.hpp"

namespace fsi::rigid {

namespace {

Vec2 turned(const Vec2& r) {
  return {-r.y(), r.x()};
}

/// Resistance of the mode that goes as given: a power of two, beside which any other vanishes.
constexpr double unmoved = 0x1p500;

/// Where a pose puts points of the reference body.
class Placement {
 public:
  Placement(const Pose& pose, const Vec2& reference_centre)
      : reference_centre_(reference_centre),
        centre_(pose.centre),
        cos_(std::cos(pose.angle)),
        sin_(std::sin(pose.angle)) {}

  Vec2 of(const Vec2& x_bar) const {
    const Vec2 r = x_bar - reference_centre_;
    return centre_ + cos_ * r + sin_ * turned(r);
  }

 private:
  Vec2 reference_centre_, centre_;
  double cos_, sin_;
};

}  // namespace

RigidBody::RigidBody(Outline outline, const Inertia& inertia, double rho, Mounting mounting)
    : outlines_{std::move(outline)},
      reference_centre_(inertia.centre),
      arm_(mounting.pivot ? Vec2(inertia.centre - *mounting.pivot) : Vec2::Zero()),
      masses_{.mass = rho * inertia.area, .moment_of_inertia = rho * inertia.second_moment},
      mounting_(std::move(mounting)),
      E_(mounting_.freedoms) {
  if (mounting_.given) {
    E_.conservativeResize(Eigen::NoChange, E_.cols() + 1);
    E_.rightCols<1>() = mounting_.given.rate(0);
    given_acceleration_ = mounting_.given.acceleration(0);
  }
  s_ = modes_at_rest();
  start(Vec3::Zero());
}

/// S with the resistance of the given mode, and g with what moves it with velocity 1.
Eigen::MatrixXd RigidBody::resisted(Eigen::MatrixXd S) const {
  if (mounting_.given) S.diagonal().tail<1>().setConstant(unmoved);
  return S;
}

Eigen::VectorXd RigidBody::pushed(Eigen::VectorXd g) const {
  if (mounting_.given) g.tail<1>().setConstant(unmoved);
  return g;
}

Eigen::VectorXd RigidBody::modes_at_rest() const {
  Eigen::VectorXd s = Eigen::VectorXd::Zero(modes());
  if (mounting_.given) s.tail<1>().setOnes();
  return s;
}

void RigidBody::start(const Vec3& V) {
  const Vec3 momentum = masses_.diagonal().cwiseProduct(V);
  s_ = V.isZero(0) ? modes_at_rest() : solve_few_modes(resisted(mass_matrix()), pushed(modal_load(momentum)));
  old_s_ = s_;
  old_V_ = older_V_ = velocity();
  acceleration_ = unloaded_acceleration();
  old_mean_ = Eigen::VectorXd::Zero(modes());
}

/// M s' = -B^T diag(m, m, I) ((-omega^2 d, 0) + D p'') - E^T C q' with the springs at rest.
Eigen::VectorXd RigidBody::unloaded_acceleration() const {
  const Vec3 rate = E_ * s_;
  Vec3 load = -masses_.diagonal().cwiseProduct(at_centre() * given_acceleration_);
  load.head<2>() += masses_.mass * rate[2] * rate[2] * arm();
  Eigen::VectorXd f = modal_load(load) - E_.transpose() * mounting_.damper.cwiseProduct(rate);
  if (mounting_.given) f.tail<1>().setZero();
  return f.isZero(0) ? Eigen::VectorXd::Zero(modes()) : solve_few_modes(resisted(mass_matrix()), f);
}

/// From the pivot to the centre of mass.
Vec2 RigidBody::arm() const {
  return std::cos(q_[2]) * arm_ + std::sin(q_[2]) * turned(arm_);
}

/// D.
Eigen::Matrix3d RigidBody::at_centre() const {
  Eigen::Matrix3d D = Eigen::Matrix3d::Identity();
  D.block<2, 1>(0, 2) = turned(arm());
  return D;
}

/// B = D E.
Eigen::MatrixXd RigidBody::modes_now() const {
  return at_centre() * E_;
}

Pose RigidBody::pose() const {
  return {.centre = reference_centre_ - arm_ + q_.head<2>() + arm(), .angle = q_[2]};
}

/// Puts q and E where the given motion has them at t.
void RigidBody::go_as_given(double t) {
  if (!mounting_.given) return;
  mounting_.given.put(t, q_);
  E_.rightCols<1>() = mounting_.given.rate(t);
}

void RigidBody::advance(double t, double dt) {
  older_q_ = old_q_;
  old_q_ = q_;
  older_V_ = old_V_;
  old_V_ = velocity();
  old_s_ = s_;
  old_dt_ = dt_;
  dt_ = dt;
  t_ = t;
  q_ = old_q_ + E_ * (dt * (old_s_ + 0.5 * dt * acceleration_));
  s_ = old_s_ + dt * acceleration_;
  go_as_given(t);
}

Eigen::MatrixXd RigidBody::response() const {
  const double b = difference().leading;
  const Vec3 held = dt_ * mounting_.damper + dt_ * dt_ / b * mounting_.spring;
  return resisted(b * mass_matrix() + E_.transpose() * held.asDiagonal() * E_);
}

Eigen::VectorXd RigidBody::history(const Vec3& own_load) const {
  const BackwardDifference d = difference();
  const Vec3 past = masses_.diagonal().cwiseProduct(Vec3(d.history(old_V_, older_V_)));
  const Vec3 pulled = mounting_.spring.cwiseProduct(Vec3(d.history(old_q_, older_q_))) / d.leading;
  return pushed(modal_load(past + dt_ * own_load) - dt_ * (E_.transpose() * pulled));
}

void RigidBody::correct(const Eigen::VectorXd& s) {
  s_ = s;
  const BackwardDifference d = difference();
  const bool sprung = !mounting_.spring.isZero(0);
  q_ = sprung ? Vec3((dt_ * (E_ * s_) + d.history(old_q_, older_q_)) / d.leading)
              : Vec3(old_q_ + E_ * (0.5 * dt_ * (old_s_ + s_)));
  if (mounting_.given) mounting_.given.put(t_, q_);
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
  const auto three = [&](const char* name, Vec3& v) { archive.values(name, {v.data(), 3}); };
  three("q", q_);
  three("old_q", old_q_);
  three("older_q", older_q_);
  vector("s", s_);
  vector("old_s", old_s_);
  three("old_V", old_V_);
  three("older_V", older_V_);
  vector("acceleration", acceleration_);
  vector("old_mean", old_mean_);
  archive.number("dt", dt_);
  archive.number("old_dt", old_dt_);
  if (!mounting_.given) return;
  archive.number("t", t_);
  go_as_given(t_);
}

Eigen::MatrixXd RigidBody::mass_matrix() const {
  const Eigen::MatrixXd B = modes_now();
  return B.transpose() * masses_.diagonal().asDiagonal() * B;
}

Eigen::MatrixXd RigidBody::mode_vectors(std::size_t outline) const {
  const std::vector<double> x = positions(outline);
  const std::vector<double> normals =
      grid::normals(x, outlines_[outline].ends, outlines_[outline].orientation);
  const std::size_t n = points(outline);
  const Vec2 centre = pose().centre;
  Eigen::MatrixXd N(3, static_cast<Eigen::Index>(n));
  for (std::size_t k = 0; k < n; ++k) {
    const Vec2 normal(normals[k], normals[n + k]);
    const Vec2 turning = turned(Vec2(x[k], x[n + k]) - centre);
    N.col(static_cast<Eigen::Index>(k)) << normal.x(), normal.y(), normal.dot(turning);
  }
  return modes_now().transpose() * N;
}

Vec2 RigidBody::position(const Vec2& x_bar) const {
  return Placement(pose(), reference_centre_).of(x_bar);
}

Vec2 RigidBody::velocity_at(const Vec2& x) const {
  const Vec3 v = velocity();
  return v.head<2>() + v[2] * turned(x - pose().centre);
}

std::vector<double> RigidBody::positions(std::size_t outline) const {
  const std::vector<double>& x_bar = outlines_[outline].x;
  const std::size_t n = points(outline);
  const Placement placement(pose(), reference_centre_);
  std::vector<double> x(2 * n);
  for (std::size_t k = 0; k < n; ++k) {
    const Vec2 now = placement.of({x_bar[k], x_bar[n + k]});
    x[k] = now.x();
    x[n + k] = now.y();
  }
  return x;
}

std::vector<double> RigidBody::velocities(std::span<const double> x) const {
  const std::size_t n = x.size() / 2;
  const Vec3 of_centre = velocity();
  const Vec2 centre = pose().centre;
  std::vector<double> v(2 * n);
  for (std::size_t k = 0; k < n; ++k) {
    const Vec2 now = of_centre.head<2>() + of_centre[2] * turned(Vec2(x[k], x[n + k]) - centre);
    v[k] = now.x();
    v[n + k] = now.y();
  }
  return v;
}

/// V' = B s' + D p'' + (-omega^2 d, 0), and of a point r from the centre alpha e_z x r - omega^2 r besides.
std::vector<double> RigidBody::initial_accelerations(std::span<const double> x) const {
  const std::size_t n = x.size() / 2;
  const double omega = velocity()[2];
  const Vec3 of_modes = modes_now() * acceleration_ + at_centre() * given_acceleration_;
  const Vec2 centre = pose().centre, of_centre = of_modes.head<2>() - omega * omega * arm();
  std::vector<double> a(2 * n);
  for (std::size_t k = 0; k < n; ++k) {
    const Vec2 r = Vec2(x[k], x[n + k]) - centre;
    const Vec2 of_point = of_centre + of_modes[2] * turned(r) - omega * omega * r;
    a[k] = of_point.x();
    a[n + k] = of_point.y();
  }
  return a;
}

double RigidBody::angular_momentum() const {
  const Vec3 v = velocity();
  return masses_.mass * turned(pose().centre).dot(v.head<2>()) + masses_.moment_of_inertia * v[2];
}

}  // namespace fsi::rigid
