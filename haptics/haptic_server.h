#pragma once

/// Runs the system in real time, with two threads. The haptic thread runs at 1 kHz or another rate. It computes the
/// forces and the poses of the ghosts (the parts' poses if nothing were in the way) from the states of all devices and
/// the newest contact set. The simulation thread answers the newest poses of the ghosts with a contact set, once per
/// millisecond if the collision queries are fast enough. Neither thread waits for the other.

#include <array>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <glissade/base/export.h>
#include <glissade/devices/glove_device.h>
#include <glissade/devices/haptic_state.h>
#include <glissade/haptics/haptic_kernel.h>
#include <glissade/haptics/recording.h>
#include <glissade/realtime/clock.h>
#include <glissade/realtime/latency_histogram.h>
#include <glissade/realtime/periodic_thread.h>
#include <glissade/realtime/spsc_ring.h>
#include <glissade/realtime/triple_buffer.h>

namespace glissade::grasping {
class GraspSimulation;
}

namespace glissade::haptics {

class Answerer;

struct HapticServerOptions {
  /// Period of the haptic thread, from kShortestTickPeriod to kLongestTickPeriod. The forces do not depend on the
  /// period, because all rates of change are per second.
  std::chrono::nanoseconds period = kTickPeriod;
  /// Number of counted ticks after which the force fades and the haptic thread ends. With 0, the thread runs until
  /// `stop`. Ticks before the first state of any device and ticks of the fade are not counted.
  std::int64_t ticks = 0;
  /// How long before each deadline the haptic thread polls the clock instead of sleeping; at most half of the period.
  /// Polling makes ticks start on time, but occupies a processor while it lasts.
  std::chrono::nanoseconds spin{0};
  /// Receives the state of each counted tick. May be empty. The haptic thread calls this function, so the function must
  /// be real-time safe. After an exception from `sink` the force fades, as after an exception of the simulation, and
  /// `sink` is not called again.
  std::function<void(const devices::HapticState&)> sink{};
  LoopObserver* observer = nullptr;  ///< null: none; must outlive the server
  /// If null, the steady clock of the system is used. Several threads use the clock. The clock must outlive the server.
  realtime::Clock* clock = nullptr;
};

/// Measurements of the server. Complete after `stop`.
struct HapticServerStatistics {
  realtime::PeriodicStatistics haptic;         ///< all ticks of the haptic thread, counted or not
  realtime::LatencyHistogram simulation;       ///< duration of each call of the simulation
  realtime::LatencyHistogram contact_set_age;  ///< age of the contact set's ghosts at each counted tick
  std::int64_t unsolved_ticks = 0;             ///< counted ticks in which the contacts of any hand had no solution
  realtime::ThreadScheduling scheduling;       ///< of the haptic thread
  std::int64_t page_faults = 0;                ///< of the haptic thread, from its first counted tick to its end
};

/// Runs both threads from construction to `stop`. Thread-safety: one thread owns the object. From construction to the
/// end of `stop`, only the server's threads may use the devices and `simulation`.
class GLISSADE_EXPORT HapticServer {
 public:
  /// Starts both threads. Devices and simulation must outlive the server. A hand grasps its part when the first state
  /// of its device arrives. Grasping does not move the part. A part that no hand holds and no script moves lies still
  /// and is an obstacle. The coupling is the result of `coupling_for` with the descriptor of the device and the
  /// stiffness of the simulation. The simulation should use `contact::real_time_rules`. Throws std::invalid_argument if
  /// a device is null, if the period is out of bounds, or if there are fewer devices than hands in the simulation. Also
  /// throws what the constructors of `HapticKernel` and `realtime::PeriodicThread` throw.
  HapticServer(const std::vector<HandInLoop<devices::GloveDevice>>& hands, grasping::GraspSimulation& simulation,
               HapticServerOptions options = {});
  HapticServer(const HapticServer&) = delete;
  HapticServer& operator=(const HapticServer&) = delete;
  ~HapticServer();

  /// Calls `HapticKernel::grasp` or `HapticKernel::release` in the next tick. Returns false and does nothing if the
  /// kernel refuses, or if 256 calls wait for the haptic thread. In the second case, the caller may try again.
  /// Wait-free. Only one thread may call these functions. `release` does not affect hands with fingers, because the
  /// simulation decides for these hands.
  bool grasp(std::size_t hand, std::size_t part) noexcept {
    return kernel_.can_grasp(hand, part) &&
           requests_.push({static_cast<std::int32_t>(hand), static_cast<std::int32_t>(part)});
  }
  bool release(std::size_t hand) noexcept {
    return hand < devices_.size() && requests_.push({static_cast<std::int32_t>(hand), -1});
  }

  /// Whether the server has reached `HapticServerOptions::ticks` and the forces of all devices are zero. Wait-free, any
  /// thread.
  bool is_done() const noexcept { return done_.load(std::memory_order_acquire); }

  /// Whether the simulation or the sink threw an exception. Then the force fades and stays at zero. Wait-free, any
  /// thread.
  bool has_failed() const noexcept { return failed_.load(std::memory_order_acquire); }
  /// The first 255 bytes of the exception's message. Valid once `has_failed` returns true.
  std::string failure() const { return failure_.data(); }

  /// The force fades and stays at zero, but the loop goes on. Wait-free, any thread.
  void emergency_stop() noexcept { emergency_.store(true, std::memory_order_relaxed); }

  /// Number of counted ticks so far. Wait-free, any thread.
  std::int64_t ticks() const noexcept { return ticks_.load(std::memory_order_relaxed); }

  /// Number of all ticks so far, counted or not, that began a period or more late. Wait-free, any thread.
  std::int64_t late_ticks() const noexcept { return late_ticks_.load(std::memory_order_relaxed); }
  /// The scheduling that the system granted to the haptic thread. Any thread.
  const realtime::ThreadScheduling& scheduling() const noexcept { return haptic_thread_->scheduling(); }

  /// Blocks for `longest`, or until the server is done or has failed. Then stops the server. If the server has failed,
  /// throws std::runtime_error with the message of `failure`.
  void run_for(std::chrono::nanoseconds longest);
  /// Like `run_for`, but without a time limit. Throws std::invalid_argument if `HapticServerOptions::ticks` is 0. As
  /// long as no device sends a state, the function returns only if the server fails.
  void wait();

  /// Lets the force fade and stops both threads. May block for some ticks and one call of the simulation.
  void stop();

  /// Valid after `stop`.
  const HapticServerStatistics& statistics() const noexcept { return statistics_; }

 private:
  bool read_devices() noexcept;
  void take_requests() noexcept;
  bool haptic_tick(const realtime::PeriodicTick& timing) noexcept;
  void report() noexcept;
  bool go_on_fading() noexcept;
  bool simulation_tick() noexcept;
  template <typename Work>
  bool guarded(const Work& work) noexcept;
  void fail(std::string_view message) noexcept;
  void answer_newest_ghosts();

  HapticServerOptions options_;
  realtime::SteadyClock steady_clock_;
  realtime::Clock& clock_;

  // Haptic thread only.
  std::vector<devices::GloveDevice*> devices_;
  TickRecord record_;  // of the newest tick
  HapticKernel kernel_;
  std::optional<std::chrono::nanoseconds> fading_since_;
  bool sink_failed_ = false;
  std::int64_t page_faults_before_ = 0;  // the first counted tick

  // Simulation thread only.
  std::unique_ptr<Answerer> answerer_;
  AnswerRecord answer_;  // the newest

  // Shared.
  realtime::SpscRing<HoldRequest> requests_{256};
  realtime::TripleBuffer<Ghosts> ghosts_;
  realtime::TripleBuffer<ContactSet> sets_;

  std::atomic<std::int64_t> ticks_{0};
  std::atomic<std::int64_t> late_ticks_{0};
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
