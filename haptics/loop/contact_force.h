#pragma once

/// The force of the contacts on the hand *now*, from the newest contact set, which may be some milliseconds old. It
/// gives the haptic thread a force that follows the hand at its own rate, without any collision query.

#include <array>
#include <chrono>
#include <cstddef>

#include <Eigen/Geometry>

#include <glissade/haptics/contact_set.h>
#include <glissade/haptics/coupling.h>

#include "solver/projection.h"

namespace glissade::haptics {

/// The share of its force that a set of this age exerts: 1, then smoothly down to 0.
double force_share(std::chrono::nanoseconds age) noexcept;

/// Within this time the largest force goes to zero where the contacts demand none any more.
inline constexpr std::chrono::milliseconds kLongestFall{75};

/// The wanted displacement of the part is projected on the rows of the set. The force is the sum of the multipliers
/// times the normals, with the friction that belongs to them. Rows that did not push count no
/// more once the ghost has left their `range`. The plane of one that pushed goes on; its force fades where the
/// projection is more than 3 mm beyond the range, and is zero from 9 mm on. Bodies that move go on at their speed for
/// kFullForce. So it never holds the hand back along a frictionless contact, however old the
/// set is: an old set knows too few contacts or contacts that the part has left, and their force fades.
///
/// From one tick to the next the wrench moves on the straight line to its new value. Two sums of normal forces have
/// only sums of normal forces between them. The share of an old set falls with its age and returns within 200 ms; it
/// also bounds the force, so that at kForceless there is none. Real-time safe: bounded work, no allocation. Not
/// thread-safe.
class ContactForce {
 public:
  /// For a part with the given reference point (in its frame), radius (metres) and coupling, at its start pose. The
  /// force, and that at the radius which has the torque, never exceeds `max_force` (N), that of the device.
  ContactForce(const Eigen::Vector3d& p_Vref, double radius, const CouplingStiffness& stiffness, double max_force,
               const Eigen::Isometry3d& X_WV_start)
      : p_Vref_(p_Vref),
        radius_(radius),
        stiffness_(stiffness),
        max_force_(max_force),
        solver_(kMaxContactRows),
        X_WG_(X_WV_start) {}

  /// The wrench on the hand about the reference point for ghost X_WG, `dt` (seconds) after the last call. Exactly zero
  /// where no contact of the set is in the way; after a contact that vanished, within kLongestFall. Changes by at most
  /// k_t times kSlew_m a millisecond and twice the ghost's own motion, or falls by the largest force within
  /// kLongestFall. The torque counts by its force at the radius.
  const Wrench& update(const ContactSet& set, std::chrono::nanoseconds age, const Eigen::Isometry3d& X_WG,
                       double dt) noexcept;

  /// The share of its force that the set exerted in the last call: less than 1 where it is old, or where its contacts
  /// are not known any more, and for 200 ms after that.
  double share() const noexcept { return share_; }
  /// Whether the last call found no solution, so that the force went towards zero.
  bool is_unsolved() const noexcept { return is_unsolved_; }

 private:
  Wrench target(const ContactSet& set, std::chrono::nanoseconds age, const Eigen::Isometry3d& X_WG) noexcept;
  void take_rows(const ContactSet& set, std::chrono::nanoseconds age, const Eigen::Isometry3d& X_WG) noexcept;

  Eigen::Vector3d p_Vref_;
  double radius_;
  CouplingStiffness stiffness_;
  double max_force_;
  ProjectionSolver solver_;
  std::array<ConstraintRow, kMaxContactRows> rows_{};   // in range, as they are now
  std::array<std::size_t, kMaxContactRows> numbers_{};  // of these rows in the set
  std::size_t row_count_ = 0;
  Eigen::Isometry3d X_WG_;
  Wrench wrench_;
  double known_ = 1.0;  // share of the force whose rows are known to hold at the projection
  double share_ = 1.0;  // of its force that the set exerts
  bool is_unsolved_ = false;
};

}  // namespace glissade::haptics
