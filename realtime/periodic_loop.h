#pragma once

/// A loop that runs at a fixed rate and keeps account of how punctual it was.
///
/// The rule: the deadlines are a fixed grid, start + k · period. A tick that starts a whole period or more after its
/// deadline, so that its successor's deadline has passed too, counts late. After each tick the loop goes on with the
/// first deadline of the grid whose own period is not over yet; those before it are skipped and counted. So ticks never
/// bunch up to catch up, the loop never drifts, and after a short overrun the next tick starts at once.
///
/// It waits by plain absolute sleep. Spinning through the last 100 µs would bring the median lateness (20 µs under
/// SCHED_FIFO, a little more otherwise) to about 0, but takes a tenth of a core at 1 kHz, which on a small machine the
/// simulation needs more; and where a host takes the processor away for milliseconds, the tail stays as it was.

#include <chrono>
#include <cstdint>

#include <glissade/realtime/clock.h>
#include <glissade/realtime/latency_histogram.h>

namespace glissade::realtime {

/// The account of one loop. Runs add to it, so that a loop may be run in slices.
struct PeriodicStatistics {
  std::uint64_t ticks = 0;
  std::uint64_t late_ticks = 0;  ///< ticks that started after their successor's deadline
  std::uint64_t skipped_deadlines =
      0;                      ///< deadlines that got no tick, because an earlier tick or wake-up took too long
  LatencyHistogram lateness;  ///< start of the tick minus its deadline
  LatencyHistogram duration;  ///< end of the tick minus its start
};

/// What a tick is told.
struct PeriodicTick {
  std::uint64_t index;                ///< 0, 1, 2, … within this run; counts ticks, not deadlines
  std::chrono::nanoseconds deadline;  ///< when it should have started
  std::chrono::nanoseconds start;     ///< when it did
};

/// The bookkeeping of the rule above, without a clock. `run_periodic` is the loop to use.
class PeriodicSchedule {
 public:
  /// `period` > 0, otherwise std::invalid_argument. The first deadline is `start`.
  PeriodicSchedule(std::chrono::nanoseconds start, std::chrono::nanoseconds period);

  std::chrono::nanoseconds deadline() const noexcept { return deadline_; }

  /// Accounts for a tick that ran from `started` to `ended` and moves on to the next deadline.
  void finish_tick(std::chrono::nanoseconds started, std::chrono::nanoseconds ended,
                   PeriodicStatistics& statistics) noexcept;

 private:
  std::chrono::nanoseconds period_;
  std::chrono::nanoseconds deadline_;
};

/// Calls `tick(const PeriodicTick&) -> bool` every `period` in the calling thread, the first time one period from now,
/// until it returns false. Adds to `statistics` in place. Allocates nothing, locks nothing; between ticks it sleeps on
/// `clock`. Throws std::invalid_argument when `period` is not positive.
template <typename Tick>
void run_periodic(Clock& clock, std::chrono::nanoseconds period, PeriodicStatistics& statistics, Tick&& tick) {
  PeriodicSchedule schedule(clock.now() + period, period);
  bool go_on = true;
  for (std::uint64_t index = 0; go_on; ++index) {
    clock.sleep_until(schedule.deadline());
    const std::chrono::nanoseconds start = clock.now();
    go_on = tick(PeriodicTick{index, schedule.deadline(), start});
    schedule.finish_tick(start, clock.now(), statistics);
  }
}

}  // namespace glissade::realtime
