#pragma once

/// The force of a contact set on one hand that holds one part, as the haptic thread computes it.

#include <chrono>
#include <span>

#include <Eigen/Geometry>

#include <glissade/contact/spring.h>
#include <glissade/geometry/displacement.h>
#include <glissade/haptics/contact_set.h>

#include "loop/contact_force.h"
#include "loop/contact_projection.h"

namespace glissade::test_support {

class OneHandForce {
 public:
  OneHandForce(const Eigen::Vector3d& p_Vref, double radius, const contact::CouplingStiffness& stiffness,
               double max_force, const Eigen::Isometry3d& X_WV_start)
      : p_Vref_(p_Vref),
        radius_(radius),
        stiffness_(stiffness),
        projection_(1),
        force_(radius, stiffness, max_force),
        X_WG_(X_WV_start) {}

  const contact::Wrench& update(const haptics::ContactSet& set, std::chrono::nanoseconds age,
                                const Eigen::Isometry3d& X_WG, double dt) {
    const double motion = geometry::motion_bound(geometry::displacement_between(X_WG_, X_WG, p_Vref_), radius_);
    X_WG_ = X_WG;
    const haptics::LedPart part{X_WG, set.parts[0].X_GT, stiffness_, true};
    projection_.update(set, age, {&part, 1}, dt);
    return force_.update(projection_.of_part(0), age, motion, dt);
  }

  double share() const { return force_.share(); }
  bool is_unsolved() const { return projection_.of_part(0).is_unsolved; }

 private:
  Eigen::Vector3d p_Vref_;
  double radius_;
  contact::CouplingStiffness stiffness_;
  haptics::ContactProjection projection_;
  haptics::ContactForce force_;
  Eigen::Isometry3d X_WG_;
};

}  // namespace glissade::test_support
