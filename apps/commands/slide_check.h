#pragma once

/// The assembly check of a trajectory: whether the part reaches its goal, and with which forces and clearance.

#include <chrono>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <glissade/apps/files/followed_trajectory.h>
#include <glissade/apps/report/html_report.h>
#include <glissade/apps/report/plot.h>
#include <glissade/apps/scene/haptic_scene.h>
#include <glissade/apps/scene/sliding_option.h>
#include <glissade/contact/sliding.h>
#include <glissade/haptics/coupling.h>
#include <glissade/reference/sliding_method.h>
#include <glissade/study/slide_meter.h>

namespace glissade::apps {

struct SlideCheckOptions {
  contact::SlidingOptions sliding{};  ///< what follows from the choice
  SlidingChoice choice{};
  reference::SlidingMethod method = reference::SlidingMethod::kProjection;
  double goal_tolerance_m = 0.3e-3;
  double goal_tolerance_deg = 0.5;
  bool needs_summary = true;  ///< otherwise the least clearance is left out
  bool needs_curve = false;   ///< of clearance and force over time
};

struct SlideCheck {
  std::string trajectory;              ///< the file's name
  std::optional<std::string> problem;  ///< one sentence: why the check was impossible; then all else is meaningless
  bool has_goal = false;               ///< of the scene; otherwise the goal is the end of the trajectory
  study::SlideMeasures measures;
  std::string overlaps;  ///< if the goal is not reached: "at most 0.1 mm deep in 'wall'", if it still is
  PlotSeries force;      ///< newtons over seconds
  PlotSeries clearance;  ///< as of `ClearanceCurve`; empty if left out
  std::string doubt;     ///< of the positions, see `doubt_of_positions`
  double far_m = 0.0;    ///< a lower bound of the least clearance, from bounding spheres
};

/// Called after each millisecond, first for the start, with the time on the clock of the trajectory.
using SlideWatch = std::function<void(std::chrono::nanoseconds time, const reference::SlidingSimulation& sliding)>;

/// Moves the part along the trajectory in steps of a millisecond, offline. The part starts at the pose of the first
/// row, objects that move on their own at their poses of that time. The goal is that of the scene, by default the last
/// row of the trajectory. A start that is not free is reported as `problem`, without a call of `watch`. Checks of one
/// scene may run in several threads at once. Memory hardly grows with the trajectory.
SlideCheck check_slide(const HapticScene& scene, FollowedTrajectory& trajectory, const std::string& name,
                       const SlideCheckOptions& options, const SlideWatch& watch = {});

/// The outcome in one sentence.
std::string verdict(const SlideCheck& check, const SlideCheckOptions& options);

/// What the part should reach: "goal", or "end of the trajectory".
std::string name_of_goal(const SlideCheck& check);
/// How near it must come, such as "0.3 mm and 0.5 degrees".
std::string goal_tolerance(const SlideCheckOptions& options);

/// The page of all checks; that of a single one lacks what `SlideReplay` adds.
Report report_of(const HapticScene& scene, const std::vector<SlideCheck>& checks, const SlideCheckOptions& options);

}  // namespace glissade::apps
