#pragma once

/// The system in real time, with two threads. The haptic thread runs at 1 kHz or another rate: from the state of the
/// device and the newest contact set, it computes the force and the pose of the ghost, i.e. the part's pose if nothing
/// were in the way. The simulation thread answers the newest pose of the ghost with a contact set, once per millisecond
/// if the collision queries are fast enough. Neither thread waits for the other.

#include <array>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

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
  /// Period of the haptic thread, kShortestTickPeriod to kLongestTickPeriod. The forces do not depend on it: all rates
  /// of change are per second.
  std::chrono::nanoseconds period = kTickPeriod;
  /// Number of counted ticks of the haptic thread after which the force fades and that thread ends by itself; with 0 it
  /// runs until `stop`. Ticks before the first state of the device and ticks of the fade are not counted.
  std::int64_t ticks = 0;
  /// SCHED_FIFO priority that the haptic thread requests; 0 requests none.
  int fifo_priority = 80;
};

/// Measurements of the server. Complete after `stop`.
struct HapticServerStatistics {
  realtime::PeriodicStatistics haptic;         ///< all ticks of the haptic thread, counted or not
  realtime::LatencyHistogram simulation;       ///< duration of each call of the simulation
  realtime::LatencyHistogram contact_set_age;  ///< at each counted tick: age of the ghost that the set answers
  std::int64_t unsolved_ticks = 0;             ///< counted ticks whose contacts had no solution: the force faded
  bool has_fifo_scheduling = false;
};

/// Runs both threads from construction to `stop`. Thread-safety: one thread owns the object. Between construction and
/// the end of `stop`, `device` and `simulation` belong to the server's threads.
class HapticServer {
 public:
  /// Receives the state of each counted tick (`HapticServerOptions::ticks`). Called by the haptic thread; must be
  /// real-time safe. After an exception from it the force fades, as after one of the simulation, and it is called no
  /// more.
  using Sink = std::function<void(const devices::HapticState&)>;

  /// Starts both threads. The references must outlive the server. The hand grasps the part when the first state of the
  /// device arrives; the part stays where it is. The coupling is the result of `coupling_for` with the descriptor of
  /// the device and the stiffness of the simulation. Throws std::invalid_argument for an empty sink or a period out of
  /// bounds, and as `coupling_for` does.
  HapticServer(devices::GloveDevice& device, SlidingSimulation& simulation, realtime::Clock& clock, Sink sink,
               const HapticServerOptions& options = {});
  HapticServer(const HapticServer&) = delete;
  HapticServer& operator=(const HapticServer&) = delete;
  ~HapticServer() { stop(); }

  /// Whether the server has reached `HapticServerOptions::ticks`, and the device has no force any more. Wait-free, any
  /// thread.
  bool is_done() const noexcept { return done_.load(std::memory_order_acquire); }

  /// Whether the simulation or the sink threw an exception. Then the force fades and stays at zero. Wait-free, any
  /// thread.
  bool has_failed() const noexcept { return failed_.load(std::memory_order_acquire); }
  /// The message of the exception, of which at most 255 bytes are kept. Valid once `has_failed` returns true.
  std::string failure() const { return failure_.data(); }

  /// The force fades and stays at zero; the loop goes on. Wait-free, any thread.
  void emergency_stop() noexcept { emergency_.store(true, std::memory_order_relaxed); }

  /// Number of counted ticks so far. Wait-free, any thread.
  std::int64_t ticks() const noexcept { return ticks_.load(std::memory_order_relaxed); }

  /// Lets the force fade and stops both threads. May block for some ticks and one call of the simulation.
  void stop();

  /// Valid after `stop`.
  const HapticServerStatistics& statistics() const noexcept { return statistics_; }

 private:
  struct Ghost {
    Eigen::Isometry3d X_WG = Eigen::Isometry3d::Identity();
    std::chrono::nanoseconds time{0};
  };

  bool haptic_tick(const realtime::PeriodicTick& timing) noexcept;
  void report(const HapticTick& tick, const ContactSet& set, std::chrono::nanoseconds now) noexcept;
  bool go_on_fading(const HapticTick& tick, std::chrono::nanoseconds now) noexcept;
  bool simulation_tick() noexcept;
  template <typename Work>
  bool guarded(const Work& work) noexcept;
  void fail(std::string_view message) noexcept;
  void answer_newest_ghost();

  devices::GloveDevice& device_;
  SlidingSimulation& simulation_;
  realtime::Clock& clock_;
  Sink sink_;
  HapticServerOptions options_;

  // Haptic thread only.
  HapticKernel kernel_;
  devices::GloveState state_;
  std::optional<std::chrono::nanoseconds> fading_since_;
  bool sink_failed_ = false;

  // Simulation thread only.
  std::int64_t set_sequence_ = 0;
  std::optional<std::chrono::nanoseconds> answered_;  // time of the last answered ghost
  std::vector<std::int32_t> scratch_;

  // Shared by both threads.
  realtime::TripleBuffer<Ghost> ghosts_;
  realtime::TripleBuffer<ContactSet> sets_;

  std::atomic<std::int64_t> ticks_{0};
  std::atomic<bool> done_{false};
  std::atomic<bool> should_end_{false};
  std::atomic<bool> emergency_{false};
  std::atomic<bool> is_failing_{false};  // one thread writes the message
  std::atomic<bool> failed_{false};
  std::array<char, 256> failure_{};  // written before failed_; a string might throw where the exception was bad_alloc
  HapticServerStatistics statistics_;
  std::unique_ptr<realtime::PeriodicThread> simulation_thread_;
  std::unique_ptr<realtime::PeriodicThread> haptic_thread_;
};

}  // namespace glissade::haptics
