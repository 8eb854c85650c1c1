#pragma once

/// The shapes of the segments of a right hand, in their own frames (`HandModel`): closed, smooth, oriented meshes.

#include <glissade/geometry/triangle_mesh.h>

namespace glissade::grasping {

/// Half of a section's width over its height, at the joints of fingers: fingers are a little flatter than round.
inline constexpr double kFingerFlatness = 0.93;

/// A segment between two joints, with these radii (m) there. Its ends are round about the joints, so that it goes over
/// into its neighbors at any angle.
geometry::TriangleMesh phalanx_mesh(double length, double start_radius, double end_radius);

/// An outer segment: a full pad below, flat above where the nail is, and rounded at x = length.
geometry::TriangleMesh fingertip_mesh(double length, double radius);

/// The metacarpal with the ball of the thumb.
geometry::TriangleMesh thumb_metacarpal_mesh(double length, double hand_breadth);

/// The metacarpals of ring finger and little finger, from CMC joint to knuckle, with the flesh about them.
geometry::TriangleMesh ring_metacarpal_mesh(double length, double hand_breadth);
geometry::TriangleMesh little_metacarpal_mesh(double length, double hand_breadth);

/// The rigid part of the palm: the carpus and the metacarpals of index and middle finger.
geometry::TriangleMesh palm_mesh(double hand_length, double hand_breadth);

}  // namespace glissade::grasping
