#pragma once

/// Where bodies are at any moment of a step: obstacles stand still, each part goes along a displacement.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Geometry>

#include <glissade/geometry/displacement.h>
#include <glissade/geometry/triangle_pair.h>

#include "scene/contact_scene.h"

namespace glissade::haptics {

/// Bodies are numbered as in the scene. Not thread-safe.
class MovingBodies {
 public:
  /// A step is cut into 2^5 stretches; a moment is the number of one of their ends.
  static constexpr int kMoments = 32;

  /// The scene must outlive this object.
  explicit MovingBodies(const ContactScene& scene);

  /// A step begins where the parts are placed now; `displacements` has one for each of them.
  void begin_step(std::span<const geometry::Displacement> displacements);

  /// Whether a body moves at all.
  bool moves(std::int32_t body) const { return is_part(body) && path(body).moves; }
  /// Metres that no point of a body moves more than in the whole step.
  double motion(std::int32_t body) const { return is_part(body) ? path(body).motion : 0.0; }
  /// Metres that a point of a body may be off the chord between two moments: |w|² ρ / 8, as the second derivative of
  /// its path is at most |w|² ρ.
  double curvature(std::int32_t body, int begin, int end) const;

  /// The pose of a body at a moment.
  const Eigen::Isometry3d& pose(std::int32_t body, int moment);
  /// One of its triangles at a moment, in world coordinates.
  geometry::TrianglePoints triangle_W(std::int32_t body, std::int32_t triangle, int moment);

  /// Metres: of bodies where they are placed now, less than this is no certain distance.
  double certain_distance() const;

 private:
  struct Path {
    Eigen::Vector3d p_Vref;
    double radius;
    geometry::Displacement displacement;
    bool moves;
    double motion;
    std::array<Eigen::Isometry3d, kMoments + 1> X_WV_at;
    std::array<bool, kMoments + 1> known{};  ///< which of them have been computed
  };

  bool is_part(std::int32_t body) const { return body >= first_part_; }
  Path& path(std::int32_t body) { return paths_[static_cast<std::size_t>(body - first_part_)]; }
  const Path& path(std::int32_t body) const { return paths_[static_cast<std::size_t>(body - first_part_)]; }

  const ContactScene& scene_;
  std::int32_t first_part_;
  double reach_of_obstacles_ = 0.0;  // metres from the origin
  std::vector<Path> paths_;          // one for each part
};

}  // namespace glissade::haptics
