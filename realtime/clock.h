#pragma once

/// Clocks for loops: the clock of the machine, and a simulated clock. A loop on the simulated clock is deterministic
/// and runs as fast as it can.

#include <chrono>

namespace glissade::realtime {

/// A source of time that can also wait. Times are nanoseconds since an arbitrary epoch, which is fixed for the clock's
/// life.
class Clock {
 public:
  virtual ~Clock() = default;

  virtual std::chrono::nanoseconds now() const noexcept = 0;

  /// Returns as soon as now() ≥ `deadline`. May block.
  virtual void sleep_until(std::chrono::nanoseconds deadline) noexcept = 0;

  /// As `sleep_until`, for a short time before a deadline. If a clock can spin, it reads the time in a busy loop
  /// instead of giving up the processor, so that no wake-up comes late.
  virtual void spin_until(std::chrono::nanoseconds deadline) noexcept { sleep_until(deadline); }
};

/// CLOCK_MONOTONIC. The epoch is the same for all processes of a machine. Any number of threads may use one object.
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
