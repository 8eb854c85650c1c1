#pragma once

/// A thread that runs a tick at a fixed rate: `run_periodic` with a life of its own.

#include <atomic>
#include <chrono>
#include <functional>
#include <thread>

#include <glissade/realtime/clock.h>
#include <glissade/realtime/periodic_loop.h>

namespace glissade::realtime {

/// How a periodic thread runs.
struct PeriodicThreadOptions {
  std::chrono::nanoseconds period{std::chrono::milliseconds(1)};
  int fifo_priority = 0;  ///< SCHED_FIFO priority to ask for, 1 to 99; 0 asks for none
};

/// What the system granted to a thread.
struct ThreadScheduling {
  bool is_fifo = false;                  ///< runs under SCHED_FIFO: ahead of every ordinary thread
  bool has_minimal_timer_slack = false;  ///< the kernel no longer delays its timers (by 50 µs) to batch wake-ups
};

/// Starts in its constructor, ends when the tick returns false, on `stop()`, or with its destructor.
/// Thread-safety: only the thread that owns the object may call its functions.
class PeriodicThread {
 public:
  /// Returns false to end the loop. Must not throw.
  using Tick = std::function<bool(const PeriodicTick&)>;

  /// `clock` must outlive the thread. Returns once the thread runs and its scheduling is known. Throws
  /// std::invalid_argument when the period is not positive or the tick is empty, std::system_error when there is no
  /// thread to be had.
  PeriodicThread(Clock& clock, const PeriodicThreadOptions& options, Tick tick);
  PeriodicThread(const PeriodicThread&) = delete;
  PeriodicThread& operator=(const PeriodicThread&) = delete;
  ~PeriodicThread() { stop(); }

  const ThreadScheduling& scheduling() const noexcept { return scheduling_; }

  /// Waits until the tick has returned false.
  void join();

  /// Ends the loop after the current tick, or after the one it sleeps for, and waits for that: at most about a period.
  void stop();

  /// The account of the loop, once `join()` or `stop()` has returned.
  const PeriodicStatistics& statistics() const noexcept { return statistics_; }

 private:
  ThreadScheduling scheduling_;
  PeriodicStatistics statistics_;
  std::atomic<bool> should_stop_{false};
  std::thread thread_;
};

}  // namespace glissade::realtime
