/// Two gloves whose fingers grasp, and a server, each a process of its own over UDP multicast, in a network namespace.
/// One hand takes a ball, both hold it, the other carries it to a wall, slides it along there and leaves it. All is
/// checked from the recording of the run, by code that shares nothing with the simulation. What depends on the delay of
/// the link to the last degree is checked in an offline run.

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <memory>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <glissade/devices/simulated_glove.h>
#include <glissade/geometry/mesh_generators.h>
#include <glissade/haptics/finger_forces.h>
#include <glissade/reference/grid_check.h>

#include "finger_hands.h"
#include "glissade_program.h"
#include "poses.h"
#include "temporary_folder.h"

namespace glissade::apps {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using hands::JointValues;
using hands::kJoints;
using test_support::at;
using test_support::HandPause;
using test_support::ProgramResult;
using test_support::read_ticks;
using test_support::RecordedTick;
using test_support::script_text;
using test_support::ThumbShape;
using test_support::VisibleBodies;
using testing::ElementsAre;
using testing::HasSubstr;

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kSeconds = 8.6;

constexpr double kBallRadius_m = 0.035;
const Vector3d kBallPlace(0.07, -0.006, -0.057);
const Vector3d kWallEdges_m(0.02, 0.6, 0.6);
const Isometry3d kWallPlace = at(0.23, 0.0, 0.0);

constexpr const char* kScene = R"(objects:
  - name: wall
    shape: {type: box, size_x_m: 0.02, size_y_m: 0.6, size_z_m: 0.6, triangles: 2000}
    pose: {position_m: [0.23, 0, 0]}
  - name: ball
    shape: {type: sphere, radius_m: 0.035, triangles: 2000}
    pose: {position_m: [0.07, -0.006, -0.057]}
    movable: true
)";

constexpr ThumbShape kThumb{{20, -10, -15, 35}, {60, 45, 40, 20}};

/// Takes the ball in its palm, and opens again when the other hand has it.
std::vector<HandPause> first_hand() {
  const Isometry3d here = Isometry3d::Identity();
  const Isometry3d above = at(0.0, 0.0, 0.2);
  return {{0.0, here, 0.0}, {0.5, here, 0.0}, {0.8, here, 1.0},  {3.0, here, 1.0},
          {3.2, here, 0.0}, {3.4, here, 0.0}, {4.0, above, 0.0}, {8.5, above, 0.0}};
}

/// Comes from below, upside down, to the ball in the other hand; carries it to the wall, along there, and back.
std::vector<HandPause> second_hand() {
  const Isometry3d here = Eigen::Translation3d(kBallPlace) * Eigen::AngleAxisd(std::numbers::pi, Vector3d::UnitX()) *
                          Eigen::Translation3d(-kBallPlace);
  const auto from_there = [&](double x, double y, double z) { return at(x, y, z) * here; };
  return {{0.0, from_there(0.0, 0.0, -0.2), 0.0},
          {1.0, from_there(0.0, 0.0, -0.2), 0.0},
          {1.6, here, 0.0},
          {1.8, here, 0.0},
          {2.1, here, 1.0},
          {4.0, here, 1.0},
          {4.4, from_there(0.0, 0.0, -0.05), 1.0},
          {5.2, from_there(0.16, 0.0, -0.05), 1.0},
          {5.7, from_there(0.16, 0.0, -0.05), 1.0},
          {6.2, from_there(0.16, 0.05, -0.05), 1.0},
          {6.7, from_there(0.05, 0.05, -0.05), 1.0},
          {7.0, from_there(0.05, 0.05, -0.05), 1.0},
          {7.3, from_there(0.05, 0.05, -0.05), 0.0},
          {7.6, from_there(0.05, 0.05, -0.05), 0.0},
          {8.2, from_there(0.05, 0.05, -0.25), 0.0},
          {8.5, from_there(0.05, 0.05, -0.25), 0.0}};
}

VisibleBodies visible_bodies() {
  const auto ball = std::make_shared<const geometry::TriangleMesh>(geometry::make_sphere(kBallRadius_m, 2000));
  const auto wall = std::make_shared<const geometry::TriangleMesh>(geometry::make_box(kWallEdges_m, 2000));
  return {ball, {{wall, kWallPlace}}};
}

class TwoHands : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    ASSERT_NE(std::getenv("GLISSADE_NETWORK_NAMESPACE"), nullptr) << "would send outside of this test";
    folder = std::make_unique<test_support::TemporaryFolder>();
    server = test_support::record_two_hands(
        *folder, kScene, {script_text(first_hand(), kThumb), script_text(second_hand(), kThumb)}, kSeconds, log());
    ASSERT_EQ(server.exit_code, 0) << server.standard_error;
    recorded = read_ticks(log());
  }
  static void TearDownTestSuite() { folder.reset(); }

  static std::string log() { return folder->path("run.lcmlog"); }
  static Vector3d ball_of(const RecordedTick& tick) { return tick.state.parts[0].X_WV.translation(); }

  static inline std::unique_ptr<test_support::TemporaryFolder> folder;
  static inline ProgramResult server;
  static inline std::vector<RecordedTick> recorded;
};

// Whenever that is: on a busy computer, gloves and server begin one after the other.
TEST_F(TwoHands, TakeHoldShareCarryAndLeave) {
  using Held = test_support::HeldByHands;
  std::vector<Vector3d> carried;  // by the second hand alone
  for (const RecordedTick& tick : recorded) {
    if (tick.state.hands[0].part == -1 && tick.state.hands[1].part == 0) carried.push_back(ball_of(tick));
  }
  EXPECT_THAT(test_support::holds_of(recorded),
              ElementsAre(Held(-1, -1), Held(0, -1), Held(0, 0), Held(-1, 0), Held(-1, -1)))
      << server.standard_error;
  ASSERT_FALSE(carried.empty());
  const auto farthest = std::max_element(carried.begin(), carried.end(),
                                         [](const Vector3d& a, const Vector3d& b) { return a.x() < b.x(); });
  EXPECT_GT(farthest->x(), carried.front().x() + 0.08) << "carried to the wall";
  EXPECT_GT(carried.back().y(), carried.front().y() + 0.03) << "along it";
  EXPECT_LT(carried.back().x(), farthest->x() - 0.02) << "and back";
  EXPECT_EQ(ball_of(recorded.back()), ball_of(*(recorded.end() - 100))) << "it stays where it was left";
  const nlohmann::json summary = nlohmann::json::parse(server.standard_output);
  EXPECT_EQ(summary["colliding_poses"], 0);
  EXPECT_EQ(summary["hands"][0]["has_fingers"], true);
}

TEST_F(TwoHands, VisibleBodiesNeverCollide) {
  VisibleBodies bodies = visible_bodies();
  for (std::size_t i = 0; i < recorded.size(); i += 5)
    ASSERT_FALSE(bodies.collide(recorded[i].state)) << "after " << i << " ms";
}

/// How far the joint of a glove that feels a torque is from the stop of the visible finger, in rad; of all joints the
/// greatest.
double beyond_the_stop(const RecordedTick& tick) {
  const devices::HapticHandState& hand = tick.state.hands[0];
  double greatest = 0.0;
  for (std::size_t joint = 0; joint < kJoints; ++joint) {
    if (hand.joint_torques[joint] != 0.0)
      greatest = std::max(greatest, std::abs(tick.gloves[0].joint_angles[joint] - hand.visible.angles[joint]));
  }
  return greatest;
}

// The wearer wants to close them by 30° and more beyond that. A slow link makes the springs weaker, and where the
// computer stalls, fingers go deeper for a while: so half of the ticks with a torque are enough, of those that follow
// 50 ms without a stall.
TEST_F(TwoHands, StopTheFingersOfTheGlove) {
  ASSERT_GE(recorded.size(), 2500U);
  const devices::DeviceDescriptor device = devices::simulated_glove_descriptor();
  constexpr std::chrono::milliseconds kPunctual{4};
  int felt = 0;
  int judged = 0;
  int stopped = 0;
  int punctual_ticks = 0;
  for (std::size_t i = 1200; i < 2500; ++i) {
    const bool is_punctual =
        recorded[i].gloves[0].command_age < kPunctual && recorded[i].time - recorded[i - 1].time < kPunctual;
    punctual_ticks = is_punctual ? punctual_ticks + 1 : 0;
    const JointValues& torques = recorded[i].state.hands[0].joint_torques;
    const double greatest_Nm = std::abs(*std::max_element(
        torques.begin(), torques.end(), [](double a, double b) { return std::abs(a) < std::abs(b); }));
    if (greatest_Nm == 0.0) continue;
    ++felt;
    if (punctual_ticks < 50) continue;
    ++judged;
    const double stiffness = haptics::finger_stiffness(device, haptics::kTickPeriod, recorded[i].gloves[0].link_delay);
    if (beyond_the_stop(recorded[i]) <= std::max(2.0 * kDegree, 1.5 * greatest_Nm / stiffness)) ++stopped;
  }
  EXPECT_GT(felt, 100);
  if (judged < 100) GTEST_SKIP() << "the computer stalls too often";
  EXPECT_GE(2 * stopped, judged) << felt << " felt";
}

TEST(OneHand, StopsItsFingersAtTheSurface) {
  const test_support::TemporaryFolder folder;
  const std::string log = folder.path("run.lcmlog");
  std::vector<HandPause> pauses = first_hand();
  pauses.resize(4);  // it holds the ball
  folder.write("hand.csv", script_text(pauses, kThumb));
  const std::string scene = folder.write("scene.yaml", std::string(kScene) + "script: hand.csv\n");
  const ProgramResult run =
      test_support::glissade({"demo", "--offline", "--scene", scene, "--seconds", "3", "--record", log});
  ASSERT_EQ(run.exit_code, 0) << run.standard_error;
  const RecordedTick at_rest = read_ticks(log).back();
  const devices::HapticHandState& hand = at_rest.state.hands[0];
  EXPECT_LE(beyond_the_stop(at_rest), kDegree);
  VisibleBodies bodies = visible_bodies();
  int stopped = 0;
  for (std::size_t joint = 0; joint < kJoints; ++joint) {
    hands::VisibleHand deeper = hand.visible;
    deeper.angles[joint] -= std::copysign(kDegree, hand.joint_torques[joint]);
    if (hand.joint_torques[joint] != 0.0 && bodies.collides(deeper, at_rest.state.parts[0].X_WV)) ++stopped;
  }
  EXPECT_GE(stopped, 3) << "joints that a degree more would bring into the ball";
}

TEST_F(TwoHands, ForceNeverJumpsAndIsZeroAtTheEnd) {
  EXPECT_GT(test_support::expect_nothing_that_jumps(recorded), 2.0) << "the wall";
  for (std::size_t i = static_cast<std::size_t>(8.3e3); i < recorded.size(); ++i) {
    for (std::size_t h = 0; h < 2; ++h) {
      ASSERT_TRUE(recorded[i].state.hands[h].force_W.isZero(0.0)) << i;
      ASSERT_EQ(recorded[i].state.hands[h].joint_torques, JointValues{}) << i;
    }
  }
}

TEST_F(TwoHands, ReplayIsBitIdentical) {
  const ProgramResult replay = test_support::glissade({"replay", log()});
  EXPECT_EQ(replay.exit_code, 0) << replay.standard_error;
  EXPECT_THAT(replay.standard_output, HasSubstr("bit-identical"));
}

}  // namespace
}  // namespace glissade::apps
