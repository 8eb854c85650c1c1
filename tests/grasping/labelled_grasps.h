#pragma once

/// Grasps of things of a household, with the labels that docs/grasps.md explains.

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include <glissade/geometry/triangle_mesh.h>
#include <glissade/grasping/grasp_analysis.h>
#include <glissade/grasping/grasp_simulation.h>
#include <glissade/grasping/kinematic_chain.h>

#include "clasped_hand.h"

namespace glissade::test_support {

/// The object lies still in W, where the root of the hand is at first.
struct LabelledGrasp {
  std::string name;
  std::string object;  ///< in the shape catalogue
  Eigen::Isometry3d X_WB = Eigen::Isometry3d::Identity();
  grasping::Posture start;  ///< touches nothing
  grasping::Posture close;  ///< the target, which may lie within the object
  Eigen::Vector3d up_W = Eigen::Vector3d::UnitZ();
  grasping::GraspType type = grasping::GraspType::kNone;  ///< expected
  grasping::GraspForm form = grasping::GraspForm::kNone;
  std::string reason;  ///< of the label

  bool holds() const { return grasping::Grasp{type, form, 0, {}}.holds(); }
};

/// Throws std::invalid_argument, naming the grasp, for a key, a finger, a type, or a form that is not known.
std::vector<LabelledGrasp> read_labelled_grasps(const std::filesystem::path& file);

/// The target of a labelled grasp so many milliseconds after its start: in 100 ms the root goes to its pose, in 200 ms
/// more the fingers close.
grasping::Posture target_at(const LabelledGrasp& grasp, int ms);
/// When a hand has closed, and kept closed for a while.
inline constexpr int kClosed_ms = 500;

/// A hand that performs a labelled grasp of an object that stands still in W.
class GraspTrial {
 public:
  explicit GraspTrial(const LabelledGrasp& grasp);

  /// Follows `target_at`. Returns the grasp after kClosed_ms.
  const grasping::Grasp& close();

  /// One more millisecond.
  const grasping::Grasp& advance(const grasping::Posture& target);

  const ClaspedHand& hand() const { return hand_; }
  const geometry::TriangleMesh& object() const { return *object_; }
  const grasping::GraspAnalysis& analysis() const { return analysis_; }

 private:
  LabelledGrasp grasp_;
  std::shared_ptr<const geometry::TriangleMesh> object_;
  ClaspedHand hand_;
  grasping::GraspAnalysis analysis_;
};

/// The same with an object that is loose: the hand pushes it, takes hold of it, and carries it.
class LooseGraspTrial {
 public:
  explicit LooseGraspTrial(const LabelledGrasp& grasp, const std::vector<contact::Obstacle>& fixed = {});

  /// Follows `target_at` for kClosed_ms. Returns whether the hand holds the object then.
  bool close();

  /// One more millisecond.
  void advance(const grasping::Posture& target);

  bool holds() const { return simulation_.held_part(0).has_value(); }
  const grasping::Grasp& grasp() const { return simulation_.grasp(0); }
  const grasping::GraspSimulation& simulation() const { return simulation_; }
  /// Whether the hand collides with the object, by a check without code of the trees.
  bool collides() const;

 private:
  LabelledGrasp grasp_;
  std::shared_ptr<const geometry::TriangleMesh> object_;
  grasping::GraspSimulation simulation_;
};

}  // namespace glissade::test_support
