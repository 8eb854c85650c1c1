#include "scripted_scene.h"

#include <chrono>

#include <glissade/apps/files/scene_file.h>
#include <glissade/apps/scene/embedded_scene.h>
#include <glissade/apps/scene/haptic_scene.h>
#include <glissade/files/pose_files.h>

namespace glissade::bench {
namespace {

using Eigen::Isometry3d;
using std::chrono::milliseconds;
using test_support::SlidingScene;

SlidingScene scripted(const std::string& name, const apps::Scene& file, const geometry::PoseTrajectory& script_X_WH,
                      double speed) {
  const apps::HapticScene haptic = apps::make_haptic_scene(file, apps::movable_objects(file));
  SlidingScene scene;
  scene.name = name;
  scene.obstacles = haptic.obstacles;
  scene.part_V = haptic.parts.front().part_V;
  scene.X_WV_start = haptic.parts.front().X_WV_start;
  double way = 0.0;
  constexpr int kPieces = 10'000;
  Isometry3d last = script_X_WH.pose_at(script_X_WH.first_time());
  for (int i = 1; i <= kPieces; ++i) {
    const Isometry3d next = script_X_WH.pose_at(script_X_WH.first_time() + i * script_X_WH.duration() / kPieces);
    way += (next.translation() - last.translation()).norm();
    last = next;
  }
  scene.ticks = static_cast<int>(1e3 * way / speed);
  const geometry::PoseTrajectory scaled = script_X_WH.time_scaled(milliseconds(scene.ticks));
  const Isometry3d X_HG = scaled.pose_at(scaled.first_time()).inverse() * scene.X_WV_start;
  scene.ghost = [=](int tick) -> Isometry3d { return scaled.pose_at(scaled.first_time() + milliseconds(tick)) * X_HG; };
  return scene;
}

}  // namespace

SlidingScene car_door_scene(double speed) {
  return scripted(
      "car-door",
      apps::parse_scene(std::string(apps::embedded_scene_yaml(apps::Demonstration::kCarDoor)), "car_door.yaml", "."),
      files::parse_trajectory(apps::embedded_scene_script(apps::Demonstration::kCarDoor), "car_door_script.csv"),
      speed);
}

}  // namespace glissade::bench
