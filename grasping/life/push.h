#pragma once

/// How a loose part yields to hands that push it.

#include <cstddef>
#include <cstdint>
#include <vector>

#include <Eigen/Geometry>

#include <glissade/geometry/displacement.h>
#include <glissade/grasping/clasp.h>
#include <glissade/haptics/contact_body.h>

#include "clasp/slide_past.h"

namespace glissade::grasping {

/// Contacts of all hands with one part. A loose part resists a little, as if it lay on something with friction: the
/// targets of segments stay kPress_m within it. So a segment that pushes goes on touching, and the others have time to
/// come to the part as well: an object lies on several fingers, or is held between two. Not thread-safe.
class Push {
 public:
  static constexpr double kPress_m = 1e-3;

  void clear() { planes_.clear(); }
  /// Adds the contacts of a hand with the part, whose number as a body is `body`, at X_WV.
  void add(const std::vector<LinkContact>& contacts, std::int32_t body, const Eigen::Isometry3d& X_WV,
           const haptics::SlidingPart& part);
  bool is_empty() const { return planes_.empty(); }

  /// The shortest displacement of the part on which the targets of all hands lie no deeper than kPress_m, to first
  /// order; where there is none, because they press from all sides, a balance. No point of the part, which has this
  /// radius about its reference point, moves farther than the deepest target lies.
  geometry::Displacement displacement(double radius);

 private:
  static constexpr double kCompliance = 0.1;

  std::vector<ContactPlane> planes_;
  std::vector<double> forces_;
};

}  // namespace glissade::grasping
