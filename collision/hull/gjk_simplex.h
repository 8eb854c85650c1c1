#pragma once

/// The simplex of GJK: up to four points of the Minkowski difference B − A, and the point of their hull that is nearest
/// to the origin (E. G. Gilbert, D. W. Johnson and S. S. Keerthi 1988; the regions of a triangle after C. Ericson
/// 2005).

#include <array>
#include <cstdint>
#include <optional>

#include <Eigen/Core>

#include <glissade/base/assert.h>

namespace glissade::collision {

struct GjkPoint {
  Eigen::Vector3d w;  ///< corner of B minus corner of A, in the frame of A
  std::int32_t corner_A;
  std::int32_t corner_B;
};

class GjkSimplex {
 public:
  int count() const { return count_; }
  const GjkPoint& operator[](int i) const {
    GLISSADE_ASSERT(i >= 0 && i < count_);
    return points_[static_cast<std::size_t>(i)];
  }
  bool has(std::int32_t corner_A, std::int32_t corner_B) const;

  /// The simplex must have fewer than four points.
  void add(const GjkPoint& point) {
    GLISSADE_ASSERT(count_ < 4);
    points_[static_cast<std::size_t>(count_++)] = point;
  }

  /// Whether the simplex has four points that certainly enclose the origin.
  bool encloses_origin() const;

  /// Returns the point of the hull that is nearest to the origin, and keeps only the points of the simplex on which it
  /// depends. The simplex must not be empty. Exact except for rounding, which may put the origin outside of four points
  /// that barely enclose it.
  Eigen::Vector3d reduce_to_nearest();

  /// The point nearest to the origin on the plane of the three points of the simplex, which must have exactly three.
  /// Not finite if the points do not span a plane.
  Eigen::Vector3d nearest_of_plane() const;

 private:
  struct Nearest {
    Eigen::Vector3d point;
    std::array<int, 3> of;  ///< the points it depends on
    int count;
  };
  using Face = std::array<int, 4>;  ///< three points, and the fourth that is not part of it
  bool surely_sees_no_origin(const Face& face) const;
  Nearest nearest_of_segment(int a, int b) const;
  std::optional<Eigen::Vector3d> nearest_inside(int a, int b, int c) const;
  Nearest nearest_of_triangle(int a, int b, int c) const;
  Nearest nearest_of_tetrahedron() const;
  const Eigen::Vector3d& w(int i) const { return points_[static_cast<std::size_t>(i)].w; }

  std::array<GjkPoint, 4> points_;
  int count_ = 0;
};

}  // namespace glissade::collision
