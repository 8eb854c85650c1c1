#pragma once

/// A triangle of one body of a candidate pair, with what the contact search asks about its features.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

#include <Eigen/Geometry>

#include <glissade/geometry/triangle_pair.h>

#include "scene/contact_scene.h"

namespace glissade::contact {

/// One side of a pair, part or obstacle: a triangle in world coordinates, and the features that it owns.
class TriangleSide {
 public:
  explicit TriangleSide(double sign) : sign_(sign) {}

  /// The body must stay where it is until the next call.
  void select(const PlacedBody& placed, std::int32_t triangle) {
    mesh_ = &placed.body->tree.mesh();
    topology_ = &placed.body->topology;
    X_WB_ = &placed.X_WB;
    triangle_ = triangle;
    points_ = placed.triangle_W(triangle);
  }

  /// Whether the selected triangle may be within `distance` (metres) of that of the other side.
  bool may_be_near(const TriangleSide& other, double distance) const {
    return bounds().squaredExteriorDistance(other.bounds()) <= distance * distance;
  }

  std::int32_t triangle() const { return triangle_; }
  const Eigen::Vector3d& corner(int i) const { return points_[static_cast<std::size_t>(i)]; }

  /// Numbers in the mesh of corner / edge i.
  std::int32_t vertex(int i) const {
    return mesh_->triangles[static_cast<std::size_t>(triangle_)][static_cast<std::size_t>(i)];
  }
  std::int32_t edge(int i) const { return topology_->edges_of(triangle_)[static_cast<std::size_t>(i)]; }

  /// Whether the selected triangle owns its corner / edge i, and that feature can stop anything.
  bool owns_corner(int i) const { return topology_->owns_corner(triangle_, i); }
  bool owns_edge(int i) const { return topology_->owns_edge(triangle_, i); }
  /// Whether the point at parameter s of the line of edge i is inside the edge, or past an end by at most `tolerance`
  /// (metres) where the rim goes straight on. Otherwise an edge that crosses the rim just there could slip through
  /// between two edges.
  bool is_on_edge(int i, double s, double tolerance) const {
    if (s > 0.0 && s < 1.0) return true;
    const int end = s <= 0.0 ? i : (i + 1) % 3;
    const double past = s <= 0.0 ? -s : s - 1.0;
    const double squared_length = (corner((i + 1) % 3) - corner(i)).squaredNorm();
    return past * past * squared_length <= tolerance * tolerance && !topology_->can_stop(vertex(end));
  }
  /// The point of the selected triangle closest to x. If that is a vertex inside a straight rim, the point on the edge
  /// beside which x lies, in the sense of `is_on_edge`.
  geometry::ClosestOnTriangle closest_to(const Eigen::Vector3d& x, double tolerance) const {
    const geometry::ClosestOnTriangle on = geometry::closest_on_triangle(x, points_);
    if (on.region != geometry::Region::kVertex || topology_->can_stop(vertex(on.index))) return on;
    for (const int i : {on.index, (on.index + 2) % 3}) {
      if (!owns_edge(i)) continue;
      const Eigen::Vector3d along = corner((i + 1) % 3) - corner(i);
      const double s = along.dot(x - corner(i)) / along.squaredNorm();
      if (is_on_edge(i, s, tolerance)) return {corner(i) + s * along, geometry::Region::kEdge, i};
    }
    return on;
  }
  /// Whether corner / edge i is nearest to the other side among its neighbors: none is nearer by more than `tolerance`
  /// (metres) along the normal n (from obstacle to part).
  bool corner_is_nearest(int i, const Eigen::Vector3d& n, double tolerance) const {
    return none_nearer(topology_->neighbors_of(vertex(i)), corner(i), n, tolerance);
  }
  bool edge_is_nearest(int i, const Eigen::Vector3d& n, double tolerance) const {
    return none_nearer(topology_->apexes_of(edge(i)), corner(i), n, tolerance);
  }
  bool is_flat(int i) const { return topology_->edges()[static_cast<std::size_t>(edge(i))].flat; }
  /// Distance of the point at parameter s of edge i from the ends of its rim; infinite where the rim goes straight on.
  double distance_to_ends(int i, double s) const {
    const double length = (corner((i + 1) % 3) - corner(i)).norm();
    double least = std::numeric_limits<double>::infinity();
    if (topology_->can_stop(vertex(i))) least = std::max(0.0, s) * length;
    if (topology_->can_stop(vertex((i + 1) % 3))) least = std::min(least, std::max(0.0, 1.0 - s) * length);
    return least;
  }
  /// An edge of the selected triangle that is not flat and within `tolerance` (metres) of x; −1 if there is none.
  std::int32_t rim_near(const Eigen::Vector3d& x, double tolerance) const {
    for (int i = 0; i < 3; ++i) {
      if (is_flat(i)) continue;
      const Eigen::Vector3d along = corner((i + 1) % 3) - corner(i);
      if (along.cross(x - corner(i)).squaredNorm() <= tolerance * tolerance * along.squaredNorm()) return edge(i);
    }
    return -1;
  }

 private:
  Eigen::AlignedBox3d bounds() const {
    Eigen::AlignedBox3d bounds(points_[0]);
    return bounds.extend(points_[1]).extend(points_[2]);
  }

  bool none_nearer(std::span<const std::int32_t> vertices, const Eigen::Vector3d& x_W, const Eigen::Vector3d& n,
                   double tolerance) const {
    for (const std::int32_t v : vertices) {
      const Eigen::Vector3d y_W = *X_WB_ * mesh_->vertices[static_cast<std::size_t>(v)];
      if (sign_ * n.dot(y_W - x_W) < -tolerance) return false;
    }
    return true;
  }

  const geometry::TriangleMesh* mesh_ = nullptr;
  const geometry::MeshTopology* topology_ = nullptr;
  const Eigen::Isometry3d* X_WB_ = nullptr;
  double sign_;  // +1 for the part, towards which normals point; −1 for the obstacle
  std::int32_t triangle_ = -1;
  geometry::TrianglePoints points_;
};

}  // namespace glissade::contact
