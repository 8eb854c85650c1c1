#pragma once

/// Parts that no hand holds.

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include <glissade/contact/multi_part_sliding.h>
#include <glissade/contact/sliding_rules.h>

#include "life/grasping_hand.h"
#include "life/push.h"

namespace glissade::grasping {

/// A loose part stands still, released, until hands push it farther than it resists; then it follows the push, as if it
/// were grasped. Not thread-safe.
class LooseParts {
 public:
  /// Of a simulation whose parts have these metaphors.
  explicit LooseParts(std::vector<contact::Metaphor> metaphors)
      : metaphors_(std::move(metaphors)), pushes_(metaphors_.size()), is_pushed_(metaphors_.size(), 0) {}

  /// The ghost of a loose part for a call of so many milliseconds. Grasps the part in `sliding` when hands begin to
  /// push it, and releases it when they no longer do.
  Eigen::Isometry3d push(std::size_t part, double milliseconds, contact::MultiPartSliding& sliding);

  /// A hand is about to hold the part, or has let go of it: nobody pushes it.
  void end_push(std::size_t part, contact::MultiPartSliding& sliding);

  /// Looks at what hands do to a part that none of them holds. A hand that is about to take hold of it pushes it no
  /// farther, one that has just let go of it leaves it where it is, and so does one that has been lost and now comes
  /// late.
  void look(std::size_t part, std::span<const GraspingHand> hands, const contact::MultiPartSliding& sliding);

 private:
  void stop(std::size_t part, contact::MultiPartSliding& sliding);

  std::vector<contact::Metaphor> metaphors_;
  std::vector<Push> pushes_;
  std::vector<char> is_pushed_;
};

}  // namespace glissade::grasping
