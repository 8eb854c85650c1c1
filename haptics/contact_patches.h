#pragma once

/// Contacts merged for display: one arrow where a hundred vertices of two flush faces touch.

#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

#include <glissade/haptics/contact_tracker.h>

namespace glissade::haptics {

/// Contacts with one obstacle that lie in one plane.
struct ContactPatch {
  std::int64_t id = 0;  ///< that of its oldest contact, the one with the lowest number
  std::int32_t obstacle = 0;
  std::int32_t count = 0;  ///< of contacts
  Eigen::Vector3d p_W =
      Eigen::Vector3d::Zero();  ///< centre of the forces on the part; where nothing pushes, the mean of the points
  Eigen::Vector3d n_W = Eigen::Vector3d::UnitZ();  ///< unit, from the obstacle to the part: the mean of the normals,
                                                   ///< weighted in the same way
  Eigen::Vector3d force_on_part_W = Eigen::Vector3d::Zero();  ///< newtons, friction included
  double gap = 0.0;                                           ///< the least, metres
  double extent = 0.0;  ///< how far the furthest contact point is from p_W, metres
};

/// Merges contacts. Not thread-safe.
///
/// The oldest contact that belongs to no patch yet founds one. Every contact with the same obstacle joins it whose
/// normal is within 10° of the founder's, and whose point is no further than 1 % of ρ from the plane through the
/// founder's point. How far apart they are within that plane does not matter, as the four corners of a box that lies
/// flat are one patch. Patches keep their founders as long as these touch, and so their ids.
class ContactPatches {
 public:
  /// `radius` (metres) is ρ of the part.
  explicit ContactPatches(double radius) : plane_tolerance_(0.01 * radius) {}

  /// The patches of `contacts`, which `ContactTracker` tells, in ascending order of their ids. Nothing is remembered
  /// from one call to the next, and the order of `contacts` matters to rounding only. Valid until the next call.
  /// Cost O(n log n) and O(n) for each patch; allocates only when there are more contacts than ever before.
  std::span<const ContactPatch> merge(std::span<const TrackedContact> contacts);

 private:
  double plane_tolerance_;  // metres
  std::vector<std::int32_t> by_age_;
  std::vector<std::int32_t> members_;
  std::vector<ContactPatch> patches_;
};

}  // namespace glissade::haptics
