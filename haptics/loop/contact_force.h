#pragma once

/// The force of the contacts on one hand, without jumps: from the wrenches of successive ticks, bounded by the age of
/// what is known.

#include <chrono>

#include <glissade/contact/spring.h>
#include <glissade/haptics/contact_set.h>
#include <glissade/haptics/coupling.h>

#include "loop/contact_projection.h"

namespace glissade::haptics {

/// The share of its force that a set of this age exerts: 1, then smoothly down to 0.
double force_share(std::chrono::nanoseconds age) noexcept;

/// Within this time the largest force goes to zero where the contacts demand none any more.
inline constexpr std::chrono::milliseconds kLongestFall{75};

/// From one tick to the next the wrench moves on the straight line to its new value. Two sums of normal forces have
/// only sums of normal forces between them. The share of an old set falls with its age, and bounds the force, so that
/// at kForceless there is none; what newer sets demand returns within 200 ms. Real-time safe: bounded work, no
/// allocation. Not thread-safe.
class ContactForce {
 public:
  /// For the hand's coupling to a part, no point of which is farther from the reference point than `radius` (metres).
  /// The force, and that at the radius which has the torque, never exceeds `max_force` (N), that of the device.
  ContactForce(double radius, const contact::CouplingStiffness& stiffness, double max_force)
      : radius_(radius), stiffness_(stiffness), max_force_(max_force) {}

  /// From now on the hand holds another part. The force of the last one goes on from where it is.
  void hold(double radius, const contact::CouplingStiffness& stiffness) noexcept {
    radius_ = radius;
    stiffness_ = stiffness;
  }

  /// The reference point, about which the wrench is, is elsewhere from now on: both points in the world.
  void move_reference(const Eigen::Vector3d& p_from, const Eigen::Vector3d& p_to) noexcept {
    wrench_ = contact::about_point(wrench_, p_from, p_to);
  }

  /// The wrench on the hand, `dt` (seconds) after the last call, for contacts from a set of this age. Exactly zero
  /// where no contact of the set is in the way; after a contact that vanished, within kLongestFall. Changes by at most
  /// k_t times kSlew_m a millisecond and twice the ghost's own motion (`ghost_motion`, metres since the last call), or
  /// falls by the largest force within kLongestFall, or as fast as the share of an old set. The torque counts by its
  /// force at the radius.
  const contact::Wrench& update(const PartContacts& contacts, std::chrono::nanoseconds age, double ghost_motion,
                                double dt) noexcept;

  /// The share of its force that the set may exert, which the force follows within kLongestFall: less than 1 where it
  /// is old, or where its contacts are not known any more, and for 200 ms after that.
  double share() const noexcept { return share_; }
  /// What the contacts would exert more if they were new and known; zero while `share` is 1.
  const contact::Wrench& withheld() const noexcept { return withheld_; }

 private:
  double radius_;
  contact::CouplingStiffness stiffness_;
  double max_force_;
  contact::Wrench wrench_;
  contact::Wrench withheld_;
  double share_ = 1.0;  // of its force that the set exerts
};

}  // namespace glissade::haptics
