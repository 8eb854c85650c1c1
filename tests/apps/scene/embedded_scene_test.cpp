#include <algorithm>
#include <chrono>

#include <gtest/gtest.h>

#include <glissade/apps/files/hand_script.h>
#include <glissade/apps/files/scene_file.h>
#include <glissade/apps/scene/embedded_scene.h>

namespace glissade::apps {
namespace {

class EmbeddedScene : public testing::TestWithParam<Demonstration> {
 protected:
  const Scene scene = read_or_embedded_scene("", GetParam());
  const HandScript script = parse_hand_script(embedded_scene_script(GetParam()), embedded_script_name(GetParam()));
};

TEST_P(EmbeddedScene, HasOneMovablePartAndASeatForIt) {
  EXPECT_EQ(
      std::count_if(scene.objects.begin(), scene.objects.end(), [](const auto& object) { return object.movable; }), 1);
  EXPECT_TRUE(scene.find("window_motor").movable);
  EXPECT_TRUE(scene.X_WGoal.has_value());
  ASSERT_TRUE(scene.script_path.has_value());
  EXPECT_TRUE(scene.script_path->ends_with(embedded_script_name(GetParam()))) << *scene.script_path;
}

TEST_P(EmbeddedScene, LastsTenSeconds) {
  EXPECT_EQ(script.X_WH.duration(), std::chrono::seconds(10));
}

TEST_P(EmbeddedScene, StartsAtThePartWithoutFingersAndBesideItWithThem) {
  const Eigen::Vector3d p_WV = scene.find("window_motor").X_WB.translation();
  const double distance = (script.X_WH.pose_at(script.X_WH.first_time()).translation() - p_WV).norm();
  if (GetParam() == Demonstration::kCarDoor) {
    EXPECT_TRUE(script.fingers.empty());
    EXPECT_LT(distance, 1e-9);
  } else {
    EXPECT_FALSE(script.fingers.empty());
    EXPECT_GT(distance, 0.2);
  }
}

INSTANTIATE_TEST_SUITE_P(All, EmbeddedScene, testing::Values(Demonstration::kCarDoor, Demonstration::kDoorModule));

}  // namespace
}  // namespace glissade::apps
