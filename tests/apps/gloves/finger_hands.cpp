#include "finger_hands.h"

#include <algorithm>
#include <csignal>
#include <numbers>
#include <optional>
#include <sstream>
#include <string_view>

#include <gtest/gtest.h>

#include <glissade/devices/event_log.h>
#include <glissade/devices/simulated_glove.h>
#include <glissade/haptics/recording.h>

#include "glissade_program.h"

namespace glissade::test_support {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using hands::JointValues;
using hands::kJoints;

namespace {

/// The four long fingers bend alike.
JointValues angles_of(const ThumbShape& thumb, double closed) {
  constexpr double kDegree = std::numbers::pi / 180.0;
  const auto between = [closed](double open_deg, double closed_deg) {
    return kDegree * (open_deg + closed * (closed_deg - open_deg));
  };
  JointValues angles{};
  for (std::size_t i = 0; i < thumb.open.size(); ++i)
    angles[i] = between(thumb.open[i], thumb.closed[i]);
  for (const std::size_t first : {4U, 7U, 11U, 15U}) {
    angles[first] = between(-15, 55);
    angles[first + 1] = between(0, 75);
    angles[first + 2] = between(-5, 55);
  }
  return angles;
}

}  // namespace

std::string script_text(const std::vector<HandPause>& pauses, const ThumbShape& thumb) {
  std::ostringstream text;
  text.precision(12);
  text << "t_s,x_m,y_m,z_m,qw,qx,qy,qz";
  for (const std::string_view name : hands::kJointNames)
    text << ',' << name << "_rad";
  for (const HandPause& pause : pauses) {
    const Eigen::Quaterniond q(pause.X_WH.linear());
    const Vector3d p = pause.X_WH.translation();
    text << '\n' << pause.time_s << ',' << p.x() << ',' << p.y() << ',' << p.z();
    text << ',' << q.w() << ',' << q.x() << ',' << q.y() << ',' << q.z();
    for (const double angle : angles_of(thumb, pause.closed))
      text << ',' << angle;
  }
  return text.str() + '\n';
}

ProgramResult record_two_hands(const TemporaryFolder& folder, const std::string& scene,
                               const std::array<std::string, 2>& scripts, double seconds, const std::string& log) {
  const std::string scene_file = folder.write("scene.yaml", scene);
  std::array<std::unique_ptr<Process>, 2> gloves;
  for (std::size_t h = 0; h < gloves.size(); ++h) {
    const std::string number = std::to_string(h + 1);
    const std::string script = folder.write("hand_" + number + ".csv", scripts[h]);
    gloves[h] = std::make_unique<Process>(
        std::vector<std::string>{GLISSADE_PROGRAM, "glove", "--lcm", kUrl, "--device", number, "--script", script});
  }
  ProgramResult server = glissade({"record", log, scene_file, "--lcm", kUrl, "--device", "1", "2", "--fingers",
                                   "--seconds", std::to_string(seconds), "--json"});
  for (const std::unique_ptr<Process>& glove : gloves) {
    glove->signal(SIGINT);
    EXPECT_EQ(glove->wait().exit_code, 0);
  }
  return server;
}

std::vector<RecordedTick> read_ticks(const std::string& log_file) {
  std::vector<RecordedTick> ticks;
  std::optional<haptics::TickRecord> newest;
  devices::EventLogReader log(log_file);
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

std::vector<HeldByHands> holds_of(const std::vector<RecordedTick>& ticks) {
  std::vector<HeldByHands> holds;
  for (const RecordedTick& tick : ticks) {
    const HeldByHands now{tick.state.hands[0].part, tick.state.hands[1].part};
    if (holds.empty() || holds.back() != now) holds.push_back(now);
  }
  return holds;
}

VisibleBodies::VisibleBodies(std::shared_ptr<const geometry::TriangleMesh> part,
                             const std::vector<reference::PlacedMesh>& obstacles)
    : part_(std::move(part)), part_check_({{part_}}), obstacle_check_(obstacles), X_WL_(grasping::kHandLinks) {}

bool VisibleBodies::collide(const devices::HapticState& state) {
  const Isometry3d& X_WV = state.parts[0].X_WV;
  if (obstacle_check_.collides(*part_, X_WV)) return true;
  return std::any_of(state.hands.begin(), state.hands.begin() + state.hand_count,
                     [&](const devices::HapticHandState& hand) { return collides(hand.visible, X_WV); });
}

bool VisibleBodies::collides(const hands::VisibleHand& hand, const Isometry3d& X_WV) {
  if (hand.activity != hands::HandActivity::kFree && hand.activity != hands::HandActivity::kHolding) return false;
  model_.chain.poses(hand.X_WH, hand.angles, X_WL_);
  for (std::size_t link = 0; link < X_WL_.size(); ++link) {
    const auto& mesh = model_.chain.links()[link].mesh;
    if (mesh == nullptr) continue;
    if (obstacle_check_.collides(*mesh, X_WL_[link]) || part_check_.collides(*mesh, X_WV.inverse() * X_WL_[link]))
      return true;
  }
  return false;
}

double expect_nothing_that_jumps(const std::vector<RecordedTick>& ticks) {
  const devices::DeviceDescriptor device = devices::simulated_glove_descriptor();
  constexpr double kRise_s = 7e-3;  // from zero to the maximum
  constexpr double kJointRise_s = 2e-3;
  double greatest_N = 0.0;
  for (std::size_t i = 1; i < ticks.size(); ++i) {
    // The envelope counts at most two periods for a step.
    const double dt =
        std::clamp(std::chrono::duration<double>(ticks[i].time - ticks[i - 1].time).count(), 0.0, 2e-3) + 1e-9;
    for (std::size_t h = 0; h < 2; ++h) {
      const devices::HapticHandState& now = ticks[i].state.hands[h];
      const devices::HapticHandState& before = ticks[i - 1].state.hands[h];
      EXPECT_LE((now.force_W - before.force_W).norm(), device.max_force / kRise_s * dt) << i;
      EXPECT_LE(now.force_W.norm(), device.max_force * (1.0 + 1e-9)) << i;
      greatest_N = std::max(greatest_N, now.force_W.norm());
      for (std::size_t joint = 0; joint < kJoints; ++joint) {
        const double torque = now.joint_torques[joint];
        EXPECT_LE(std::abs(torque - before.joint_torques[joint]), device.max_joint_torque / kJointRise_s * dt) << i;
        EXPECT_LE(std::abs(torque), device.max_joint_torque) << i;
      }
    }
  }
  return greatest_N;
}

}  // namespace glissade::test_support
