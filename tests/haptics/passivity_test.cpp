// A device, a link with delay and a virtual wall: the coupling stays passive, and the wall never feeds an oscillation.

#include <cmath>
#include <cstdlib>
#include <deque>
#include <functional>
#include <memory>
#include <random>

#include <gtest/gtest.h>

#include <glissade/devices/simulated_glove.h>
#include <glissade/geometry/mesh_generators.h>
#include <glissade/haptics/contact_body.h>
#include <glissade/haptics/haptic_kernel.h>

namespace glissade::haptics {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using std::chrono::milliseconds;
using std::chrono::nanoseconds;

/// A mass with viscous friction that moves along z, by the exact solution for constant forces.
struct Mass {
  double mass;
  double damping;
  double z = 0.0;
  double v = 0.0;

  void step(double force, double dt) {
    const double v_end = force / damping;
    const double decay = std::exp(-damping / mass * dt);
    z += v_end * dt + (v - v_end) * mass / damping * (1.0 - decay);
    v = v_end + (v - v_end) * decay;
  }
};

/// Whether the oscillation of a mass on a spring that is sampled every millisecond and acts `delay` later grows.
bool grows(double stiffness, double damping, milliseconds delay) {
  Mass mass{.mass = 4.0, .damping = damping, .z = 0.01};
  std::deque<double> on_their_way(static_cast<std::size_t>(delay.count()), 0.0);
  const auto energy = [&] { return 0.5 * mass.mass * mass.v * mass.v + 0.5 * stiffness * mass.z * mass.z; };
  double early = 0.0;
  double late = 0.0;
  constexpr int kTicks = 20'000;
  for (int i = 0; i < kTicks; ++i) {
    on_their_way.push_back(-stiffness * mass.z);
    mass.step(on_their_way.front(), 1e-3);
    on_their_way.pop_front();
    if (i >= kTicks / 4 && i < kTicks / 2) early = std::max(early, energy());
    if (i >= 3 * kTicks / 4) late = std::max(late, energy());
  }
  return late > early;
}

TEST(PassiveStiffness, IsWhereTheOscillationOfAHeavyDeviceBeginsToGrow) {
  devices::DeviceDescriptor device = devices::simulated_glove_descriptor();
  for (const milliseconds delay :
       {milliseconds(0), milliseconds(1), milliseconds(5), milliseconds(20), milliseconds(50)}) {
    double low = 1.0;
    double high = 1e5;
    while (high > 1.001 * low) {
      const double middle = std::sqrt(low * high);
      (grows(middle, device.damping, delay) ? high : low) = middle;
    }
    const double limit = passive_stiffness(device, milliseconds(1), delay).translational;
    EXPECT_NEAR(limit / low, 1.0, 0.1) << delay.count() << " ms of delay: " << limit << " and " << low << " N/m";
  }
}

TEST(PassiveStiffness, ACoarseMeasurementNeedsFriction) {
  devices::DeviceDescriptor device = devices::simulated_glove_descriptor();
  device.friction = 0.05;
  device.resolution = 1e-4;
  EXPECT_EQ(passive_stiffness(device, milliseconds(1), nanoseconds(0)).translational, 1000.0);
}

TEST(PassiveStiffness, ADeviceOfUnknownDampingHasTheLimitsOfItsMakerOnly) {
  devices::DeviceDescriptor device = devices::simulated_glove_descriptor();
  device.damping = 0.0;
  EXPECT_EQ(coupling_for(device, {1e5, 1.0}, milliseconds(1), milliseconds(50)).stiffness.translational, 4000.0);
}

/// A hand, which may add some damping of its own, on a device presses on a wall at z = 0; device and server are joined
/// by a link with a constant delay.
class DelayedWall {
 public:
  DelayedWall(const devices::DeviceDescriptor& device, double mass, double stiffness, milliseconds one_way,
              double of_hand = 0.0)
      : one_way_(static_cast<std::size_t>(one_way.count())),
        hand_{.mass = mass, .damping = device.damping + of_hand, .z = 5e-3},
        kernel_({{part_.p_Vref(), part_.radius(), {stiffness, 1.0}}}, {{device, 0}}),
        glove_(device, 6.0) {
    wall_.sequence = 1;
    wall_.row_count = 1;
    wall_.row_array[0] = {{{Vector3d::UnitZ(), Vector3d::Zero(), 0.0}}};
    wall_.parts[0].hold = 1;
  }

  /// A millisecond in which the wearer pushes with `push` N.
  void step(double push) {
    now_ += milliseconds(1);
    state_.time = now_;
    ++state_.sequence;
    state_.X_WH.translation().z() = hand_.z;
    state_.v_WH.z() = hand_.v;
    devices::GloveState told = state_;
    told.link_delay = glove_.link_delay();
    states_.push_back(told);
    if (states_.size() > one_way_) {
      if (now_ >= halted_until_) wall_.time = now_;
      wall_.parts[0].X_WV_of_rows =
          Isometry3d(Eigen::Translation3d(0.0, 0.0, -5e-3));  // the part starts 5 mm lower than the hand
      const devices::GloveState* const newest = &states_.front();
      const devices::GloveCommand command = kernel_.tick({&newest, 1}, wall_, now_).hands[0].command.values();
      if (now_ >= silent_until_) commands_.push_back(command);
      states_.pop_front();
    }
    if (commands_.size() > one_way_) {
      newest_ = commands_.front();
      commands_.pop_front();
    }
    command_ = glove_.limit(newest_, state_, now_);
    for (int i = 0; i < 10; ++i)
      hand_.step(push + command_.values().f_H_W.z(), 1e-4);
  }

  /// The server sends no commands for so long.
  void fall_silent(milliseconds time) { silent_until_ = now_ + time; }

  /// The simulation makes no new set for so long.
  void halt(milliseconds time) { halted_until_ = now_ + time; }

  const devices::SafeCommand& command() const { return command_; }
  double force() const { return command_.values().f_H_W.z(); }
  double z() const { return hand_.z; }
  const HapticKernel& kernel() const { return kernel_; }

 private:
  SlidingPart part_{std::make_shared<geometry::TriangleMesh>(geometry::make_box({0.1, 0.1, 0.1}, 12))};
  std::size_t one_way_;
  Mass hand_;
  HapticKernel kernel_;
  devices::SafetyEnvelope glove_;
  ContactSet wall_;
  devices::GloveState state_;
  std::deque<devices::GloveState> states_;
  std::deque<devices::GloveCommand> commands_;
  devices::GloveCommand newest_;
  devices::SafeCommand command_;
  nanoseconds now_{milliseconds(100)};
  nanoseconds silent_until_{0};
  nanoseconds halted_until_{0};
};

/// A wearer, as stiff and damped as a relaxed arm, wants to be 20 mm deep in the wall. Returns the greatest change of
/// the force in the last second of eight.
double unrest(DelayedWall& wall) {
  double least = 1e9;
  double greatest = -1e9;
  for (int i = 0; i < 8000; ++i) {
    wall.step(-400.0 * (wall.z() + 0.02));
    if (i < 7000) continue;
    least = std::min(least, wall.force());
    greatest = std::max(greatest, wall.force());
  }
  return greatest - least;
}

TEST(DelayedWall, IsFeltAsSoftAndNeverAsOscillation) {
  const devices::DeviceDescriptor device = devices::simulated_glove_descriptor();
  for (const milliseconds one_way :
       {milliseconds(0), milliseconds(1), milliseconds(5), milliseconds(25), milliseconds(50)}) {
    DelayedWall wall(device, 0.8, 1000.0, one_way, 20.0);
    EXPECT_LT(unrest(wall), 0.05) << one_way.count() << " ms";
    const double limit = wall.kernel().present_coupling(0).stiffness.translational;
    EXPECT_NEAR(wall.force() / -wall.z(), limit, 0.02 * limit) << one_way.count() << " ms";
    EXPECT_NEAR(limit, std::min(1000.0, 2.0 / (0.5e-3 + 2e-3 * static_cast<double>(one_way.count()))), 0.02 * limit);
  }
}

/// A hand presses with `push` N, then `interrupt` happens: the force seconds later, and by how much it falls within a
/// second. It may still rise: a calm contact gets back slowly what the refill did not give.
struct Afterwards {
  double force;
  double unrest;
};

Afterwards after(double push, const std::function<void(DelayedWall& wall)>& interrupt) {
  DelayedWall wall(devices::simulated_glove_descriptor(), 0.8, 1000.0, milliseconds(0), 20.0);
  const double target = -push / 400.0 - push / 1000.0;
  const auto lead = [&](int ms) {
    for (int i = 0; i < ms; ++i)
      wall.step(-400.0 * (wall.z() - target));
  };
  lead(3000);
  interrupt(wall);
  lead(3000);
  const double force = wall.force();
  double greatest = force;
  double fall = 0.0;
  for (int i = 0; i < 1000; ++i) {
    lead(1);
    greatest = std::max(greatest, wall.force());
    fall = std::max(fall, greatest - wall.force());
  }
  return {force, fall};
}

TEST(DelayedWall, IsAsHardAndAsQuietAfterAnInterruptionAsBefore) {
  for (const double push : {2.0, 5.0, 10.0, 15.0, 19.0}) {
    for (const milliseconds time : {milliseconds(20), milliseconds(100), milliseconds(800)}) {
      SCOPED_TRACE(testing::Message() << push << " N, " << time.count() << " ms");
      const Afterwards silence = after(push, [&](DelayedWall& wall) { wall.fall_silent(time); });
      EXPECT_NEAR(silence.force, push, (push > 15.0 ? 0.2 : 0.02) * push) << "the refill has an end";
      EXPECT_LT(silence.unrest, 0.05);
      const Afterwards halt = after(push, [&](DelayedWall& wall) { wall.halt(time); });
      EXPECT_NEAR(halt.force, push, 0.05 * push);
      EXPECT_LT(halt.unrest, 0.05);
    }
  }
}

/// Far beyond the depth at which the device gives its all, and back.
TEST(DelayedWall, IsQuietWhenTheHandBacksOffFromFarInside) {
  for (const auto& [deep, back] :
       {std::pair(0.13, 0.11), std::pair(0.13, 0.09), std::pair(0.09, 0.06), std::pair(0.23, 0.13)}) {
    DelayedWall wall(devices::simulated_glove_descriptor(), 0.8, 1000.0, milliseconds(0), 20.0);
    double least = 1e9;
    double greatest = -1e9;
    for (int i = 0; i < 9000; ++i) {
      const double in = std::clamp((i - 1000) / 1000.0, 0.0, 1.0);
      const double out = std::clamp((i - 4000) / 500.0, 0.0, 1.0);
      wall.step(-400.0 * (wall.z() + in * deep + out * (back - deep)));
      if (i < 7000) continue;
      least = std::min(least, wall.force());
      greatest = std::max(greatest, wall.force());
    }
    EXPECT_LT(greatest - least, 0.05) << deep << " to " << back;
    EXPECT_GT(least, 10.0) << deep << " to " << back;
  }
}

// A thousand settings: GLISSADE_PASSIVITY_SETTINGS=1000.
TEST(DelayedWall, NeverGivesBackMoreEnergyThanTheHandPutIn) {
  const char* const wish = std::getenv("GLISSADE_PASSIVITY_SETTINGS");
  const int settings = wish != nullptr ? std::atoi(wish) : 60;
  double worst = 1.0;
  for (int seed = 1; seed <= settings; ++seed) {
    std::mt19937_64 random(static_cast<std::uint64_t>(seed));
    std::uniform_real_distribution<double> uniform(0.0, 1.0);
    devices::DeviceDescriptor device = devices::simulated_glove_descriptor();
    device.damping = uniform(random) < 0.1 ? 1e-3 : std::pow(10.0, -1.0 + 2.0 * uniform(random));
    DelayedWall wall(device, 0.1 + 3.0 * uniform(random), std::pow(10.0, 1.5 + 2.5 * uniform(random)),
                     milliseconds(static_cast<int>(25.0 * uniform(random) * uniform(random))));
    double push = 0.0;
    double least = 1.0;
    for (int i = 0; i < 3000; ++i) {
      if (random() % 100 == 0) push = uniform(random) < 0.3 ? 3.0 : -8.0 * uniform(random);
      if (wall.z() > 0.05) push = -std::abs(push);
      wall.step(push);
      least = std::min(least, wall.command().energy());
    }
    EXPECT_GE(least, 0.0) << "seed " << seed << ": " << device.damping << " N s/m";
    worst = std::min(worst, least);
  }
  RecordProperty("least_energy_J", std::to_string(worst));
}

}  // namespace
}  // namespace glissade::haptics
