#pragma once

/// Two clocks for loops: the clock of the machine and a simulated clock. A loop on the simulated clock is deterministic
/// and runs as fast as it can.

#include <chrono>

#include <glissade/base/export.h>

namespace glissade::realtime {

/// A source of time that can also wait. Times are nanoseconds since an epoch. The epoch is arbitrary, but fixed for the
/// clock's life.
class GLISSADE_EXPORT Clock {
 public:
  virtual ~Clock() = default;

  virtual std::chrono::nanoseconds now() const noexcept = 0;

  /// Returns as soon as now() ≥ `deadline`. May block.
  virtual void sleep_until(std::chrono::nanoseconds deadline) noexcept = 0;

  /// Like `sleep_until`, for the short time before a deadline. A clock that can spin reads the time in a busy loop and
  /// keeps the processor, so no wake-up can be late.
  virtual void spin_until(std::chrono::nanoseconds deadline) noexcept { sleep_until(deadline); }
};

/// The clock of the machine, CLOCK_MONOTONIC. The epoch is the same for all processes of a machine. Any number of
/// threads may use one object.
class GLISSADE_EXPORT SteadyClock final : public Clock {
 public:
  std::chrono::nanoseconds now() const noexcept override;
  void sleep_until(std::chrono::nanoseconds deadline) noexcept override;
  void spin_until(std::chrono::nanoseconds deadline) noexcept override;
};

/// A simulated clock. It starts at 0, and only `sleep_until` and `advance` change its time. Not thread-safe.
class GLISSADE_EXPORT SimulatedClock final : public Clock {
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
