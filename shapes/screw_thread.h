#pragma once

/// A bolt and a nut with a metric thread: right-handed, flanks at 60°, crests cut at an eighth of the pitch and roots
/// at a quarter, as in the basic profile of ISO 68-1.
///
/// A nut of as many segments as the bolt is free on it in all poses X = rotation by 2π t about z and translation by
/// pitch t along z, and along z from there by half of the play either way: at *every* angle, also between the corners
/// of the facets. The facets of both lie on the safe side of the true thread: those of the bolt within it, and those of
/// the nut, whose radii are larger by 1 / cos(π / segments), outside. So the free way along z is at least the play, and
/// at most the play + tan 30° · diameter / 2 · (π / segments)², which adds 13 µm for the defaults. (The edges of facets
/// are straight where the thread is bent; this takes up to 1.3 pitch / segments³ away from it, here 10 nm.) Radially
/// there is as much room as the play at the crests and at the roots.
///
/// Sizes are in metres. The functions throw std::invalid_argument, naming the argument and its value, for sizes that
/// are not positive and finite or do not fit together, and for counts out of range.

#include <glissade/geometry/triangle_mesh.h>

namespace glissade::shapes {

struct ThreadShape {
  double diameter = 16e-3;  ///< outer diameter of the bolt, more than 2.2 pitches
  double pitch = 2e-3;
  int turns = 10;     ///< of this piece, 1 ... 1000
  int segments = 60;  ///< steps per turn, a multiple of 12 for a nut, 12 ... 10,000
};

/// The thread of a bolt about z, facing outward, as an open sheet: it begins at z = 0 and ends at z = turns · pitch,
/// each time with an edge that rises by one pitch around. 8 segments (turns - 1/4) triangles.
geometry::TriangleMesh make_bolt(const ThreadShape& thread);

/// A nut for that bolt: its thread, an open sheet that faces the axis, in a hexagonal sleeve of 1.5 diameters across
/// flats, with faces at z = 0 and z = (turns + 1) · pitch. The two are separate components. `play` is along z, less
/// than an eighth of the pitch.
geometry::TriangleMesh make_nut(const ThreadShape& thread, double play);

}  // namespace glissade::shapes
