/// Two gloves whose fingers grasp, and a server, each a process of its own over UDP multicast, in a network namespace.
/// One hand takes a ball, both hold it, the other carries it to a wall, slides it along there and leaves it. All is
/// checked from the recording of the run, by code that shares nothing with the simulation. What depends on the delay of
/// the link to the last degree is checked in an offline run.

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <memory>
#include <numbers>
#include <optional>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <glissade/devices/event_log.h>
#include <glissade/devices/simulated_glove.h>
#include <glissade/geometry/mesh_generators.h>
#include <glissade/grasping/hand_model.h>
#include <glissade/haptics/finger_forces.h>
#include <glissade/haptics/recording.h>
#include <glissade/reference/grid_check.h>

#include "glissade_program.h"
#include "poses.h"
#include "temporary_folder.h"

namespace glissade::apps {
namespace {

using devices::HapticState;
using devices::JointValues;
using devices::kGloveJoints;
using Eigen::Isometry3d;
using Eigen::Vector3d;
using test_support::at;
using test_support::Process;
using test_support::ProgramResult;
using testing::ElementsAre;
using testing::HasSubstr;

constexpr const char* kUrl = "udpm://239.255.76.67:7667?ttl=0";
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

/// A time of a script: where the hand root is, and how far the fingers are closed, from 0 to 1.
struct Pause {
  double time_s;
  Isometry3d X_WH;
  double closed;
};

/// Thumb and fingers from the open hand to one that is closed in a ball of this size.
JointValues fingers(double closed) {
  const auto between = [closed](double open_deg, double closed_deg) {
    return kDegree * (open_deg + closed * (closed_deg - open_deg));
  };
  JointValues angles{between(20, 60), between(-10, 45), between(-15, 40), between(35, 20)};
  for (const std::size_t first : {4U, 7U, 11U, 15U}) {
    angles[first] = between(-15, 55);
    angles[first + 1] = between(0, 75);
    angles[first + 2] = between(-5, 55);
  }
  return angles;
}

std::string csv_of(const std::vector<Pause>& pauses) {
  std::ostringstream text;
  text.precision(12);
  text << "t_s,x_m,y_m,z_m,qw,qx,qy,qz";
  for (const std::string_view name : devices::kGloveJointNames)
    text << ',' << name << "_rad";
  for (const Pause& pause : pauses) {
    const Eigen::Quaterniond q(pause.X_WH.linear());
    const Vector3d p = pause.X_WH.translation();
    text << '\n' << pause.time_s << ',' << p.x() << ',' << p.y() << ',' << p.z();
    text << ',' << q.w() << ',' << q.x() << ',' << q.y() << ',' << q.z();
    for (const double angle : fingers(pause.closed))
      text << ',' << angle;
  }
  return text.str() + '\n';
}

/// Takes the ball in its palm, and opens again when the other hand has it.
std::vector<Pause> first_hand() {
  const Isometry3d here = Isometry3d::Identity();
  const Isometry3d above = at(0.0, 0.0, 0.2);
  return {{0.0, here, 0.0}, {0.5, here, 0.0}, {0.8, here, 1.0},  {3.0, here, 1.0},
          {3.2, here, 0.0}, {3.4, here, 0.0}, {4.0, above, 0.0}, {8.5, above, 0.0}};
}

/// Comes from below, upside down, to the ball in the other hand; carries it to the wall, along there, and back.
std::vector<Pause> second_hand() {
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

/// The visible bodies of a tick, and whether any two of them collide that must not.
class VisibleBodies {
 public:
  bool collide(const HapticState& state) {
    const Isometry3d& X_WV = state.parts[0].X_WV;
    if (wall_check_.collides(*ball_, X_WV)) return true;
    return std::any_of(state.hands.begin(), state.hands.begin() + state.hand_count,
                       [&](const devices::HapticHandState& hand) { return collides(hand.visible, X_WV); });
  }

  bool collides(const devices::VisibleHand& hand, const Isometry3d& X_WV) {
    if (hand.activity != devices::HandActivity::kFree && hand.activity != devices::HandActivity::kHolding) return false;
    model_.chain.poses(hand.X_WH, hand.angles, X_WL_);
    for (std::size_t link = 0; link < X_WL_.size(); ++link) {
      const auto& mesh = model_.chain.links()[link].mesh;
      if (mesh == nullptr) continue;
      if (wall_check_.collides(*mesh, X_WL_[link]) || ball_check_.collides(*mesh, X_WV.inverse() * X_WL_[link]))
        return true;
    }
    return false;
  }

 private:
  std::shared_ptr<const geometry::TriangleMesh> ball_ =
      std::make_shared<const geometry::TriangleMesh>(geometry::make_sphere(kBallRadius_m, 2000));
  reference::GridCheck ball_check_{{{ball_}}};
  reference::GridCheck wall_check_{
      {{std::make_shared<const geometry::TriangleMesh>(geometry::make_box(kWallEdges_m, 2000)), kWallPlace}}};
  grasping::HandModel model_ = grasping::make_hand();
  std::vector<Isometry3d> X_WL_ = std::vector<Isometry3d>(grasping::kHandLinks);
};

/// A tick, and what the gloves had told.
struct RecordedTick {
  HapticState state;
  std::array<devices::GloveState, 2> gloves;
  std::chrono::nanoseconds time{0};
};

std::vector<RecordedTick> read_ticks(const std::string& path) {
  std::vector<RecordedTick> ticks;
  std::optional<haptics::TickRecord> newest;
  devices::EventLogReader log(path);
  while (const auto event = log.next()) {
    if (event->channel == "HAPTIC_TICK") {
      newest = haptics::consumed_by_tick(*event);
    } else if (const auto state = devices::haptic_state_of(*event); state && newest) {
      ticks.push_back({*state, {newest->states[0], newest->states[1]}, newest->time});
    }
  }
  EXPECT_EQ(log.damage(), "");
  return ticks;
}

class TwoHands : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    ASSERT_NE(std::getenv("GLISSADE_NETWORK_NAMESPACE"), nullptr) << "would send outside of this test";
    folder = std::make_unique<test_support::TemporaryFolder>();
    const std::string scene = folder->write("scene.yaml", kScene);
    std::array<std::unique_ptr<Process>, 2> gloves;
    for (std::size_t h = 0; h < gloves.size(); ++h) {
      const std::string number = std::to_string(h + 1);
      gloves[h] = std::make_unique<Process>(std::vector<std::string>{
          GLISSADE_PROGRAM, "glove", "--lcm", kUrl, "--device", number, "--script",
          folder->write("hand_" + number + ".csv", csv_of(h == 0 ? first_hand() : second_hand()))});
    }
    server = test_support::glissade({"record", log(), scene, "--lcm", kUrl, "--device", "1", "2", "--fingers",
                                     "--seconds", std::to_string(kSeconds), "--json"});
    for (const std::unique_ptr<Process>& glove : gloves) {
      glove->signal(SIGINT);
      EXPECT_EQ(glove->wait().exit_code, 0);
    }
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
  using Held = std::pair<std::int32_t, std::int32_t>;
  std::vector<Held> holds;
  std::vector<Vector3d> carried;  // by the second hand alone
  for (const RecordedTick& tick : recorded) {
    const Held now{tick.state.hands[0].part, tick.state.hands[1].part};
    if (holds.empty() || holds.back() != now) holds.push_back(now);
    if (now == Held(-1, 0)) carried.push_back(ball_of(tick));
  }
  EXPECT_THAT(holds, ElementsAre(Held(-1, -1), Held(0, -1), Held(0, 0), Held(-1, 0), Held(-1, -1)))
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

TEST_F(TwoHands, ShowNothingThatPenetrates) {
  VisibleBodies bodies;
  for (std::size_t i = 0; i < recorded.size(); i += 5)
    ASSERT_FALSE(bodies.collide(recorded[i].state)) << "after " << i << " ms";
}

/// How far the joint of a glove that feels a torque is from the stop of the visible finger, in rad; of all joints the
/// greatest.
double beyond_the_stop(const RecordedTick& tick) {
  const devices::HapticHandState& hand = tick.state.hands[0];
  double greatest = 0.0;
  for (std::size_t joint = 0; joint < kGloveJoints; ++joint) {
    if (hand.joint_torques[joint] != 0.0)
      greatest = std::max(greatest, std::abs(tick.gloves[0].joint_angles[joint] - hand.visible.angles[joint]));
  }
  return greatest;
}

// The wearer wants to close them by 30° and more beyond that. A slow link makes the springs weaker, and where the
// computer stalls, fingers go deeper for a while: so half of the ticks with a torque are enough.
TEST_F(TwoHands, StopTheFingersOfTheGlove) {
  ASSERT_GE(recorded.size(), 2500U);
  const devices::DeviceDescriptor device = devices::simulated_glove_descriptor();
  int felt = 0;
  int stopped = 0;
  for (std::size_t i = 1200; i < 2500; ++i) {
    const JointValues& torques = recorded[i].state.hands[0].joint_torques;
    const double greatest_Nm = std::abs(*std::max_element(
        torques.begin(), torques.end(), [](double a, double b) { return std::abs(a) < std::abs(b); }));
    if (greatest_Nm == 0.0) continue;
    ++felt;
    const double stiffness = haptics::finger_stiffness(device, haptics::kTickPeriod, recorded[i].gloves[0].link_delay);
    if (beyond_the_stop(recorded[i]) <= std::max(2.0 * kDegree, 1.5 * greatest_Nm / stiffness)) ++stopped;
  }
  EXPECT_GT(felt, 100);
  EXPECT_GT(2 * stopped, felt);
}

TEST(OneHand, StopsItsFingersAtTheSurface) {
  const test_support::TemporaryFolder folder;
  const std::string log = folder.path("run.lcmlog");
  std::vector<Pause> pauses = first_hand();
  pauses.resize(4);  // it holds the ball
  folder.write("hand.csv", csv_of(pauses));
  const std::string scene = folder.write("scene.yaml", std::string(kScene) + "script: hand.csv\n");
  const ProgramResult run =
      test_support::glissade({"demo", "--offline", "--scene", scene, "--seconds", "3", "--record", log});
  ASSERT_EQ(run.exit_code, 0) << run.standard_error;
  const RecordedTick at_rest = read_ticks(log).back();
  const devices::HapticHandState& hand = at_rest.state.hands[0];
  EXPECT_LE(beyond_the_stop(at_rest), kDegree);
  VisibleBodies bodies;
  int stopped = 0;
  for (std::size_t joint = 0; joint < kGloveJoints; ++joint) {
    devices::VisibleHand deeper = hand.visible;
    deeper.angles[joint] -= std::copysign(kDegree, hand.joint_torques[joint]);
    if (hand.joint_torques[joint] != 0.0 && bodies.collides(deeper, at_rest.state.parts[0].X_WV)) ++stopped;
  }
  EXPECT_GE(stopped, 3) << "joints that a degree more would bring into the ball";
}

TEST_F(TwoHands, FeelNothingThatJumpsAndNothingThatLasts) {
  const devices::DeviceDescriptor device = devices::simulated_glove_descriptor();
  constexpr double kRise_s = 7e-3;  // from zero to the maximum
  double greatest_N = 0.0;
  for (std::size_t i = 1; i < recorded.size(); ++i) {
    // The envelope counts at most two periods for a step.
    const double dt =
        std::clamp(std::chrono::duration<double>(recorded[i].time - recorded[i - 1].time).count(), 0.0, 2e-3) + 1e-9;
    for (std::size_t h = 0; h < 2; ++h) {
      const devices::HapticHandState& now = recorded[i].state.hands[h];
      const devices::HapticHandState& before = recorded[i - 1].state.hands[h];
      ASSERT_LE((now.force_W - before.force_W).norm(), device.max_force / kRise_s * dt) << i;
      ASSERT_LE(now.force_W.norm(), device.max_force * (1.0 + 1e-9)) << i;
      greatest_N = std::max(greatest_N, now.force_W.norm());
      for (std::size_t joint = 0; joint < kGloveJoints; ++joint) {
        const double torque = now.joint_torques[joint];
        ASSERT_LE(std::abs(torque - before.joint_torques[joint]), device.max_joint_torque / kRise_s * dt) << i;
        ASSERT_LE(std::abs(torque), device.max_joint_torque) << i;
      }
    }
  }
  EXPECT_GT(greatest_N, 2.0) << "the wall";
  for (std::size_t i = static_cast<std::size_t>(8.3e3); i < recorded.size(); ++i) {
    for (std::size_t h = 0; h < 2; ++h) {
      ASSERT_TRUE(recorded[i].state.hands[h].force_W.isZero(0.0)) << i;
      ASSERT_EQ(recorded[i].state.hands[h].joint_torques, JointValues{}) << i;
    }
  }
}

TEST_F(TwoHands, AreRepeatedToTheBit) {
  const ProgramResult replay = test_support::glissade({"replay", log()});
  EXPECT_EQ(replay.exit_code, 0) << replay.standard_error;
  EXPECT_THAT(replay.standard_output, HasSubstr("same to the bit"));
}

}  // namespace
}  // namespace glissade::apps
