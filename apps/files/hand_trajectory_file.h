#pragma once

/// Files of hand postures over time: rows `t_s,x_m,y_m,z_m,qw,qx,qy,qz` and the 22 flex values of a hand; and files
/// that describe a hand.

#include <chrono>
#include <string>
#include <utility>
#include <vector>

#include <glissade/devices/simulated_glove.h>
#include <glissade/geometry/pose_trajectory.h>
#include <glissade/grasping/hand_model.h>
#include <glissade/grasping/kinematic_chain.h>

namespace glissade::apps {

/// The tracked postures of a hand. Between two rows each flex value is linear in time, and the root moves as
/// `PoseTrajectory` tells. Before the first row and after the last, the posture is constant.
class HandTrajectory {
 public:
  /// Both with the same times.
  HandTrajectory(geometry::PoseTrajectory X_WR, std::vector<devices::TimedAngles> values)
      : X_WR_(std::move(X_WR)), values_(std::move(values)) {}

  std::chrono::nanoseconds first_time() const { return values_.front().time; }
  std::chrono::nanoseconds last_time() const { return values_.back().time; }
  std::chrono::nanoseconds duration() const { return last_time() - first_time(); }
  grasping::Posture posture_at(std::chrono::nanoseconds time) const;
  /// Of all rows, in either direction, rad.
  double greatest_angle() const;

 private:
  geometry::PoseTrajectory X_WR_;
  std::vector<devices::TimedAngles> values_;
};

/// Reads a trajectory. Throws std::invalid_argument as `read_trajectory`.
HandTrajectory read_hand_trajectory(const std::string& path);

/// Reads the description of a hand: YAML with the keys `side` (left or right), `length_m` and `breadth_m`, all
/// optional. Throws std::invalid_argument, naming the file, the line and the key.
grasping::HandShape read_hand_shape(const std::string& path);

}  // namespace glissade::apps
