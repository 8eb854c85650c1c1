// Frames, read number by number.

#include <cstring>
#include <memory>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include <glissade/geometry/mesh_generators.h>
#include <glissade/grasping/grasp_analysis.h>
#include <glissade/viewer/view_frame.h>

namespace glissade::viewer {
namespace {

using std::chrono::microseconds;
using std::chrono::milliseconds;

ViewScene scene_far_away() {
  ViewScene scene;
  scene.objects.push_back({"part", std::make_shared<geometry::TriangleMesh>(geometry::make_box({0.1, 0.1, 0.1}, 12)),
                           Eigen::Isometry3d(Eigen::Translation3d(1000.0, 0.0, 0.0)), 0});
  return scene;
}

devices::HapticState some_state() {
  devices::HapticState state;
  state.sequence = 5;
  state.time = milliseconds(2500);
  state.contact_set_age = milliseconds(3);
  state.parts[0].X_WV = Eigen::Translation3d(1000.25, 0.5, 0.0);
  state.parts[0].X_WG = Eigen::Translation3d(1000.5, 0.5, 0.0);
  state.parts[0].state = devices::PartState::kSliding;
  state.parts[0].contact_count = 1;
  state.hands[0].part = 0;
  state.hands[0].force_W = {0.0, 0.0, 2.0};
  state.contact_count = 1;
  state.contacts[0] = {0, {0.0F, 0.0F, -0.05F}, Eigen::Vector3f::UnitZ()};
  state.patch_count = 1;
  state.patches_left_out = 2;
  state.patches[0] = {0, 4, {0.25F, 0.0F, -0.05F}, Eigen::Vector3f::UnitZ(), 0.125F};
  return state;
}

struct Frame {
  double time;
  double sequence;
  std::vector<float> numbers;
};

Frame read_frame(const std::string& bytes) {
  Frame frame{};
  std::memcpy(&frame.time, bytes.data(), 8);
  std::memcpy(&frame.sequence, bytes.data() + 8, 8);
  frame.numbers.resize((bytes.size() - 16) / 4);
  std::memcpy(frame.numbers.data(), bytes.data() + 16, bytes.size() - 16);
  return frame;
}

constexpr std::size_t kHead = 10;
constexpr std::size_t kPart = 18;
constexpr std::size_t kHand = 20;
constexpr std::size_t kContact = 7;
constexpr std::size_t kPatch = 9;

TEST(ViewFrame, HasTheNewestStateAboutTheOriginOfTheScene) {
  FrameMaker maker(scene_far_away());
  EXPECT_FALSE(maker.has_news());
  maker.add(some_state());
  ASSERT_TRUE(maker.has_news());
  const Frame frame = read_frame(maker.make());
  EXPECT_FALSE(maker.has_news());
  EXPECT_EQ(frame.time, 2.5);
  EXPECT_EQ(frame.sequence, 5.0);
  ASSERT_EQ(frame.numbers.size(), kHead + kPart + kHand + kContact + kPatch);
  const std::vector<float> head(frame.numbers.begin(), frame.numbers.begin() + kHead);
  EXPECT_EQ(head, (std::vector<float>{0, 3, 0, 0, 0, 1, 1, 1, 1, 2}));
  EXPECT_EQ(frame.numbers[kHead], 0.5F);        // ghost, x
  EXPECT_EQ(frame.numbers[kHead + 3], 1.0F);    // ghost, w
  EXPECT_EQ(frame.numbers[kHead + 7], 0.25F);   // visible part, x
  EXPECT_EQ(frame.numbers[kHead + 14], 0.25F);  // lag, metres
  EXPECT_EQ(frame.numbers[kHead + 16], 3.0F);   // sliding
  const std::size_t hand = kHead + kPart;
  EXPECT_EQ(frame.numbers[hand + 3], 2.0F);  // force, z
  EXPECT_EQ(frame.numbers[hand + 7], 2.0F);  // the greatest
  const std::size_t contact = hand + kHand;
  EXPECT_EQ(frame.numbers[contact + 3], -0.05F);
  EXPECT_EQ(frame.numbers[contact + 6], 1.0F);
  const std::vector<float> patch(frame.numbers.end() - kPatch, frame.numbers.end());
  EXPECT_EQ(patch, (std::vector<float>{0, 4, 0.25F, 0, -0.05F, 0, 0, 1, 0.125F}));
}

TEST(ViewFrame, TellsTheLagOfTheReferencePointAndItsAngle) {
  // A lever, held by a point 0.5 m from its origin, whose ghost has turned by a right angle about the origin.
  devices::HapticState state = some_state();
  state.parts[0].p_Vref = {0.5, 0.0, 0.0};
  state.parts[0].X_WG = state.parts[0].X_WV * Eigen::AngleAxisd(std::numbers::pi / 2.0, Eigen::Vector3d::UnitZ());
  FrameMaker maker(scene_far_away());
  maker.add(state);
  const Frame frame = read_frame(maker.make());
  EXPECT_FLOAT_EQ(frame.numbers[kHead + 14], 0.5F * std::numbers::sqrt2_v<float>);
  EXPECT_FLOAT_EQ(frame.numbers[kHead + 15], std::numbers::pi_v<float> / 2.0F);
}

TEST(ViewFrame, ShowsTheWorstSinceTheLastFrame) {
  FrameMaker maker(scene_far_away());
  devices::HapticState state = some_state();
  state.lateness = microseconds(70);
  state.last_duration = microseconds(9);
  state.hands[0].force_W = {0.0, 5.0, 0.0};
  maker.add(state);
  maker.add(some_state());
  const Frame worst = read_frame(maker.make());
  EXPECT_EQ(worst.numbers[2], 70.0F);
  EXPECT_EQ(worst.numbers[3], 9.0F);
  EXPECT_EQ(worst.numbers[kHead + kPart + 7], 5.0F);
  EXPECT_EQ(worst.numbers[kHead + kPart + 3], 2.0F);  // the force itself is the newest
  maker.add(some_state());
  EXPECT_EQ(read_frame(maker.make()).numbers[2], 0.0F);
}

TEST(ViewFrame, HasThePosesOfAHandsLinks) {
  ViewScene scene = scene_far_away();
  scene.hands = {{.model = std::make_shared<const grasping::HandModel>(grasping::make_hand())}};
  FrameMaker maker(scene);
  devices::HapticState state = some_state();
  state.hands[0].visible.activity = hands::HandActivity::kHolding;
  state.hands[0].visible.grasp = hands::GraspType::kPower;
  state.hands[0].visible.form = hands::GraspForm::kGravity;
  state.hands[0].visible.touching = (1 << 23) + 1;
  state.hands[0].visible.X_WH = Eigen::Translation3d(1000.0, 0.0, 0.125);
  maker.add(state);
  const Frame frame = read_frame(maker.make());
  const std::size_t hand = kHead + kPart;
  EXPECT_EQ(frame.numbers[hand + 14], 3.0F);  // power
  EXPECT_EQ(frame.numbers[hand + 15], 6.0F);  // gravity
  EXPECT_EQ(frame.numbers[hand + 16], 8388609.0F);
  EXPECT_EQ(frame.numbers[hand + 17], 0.0F);  // it lacks nothing
  ASSERT_EQ(frame.numbers[hand + 19], static_cast<float>(grasping::kHandLinks));
  EXPECT_EQ(frame.numbers[hand + 20 + 2], 0.125F);  // the root, z
  EXPECT_EQ(frame.numbers.size(), hand + kHand + 7 * grasping::kHandLinks + kContact + kPatch);
}

TEST(ViewFrame, TellsWhatAHandLacksThatOnlyPushes) {
  FrameMaker maker(scene_far_away());
  devices::HapticState state = some_state();
  state.hands[0].visible.grasp = hands::GraspType::kPush;
  state.hands[0].visible.touching = 1 << (4 * 2 + 3);  // the outer segment of the index
  maker.add(state);
  EXPECT_EQ(read_frame(maker.make()).numbers[kHead + kPart + 17],
            static_cast<float>(grasping::GraspLack::kThumbOrPalm));
}

TEST(ViewFrame, WaitingOrLostHandIsNotShown) {
  using Activity = hands::HandActivity;
  EXPECT_FALSE(is_present(Activity::kNone));
  EXPECT_FALSE(is_present(Activity::kWaiting)) << "where it is has not been told: it would stand at the origin";
  EXPECT_FALSE(is_present(Activity::kLost));
  EXPECT_TRUE(is_present(Activity::kFree));
  EXPECT_TRUE(is_present(Activity::kHolding));
  ViewScene scene = scene_far_away();
  scene.hands = {{.model = std::make_shared<const grasping::HandModel>(grasping::make_hand())}};
  FrameMaker maker(scene);
  devices::HapticState state = some_state();
  state.hands[0].visible.activity = Activity::kWaiting;
  maker.add(state);
  EXPECT_EQ(read_frame(maker.make()).numbers.size(), kHead + kPart + kHand + kContact + kPatch);
}

TEST(ViewFrame, TellsAViewerWhatItHasMissed) {
  FrameMaker maker(scene_far_away());
  maker.add(some_state());
  std::string frame = maker.make();
  set_missed(frame, 12);
  EXPECT_EQ(read_frame(frame).numbers[4], 12.0F);
  EXPECT_EQ(read_frame(frame).numbers[5], 1.0F);
}

}  // namespace
}  // namespace glissade::viewer
