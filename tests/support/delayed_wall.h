#pragma once

/// A device, a link with delay and a virtual wall, to measure from which stiffness an oscillation grows, and whether
/// the wall gives back more energy than the hand put in.

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <deque>
#include <memory>
#include <random>
#include <utility>

#include <Eigen/Geometry>

#include <glissade/contact/contact_body.h>
#include <glissade/devices/safety_envelope.h>
#include <glissade/devices/simulated_glove.h>
#include <glissade/geometry/mesh_generators.h>
#include <glissade/haptics/haptic_kernel.h>

namespace glissade::test_support {

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
inline bool grows(double stiffness, double damping, std::chrono::milliseconds delay) {
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

/// The stiffness (N/m) at which the oscillation of a heavy device begins to grow.
inline double stiffness_that_grows(double damping, std::chrono::milliseconds delay) {
  double low = 1.0;
  double high = 1e5;
  while (high > 1.001 * low) {
    const double middle = std::sqrt(low * high);
    (grows(middle, damping, delay) ? high : low) = middle;
  }
  return low;
}

/// A hand, which may add some damping of its own, on a device presses on a wall at z = 0; device and server are joined
/// by a link with a constant delay.
class DelayedWall {
 public:
  DelayedWall(const devices::DeviceDescriptor& device, double mass, double stiffness, std::chrono::milliseconds one_way,
              double of_hand = 0.0)
      : one_way_(static_cast<std::size_t>(one_way.count())),
        hand_{.mass = mass, .damping = device.damping + of_hand, .z = 5e-3},
        kernel_({{part_.p_Vref(), part_.radius(), {stiffness, 1.0}}}, {{device, 0}}),
        glove_(device, 6.0),
        in_device_(static_cast<std::size_t>(device.delay / std::chrono::milliseconds(1)), 0.0) {
    wall_.sequence = 1;
    wall_.row_count = 1;
    wall_.row_array[0] = {{{Eigen::Vector3d::UnitZ(), Eigen::Vector3d::Zero(), 0.0}}};
    wall_.parts[0].hold = 1;
  }

  /// A millisecond in which the wearer pushes with `push` N.
  void step(double push) {
    now_ += std::chrono::milliseconds(1);
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
          Eigen::Isometry3d(Eigen::Translation3d(0.0, 0.0, -5e-3));  // the part starts 5 mm lower than the hand
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
    in_device_.push_back(command_.values().f_H_W.z());
    force_ = in_device_.front();
    in_device_.pop_front();
    for (int i = 0; i < 10; ++i)
      hand_.step(push + force_, 1e-4);
  }

  /// The server sends no commands for so long.
  void fall_silent(std::chrono::milliseconds time) { silent_until_ = now_ + time; }

  /// The simulation makes no new set for so long.
  void halt(std::chrono::milliseconds time) { halted_until_ = now_ + time; }

  const devices::SafeCommand& command() const { return command_; }
  /// What the device exerts.
  double force() const { return force_; }
  double z() const { return hand_.z; }
  const haptics::HapticKernel& kernel() const { return kernel_; }

 private:
  contact::SlidingPart part_{std::make_shared<geometry::TriangleMesh>(geometry::make_box({0.1, 0.1, 0.1}, 12))};
  std::size_t one_way_;
  Mass hand_;
  haptics::HapticKernel kernel_;
  devices::SafetyEnvelope glove_;
  std::deque<double> in_device_;  // forces, N, which it exerts after its own delay
  double force_ = 0.0;
  haptics::ContactSet wall_;
  devices::GloveState state_;
  std::deque<devices::GloveState> states_;
  std::deque<devices::GloveCommand> commands_;
  devices::GloveCommand newest_;
  devices::SafeCommand command_;
  std::chrono::nanoseconds now_{std::chrono::milliseconds(100)};
  std::chrono::nanoseconds silent_until_{0};
  std::chrono::nanoseconds halted_until_{0};
};

struct WallEnergies {
  double least_J = 1.0;  ///< least `SafeCommand::energy`
  double given_J = 0.0;  ///< greatest work of the wall on the hand since the start, from its true motion
};

/// Three seconds in which a hand pushes and pulls at random on a wall with a random device, stiffness and delay. Some
/// devices do not tell their damping, and some change their force slowly.
inline WallEnergies random_wall(std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  devices::DeviceDescriptor device = devices::simulated_glove_descriptor();
  device.damping = uniform(random) < 0.1 ? 1e-3 : std::pow(10.0, -1.0 + 2.0 * uniform(random));
  const double mass = 0.1 + 3.0 * uniform(random);
  const double stiffness = std::pow(10.0, 1.5 + 2.5 * uniform(random));
  double one_way_ms = 25.0 * uniform(random);
  one_way_ms *= uniform(random);
  if (uniform(random) < 0.3) device.max_force_rate = std::pow(10.0, 2.0 + 1.5 * uniform(random));
  const double untold = uniform(random) < 0.2 ? std::exchange(device.damping, 0.0) : 0.0;
  DelayedWall wall(device, mass, stiffness, std::chrono::milliseconds(static_cast<int>(one_way_ms)), untold);
  WallEnergies energies;
  double push = 0.0;
  double work = 0.0;
  for (int i = 0; i < 3000; ++i) {
    if (random() % 100 == 0) push = uniform(random) < 0.3 ? 3.0 : -8.0 * uniform(random);
    if (wall.z() > 0.05) push = -std::abs(push);
    const double before = wall.z();
    wall.step(push);
    work += wall.force() * (wall.z() - before);
    energies.least_J = std::min(energies.least_J, wall.command().energy());
    energies.given_J = std::max(energies.given_J, work);
  }
  return energies;
}

}  // namespace glissade::test_support
