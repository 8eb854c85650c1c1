#pragma once

/// A thread that calls a tick function at a fixed rate by `run_periodic`. Also has functions that request real-time
/// priority and locked memory from the system.

#include <atomic>
#include <chrono>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <thread>

#include <glissade/realtime/clock.h>
#include <glissade/realtime/periodic_loop.h>

namespace glissade::realtime {

/// SCHED_FIFO priorities of the threads on the path from the states of a device to its forces.
inline constexpr int kHapticPriority = 80;
inline constexpr int kLinkPriority = 75;        ///< receives states and sends commands, or vice versa
inline constexpr int kSimulationPriority = 70;  ///< computes contacts

/// The shares of the time for which other threads than the haptic thread have their priority. The kernel stops all
/// SCHED_FIFO threads of a processor, including the haptic thread, once they compute for nearly all of a second (by
/// default 0.95 s, `sched_rt_runtime_us`). With one glove, the shares add up to 0.8 of one processor.
inline constexpr double kLinkShare = 0.1;  ///< of each thread that receives or sends
inline constexpr double kSimulationShare = 0.4;
inline constexpr double kSearchShare = 0.2;  ///< of a thread that searches for contacts

/// Name, period and priority of a periodic thread.
struct PeriodicThreadOptions {
  std::chrono::nanoseconds period{std::chrono::milliseconds(1)};
  int fifo_priority = 0;    ///< SCHED_FIFO priority to request, 1 to 99; 0 requests nothing
  double fifo_share = 1.0;  ///< as in `FifoShare`; 1: the priority is permanent
  /// Time before each deadline for which the thread spins instead of sleeping, as in `run_periodic`.
  std::chrono::nanoseconds spin{0};
  std::string name;  ///< as in `name_this_thread`; empty: the name of the starting thread
};

/// Names the calling thread for `top -H`, debuggers and /proc. The system keeps the first 15 bytes of the name.
void name_this_thread(std::string_view name) noexcept;

/// Whether the system would grant `lock_memory`, i.e. lets this process lock any amount of memory. Changes nothing.
bool may_lock_memory() noexcept;

/// Locks all present and future memory of this process, so that no thread waits for a page. The system neither swaps
/// pages out nor defers their allocation to the first access, and the heap keeps freed memory. Each thread then
/// occupies its whole stack, by default 8 MiB. Returns whether the lock was granted; if not, nothing has changed.
/// Programs should call this at their start. Any thread may call it.
bool lock_memory() noexcept;

/// What the system granted to a thread.
struct ThreadScheduling {
  bool is_fifo = false;                  ///< the thread runs under SCHED_FIFO, ahead of every ordinary thread
  bool has_locked_memory = false;        ///< `lock_memory` had been granted when the thread started
  bool has_minimal_timer_slack = false;  ///< the kernel does not delay timers to batch wake-ups (default: up to 50 µs)
};

/// Puts the calling thread under SCHED_FIFO with `priority` (1 to 99); 0 leaves the policy unchanged. Also sets the
/// timer slack of the thread to the minimum. If the system refuses SCHED_FIFO and `priority` is at least kLinkPriority,
/// requests short time slices instead. Never fails: a refusal shows in the result.
ThreadScheduling schedule_this_thread(int priority) noexcept;

/// The SCHED_FIFO priority of the calling thread; 0 for an ordinary thread.
int fifo_priority_of_this_thread() noexcept;

/// Checks whether a thread computes for no more than its share of each window of 10 ms.
class TimeShare {
 public:
  /// `share`, from 0 to 1, is the fraction of a window in which the thread may compute.
  explicit TimeShare(double share) : share_(share) {}

  /// `now` is the time, `computed` the total processor time of the thread so far.
  bool is_within(std::chrono::nanoseconds now, std::chrono::nanoseconds computed) noexcept;

 private:
  double share_;
  std::optional<std::chrono::nanoseconds> window_end_;
  std::chrono::nanoseconds computed_before_{0};
};

/// A SCHED_FIFO priority for a share of the time. A thread that computes for more than its share of a window of 10 ms
/// is an ordinary thread until the next window. The thread itself constructs and uses the object. The haptic thread
/// must not use it, because `check` calls the system.
class FifoShare {
 public:
  /// Requests `priority` as `schedule_this_thread` does.
  FifoShare(int priority, double share)
      : priority_(priority), share_(share), scheduling_(schedule_this_thread(priority)) {}

  const ThreadScheduling& scheduling() const noexcept { return scheduling_; }

  /// Call this often: at the end of a tick, or every millisecond of a long computation.
  void check() noexcept;

 private:
  int priority_;
  TimeShare share_;
  ThreadScheduling scheduling_;
  bool is_ahead_ = true;
};

/// The thread starts in the constructor. It ends when the tick function returns false, on `stop()`, or in the
/// destructor. Thread-safety: only the thread that owns the object may call its functions.
class PeriodicThread {
 public:
  /// The tick function. Returns false to end the loop. Must not throw.
  using Tick = std::function<bool(const PeriodicTick&)>;

  /// `clock` must outlive the thread. Returns once the thread runs and its scheduling is known. Throws
  /// std::invalid_argument when the period is not positive, when the spin is too long, and when the tick function is
  /// empty. Throws std::system_error when the system cannot start a thread.
  PeriodicThread(Clock& clock, const PeriodicThreadOptions& options, Tick tick);
  PeriodicThread(const PeriodicThread&) = delete;
  PeriodicThread& operator=(const PeriodicThread&) = delete;
  ~PeriodicThread() { stop(); }

  const ThreadScheduling& scheduling() const noexcept { return scheduling_; }

  /// Waits until the tick function has returned false.
  void join();

  /// Ends the thread without a further call of the tick function, and waits for the end. A running call finishes first.
  /// The thread ends at its next deadline, at most about one period later.
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
