#pragma once

/// Separating planes of many pairs of triangles: for each pair a direction, fixed to the obstacle, along which the two
/// triangles are apart. Where parts fit closely and slide, such as a nut on its thread, these gaps hardly change though
/// the parts move far. So most pairs need no look of their own.

#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Geometry>

#include "certificate/plane_kernel.h"
#include "scene/contact_scene.h"

namespace glissade::haptics {

/// The planes of the pairs of two bodies. Not thread-safe.
class PlanesOfBodies {
 public:
  /// Begins anew, with no pair. `bodies` are at the poses near which gaps will be asked for: the error of a gap grows
  /// with the way from there.
  void start(const BodyPair& pair, std::span<const PlacedBody> bodies);

  const BodyPair& bodies() const { return pair_; }
  /// Adds a pair with a number that its owner gives it. Where n_W is zero, the direction is unknown, and so is the gap.
  void add(std::uint32_t number, std::int32_t obstacle_triangle, std::int32_t part_triangle, const Eigen::Vector3d& n_W,
           std::span<const PlacedBody> bodies);
  /// By slot: kPlanesAtOnce slots are a block.
  std::span<const std::uint32_t> numbers() const { return numbers_; }

  std::size_t block_count() const { return blocks_.size(); }

  /// Sets the gaps (metres) of all slots in the blocks from `first` to before `end`. Each is a lower bound of the
  /// distance of a pair if A and t are the rotation and the translation of the part in the obstacle's frame. For any
  /// other A and t it is the least height of the part's corners over the obstacle's triangle, up to rounding. Unknown
  /// gaps are far below zero. `gaps` gets an entry for each slot of all blocks.
  void find_gaps(const Eigen::Matrix3d& A, const Eigen::Vector3d& t, std::size_t first, std::size_t end,
                 std::vector<float>& gaps) const;

  /// Gives the pair in a slot another direction, in the obstacle's axes; not zero.
  void turn(std::size_t slot, const ContactBody& obstacle, std::int32_t obstacle_triangle, const Eigen::Vector3d& n_O);

 private:
  BodyPair pair_{};
  // Corners of the part are relative to this point, heights to this one of the obstacle.
  Eigen::Vector3d c_V_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d o_O_ = Eigen::Vector3d::Zero();
  double radius_ = 0.0;    // metres: of the part about c_V
  double farthest_ = 0.0;  // metres: of a corner of the obstacle from o_O
  std::vector<std::uint32_t> numbers_;
  std::vector<PlaneBlock> blocks_;
};

/// The pose of a body's part in the frame of its obstacle. A pose may deviate from a rotation as far as `rigid_pose`
/// allows, which is more than the rounding of a certificate. So its inverse is that of the matrix: then only gaps, not
/// coordinates, are wrong by this share.
inline Eigen::Isometry3d relative_pose(const Eigen::Isometry3d& X_WO, const Eigen::Isometry3d& X_WV) {
  return X_WO.inverse(Eigen::Affine) * X_WV;
}

}  // namespace glissade::haptics
