#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include <Eigen/Geometry>

#include <glissade/base/assert.h>
#include <glissade/collision/convex_hull.h>

#include "hull/qhull_facets.h"

namespace glissade::collision {
namespace {

using Eigen::Vector3d;
using Points = std::span<const Vector3d>;

// Relative to all coordinates that take part. A thinner set of points is a hull of fewer dimensions, and its thickness
// is part of `outside`.
constexpr double kRoundingOfPoints = 1e-15;

// Bound on s + t of `climbing_error_of`, times the altitude of the facets: Qhull's points are 3 across, and the height
// of a facet above a point is not greater.
constexpr double kReachOfFacets = 12.0;

std::vector<Vector3d> corners_of(const geometry::TriangleMesh& mesh) {
  std::vector<bool> is_used(mesh.vertices.size(), false);
  for (const geometry::Triangle& triangle : mesh.triangles) {
    for (const std::int32_t index : triangle) {
      GLISSADE_ASSERT(index >= 0 && static_cast<std::size_t>(index) < is_used.size());
      is_used[static_cast<std::size_t>(index)] = true;
    }
  }
  std::vector<Vector3d> corners;
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    if (is_used[i]) corners.push_back(mesh.vertices[i]);
  }
  return corners;
}

// The index of the point with the greatest `value`.
template <typename Value>
std::size_t farthest_of(Points points, const Value& value) {
  std::size_t best = 0;
  double most = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double v = value(points[i]);
    if (v > most) {
      most = v;
      best = i;
    }
  }
  return best;
}

// Extents of a set of points along three axes: from a point to the one farthest from it, from the line through both to
// the point farthest from that, and from the plane of the first two axes.
struct Extents {
  std::array<std::size_t, 2> ends;
  std::array<Vector3d, 3> axis;    ///< orthonormal
  std::array<double, 3> beyond{};  ///< metres, largest first
};

Extents extents_of(Points points) {
  Extents e{};
  e.ends[0] = farthest_of(points, [&](const Vector3d& x) { return (x - points[0]).squaredNorm(); });
  const Vector3d& origin = points[e.ends[0]];
  e.ends[1] = farthest_of(points, [&](const Vector3d& x) { return (x - origin).squaredNorm(); });
  e.axis = {Vector3d::UnitX(), Vector3d::UnitY(), Vector3d::UnitZ()};
  e.beyond[0] = (points[e.ends[1]] - origin).norm();
  if (!(e.beyond[0] > 0.0)) return e;
  e.axis[0] = (points[e.ends[1]] - origin) / e.beyond[0];

  const auto off_line = [&](const Vector3d& x) -> Vector3d {
    const Vector3d d = x - origin;
    return d - d.dot(e.axis[0]) * e.axis[0];
  };
  const Vector3d side =
      off_line(points[farthest_of(points, [&](const Vector3d& x) { return off_line(x).squaredNorm(); })]);
  e.beyond[1] = side.norm();
  e.axis[1] = e.beyond[1] > 0.0 ? Vector3d(side / e.beyond[1]) : e.axis[0].unitOrthogonal();
  e.axis[1] = (e.axis[1] - e.axis[1].dot(e.axis[0]) * e.axis[0]).normalized();

  e.axis[2] = e.axis[0].cross(e.axis[1]);
  for (const Vector3d& x : points)
    e.beyond[2] = std::max(e.beyond[2], std::abs((x - origin).dot(e.axis[2])));
  return e;
}

// Coordinates along the first `dimension` axes, relative to the middle and scaled to extents of 1. Neighbors on a hull
// stay neighbors under any stretching, and Qhull never sees flat input.
std::vector<double> unit_coordinates(Points points, const Extents& extents, int dimension) {
  const Vector3d origin = 0.5 * (points[extents.ends[0]] + points[extents.ends[1]]);
  std::vector<double> coordinates;
  coordinates.reserve(points.size() * static_cast<std::size_t>(dimension));
  for (const Vector3d& x : points) {
    for (std::size_t i = 0; i < static_cast<std::size_t>(dimension); ++i)
      coordinates.push_back((x - origin).dot(extents.axis[i]) / extents.beyond[i]);
  }
  return coordinates;
}

// Both directions of every edge, in order.
std::vector<std::array<std::int32_t, 2>> edges_of(const std::vector<std::array<std::int32_t, 3>>& facets) {
  std::vector<std::array<std::int32_t, 2>> edges;
  for (const auto& facet : facets) {
    for (std::size_t i = 0; i < 3; ++i) {
      const std::int32_t a = facet[i];
      const std::int32_t b = facet[(i + 1) % 3];
      if (a < 0 || b < 0) continue;
      edges.push_back({a, b});
      edges.push_back({b, a});
    }
  }
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  return edges;
}

// Bound of the climbing error. Let climbing stop at v, where no edge e rises by more than δ, an amount that rounding
// hides, and let x be higher. Everything below the facets of v lies in the cone of its edges, so vertically above x
// there is a point v + s a + t b of a facet with edges a and b, with s and t not negative. It is higher than v by at
// most (s + t) δ. s + t is at most its distance from v, divided by the distance of v from the opposite side. Stretching
// changes neither s nor t. The facets are not exactly convex to each other, and the coordinates given to Qhull are
// rounded: that adds the terms of `outside`.
double climbing_error_of(const HullFacets& hull, double reach, double outside) {
  return 4.0 * outside + kReachOfFacets / hull.altitude * 4.0 * kRoundingOfPoints * reach;
}

void check(Points points) {
  if (points.empty()) throw std::invalid_argument("there are no points to make a convex hull of");
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!points[i].allFinite()) {
      throw std::invalid_argument("point " + std::to_string(i) +
                                  " of a convex hull has a coordinate that is not finite");
    }
  }
}

}  // namespace

ConvexHull::ConvexHull(Points points) {
  check(points);
  const HullFacets facets = find_corners(points);
  Eigen::Array3d low = Eigen::Array3d::Constant(std::numeric_limits<double>::infinity());
  Eigen::Array3d high = -low;
  for (const Vector3d& x : vertices_) {
    low = low.min(x.array());
    high = high.max(x.array());
  }
  center_ = 0.5 * (low + high).matrix();
  for (const Vector3d& x : vertices_) {
    radius_ = std::max(radius_, (x - center_).norm());
    reach_ = std::max(reach_, x.norm());
  }
  find_starts();
  climbing_error_ = dimension_ < 2 ? 4.0 * kRoundingOfPoints * reach_ : climbing_error_of(facets, reach_, outside_);
}

std::int32_t ConvexHull::farthest(const Vector3d& direction) const {
  return static_cast<std::int32_t>(farthest_of(vertices_, [&](const Vector3d& x) { return direction.dot(x); }));
}

ConvexHull::ConvexHull(const geometry::TriangleMesh& mesh) : ConvexHull(Points(corners_of(mesh))) {}

HullFacets ConvexHull::find_corners(Points points) {
  const Extents extents = extents_of(points);
  const double size = extents.beyond[0];
  const double rounding = kRoundingOfPoints * (size + points[0].norm());
  HullFacets hull;
  for (dimension_ = 3; dimension_ >= 2; --dimension_) {
    if (!(extents.beyond[static_cast<std::size_t>(dimension_ - 1)] > 4.0 * rounding)) continue;
    std::vector<double> coordinates = unit_coordinates(points, extents, dimension_);
    hull = qhull_facets(coordinates, dimension_);
    if (!hull.facets.empty()) break;
  }
  const double flatness = dimension_ < 3 ? extents.beyond[static_cast<std::size_t>(dimension_)] : 0.0;
  outside_ = size * hull.thickness + 2.0 * flatness + rounding;

  if (dimension_ == 1 && !(size > rounding)) dimension_ = 0;
  if (dimension_ == 0) {
    vertices_.assign(1, points[0]);
    first_neighbor_.assign(2, 0);
    outside_ = size + rounding;
    return hull;
  }
  if (dimension_ == 1) {
    hull.facets.push_back({static_cast<std::int32_t>(extents.ends[0]), static_cast<std::int32_t>(extents.ends[1]), -1});
  }
  take_corners(points, edges_of(hull.facets));
  return hull;
}

void ConvexHull::find_starts() {
  starts_.reserve(6 * kCells * kCells);
  std::int32_t corner = 0;
  for (int face = 0; face < 6; ++face) {
    for (int u = 0; u < kCells; ++u) {
      for (int v = 0; v < kCells; ++v) {
        const int axis = face / 2;
        Vector3d direction;
        direction[axis] = face % 2 == 0 ? 1.0 : -1.0;
        direction[(axis + 1) % 3] = (2.0 * u + 1.0) / kCells - 1.0;
        direction[(axis + 2) % 3] = (2.0 * v + 1.0) / kCells - 1.0;
        corner = support(direction.normalized(), corner);
        starts_.push_back(corner);
      }
    }
  }
}

// Neighbors get numbers close to each other, because they are read together.
void ConvexHull::take_corners(Points points, const std::vector<Edge>& edges) {
  std::vector<std::int32_t> number(points.size(), -1);
  std::vector<std::int32_t> point_of;
  const auto take = [&](std::int32_t point) {
    std::int32_t& n = number[static_cast<std::size_t>(point)];
    if (n >= 0) return;
    n = static_cast<std::int32_t>(point_of.size());
    point_of.push_back(point);
    vertices_.push_back(points[static_cast<std::size_t>(point)]);
  };
  take(edges.front()[0]);
  first_neighbor_.push_back(0);
  for (std::size_t v = 0; v < point_of.size(); ++v) {
    auto edge = std::lower_bound(edges.begin(), edges.end(), Edge{point_of[v], 0});
    for (; edge != edges.end() && (*edge)[0] == point_of[v]; ++edge) {
      take((*edge)[1]);
      neighbors_.push_back(number[static_cast<std::size_t>((*edge)[1])]);
    }
    first_neighbor_.push_back(static_cast<std::int32_t>(neighbors_.size()));
  }
}

}  // namespace glissade::collision
