#pragma once

/// A thread that calls a function, the tick function, at a fixed rate: `run_periodic` in a thread of its own. And what
/// such a thread needs of its system: a place ahead of other work, and memory that is there when a tick touches it.

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

/// SCHED_FIFO priorities of the threads between a device and its forces. A thread's work is done before that of those
/// it has to wait for.
inline constexpr int kHapticPriority = 80;
inline constexpr int kLinkPriority = 75;        ///< receives states and sends commands, or the other way round
inline constexpr int kSimulationPriority = 70;  ///< answers with contacts

/// The kernel holds up all threads of a processor under SCHED_FIFO where they compute for nearly all of a second (by
/// default 0.95 s, `sched_rt_runtime_us`), the haptic thread among them. So the others have their priority for a share
/// of the time only. With one glove, the shares are 0.8 of one processor together.
inline constexpr double kLinkShare = 0.1;  ///< receiving and sending, each
inline constexpr double kSimulationShare = 0.4;
inline constexpr double kSearchShare = 0.2;  ///< of a thread that searches for contacts

/// Name, period and priority of a periodic thread.
struct PeriodicThreadOptions {
  std::chrono::nanoseconds period{std::chrono::milliseconds(1)};
  int fifo_priority = 0;    ///< SCHED_FIFO priority to request, 1 to 99; 0 requests nothing
  double fifo_share = 1.0;  ///< as in `FifoShare`; 1: the priority is for good
  /// Time before each deadline for which the thread reads the clock instead of sleeping, as in `run_periodic`.
  std::chrono::nanoseconds spin{0};
  std::string name;  ///< as in `name_this_thread`; empty: that of the thread that starts it
};

/// Names the calling thread for `top -H`, debuggers and /proc. The system keeps the first 15 bytes.
void name_this_thread(std::string_view name) noexcept;

/// Whether the system would grant `lock_memory`: this process may lock as much memory as it likes. Changes nothing.
bool may_lock_memory() noexcept;

/// Keeps all memory of this process, present and future, in its place, so that no thread waits for a page: the system
/// neither moves pages out nor puts off to the first touch what it hands over, and the heap keeps what is freed. Then
/// each thread occupies its whole stack, 8 MiB unless the system says otherwise. Returns whether it was granted; if
/// not, nothing has changed. For programs, best at their start. Any thread.
bool lock_memory() noexcept;

/// What the system granted to a thread.
struct ThreadScheduling {
  bool is_fifo = false;                  ///< the thread runs under SCHED_FIFO, ahead of every ordinary thread
  bool has_locked_memory = false;        ///< `lock_memory` had been granted when the thread started
  bool has_minimal_timer_slack = false;  ///< the kernel does not delay timers to batch wake-ups (default: by 50 µs)
};

/// Puts the calling thread under SCHED_FIFO with `priority` (1 to 99) where the system allows it, leaves its scheduling
/// alone for `priority` 0, and sets its timer slack to the minimum. Where it does not allow it, asks for short slices
/// of time from `kLinkPriority` on: such threads compute little at a time. Never fails: a refusal shows in the result.
ThreadScheduling schedule_this_thread(int priority) noexcept;

/// The priority of the calling thread under SCHED_FIFO; 0: an ordinary thread.
int fifo_priority_of_this_thread() noexcept;

/// Whether a thread is within its share of each window of time, by what it tells of its computing.
class TimeShare {
 public:
  /// `share` is that of a window in which the thread may compute, 0 to 1.
  explicit TimeShare(double share) : share_(share) {}

  /// `now` is the time, `computed` all that the thread has computed so far.
  bool is_within(std::chrono::nanoseconds now, std::chrono::nanoseconds computed) noexcept;

 private:
  double share_;
  std::optional<std::chrono::nanoseconds> window_end_;
  std::chrono::nanoseconds computed_before_{0};
};

/// A priority under SCHED_FIFO for a share of the time: a thread that has computed for longer in a window of 10 ms is
/// an ordinary one until the next window. For the thread itself, which makes and uses the object. Calls the system, so
/// it is not for the haptic thread.
class FifoShare {
 public:
  /// Asks for `priority` as `schedule_this_thread` does.
  FifoShare(int priority, double share)
      : priority_(priority), share_(share), scheduling_(schedule_this_thread(priority)) {}

  const ThreadScheduling& scheduling() const noexcept { return scheduling_; }

  /// To be called often: at the end of a tick, or every millisecond of a long work.
  void check() noexcept;

 private:
  int priority_;
  TimeShare share_;
  ThreadScheduling scheduling_;
  bool is_ahead_ = true;
};

/// The thread starts in the constructor. The thread ends when the tick function returns false, on `stop()`, or in the
/// destructor. Thread-safety: only the thread that owns the object may call its functions.
class PeriodicThread {
 public:
  /// The tick function. Returns false to end the loop. Must not throw.
  using Tick = std::function<bool(const PeriodicTick&)>;

  /// `clock` must outlive the thread. Returns once the thread runs and its scheduling is known. Throws
  /// std::invalid_argument when the period is not positive, the spin too long or the tick function empty, and
  /// std::system_error when the system cannot start a thread.
  PeriodicThread(Clock& clock, const PeriodicThreadOptions& options, Tick tick);
  PeriodicThread(const PeriodicThread&) = delete;
  PeriodicThread& operator=(const PeriodicThread&) = delete;
  ~PeriodicThread() { stop(); }

  const ThreadScheduling& scheduling() const noexcept { return scheduling_; }

  /// Waits until the tick function has returned false.
  void join();

  /// Lets a running call of the tick function finish, and makes no further call. Waits until the thread has ended. The
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
