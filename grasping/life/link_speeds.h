#pragma once

/// How fast the links of a tracked hand move.

#include <cstddef>
#include <memory>
#include <vector>

#include <Eigen/Geometry>

#include <glissade/contact/contact_body.h>
#include <glissade/grasping/kinematic_chain.h>

namespace glissade::grasping {

/// Not thread-safe.
class LinkSpeeds {
 public:
  static constexpr double kMean_ms = 10.0;

  /// `bodies` are the links with meshes, in their order.
  LinkSpeeds(std::shared_ptr<const KinematicChain> chain,
             std::vector<std::shared_ptr<const contact::SlidingPart>> bodies);

  /// The tracker has lost the hand: what it did until it is found again is no motion.
  void forget();
  /// Takes the posture of the tracked hand, `milliseconds` after the last one.
  void follow(const Posture& target, double milliseconds);
  /// Metres a millisecond: no point of this link was faster, in the mean of about the last kMean_ms. A glove may tell
  /// fewer postures than it is asked for.
  double of(std::size_t link) const { return speeds_[link]; }

 private:
  std::shared_ptr<const KinematicChain> chain_;
  std::vector<std::shared_ptr<const contact::SlidingPart>> bodies_;
  bool has_last_ = false;
  std::vector<Eigen::Isometry3d> X_WL_;
  std::vector<Eigen::Isometry3d> X_WL_last_;
  std::vector<double> speeds_;  // by link; 0 for those without meshes
};

}  // namespace glissade::grasping
