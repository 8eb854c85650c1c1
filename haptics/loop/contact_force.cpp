#include "loop/contact_force.h"

#include <algorithm>

namespace glissade::haptics {

namespace {

constexpr double kFastestGhost = 2.0;  // m/s; motion beyond is no reason for a faster change of the force
constexpr double kReturn_s = 0.2;
/// Metres beyond the range of a row up to which its plane may stand for what comes after it, and from which it may not.
constexpr double kKnown_m = 3e-3;
constexpr double kUnknown_m = 9e-3;

/// From 1 to 0 as x goes from `low` to `high`.
double smoothly_down(double x, double low, double high) {
  const double t = std::clamp((x - low) / (high - low), 0.0, 1.0);
  return 1.0 - t * t * (3.0 - 2.0 * t);
}

/// Metres by which the contact point of a row moves across its normal.
double across(const ConstraintRow& row, const geometry::Displacement& d) {
  const Eigen::Vector3d u = d.v + d.w.cross(row.r);
  return (u - row.n.dot(u) * row.n).norm();
}

/// N: the force or, if greater, the force at the radius that has this torque.
double size_of(const Wrench& wrench, double radius) {
  return std::max(wrench.f.norm(), wrench.t.norm() / radius);
}

/// Scaled down as a whole, so that its size is at most `most`.
Wrench limited(const Wrench& wrench, double most, double radius) {
  const double size = size_of(wrench, radius);
  return size > most ? scaled(wrench, most / size) : wrench;
}

}  // namespace

double force_share(std::chrono::nanoseconds age) noexcept {
  using Seconds = std::chrono::duration<double>;
  return smoothly_down(Seconds(age).count(), Seconds(kFullForce).count(), Seconds(kForceless).count());
}

const Wrench& ContactForce::update(const ContactSet& set, std::chrono::nanoseconds age, const Eigen::Isometry3d& X_WG,
                                   double dt) noexcept {
  const double ghost_motion = geometry::motion_bound(geometry::displacement_between(X_WG_, X_WG, p_Vref_), radius_);
  X_WG_ = X_WG;
  const Wrench all = limited(target(set, age, X_WG), max_force_, radius_);
  share_ = std::min(force_share(age) * known_, share_ + dt / kReturn_s);
  const Wrench wanted = scaled(all, share_);

  constexpr double kSlew_m_per_s = kSlew_m / 1e-3;
  double longest = stiffness_.translational * (kSlew_m_per_s * dt + 2.0 * std::min(ghost_motion, kFastestGhost * dt));
  if (size_of(wanted, radius_) < size_of(wrench_, radius_)) {
    longest = std::max(longest, max_force_ * dt / std::chrono::duration<double>(kLongestFall).count());
  }
  const Wrench change{wanted.f - wrench_.f, wanted.t - wrench_.t};
  const double size = size_of(change, radius_);
  if (size <= longest) {
    wrench_ = wanted;
  } else {
    const Wrench step = scaled(change, longest / size);
    wrench_ = {wrench_.f + step.f, wrench_.t + step.t};
  }
  wrench_ = limited(wrench_, share_ * max_force_, radius_);
  return wrench_;
}

Wrench ContactForce::target(const ContactSet& set, std::chrono::nanoseconds age,
                            const Eigen::Isometry3d& X_WG) noexcept {
  is_unsolved_ = false;
  known_ = 1.0;
  if (set.row_count == 0) return {};
  const geometry::Displacement wanted = geometry::displacement_between(set.X_WV_of_rows, X_WG * set.X_GT, p_Vref_);
  take_rows(set, age, X_WG);
  const Projection projection = solver_.project(wanted, stiffness_, {rows_.data(), row_count_});
  is_unsolved_ = projection.status != ProjectionStatus::kSolved;
  if (is_unsolved_) return {};
  Wrench wrench;
  double pushes = 0.0;
  double known_pushes = 0.0;
  for (int i = 0; i < projection.active_count; ++i) {
    const auto active = static_cast<std::size_t>(projection.active[static_cast<std::size_t>(i)]);
    const ConstraintRow& row = rows_[active];
    const Eigen::Vector3d& friction_ratio = set.friction_ratio_W[numbers_[active]];
    const double push = projection.force[static_cast<std::size_t>(i)];
    const Eigen::Vector3d f = push * (row.n + friction_ratio);
    pushes += push;
    known_pushes += push * smoothly_down(across(row, projection.displacement()) - row.range, kKnown_m, kUnknown_m);
    wrench.f += f;
    wrench.t += row.r.cross(f);
  }
  if (pushes > 0.0) known_ = known_pushes / pushes;
  return wrench;
}

// A part in contact moves across the normals as its ghost does.
void ContactForce::take_rows(const ContactSet& set, std::chrono::nanoseconds age,
                             const Eigen::Isometry3d& X_WG) noexcept {
  const double seconds =
      std::chrono::duration<double>(std::clamp<std::chrono::nanoseconds>(age, {}, kFullForce)).count();
  const geometry::Displacement moved = geometry::displacement_between(set.X_WG, X_WG, p_Vref_);
  row_count_ = 0;
  for (std::size_t i = 0; i < static_cast<std::size_t>(set.row_count); ++i) {
    const ConstraintRow& row = set.row_array[i];
    const bool pushed = i < static_cast<std::size_t>(set.pushing);
    if (!pushed && across(row, moved) > row.range) continue;
    rows_[row_count_] = row;
    rows_[row_count_].bound += row.approach * seconds;
    numbers_[row_count_] = i;
    ++row_count_;
  }
}

}  // namespace glissade::haptics
