#pragma once

/// Proves that a rigid motion of a part keeps it apart from obstacles, and measures how near it is to them. Plain loops
/// over triangles: it shares no code with the DOP-tree, nor with the path certificate of sliding.
///
/// What a proof says: no triangle of the part meets one of the obstacles at any instant of the motion
/// x(t) = p + t v + exp(t w) (x - p), t from 0 to 1, but for the rounding of double precision, against which
/// separations must exceed 1e-14 of the coordinates. Where nothing is proved the motion collides, or comes so near that
/// 40 halvings of the time do not tell.

#include <optional>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include <glissade/geometry/displacement.h>
#include <glissade/geometry/triangle_pair.h>

#include "scene/contact_scene.h"

namespace glissade::test_support {

/// Of one part among obstacles that stand still. Not thread-safe: it keeps scratch memory.
class SweptCheck {
 public:
  /// Triangles without area are left out, as the queries do. `p_Vref` is the point p of the motion at t = 0, in the
  /// part's frame.
  SweptCheck(const std::vector<haptics::Obstacle>& obstacles, const geometry::TriangleMesh& part_V,
             const Eigen::Vector3d& p_Vref);

  /// What could not be proved apart on the motion that begins at X_WV, in words; nothing if all was.
  std::optional<std::string> fault_of(const Eigen::Isometry3d& X_WV, const geometry::Displacement& motion);

  /// Two triangles that are near and the points where they are nearest, world axes.
  struct NearPair {
    double distance;
    Eigen::Vector3d p_part;
    Eigen::Vector3d p_obstacle;
  };
  /// The pairs that are at most `limit` metres apart, but no more than `most` of them.
  const std::vector<NearPair>& near_pairs(const Eigen::Isometry3d& X_WV, double limit, std::size_t most);

  /// The least distance in metres, or `limit` if it is more.
  double distance(const Eigen::Isometry3d& X_WV, double limit);

 private:
  struct Box {
    Eigen::Array3d low;
    Eigen::Array3d high;
    bool meets(const Box& other) const { return (low <= other.high).all() && (other.low <= high).all(); }
  };
  struct BoxedTriangle {
    geometry::TrianglePoints points;
    Box box;
  };
  struct Motion;

  static Box box_of(const geometry::TrianglePoints& points, double margin);
  void select_obstacles(const Box& box);
  template <typename Visit>
  void traverse_near(const Eigen::Isometry3d& X_WV, double limit, const Visit& visit);

  std::vector<BoxedTriangle> obstacles_W_;
  std::vector<geometry::TrianglePoints> part_V_;
  Eigen::Vector3d p_Vref_;
  std::vector<const BoxedTriangle*> selected_;
  std::vector<BoxedTriangle> placed_;
  std::vector<NearPair> near_;
};

}  // namespace glissade::test_support
