#pragma once

/// Clocks for loops: the clock of the machine, and a simulated clock. With the simulated clock, a loop is deterministic
/// and runs as fast as it can.

#include <chrono>

namespace glissade::realtime {

/// A source of time that can also wait. Times are nanoseconds since an epoch that is arbitrary but fixed for the
/// clock's life.
class Clock {
 public:
  virtual ~Clock() = default;

  virtual std::chrono::nanoseconds now() const noexcept = 0;

  /// Returns as soon as now() ≥ `deadline`, and at once if the deadline has already passed. May block.
  virtual void sleep_until(std::chrono::nanoseconds deadline) noexcept = 0;

  /// As `sleep_until`, for the last stretch before a deadline: a clock that can do so keeps the processor and reads the
  /// time again and again, so that no wake-up comes late.
  virtual void spin_until(std::chrono::nanoseconds deadline) noexcept { sleep_until(deadline); }
};

/// CLOCK_MONOTONIC, with the same epoch for every process of a machine. Any number of threads may use one object.
class SteadyClock final : public Clock {
 public:
  std::chrono::nanoseconds now() const noexcept override;
  void sleep_until(std::chrono::nanoseconds deadline) noexcept override;
  void spin_until(std::chrono::nanoseconds deadline) noexcept override;
};

/// A clock that starts at 0 and moves only by `sleep_until` and `advance`. Not thread-safe.
class SimulatedClock final : public Clock {
 public:
  std::chrono::nanoseconds now() const noexcept override { return now_; }
  void sleep_until(std::chrono::nanoseconds deadline) noexcept override {
    if (deadline > now_) now_ = deadline;
  }

  /// Lets `duration` (≥ 0) pass, for example the simulated duration of one cycle of a loop.
  void advance(std::chrono::nanoseconds duration) noexcept { now_ += duration; }

 private:
  std::chrono::nanoseconds now_{0};
};

}  // namespace glissade::realtime
