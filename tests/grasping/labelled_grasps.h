#pragma once

/// Grasps of things of a household, with the labels that docs/grasps.md explains.

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include <glissade/geometry/triangle_mesh.h>
#include <glissade/grasping/grasp_analysis.h>
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
  /// Whether the object slips out of a trembling hand. (It stands still in W, and does not go with the hand.)
  bool slips = false;
};

/// Throws std::invalid_argument, naming the grasp, for a key, a finger, a type, or a form that is not known.
std::vector<LabelledGrasp> read_labelled_grasps(const std::filesystem::path& file);

/// A hand that performs a labelled grasp.
class GraspTrial {
 public:
  explicit GraspTrial(const LabelledGrasp& grasp);

  /// Goes from the start to the target in 300 ms, first the root, then the fingers, and stays there for 200 ms. Returns
  /// the grasp at the end.
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

}  // namespace glissade::test_support
