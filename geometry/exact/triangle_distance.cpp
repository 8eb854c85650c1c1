#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>

#include <glissade/geometry/triangle_pair.h>

#include "exact/face_corrections.h"

namespace glissade::geometry {
namespace {

using Eigen::Vector3d;

// A point on each triangle, and the square of their distance. The distance is computed from differences of corners,
// which are more accurate than differences of the rounded points when the coordinates are large.
struct Candidate {
  Vector3d p_a;
  Vector3d p_b;
  double squared_distance;
};

// A triangle with quantities that its features share. Edge i goes from corner i to corner i + 1.
struct Face {
  explicit Face(const TrianglePoints& points)
      : corners(points),
        edges{points[1] - points[0], points[2] - points[1], points[0] - points[2]},
        squared_lengths{edges[0].squaredNorm(), edges[1].squaredNorm(), edges[2].squaredNorm()},
        normal(edges[0].cross(edges[1])),
        squared_normal(normal.squaredNorm()) {}

  const TrianglePoints& corners;
  std::array<Vector3d, 3> edges;
  std::array<double, 3> squared_lengths;
  Vector3d normal;
  double squared_normal;
};

// NaN, which is the parameter along an edge without length, becomes 0.
double clamp_to_unit(double parameter) {
  return parameter > 0.0 ? std::min(parameter, 1.0) : 0.0;
}

// Closest points of edge i of a and edge j of b: the parameters along the edges and the vector between the points.
struct EdgePair {
  double s;
  double t;
  Vector3d gap;
};

// The parameter on the first edge starts at the closest points of the two lines, by cross products, which lose no
// digits on nearly parallel edges. Projection to the second edge and back then reaches the minimum of the squared
// distance, which is convex in the two parameters. For parallel edges any start is as good.
EdgePair closest_on_edges(const Face& a, std::size_t i, const Face& b, std::size_t j) {
  const Vector3d& along_a = a.edges[i];
  const Vector3d& along_b = b.edges[j];
  const Vector3d offset = b.corners[j] - a.corners[i];
  const Vector3d normal = along_a.cross(along_b);
  const double squared_normal = normal.squaredNorm();
  const double on_lines = squared_normal > 0.0 ? offset.cross(along_b).dot(normal) / squared_normal : 0.0;
  double s = clamp_to_unit(on_lines);
  const double t = clamp_to_unit((s * along_a - offset).dot(along_b) / b.squared_lengths[j]);
  s = clamp_to_unit((offset + t * along_b).dot(along_a) / a.squared_lengths[i]);
  return {s, t, offset + t * along_b - s * along_a};
}

// Whether the slab across the gap between two edges certainly separates the third corners too: no other points are then
// closer. Certainty is required because rounding tilts a slab across a small gap, which could hide closer points far
// from the gap.
bool edges_are_closest(const EdgePair& pair, const Face& a, std::size_t i, const Face& b, std::size_t j,
                       double uncertainty) {
  const Vector3d to_corner_a = -a.edges[(i + 2) % 3] - pair.s * a.edges[i];
  const Vector3d to_corner_b = -b.edges[(j + 2) % 3] - pair.t * b.edges[j];
  return to_corner_a.dot(pair.gap) < -uncertainty && to_corner_b.dot(pair.gap) > uncertainty;
}

// Bound on the rounding error of `edges_are_closest`.
double slab_uncertainty(const Face& a, const Face& b) {
  const double reach = (b.corners[0] - a.corners[0]).lpNorm<1>() + a.edges[0].lpNorm<1>() + a.edges[2].lpNorm<1>() +
                       b.edges[0].lpNorm<1>() + b.edges[2].lpNorm<1>();
  return 16.0 * std::numeric_limits<double>::epsilon() * reach * reach;
}

// Coordinates of a vector in the basis edge 0 and minus edge 2 of a face, after projection on its plane.
struct FaceCoordinates {
  double u;
  double v;
};

FaceCoordinates face_coordinates(const Face& face, const Vector3d& vector) {
  const Vector3d turned = vector.cross(face.normal);
  return {face.edges[2].dot(turned) / face.squared_normal, face.edges[0].dot(turned) / face.squared_normal};
}

// The vector from `point` to the nearest point of the face's plane. `inside` reports whether that point lies inside the
// face.
Vector3d gap_to_face(const Vector3d& point, const Face& face, bool& inside) {
  const Vector3d offset = face.corners[0] - point;
  FaceCoordinates at = face_coordinates(face, -offset);
  const auto gap = [&]() -> Vector3d { return offset + at.u * face.edges[0] - at.v * face.edges[2]; };
  for (int i = 0; i < kFaceCorrections; ++i) {
    const FaceCoordinates correction = face_coordinates(face, -gap());
    at.u += correction.u;
    at.v += correction.v;
  }
  inside = at.u >= 0.0 && at.v >= 0.0 && at.u + at.v <= 1.0;
  return gap();
}

void keep_closer(const Vector3d& p_a, const Vector3d& p_b, const Vector3d& gap, Candidate& best) {
  const double squared_distance = gap.squaredNorm();
  if (squared_distance < best.squared_distance) {
    best = {p_a, p_b, squared_distance};
  }
}

// The closest of the 9 pairs of edges and the 6 pairs of a corner and the inside of a face.
Candidate closest_features(const Face& a, const Face& b) {
  const double uncertainty = slab_uncertainty(a, b);
  Candidate best{a.corners[0], b.corners[0], std::numeric_limits<double>::infinity()};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      const EdgePair pair = closest_on_edges(a, i, b, j);
      keep_closer(a.corners[i] + pair.s * a.edges[i], b.corners[j] + pair.t * b.edges[j], pair.gap, best);
      if (edges_are_closest(pair, a, i, b, j, uncertainty)) {
        return best;
      }
    }
  }
  bool inside = false;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vector3d a_to_b = gap_to_face(a.corners[i], b, inside);
    if (inside) {
      keep_closer(a.corners[i], a.corners[i] + a_to_b, a_to_b, best);
    }
    const Vector3d b_to_a = gap_to_face(b.corners[i], a, inside);
    if (inside) {
      keep_closer(b.corners[i] + b_to_a, b.corners[i], b_to_a, best);
    }
  }
  return best;
}

// Tries the points where edges of `piercing` cross the plane of `face` inside the face. `swapped`: `piercing` is the
// second triangle.
void keep_closer_crossings(const Face& piercing, const Face& face, bool swapped, Candidate& best) {
  for (std::size_t i = 0; i < 3; ++i) {
    const double height = (piercing.corners[i] - face.corners[0]).dot(face.normal);
    const double rise = piercing.edges[i].dot(face.normal);
    if (rise == 0.0) {
      continue;
    }
    const Vector3d crossing = piercing.corners[i] + clamp_to_unit(-height / rise) * piercing.edges[i];
    bool inside = false;
    const Vector3d gap = gap_to_face(crossing, face, inside);
    if (!inside) {
      continue;
    }
    if (swapped) {
      keep_closer(crossing + gap, crossing, gap, best);
    } else {
      keep_closer(crossing, crossing + gap, gap, best);
    }
  }
}

}  // namespace

TriangleDistance triangle_distance(const TrianglePoints& a, const TrianglePoints& b) {
  const Face face_a(a);
  const Face face_b(b);
  Candidate best = closest_features(face_a, face_b);
  if (triangles_intersect(a, b)) {
    keep_closer_crossings(face_a, face_b, false, best);
    keep_closer_crossings(face_b, face_a, true, best);
    return {0.0, best.p_a, best.p_b};
  }
  // Triangles that do not intersect have a positive distance, even where rounding loses the gap.
  const double distance = std::max(std::sqrt(best.squared_distance), std::numeric_limits<double>::min());
  return {distance, best.p_a, best.p_b};
}

}  // namespace glissade::geometry
