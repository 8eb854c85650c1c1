#pragma once

/// Contacts after their bodies have moved, and contacts of two parts as the other part sees them.

#include <cstdint>

#include <Eigen/Geometry>

#include <glissade/contact/sliding_result.h>

namespace glissade::contact {

/// The contact after its part and its obstacle have moved, to first order. A motion maps the coordinates of a point in
/// the world before the motion to those after it.
/// The normal stays, and the range is that which is left. A vertex of the part keeps its place on the part; otherwise
/// the obstacle's point keeps its place on the obstacle.
Contact carried(const Contact& contact, const Eigen::Isometry3d& part_motion_W,
                const Eigen::Isometry3d& obstacle_motion_W = Eigen::Isometry3d::Identity());

/// A contact as the other body sees it. `own_body` is the number of the body that has the contact. The part and the
/// rider that the other body is are left as they were.
Contact mirrored(const Contact& contact, std::int32_t own_body);

}  // namespace glissade::contact
