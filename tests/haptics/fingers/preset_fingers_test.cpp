/// The gloves of the presets in the whole loop: a wearer with tremor and reflex closes the hand round a ball, and holds
/// it at rest. What the fingers feel, and where they stop.

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <memory>
#include <numbers>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include <glissade/devices/glove_model.h>
#include <glissade/geometry/mesh_generators.h>
#include <glissade/grasping/grasp_simulation.h>
#include <glissade/haptics/offline_run.h>

#include "clasped_hand.h"
#include "closing_hand.h"

namespace glissade::haptics {
namespace {

using hands::kJoints;
using std::chrono::milliseconds;

constexpr int kRest_ms = 2500;         // when the hand has come to rest
constexpr int kWatched_ms = 2000;      // from then on
constexpr double kPressing_Nm = 0.05;  // more than the friction of any preset

/// A finger joint that presses, at rest.
struct PressedJoint {
  double error_deg = 0.0;         ///< of the stop: mean distance from the visible joint
  std::vector<double> torques{};  ///< Nm, each millisecond
};

struct HeldBall {
  std::vector<PressedJoint> joints{};
  int held_ms = 0;  ///< of the watched time
};

devices::SimulatedGlove closing_glove(const devices::GloveModel& model) {
  devices::SimulatedGloveParameters wearer;
  wearer.fingers = {{milliseconds(0), test_support::kOpenHand},
                    {milliseconds(400), test_support::kOpenHand},
                    {milliseconds(1400), test_support::kClosedHand}};
  return devices::SimulatedGlove(geometry::PoseTrajectory({geometry::TimedPose{}}), wearer, model);
}

HeldBall hold_ball(devices::GloveModel model, double grip_Nm) {
  model.wearer.grip = grip_Nm;
  grasping::GraspSimulation simulation(
      {},
      {{.part_V = std::make_shared<const contact::SlidingPart>(test_support::ball_for_hand()),
        .X_WV_start = test_support::kBallInHand}},
      std::vector<std::shared_ptr<const grasping::HandModel>>{test_support::hand_model()});
  devices::SimulatedGlove glove = closing_glove(model);
  std::array<PressedJoint, kJoints> joints;
  HeldBall result;
  const auto watch = [&](const devices::HapticState& state) {
    if (state.sequence <= kRest_ms) return;
    result.held_ms += state.hands[0].part == 0 ? 1 : 0;
    for (std::size_t j = 0; j < kJoints; ++j) {
      joints[j].torques.push_back(glove.felt_torques()[j]);
      const double error = glove.true_state().joint_angles[j] - state.hands[0].visible.angles[j];
      joints[j].error_deg += std::abs(error) * 180.0 / std::numbers::pi / kWatched_ms;
    }
  };
  run_offline({{&glove}}, simulation, kRest_ms + kWatched_ms, watch);
  for (PressedJoint& joint : joints) {
    const auto presses = [](double torque) { return std::abs(torque) > kPressing_Nm; };
    if (std::all_of(joint.torques.begin(), joint.torques.end(), presses)) result.joints.push_back(std::move(joint));
  }
  return result;
}

double mean_of(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values)
    sum += value;
  return sum / static_cast<double>(values.size());
}

/// Root mean square of all that is faster than 30 Hz, by the discrete Fourier transform in a Hann window.
double rms_above_30_Hz(const std::vector<double>& values) {
  const double mean = mean_of(values);
  const auto n = static_cast<double>(values.size());
  const auto first = static_cast<std::size_t>(30.0 * n / 1000.0);
  double power = 0.0;
  for (std::size_t k = first; k < values.size() / 2; ++k) {
    double real = 0.0;
    double imaginary = 0.0;
    for (std::size_t i = 0; i < values.size(); ++i) {
      const double turn = 2.0 * std::numbers::pi * static_cast<double>(i) / n;
      const double windowed = (values[i] - mean) * 0.5 * (1.0 - std::cos(turn));
      real += windowed * std::cos(static_cast<double>(k) * turn);
      imaginary += windowed * std::sin(static_cast<double>(k) * turn);
    }
    power += 2.0 * (real * real + imaginary * imaginary) / (n * n);
  }
  constexpr double kPowerOfWindow = 3.0 / 8.0;
  return std::sqrt(power / kPowerOfWindow);
}

struct Device {
  const char* preset;
  double grip_Nm;    ///< that the device can withstand
  double error_deg;  ///< allowed for the stop
  std::size_t joints;
};

void PrintTo(const Device& device, std::ostream* stream) {
  *stream << device.preset;
}

class PresetFingers : public testing::TestWithParam<Device> {};

TEST_P(PresetFingers, StopAtTheBallAndDoNotChatter) {
  const Device& device = GetParam();
  const HeldBall held = hold_ball(devices::read_glove_model(device.preset), device.grip_Nm);
  EXPECT_EQ(held.held_ms, kWatched_ms) << "the ball is not let go for a moment";
  EXPECT_GE(held.joints.size(), device.joints);
  for (const PressedJoint& joint : held.joints) {
    EXPECT_LE(joint.error_deg, device.error_deg);
    EXPECT_LE(rms_above_30_Hz(joint.torques), 0.05 * std::abs(mean_of(joint.torques)));
  }
}

INSTANTIATE_TEST_SUITE_P(WithFingers, PresetFingers,
                         testing::Values(Device{"dynamixel", 0.2, 2.05, 3}, Device{"sense_glove_r1", 0.2, 2.0, 6},
                                         Device{"opengloves", 0.1, 4.0, 3}, Device{"brake", 0.2, 15.0, 2}),
                         [](const auto& info) { return std::string(info.param.preset); });

}  // namespace
}  // namespace glissade::haptics
