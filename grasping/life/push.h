#pragma once

/// How a loose part yields to hands that push it.

#include <cstdint>
#include <vector>

#include <Eigen/Geometry>

#include <glissade/contact/contact_body.h>
#include <glissade/geometry/displacement.h>

#include "clasp/slide_past.h"
#include "life/grasping_hand.h"

namespace glissade::grasping {

/// Contacts of all hands with one loose part. The part resists a little, as if it lay on something with friction: the
/// targets of segments stay `GraspingHand::kResistance_m` within it. So a segment that pushes goes on touching, and the
/// others have time to come to the part as well: an object lies on several fingers, or is held between two. What a
/// segment has moved in a late call, beyond a millisecond, does not push yet: the others have moved as well.
/// Not thread-safe.
class Push {
 public:
  /// In speeds of the fastest segment that pushes: a part that comes free goes no faster, however deep the target lies.
  /// What the hand would need to go on waits.
  static constexpr double kFastest = 1.5;
  /// Milliseconds: a call for a longer time pushes no farther. The other fingers, which have moved on meanwhile as
  /// well, come to the part after this call, and may close round it before the next one.
  static constexpr double kLongestPush_ms = 5.0;
  static constexpr double kRegularCall_ms = 1.0;
  /// Metres a millisecond: hands as slow as this stand still.
  static constexpr double kStill_m_per_ms = 1e-6;

  void clear();
  /// Adds the contacts of a hand with the part, whose number as a body is `body`, at X_WV.
  void add(const GraspingHand& hand, std::int32_t body, const Eigen::Isometry3d& X_WV,
           const contact::SlidingPart& part);
  void add(const LinkContact& touch, double link_m_per_ms, const Eigen::Vector3d& p_Wref);

  /// The shortest displacement of the part in so many milliseconds on which the targets of all hands lie no deeper than
  /// the part resists, to first order; where there is none, because they press from all sides, a balance. No point of
  /// the part, which has this radius about its reference point, moves farther than the deepest target lies, nor
  /// kFastest times as fast as the fastest segment, nor for longer than kLongestPush_ms.
  geometry::Displacement displacement(double radius, double milliseconds);

 private:
  static constexpr double kCompliance = 0.1;

  std::vector<ContactPlane> planes_;
  std::vector<double> depths_;           // of the targets
  std::vector<double> speeds_m_per_ms_;  // of the segments
  double fastest_m_per_ms_ = 0.0;
  std::vector<double> forces_;
};

}  // namespace glissade::grasping
