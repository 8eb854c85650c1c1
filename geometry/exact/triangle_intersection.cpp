#include <utility>

#include <glissade/base/assert.h>
#include <glissade/geometry/triangle_pair.h>

#include "exact/orientation.h"
#include "exact/triangle_filter.h"

namespace glissade::geometry {
namespace {

using Eigen::Vector3d;

// The sides of a triangle's plane on which the corners of another triangle lie.
struct Sides {
  int s0;
  int s1;
  int s2;

  bool all_on_one_side() const { return (s0 > 0 && s1 > 0 && s2 > 0) || (s0 < 0 && s1 < 0 && s2 < 0); }
  bool all_in_plane() const { return s0 == 0 && s1 == 0 && s2 == 0; }
};

Sides sides_of_plane(const TrianglePoints& plane, const TrianglePoints& triangle) {
  return {orient3d_sign(plane[0], plane[1], plane[2], triangle[0]),
          orient3d_sign(plane[0], plane[1], plane[2], triangle[1]),
          orient3d_sign(plane[0], plane[1], plane[2], triangle[2])};
}

// The corners of a triangle, with `apex` apart from the others: the plane of the other triangle weakly separates it
// from `left` and `right`, and contains neither edge from the apex. So each of these edges crosses the plane in exactly
// one point.
struct Apex {
  const Vector3d* apex;
  const Vector3d* left;
  const Vector3d* right;
  bool above;  // the apex is on the positive side of the plane, or in it with the others on the negative side
};

Apex find_apex(const TrianglePoints& t, const Sides& s) {
  // A corner in the plane is apart if the two others are strictly on one side; it is then the only point in the plane.
  // Any other corner is apart if none of the others is strictly on its side.
  const auto apart = [](int apex, int left, int right) {
    if (apex == 0) {
      return left * right > 0;
    }
    return apex * left <= 0 && apex * right <= 0;
  };
  if (apart(s.s0, s.s1, s.s2)) {
    return {&t[0], &t[1], &t[2], s.s0 > 0 || (s.s0 == 0 && s.s1 < 0)};
  }
  if (apart(s.s1, s.s2, s.s0)) {
    return {&t[1], &t[2], &t[0], s.s1 > 0 || (s.s1 == 0 && s.s2 < 0)};
  }
  return {&t[2], &t[0], &t[1], s.s2 > 0 || (s.s2 == 0 && s.s0 < 0)};
}

// Each triangle meets the common line of the two planes in an interval, whose ends lie on the two edges from its apex.
// With each apex on the positive side of the other's plane, the orientation of two edges gives the order of their ends
// along the line, and the intervals are [left, right] for a and [right, left] for b. After P. Guigue and O. Devillers,
// "Fast and robust triangle-triangle overlap test using orientation predicates", 2003.
bool intervals_overlap(Apex a, Apex b) {
  // Seen from the other side, a triangle has the opposite orientation.
  if (!a.above) {
    std::swap(b.left, b.right);
  }
  if (!b.above) {
    std::swap(a.left, a.right);
  }
  return orient3d_sign(*a.apex, *a.left, *b.apex, *b.left) <= 0 &&
         orient3d_sign(*a.apex, *a.right, *b.apex, *b.right) >= 0;
}

// Whether all of `other` is strictly outside some edge of `t`, in the projection along `axis`; `turn` is the
// orientation of `t` in it.
bool edge_separates(const TrianglePoints& t, int turn, const TrianglePoints& other, int axis) {
  for (std::size_t i = 0; i < 3; ++i) {
    const Vector3d& from = t[i];
    const Vector3d& to = t[(i + 1) % 3];
    if (turn * orient2d_sign(from, to, other[0], axis) < 0 && turn * orient2d_sign(from, to, other[1], axis) < 0 &&
        turn * orient2d_sign(from, to, other[2], axis) < 0) {
      return true;
    }
  }
  return false;
}

// Two triangles in one plane are projected along an axis that is not parallel to it, so that both keep an area. Two
// convex polygons are disjoint if and only if an edge of one separates them.
bool coplanar_triangles_intersect(const TrianglePoints& a, const TrianglePoints& b) {
  for (int axis = 0; axis < 3; ++axis) {
    const int turn_a = orient2d_sign(a[0], a[1], a[2], axis);
    if (turn_a == 0) {
      continue;
    }
    const int turn_b = orient2d_sign(b[0], b[1], b[2], axis);
    return !edge_separates(a, turn_a, b, axis) && !edge_separates(b, turn_b, a, axis);
  }
  return false;
}

bool between(const Vector3d& p, const Vector3d& q, const Vector3d& x) {
  return (p.cwiseMin(q).array() <= x.array()).all() && (x.array() <= p.cwiseMax(q).array()).all();
}

// A triangle without area is a segment: two of its corners have the third between them.
std::array<Vector3d, 2> ends_of(const TrianglePoints& flat) {
  if (between(flat[0], flat[1], flat[2])) {
    return {flat[0], flat[1]};
  }
  if (between(flat[1], flat[2], flat[0])) {
    return {flat[1], flat[2]};
  }
  return {flat[2], flat[0]};
}

// As `coplanar_triangles_intersect`, for a segment in the plane of a triangle.
bool coplanar_segment_meets(const std::array<Vector3d, 2>& s, const TrianglePoints& t) {
  for (int axis = 0; axis < 3; ++axis) {
    const int turn = orient2d_sign(t[0], t[1], t[2], axis);
    if (turn == 0) {
      continue;
    }
    for (std::size_t i = 0; i < 3; ++i) {
      const Vector3d& from = t[i];
      const Vector3d& to = t[(i + 1) % 3];
      if (turn * orient2d_sign(from, to, s[0], axis) < 0 && turn * orient2d_sign(from, to, s[1], axis) < 0) {
        return false;
      }
    }
    const int side0 = orient2d_sign(s[0], s[1], t[0], axis);
    const int side1 = orient2d_sign(s[0], s[1], t[1], axis);
    const int side2 = orient2d_sign(s[0], s[1], t[2], axis);
    return !Sides{side0, side1, side2}.all_on_one_side();
  }
  return false;
}

bool segment_meets(const std::array<Vector3d, 2>& s, const TrianglePoints& t) {
  const int start = orient3d_sign(t[0], t[1], t[2], s[0]);
  const int end = orient3d_sign(t[0], t[1], t[2], s[1]);
  if (start == 0 && end == 0) {
    return coplanar_segment_meets(s, t);
  }
  if (start * end > 0) {
    return false;
  }
  // The segment crosses the plane. Its line passes through the triangle if and only if it has all edges on the same
  // side.
  const int edge0 = orient3d_sign(s[0], s[1], t[0], t[1]);
  const int edge1 = orient3d_sign(s[0], s[1], t[1], t[2]);
  const int edge2 = orient3d_sign(s[0], s[1], t[2], t[0]);
  return (edge0 >= 0 && edge1 >= 0 && edge2 >= 0) || (edge0 <= 0 && edge1 <= 0 && edge2 <= 0);
}

}  // namespace

bool is_degenerate(const TrianglePoints& triangle) {
  return orient2d_sign(triangle[0], triangle[1], triangle[2], 0) == 0 &&
         orient2d_sign(triangle[0], triangle[1], triangle[2], 1) == 0 &&
         orient2d_sign(triangle[0], triangle[1], triangle[2], 2) == 0;
}

bool triangles_intersect(const TrianglePoints& a, const TrianglePoints& b) {
  const Verdict verdict = filtered_intersection(a, b);
  if (verdict != Verdict::kUnsure) {
    return verdict == Verdict::kIntersect;
  }
  GLISSADE_ASSERT(!is_degenerate(a));  // where the filter is sure, the area does not matter
  if (is_degenerate(b)) {
    return segment_meets(ends_of(b), a);
  }
  const Sides sides_a = sides_of_plane(b, a);
  if (sides_a.all_on_one_side()) {
    return false;
  }
  if (sides_a.all_in_plane()) {
    return coplanar_triangles_intersect(a, b);
  }
  const Sides sides_b = sides_of_plane(a, b);
  if (sides_b.all_on_one_side()) {
    return false;
  }
  return intervals_overlap(find_apex(a, sides_a), find_apex(b, sides_b));
}

}  // namespace glissade::geometry
