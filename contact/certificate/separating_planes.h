#pragma once

/// Separating planes of many pairs of triangles: for each pair a direction, fixed to either body, along which the two
/// triangles are apart. Where parts fit closely and slide, such as a nut on its thread, these gaps hardly change though
/// the parts move far. So most pairs need no look of their own.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Geometry>

#include "certificate/fixed_direction.h"
#include "certificate/plane_kernel.h"
#include "scene/contact_scene.h"

namespace glissade::contact {

/// The planes of the pairs of two bodies. Not thread-safe.
class PlanesOfBodies {
 public:
  /// Begins anew, with no pair. `bodies` are at the poses near which gaps will be asked for: the error of a gap grows
  /// with the way from there.
  void start(const BodyPair& pair, std::span<const PlacedBody> bodies);

  const BodyPair& bodies() const { return pair_; }
  /// Adds a pair with a number that its owner gives it. Its direction is n_W at the poses of `bodies`, fixed to the
  /// part if it is to turn with it and may, otherwise to the obstacle. Where n_W is zero, the direction is unknown, and
  /// so is the gap.
  void add(std::uint32_t number, const TrianglesOfBodies& pair, const Eigen::Vector3d& n_W, bool turns_with_part,
           std::span<const PlacedBody> bodies);
  /// By slot: kPlanesAtOnce slots are a block.
  std::span<const std::uint32_t> numbers() const { return numbers_; }
  TrianglesOfBodies triangles(std::size_t slot) const { return {pair_, triangles_[slot][0], triangles_[slot][1]}; }

  std::size_t block_count() const { return blocks_.size(); }
  const PlaneBlock& block(std::size_t number) const { return blocks_[number]; }

  /// Where the part's points x are at A x + t in the obstacle's frame, mostly a rotation and a translation.
  PlaneMaps maps(const Eigen::Matrix3d& A, const Eigen::Vector3d& t) const;
  PlaneMaps maps(const Eigen::Isometry3d& X_OV) const { return maps(X_OV.linear(), X_OV.translation()); }

  /// Sets the gaps (metres) of all slots in the blocks from `first` to before `end`. Each is a lower bound of the
  /// distance of a pair where the part is, up to the share by which A stretches a direction. Unknown gaps are far below
  /// zero. `gaps` gets an entry for each slot of all blocks.
  void find_gaps(const PlaneMaps& maps, std::size_t first, std::size_t end, std::vector<float>& gaps) const;

  /// Where an obstacle's triangle must be for a direction that turns with the part.
  const BallAboutPart& ball() const { return ball_; }

  /// Gives the pair in a slot another direction, not zero. Returns false for one that would turn with the part and may
  /// not, which changes nothing.
  bool turn(std::size_t slot, const FixedDirection& direction, std::span<const PlacedBody> bodies);

 private:
  BodyPair pair_{};
  // Points of the part are relative to its centre, those of the obstacle to that of the ball.
  Eigen::Vector3d c_V_ = Eigen::Vector3d::Zero();
  double radius_ = 0.0;  // metres: of the part about c_V
  BallAboutPart ball_{};
  double farthest_squared_ = 0.0;  // m²: of a corner of the obstacle from the centre of the ball
  std::vector<std::uint32_t> numbers_;
  std::vector<std::array<std::int32_t, 2>> triangles_;  // of the obstacle and the part
  std::vector<PlaneBlock> blocks_;
};

/// The pose of a body's part in the frame of its obstacle. A pose may deviate from a rotation as far as `rigid_pose`
/// allows, which is more than the rounding of a certificate. So its inverse is that of the matrix: then only gaps, not
/// coordinates, are wrong by this share.
inline Eigen::Isometry3d relative_pose(const Eigen::Isometry3d& X_WO, const Eigen::Isometry3d& X_WV) {
  return X_WO.inverse(Eigen::Affine) * X_WV;
}

}  // namespace glissade::contact
