#pragma once

/// Clocks for loops: the machine's, and a simulated one, with which a loop is deterministic and runs as fast as it can.

#include <chrono>

namespace glissade::realtime {

/// A source of time that can also wait. Times are nanoseconds since an epoch that is arbitrary but fixed for the
/// clock's life.
class Clock {
 public:
  virtual ~Clock() = default;

  virtual std::chrono::nanoseconds now() const noexcept = 0;

  /// Returns once now() ≥ `deadline`; at once when it has passed. May block.
  virtual void sleep_until(std::chrono::nanoseconds deadline) noexcept = 0;
};

/// CLOCK_MONOTONIC, with the same epoch for every process of a machine. Any number of threads may use one object.
class SteadyClock final : public Clock {
 public:
  std::chrono::nanoseconds now() const noexcept override;
  void sleep_until(std::chrono::nanoseconds deadline) noexcept override;
};

/// A clock that starts at 0 and moves only by `sleep_until` and `advance`. For one thread at a time.
class SimulatedClock final : public Clock {
 public:
  std::chrono::nanoseconds now() const noexcept override { return now_; }
  void sleep_until(std::chrono::nanoseconds deadline) noexcept override {
    if (deadline > now_) now_ = deadline;
  }

  /// Lets `duration` (≥ 0) pass, for example the simulated duration of a tick.
  void advance(std::chrono::nanoseconds duration) noexcept { now_ += duration; }

 private:
  std::chrono::nanoseconds now_{0};
};

}  // namespace glissade::realtime
