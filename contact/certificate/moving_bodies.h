#pragma once

/// Poses of the bodies at any moment of a step: obstacles stand still, parts follow their displacements, riders the
/// parts to which they are attached; or movers follow a common motion.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Geometry>

#include <glissade/base/assert.h>
#include <glissade/contact/contact_body.h>
#include <glissade/geometry/displacement.h>
#include <glissade/geometry/triangle_pair.h>

#include "scene/contact_scene.h"

namespace glissade::contact {

/// Bodies are numbered as in the scene. Not thread-safe.
class MovingBodies {
 public:
  /// A step is divided into 2^5 equal stretches. A moment is the number of a stretch end, from 0 to kMoments.
  static constexpr int kMoments = 32;

  /// The scene must outlive this object.
  explicit MovingBodies(const ContactScene& scene);

  /// Begins a step at the present poses of the parts; `displacements` has one entry for each part.
  void begin_step(std::span<const geometry::Displacement> displacements);

  /// The same for the movers from `first_mover` on, which follow a motion; the others stand still. The motion must
  /// begin at the present poses, and outlive the step.
  void begin_step(const BodiesMotion& motion, std::size_t first_mover);

  /// Whether a body moves at all.
  bool moves(std::int32_t body) const { return is_mover(body) && path(body).moves; }
  /// Bound (metres) of the motion of every point of a body in the whole step.
  double motion(std::int32_t body) const { return is_mover(body) ? path(body).motion : 0.0; }
  /// Bound (metres) of the deviation of every point of a body from its chord between two moments: an eighth of the
  /// bound of the second derivative of its path between them.
  double curvature(std::int32_t body, int begin, int end) const;

  /// The same over the whole step for a point that stands still, in the frame of a body that follows a displacement.
  /// The point comes no farther than `farthest` (metres) from the body's reference point.
  double curvature_seen_from(std::int32_t body, double farthest) const;
  /// The reference point of a mover, about which its displacement turns it, at a moment; only if it moves.
  Eigen::Vector3d reference_point_W(std::int32_t body, int moment) {
    GLISSADE_ASSERT(moves(body));
    return pose(body, moment) * path(body).p_Bref;
  }

  /// Bound (metres) of the sum of `curvature` for any two bodies in the whole step.
  double most_curvature() const;

  /// The pose of a body at a moment.
  const Eigen::Isometry3d& pose(std::int32_t body, int moment);
  /// A triangle of a body at a moment, in world coordinates.
  geometry::TrianglePoints triangle_W(std::int32_t body, std::int32_t triangle, int moment);

  /// Smallest distance (metres) that is certain in spite of rounding, for the present poses of the bodies.
  double certain_distance() const;

 private:
  /// B is the frame of the mover.
  struct Path {
    Eigen::Vector3d p_Bref = Eigen::Vector3d::Zero();  ///< the reference point of the part with which the mover moves
    geometry::Displacement displacement;
    bool moves = false;
    double motion = 0.0;
    double acceleration =
        0.0;  ///< metres: bound of the second derivative over the whole step; |w|² ρ of a displacement
    std::array<Eigen::Isometry3d, kMoments + 1> X_WB_at;
    std::array<bool, kMoments + 1> known{};  ///< which of these poses have been computed
  };

  bool is_mover(std::int32_t body) const { return body >= first_mover_body_; }
  void begin(Path& path, std::size_t mover) const;
  void follow_motion(std::size_t moment);
  Path& path(std::int32_t body) { return paths_[static_cast<std::size_t>(body - first_mover_body_)]; }
  const Path& path(std::int32_t body) const { return paths_[static_cast<std::size_t>(body - first_mover_body_)]; }

  const ContactScene& scene_;
  std::int32_t first_mover_body_;
  double reach_of_obstacles_ = 0.0;       // metres from the origin
  std::vector<Path> paths_;               // one for each mover
  const BodiesMotion* motion_ = nullptr;  // of the movers from `first_mover_` on; null: displacements
  std::size_t first_mover_ = 0;
  std::vector<Eigen::Isometry3d> X_WM_;  // of these movers
};

}  // namespace glissade::contact
