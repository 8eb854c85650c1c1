#pragma once

/// The convex hull of an object: its corners, and which of them are neighbours. A much tighter enclosure than a box,
/// and two of them are told apart in nanoseconds by `separating_plane.h` (paper §2.2).

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

#include <glissade/collision/triangle_mesh.h>

namespace glissade::collision {

struct HullFacets;

/// Immutable after construction, so safe to share between objects and threads. Points that lie in one plane, on one
/// line or in one place have a hull, too.
class ConvexHull {
 public:
  /// Of some points, in metres, in the frame of the object. Throws std::invalid_argument when there is none, or one has
  /// a coordinate that is not finite. Cost O(n log n).
  explicit ConvexHull(std::span<const Eigen::Vector3d> points);

  /// Of the corners of the triangles of a mesh, which must have one.
  explicit ConvexHull(const TriangleMesh& mesh);

  /// The corners of the hull, in no particular order.
  std::span<const Eigen::Vector3d> vertices() const { return vertices_; }

  /// The corners that share an edge with corner `vertex`; edges that divide a flat face into triangles are among them.
  std::span<const std::int32_t> neighbors(std::int32_t vertex) const {
    const auto v = static_cast<std::size_t>(vertex);
    return std::span(neighbors_)
        .subspan(static_cast<std::size_t>(first_neighbor_[v]),
                 static_cast<std::size_t>(first_neighbor_[v + 1] - first_neighbor_[v]));
  }

  /// 3 for a solid, 2 for a polygon, 1 for a segment, 0 for a point.
  int dimension() const { return dimension_; }

  /// Of the bounding box of the corners, and the largest distance of a corner from there (metres).
  const Eigen::Vector3d& center() const { return center_; }
  double radius() const { return radius_; }

  /// The largest distance of a corner from the origin of the object's frame (metres): coordinates are rounded in
  /// proportion to it.
  double reach() const { return reach_; }

  /// How far a point that was given may lie outside the hull of `vertices()`, in metres: Qhull leaves out points that
  /// are nearly in a face.
  double outside() const { return outside_; }

  /// The corner that is furthest along `direction`, which must be about of unit length, found from corner `start` by
  /// climbing from neighbour to neighbour: no corner is further by more than `climbing_error`.
  /// Cost: the corners on the way and their neighbours, about √n from anywhere, next to nothing from where it was
  /// before.
  std::int32_t support(const Eigen::Vector3d& direction, std::int32_t start) const;

  /// A corner that is about furthest along `direction`, within some degrees, for climbing to begin at when nothing
  /// better is known. Cost O(1).
  std::int32_t start_toward(const Eigen::Vector3d& direction) const { return starts_[cell_of(direction)]; }

  /// How much further than the corner of `support` another may be, in metres: climbing stops where it sees no
  /// difference for rounding, which matters where facets are narrow.
  double climbing_error() const { return climbing_error_; }

  /// The corner that is furthest along `direction`: all are looked at.
  std::int32_t furthest(const Eigen::Vector3d& direction) const;

 private:
  using Edge = std::array<std::int32_t, 2>;

  // Directions by the cell of a cube that they point to: of each of its six faces, kCells by kCells.
  static constexpr int kCells = 8;
  static std::size_t cell_of(const Eigen::Vector3d& direction);
  void find_starts();

  HullFacets find_corners(std::span<const Eigen::Vector3d> points);
  void take_corners(std::span<const Eigen::Vector3d> points, const std::vector<Edge>& edges);

  std::vector<Eigen::Vector3d> vertices_;
  std::vector<std::int32_t> first_neighbor_;  ///< one more than vertices
  std::vector<std::int32_t> neighbors_;
  std::vector<std::int32_t> starts_;  ///< by cell
  int dimension_ = 0;
  double outside_ = 0.0;
  double climbing_error_ = 0.0;
  Eigen::Vector3d center_ = Eigen::Vector3d::Zero();
  double radius_ = 0.0;
  double reach_ = 0.0;
};

inline std::size_t ConvexHull::cell_of(const Eigen::Vector3d& direction) {
  Eigen::Index axis = 0;
  const double largest = direction.cwiseAbs().maxCoeff(&axis);
  // The cells of a face, from −1 to 1 along either side. A direction of no length has a cell, too.
  const double scale = largest > 0.0 ? 0.5 * kCells / largest : 0.0;
  const auto cell = [&](Eigen::Index i) {
    return std::clamp(static_cast<int>(direction[i] * scale + 0.5 * kCells), 0, kCells - 1);
  };
  const int face = 2 * static_cast<int>(axis) + (direction[axis] < 0.0 ? 1 : 0);
  return static_cast<std::size_t>((face * kCells + cell((axis + 1) % 3)) * kCells + cell((axis + 2) % 3));
}

inline std::int32_t ConvexHull::support(const Eigen::Vector3d& direction, std::int32_t start) const {
  std::int32_t best = start;
  double height = direction.dot(vertices_[static_cast<std::size_t>(best)]);
  for (bool climbed = true; climbed;) {
    climbed = false;
    for (const std::int32_t next : neighbors(best)) {
      const double height_of_next = direction.dot(vertices_[static_cast<std::size_t>(next)]);
      if (height_of_next > height) {
        height = height_of_next;
        best = next;
        climbed = true;
      }
    }
  }
  return best;
}

}  // namespace glissade::collision
