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

/// Contacts of all hands with one part. Not thread-safe.
class Push {
 public:
  void clear() { planes_.clear(); }
  /// Adds the contacts of a hand with the part, whose number as a body is `body`, at X_WV.
  void add(const std::vector<LinkContact>& contacts, std::int32_t body, const Eigen::Isometry3d& X_WV,
           const haptics::SlidingPart& part);
  bool is_empty() const { return planes_.empty(); }

  /// The shortest displacement of the part on which the targets of all hands have room, to first order; where they have
  /// none, because they press from all sides, a balance. No point of the part, which has this radius about its
  /// reference point, moves farther than the deepest target lies.
  geometry::Displacement displacement(double radius);

 private:
  static constexpr double kCompliance = 0.1;

  std::vector<ContactPlane> planes_;
  std::vector<double> forces_;
};

}  // namespace glissade::grasping
