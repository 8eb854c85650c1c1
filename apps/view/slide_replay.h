#pragma once

/// A report of `glissade slide` on one trajectory: its replay, and its plots over time.

#include <chrono>
#include <cstdint>
#include <span>
#include <string>

#include <Eigen/Geometry>

#include <glissade/apps/report/html_report.h>
#include <glissade/apps/scene/haptic_scene.h>
#include <glissade/apps/view/part_curves.h>
#include <glissade/apps/view/replay_maker.h>
#include <glissade/contact/sliding.h>
#include <glissade/contact/tracked_contacts.h>

namespace glissade::apps {

/// Looks at the simulation of the scene's first part, which one hand leads, millisecond by millisecond.
class SlideReplay {
 public:
  explicit SlideReplay(const HapticScene& scene);

  /// `sliding` is a `contact::Sliding` or a `reference::SlidingSimulation`.
  template <typename SlidingSimulation>
  void add(std::chrono::nanoseconds time, const SlidingSimulation& sliding) {
    add(time, sliding.result(), sliding.part().p_Vref(), sliding.scripted_X_WB());
  }
  /// Adds the replay, and plots of wrench, lag, contacts and states; `of` ends the titles of those of the wrench. Once,
  /// at the end.
  void finish(Report& report, const std::string& of = {});

 private:
  void add(std::chrono::nanoseconds time, const contact::SlidingResult& result, const Eigen::Vector3d& p_Vref,
           std::span<const Eigen::Isometry3d> scripted_X_WB);

  ReplayMaker maker_;
  VectorPlot force_{"Force on the hand", "force [N]"};
  VectorPlot torque_{"Torque on the hand about the reference point of the part", "torque [Nm]"};
  PartCurves part_;
  contact::ContactPatches patches_;
  std::int64_t ticks_ = 0;
};

}  // namespace glissade::apps
