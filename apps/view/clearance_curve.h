#pragma once

/// The clearance of a part over a run, for a plot.

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include <glissade/apps/report/plot.h>
#include <glissade/apps/scene/haptic_scene.h>
#include <glissade/collision/query_types.h>
#include <glissade/contact/sliding_result.h>

namespace glissade::apps {

/// The distance between the features of a part of a scene and those of all other objects, as of `LeastClearance`, at
/// 250 to 500 moments of a run, or at all poses of a shorter one. Not thread-safe.
class ClearanceCurve {
 public:
  /// Clearances from here on are left out: the curve has gaps there.
  static constexpr double kFarthest_m = 0.002;

  /// For the part with this number in a run of so many poses. The scene must outlive this object.
  ClearanceCurve(const HapticScene& scene, std::int64_t poses, std::size_t part = 0);

  /// Takes the next pose of the part, and the poses of the other parts and of the objects that move on their own, in
  /// their order in the scene. `contacts`, at this pose or near it, save work: nothing farther away than their
  /// triangles is searched.
  void note(std::chrono::nanoseconds time, const Eigen::Isometry3d& X_WV,
            std::span<const Eigen::Isometry3d> moving_X_WB, std::span<const contact::Contact> contacts = {});

  /// Micrometres over seconds.
  PlotSeries take(std::string name);

 private:
  struct Body {
    const contact::ContactBody* body_B;
    Eigen::Isometry3d X_WB;
  };

  struct Pair {
    std::size_t body;
    collision::TrianglePair triangles;  ///< of the body and the part
  };

  Pair pair_of(const contact::Contact& contact) const;
  double distance_of(const Pair& pair, const Eigen::Isometry3d& X_WV) const;
  double distance_to(std::size_t b, const Eigen::Isometry3d& X_WV, double limit);

  const contact::SlidingPart& part_V_;
  std::vector<Body> bodies_;  // obstacles, other parts, objects that move on their own
  std::size_t first_moving_;
  std::size_t own_number_;  // among the bodies of contacts
  std::int64_t every_;      // poses
  std::int64_t noted_ = 0;
  std::optional<Pair> nearest_;  // at the last moment
  collision::QueryWorkspace workspace_;
  std::vector<collision::ClosePair> close_;
  PlotSeries series_;
};

/// A plot without curves, for some of these.
Plot clearance_plot();

}  // namespace glissade::apps
