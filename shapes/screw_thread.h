#pragma once

/// A bolt and a nut with a right-handed metric thread. As in the basic profile of ISO 68-1, the angle between flanks is
/// 60°, crests are flats of pitch / 8, and roots are flats of pitch / 4.
///
/// The screw motion is a rotation by 2π · t about z and a translation by pitch · t along z. For every t, a nut with as
/// many segments as the bolt is clear of the bolt, even if its corners lie between the bolt's corners. From each of
/// these poses, the nut can move along z by half of the play in either direction. The bolt's facets lie inside the true
/// thread. The nut's facets lie outside the true thread, with radii larger by the factor 1 / cos(π / segments). So the
/// free displacement along z is at least the play, and at most the play + tan 30° · diameter / 2 · (π / segments)². The
/// second term is 13 µm for the defaults. Straight edges of facets reduce the free displacement by up to 1.3 · pitch /
/// segments³, here 10 nm. The radial clearance at the crests and at the roots equals the play.
///
/// Sizes are in metres. The functions throw std::invalid_argument, naming the argument and its value, if a size is not
/// positive and finite, if sizes do not fit together, or if a count is out of range.

#include <glissade/geometry/triangle_mesh.h>

namespace glissade::shapes {

struct ThreadShape {
  double diameter = 16e-3;  ///< outer diameter of the bolt, more than 2.2 pitches
  double pitch = 2e-3;
  int turns = 10;     ///< turns of the thread, 1 ... 1000
  int segments = 60;  ///< facets per turn, 12 ... 10,000; a multiple of 12 for a nut
};

/// The thread of a bolt about z, as an open sheet that faces outward, from z = 0 to z = turns · pitch. The lower and
/// the upper border each rise by one pitch around the axis. The mesh has 8 · segments · (turns - 1/4) triangles.
geometry::TriangleMesh make_bolt(const ThreadShape& thread);

/// A nut for this bolt, of two separate components. The thread is an open sheet that faces the axis. The hexagonal
/// sleeve is 1.5 diameters wide across flats, with end faces at z = 0 and z = (turns + 1) · pitch. `play` is measured
/// along z, and must be less than an eighth of the pitch.
geometry::TriangleMesh make_nut(const ThreadShape& thread, double play);

}  // namespace glissade::shapes
