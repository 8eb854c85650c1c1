#pragma once

/// Contacts for lists, logs and displays: each with a number that it keeps over time, and merged into patches. The
/// simulation itself needs neither.

#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <glissade/haptics/sliding_result.h>

namespace glissade::haptics {

/// A contact with its identity. Point, normal and gap are those at the visible pose.
struct TrackedContact {
  std::int64_t id = 0;   ///< from 1 on; each new contact has the next number
  std::int64_t age = 0;  ///< updates since it got the number
  Contact contact;
};

/// Follows the contacts of one part from one result to the next; of several parts each has a tracker. Not thread-safe.
///
/// A contact **touches** when it pushes or its gap is at most two margins: contacts hold the part one margin away.
///
/// Contacts with one obstacle whose points lie within a margin and whose normals within 1° are **one** to the user: a
/// vertex over the seam of several triangles of a plane, each of which counts it as over its inside, or an edge that
/// crosses two others at the vertex they share. The one that comes first in the order of the list stands for all, with
/// the sum of their forces.
///
/// A contact gets its number when it first touches, and **keeps** it until it neither pushes nor is nearer than three
/// margins, so that one that flickers about the limit stays the same. It is the same contact from one update to the
/// next when
/// - obstacle, kind and features are the same; or else
/// - it takes the place of one that has ended in the same update, of the same obstacle, with both contact points no
///   further from the old ones than the part's motion there has carried that point (and three margins), and a normal
///   within 10°. So a contact stays the same when its point passes from one triangle or edge to the next on a flat or
///   smooth face, and becomes another where it goes round a corner. Of several that have ended, it continues one with
///   which it has a feature in common, then the nearest, then the oldest.
class ContactTracker {
 public:
  /// `margin` (metres) is that of the simulation, see `SlidingSimulation::margin`; where obstacles have margins of
  /// their own, the greatest.
  explicit ContactTracker(double margin) : margin_(margin) {}

  /// The contacts that touch according to `result`, the next result of the same simulation, in ascending order of
  /// obstacle, kind, the part's feature and the obstacle's. Simulations tell their contacts as
  /// they were before the last cycle moved the part; here they are carried along with it, which is exact for
  /// translations along a face. `obstacle_travel` (metres): no point of an obstacle or another part has moved more
  /// since the last update. Valid until the next update. Cost O(n log n) for n contacts; allocates only when there are
  /// more than ever before.
  std::span<const TrackedContact> update(const SlidingResult& result, double obstacle_travel = 0.0);

  /// The contacts of the last update.
  std::span<const TrackedContact> contacts() const { return touching_; }

 private:
  void take(const SlidingResult& result);
  void unite_coincident();
  void match_features();
  void match_places(const Eigen::Isometry3d& X_WV, double obstacle_travel);
  std::int32_t predecessor_of(const Contact& contact, double widest) const;
  void number_new_ones();

  bool touches(const Contact& contact) const { return contact.force > 0.0 || contact.gap <= 2.0 * margin_; }
  bool lasts(const Contact& contact) const { return contact.force > 0.0 || contact.gap <= 3.0 * margin_; }

  /// A contact of the last update that has ended, and how far its points can have come since.
  struct Ended {
    std::int32_t index;
    double travel;
    bool continued;
  };

  double margin_;
  std::int64_t last_id_ = 0;
  Eigen::Isometry3d X_WV_ = Eigen::Isometry3d::Identity();  // of the last update
  std::vector<TrackedContact> before_;                      // in order
  std::vector<TrackedContact> now_;                         // in order; id 0 until it is known
  std::vector<std::int32_t> by_x_;                          // numbers in `now_`
  std::vector<Ended> ended_;                                // by p_W.x
  std::vector<TrackedContact> touching_;
};

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
