// A scene, and its simulation without a haptic loop, as viewers show them.

#include <gtest/gtest.h>

#include <glissade/geometry/mesh_generators.h>
#include <glissade/viewer/view_simulation.h>

namespace glissade::viewer {
namespace {

TEST(ViewSimulation, NumbersPartsAsTheirStatesDo) {
  const auto box = geometry::make_box({0.1, 0.1, 0.1}, 12);
  simulation::Scene scene;
  scene.objects = {{.name = "gate", .mesh = box, .motion = simulation::SceneMotion{geometry::PoseTrajectory({{}})}},
                   {.name = "wall", .mesh = box},
                   {.name = "peg", .mesh = box, .movable = true}};
  const std::vector<ViewObject> objects = shown_objects(scene, {"peg"});
  EXPECT_EQ(objects[0].part, 1U) << "what moves on its own comes after the parts";
  EXPECT_TRUE(objects[0].moves_on_its_own);
  EXPECT_EQ(objects[1].part, std::nullopt);
  EXPECT_EQ(objects[2].part, 0U);
}

TEST(ViewSimulation, ShowsThePushingContactsOfAPartInItsFrame) {
  contact::SlidingResult result;
  result.X_WV = result.X_WV_of_contacts = Eigen::Translation3d(1.0, 2.0, 3.0);
  result.X_WG = Eigen::Translation3d(1.0, 2.0, 2.9);
  result.state = contact::SlidingState::kResting;
  result.pushing = 1;
  contact::Contact contact{};
  contact.n_W = Eigen::Vector3d::UnitZ();
  contact.p_W = {1.25, 2.0, 3.0};
  result.contacts = {contact, contact};
  result.contacts[1].force = 2.0;
  devices::HapticState state;
  contact::ContactPatches patches(0.1);
  show_part(result, {0.5, 0.0, 0.0}, 1, patches, state);
  EXPECT_EQ(state.parts[1].state, devices::PartState::kResting);
  EXPECT_EQ(state.parts[1].X_WG.translation().z(), 2.9);
  EXPECT_EQ(state.parts[1].p_Vref.x(), 0.5);
  ASSERT_EQ(state.contact_count, 1);
  EXPECT_EQ(state.contacts[0].part, 1);
  EXPECT_TRUE(state.contacts[0].p_V.isApprox(Eigen::Vector3f(0.25F, 0.0F, 0.0F)));
  ASSERT_EQ(state.patch_count, 1);
  EXPECT_EQ(state.patches[0].part, 1);
  EXPECT_EQ(state.patches[0].contact_count, 1);
  EXPECT_TRUE(state.patches[0].p_V.isApprox(Eigen::Vector3f(0.25F, 0.0F, 0.0F)));
}

}  // namespace
}  // namespace glissade::viewer
