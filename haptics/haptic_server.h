#pragma once

/// The system in real time: a haptic thread at 1 kHz between a device and the newest contact set, and a simulation
/// thread that answers the newest ghost pose as fast as collision queries allow. Neither waits for the other.

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>

#include <glissade/devices/glove_device.h>
#include <glissade/devices/haptic_state.h>
#include <glissade/haptics/haptic_kernel.h>
#include <glissade/haptics/sliding_simulation.h>
#include <glissade/realtime/clock.h>
#include <glissade/realtime/latency_histogram.h>
#include <glissade/realtime/periodic_thread.h>
#include <glissade/realtime/triple_buffer.h>

namespace glissade::haptics {

struct HapticServerOptions {
  /// Ends by itself after so many ticks with a device; 0 goes on until `stop`.
  std::int64_t ticks = 0;
  /// SCHED_FIFO priority the haptic thread asks for; 0 asks for none.
  int fifo_priority = 80;
  /// A device that has sent nothing new for so long gets no force.
  std::chrono::nanoseconds device_timeout{std::chrono::milliseconds(50)};
};

/// What the server measured. Complete after `stop`.
struct HapticServerStatistics {
  realtime::PeriodicStatistics haptic;         ///< the haptic thread's ticks, those before the first state included
  realtime::LatencyHistogram simulation;       ///< time one answer of the simulation took
  realtime::LatencyHistogram contact_set_age;  ///< at the ticks that used it
  bool has_fifo_scheduling = false;
};

/// Thread-safety: one thread owns the object. Between construction and the end of `stop`, `device` and `simulation`
/// belong to the server's threads.
class HapticServer {
 public:
  /// Called by the haptic thread for each tick with a device; must be real-time safe.
  using Sink = std::function<void(const devices::HapticState&)>;

  /// Starts both threads. The references must outlive the server. The part is grasped where it is when the first state
  /// of the device arrives. The coupling is `coupling_for` the device and the stiffness of the simulation. Throws
  /// std::invalid_argument for an empty sink, and as `coupling_for` does.
  HapticServer(devices::GloveDevice& device, SlidingSimulation& simulation, realtime::Clock& clock, Sink sink,
               const HapticServerOptions& options = {});
  HapticServer(const HapticServer&) = delete;
  HapticServer& operator=(const HapticServer&) = delete;
  ~HapticServer() { stop(); }

  /// Whether the given number of ticks has been done. Wait-free, any thread.
  bool is_done() const noexcept { return done_.load(std::memory_order_acquire); }

  /// Ticks with a device so far. Wait-free, any thread.
  std::int64_t ticks() const noexcept { return ticks_.load(std::memory_order_relaxed); }

  /// Ends both threads; may block for the length of one answer of the simulation.
  void stop();

  /// Valid after `stop`.
  const HapticServerStatistics& statistics() const noexcept { return statistics_; }

 private:
  struct Ghost {
    Eigen::Isometry3d X_WG = Eigen::Isometry3d::Identity();
    std::chrono::nanoseconds time{0};
  };

  bool haptic_tick(const realtime::PeriodicTick& timing) noexcept;
  void simulation_tick();

  devices::GloveDevice& device_;
  SlidingSimulation& simulation_;
  realtime::Clock& clock_;
  Sink sink_;
  HapticServerOptions options_;

  // Of the haptic thread.
  HapticKernel kernel_;
  devices::GloveState state_;
  std::int64_t state_sequence_ = -1;
  std::chrono::nanoseconds state_arrival_{0};

  // Of the simulation thread.
  std::int64_t set_sequence_ = 0;
  std::chrono::nanoseconds answered_{0};  // time of the last ghost that was answered
  std::vector<std::int32_t> scratch_;

  // Between them.
  realtime::TripleBuffer<Ghost> ghosts_;
  realtime::TripleBuffer<ContactSet> sets_;

  std::atomic<std::int64_t> ticks_{0};
  std::atomic<bool> done_{false};
  HapticServerStatistics statistics_;
  std::unique_ptr<realtime::PeriodicThread> simulation_thread_;
  std::unique_ptr<realtime::PeriodicThread> haptic_thread_;
};

}  // namespace glissade::haptics
