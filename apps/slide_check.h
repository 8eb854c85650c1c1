#pragma once

/// What became of a part on its way through a scene: the assembly check of one trajectory.

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include <glissade/apps/haptic_scene.h>
#include <glissade/apps/html_report.h>
#include <glissade/apps/plot.h>
#include <glissade/geometry/pose_trajectory.h>
#include <glissade/haptics/coupling.h>
#include <glissade/haptics/sliding.h>

namespace glissade::apps {

struct SlideCheckOptions {
  haptics::SlidingOptions sliding{};
  haptics::SlidingMethod method = haptics::SlidingMethod::kProjection;
  double goal_tolerance_m = 0.3e-3;
  double goal_tolerance_deg = 0.5;
};

struct SlideCheck {
  std::string trajectory;              ///< the file's name
  std::optional<std::string> problem;  ///< why there is no answer, as one sentence; then all else is meaningless
  bool goal_reached = false;
  double goal_distance_m = 0.0;  ///< of the part's origin, at the end
  double goal_angle_deg = 0.0;
  double force_max_N = 0.0;
  double torque_max_Nm = 0.0;    ///< about the part's reference point
  double clearance_min_m = 0.0;  ///< of the visible part, by exact queries
  double clearance_min_at_s = 0.0;
  double duration_s = 0.0;
  double contact_s = 0.0;  ///< contacts pushed for so long
  PlotSeries force;        ///< newtons over seconds
};

/// The simulation of the scene; it begins at the time and pose of the trajectory's first row, and what moves on its own
/// begins where it is at that time. Throws std::invalid_argument, as one sentence, where anything is not free then.
std::unique_ptr<haptics::SlidingSimulation> start_sliding(const HapticScene& scene,
                                                          const geometry::PoseTrajectory& trajectory,
                                                          const SlideCheckOptions& options);

/// Goes on to a tick of the trajectory and returns its time. Ticks are a millisecond each, and must come in order: 0,
/// 1, 2 and so on.
std::chrono::nanoseconds slide_to(std::int64_t tick, const geometry::PoseTrajectory& trajectory,
                                  haptics::SlidingSimulation& sliding);

/// Leads the part along the trajectory in steps of a millisecond, offline, and keeps account. The goal is the scene's,
/// or else where the trajectory ends. A start that is not free is told as a `problem`. Different checks of one scene
/// may run at once.
SlideCheck check_slide(const HapticScene& scene, const geometry::PoseTrajectory& trajectory, const std::string& name,
                       const SlideCheckOptions& options);

/// One row for each check, in their order; `path` as for `CsvWriter`.
void write_checks(const std::vector<SlideCheck>& checks, const std::string& path);

/// The page of all checks.
Report report_of(const HapticScene& scene, const std::vector<SlideCheck>& checks, const SlideCheckOptions& options);

}  // namespace glissade::apps
