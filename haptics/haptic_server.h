#pragma once

/// The system in real time, with two threads. The haptic thread runs at 1 kHz: from the state of the device and the
/// newest contact set, it computes the force and the pose of the ghost, i.e. the part's pose if nothing were in the
/// way. The simulation thread answers the newest pose of the ghost with a contact set, once per millisecond if the
/// collision queries are fast enough. Neither thread waits for the other.

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
  /// Number of counted ticks of the haptic thread after which that thread ends by itself; with 0 it runs until `stop`.
  /// Ticks before the first state of the device are not counted.
  std::int64_t ticks = 0;
  /// SCHED_FIFO priority that the haptic thread requests; 0 requests none.
  int fifo_priority = 80;
  /// The force on the device is zero while its newest state is older than this, measured from the state's arrival.
  std::chrono::nanoseconds device_timeout{std::chrono::milliseconds(50)};
};

/// Measurements of the server. Complete after `stop`.
struct HapticServerStatistics {
  realtime::PeriodicStatistics haptic;         ///< all ticks of the haptic thread, counted or not
  realtime::LatencyHistogram simulation;       ///< duration of each call of the simulation
  realtime::LatencyHistogram contact_set_age;  ///< at each counted tick: age of the ghost that the set answers
  bool has_fifo_scheduling = false;
};

/// Runs both threads from construction to `stop`. Thread-safety: one thread owns the object. Between construction and
/// the end of `stop`, `device` and `simulation` belong to the server's threads.
class HapticServer {
 public:
  /// Receives the state of each counted tick (`HapticServerOptions::ticks`). Called by the haptic thread; must be
  /// real-time safe.
  using Sink = std::function<void(const devices::HapticState&)>;

  /// Starts both threads. The references must outlive the server. The hand grasps the part when the first state of the
  /// device arrives; the part stays where it is. The coupling is the result of `coupling_for` with the descriptor of
  /// the device and the stiffness of the simulation. Throws std::invalid_argument for an empty sink, and as
  /// `coupling_for` does.
  HapticServer(devices::GloveDevice& device, SlidingSimulation& simulation, realtime::Clock& clock, Sink sink,
               const HapticServerOptions& options = {});
  HapticServer(const HapticServer&) = delete;
  HapticServer& operator=(const HapticServer&) = delete;
  ~HapticServer() { stop(); }

  /// Whether the server has reached `HapticServerOptions::ticks`. Wait-free, any thread.
  bool is_done() const noexcept { return done_.load(std::memory_order_acquire); }

  /// Number of counted ticks so far. Wait-free, any thread.
  std::int64_t ticks() const noexcept { return ticks_.load(std::memory_order_relaxed); }

  /// Stops both threads. May block for the duration of one call of the simulation.
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

  // Haptic thread only.
  HapticKernel kernel_;
  devices::GloveState state_;
  std::int64_t state_sequence_ = -1;
  std::chrono::nanoseconds state_arrival_{0};

  // Simulation thread only.
  std::int64_t set_sequence_ = 0;
  std::chrono::nanoseconds answered_{0};  // time of the last answered ghost
  std::vector<std::int32_t> scratch_;

  // Shared by both threads.
  realtime::TripleBuffer<Ghost> ghosts_;
  realtime::TripleBuffer<ContactSet> sets_;

  std::atomic<std::int64_t> ticks_{0};
  std::atomic<bool> done_{false};
  HapticServerStatistics statistics_;
  std::unique_ptr<realtime::PeriodicThread> simulation_thread_;
  std::unique_ptr<realtime::PeriodicThread> haptic_thread_;
};

}  // namespace glissade::haptics
