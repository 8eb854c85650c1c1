#pragma once

/// The page of a run of `glissade grasp`: the hands and parts in three dimensions, and what they did over time.

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <glissade/apps/report/html_report.h>
#include <glissade/apps/report/word_curve.h>
#include <glissade/apps/scene/haptic_scene.h>
#include <glissade/apps/view/clearance_curve.h>
#include <glissade/apps/view/grasp_outcome.h>
#include <glissade/apps/view/part_curves.h>
#include <glissade/apps/view/replay_maker.h>
#include <glissade/contact/tracked_contacts.h>
#include <glissade/grasping/grasp_simulation.h>
#include <glissade/grasping/hand_model.h>

namespace glissade::apps {

/// Looks at a simulation, which must outlive it, millisecond by millisecond.
class GraspReport {
 public:
  /// For a run of so many milliseconds.
  GraspReport(const HapticScene& scene, const grasping::GraspSimulation& simulation,
              const std::vector<std::shared_ptr<const grasping::HandModel>>& hands, std::int64_t ticks);

  void add(std::chrono::nanoseconds time);
  Report finish(const GraspOutcome& outcome);

 private:
  const HapticScene& scene_;
  const grasping::GraspSimulation& simulation_;
  ReplayMaker replay_;
  std::vector<contact::ContactPatches> patches_;  // by part
  std::int64_t ticks_ = 0;
  std::vector<WordCurve> kinds_;  // of grasps, by hand
  GrowingPlot touching_;
  std::vector<VectorPlot> forces_;  // by part
  std::vector<VectorPlot> torques_;
  PartCurves parts_;
  std::vector<ClearanceCurve> clearances_;  // by part
  std::vector<Eigen::Isometry3d> others_X_WB_;
};

}  // namespace glissade::apps
