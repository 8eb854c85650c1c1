#pragma once

/// Contacts for lists, logs and displays. Each contact keeps its number over time. Contacts in one plane are merged
/// into patches. The simulation itself uses neither the numbers nor the patches.

#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <glissade/base/export.h>
#include <glissade/contact/sliding_result.h>

namespace glissade::contact {

/// A contact with its identity. Point, normal and gap are given at the visible pose.
struct TrackedContact {
  std::int64_t id = 0;   ///< number of the contact, from 1 in order of first touch
  std::int64_t age = 0;  ///< updates since the contact got its number
  Contact contact;
};

/// Tracks the contacts of one part from one result to the next. Each part needs its own tracker. Not thread-safe.
///
/// A contact **touches** when its force is positive or its gap is at most two margins. (The margin is the gap at which
/// contacts stop the part.)
///
/// Contacts with one obstacle are merged if three conditions hold:
/// - Their normals are within 1°.
/// - Their points on the part are within a margin of each other.
/// - Their points on the obstacle are within a margin of each other.
///
/// For example, a vertex over the common edge of coplanar triangles makes a contact with each of these triangles. An
/// edge that crosses two other edges at their common vertex makes a contact with each of these two edges. The merged
/// contact takes the place of the first contact in the order of `update`. The force of the merged contact is the sum of
/// the forces of all merged contacts.
///
/// A contact gets its number when it first touches. The contact **keeps** its number while its force is positive or its
/// gap is at most three margins. So the number stays the same while the gap fluctuates around two margins. Contacts of
/// two successive updates are the same contact, with the same number, in two cases:
/// 1. Obstacle, kind, features and triangles are the same.
/// 2. Case 1 gives the old contact no successor, and the new contact continues the old one. A contact continues
///    another contact if the obstacle is the same, the normals are within 10°, the contact points on the part are at
///    most d apart, and the contact points on the obstacle are at most d apart. Here d is the sum of the motion of the
///    part at the contact, `obstacle_travel` and three margins.
///
/// By case 2, a contact keeps its number when its point passes to the next triangle or edge of a flat or smooth face.
/// When the point goes round a corner, a contact with a new number begins. If a new contact could continue several old
/// contacts, three criteria select the old contact, in this order: a feature shared with the new contact, the least
/// distance, and the greatest age.
class GLISSADE_EXPORT ContactTracker {
 public:
  /// `margin` (metres) is the margin of the simulation (see `Sliding::margin`). If obstacles have margins of their own,
  /// `margin` is the largest of all margins.
  explicit ContactTracker(double margin) : margin_(margin) {}

  /// Returns the touching contacts of `result`, in ascending order of obstacle, kind, part feature and obstacle
  /// feature. `result` must be the next result of the same simulation. A simulation may report contacts at the pose
  /// before its last step (see `SlidingResult::X_WV_of_contacts`). The tracker moves these contacts with the part to
  /// the visible pose. The moved contacts are exact if the step is a translation along a face. `obstacle_travel`
  /// (metres) bounds the motion of every point of an obstacle or another part since the last update. The returned span
  /// is valid until the next update. Cost O(n log n) for n contacts. Allocates only when there are more contacts than
  /// ever before.
  std::span<const TrackedContact> update(const SlidingResult& result, double obstacle_travel = 0.0);

  /// The touching contacts of the last update.
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

  /// A contact of the last update that has ended, and an upper bound (metres) of its points' motion since that update.
  struct Ended {
    std::int32_t index;
    double travel;
    bool continued;
  };

  double margin_;
  std::int64_t last_id_ = 0;
  Eigen::Isometry3d X_WV_ = Eigen::Isometry3d::Identity();  // of the last update
  std::vector<TrackedContact> before_;                      // sorted
  std::vector<TrackedContact> now_;                         // sorted; id 0 until it is known
  std::vector<std::int32_t> by_x_;                          // indices into `now_`
  std::vector<Ended> ended_;                                // by p_W.x
  std::vector<TrackedContact> touching_;
};

/// Contacts with one obstacle that lie in one plane.
struct ContactPatch {
  std::int64_t id = 0;  ///< the lowest id of the patch's contacts, i.e. the id of the oldest contact
  std::int32_t obstacle = 0;
  std::int32_t count = 0;  ///< number of contacts
  /// Mean of the contact points on the part (`Contact::p_W`), metres. The mean is weighted by force, or unweighted if
  /// no contact pushes.
  Eigen::Vector3d p_W = Eigen::Vector3d::Zero();
  /// Unit normal from the obstacle to the part: the mean of the contact normals. The mean is weighted by force, or
  /// unweighted if no contact pushes.
  Eigen::Vector3d n_W = Eigen::Vector3d::UnitZ();
  Eigen::Vector3d force_on_part_W = Eigen::Vector3d::Zero();  ///< newtons, friction included
  double gap = 0.0;                                           ///< smallest gap, metres
  double extent = 0.0;  ///< distance of the farthest contact point from p_W, metres
};

/// Merges contacts into patches. Not thread-safe.
///
/// The oldest contact without a patch begins a new patch as its founder. The plane of the patch goes through the
/// founder's contact point, perpendicular to the founder's normal. A contact with the same obstacle joins the patch if
/// its normal is within 10° of the founder's normal and its point is within 0.01 ρ of the plane. Here ρ is the radius
/// of the part. Distance within the plane does not matter. For example, the contacts at the four corners of a box that
/// lies flat are one patch. A patch has the id of its founder. The patch keeps this id while the founder touches and no
/// older contact joins.
class GLISSADE_EXPORT ContactPatches {
 public:
  /// `radius` (metres) is ρ, the radius of the part (`SlidingPart::radius`).
  explicit ContactPatches(double radius) : plane_tolerance_(0.01 * radius) {}

  /// Returns the patches of `contacts`, a list from `ContactTracker`, in ascending order of their ids. Each call is
  /// independent of earlier calls. The order of `contacts` affects rounding only. The returned span is valid until the
  /// next call. Cost O(n log n), plus O(n) for each patch. Allocates only when there are more contacts than ever
  /// before.
  std::span<const ContactPatch> merge(std::span<const TrackedContact> contacts);

 private:
  double plane_tolerance_;  // metres
  std::vector<std::int32_t> by_age_;
  std::vector<std::int32_t> members_;
  std::vector<ContactPatch> patches_;
};

}  // namespace glissade::contact
