#include "proof_scene.h"

#include <numbers>
#include <vector>

#include <glissade/contact/spring.h>

#include "held_part.h"
#include "holding_arm.h"
#include "poses.h"

namespace glissade::test_support {

namespace {

constexpr double kEdge_m = 0.04;

/// A motion that begins at (x, 0, z), and in which the pose is at (x, 0, z) + `way` every second time.
geometry::PoseTrajectory to_and_fro(const Eigen::Vector3d& p_from, const Eigen::Vector3d& way,
                                    std::chrono::milliseconds step, std::chrono::seconds duration) {
  std::vector<geometry::TimedPose> rows;
  for (std::chrono::milliseconds time(0); time <= duration; time += step) {
    const bool is_away = rows.size() % 2 == 1;
    rows.push_back({time, pose(p_from + (is_away ? way : Eigen::Vector3d::Zero()),
                               turn(is_away ? 0.2 : 0.0, Eigen::Vector3d::UnitZ()))});
  }
  return geometry::PoseTrajectory(rows);
}

}  // namespace

devices::SimulatedGlove proof_hand(std::chrono::seconds duration) {
  return devices::SimulatedGlove(
      to_and_fro({-0.03, 0.0, 0.0}, {0.05, 0.03, 0.01}, std::chrono::milliseconds(400), duration));
}

devices::SimulatedGlove proof_arm(std::chrono::seconds duration) {
  return {
      to_and_fro({0.03, 0.0, 0.0}, {0.04, -0.02, 0.0}, std::chrono::milliseconds(500), duration), {}, holding_arm()};
}

grasping::GraspSimulation proof_parts() {
  using std::chrono::milliseconds;
  constexpr std::chrono::seconds kForLong(600);
  const contact::CouplingStiffness stiffness{1000.0, 1.0};
  const auto held = [&](double x) {
    return contact::HeldPart{.part_V = cube(kEdge_m), .X_WV_start = at(x, 0.0, 0.0), .stiffness = stiffness};
  };
  const geometry::PoseTrajectory lift = to_and_fro({0.0, 0.0, -0.08}, {0.0, 0.0, 0.04}, milliseconds(1000), kForLong);
  return {{wall(0.07)},
          {held(-0.03), held(0.03), contact::held_by_script({cube(kEdge_m), lift})},
          {},
          {.sliding = contact::real_time_rules()}};
}

}  // namespace glissade::test_support
