#include <chrono>
#include <cmath>

#include <glissade/apps/commands/pose_script.h>
#include <glissade/bridges/calibration_poses.h>

namespace glissade::apps {

HandScript pose_script(double seconds_per_pose) {
  const auto at = [](double seconds) { return std::chrono::nanoseconds(std::llround(1e9 * seconds)); };
  constexpr double kDelay = 0.4;  // of the time of a pose
  constexpr double kWay = 0.1;
  const Eigen::Isometry3d X_WH(Eigen::Translation3d(0.0, 0.0, 0.2));
  const double end_s = (bridges::kCalibrationPoses + 1) * seconds_per_pose;
  HandScript script{.X_WH = geometry::PoseTrajectory({{at(0.0), X_WH}, {at(end_s), X_WH}})};
  hands::JointValues posture = bridges::posture_of(bridges::calibration_poses().front());
  script.fingers.push_back({at(0.0), posture});
  for (std::size_t p = 1; p < bridges::kCalibrationPoses; ++p) {
    const double begin_s = (static_cast<double>(p) + kDelay) * seconds_per_pose;
    script.fingers.push_back({at(begin_s), posture});
    posture = bridges::posture_of(bridges::calibration_poses()[p]);
    script.fingers.push_back({at(begin_s + kWay * seconds_per_pose), posture});
  }
  return script;
}

}  // namespace glissade::apps
