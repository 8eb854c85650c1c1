#include "half_spaces/held_spring.h"

#include <algorithm>
#include <cmath>

#include "half_spaces/least_distance.h"

namespace glissade::devices {
namespace {

using Eigen::Vector3d;

/// What the half-spaces demand of a displacement (v, ρ w) that is added to the one of the hand.
Inequalities demands(const HalfSpaces& half_spaces, const geometry::Displacement& of_hand, double radius) noexcept {
  Inequalities inequalities;
  const auto count = static_cast<Eigen::Index>(std::min(half_spaces.count, kMaxHalfSpaces));
  inequalities.G.resize(count, 6);
  inequalities.h.resize(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const HalfSpace& row = half_spaces.rows[static_cast<std::size_t>(i)];
    const Vector3d arm = row.r_W.cross(row.n_W);
    inequalities.G.row(i) << row.n_W.transpose(), arm.transpose() / radius;
    inequalities.h[i] = row.bound - row.n_W.dot(of_hand.v) - arm.dot(of_hand.w);
  }
  return inequalities;
}

}  // namespace

HeldSpring::HeldSpring(const HalfSpaces& half_spaces, const Eigen::Isometry3d& X_WH) noexcept
    : half_spaces_(half_spaces), p_HR_W_(X_WH.linear() * half_spaces.p_HR), direction_(geometry::Vector6d::Zero()) {
  if (!half_spaces.any()) return;
  radius_ = std::sqrt(half_spaces.rotational_stiffness / half_spaces.stiffness);
  const geometry::Displacement d = geometry::displacement_between(half_spaces.X_WB, X_WH, half_spaces.p_HR);
  const auto way = least_distance(demands(half_spaces, d, radius_));
  if (!way || way->isZero(0.0)) return;
  depth_ = way->norm();
  direction_ = *way / depth_;
}

double HeldSpring::closing(const Vector3d& v_WH, const Vector3d& w_WH) const noexcept {
  const Vector3d v_WR = v_WH + w_WH.cross(p_HR_W_);
  return -direction_.head<3>().dot(v_WR) - radius_ * direction_.tail<3>().dot(w_WH);
}

double HeldSpring::size() const noexcept {
  return std::min(half_spaces_.stiffness * depth_, half_spaces_.max_force);
}

HandWrench HeldSpring::wrench(double size) const noexcept {
  HandWrench wrench{size * direction_.head<3>(), size * radius_ * direction_.tail<3>()};
  wrench.t_H_W += p_HR_W_.cross(wrench.f_H_W);
  const double torque = wrench.t_H_W.norm();
  const double most = std::max(0.0, half_spaces_.max_torque);
  if (torque > most) wrench.t_H_W *= most / torque;
  return wrench;
}

double HeldSpring::energy() const noexcept {
  const double force = size();
  return force > 0.0 ? force * (depth_ - 0.5 * force / half_spaces_.stiffness) : 0.0;
}

double HeldSpring::force_for(double joules) const noexcept {
  const double whole = half_spaces_.stiffness * depth_;  // F (2 K d − F) = 2 K E
  return whole - std::sqrt(std::max(0.0, whole * whole - 2.0 * half_spaces_.stiffness * std::max(0.0, joules)));
}

HandWrench half_space_wrench(const HalfSpaces& half_spaces, const Eigen::Isometry3d& X_WH, const Vector3d& v_WH,
                             const Vector3d& w_WH) noexcept {
  const HeldSpring spring(half_spaces, X_WH);
  if (spring.depth() == 0.0) return {};
  const double damped = half_spaces.stiffness * spring.depth() + half_spaces.damping * spring.closing(v_WH, w_WH);
  return spring.wrench(std::clamp(damped, 0.0, half_spaces.max_force));
}

double stored_energy(const HalfSpaces& half_spaces, const Eigen::Isometry3d& X_WH) noexcept {
  return HeldSpring(half_spaces, X_WH).energy();
}

}  // namespace glissade::devices
