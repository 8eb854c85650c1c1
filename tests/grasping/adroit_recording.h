#pragma once

/// Recordings of people who open a door with the Adroit hand in the task `AdroitHandDoor` (Rajeswaran et al., Learning
/// complex dexterous manipulation with deep reinforcement learning and demonstrations, 2018), as tables: a row each
/// 10 ms with the angles of arm, hand and latch (rad) and the position of the site S_grasp before the palm (metres).
/// The geometry of the hand and of the door's handle are those of the task.

#include <array>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include <glissade/geometry/triangle_mesh.h>
#include <glissade/grasping/hand_conversions.h>

namespace glissade::test_support {

struct AdroitRow {
  double t_s = 0.0;
  Eigen::Vector3d arm = Eigen::Vector3d::Zero();  ///< ARRx, ARRy, ARRz
  std::array<double, grasping::kAdroitJoints> joints{};
  double latch = 0.0;
  Eigen::Vector3d p_WGrasp = Eigen::Vector3d::Zero();
};

/// Throws std::runtime_error, naming the file, for a table without these columns or with a field that is no number.
std::vector<AdroitRow> read_adroit_recording(const std::string& path);
void write_adroit_recording(const std::string& path, const std::vector<AdroitRow>& rows);

/// Between two rows, linearly.
AdroitRow between(const AdroitRow& from, const AdroitRow& to, double t);

/// The pose of the recorded palm: z points to the fingers, x to the thumb's side, y out of the back of the hand.
Eigen::Isometry3d adroit_palm(const AdroitRow& row);

/// A human hand with the angles of a row, and with the knuckle of the middle finger where the recorded one has it:
/// there, both hands are built alike, while the recorded palm is longer.
grasping::HandPose human_hand_of(const grasping::HandModel& hand, const AdroitRow& row);

/// The latch with its lever, in the frame of its axis: a bar 40 mm thick along x, 150 mm before the axis.
geometry::TriangleMesh adroit_handle();
/// The handle of a door whose frame is at `p_WDoor`, while the latch holds it.
Eigen::Isometry3d handle_pose(const Eigen::Vector3d& p_WDoor, double latch);

}  // namespace glissade::test_support
