#pragma once

/// A thread that calls a tick function at a fixed rate by `run_periodic`. This file also has functions that request
/// real-time priority and locked memory from the system.

#include <atomic>
#include <chrono>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <thread>

#include <glissade/base/export.h>
#include <glissade/realtime/clock.h>
#include <glissade/realtime/periodic_loop.h>

namespace glissade::realtime {

/// SCHED_FIFO priorities of the threads on the path from the states of a device to its forces.
inline constexpr int kHapticPriority = 80;
inline constexpr int kLinkPriority = 75;        ///< receives states and sends commands, or vice versa
inline constexpr int kSimulationPriority = 70;  ///< computes contacts

/// A part of the time: the share, from 0 to 1, of each window.
struct TimeShare {
  double share = 1.0;
  std::chrono::nanoseconds window{std::chrono::milliseconds(10)};
};

/// The shares of time in which threads other than the haptic thread have their priority. The kernel stops all
/// SCHED_FIFO threads of a processor, including the haptic thread, if they compute for nearly all of a second (by
/// default 0.95 s, see `sched_rt_runtime_us`). With one glove, the shares add up to 0.9 of one processor.
///
/// A link has a long window. After a stall, it must send all waiting messages. Without priority, more would wait.
inline constexpr TimeShare kLinkShare{0.15, std::chrono::milliseconds(100)};  ///< of each thread that receives or sends
inline constexpr TimeShare kSimulationShare{0.4};
inline constexpr TimeShare kSearchShare{0.2};  ///< of a thread that searches for contacts

/// Name, period and priority of a periodic thread.
struct PeriodicThreadOptions {
  std::chrono::nanoseconds period{std::chrono::milliseconds(1)};
  int fifo_priority = 0;      ///< SCHED_FIFO priority to request, 1 to 99; 0 requests nothing
  TimeShare fifo_share = {};  ///< see `FifoShare`; 1: the priority is permanent
  /// Time before each deadline for which the thread spins instead of sleeping, see `run_periodic`.
  std::chrono::nanoseconds spin{0};
  std::string name;  ///< see `name_this_thread`; empty: the name of the starting thread
};

/// Sets the name of the calling thread, as shown by `top -H`, debuggers and /proc. The system keeps the first 15 bytes.
GLISSADE_EXPORT void name_this_thread(std::string_view name) noexcept;

/// Whether the system would grant `lock_memory`, i.e. whether this process may lock any amount of memory. Changes
/// nothing.
GLISSADE_EXPORT bool may_lock_memory() noexcept;

/// Locks all present and future memory of this process, so that no thread waits for a page. The system neither swaps
/// pages out nor defers their allocation to the first access, and the heap keeps freed memory. The whole stack of each
/// thread, by default 8 MiB, then occupies memory. Returns whether the system granted the lock. Without the lock,
/// nothing has changed. Programs should call this function at their start. Any thread may call it.
GLISSADE_EXPORT bool lock_memory() noexcept;

/// What the system granted to a thread.
struct ThreadScheduling {
  bool is_fifo = false;                  ///< the thread runs under SCHED_FIFO, ahead of every ordinary thread
  bool has_locked_memory = false;        ///< `lock_memory` had been granted when the thread started
  bool has_minimal_timer_slack = false;  ///< the kernel does not delay timers (default: up to 50 µs) to batch wake-ups
};

/// Puts the calling thread under SCHED_FIFO with `priority` (1 to 99). A `priority` of 0 leaves the policy unchanged.
/// Also sets the timer slack of the thread to the minimum. If the system refuses SCHED_FIFO and `priority` is at least
/// kLinkPriority, the function requests short time slices instead. The function never fails. The result shows a
/// refusal.
GLISSADE_EXPORT ThreadScheduling schedule_this_thread(int priority) noexcept;

/// The SCHED_FIFO priority of the calling thread; 0 for an ordinary thread.
GLISSADE_EXPORT int fifo_priority_of_this_thread() noexcept;

/// Checks whether a thread keeps to its share of processor time in each window.
class GLISSADE_EXPORT TimeBudget {
 public:
  explicit TimeBudget(const TimeShare& share) : share_(share) {}

  /// `now` is the time. `computed` is the total processor time of the thread so far.
  bool is_within(std::chrono::nanoseconds now, std::chrono::nanoseconds computed) noexcept;

 private:
  TimeShare share_;
  std::optional<std::chrono::nanoseconds> window_end_;
  std::chrono::nanoseconds computed_before_{0};
};

/// A SCHED_FIFO priority for a share of the time. If a thread computes for more than its share of a window, it becomes
/// an ordinary thread until the next window. The thread itself constructs and uses the object. The haptic thread must
/// not use it, because `check` calls the system.
class GLISSADE_EXPORT FifoShare {
 public:
  /// Requests `priority` in the same way as `schedule_this_thread`.
  FifoShare(int priority, const TimeShare& share)
      : priority_(priority), budget_(share), scheduling_(schedule_this_thread(priority)) {}

  const ThreadScheduling& scheduling() const noexcept { return scheduling_; }

  /// Call this often: at the end of each tick, or in every millisecond of a long computation.
  void check() noexcept;

 private:
  int priority_;
  TimeBudget budget_;
  ThreadScheduling scheduling_;
  bool is_ahead_ = true;
};

/// The constructor starts the thread. The thread ends when the tick function returns false, at a call of `stop()`, or
/// in the destructor. Thread-safety: only the thread that owns the object may call its functions.
class GLISSADE_EXPORT PeriodicThread {
 public:
  /// The tick function. Returns false to end the loop. Must not throw.
  using Tick = std::function<bool(const PeriodicTick&)>;

  /// `clock` must outlive the thread. Returns once the thread runs and its scheduling is known. Throws
  /// std::invalid_argument if the period is not positive, if the spin is too long, or if the tick function is empty.
  /// Throws std::system_error if the system cannot start a thread.
  PeriodicThread(Clock& clock, const PeriodicThreadOptions& options, Tick tick);
  PeriodicThread(const PeriodicThread&) = delete;
  PeriodicThread& operator=(const PeriodicThread&) = delete;
  ~PeriodicThread() { stop(); }

  const ThreadScheduling& scheduling() const noexcept { return scheduling_; }

  /// Waits until the tick function has returned false.
  void join();

  /// Ends the thread and waits for its end. The tick function is not called again, but a running call finishes. The
  /// thread ends at its next deadline, at most about one period later.
  void stop();

  /// Statistics of the loop, valid once `join()` or `stop()` has returned.
  const PeriodicStatistics& statistics() const noexcept { return statistics_; }

 private:
  ThreadScheduling scheduling_;
  PeriodicStatistics statistics_;
  std::atomic<bool> should_stop_{false};
  std::thread thread_;
};

}  // namespace glissade::realtime
