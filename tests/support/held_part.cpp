#include "held_part.h"

#include <cmath>

#include <glissade/contact/spring.h>

#include "poses.h"

namespace glissade::test_support {

using Eigen::Isometry3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;

Isometry3d between(const Isometry3d& X_from, const Isometry3d& X_to, double t) {
  const Quaterniond q = Quaterniond(X_from.linear()).slerp(t, Quaterniond(X_to.linear()));
  return pose((1.0 - t) * X_from.translation() + t * X_to.translation(), q);
}

double length_in(const contact::CouplingStiffness& stiffness, const geometry::Displacement& d) {
  return std::sqrt(stiffness.translational * d.v.squaredNorm() + stiffness.rotational * d.w.squaredNorm());
}

}  // namespace glissade::test_support
