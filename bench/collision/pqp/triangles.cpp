#include "triangles.h"

namespace glissade::bench::pqp {
namespace {

// Each lane is a vector of its own.
struct Vectors {
  Floats4 x;
  Floats4 y;
  Floats4 z;
};

Vectors operator-(const Vectors& a, const Vectors& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
Vectors operator+(const Vectors& a, const Vectors& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
Vectors operator*(const Vectors& a, Floats4 factor) {
  return {a.x * factor, a.y * factor, a.z * factor};
}
Floats4 dot(const Vectors& a, const Vectors& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
Vectors cross(const Vectors& a, const Vectors& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

// The vector of one lane in all lanes.
Vectors of_lane(const Vectors& a, int lane) {
  return {all(a.x[lane]), all(a.y[lane]), all(a.z[lane])};
}

// The vector of the next corner in each lane.
Vectors next(const Vectors& a) {
  return {turned(a.x), turned(a.y), turned(a.z)};
}

// Two triangles with the first corner of A as the origin: rounding is that of the triangles' size and distance.
struct TrianglePair {
  TrianglePair(const Corners& corners_A, const Corners& corners_B)
      : a{corners_A.x - corners_A.x[0], corners_A.y - corners_A.y[0], corners_A.z - corners_A.z[0]},
        b{corners_B.x - corners_A.x[0], corners_B.y - corners_A.y[0], corners_B.z - corners_A.z[0]},
        edges_A(next(a) - a),
        edges_B(next(b) - b),
        normal_A(cross(of_lane(edges_A, 0), of_lane(edges_A, 1))),
        normal_B(cross(of_lane(edges_B, 0), of_lane(edges_B, 1))) {}

  Vectors a;  // corners
  Vectors b;
  Vectors edges_A;  // from each corner to the next
  Vectors edges_B;
  Vectors normal_A;  // in all lanes
  Vectors normal_B;
};

// Gap of the projections on one axis, in units of the axis' length; negative where they overlap. All corners are
// projected, because products of edges of slivers are far from normal to them.
float gap_along(const Vectors& axis, const TrianglePair& pair) {
  const Floats4 on_A = dot(axis, pair.a);
  const Floats4 on_B = dot(axis, pair.b);
  const float B_above = least_of_three(on_B) - largest_of_three(on_A);
  const float A_above = least_of_three(on_A) - largest_of_three(on_B);
  return B_above > A_above ? B_above : A_above;
}

// Whether one of three axes, one in each lane, has separate projections.
bool separates(const Vectors& axes, const TrianglePair& pair) {
  const auto bounds = [&](const Vectors& triangle, Floats4& low, Floats4& high) {
    const Floats4 first = dot(axes, of_lane(triangle, 0));
    const Floats4 second = dot(axes, of_lane(triangle, 1));
    const Floats4 third = dot(axes, of_lane(triangle, 2));
    low = smaller(smaller(first, second), third);
    high = larger(larger(first, second), third);
  };
  Floats4 low_A;
  Floats4 high_A;
  Floats4 low_B;
  Floats4 high_B;
  bounds(pair.a, low_A, high_A);
  bounds(pair.b, low_B, high_B);
  return any_of_three((low_A > high_B) | (low_B > high_A));
}

// The 15 axes beside the normals: products of edges, and for triangles in one plane the normals of edges in the plane.
bool edges_separate(const TrianglePair& pair) {
  for (int i = 0; i < 3; ++i) {
    if (separates(cross(of_lane(pair.edges_A, i), pair.edges_B), pair)) return true;
  }
  return separates(cross(pair.normal_A, pair.edges_A), pair) || separates(cross(pair.normal_B, pair.edges_B), pair);
}

// Least squared distance of an edge of A, in all lanes, and the three edges of B.
Floats4 squared_distance_of_edges(const Vectors& corner_A, const Vectors& edge_A, const TrianglePair& pair) {
  const Vectors from_B = corner_A - pair.b;
  const Floats4 aa = dot(edge_A, edge_A);
  const Floats4 bb = dot(pair.edges_B, pair.edges_B);
  const Floats4 ab = dot(edge_A, pair.edges_B);
  const Floats4 from_B_on_A = dot(edge_A, from_B);
  const Floats4 from_B_on_B = dot(pair.edges_B, from_B);
  const Floats4 area = aa * bb - ab * ab;
  const Floats4 on_lines = (ab * from_B_on_B - from_B_on_A * bb) / area;
  const Floats4 start_A = area > Floats4{} ? clamped(on_lines, 1.0F) : Floats4{};  // parallel edges: from any point
  const Floats4 share_B = clamped((ab * start_A + from_B_on_B) / bb, 1.0F);
  const Floats4 share_A = clamped((ab * share_B - from_B_on_A) / aa, 1.0F);
  const Vectors between = from_B + edge_A * share_A - pair.edges_B * share_B;
  return dot(between, between);
}

// Squared distance of each of three corners and its foot in a triangle; `otherwise` where the foot is outside.
Floats4 squared_distance_to_face(const Vectors& points, const Vectors& corner, const Vectors& edge, const Vectors& side,
                                 const Vectors& normal, Floats4 otherwise) {
  const Vectors from_corner = points - corner;
  const Floats4 area = dot(normal, normal);
  const Floats4 along_edge = dot(cross(from_corner, side), normal) / area;
  const Floats4 along_side = dot(cross(edge, from_corner), normal) / area;
  const Vectors above = from_corner - edge * along_edge - side * along_side;
  const Truths4 inside = (along_edge >= Floats4{}) & (along_side >= Floats4{}) & (along_edge + along_side <= all(1.0F));
  return inside ? dot(above, above) : otherwise;
}

// Whether the gap along an axis, which may be long or short, is at least the root of `limit`.
bool is_beyond(float gap, const Vectors& axis, float limit) {
  return gap > 0.0F && gap * gap >= limit * dot(axis, axis)[0];
}

}  // namespace

bool overlap(const Corners& a, const Corners& b) {
  const TrianglePair pair(a, b);
  return gap_along(pair.normal_A, pair) <= 0.0F && gap_along(pair.normal_B, pair) <= 0.0F && !edges_separate(pair);
}

float squared_distance_below(float limit, const Corners& a, const Corners& b) {
  const TrianglePair pair(a, b);
  const float gap_A = gap_along(pair.normal_A, pair);
  if (is_beyond(gap_A, pair.normal_A, limit)) return limit;
  const float gap_B = gap_along(pair.normal_B, pair);
  if (is_beyond(gap_B, pair.normal_B, limit)) return limit;
  if (gap_A <= 0.0F && gap_B <= 0.0F && !edges_separate(pair)) return 0.0F;

  Floats4 least = all(limit);
  for (int i = 0; i < 3; ++i)
    least = smaller(squared_distance_of_edges(of_lane(pair.a, i), of_lane(pair.edges_A, i), pair), least);
  const auto least_to_face = [&](const Vectors& points, const Vectors& corners, const Vectors& edges,
                                 const Vectors& normal) {
    const Vectors to_third = of_lane(corners, 2) - of_lane(corners, 0);
    return squared_distance_to_face(points, of_lane(corners, 0), of_lane(edges, 0), to_third, normal, all(limit));
  };
  least = smaller(least_to_face(pair.b, pair.a, pair.edges_A, pair.normal_A), least);
  least = smaller(least_to_face(pair.a, pair.b, pair.edges_B, pair.normal_B), least);
  return least_of_three(least);
}

}  // namespace glissade::bench::pqp
