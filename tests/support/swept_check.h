#pragma once

/// Proves that a rigid motion of a part is free of collisions with obstacles, and measures its distance from them.
/// Plain loops over triangles, without code shared with the DOP-tree or the path certificate of sliding.
///
/// A proof states: no triangle of the part meets one of the obstacles at any instant of the motion
/// x(t) = p + t v + exp(t w) (x - p), t from 0 to 1. Separations must exceed 1e-14 of the coordinates, because of
/// rounding in double precision. Without a proof, the motion collides, or comes so near that 40 halvings of the time do
/// not decide.

#include <optional>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include <glissade/geometry/displacement.h>
#include <glissade/geometry/triangle_pair.h>

#include "scene/contact_scene.h"

namespace glissade::test_support {

/// The check of one part among fixed obstacles. Not thread-safe: it keeps scratch memory.
class SweptCheck {
 public:
  /// Triangles without area are left out, as the queries do. `p_Vref` is the point p of the motion at t = 0, in the
  /// part's frame.
  SweptCheck(const std::vector<contact::Obstacle>& obstacles, const geometry::TriangleMesh& part_V,
             const Eigen::Vector3d& p_Vref);

  /// A description of the triangles not proved apart on the motion that begins at X_WV; nothing if all are.
  std::optional<std::string> fault_of(const Eigen::Isometry3d& X_WV, const geometry::Displacement& motion);

  /// Two near triangles and their closest points, in the world.
  struct NearPair {
    double distance;
    Eigen::Vector3d p_part;
    Eigen::Vector3d p_obstacle;
  };
  /// The pairs at most `limit` metres apart, at most `most` of them.
  const std::vector<NearPair>& near_pairs(const Eigen::Isometry3d& X_WV, double limit, std::size_t most);

  /// The smallest distance in metres, at most `limit`.
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
