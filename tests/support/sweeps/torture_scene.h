#pragma once

/// Random scenes and random hands for sliding contact: soups, sheets, slivers, needles and smooth surfaces from 1 mm to
/// 5 m, and ghosts that wander, press, turn, jump and let go. The scene of a seed does not depend on machine or thread,
/// only on the compiler, see `RandomNumbers`.

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include <glissade/contact/contact_body.h>

#include "random_numbers.h"
#include "scene/contact_scene.h"

namespace glissade::test_support {

/// A part among obstacles, free of collision by `GridCheck`.
struct TortureScene {
  std::string description;
  double size = 1.0;  ///< about the part's radius, metres
  double room = 1.0;  ///< half the edge of the cube about `origin` that holds all bodies, metres
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  std::vector<contact::Obstacle> obstacles;
  std::shared_ptr<const contact::SlidingPart> part_V;
  Eigen::Isometry3d X_WV_start = Eigen::Isometry3d::Identity();
};

TortureScene random_torture_scene(RandomNumbers& random);

/// A hand that holds the part. Its motion consists of stretches of 20 to 200 ms of one kind each.
class TortureHand {
 public:
  TortureHand(const TortureScene& scene, RandomNumbers& random);

  /// The pose of the ghost a millisecond later.
  const Eigen::Isometry3d& next();

  /// Whether the hand holds the part in this millisecond.
  bool holds() const { return motion_ != Motion::kReleased; }

 private:
  enum class Motion { kGo, kPress, kTurn, kWalk, kRest, kReleased };
  void begin_stretch();
  Eigen::Vector3d random_place();

  const TortureScene& scene_;
  RandomNumbers& random_;
  Eigen::Isometry3d X_WG_;
  Motion motion_ = Motion::kRest;
  int ticks_left_ = 0;
  Eigen::Vector3d target_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d axis_ = Eigen::Vector3d::UnitX();
  double speed_ = 0.0;       // metres in a tick
  double turn_speed_ = 0.0;  // radians in a tick
};

}  // namespace glissade::test_support
