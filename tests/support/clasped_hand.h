#pragma once

/// A hand, or another chain, that clasps one object, and an independent check of its postures.

#include <memory>
#include <vector>

#include <glissade/geometry/triangle_mesh.h>
#include <glissade/grasping/clasp.h>
#include <glissade/grasping/hand_model.h>
#include <glissade/reference/grid_check.h>

namespace glissade::test_support {

/// The model of a hand, shared by all tests of a program.
inline const std::shared_ptr<const grasping::HandModel>& hand_model() {
  static const auto hand = std::make_shared<const grasping::HandModel>(grasping::make_hand());
  return hand;
}

inline std::shared_ptr<const grasping::KinematicChain> hand_chain() {
  return {hand_model(), &hand_model()->chain};
}

/// The hand with its root at the origin and all flex values 0.
inline grasping::Posture open_hand() {
  return {.values = std::vector<double>(hand_chain()->values().size(), 0.0)};
}

/// All fingers bent by this angle (rad) in their first two joints, by two thirds of it in the last.
grasping::Posture bent_hand(double angle);

/// The posture at the fraction t of the way from one to another, as the clasp defines it.
grasping::Posture between(const grasping::Posture& from, const grasping::Posture& to, double t);

class ClaspedHand {
 public:
  ClaspedHand(const geometry::TriangleMesh& object, const Eigen::Isometry3d& X_WB,
              const grasping::ClaspRules& rules = {});
  ClaspedHand(std::shared_ptr<const grasping::KinematicChain> chain, const geometry::TriangleMesh& object,
              const Eigen::Isometry3d& X_WB);

  grasping::Clasp clasp;

  /// Whether a posture collides with the object, by a check without code of the trees.
  bool collides(const grasping::Posture& posture) const;

  /// Whether any of the postures on the way of the last call collides: each step is looked at in `parts` places.
  bool way_collides(const grasping::Posture& start, int parts) const;

 private:
  ClaspedHand(std::shared_ptr<const grasping::KinematicChain> chain,
              std::shared_ptr<const geometry::TriangleMesh> object, const Eigen::Isometry3d& X_WB,
              const grasping::ClaspRules& rules);

  reference::GridCheck check_;
};

}  // namespace glissade::test_support
