#include <algorithm>
#include <string>

#include <gtest/gtest.h>

#include <glissade/apps/embedded_scene.h>
#include <glissade/apps/files/scene_file.h>
#include <glissade/apps/files/trajectory_file.h>

namespace glissade::apps {
namespace {

TEST(EmbeddedScene, TheScriptStartsAtTheMovablePart) {
  const Scene scene = parse_scene(std::string(embedded_scene_yaml()), "embedded scene", "");
  EXPECT_EQ(
      std::count_if(scene.objects.begin(), scene.objects.end(), [](const auto& object) { return object.movable; }), 1);
  EXPECT_TRUE(scene.X_WGoal.has_value());
  EXPECT_EQ(scene.script_path, "car_door_script.csv");

  const geometry::PoseTrajectory script = parse_trajectory(embedded_scene_script(), "embedded script");
  EXPECT_TRUE(script.pose_at(script.first_time()).isApprox(scene.find("window_motor").X_WB, 1e-9));
}

}  // namespace
}  // namespace glissade::apps
