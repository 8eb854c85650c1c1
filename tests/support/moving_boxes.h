#pragma once

/// Proves that boxes which move rigidly, all at once, stay apart: by the separating axes of convex bodies in plain
/// double arithmetic. No code is shared with the library but for the definition of a displacement.

#include <optional>

#include <Eigen/Geometry>

namespace glissade::test_support {

/// A box about the origin of its frame B, which moves by one displacement about that origin: straight, and turning at a
/// constant rate by the shorter way.
struct MovingBox {
  Eigen::Vector3d half;  ///< of the edges, metres; 0 along the normal of a sheet
  Eigen::Isometry3d X_WB_from;
  Eigen::Isometry3d X_WB_to;

  bool stands_still() const { return X_WB_from.matrix() == X_WB_to.matrix(); }
  /// The pose at the fraction t of the way.
  Eigen::Isometry3d at(double t) const;
};

/// The unit vector in the world, from box a to box b, along which the gap between them is the widest of all separating
/// axes; nothing if no axis certainly separates them, because they meet or are nearer than about 1e-14 m.
std::optional<Eigen::Vector3d> separating_axis(const Eigen::Vector3d& half_a, const Eigen::Isometry3d& X_WA,
                                               const Eigen::Vector3d& half_b, const Eigen::Isometry3d& X_WB);

/// Whether the boxes certainly have a gap at every instant of their motion.
bool stay_apart(const MovingBox& a, const MovingBox& b);

}  // namespace glissade::test_support
