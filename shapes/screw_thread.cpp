#include <array>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include <glissade/base/require.h>
#include <glissade/geometry/triangle_mesh.h>
#include <glissade/shapes/screw_thread.h>

#include "surfaces/loop_mesh.h"

namespace glissade::shapes {
namespace {

// Radii and heights, within one pitch, of the four helices at the edges of a thread: the beginning and the end of the
// lower flank, and those of the upper flank.
struct ThreadProfile {
  std::array<double, 4> radius;
  std::array<double, 4> height;
};

// Radial depth of the thread: 5/8 of the height of the sharp triangle.
double thread_depth(double pitch) {
  return 5.0 / 8.0 * std::sqrt(3.0) / 2.0 * pitch;
}

// The profile of the bolt, widened by half of `play` at either side, and by `play` at crest and root.
ThreadProfile profile_of(const ThreadShape& thread, double play) {
  const double crest = thread.diameter / 2 + play;
  const double root = crest - thread_depth(thread.pitch);
  // A flank that is moved by `play` along the radius is moved by play tan 30° along the axis.
  const double widening = play / 2 - play / std::sqrt(3.0);
  const double crest_half = thread.pitch / 16 + widening;
  const double root_half = 3 * thread.pitch / 8 + widening;
  const double middle = thread.pitch / 2;
  return {{root, crest, crest, root},
          {middle - root_half, middle - crest_half, middle + crest_half, middle + root_half}};
}

enum class Material { kInside, kOutside };

// Quadrilaterals between neighboring helices. A flank is a saddle, so the diagonal that halves a quadrilateral decides
// on which side of the true flank its triangles lie. Both flanks of a thread need the same diagonal, so that all
// triangles lie on the side of the material. The sheet faces away from the material.
geometry::TriangleMesh helical_sheet(const ThreadShape& thread, const ThreadProfile& profile, double scale,
                                     Material material) {
  const int steps = thread.turns * thread.segments;
  geometry::TriangleMesh mesh;
  for (std::size_t helix = 0; helix < 4; ++helix) {
    for (int i = 0; i <= steps; ++i) {
      // Each turn repeats the coordinates of the first to the bit.
      const double angle = 2 * std::numbers::pi * (i % thread.segments) / thread.segments;
      const double radius = scale * profile.radius[helix];
      mesh.vertices.emplace_back(radius * std::cos(angle), radius * std::sin(angle),
                                 profile.height[helix] + thread.pitch * i / thread.segments);
    }
  }
  const auto vertex = [&](int helix, int i) { return static_cast<std::int32_t>(helix * (steps + 1) + i); };
  const auto add = [&](std::int32_t p, std::int32_t q, std::int32_t r) {
    if (material == Material::kOutside) std::swap(q, r);
    mesh.triangles.push_back({p, q, r});
  };
  for (int helix = 0; helix < 4; ++helix) {
    const int next = (helix + 1) % 4;
    const int lead = next == 0 ? thread.segments : 0;  // the root leads to the next turn
    for (int i = 0; i + 1 + lead <= steps; ++i) {
      const std::int32_t a0 = vertex(helix, i);
      const std::int32_t a1 = vertex(helix, i + 1);
      const std::int32_t b0 = vertex(next, i + lead);
      const std::int32_t b1 = vertex(next, i + 1 + lead);
      if (material == Material::kInside) {
        add(a0, a1, b0);
        add(a1, b1, b0);
      } else {
        add(a0, a1, b1);
        add(a0, b1, b0);
      }
    }
  }
  return mesh;
}

void check(const ThreadShape& thread, int multiple) {
  base::require_positive("diameter", thread.diameter);
  base::require_positive("pitch", thread.pitch);
  base::require_below("2.2 pitches", 2.2 * thread.pitch, "the diameter", thread.diameter);
  base::require_count("turns", thread.turns, 1, 1000);
  base::require_count("segments", thread.segments, 12, 10'000, multiple);
}

geometry::TriangleMesh hexagonal_sleeve(const Loop& hole, double across_flats, double height) {
  const Loop hexagon = polygon_loop(6, across_flats / 2, static_cast<int>(hole.size()));
  LoopMesh mesh;
  const int lower_hole = mesh.add_loop(hole, 0.0);
  const int lower = mesh.add_loop(hexagon, 0.0);
  mesh.add_band(lower_hole, lower);
  const int upper = mesh.add_wall(lower, hexagon, 0.0, height, 1);
  mesh.add_band(upper, mesh.add_loop(hole, height));
  return mesh.mesh();
}

}  // namespace

geometry::TriangleMesh make_bolt(const ThreadShape& thread) {
  check(thread, 1);
  return helical_sheet(thread, profile_of(thread, 0.0), 1.0, Material::kInside);
}

geometry::TriangleMesh make_nut(const ThreadShape& thread, double play) {
  check(thread, 12);
  base::require_positive("play", play);
  base::require_below("play", play, "an eighth of the pitch", thread.pitch / 8);
  const ThreadProfile profile = profile_of(thread, play);
  const double scale = 1.0 / std::cos(std::numbers::pi / thread.segments);
  const Loop hole = round_loop(profile.radius[1], thread.segments);
  const std::vector<geometry::TriangleMesh> components{
      helical_sheet(thread, profile, scale, Material::kOutside),
      hexagonal_sleeve(hole, 1.5 * thread.diameter, (thread.turns + 1) * thread.pitch)};
  return geometry::merge(components);
}

}  // namespace glissade::shapes
