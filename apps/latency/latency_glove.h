#pragma once

/// The glove of a measurement of latencies, in another process, in another thread, or as a driver in the same process;
/// and the stamps that it and the haptic loop leave.

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include <glissade/apps/latency/latency_stages.h>
#include <glissade/apps/latency/shared_stamps.h>
#include <glissade/devices/glove_device.h>
#include <glissade/devices/lcm_bus.h>
#include <glissade/devices/lcm_glove.h>
#include <glissade/devices/simulated_glove.h>
#include <glissade/realtime/clock.h>
#include <glissade/realtime/periodic_thread.h>
#include <glissade/realtime/triple_buffer.h>

namespace glissade::apps {

/// Steps the glove of a measurement to a deadline; the state is stamped with the present time.
class LatencyHand {
 public:
  LatencyHand();

  const devices::DeviceDescriptor& descriptor() const noexcept { return glove_.descriptor(); }
  const devices::GloveState& state() const noexcept { return state_; }
  const devices::GloveState& step(std::chrono::nanoseconds deadline, const devices::SafeCommand& command) noexcept;

 private:
  devices::SimulatedGlove glove_;
  devices::GloveState state_;
  std::chrono::nanoseconds last_deadline_{0};
  realtime::SteadyClock clock_;
};

/// The glove's end of an LCM link, from construction to destruction: sends states, and notes in `arrivals` when each
/// command arrives.
class LinkedGlove {
 public:
  LinkedGlove(const std::shared_ptr<devices::LcmBus>& bus, SharedStamps& arrivals);

 private:
  void tick(std::chrono::nanoseconds deadline) noexcept;

  realtime::SteadyClock clock_;
  LatencyHand hand_;
  devices::LcmGloveHost host_;
  std::unique_ptr<devices::LcmBus::Subscription> subscription_;
  std::unique_ptr<realtime::PeriodicThread> thread_;
};

/// Notes when each state of a glove on `bus` has been received. Make it after the `LcmGlove`, whose handler then runs
/// before its own.
std::unique_ptr<devices::LcmBus::Subscription> note_states(devices::LcmBus& bus, SharedStamps& received);

/// A device whose driver is in the same process: states and commands pass through a triple buffer each.
class DirectGlove final : public devices::GloveDevice {
 public:
  DirectGlove(SharedStamps& received, SharedStamps& arrivals);

  const devices::DeviceDescriptor& descriptor() const noexcept override { return hand_.descriptor(); }
  bool read(devices::GloveState& newest) noexcept override;
  void command(const devices::SafeCommand& command) noexcept override;

 private:
  SharedStamps& received_;
  SharedStamps& arrivals_;
  realtime::SteadyClock clock_;
  LatencyHand hand_;
  realtime::TripleBuffer<devices::GloveState> states_;
  realtime::TripleBuffer<devices::SafeCommand> commands_;
  bool has_state_ = false;  ///< used by the haptic thread only
  std::unique_ptr<realtime::PeriodicThread> driver_;
};

/// Passes everything on to another device, and notes when.
class StampedGlove final : public devices::GloveDevice {
 public:
  /// `device` must outlive this. Notes the first `capacity` commands.
  StampedGlove(devices::GloveDevice& device, std::size_t capacity);

  const devices::DeviceDescriptor& descriptor() const noexcept override { return device_.descriptor(); }
  bool read(devices::GloveState& newest) noexcept override;
  void command(const devices::SafeCommand& command) noexcept override;

  /// Adds the ways of all samples with a noted command. The haptic thread must have ended. A sample that several ticks
  /// have read counts once, with the first command.
  void add_ways(const SharedStamps& received, const SharedStamps& arrivals, LatencyStages& stages) const;

 private:
  struct Answer {
    std::int64_t command;  // its sequence
    std::int64_t state;    // that of the state
    std::chrono::nanoseconds measured;
    std::chrono::nanoseconds read;
    std::chrono::nanoseconds handed_over;
  };

  devices::GloveDevice& device_;
  realtime::SteadyClock clock_;
  std::chrono::nanoseconds read_{0};
  std::vector<Answer> answers_;
};

}  // namespace glissade::apps
