#pragma once

/// Meshes about the z axis, built from closed loops of points.

#include <array>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include <glissade/geometry/triangle_mesh.h>

namespace glissade::shapes {

/// Counterclockwise about the origin.
using Loop = std::vector<Eigen::Vector2d>;

/// Regular polygon of `points` facets at the distance `facet_radius` from the origin; its first corner is on the x
/// axis.
Loop round_loop(double facet_radius, int points);

/// `points` points on a regular polygon of `sides` facets at the distance `facet_radius`, in the directions of the
/// corners of `round_loop`. The first facet faces +x. Its corners are among the points if `points` is a multiple of
/// 2 `sides`.
Loop polygon_loop(int sides, double facet_radius, int points);

class LoopMesh {
 public:
  // Adds a loop at the height z; returns its number.
  int add_loop(const Loop& loop, double z);

  // Adds the band of quadrilaterals between two loops with equally many points. It faces away from the axis if `upper`
  // lies above `lower`, and up if both have the same height and `upper` lies inside `lower`.
  void add_band(int lower, int upper);

  // Adds a straight wall between two heights in `rows` bands; returns its last loop.
  int add_wall(int from, const Loop& loop, double z_from, double z_to, int rows);

  // Adds a fan about the axis that fills the loop.
  void add_cap(int loop, bool faces_up);

  // A point of a loop. The index wraps around.
  struct Point {
    int loop;
    int index;
  };
  // Adds a quadrilateral. It faces the side from which its corners run counterclockwise.
  void add_quad(const std::array<Point, 4>& corners);

  const geometry::TriangleMesh& mesh() const { return mesh_; }

 private:
  struct Range {
    std::int32_t first;  // vertex
    std::int32_t count;
  };
  std::int32_t vertex(Point point) const;

  geometry::TriangleMesh mesh_;
  std::vector<Range> loops_;
};

}  // namespace glissade::shapes
