#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>

#include <glissade/collision/triangle_distance.h>

namespace glissade::collision {
namespace {

using Eigen::Vector3d;

// A point on each triangle and the vector from the first to the second, which is more accurate than the difference of
// the two rounded points when the coordinates are large.
struct Candidate {
  Vector3d p_a;
  Vector3d p_b;
  Vector3d gap;
  double squared_distance;
};

Candidate make_candidate(const Vector3d& p_a, const Vector3d& p_b, const Vector3d& gap) {
  return {p_a, p_b, gap, gap.squaredNorm()};
}

// A triangle with what the features share: edge i goes from corner i to corner i + 1.
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

double clamp_to_unit(double parameter) {
  return std::clamp(parameter, 0.0, 1.0);
}

// Closest points of edge i of a and edge j of b. The parameter on the first edge is that of the two lines, from cross
// products because they lose no digits on nearly parallel edges; projecting back and forth then brings both points to
// where the squared distance, convex in the two parameters, is least. Whatever parallel edges start from is as good.
Candidate edge_to_edge(const Face& a, std::size_t i, const Face& b, std::size_t j) {
  const Vector3d& along_a = a.edges[i];
  const Vector3d& along_b = b.edges[j];
  const Vector3d offset = b.corners[j] - a.corners[i];
  const Vector3d normal = along_a.cross(along_b);
  const double squared_normal = normal.squaredNorm();
  const double on_lines = squared_normal > 0.0 ? offset.cross(along_b).dot(normal) / squared_normal : 0.0;
  double s = clamp_to_unit(on_lines);
  const double t = clamp_to_unit((s * along_a - offset).dot(along_b) / b.squared_lengths[j]);
  s = clamp_to_unit((offset + t * along_b).dot(along_a) / a.squared_lengths[i]);
  return make_candidate(a.corners[i] + s * along_a, b.corners[j] + t * along_b, offset + t * along_b - s * along_a);
}

// Whether the slab across the gap between two edges keeps the triangles apart: then no other points are closer.
bool edges_are_closest(const Candidate& candidate, const Face& a, std::size_t i, const Face& b, std::size_t j) {
  return (a.corners[(i + 2) % 3] - candidate.p_a).dot(candidate.gap) <= 0.0 &&
         (b.corners[(j + 2) % 3] - candidate.p_b).dot(candidate.gap) >= 0.0;
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

// The vector from `point` to the nearest point of the face's plane, if that lies inside of the face; `inside` tells.
// A second step on the remainder removes what the rounded normal of a thin triangle spoils in the first.
Vector3d gap_to_face(const Vector3d& point, const Face& face, bool& inside) {
  const Vector3d offset = face.corners[0] - point;
  const FaceCoordinates first = face_coordinates(face, -offset);
  const Vector3d first_gap = offset + first.u * face.edges[0] - first.v * face.edges[2];
  const FaceCoordinates correction = face_coordinates(face, -first_gap);
  const double u = first.u + correction.u;
  const double v = first.v + correction.v;
  inside = u >= 0.0 && v >= 0.0 && u + v <= 1.0;
  return offset + u * face.edges[0] - v * face.edges[2];
}

void keep_closer(const Candidate& candidate, Candidate& best) {
  if (candidate.squared_distance < best.squared_distance) {
    best = candidate;
  }
}

// The closest of the 9 pairs of edges and the 6 pairs of a corner and the inside of a face.
Candidate closest_features(const Face& a, const Face& b) {
  Candidate best{};
  best.squared_distance = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      const Candidate candidate = edge_to_edge(a, i, b, j);
      if (edges_are_closest(candidate, a, i, b, j)) {
        return candidate;
      }
      keep_closer(candidate, best);
    }
  }
  bool inside = false;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vector3d a_to_b = gap_to_face(a.corners[i], b, inside);
    if (inside) {
      keep_closer(make_candidate(a.corners[i], a.corners[i] + a_to_b, a_to_b), best);
    }
    const Vector3d b_to_a = gap_to_face(b.corners[i], a, inside);
    if (inside) {
      keep_closer(make_candidate(b.corners[i] + b_to_a, b.corners[i], -b_to_a), best);
    }
  }
  return best;
}

// Where the edges of `piercing` cross the plane of `face` inside of it. `swapped` when `piercing` is the second
// triangle.
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
    const Vector3d on_face = crossing + gap;
    keep_closer(swapped ? make_candidate(on_face, crossing, -gap) : make_candidate(crossing, on_face, gap), best);
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
  // Triangles that do not meet are apart, also where the gap is lost in rounding.
  const double distance = std::max(std::sqrt(best.squared_distance), std::numeric_limits<double>::min());
  return {distance, best.p_a, best.p_b};
}

}  // namespace glissade::collision
