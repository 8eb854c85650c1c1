/// A hand that presses on a wall by a device that is late, slow or measures with noise.

#include <algorithm>
#include <chrono>
#include <cmath>
#include <deque>
#include <random>

#include <gtest/gtest.h>

#include <glissade/devices/safety_envelope.h>
#include <glissade/devices/simulated_glove.h>

#include "random_numbers.h"

namespace glissade::devices {
namespace {

using std::chrono::microseconds;
using std::chrono::milliseconds;

/// In SI units.
struct Arm {
  double mass = 0.8;
  double stiffness = 400.0;  ///< toward where the hand wants to be
  double damping = 35.0;     ///< of hand and device
};

/// Moves along z, by semi-implicit Euler in steps of 0.1 ms. The wall is at z = 0 and wants `stiffness` times the
/// depth, whatever the device can render.
class PressedWall {
 public:
  PressedWall(const DeviceDescriptor& device, const Arm& arm, double stiffness)
      : device_(device), arm_(arm), stiffness_(stiffness), envelope_(device, 6.0) {}

  /// A millisecond in which the hand wants to be at this depth.
  void step(double depth) {
    for (int i = 0; i < 10; ++i) {
      if (now_ >= next_period_) {
        next_period_ += microseconds(std::lround(1e6 / device_.update_rate));
        command();
      }
      while (!on_their_way_.empty() && on_their_way_.front().acts <= now_) {
        force_ = on_their_way_.front().force;
        on_their_way_.pop_front();
      }
      v_ += 1e-4 * (force_ - arm_.damping * v_ - arm_.stiffness * (z_ + depth)) / arm_.mass;
      z_ += 1e-4 * v_;
      work_ += 1e-4 * v_ * force_;
      now_ += microseconds(100);
    }
  }

  double force() const { return force_; }  ///< N
  double work() const { return work_; }    ///< J, on the hand

  bool is_enabled = true;
  double noise = 0.0;  ///< standard deviation of the measured position, m

 private:
  struct Delayed {
    microseconds acts;
    double force;
  };

  void command() {
    const double z = z_ + noise * normal_(random_);
    state_.time = now_;
    state_.is_enabled = is_enabled;
    ++state_.sequence;
    state_.X_WH.translation().z() = z;
    state_.v_WH.z() = v_;
    GloveCommand wanted;
    wanted.sequence = state_.sequence;
    wanted.state_time = state_.time;
    wanted.f_H_W.z() = std::clamp(-stiffness_ * z, 0.0, device_.max_force);
    const SafeCommand safe = envelope_.limit(wanted, state_, now_);
    on_their_way_.push_back({now_ + std::chrono::duration_cast<microseconds>(device_.delay), safe.values().f_H_W.z()});
  }

  DeviceDescriptor device_;
  Arm arm_;
  double stiffness_;
  SafetyEnvelope envelope_;
  GloveState state_;
  std::deque<Delayed> on_their_way_;
  std::mt19937_64 random_{1};
  std::normal_distribution<double> normal_;
  microseconds now_{milliseconds(100)};
  microseconds next_period_{milliseconds(100)};
  double force_ = 0.0;
  double z_ = 5e-3;
  double v_ = 0.0;
  double work_ = 0.0;
};

/// The depth at which a hand wants to be that presses to `deep` and draws back by `back` at 1 m/s.
double depth_at(int ms, double deep, double back) {
  return deep * std::clamp((ms - 1000) / 1000.0, 0.0, 1.0) - std::clamp((ms - 3000) / 1000.0, 0.0, back);
}

template <typename Test>
void for_each_late_device(const Test& test, int latest_ms = 40) {
  for (const double update_rate : {1000.0, 100.0}) {
    for (const int delay_ms : {0, 2, 5, 10, 20, 40}) {
      if (delay_ms > latest_ms) continue;
      SCOPED_TRACE(testing::Message() << update_rate << " Hz, " << delay_ms << " ms");
      DeviceDescriptor device = simulated_glove_descriptor();
      device.update_rate = update_rate;
      device.delay = milliseconds(delay_ms);
      test(device);
    }
  }
}

Arm random_arm(test_support::RandomNumbers& random) {
  return {.mass = std::exp(random.uniform(std::log(0.1), std::log(3.0))),
          .stiffness = std::exp(random.uniform(std::log(100.0), std::log(1500.0))),
          .damping = std::exp(random.uniform(std::log(2.0), std::log(40.0)))};
}

// Any wall, also one that the device cannot render: it may oscillate, but not for free.
TEST(LateDevice, GivesNoMoreThanTheAllowance) {
  test_support::RandomNumbers random(1);
  for_each_late_device([&](const DeviceDescriptor& device) {
    for (int world = 0; world < 20; ++world) {
      PressedWall wall(device, random_arm(random), std::exp(random.uniform(std::log(200.0), std::log(3000.0))));
      const double deep = random.uniform(0.02, 0.25);
      const double back = random.uniform(0.0, deep);
      for (int ms = 0; ms < 9000; ++ms) {
        wall.step(depth_at(ms, deep, back));
        ASSERT_LE(wall.work(), 0.1 + 1.0 + 0.3e-3 * ms) << "world " << world << ", " << ms << " ms";
      }
    }
  });
}

// It leaves the wall at 1 m/s while the device still pushes, and is back before that is forgotten.
TEST(LateDevice, GivesNoMoreThanTheAllowanceToAHandThatBeatsTheWall) {
  test_support::RandomNumbers random(3);
  for_each_late_device(
      [&](const DeviceDescriptor& device) {
        for (int world = 0; world < 60; ++world) {
          PressedWall wall(device, random_arm(random), std::exp(random.uniform(std::log(50.0), std::log(3000.0))));
          const double way = random.uniform(0.02, 0.2);  // to and fro
          const double mean_depth = way * random.uniform(0.0, 1.5);
          for (int ms = 0; ms < 9000; ++ms) {
            wall.step(mean_depth + way * std::sin(1e-3 * ms / way));
            ASSERT_LE(wall.work(), 0.1 + 1.0 + 0.3e-3 * ms) << "world " << world << ", " << ms << " ms";
          }
        }
      },
      20);
}

/// How far a hand has gone so long after it left at 50 m/s² up to 2 m/s.
double left_by(double seconds) {
  return seconds < 0.04 ? 25.0 * seconds * seconds : 0.04 + 2.0 * (seconds - 0.04);
}

// A hand at rest has no power that a limit could see. It accelerates while the force falls, or is still to come.
TEST(SlowRates, GiveNoMoreThanTheAllowanceToAHandThatLeavesFast) {
  for_each_late_device(
      [](DeviceDescriptor device) {
        device.damping = 10.0;
        device.max_force = 40.0;
        device.max_force_rate = device.max_force * device.update_rate / 15.0;  // the slowest that leaves this force
        const Arm strong{.mass = 1.0, .stiffness = 1e5, .damping = 630.0};     // goes where it wants to be
        PressedWall wall(device, strong, 2000.0);
        for (int ms = 0; ms < 6000; ++ms) {
          const int in_cycle = ms % 1500;  // presses, rests, is interrupted, rests, leaves, and comes back
          wall.is_enabled = in_cycle < 550 || in_cycle >= 600;
          const double pressed = 0.02 * std::min(1.0, in_cycle / 400.0);
          const double left = left_by(1e-3 * std::clamp(in_cycle - 850, 0, 150));
          const double back = 1e-3 * std::max(0, in_cycle - 1000);
          wall.step(pressed - left + std::min(back, std::max(0.0, left - 0.02)));
          ASSERT_LE(wall.work(), 0.1 + 1.0 + 0.3e-3 * ms) << ms << " ms";
        }
      },
      20);
}

// A wall that is passive with the damping of arm and device, if nothing limits its energy.
TEST(LateDevice, HandComesToRestAfterDrawingBack) {
  test_support::RandomNumbers random(2);
  for_each_late_device([&](const DeviceDescriptor& device) {
    for (int world = 0; world < 20; ++world) {
      Arm arm = random_arm(random);
      arm.damping = std::max(arm.damping, std::sqrt(arm.stiffness * arm.mass));  // it comes to rest by itself
      const double most = 0.5 * arm.damping / lag_of(device, milliseconds(1), milliseconds(0));
      PressedWall wall(device, arm, std::min(most, std::exp(random.uniform(std::log(200.0), std::log(3000.0)))));
      const double deep = random.uniform(0.02, 0.25);
      const double back = random.uniform(0.0, deep);
      double greatest = 0.0;
      double fall = 0.0;
      for (int ms = 0; ms < 12'000; ++ms) {
        wall.step(depth_at(ms, deep, back));
        if (ms < 11'000) continue;
        greatest = std::max(greatest, wall.force());
        fall = std::max(fall, greatest - wall.force());
      }
      EXPECT_LT(fall, 0.05) << "world " << world << ": the force only comes back";
    }
  });
}

TEST(NoisyTracker, PressingHandKeepsItsForceForAMinute) {
  for (const double noise : {3e-6, 30e-6, 100e-6}) {
    SCOPED_TRACE(noise);
    DeviceDescriptor device = simulated_glove_descriptor();
    device.resolution = noise;
    PressedWall wall(device, {}, 1000.0);
    wall.noise = noise;
    double mean = 0.0;
    for (int ms = 0; ms < 60'000; ++ms) {
      wall.step(depth_at(ms, 0.16, 0.1));
      if (ms >= 59'000) mean += 1e-3 * wall.force();
    }
    EXPECT_NEAR(mean, 17.14, 0.1) << "60 mm by springs of 400 and 1000 N/m in a row";
  }
}

struct Afterwards {
  double force;   ///< N
  double unrest;  ///< N
};

/// A hand that presses, is interrupted, and rests: its force, and how much that changes in the last second.
Afterwards after_interruptions(const DeviceDescriptor& device, const Arm& arm, double stiffness) {
  PressedWall wall(device, arm, stiffness);
  double least = 1e9;
  double greatest = 0.0;
  for (int ms = 0; ms < 15'000; ++ms) {
    wall.is_enabled = ms < 3000 || ms >= 4000 || ms % 250 >= 100;
    wall.step(depth_at(ms, 0.12, 0.0));
    if (ms < 14'000) continue;
    least = std::min(least, wall.force());
    greatest = std::max(greatest, wall.force());
  }
  return {wall.force(), greatest - least};
}

// The brake of the limit itself must not shake a light hand.
TEST(LateDevice, LightHandIsSteadyAtSlowUpdateRates) {
  for (const double update_rate : {100.0, 150.0, 200.0, 1000.0}) {
    for (const double damping : {2.0, 10.0, 20.0}) {
      for (const double mass : {0.15, 0.3}) {
        DeviceDescriptor device = simulated_glove_descriptor();
        device.update_rate = update_rate;
        device.damping = damping;
        const Arm arm{.mass = mass, .stiffness = 300.0, .damping = damping + 10.0};
        const double passive = damping / lag_of(device, milliseconds(1), milliseconds(0));
        SCOPED_TRACE(testing::Message() << update_rate << " Hz, " << damping << " N s/m, " << mass << " kg");
        const double stiffness = std::min(1000.0, passive);
        const Afterwards after = after_interruptions(device, arm, stiffness);
        EXPECT_LT(after.unrest, 0.05);
        const double both = arm.stiffness * stiffness / (arm.stiffness + stiffness);
        EXPECT_GT(after.force, 0.95 * std::min(device.max_force, both * 0.12));
      }
    }
  }
}

// What the refill gives lifts the hand; that is no reason to end it.
TEST(PressedHand, ForceReturnsSmoothlyToASoftArmAfterInterruptions) {
  PressedWall wall(simulated_glove_descriptor(), {.mass = 0.3, .stiffness = 200.0, .damping = 9.0}, 1000.0);
  double before = 0.0;
  for (int ms = 0; ms < 10'000; ++ms) {
    wall.is_enabled = ms < 3000 || ms >= 4000 || ms % 250 >= 100;
    wall.step(depth_at(ms, 0.12, 0.0));
    if (ms >= 5500) {
      ASSERT_LT(wall.force() - before, 0.05) << ms;
    }
    before = wall.force();
  }
  EXPECT_GT(wall.force(), 19.0);
}

}  // namespace
}  // namespace glissade::devices
