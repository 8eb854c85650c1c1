#pragma once

/// A scene in which two hands, one in a device of this process and one behind an LCM link, press parts on a wall and on
/// each other, for as long as one likes.

#include <chrono>
#include <cstdint>
#include <functional>

#include <glissade/devices/simulated_glove.h>
#include <glissade/grasping/grasp_simulation.h>
#include <glissade/realtime/clock.h>

namespace glissade::test_support {

/// A hand for the first part. It goes to and fro for `duration`.
devices::SimulatedGlove proof_hand(std::chrono::seconds duration);

/// The same for the second part. Its device takes half-spaces in place of a wrench.
devices::SimulatedGlove proof_arm(std::chrono::seconds duration);

/// Two cubes for the hands, and one that moves on its own, at a wall.
grasping::GraspSimulation proof_parts();

/// A device without a link: a simulated glove that takes a step whenever it is read. It tells when a tick has given its
/// command.
class ProofGlove final : public devices::GloveDevice {
 public:
  ProofGlove(devices::SimulatedGlove glove, std::chrono::nanoseconds period, std::function<void()> after_command)
      : glove_(std::move(glove)), period_(period), after_command_(std::move(after_command)) {}

  const devices::DeviceDescriptor& descriptor() const noexcept override { return glove_.descriptor(); }
  bool read(devices::GloveState& newest) noexcept override {
    newest = glove_.step(period_, command_);
    newest.time = clock_.now();
    return true;
  }
  void command(const devices::SafeCommand& command) noexcept override {
    command_ = command;
    after_command_();
  }

 private:
  devices::SimulatedGlove glove_;
  std::chrono::nanoseconds period_;
  std::function<void()> after_command_;
  realtime::SteadyClock clock_;
  devices::SafeCommand command_;
};

}  // namespace glissade::test_support
