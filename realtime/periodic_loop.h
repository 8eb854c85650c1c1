#pragma once

/// A loop that calls a function at a fixed rate and records its punctuality. A tick is one call of this function.
///
/// The scheduling rule is as follows. The deadlines form a fixed grid, start + k · period. A tick counts as late when
/// it starts at or after the deadline that follows its own deadline. After each tick, the next deadline is the first
/// later deadline that is in the future or less than one period in the past. The loop skips and counts the deadlines in
/// between. So ticks never run in bursts, and the loop never drifts. After an overrun, the next tick starts at once.
///
/// Between ticks, the loop sleeps until the absolute time of the next deadline. The sleep ends late, because the system
/// needs some time to wake the thread. With spinning, the loop sleeps until a given time before the deadline. Then it
/// reads the clock until the deadline. Spinning is off by default, because it takes a part of a core from other
/// threads. Spinning does not shorten the longest delays, in which the thread does not get the processor. For
/// measurements, see docs/real_time.md.

#include <chrono>
#include <cstdint>

#include <glissade/base/export.h>
#include <glissade/realtime/clock.h>
#include <glissade/realtime/latency_histogram.h>

namespace glissade::realtime {

/// Statistics of one loop. Each run adds to the statistics, so a loop may be split into several runs.
struct PeriodicStatistics {
  std::uint64_t ticks = 0;
  std::uint64_t late_ticks = 0;         ///< ticks that started a period or more after their deadline
  std::uint64_t skipped_deadlines = 0;  ///< deadlines without a tick, because of a late wake-up or a long tick
  LatencyHistogram lateness;            ///< start of the tick minus its deadline
  LatencyHistogram duration;            ///< end of the tick minus its start
};

/// The argument of a tick function.
struct PeriodicTick {
  std::uint64_t index;                ///< number of the tick in this run, from 0; skipped deadlines do not count
  std::chrono::nanoseconds deadline;  ///< scheduled start of this tick
  std::chrono::nanoseconds start;     ///< actual start of this tick
};

/// Computes deadlines by the scheduling rule (see the top of this file), without a clock. `run_periodic` is the
/// complete loop.
class GLISSADE_EXPORT PeriodicSchedule {
 public:
  /// The first deadline is `start`. Throws std::invalid_argument if `period` is not positive.
  PeriodicSchedule(std::chrono::nanoseconds start, std::chrono::nanoseconds period);

  std::chrono::nanoseconds deadline() const noexcept { return deadline_; }

  /// Adds a tick that ran from `started` to `ended` to `statistics`, and advances to the next deadline by the
  /// scheduling rule.
  void finish_tick(std::chrono::nanoseconds started, std::chrono::nanoseconds ended,
                   PeriodicStatistics& statistics) noexcept;

 private:
  std::chrono::nanoseconds period_;
  std::chrono::nanoseconds deadline_;
};

/// Throws std::invalid_argument unless 0 ≤ `spin` ≤ `period` / 2. Under SCHED_FIFO, a loop that spins all the time
/// would block all other threads of its processor.
GLISSADE_EXPORT void validate_spin(std::chrono::nanoseconds spin, std::chrono::nanoseconds period);

/// Calls `tick(const PeriodicTick&) -> bool` every `period` in the calling thread until the tick returns false. The
/// first call is one period from now. Updates `statistics`. Allocates and locks nothing. Between ticks, the loop sleeps
/// on `clock` until the time `spin` before the deadline, and then spins until the deadline. Throws
/// std::invalid_argument if `period` is not positive or `validate_spin` rejects `spin`.
template <typename Tick>
void run_periodic(Clock& clock, std::chrono::nanoseconds period, PeriodicStatistics& statistics, Tick&& tick,
                  std::chrono::nanoseconds spin = std::chrono::nanoseconds(0)) {
  PeriodicSchedule schedule(clock.now() + period, period);
  validate_spin(spin, period);
  bool go_on = true;
  for (std::uint64_t index = 0; go_on; ++index) {
    clock.sleep_until(schedule.deadline() - spin);
    if (spin > std::chrono::nanoseconds::zero()) clock.spin_until(schedule.deadline());
    const std::chrono::nanoseconds start = clock.now();
    go_on = tick(PeriodicTick{index, schedule.deadline(), start});
    schedule.finish_tick(start, clock.now(), statistics);
  }
}

}  // namespace glissade::realtime
