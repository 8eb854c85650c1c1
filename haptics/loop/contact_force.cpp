#include "loop/contact_force.h"

#include <algorithm>

namespace glissade::haptics {

namespace {

constexpr double kFastestGhost = 2.0;  // m/s; motion beyond is no reason for a faster change of the force

}  // namespace

double force_share(std::chrono::nanoseconds age) noexcept {
  const std::chrono::duration<double> fading = age - kFullForce;
  const double x = std::clamp(fading / std::chrono::duration<double>(kForceless - kFullForce), 0.0, 1.0);
  return 1.0 - x * x * (3.0 - 2.0 * x);
}

const Wrench& ContactForce::update(const ContactSet& set, std::chrono::nanoseconds age, const Eigen::Isometry3d& X_WG,
                                   double dt) noexcept {
  const double ghost_motion = geometry::motion_bound(geometry::displacement_between(X_WG_, X_WG, p_Vref_), radius_);
  X_WG_ = X_WG;
  const Wrench wanted = scaled(target(set, age, X_WG), force_share(age));

  constexpr double kSlew_m_per_s = kSlew_m / 1e-3;
  const double longest =
      stiffness_.translational * (kSlew_m_per_s * dt + 2.0 * std::min(ghost_motion, kFastestGhost * dt));
  const Wrench change{wanted.f - wrench_.f, wanted.t - wrench_.t};
  const double size = std::max(change.f.norm(), change.t.norm() / radius_);
  if (size <= longest) {
    wrench_ = wanted;
  } else {
    const Wrench step = scaled(change, longest / size);
    wrench_ = {wrench_.f + step.f, wrench_.t + step.t};
  }
  return wrench_;
}

Wrench ContactForce::target(const ContactSet& set, std::chrono::nanoseconds age,
                            const Eigen::Isometry3d& X_WG) noexcept {
  is_unsolved_ = false;
  if (set.row_count == 0) return {};
  const geometry::Displacement wanted = geometry::displacement_between(set.X_WV_of_rows, X_WG * set.X_GT, p_Vref_);
  take_rows(set, age, X_WG);
  const Projection projection = solver_.project(wanted, stiffness_, {rows_.data(), row_count_});
  is_unsolved_ = projection.status != ProjectionStatus::kSolved;
  if (is_unsolved_) return {};
  Wrench wrench;
  for (int i = 0; i < projection.active_count; ++i) {
    const auto active = static_cast<std::size_t>(projection.active[static_cast<std::size_t>(i)]);
    const ConstraintRow& row = rows_[active];
    const Eigen::Vector3d& friction_ratio = set.friction_ratio_W[numbers_[active]];
    const Eigen::Vector3d f = projection.force[static_cast<std::size_t>(i)] * (row.n + friction_ratio);
    wrench.f += f;
    wrench.t += row.r.cross(f);
  }
  return wrench;
}

// A part in contact moves across the normals as its ghost does.
void ContactForce::take_rows(const ContactSet& set, std::chrono::nanoseconds age,
                             const Eigen::Isometry3d& X_WG) noexcept {
  const double seconds =
      std::chrono::duration<double>(std::clamp<std::chrono::nanoseconds>(age, {}, kForceless)).count();
  const geometry::Displacement moved = geometry::displacement_between(set.X_WG, X_WG, p_Vref_);
  row_count_ = 0;
  for (std::size_t i = 0; i < static_cast<std::size_t>(set.row_count); ++i) {
    const ConstraintRow& row = set.row_array[i];
    const Eigen::Vector3d u = moved.v + moved.w.cross(row.r);
    const Eigen::Vector3d across = u - row.n.dot(u) * row.n;
    if (across.squaredNorm() > row.range * row.range) continue;
    rows_[row_count_] = row;
    rows_[row_count_].bound += row.approach * seconds;
    numbers_[row_count_] = i;
    ++row_count_;
  }
}

}  // namespace glissade::haptics
