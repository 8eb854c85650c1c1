#pragma once

/// The measures of one slide: how near the part came to its goal, with which forces and clearance, and where it jams.

#include <chrono>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include <Eigen/Geometry>

#include <glissade/contact/contact_body.h>
#include <glissade/contact/sliding_result.h>
#include <glissade/contact/spring.h>
#include <glissade/simulation/least_clearance.h>
#include <glissade/simulation/scene.h>

namespace glissade::study {

/// The pose that a part should reach, and how near it must come.
struct SlideGoal {
  Eigen::Isometry3d X_WGoal = Eigen::Isometry3d::Identity();
  double distance_m = 0.3e-3;
  double angle_deg = 0.5;
};

struct SlideMeasures {
  bool goal_reached = false;
  double goal_distance_m = 0.0;  ///< of the part's origin from that of the goal, at the end
  double goal_angle_deg = 0.0;
  double force_max_N = 0.0;
  double torque_max_Nm = 0.0;    ///< about the part's compliance point
  double clearance_min_m = 0.0;  ///< infinite if it was not measured, or if nothing came near (`LeastClearance`)
  double clearance_min_at_s = 0.0;
  double duration_s = 0.0;
  double contact_s = 0.0;  ///< time during which contacts pushed
  double work_J = 0.0;     ///< of the hand against the contacts
  /// Since this time, the part has stayed as near to where it then was as it must come to its goal.
  double still_since_s = 0.0;
  /// Within the last 10 ms, the part has moved by a tenth of how near it must come to its goal: a longer slide may end
  /// elsewhere.
  bool moves_at_end = false;
  std::string pushed_by;                     ///< the objects that push the part at the end
  std::optional<Eigen::Vector3d> p_Wpushed;  ///< mean of their contact points, weighted by the forces
  Eigen::Isometry3d X_WV_end = Eigen::Isometry3d::Identity();

  /// A part jams if contacts hold it away from its goal.
  bool jams() const { return !goal_reached && p_Wpushed.has_value() && !moves_at_end; }
};

/// Not thread-safe. Memory does not grow with the slide.
class SlideMeter {
 public:
  /// For the first part of `bodies`, which must outlive this object. Measuring clearances takes most of the time.
  SlideMeter(const simulation::SceneBodies& bodies, const SlideGoal& goal, bool measures_clearance);

  /// Adds the result of a tick. Call it for the start, and then once per millisecond. `time` is the time since the
  /// start, `moving_X_WB` are the poses of the objects that move on their own.
  void note(std::chrono::nanoseconds time, const contact::SlidingResult& result,
            std::span<const Eigen::Isometry3d> moving_X_WB);

  /// Call this function once, after the last tick.
  SlideMeasures finish();

 private:
  /// A pose near which the part has been since a time.
  struct Rest {
    Eigen::Isometry3d X_WV = Eigen::Isometry3d::Identity();
    double since_s = 0.0;
  };

  void update(Rest& rest, double share_of_goal, const Eigen::Isometry3d& X_WV, double time_s) const;
  void add_work(const contact::SlidingResult& result, const contact::Wrench& wrench);
  void note_pushing(const contact::SlidingResult& result);

  const simulation::SceneBodies& bodies_;
  SlideGoal goal_;
  std::optional<simulation::LeastClearance> clearance_;
  SlideMeasures measures_{};
  contact::SlidingResult last_{};
  contact::Wrench last_wrench_{};
  std::int64_t ticks_ = 0;
  std::int64_t contact_ticks_ = 0;
  Rest rest_{};
  Rest short_rest_{};  // within a tenth of the distance
};

}  // namespace glissade::study
