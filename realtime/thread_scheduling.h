#pragma once

/// Asks the system for punctual wake-ups, and says what was granted.

namespace glissade::realtime {

/// What the calling thread got.
struct ThreadScheduling {
  bool is_fifo = false;                  ///< runs under SCHED_FIFO: ahead of every ordinary thread
  bool has_minimal_timer_slack = false;  ///< the kernel no longer delays its timers (by 50 µs) to batch wake-ups
};

/// Puts the calling thread under SCHED_FIFO with `priority` (1 to 99) where the system allows it, leaves its scheduling
/// alone for `priority` 0, and sets its timer slack to the minimum. Never fails: a refusal shows in the result. Set-up
/// code.
ThreadScheduling request_punctual_scheduling(int priority) noexcept;

}  // namespace glissade::realtime
