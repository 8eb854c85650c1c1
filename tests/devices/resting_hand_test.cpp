/// A hand at rest feels one smooth force, whatever others have taken from it or given to it; and a hand that presses
/// feels it soon.

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include <glissade/devices/safety_envelope.h>
#include <glissade/devices/simulated_glove.h>

namespace glissade::devices {
namespace {

using std::chrono::milliseconds;

constexpr double kDebts_J[] = {-20.0, -3.0, -0.5, -0.1, 0.0, 0.5, 3.0, 20.0};
constexpr double kMasses[] = {0.1, 0.3, 0.8, 3.0};
constexpr double kDampings[] = {0.0, 0.5, 2.0, 5.0};

geometry::TimedPose at_depth(milliseconds time, double depth) {
  return {time, Eigen::Isometry3d(Eigen::Translation3d(0.0, 0.0, -depth))};
}

/// A glove on its wearer. A server tells from 0.5 s on, within some time, what others have taken or given.
class WornGlove {
 public:
  WornGlove(const std::vector<geometry::TimedPose>& script, const SimulatedGloveParameters& parameters, double supply)
      : glove_(geometry::PoseTrajectory(script), parameters), supply_(supply) {}

  /// A millisecond in which the server wants this force, upwards. Returns the force that the hand gets.
  double step(double wanted) {
    const GloveState state = glove_.step(milliseconds(1), given_);
    GloveCommand command;
    command.sequence = ++ms_;
    command.state_sequence = state.sequence;
    command.state_time = state.time;
    command.f_H_W.z() = wanted;
    const double told = 0.02 * static_cast<double>(std::max<std::int64_t>(0, ms_ - 500));
    command.supply = std::clamp(supply_, -told, told);
    given_ = envelope_.limit(command, state, state.time + std::chrono::seconds(5));
    return force();
  }

  double force() const { return given_.values().f_H_W.z(); }
  double depth() const { return -glove_.state().X_WH.translation().z(); }

 private:
  SimulatedGlove glove_;
  SafetyEnvelope envelope_{glove_.descriptor(), 6.0};
  SafeCommand given_;
  std::int64_t ms_ = 0;
  double supply_;
};

template <typename Test>
void for_each_hand(const Test& test) {
  for (const double debt : kDebts_J) {
    for (const double mass : kMasses) {
      for (const double damping : kDampings) {
        SCOPED_TRACE(testing::Message() << debt << " J, " << mass << " kg, " << damping << " N s/m");
        SimulatedGloveParameters parameters;
        parameters.mass = mass;
        parameters.arm_damping = damping;
        test(debt, parameters);
      }
    }
  }
}

/// Steps up and down, one after the other, whose product is more than 0.5 N².
class Alternations {
 public:
  void see(double force) {
    const double step = force - force_.value_or(force);
    count += step * step_ < -0.5 ? 1 : 0;
    step_ = step;
    force_ = force;
  }
  int count = 0;

 private:
  std::optional<double> force_;
  double step_ = 0.0;
};

/// A server that wants 20 N from now on, whatever the hand does.
TEST(RestingHand, ForceIsSteadyAtAnyEnergyTakenOrGivenByOtherHands) {
  for_each_hand([](double debt, SimulatedGloveParameters parameters) {
    for (const double wearer_damping : {5.0, 35.0}) {
      parameters.wearer_damping = wearer_damping;
      WornGlove hand({at_depth(milliseconds(0), 0.0)}, parameters, debt);
      Alternations alternations;
      for (int ms = 0; ms < 6000; ++ms) {
        const double before = hand.force();
        const double force = hand.step(ms < 600 ? 0.0 : 20.0);
        if (ms >= 700) alternations.see(force);  // the force has set in
        if (ms >= 5000 && wearer_damping > 5.0) {
          ASSERT_LE(std::abs(force - before), 0.01 * force) << ms;
        }
      }
      EXPECT_EQ(alternations.count, 0);
      if (wearer_damping > 5.0) {
        EXPECT_GT(hand.force(), 19.0) << "one with less still swings";
      }
    }
  });
}

/// A wall of 1000 N/m, into which the hand wants to go by 60 mm.
TEST(PressingHand, WallForceReturnsAtAnyEnergyTakenOrGivenByOtherHands) {
  for_each_hand([](double debt, const SimulatedGloveParameters& parameters) {
    WornGlove hand({at_depth(milliseconds(0), -5e-3), at_depth(milliseconds(1700), -5e-3),
                    at_depth(milliseconds(2000), 0.06), at_depth(milliseconds(9000), 0.06)},
                   parameters, debt);
    Alternations alternations;
    const auto press = [&](int ms) {
      for (int i = 0; i < ms; ++i)
        alternations.see(hand.step(std::clamp(1000.0 * hand.depth(), 0.0, 20.0)));
    };
    press(4000);
    EXPECT_GT(hand.force(), 0.95 * std::min(20.0, 1000.0 * hand.depth()));
    EXPECT_GT(hand.force(), 14.0) << "60 mm by springs of 400 and 1000 N/m in a row: 17 N";
    EXPECT_EQ(alternations.count, 0);
  });
}

}  // namespace
}  // namespace glissade::devices
