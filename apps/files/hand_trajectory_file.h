#pragma once

/// Files of hand postures over time: rows `t_s,x_m,y_m,z_m,qw,qx,qy,qz` and the 22 flex values of a hand; and files
/// that describe a hand.

#include <array>
#include <chrono>
#include <string>
#include <string_view>
#include <vector>

#include <glissade/devices/glove_device.h>
#include <glissade/geometry/pose_trajectory.h>
#include <glissade/grasping/hand_model.h>
#include <glissade/grasping/kinematic_chain.h>

namespace glissade::apps {

/// The columns of the flex values: `devices::kGloveJointNames` with the ending `_rad`.
std::vector<std::string> flex_columns();

/// The tracked postures of a hand. Between two rows each flex value is linear in time, and the root moves as
/// `PoseTrajectory` tells. Before the first row and after the last, the posture is constant.
class HandTrajectory {
 public:
  /// One row of values for each row of `X_WR`, at these times.
  HandTrajectory(geometry::PoseTrajectory X_WR, std::vector<std::chrono::nanoseconds> times,
                 std::vector<devices::JointValues> values);

  std::chrono::nanoseconds first_time() const { return times_.front(); }
  std::chrono::nanoseconds last_time() const { return times_.back(); }
  std::chrono::nanoseconds duration() const { return last_time() - first_time(); }
  grasping::Posture posture_at(std::chrono::nanoseconds time) const;

 private:
  geometry::PoseTrajectory X_WR_;
  std::vector<std::chrono::nanoseconds> times_;
  std::vector<devices::JointValues> values_;
};

/// Reads a trajectory. Throws std::invalid_argument as `read_trajectory`.
HandTrajectory read_hand_trajectory(const std::string& path);

/// Reads the description of a hand: YAML with the keys `side` (left or right), `length_m` and `breadth_m`, all
/// optional. Throws std::invalid_argument, naming the file, the line and the key.
grasping::HandShape read_hand_shape(const std::string& path);

}  // namespace glissade::apps
