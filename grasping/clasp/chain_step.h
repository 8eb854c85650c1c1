#pragma once

/// A step of a chain from its present posture: a displacement of the root, and changes of flex values, all at once.

#include <span>
#include <vector>

#include <Eigen/Geometry>

#include <glissade/contact/certified_bodies.h>
#include <glissade/geometry/displacement.h>
#include <glissade/grasping/kinematic_chain.h>

namespace glissade::grasping {

struct ChainStep {
  geometry::Displacement root;  ///< of the origin of R, and about it
  std::vector<double> values;   ///< rad, one for each flex value
};

void scale(ChainStep& step, double factor);
/// The step that leads from one posture to another.
void step_between(const Posture& from, const Posture& to, ChainStep& step);
/// The posture after the share t of a step.
void advance(const Posture& from, const ChainStep& step, double t, Posture& to);

/// The links with meshes, which can touch something: their numbers in the chain.
std::vector<std::size_t> links_that_touch(const KinematicChain& chain);

/// A step as a motion of the links that touch. The chain must outlive this object.
class ChainMotion final : public contact::BodiesMotion {
 public:
  ChainMotion(const KinematicChain& chain, std::span<const std::size_t> movers);

  /// Replaces the step. Allocates nothing after the first call.
  void set(const Posture& from, const ChainStep& step);

  void poses(double t, std::span<Eigen::Isometry3d> X_WM) const override;
  double length(std::size_t mover) const override { return lengths_[mover]; }
  double acceleration(std::size_t mover) const override { return accelerations_[mover]; }
  /// Bound (metres) of the motion of every point of every link.
  double longest() const;

 private:
  const KinematicChain& chain_;
  std::span<const std::size_t> movers_;
  Posture from_;
  ChainStep step_;
  std::vector<double> turns_;  // rad, of each joint
  std::vector<double> lengths_;
  std::vector<double> accelerations_;
  mutable Posture at_;
  mutable std::vector<Eigen::Isometry3d> X_WL_;
};

}  // namespace glissade::grasping
