#pragma once

/// Time as the loops see it: the machine's, or a simulated one that makes a loop deterministic and as fast as it can
/// run.

#include <chrono>

namespace glissade::realtime {

/// Tells the time and waits. Times are nanoseconds since an epoch that is arbitrary but fixed for the clock's life.
class Clock {
 public:
  virtual ~Clock() = default;

  virtual std::chrono::nanoseconds now() const noexcept = 0;

  /// Returns once now() ≥ `deadline`; at once when it has passed. May block.
  virtual void sleep_until(std::chrono::nanoseconds deadline) noexcept = 0;
};

/// CLOCK_MONOTONIC, the same epoch for every process of a machine. Any number of threads may use one.
class SteadyClock final : public Clock {
 public:
  std::chrono::nanoseconds now() const noexcept override;
  void sleep_until(std::chrono::nanoseconds deadline) noexcept override;
};

/// A clock that stands still until it is moved; it starts at 0 and sleeping moves it. For one thread at a time.
class SimulatedClock final : public Clock {
 public:
  std::chrono::nanoseconds now() const noexcept override { return now_; }
  void sleep_until(std::chrono::nanoseconds deadline) noexcept override {
    if (deadline > now_) now_ = deadline;
  }

  /// Lets `duration` (≥ 0) pass, for example the time that a tick is to take.
  void advance(std::chrono::nanoseconds duration) noexcept { now_ += duration; }

 private:
  std::chrono::nanoseconds now_{0};
};

}  // namespace glissade::realtime
