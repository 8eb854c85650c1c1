#pragma once

/// Up to four points of the Minkowski difference B − A, and where in their hull the origin is nearest (E. G.
/// Gilbert, D. W. Johnson and S. S. Keerthi 1988; the regions of a triangle after C. Ericson 2005).

#include <array>
#include <cstdint>
#include <optional>

#include <Eigen/Core>

#include <glissade/base/assert.h>

namespace glissade::collision {

struct GjkPoint {
  Eigen::Vector3d w;  ///< corner of B less corner of A, in the frame of A
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

  /// There must be less than four.
  void add(const GjkPoint& point) {
    GLISSADE_ASSERT(count_ < 4);
    points_[static_cast<std::size_t>(count_++)] = point;
  }

  /// Whether four points certainly enclose the origin.
  bool encloses_origin() const;

  /// Keeps the points, of which there must be one, that the nearest point of their hull depends on, and returns that.
  /// Exact but for rounding, which may call the origin outside of four points that barely enclose it.
  Eigen::Vector3d reduce_to_nearest();

  /// Of the plane of three points, of which there must be as many, the point that is nearest to the origin. Not finite
  /// if there is no such plane.
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
