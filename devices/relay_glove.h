#pragma once

/// A link between a haptic loop and a glove's driver in another thread of the same process: for drivers in other
/// languages, in game engines, or with a loop of their own. For a driver in another process, use `lcm_glove.h`.

#include <atomic>
#include <chrono>
#include <cstdint>

#include <glissade/base/export.h>
#include <glissade/devices/glove_device.h>
#include <glissade/devices/safety_envelope.h>
#include <glissade/realtime/clock.h>
#include <glissade/realtime/triple_buffer.h>

namespace glissade::devices {

/// The driver's thread publishes states and takes commands. The haptic thread reads states and hands over commands. As
/// in `LcmGloveHost`, a second envelope limits each command at the driver's end. So the force fades if the server is
/// late, stops or ends, and returns softly, whatever either thread does. The delay of the round trip counts as the
/// delay of a link, and makes the coupling softer.
///
/// Thread-safety: one driver's thread and one haptic thread. Progress: all functions except the constructor are
/// wait-free and allocate nothing. The glove must outlive its server.
class GLISSADE_EXPORT RelayGlove final : public GloveDevice {
 public:
  /// Throws what `validate` throws for the descriptor. `clock` is the clock of the server; null means the steady clock
  /// of the system. The clock must outlive the glove.
  explicit RelayGlove(const DeviceDescriptor& descriptor, const realtime::Clock* clock = nullptr);

  /// Driver: makes `measured` the newest state. `GloveState::time` is the time of the measurement, on any monotonic
  /// clock. The glove numbers the states, and adds the envelope's results for the last command. So the driver leaves
  /// `sequence`, `limits`, `command_age`, `link_delay`, `energy`, `taken` and `obeys_another` as they are.
  void publish(const GloveState& measured) noexcept;

  /// Driver: the command for the device in this period. Call this function once a period, after `publish`. The force is
  /// zero before the first state and before the first command. The force fades if the newest state is old. The force
  /// also fades if the newest command answers an old state: older than 150 ms, or than the sum of six periods and the
  /// delay of the link. A period is that of the device, but at least 1 ms. Limits and half-spaces expire as in
  /// `JointLimits::expiry`.
  SafeCommand newest_command() noexcept;

  /// Emergency stop: the force fades to zero and stays there. Any thread.
  void stop() noexcept { should_stop_.store(true, std::memory_order_relaxed); }

  // The haptic thread's end:
  const DeviceDescriptor& descriptor() const noexcept override { return descriptor_; }
  bool read(GloveState& newest) noexcept override;
  void command(const SafeCommand& command) noexcept override { commands_.publish(command); }

 private:
  realtime::SteadyClock steady_clock_;
  const realtime::Clock& clock_;
  DeviceDescriptor descriptor_;  // with the maxima that the rates lower

  // Driver's thread only.
  SafetyEnvelope envelope_;
  GloveState state_;  // the newest, as published
  SafeCommand last_;

  // Haptic thread only.
  bool has_state_ = false;

  // Shared.
  std::atomic<bool> should_stop_{false};
  realtime::TripleBuffer<GloveState> states_;
  realtime::TripleBuffer<SafeCommand> commands_;
};

}  // namespace glissade::devices
